//! The path of a roughing level, and the figures of roughing and finishing as in the tables of the paper.

use std::f64::consts::{PI, TAU};

use super::clearing::Cleared;
use super::lead::Lead;
use super::levels::Level;
use super::toolpath::Toolpath;
use crate::base::Result;
use crate::geom::{InvoluteRecord, PlaneCurve};

/// Figures of a pass, as in the tables of the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct PassFigures {
    /// Radius of the path at the wall, R [mm].
    pub path_radius: f64,
    /// Turns of the clearing, the circle at the wall not counted, or of the lead-in's involute from the centre, n.
    pub turns: f64,
    /// Normal step of neighbouring turns, H [mm].
    pub step: f64,
    /// Base radius of the involute at the wall, r [mm]; zero for other curves.
    pub base_radius: f64,
    /// Radius of the circle where the annular spiral begins [mm]; zero: in the centre or a point.
    pub inner_radius: f64,
    /// Engagement that the strategy keeps [rad], if it keeps one.
    pub engagement: Option<f64>,
    /// Length of the clearing path or lead-in [mm].
    pub length: f64,
    /// Roll angle at the start, phi0 [rad].
    pub roll: f64,
    /// Rotation of the involute, psi [rad].
    pub psi: f64,
    /// Tangent angle at the start, theta0 [rad].
    pub start_angle: f64,
    /// Turns that are really run.
    pub visible_turns: f64,
    /// Jump of the curvature's derivative where the spiral meets the wall circle [1/mm^2].
    pub slope_jump: f64,
    /// The curves as they are run: clearing or lead-in, then the circle; about the bore's centre, at the last level.
    pub curves: Vec<PlaneCurve>,
    /// Heights of the floors, from the top [mm].
    pub floors: Vec<f64>,
}

/// Start of a level of roughing, and the path from there to the wall.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Opening {
    /// The point in which the cutter comes down, for a counter-clockwise path [mm].
    pub(super) point: [f64; 2],
    /// The way from there to the wall.
    pub(super) curves: Vec<PlaneCurve>,
    /// Radius of the circle on which the clearing begins [mm]; zero: in the centre or a point.
    pub(super) inner_radius: f64,
    /// Base radius of the involute at the wall [mm]; zero for other strategies.
    pub(super) base_radius: f64,
    /// Turns that the path would have from the centre or the inner circle.
    pub(super) turns: f64,
    /// Largest normal step [mm].
    pub(super) step: f64,
    /// Engagement kept [rad], where one is.
    pub(super) engagement: Option<f64>,
    /// Turns of the start's involute before the start [rad]: the paper's phi0; zero from the centre.
    pub(super) roll: f64,
    /// Tangent angle at the wall [rad].
    pub(super) psi: f64,
    /// Turns of the path.
    pub(super) visible_turns: f64,
}

impl Opening {
    /// A way that begins on a circle about the centre, at tangent angle `psi`.
    pub(super) fn on_circle(curves: Vec<PlaneCurve>, inner: f64, turns: f64, step: f64, psi: f64) -> Opening {
        Opening {
            point: curves.first().map_or([0.0, 0.0], |c| c.start().to_array()),
            inner_radius: inner,
            base_radius: 0.0,
            turns,
            step,
            engagement: None,
            roll: 0.0,
            psi,
            visible_turns: turns,
            curves,
        }
    }

    /// A cleared disc whose path touches the wall at tangent angle `psi` [rad].
    pub(super) fn of(cleared: Cleared, psi: f64) -> Opening {
        let base_radius = match cleared.curves.last() {
            Some(PlaneCurve::Record(record)) => record.base_radius(),
            _ => 0.0,
        };
        Opening {
            base_radius,
            engagement: cleared.engagement,
            ..Opening::on_circle(cleared.curves, cleared.inner, cleared.turns, cleared.step, psi)
        }
    }
}

/// A core that comes loose and has to be taken out before the program goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slug {
    /// Its diameter [mm].
    pub diameter: f64,
    /// Index of the move before which it is taken out; the tool is on the safe plane then.
    pub before: usize,
}

impl PassFigures {
    /// Of a roughed level.
    pub(super) fn of(
        toolpath: &Toolpath,
        opening: Opening,
        radius: f64,
        levels: &[Level],
    ) -> Result<PassFigures> {
        let curves = opening.curves;
        let figures = PassFigures {
            path_radius: radius,
            turns: opening.turns,
            step: opening.step,
            base_radius: opening.base_radius,
            inner_radius: opening.inner_radius,
            engagement: opening.engagement,
            length: curves.iter().map(PlaneCurve::length).sum(),
            roll: opening.roll,
            psi: opening.psi,
            start_angle: 0.0,
            visible_turns: opening.visible_turns,
            slope_jump: opening.base_radius / radius.powi(3),
            curves,
            floors: levels.iter().map(|l| l.floor).collect(),
        };
        figures.placed(toolpath)
    }

    /// Of a finished level.
    pub(super) fn of_lead(
        toolpath: &Toolpath,
        lead: Lead,
        turns: u32,
        radius: f64,
        levels: &[Level],
    ) -> Result<PassFigures> {
        let opening = Opening {
            base_radius: lead.base_radius,
            roll: lead.roll,
            visible_turns: lead.turns,
            ..Opening::on_circle(lead.curves, 0.0, f64::from(turns), TAU * lead.base_radius, lead.psi)
        };
        PassFigures::of(toolpath, opening, radius, levels)
    }

    /// With the circle, and as it is run.
    fn placed(mut self, toolpath: &Toolpath) -> Result<PassFigures> {
        self.curves.push(InvoluteRecord::circle(self.path_radius, self.psi)?.into());
        self.curves = self.curves.iter().map(|c| toolpath.turned(c)).collect();
        if toolpath.is_clockwise() {
            self.psi = PI - self.psi;
        }
        self.start_angle = self.curves[0].at(0.0).angle;
        Ok(self)
    }
}
