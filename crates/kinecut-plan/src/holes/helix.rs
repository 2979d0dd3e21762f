//! A helix into the material with a level foot: whole turns at one slope, a turn on which the slope fades out with
//! three common derivatives at both its ends, and a flat circle.
//!
//! The usual helix that meets its flat circle at full slope has a kink of `atan(P / 2 pi R)` there, in which the
//! machine stops or shakes.

use std::f64::consts::TAU;

use super::spec::CutterData;
use super::toolpath::{Toolpath, ToolpathRole};
use crate::base::{Code, CountBound, Finding, Result};
use crate::geom::{LensOrder, Rise, RiseShape, Spiral, Support};

/// Slack of the turns: a fall of exactly three pitches is three turns.
const TURN_SLACK: f64 = 1e-9;

/// Turns of a helix: beyond it the pitch was given in the wrong unit.
const TURNS: CountBound = CountBound {
    what: "turns of a helix",
    most: 10_000.0,
    bytes: 1000,
    code: Code::PLAN_VALUE,
    help: "use a larger pitch",
};

/// A helix: where it lies and how fast it is run.
pub(super) struct Helix {
    pub(super) role: ToolpathRole,
    /// Feed on the slope and on the flat circle [mm/s].
    pub(super) feeds: [f64; 2],
    pub(super) radius: f64,
    /// Tangent angle at which it starts and ends [rad].
    pub(super) psi: f64,
    /// Largest descent of a turn [mm].
    pub(super) pitch: f64,
}

impl Helix {
    /// Down from the present height to a floor, in whole turns, and once round on it.
    pub(super) fn run(&self, toolpath: &mut Toolpath, floor: f64) -> Result<()> {
        let fall = toolpath.height() - floor;
        // The fading turn falls by half a pitch.
        let turns = (fall / self.pitch - 0.5 - TURN_SLACK).ceil().clamp(0.0, f64::INFINITY);
        TURNS.check(turns)?;
        let pitch = fall / (turns + 0.5);
        let [slope, flat] = self.feeds;
        if turns > 0.0 {
            toolpath.around(self.role, slope, self.radius, self.psi, TAU * turns, -pitch * turns)?;
        }
        let law = Support::Lens { inner: self.radius, base_radius: 0.0, order: LensOrder::Zero };
        let turn = Spiral::new(law.into(), self.psi, self.psi + TAU)?;
        let left = floor - toolpath.height();
        toolpath.along_rising(self.role, slope, &turn.into(), Rise::new(RiseShape::FadeOut, left));
        toolpath.settle(self.radius, self.psi, floor);
        toolpath.circle(ToolpathRole::Circle, flat, self.radius, self.psi)
    }
}

/// Whether the cutter follows a helix of this radius and pitch [mm].
///
/// # Errors
/// `KC0403` with the slope and the bound.
pub(super) fn follows(cutter: &CutterData, radius: f64, pitch: f64) -> Result<()> {
    if !(pitch > 0.0 && pitch.is_finite()) {
        return Err(Finding::error(Code::ENTRY_IMPOSSIBLE, "the pitch of the entry helix must be positive")
            .value_mm(pitch)
            .bound_mm(0.0)
            .key("entry.pitch")
            .into());
    }
    let slope = (pitch / (TAU * radius)).atan();
    match cutter.max_ramp_angle {
        Some(most) if slope > most => Err(Finding::error(
            Code::ENTRY_IMPOSSIBLE,
            "the entry helix is steeper than the cutter can follow",
        )
        .value(slope.to_degrees(), "deg")
        .bound(most.to_degrees(), "deg")
        .help(format!("use a pitch of at most {:.3} mm, or a larger radius", TAU * radius * most.tan()))
        .key("entry.pitch")
        .into()),
        _ => Ok(()),
    }
}
