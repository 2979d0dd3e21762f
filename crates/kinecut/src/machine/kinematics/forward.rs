//! Forward kinematics.

use glam::{DMat3, DVec3};

use super::{Kinematics, Screw};
use crate::geom::Rigid;

impl Kinematics {
    /// The tip frame in workpiece coordinates at joint positions `q` [mm or rad]; positions that are missing count as
    /// zero.
    ///
    /// ```
    /// use glam::DVec3;
    /// use kinecut::machine::{CoordinateCode, Machine};
    /// let code = CoordinateCode::parse("641203").unwrap(); // C and A tables, X, Y, bed, Z
    /// let machine = Machine::new(code, [None; 3], Default::default()).unwrap();
    /// let quarter = std::f64::consts::FRAC_PI_2;
    /// let tip = machine.kinematics(0.0).forward(&[quarter, 0.0, 10.0, 0.0, 5.0]);
    /// assert!((tip.translation - DVec3::new(0.0, 10.0, 5.0)).length() < 1e-14);
    /// ```
    pub fn forward(&self, q: &[f64]) -> Rigid {
        let mut rotation = self.tool.rotation;
        // A product with the identity is spared.
        let mut upright = self.upright;
        let mut translation = self.tool.translation;
        for (screw, &value) in self.screws[..self.count].iter().zip(q).rev() {
            if screw.rotary {
                let turn = screw.turn(value);
                rotation = if upright { turn } else { turn * rotation };
                upright = false;
                translation = screw.point + turn * (translation - screw.point);
            } else {
                translation += screw.direction * value;
            }
        }
        let tip = Rigid { rotation, translation };
        if self.work_at_home { tip } else { self.to_work.after(&tip) }
    }
}

impl Screw {
    /// The rotation by `angle` [rad] (Rodrigues).
    pub(super) fn turn(&self, angle: f64) -> DMat3 {
        let (sin, cos) = angle.sin_cos();
        self.turn_by(sin, cos)
    }

    /// The rotation by the angle of this sine and cosine.
    pub(super) fn turn_by(&self, sin: f64, cos: f64) -> DMat3 {
        let a = self.direction;
        let (n, s) = (a * (1.0 - cos), a * sin);
        DMat3::from_cols(
            DVec3::new(n.x * a.x + cos, n.x * a.y + s.z, n.x * a.z - s.y),
            DVec3::new(n.y * a.x - s.z, n.y * a.y + cos, n.y * a.z + s.x),
            DVec3::new(n.z * a.x + s.y, n.z * a.y - s.x, n.z * a.z + cos),
        )
    }
}
