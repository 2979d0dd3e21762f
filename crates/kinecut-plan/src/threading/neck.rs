//! Parts of the tool above its teeth that go into the hole, or beside the boss.

use super::thread::shown;
use super::{ThreadMillSpec, ThreadSide};
use crate::base::{Code, Finding, Result};

/// Way between wall and neck [mm].
const CLEAR: f64 = 0.05;

/// Whether neck, shank and holder clear the material at full depth.
///
/// # Errors
/// `KC0412` with the part, its diameter and what is needed.
pub(super) fn check(spec: &ThreadMillSpec, radii: [f64; 2]) -> Result<()> {
    let deep = spec.top - spec.lowest();
    let thread = &spec.thread;
    let [low, high] = if radii[0] < radii[1] { radii } else { [radii[1], radii[0]] };
    for (name, diameter, from) in spec.cutter.above() {
        if from >= deep {
            continue;
        }
        let widest = match spec.side {
            ThreadSide::Inside => {
                thread.minor_diameter() + 2.0 * thread.widening(spec.side, spec.depth) - 2.0 * (high + CLEAR)
            }
            ThreadSide::Outside => {
                2.0 * (low - CLEAR) - thread.diameter - 2.0 * thread.widening(spec.side, spec.depth)
            }
        };
        if diameter > widest {
            let (what, beside) = match spec.side {
                ThreadSide::Inside => ("meets the wall of the hole", "in the hole"),
                ThreadSide::Outside => ("meets the boss", "beside the boss"),
            };
            let message = format!(
                "the {name} of {} mm {what}: the tool goes {} deep, and its teeth end {} above its tip",
                shown(diameter),
                shown(deep),
                shown(from)
            );
            let help = if widest > 0.0 {
                let widest = shown((widest * 1e3).floor() / 1e3);
                format!(
                    "{beside} it may have {widest}: take a tool with more rows or a longer neck, and say it with neck_diameter and neck_length"
                )
            } else {
                "take a smaller tool".to_owned()
            };
            let finding = Finding::error(Code::THREAD_TOOL, message).value_mm(diameter).bound_mm(widest);
            return Err(finding.help(help).key("tool").into());
        }
    }
    let stickout = spec.cutter.stickout;
    if stickout < deep {
        let message = "the tool is too short for the depth: its holder would come below the top";
        let finding = Finding::error(Code::THREAD_TOOL, message).value_mm(stickout).bound_mm(deep);
        return Err(finding.help("clamp it longer, or mill less thread").key("depth").into());
    }
    Ok(())
}
