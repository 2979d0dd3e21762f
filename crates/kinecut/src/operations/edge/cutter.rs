//! Cutters that break an edge: wide enough, with the tip off the floor.

use crate::base::bounded::{MAX_LENGTH, length, positive};
use crate::base::{Code, Finding, Result};
use crate::contouring::{BallBreak, Chamfer};
use crate::page::trimmed;
use crate::tool::Tool;

/// Share of the tool's diameter that the tip lies below the chamfer where the job does not say.
const CLEAR: f64 = 0.1;
/// Least and greatest depth of the tip below the chamfer where the job does not say; the first also where it does [mm].
const TIP: [f64; 2] = [0.2, 0.5];
/// Radius of the cutter that stays beyond the edge [mm].
const BEYOND: f64 = 0.1;
/// Length that is rounding [mm].
const ROUNDING: f64 = 1e-9;

/// The chamfer of a V cutter, for which the tool is wide enough and the wall high enough; lengths as the table gives them.
///
/// # Errors
/// `KC0103` for numbers that make no sense, `KC0404` where the tool or the wall is too small.
pub(crate) fn v_cutter(
    tool: &Tool,
    (tip_diameter, half_angle): (f64, f64),
    width: f64,
    tip_clearance: Option<f64>,
    wall_height: Option<f64>,
) -> Result<Chamfer> {
    let diameter = tool.cutter.diameter(tool.flute_length);
    let [least, most] = TIP;
    let usual = (CLEAR * diameter).clamp(least, most);
    let tip_clearance = length("tip_clearance", tip_clearance.unwrap_or(usual), least, MAX_LENGTH)?;
    let width = positive("width", width, MAX_LENGTH, "mm")?;
    let chamfer = Chamfer { width, half_angle, tip_diameter, tip_clearance };
    let (needed, given) = (chamfer.top_radius(), 0.5 * diameter);
    if needed > given - BEYOND + ROUNDING {
        let what = format!("the chamfer needs more radius of the cutter than {} has", tool.number);
        let widest = given - BEYOND - chamfer.offset();
        let help = match widest > 0.0 {
            true => format!("write width = {} at most, or a smaller tip_clearance", floored(widest)),
            false => "write a smaller tip_clearance, or take a larger cutter".to_owned(),
        };
        let finding = Finding::error(Code::PLAN_VALUE, what).value_mm(rounded(needed));
        return Err(finding.bound_mm(rounded(given - BEYOND)).help(help).key("width").into());
    }
    if let Some(wall) = wall_height {
        let wall = positive("wall_height", wall, MAX_LENGTH, "mm")?;
        if chamfer.depth() > wall + ROUNDING {
            let what = "the V cutter's tip would touch the floor below the edge";
            let [clearance, widest] = [wall - chamfer.leg(), (wall - least) * half_angle.tan()];
            let (key, help) = if clearance >= least - ROUNDING {
                let fits = floored(clearance);
                (
                    "tip_clearance",
                    format!("largest here: tip_clearance = {fits} with width = {}", trimmed(width, 4)),
                )
            } else if widest > 0.0 {
                ("width", format!("largest here: width = {} with tip_clearance = {least}", floored(widest)))
            } else {
                ("wall_height", format!("the tip needs {least} mm: take another cutter"))
            };
            let finding = Finding::error(Code::PLAN_VALUE, what).value_mm(rounded(chamfer.depth()));
            return Err(finding.bound_mm(wall).help(help).key(key).into());
        }
    }
    Ok(chamfer)
}

/// The break by a ball of a diameter [mm], whose tip stays off the floor.
///
/// # Errors
/// `KC0103` for numbers that make no sense, `KC0404` where the break is too wide for the ball or the wall too low.
pub(crate) fn ball(diameter: f64, width: f64, wall_height: Option<f64>) -> Result<BallBreak> {
    /// Largest width, in radii of the ball: beyond it the break is no flat any more.
    const WIDEST: f64 = 0.5;
    let width = positive("width", width, MAX_LENGTH, "mm")?;
    let ball = BallBreak { radius: 0.5 * diameter, width };
    let widest = WIDEST * ball.radius;
    if width > widest + ROUNDING {
        let finding = Finding::error(Code::PLAN_VALUE, "the break is too wide for this ball").value_mm(width);
        let help = format!("write width = {} at most, or take a larger ball or a V cutter", floored(widest));
        return Err(finding.bound_mm(rounded(widest)).help(help).key("width").into());
    }
    if let Some(wall) = wall_height {
        let wall = positive("wall_height", wall, MAX_LENGTH, "mm")?;
        if ball.depth() > wall + ROUNDING {
            let what = "the ball would touch the floor below the edge";
            let finding = Finding::error(Code::PLAN_VALUE, what).value_mm(rounded(ball.depth()));
            let help = "take a smaller ball, or a V cutter";
            return Err(finding.bound_mm(wall).help(help).key("tool").into());
        }
    }
    Ok(ball)
}

/// A length as messages show it [mm].
fn rounded(mm: f64) -> f64 {
    (mm * 1e4).round() / 1e4
}

/// A largest length in words, that still fits as written [mm].
fn floored(mm: f64) -> String {
    trimmed(((mm + ROUNDING) * 1e3).floor() / 1e3, 3)
}
