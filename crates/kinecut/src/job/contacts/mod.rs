//! Contacts while a program runs: tools past clamps and fixtures, and all that the machine moves.

pub(super) mod fixtures;
pub(super) mod machine;
pub(super) mod noun;
pub(super) mod stock_at;

use super::check::{Job, JobSetup, Uncertainty};
use crate::base::{Code, Finding};
use crate::contact::{Body, Contact, MachineMove, Watched};
use crate::geom::Solid;
use crate::trace::{StandKind, Trace};

/// Moves that are watched at once: their motions take some hundred bytes each.
const AT_ONCE: usize = 1 << 18;

/// Memory of the bodies that are watched in one setup at most, and of its moves [bytes].
pub(in crate::job) fn memory(job: &Job, traces: &[&Trace]) -> u64 {
    let bodies = |solids: &mut dyn Iterator<Item = &Solid>| solids.map(Body::memory).sum::<u64>();
    let of_setup = |(own, trace): (&JobSetup, &&Trace)| {
        let setup = &own.setup;
        let moves = trace.segments.len() as u64;
        let at_once = moves.min(AT_ONCE as u64);
        let fixtures = bodies(&mut setup.fixtures.iter().map(|fixture| &*fixture.solid));
        let tool = if setup.fixtures.is_empty() { 0 } else { fixtures + at_once * Watched::BYTES };
        let machine = job.machine.as_ref().filter(|m| !m.bodies.is_empty() && setup.located);
        let machine = machine.map_or(0, |machine| {
            let all = bodies(&mut machine.bodies.iter().map(|body| &body.solid)) + Body::memory(&job.stock);
            // All moves with their numbers, and some once more.
            fixtures
                + all
                + stock_at::memory(job)
                + (moves + at_once) * (MachineMove::BYTES + size_of::<u64>() as u64)
        });
        // One after the other.
        tool.max(machine)
    };
    job.setups.iter().zip(traces).map(of_setup).max().unwrap_or(0)
}

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

/// Whether a contact says more than another one, each with its way and its distance [mm]: a certain one more than one that may be; of two
/// certain ones the longer, of others the nearer.
fn is_worse(
    (one, way, distance): (Option<Contact>, f64, f64),
    (other, known, nearest): (Option<Contact>, f64, f64),
) -> bool {
    let certain = |contact: Option<Contact>| contact.is_some_and(|c| c.certain);
    match (certain(one), certain(other)) {
        (true, false) => true,
        (false, true) => false,
        (true, true) => way > known + AS_LONG,
        (false, false) => distance < nearest - AS_NEAR,
    }
}

/// The doubt about bodies that pass nearer than they may be off; `message` is that of a contact.
fn may_meet(code: Code, message: &str, distance: f64, off: Option<Uncertainty>) -> Finding {
    // Not farther than they are.
    let apart = ((distance - ACCURACY).max(0.0) * 100.0).floor() / 100.0;
    Finding::doubt(code, off.unwrap_or_default().possible(message)).value(apart, "mm apart")
}

/// A length in hundredths of a millimetre.
fn hundredths(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}
