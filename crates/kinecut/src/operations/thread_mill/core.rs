//! The core hole of a milled thread: whether it is there, has the minor diameter, and is deep enough.

use super::ThreadMillOperation;
use crate::base::{Code, Finding, Result};
use crate::operations::RoundHole;
use crate::operations::core_hole::{Core, SAME_HEIGHT};
use crate::page::trimmed;
use crate::threading::{ThreadForm, ThreadMillSpec, ThreadSide};
use crate::tool::Tap;

/// Diameter that is rounding of drills and bores [mm].
const ROUNDING: f64 = 0.01;
/// Way that stays free below the tool where the hole is blind, in pitches.
const FREE: f64 = 0.25;

/// The core hole at a place, if it is known; a warning comes with it where it is not, or is wide.
///
/// # Errors
/// `KC0413` where it leaves no thread, or is too narrow or too short.
pub(super) fn core(
    of: &ThreadMillOperation,
    spec: &ThreadMillSpec,
    at: [f64; 2],
    holes: &[RoundHole],
) -> Result<(Option<Core>, Option<Finding>)> {
    let minor = spec.thread.minor_diameter() + 2.0 * spec.thread.widening(spec.side, spec.depth);
    let shown = |mm: f64| trimmed(mm, 3);
    let found = |what: String| Finding::error(Code::THREAD_CORE, format!("{}: {what}", of.at(at)));
    let Some(core) = Core::find(of.table.core, at, [of.table.top, of.thread.pitch], holes) else {
        let message = format!("{}: no core hole is known here", of.at(at));
        let help = format!(
            "bore {0} before it; where the hole is there already, say core = {{ diameter = {0} }}",
            shown(minor)
        );
        return Ok((None, Some(Finding::warning(Code::THREAD_CORE, message).help(help))));
    };
    if core.diameter >= spec.thread.diameter {
        let finding = found("the core hole leaves no thread".to_owned());
        let finding = finding.value_mm(core.diameter).bound_mm(spec.thread.diameter);
        return Err(finding.help("below a counterbore, say its floor as `top`").into());
    }
    if core.diameter < minor - ROUNDING {
        let what = format!(
            "the core hole is {}, the thread needs {}: the roots of the teeth would cut",
            shown(core.diameter),
            shown(minor)
        );
        let finding = found(what).value_mm(core.diameter).bound_mm(minor);
        return Err(finding.help(format!("bore {}", shown(minor))).into());
    }
    let deep = of.table.top - core.bottom;
    let free = FREE * of.thread.pitch;
    let wanted = of.table.top - spec.lowest() + free;
    if !core.through && deep < wanted - SAME_HEIGHT {
        let below = wanted - of.depth - free;
        let what = format!(
            "the core hole is {} deep to its full diameter, the thread mill needs {} + {} (lowest tooth and way in) + {} (free)",
            shown(deep),
            shown(of.depth),
            shown(below),
            shown(free)
        );
        let to = (wanted * 10.0 - 1e-6).ceil() / 10.0;
        let finding = found(what).value_mm(deep).bound_mm(wanted);
        return Err(finding.help(format!("bore to {}, or ask for less thread", shown(to))).into());
    }
    Ok((Some(core), shallow(of, core, at, minor)))
}

/// A warning about a hole that is wider than class 6H allows, or, where that is not for the thread, than leaves it most of its height
/// at the bottom; `minor`: the minor diameter there [mm].
fn shallow(of: &ThreadMillOperation, core: Core, at: [f64; 2], minor: f64) -> Option<Finding> {
    /// Share of a thread's height that should be left.
    const LEFT: f64 = 0.75;
    let thread = &of.thread;
    if thread.form != ThreadForm::Metric || thread.taper > 0.0 {
        let most = minor + (1.0 - LEFT) * 2.0 * thread.height(ThreadSide::Inside);
        return (core.diameter > most + ROUNDING).then(|| {
            let [hole, shown] = [core.diameter, most].map(|mm| trimmed(mm, 3));
            let bottom = if thread.taper > 0.0 { " at its bottom" } else { "" };
            let message = format!(
                "{}: the core hole is {hole}: more than {shown} leaves less than three quarters of the thread's height{bottom}",
                of.at(at)
            );
            let help = format!("bore {}", trimmed(minor, 3));
            Finding::warning(Code::THREAD_CORE, message).value_mm(core.diameter).bound_mm(most).help(help)
        });
    }
    let tap = Tap { diameter: thread.diameter, pitch: thread.pitch, lead: 1.0, tip: 0.0, forming: false };
    let [_, most] = tap.core_bounds();
    (core.diameter > most + ROUNDING).then(|| {
        let message = format!(
            "{}: the core hole is {}, the largest of class 6H is {}: the thread is too shallow",
            of.at(at),
            trimmed(core.diameter, 3),
            trimmed(most, 3)
        );
        let help = format!("bore {}", trimmed(thread.minor_diameter(), 3));
        Finding::warning(Code::THREAD_CORE, message).value_mm(core.diameter).bound_mm(most).help(help)
    })
}
