//! Straight moves of the tool on rotary axes: the error when a control interpolates the axes, and the points between that
//! keep it small.

mod bound;
mod subdivide;

use glam::DVec3;

use super::Kinematics;
use super::inverse::angle;
use crate::machine::JointValues;

pub use subdivide::{LinearMove, LinearOptions, Orientation};

/// Deviation of a move in which all axes move in proportion from the straight move of the tool between its ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearDeviation {
    /// Greatest distance of the tip from where the straight move has it at the same share of the move [mm].
    pub in_step: f64,
    /// Greatest distance of the tip from the straight line [mm].
    pub from_line: f64,
    /// Greatest angle of the tool to its direction on the great circle at the same share of the move [rad].
    pub axis_in_step: f64,
    /// Greatest angle of the tool to the plane through its first and last direction [rad].
    pub from_plane: f64,
}

impl LinearDeviation {
    fn worst(self, other: LinearDeviation) -> LinearDeviation {
        let larger = |a: f64, b: f64| if b > a { b } else { a };
        LinearDeviation {
            in_step: larger(self.in_step, other.in_step),
            from_line: larger(self.from_line, other.from_line),
            axis_in_step: larger(self.axis_in_step, other.axis_in_step),
            from_plane: larger(self.from_plane, other.from_plane),
        }
    }
}

/// Tip and direction between which the tool should move.
#[derive(Clone, Copy)]
struct Straight {
    tips: [DVec3; 2],
    axes: [DVec3; 2],
}

impl Straight {
    fn between(chain: &Kinematics, from: &[f64], to: &[f64]) -> Straight {
        let (from, to) = (chain.forward(from), chain.forward(to));
        Straight {
            tips: [from.translation, to.translation],
            axes: [from.rotation.z_axis, to.rotation.z_axis],
        }
    }

    fn tip(&self, share: f64) -> DVec3 {
        self.tips[0] + (self.tips[1] - self.tips[0]) * share
    }

    /// The direction on the great circle; `None` between opposite directions, where it is not determined.
    fn axis(&self, share: f64) -> Option<DVec3> {
        let [from, to] = self.axes;
        let whole = angle(from, to);
        let side = to - from * from.dot(to);
        match side.try_normalize() {
            Some(side) if whole < std::f64::consts::PI - OPPOSITE => {
                let (sin, cos) = (whole * share).sin_cos();
                Some(from * cos + side * sin)
            }
            None if whole < OPPOSITE => Some(from),
            _ => None,
        }
    }

    /// Deviation of one pose at a share of the move.
    fn deviation(&self, tip: DVec3, axis: DVec3, share: f64) -> LinearDeviation {
        let way = self.tips[1] - self.tips[0];
        let along = (tip - self.tips[0]).dot(way) / way.length_squared();
        let foot = if along.is_finite() { self.tip(along.clamp(0.0, 1.0)) } else { self.tips[0] };
        let normal = self.axes[0].cross(self.axes[1]);
        let from_plane = match normal.try_normalize() {
            Some(normal) if normal.is_finite() => normal.dot(axis).abs().clamp(0.0, 1.0).asin(),
            _ => angle(self.axes[0], axis),
        };
        LinearDeviation {
            in_step: tip.distance(self.tip(share)),
            from_line: tip.distance(foot),
            axis_in_step: self.axis(share).map_or(std::f64::consts::PI, |wanted| angle(wanted, axis)),
            from_plane,
        }
    }
}

/// Directions whose angle is this near to a half turn [rad] have no great circle: rounding would choose it.
const OPPOSITE: f64 = 1e-9;

/// Joint positions at a share of a move in which all axes move in proportion.
fn proportional(from: &[f64], to: &[f64], share: f64) -> JointValues {
    let mut q = JointValues::new(from);
    for (value, to) in q.iter_mut().zip(to) {
        *value += (to - *value) * share;
    }
    q
}

impl Kinematics {
    /// Deviation of a move of all axes in proportion from the straight move of the tool, on `samples` equal steps.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::Machine;
    /// let chain = Machine::preset("mill4_xyza").unwrap().kinematics(0.0);
    /// // A quarter turn of A about (0, 0, 50) takes the tip on an arc of radius 50: its sagitta is 50 (1 - cos 45).
    /// let quarter = std::f64::consts::FRAC_PI_2;
    /// let found = chain.linear_deviation(&[0.0; 4], &[quarter, 0.0, 0.0, 0.0], 100);
    /// assert!((found.from_line - 50.0 * (1.0 - 0.5f64.sqrt())).abs() < 1e-12);
    /// ```
    pub fn linear_deviation(&self, from: &[f64], to: &[f64], samples: usize) -> LinearDeviation {
        let straight = Straight::between(self, from, to);
        let deviations = (0..=samples).map(|i| {
            let share = i as f64 / samples.max(1) as f64;
            let at = self.forward(&proportional(from, to, share));
            straight.deviation(at.translation, at.rotation.z_axis, share)
        });
        deviations.fold(LinearDeviation::default(), LinearDeviation::worst)
    }
}
