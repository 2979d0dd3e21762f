//! The load of a tap, which the stock does not show: the thread is not simulated.

use super::super::setup_outcome::SetupOutcome;
use crate::cutting::{CuttingForce, CuttingLoad, TappingCut};
use crate::tool::{Cutter, Tool};
use crate::trace::Segment;

/// The load of a tap that cuts, on its way in; `None` of other tools and ways, of taps that form, and where the speed is not known.
/// Right within [`TAPPING_SPREAD`](crate::cutting::TAPPING_SPREAD), with all of the lead in a full thread.
pub(crate) fn tapped(
    tools: &[Tool],
    force: CuttingForce,
    done: &SetupOutcome,
    segment: &Segment,
) -> Option<CuttingLoad> {
    let tool = tools.iter().find(|t| Some(t.number) == segment.tool)?;
    let Cutter::Tap(ref tap) = tool.cutter else { return None };
    let speed = done.program.state(segment.item as usize).spindle.rate();
    let goes_in = (segment.curve.end() - segment.curve.start()).dot(segment.axis) < 0.0;
    if tap.forming || !goes_in || !(speed > 0.0) {
        return None;
    }
    let cut =
        TappingCut { diameter: tap.diameter, pitch: tap.pitch, flutes: tool.teeth, lead: tap.lead, speed };
    Some(cut.load(&force))
}
