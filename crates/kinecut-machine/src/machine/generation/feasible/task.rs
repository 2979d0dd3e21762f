//! Task of a tool: the places of its frame over the two variables of a surface.

use glam::DVec3;

use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;
use crate::machine::generation::FrameMotion;

/// The part of the tool's frame that matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// Only the tip: a point tool.
    Point,
    /// The tip and the direction of the axis: a tool of revolution, which may spin.
    Axis,
    /// All of it: a turning or planing edge, a form tool, a die.
    Frame,
}

impl Hold {
    /// Number of conditions; the first three are on the tip.
    pub fn conditions(self) -> usize {
        match self {
            Hold::Point => 3,
            Hold::Axis => 5,
            Hold::Frame => 6,
        }
    }
}

/// A motion of a tool relative to the work, for which a machine is asked.
pub struct Task<'a> {
    /// Frame in the work that the tool's frame must take, over the variables.
    pub motion: &'a dyn FrameMotion,
    /// Ranges of the variables; a motion of one variable, or of none, has ranges of no length.
    pub domain: [[f64; 2]; 2],
    /// Names of the variables.
    pub names: [String; 2],
    /// The part of the frame that matters.
    pub hold: Hold,
    /// Mounting of the tool: maps the tip frame of the machine's tool into the frame of `motion`. Its Z is the axis of
    /// a tool of revolution.
    pub mount: Rigid,
    /// The point of the tip frame that has to be in place [mm]: zero for the tip itself, elsewhere for a point tool that
    /// is ground with an overhang.
    pub control: DVec3,
}

impl std::fmt::Debug for Task<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Task").field("names", &self.names).field("hold", &self.hold).finish_non_exhaustive()
    }
}

impl<'a> Task<'a> {
    /// A task for a tool that is mounted as the frame of the motion lies, with its tip as the point that counts.
    pub fn new(motion: &'a dyn FrameMotion, domain: [[f64; 2]; 2], names: [&str; 2], hold: Hold) -> Task<'a> {
        let names = names.map(str::to_owned);
        Task { motion, domain, names, hold, mount: Rigid::IDENTITY, control: DVec3::ZERO }
    }

    /// Wanted frame of the machine's tool at values of the variables, with its origin in the point that counts.
    pub fn pose(&self, u: [f64; 2]) -> Rigid {
        self.motion.pose(u).after(&self.mount).after(&Rigid::from_translation(self.control))
    }

    /// Checks the ranges, and poses at their ends.
    ///
    /// # Errors
    /// `KC1131` for a range that is reversed or a pose that is not finite.
    pub fn check(&self) -> Result<()> {
        for ([from, to], name) in self.domain.iter().zip(&self.names) {
            if !(from.is_finite() && to.is_finite() && from <= to) {
                return Err(Finding::error(
                    Code::GENERATION_INPUT,
                    format!("the range of {name} is reversed or not finite"),
                )
                .value(*from, "")
                .bound(*to, "")
                .help("give the lower end first")
                .into());
            }
        }
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let pose = self.pose([self.domain[0][i], self.domain[1][j]]);
            let whole = pose.rotation.transpose() * pose.rotation;
            let turned = whole.abs_diff_eq(glam::DMat3::IDENTITY, RIGID) && pose.rotation.determinant() > 0.0;
            if !(pose.translation.is_finite() && turned) {
                return Err(Finding::error(
                    Code::GENERATION_INPUT,
                    "the motion of the tool is not a rigid motion with finite numbers",
                )
                .value(self.domain[0][i], "")
                .help("choose parameters and ranges for which the laws have values")
                .into());
            }
        }
        Ok(())
    }
}

/// Motion that is missing to a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Miss {
    /// From the tip to where it should be [mm].
    pub(super) shift: DVec3,
    /// Rotation that would bring the tool into its direction or frame [rad].
    pub(super) turn: DVec3,
}

impl Hold {
    /// Motion that is missing from frame `at` to frame `to`.
    pub(super) fn miss(self, at: &Rigid, to: &Rigid) -> Miss {
        let shift = to.translation - at.translation;
        let turn = match self {
            Hold::Point => DVec3::ZERO,
            Hold::Axis => between(at.rotation.z_axis, to.rotation.z_axis, at.rotation.x_axis),
            Hold::Frame => {
                let d = to.rotation * at.rotation.transpose();
                let w = DVec3::new(d.y_axis.z - d.z_axis.y, d.z_axis.x - d.x_axis.z, d.x_axis.y - d.y_axis.x)
                    / 2.0;
                let trace = d.x_axis.x + d.y_axis.y + d.z_axis.z;
                let angle = w.length().atan2((trace - 1.0) / 2.0);
                match w.try_normalize() {
                    Some(axis) => axis * angle,
                    // Half a turn: about whichever axis stays, here about the tool's own X or Y or Z.
                    None if trace < 0.0 => half_turn(&d) * std::f64::consts::PI,
                    None => DVec3::ZERO,
                }
            }
        };
        Miss { shift, turn }
    }
}

/// The rotation that brings `a` to `b`, both unit vectors, the shortest way; opposite ones turn about `spare`.
fn between(a: DVec3, b: DVec3, spare: DVec3) -> DVec3 {
    let cross = a.cross(b);
    let angle = cross.length().atan2(a.dot(b));
    match cross.try_normalize() {
        Some(axis) => axis * angle,
        None if a.dot(b) < 0.0 => spare * std::f64::consts::PI,
        None => DVec3::ZERO,
    }
}

/// Axis of a half-turn: the longest column of `d + 1`.
fn half_turn(d: &glam::DMat3) -> DVec3 {
    let m = *d + glam::DMat3::IDENTITY;
    let longest = [m.x_axis, m.y_axis, m.z_axis].into_iter().max_by(|a, b| a.length().total_cmp(&b.length()));
    longest.and_then(DVec3::try_normalize).unwrap_or(DVec3::X)
}

impl Miss {
    /// Size with angles weighted by `arm` [mm].
    pub(super) fn size(&self, arm: f64) -> f64 {
        self.shift.length().hypot(self.turn.length() * arm)
    }
}

/// Largest difference of a matrix from a rotation: rounding of a chain of motions.
const RIGID: f64 = 1e-9;
