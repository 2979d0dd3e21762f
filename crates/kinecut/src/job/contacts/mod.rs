//! Contacts while a program runs: tools past clamps and fixtures, and all that the machine moves.

pub(super) mod fixtures;
pub(super) mod machine;
pub(super) mod noun;

use crate::trace::{StandKind, Trace};

/// Moves that are watched at once: their motions take some hundred bytes each.
const AT_ONCE: usize = 1 << 18;

/// Distance up to which passes are looked for [mm]: how far an offset or a length may be off.
pub(in crate::job) const LOOK: f64 = 5.0;

/// Accuracy of the distance of a pass [mm], with room.
pub(in crate::job) const ACCURACY: f64 = 4e-3;

/// Difference of two distances that counts as none [mm].
const AS_NEAR: f64 = 2e-3;

/// Difference of two ways in contact that counts as none [mm].
const AS_LONG: f64 = 0.02;

/// The block of the tool change behind which a move begins.
fn changed_before(trace: &Trace, watched: u32) -> Option<u32> {
    let next = watched as usize;
    let from = trace.stands.partition_point(|stand| stand.next < next);
    let mut here = trace.stands[from..].iter().take_while(|stand| stand.next == next);
    here.find(|stand| matches!(stand.kind, StandKind::Change(_))).map(|stand| stand.item)
}

/// A length in hundredths of a millimetre.
fn hundredths(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}
