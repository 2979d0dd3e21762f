//! The core hole of a thread: which of the holes that are there it is, and whether the tap fits it.

use super::TapOperation;
use crate::base::{Code, Finding, Result};
use crate::operations::RoundHole;
use crate::operations::core_hole::{Core, SAME_HEIGHT};

/// Way that stays free below the tap where a core hole is blind, in pitches.
const FREE: f64 = 1.0;
/// The core hole at a place, checked; a warning comes with it where a maker's data have the last word.
///
/// # Errors
/// `KC0907` where there is none, or the tap does not fit it.
pub(super) fn core(of: &TapOperation, at: [f64; 2], holes: &[RoundHole]) -> Result<(Core, Option<Finding>)> {
    let Some(core) = Core::find(of.table.core, at, [of.table.top, of.tap.pitch], holes) else {
        let finding = Finding::error(Code::TAP_CORE, format!("{}: there is no core hole", place(of, at)));
        let drill = short(of.tap.core_diameter());
        return Err(finding
            .help(format!("drill {drill} before it; where the hole is there already, say core = {{ diameter = {drill} }}"))
            .into());
    };
    if core.diameter >= of.tap.diameter {
        let finding =
            Finding::error(Code::TAP_CORE, format!("{}: the core hole leaves no thread", place(of, at)));
        let finding = finding.value_mm(core.diameter).bound_mm(of.tap.diameter);
        return Err(finding.help("below a counterbore, say its floor as `top`").into());
    }
    let doubt = diameter(of, at, &core)?;
    depth(of, at, &core)?;
    Ok((core, doubt))
}

fn diameter(of: &TapOperation, at: [f64; 2], core: &Core) -> Result<Option<Finding>> {
    let Some(bound) = of.tap.core_misfit(core.diameter) else { return Ok(None) };
    let (word, then) = match (core.diameter < bound, of.tap.forming) {
        (true, false) => ("smallest", "the tap breaks"),
        (true, true) => ("smallest", "the thread is pressed over its minor diameter"),
        (false, false) => ("largest", "the thread is too shallow for class 6H"),
        (false, true) => ("largest", "the thread is not formed to its minor diameter"),
    };
    let message = format!(
        "{}: the core hole is {}, the {word} is {}: {then}",
        place(of, at),
        short(core.diameter),
        short(bound)
    );
    let finding = if of.tap.forming {
        Finding::warning(Code::TAP_CORE, message).help("hold it against the maker's data for this tap")
    } else {
        let drill = short(of.tap.core_diameter());
        Finding::error(Code::TAP_CORE, message).help(format!("drill {drill}"))
    };
    let finding = finding.value_mm(core.diameter).bound_mm(bound);
    if of.tap.forming { Ok(Some(finding)) } else { Err(finding.into()) }
}

fn depth(of: &TapOperation, at: [f64; 2], core: &Core) -> Result<()> {
    let (tap, t) = (&of.tap, &of.table);
    let (free, deep) = (FREE * tap.pitch, t.top - core.bottom);
    let wanted = of.depth + tap.below_thread() + free;
    if core.through || deep >= wanted - SAME_HEIGHT {
        return Ok(());
    }
    let tip = if tap.tip > 0.0 { format!(" + {} (point)", short(tap.tip)) } else { String::new() };
    let message = format!(
        "{}: the core hole is {} deep to its full diameter, the tap needs {} + {} (lead){tip} + {} (free)",
        place(of, at),
        short(deep),
        short(of.depth),
        short(tap.lead * tap.pitch),
        short(free)
    );
    let drill = (wanted * 10.0 - 1e-6).ceil() / 10.0;
    Err(Finding::error(Code::TAP_CORE, message)
        .value_mm(deep)
        .bound_mm(wanted)
        .help(format!("drill to {drill}, or ask for less thread"))
        .into())
}

/// The thread and its place, for a message.
fn place(of: &TapOperation, [x, y]: [f64; 2]) -> String {
    format!("{} at X{} Y{}", of.thread(), short(x), short(y))
}

/// A number with the digits that it needs, at most three decimals.
pub(super) fn short(value: f64) -> String {
    format!("{}", (value * 1e3).round() / 1e3 + 0.0)
}
