//! The numbers of a contour, looked at before it is planned.

use std::f64::consts::FRAC_PI_4;

use super::spec::{ContourSide, ContourSpec};
use super::stretches::loop_length;
use crate::base::bounded::{MAX_LENGTH, length, positive};
use crate::base::{Code, Error, Finding, Result};

/// Fastest feed [mm/s].
const FASTEST: f64 = 1e6 / 60.0;
/// Steepest ramp [rad].
const STEEPEST: f64 = FRAC_PI_4;
/// Most loops of roughing beside one another.
const MOST_LOOPS: u32 = 1000;
/// Depth beyond the flutes that is rounding [mm].
const ROUNDING: f64 = 1e-6;

/// The error of a number that is out of range.
pub(super) fn out_of_range(key: &str, what: &str, value: f64, bound: f64, unit: &str, help: &str) -> Error {
    Finding::error(Code::PLAN_VALUE, what).value(value, unit).bound(bound, unit).help(help).key(key).into()
}

/// Looks at all numbers.
///
/// # Errors
/// `KC0103` for those that are none or not above zero, `KC0403` where the cutter cannot come down, `KC0404` for the rest.
pub(super) fn check(spec: &ContourSpec) -> Result<()> {
    let (finish, tabs) = (spec.finish, spec.tabs.as_ref());
    let lengths = [
        ("depth", Some(spec.depth)),
        ("stepdown", spec.stepdown),
        ("stepover", spec.loops_beside.map(|(_, step)| step)),
        ("tool", Some(spec.cutter.diameter)),
        ("room", spec.room),
        ("lead_radius", spec.lead_radius),
        // What has been cleared by passes in the middle leaves as much as there is.
        ("finish.allowance", finish.map(|f| f.allowance).filter(|a| !(spec.cleared && *a == 0.0))),
        ("finish.stepdown", finish.and_then(|f| f.stepdown)),
        ("finish.wear_largest", finish.and_then(|f| f.wear).map(|w| w.largest)),
        ("tabs.width", tabs.map(|t| t.width)),
        ("tabs.height", tabs.map(|t| t.height)),
    ];
    let feeds = [
        ("feed", Some(spec.feed)),
        ("plunge_feed", Some(spec.plunge_feed)),
        ("finish.feed", finish.map(|f| f.feed)),
    ];
    for (list, most, unit) in [(&lengths[..], MAX_LENGTH, "mm"), (&feeds[..], FASTEST, "mm/s")] {
        for (key, value) in list.iter().filter_map(|(key, value)| value.map(|v| (key, v))) {
            positive(key, value, most, unit)?;
        }
    }
    length("breakthrough", spec.breakthrough, 0.0, MAX_LENGTH)?;
    length("stock_to_leave", spec.stock_to_leave, 0.0, MAX_LENGTH)?;
    length("overlap", spec.overlap.unwrap_or(0.0), 0.0, MAX_LENGTH)?;
    let flutes = spec.cutter.flute_length;
    let steps = [("stepdown", spec.stepdown), ("finish.stepdown", spec.finish.and_then(|f| f.stepdown))];
    for (key, step) in steps {
        if step.is_some_and(|step| step > flutes + ROUNDING) {
            let what = "a level is deeper than the flutes are long";
            return Err(out_of_range(
                key,
                what,
                step.unwrap_or(0.0),
                flutes,
                "mm",
                "take a smaller step, or a longer tool",
            ));
        }
    }
    if let Some((count, step)) = spec.loops_beside {
        if step > spec.cutter.diameter {
            let what = "loops beside one another leave stock between them";
            let help = "write a stepover of the cutter's diameter at most";
            return Err(out_of_range("stepover", what, step, spec.cutter.diameter, "mm", help));
        }
        if !(1..=MOST_LOOPS).contains(&count) {
            let what = "the number of loops is out of range";
            let most = f64::from(MOST_LOOPS);
            return Err(out_of_range("passes", what, f64::from(count), most, "", "write a number from 1 on"));
        }
        if spec.side == ContourSide::On {
            let finding = Finding::error(Code::PLAN_VALUE, "a contour on its line has nothing beside it");
            return Err(finding
                .help("leave out `stepover` and `passes`, or give a side")
                .key("passes")
                .into());
        }
    }
    if spec.side == ContourSide::On && spec.finish.is_some() {
        let finding =
            Finding::error(Code::PLAN_VALUE, "a contour on its line has no wall that could be finished");
        return Err(finding.help("leave out `finish`, or give a side").key("finish").into());
    }
    if let Some(tabs) = &spec.tabs
        && tabs.height >= spec.depth
    {
        let what = "tabs are as high as the contour is deep";
        return Err(out_of_range(
            "tabs.height",
            what,
            tabs.height,
            spec.depth,
            "mm",
            "write a smaller height",
        ));
    }
    pieces(spec)?;
    lines(spec)?;
    let Some(ramp) = spec.ramp else {
        if spec.cutter.centre_cutting || spec.cleared || spec.clear_ends {
            return Ok(());
        }
        let finding =
            Finding::error(Code::ENTRY_IMPOSSIBLE, "the cutter does not cut at its centre and cannot plunge");
        return Err(finding
            .help("leave out `entry`, or give a ramp: entry = { ramp = 3 }")
            .key("entry")
            .into());
    };
    let most = spec.cutter.max_ramp_angle.map_or(STEEPEST, |most| most.min(STEEPEST));
    if !(ramp > 0.0 && ramp <= most + 1e-9) {
        let (ramp, most) = (ramp.to_degrees(), most.to_degrees());
        let what = "the ramp is steeper than the cutter can follow, or none";
        return Err(out_of_range("entry.ramp", what, ramp, most, "deg", "write a flatter ramp, above 0"));
    }
    Ok(())
}

