//! Functions of the machine that move no axis by custom, and that a reader may be asked to pass over.
//!
//! What an M code of the machine does is its builder's: a number is here where manuals of several builders give it the same purpose.
//! From memory; a builder may have put a macro behind any of them, which is said with each.

/// Numbers of M codes, the first and the last, and what they are for.
pub(super) type Functions = &'static [(u32, u32, &'static str)];

/// FANUC, SINUMERIK: clamps of rotary axes, gears, coolants.
pub(super) const MACHINE: Functions = &[
    (10, 11, "clamp of a rotary axis"),
    (40, 46, "gear of the spindle"),
    (50, 51, "coolant through the spindle, air"),
];

/// Haas: brakes, gears, coolant, relays.
pub(super) const HAAS: Functions = &[
    (10, 13, "brake of a rotary axis"),
    (21, 28, "relay and its answer"),
    (34, 35, "place of the coolant"),
    (41, 42, "gear of the spindle"),
    (51, 58, "relay on"),
    (61, 68, "relay off"),
    (83, 84, "air blast"),
];

/// LinuxCNC: programs of the operating system.
pub(super) const LINUXCNC: Functions = &[(100, 199, "program of the machine")];
