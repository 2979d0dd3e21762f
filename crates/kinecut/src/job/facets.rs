//! A finding where facets, not the limits of the axes, set the time of a program.

use crate::base::{Code, Finding};
use crate::machine::Machine;
use crate::motion::{ProgramTime, facets};
use crate::page;
use crate::trace::Trace;

/// A note where short straight moves in place of curves take a quarter longer than the curves would, and that is a second and
/// a fiftieth of the whole time at least; at the item that loses most.
pub(crate) fn facets_note(trace: &Trace, time: &ProgramTime, machine: &Machine) -> Option<Finding> {
    const LONGER: f64 = 1.25;
    const SHARE: f64 = 0.02;
    let found = facets(trace, time, machine)?;
    let lost = found.time - found.smooth;
    if !(found.time > LONGER * found.smooth && lost > (SHARE * time.total()).max(1.0)) {
        return None;
    }
    // Rounded up to a micrometre: a curve within it exists.
    let off = page::fixed((found.farthest * 1e3).ceil() / 1e3, 3);
    let what = format!(
        "straight moves in place of curves set the time, not the limits of the axes: {} of them take {}, smooth curves through \
         the same points {}; here most is lost",
        found.moves,
        page::duration(found.time),
        page::duration(found.smooth)
    );
    let finding = Finding::note(Code::FACETS, what).item(trace.segments[found.slowest].item);
    Some(finding.help(format!(
        "post arcs or curves within {off} mm of the points, or give the control a wider tolerance (`G64 P`, `CYCLE832`, cycle 32)"
    )))
}