/// Looks whether the side is one of the outline: closed loops have an outside and an inside, open lines a left and a right.
fn lines(spec: &ContourSpec) -> Result<()> {
    let beside_line = matches!(spec.side, ContourSide::Left | ContourSide::Right);
    let beside_face = matches!(spec.side, ContourSide::Outside | ContourSide::Inside);
    let (what, help) = match spec.outline.is_of_lines() {
        true if beside_face => (
            "an open line has no outside and no inside",
            "write side = \"left\" or \"right\" of its direction",
        ),
        false if beside_line => {
            ("a closed loop has no left and no right", "write side = \"outside\" or \"inside\"")
        }
        true if spec.tabs.is_some() => {
            let finding = Finding::error(Code::PLAN_VALUE, "a contour along an open line cuts nothing loose");
            return Err(finding.help("leave out `tabs`").key("tabs").into());
        }
        _ => return Ok(()),
    };
    Err(Finding::error(Code::PLAN_VALUE, what).help(help).key("side").into())
}

/// Looks at pieces of the outline.
fn pieces(spec: &ContourSpec) -> Result<()> {
    let Some(pieces) = &spec.pieces else { return Ok(()) };
    if spec.ramp.is_some() || spec.finish.is_some() || spec.tabs.is_some() {
        let finding =
            Finding::error(Code::PLAN_VALUE, "a contour in pieces has no ramp, no finish and no tabs");
        return Err(finding.help("leave them out, or cut whole loops").into());
    }
    for piece in pieces {
        let (whole, [from, to]) = (loop_length(&spec.outline, piece.of_loop), piece.along);
        let is_piece = from.is_finite() && to > from && to - from <= whole + ROUNDING;
        if !is_piece {
            let what = "a piece of the contour has no length, or is longer than its loop";
            let finding = Finding::error(Code::PLAN_VALUE, what).value_mm(to - from).bound_mm(whole);
            return Err(finding.help("give places along a loop, the second beyond the first").into());
        }
    }
    Ok(())
}
