//! Data of the control that a program sets.

use super::{OwnLength, WorkOffset};

/// Registers from this number on are the program's own: lengths and radii that it gives as numbers (`G43.1`, `G41.1`). Those of
/// lengths and those of radii are counted apart.
pub const OWN_REGISTERS: u32 = 1 << 30;

/// Data that a program sets at the control, in millimetres; no axis moves.
///
/// The zero of a work offset has a place on the part, which the setup tells, and a place in the machine, which it does not: a program
/// that sets it for the first time is taken to set it where the setup has it. Another zero later is a shifted frame of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ControlData {
    /// Machine coordinates of the zero of a work offset, of the axes that are said (`G10 L2`); `None` is the offset that is added
    /// to all of them (`G10 L2 P0`).
    Zero {
        /// The work offset.
        offset: Option<WorkOffset>,
        /// Its zero.
        place: [Option<f64>; 3],
    },
    /// Coordinates that the present place gets, of axes whose place there the program has not set before: by the zero of a work
    /// offset (`G10 L20`), which may be another one than that in force and then counts neither shifted nor turned, or for all of
    /// them (`G92`).
    Here {
        /// The work offset.
        offset: Option<WorkOffset>,
        /// The coordinates.
        place: [Option<f64>; 3],
    },
    /// Offsets along X, Y and Z in the tool table, of the axes that are said (`G10 L1 P Z`; `G10 L10 P R` of FANUC, a length).
    Length {
        /// Its register.
        register: u32,
        /// The offsets; that along Z is the length.
        offset: [Option<f64>; 3],
    },
    /// A length register that is called before the program has called a tool: that of the tool in the spindle. `None` is off.
    LengthCall {
        /// The register.
        register: Option<u32>,
    },
    /// A length that the program makes of numbers and registers (`G43.1`, `G43.2`), which is not in force by that.
    OwnLength {
        /// Its register, [`OWN_REGISTERS`] and above.
        register: u32,
        /// The length.
        length: OwnLength,
    },
    /// A move at feed towards a place in coordinates of its frame that ends where a probe changes its state (`G38.2` to `G38.5`).
    Probe {
        /// 2: until it touches, 3: likewise, without an alarm, 4: until it lets go, 5: likewise, without an alarm.
        kind: u8,
        /// The place, of the axes that move.
        place: [Option<f64>; 3],
    },
    /// The spindle stops at an angle (`M19`).
    Orient {
        /// The angle [deg].
        degrees: f64,
        /// Sense: 0 shortest, 1 clockwise, 2 counter-clockwise.
        way: u8,
        /// Longest wait for it [s].
        seconds: f64,
    },
    /// A radius in the tool table (`G10 L1 P R`, `G10 L12 P R`).
    Radius {
        /// Its register.
        register: u32,
        /// The radius.
        radius: f64,
    },
}
