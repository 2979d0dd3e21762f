//! The paper's lengths and coordinates of a drilled hole.

use super::{End, Side, Transient};

/// Lengths of a hole by the paper's names [mm]; those of the exit are `None` for a hole that does not go through.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lengths {
    /// L_vr1, L_vyh1: length of the point.
    pub point: f64,
    /// L_vr2: what the entry surface adds; negative where it takes away.
    pub entry_surface: f64,
    /// L_vyh2: what the exit surface adds.
    pub exit_surface: Option<f64>,
    /// L_nvr: distance of the first contact from the entry's frame.
    pub to_entry: f64,
    /// L_kvyh: distance of the break-through from the exit's frame.
    pub to_exit: Option<f64>,
    /// L_vr: the whole entry, with the approach.
    pub entry: f64,
    /// L_ust: steady cutting; negative where the drill comes out before all of it is in.
    pub steady: f64,
    /// L_vyh: the whole exit, with the overrun.
    pub exit: Option<f64>,
    /// L_rx: working stroke.
    pub stroke: f64,
}

/// Z coordinates by the paper's names [mm].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coordinates {
    /// Z_nvr1 and Z_nvr2: start and end of the entry, in the frame of the entry.
    pub entry: [f64; 2],
    /// Z_kvyh1 and Z_kvyh2: start and end of the exit, in the frame of the exit.
    pub exit_own: Option<[f64; 2]>,
    /// Z_nvyh1 and Z_nvyh2: the same in the frame of the entry.
    pub exit: Option<[f64; 2]>,
    /// Z of the tool's end, in the frame of the entry.
    pub end: f64,
    /// Best places for the zeros of the two frames, entry and exit, each in its own frame: at first contact and at
    /// break-through, so that the program starts at the approach and the exit begins at 0. `None` for a hole without
    /// exit.
    pub best_zeros: [Option<f64>; 2],
}

/// The numbers that make lengths and coordinates [mm].
pub(super) struct Frames {
    pub(super) point: f64,
    pub(super) entry: Transient,
    pub(super) exit: Option<Transient>,
    pub(super) start: f64,
    pub(super) end: f64,
    /// Distance of the exit's frame below the entry's.
    pub(super) length: f64,
}

impl Frames {
    pub(super) fn lengths(&self) -> Lengths {
        let entry = self.start - self.entry.last;
        let below = self.exit.map_or(self.end, |e| e.first);
        Lengths {
            point: self.point,
            entry_surface: self.entry.first - self.entry.last - self.point,
            exit_surface: self.exit.map(|e| e.first - e.last - self.point),
            to_entry: self.entry.first.abs(),
            to_exit: self.exit.map(|e| (e.first + self.length).abs()),
            entry,
            steady: self.entry.last - below,
            exit: self.exit.map(|e| e.first - self.end),
            stroke: self.start - self.end,
        }
    }

    pub(super) fn coordinates(&self) -> Coordinates {
        Coordinates {
            entry: [self.start, self.entry.last],
            exit_own: self.exit.map(|e| [e.first + self.length, self.end + self.length]),
            exit: self.exit.map(|e| [e.first, self.end]),
            end: self.end,
            best_zeros: [Some(self.entry.first), self.exit.map(|e| e.first + self.length)],
        }
    }
}

impl End {
    /// The surface through which the hole leaves, if it does.
    pub fn exit(&self) -> Option<&super::BoundarySurface> {
        if let End::Through { exit, .. } = self { Some(exit) } else { None }
    }
}

impl Side {
    /// The word shown.
    pub fn word(self) -> &'static str {
        match self {
            Side::Entry => "entry",
            Side::Exit => "exit",
        }
    }
}
