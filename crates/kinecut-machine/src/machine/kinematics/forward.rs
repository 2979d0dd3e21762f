//! Forward kinematics.

use glam::{DMat3, DVec3};

use super::{Kinematics, Screw};
use crate::geom::Rigid;

impl Kinematics {
    /// The tip frame in workpiece coordinates at joint positions `q` [mm or rad]; positions that are missing count as
    /// zero.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use glam::DVec3;
    /// use kinecut::machine::{CoordinateCode, Machine};
    /// let code = CoordinateCode::parse("641203").unwrap(); // C and A tables, X, Y, bed, Z
    /// let machine = Machine::new(code, [None; 3], Default::default()).unwrap();
    /// let quarter = std::f64::consts::FRAC_PI_2;
    /// let tip = machine.kinematics(0.0).forward(&[quarter, 0.0, 10.0, 0.0, 5.0]);
    /// assert!((tip.translation - DVec3::new(0.0, 10.0, 5.0)).length() < 1e-14);
    /// ```
    pub fn forward(&self, q: &[f64]) -> Rigid {
        // The usual case goes straight to the caller: a copy costs a seventh of the time.
        match &self.rotaries {
            Some(two) if self.work_at_home && self.upright => self.forward_of_two(two, q),
            _ => self.forward_of_any(q),
        }
    }

    /// One joint after the other.
    fn forward_of_any(&self, q: &[f64]) -> Rigid {
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

    /// The same of a chain with two rotary axes, its tool upright at home: both angles at once, and no product with an axis
    /// along X, Y or Z.
    fn forward_of_two(&self, two: &TwoRotaries, q: &[f64]) -> Rigid {
        let [first, second] = two.places;
        let [(sin1, cos1), (sin2, cos2)] =
            two.places.map(|place| q.get(place).copied().unwrap_or(0.0).sin_cos());
        let shift = |from: usize, to: usize, tip: DVec3| {
            let moved = self.screws[from..to].iter().zip(q.get(from..).unwrap_or(&[]));
            moved.fold(tip, |tip, (screw, &value)| tip + screw.direction * value)
        };
        let [s1, s2] = two.places.map(|place| &self.screws[place]);
        let turn = Turn { along: two.along[0], direction: s1.direction, sin: sin1, cos: cos1 };
        let inner = Turn { along: two.along[1], direction: s2.direction, sin: sin2, cos: cos2 }.matrix();
        let tip = shift(second + 1, self.count, self.tool.translation);
        let tip = s2.point + inner * (tip - s2.point);
        let tip = shift(first + 1, second, tip);
        let tip = s1.point + turn.vector(tip - s1.point);
        let tip = shift(0, first, tip);
        Rigid { rotation: turn.after(&inner), translation: tip }
    }
}

/// The rotary axes of a chain that has two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TwoRotaries {
    places: [usize; 2],
    along: [Along; 2],
}

impl TwoRotaries {
    /// Those of the chain, if there are two.
    pub(super) fn of(screws: &[Screw]) -> Option<TwoRotaries> {
        let mut rotary = (0..screws.len()).filter(|&i| screws[i].rotary);
        let (Some(first), Some(second), None) = (rotary.next(), rotary.next(), rotary.next()) else {
            return None;
        };
        let along = [first, second].map(|i| Along::of(screws[i].direction));
        Some(TwoRotaries { places: [first, second], along })
    }
}

/// Direction of a rotary axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Along {
    /// Along X, or against it: the sign of its sine.
    X(f64),
    /// Along or against Y.
    Y(f64),
    /// Along or against Z.
    Z(f64),
    /// Inclined.
    Inclined,
}

impl Along {
    fn of(direction: DVec3) -> Along {
        match direction.to_array() {
            [x, 0.0, 0.0] => Along::X(x),
            [0.0, y, 0.0] => Along::Y(y),
            [0.0, 0.0, z] => Along::Z(z),
            _ => Along::Inclined,
        }
    }
}

/// A rotation about an axis through the origin.
struct Turn {
    along: Along,
    direction: DVec3,
    sin: f64,
    cos: f64,
}

impl Turn {
    #[inline]
    fn matrix(&self) -> DMat3 {
        let c = self.cos;
        match self.along {
            Along::X(sign) => {
                let s = sign * self.sin;
                DMat3::from_cols(DVec3::X, DVec3::new(0.0, c, s), DVec3::new(0.0, -s, c))
            }
            Along::Y(sign) => {
                let s = sign * self.sin;
                DMat3::from_cols(DVec3::new(c, 0.0, -s), DVec3::Y, DVec3::new(s, 0.0, c))
            }
            Along::Z(sign) => {
                let s = sign * self.sin;
                DMat3::from_cols(DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z)
            }
            Along::Inclined => rodrigues(self.direction, self.sin, c),
        }
    }

    #[inline]
    fn vector(&self, v: DVec3) -> DVec3 {
        let c = self.cos;
        match self.along {
            Along::X(sign) => {
                let s = sign * self.sin;
                DVec3::new(v.x, c * v.y - s * v.z, s * v.y + c * v.z)
            }
            Along::Y(sign) => {
                let s = sign * self.sin;
                DVec3::new(c * v.x + s * v.z, v.y, c * v.z - s * v.x)
            }
            Along::Z(sign) => {
                let s = sign * self.sin;
                DVec3::new(c * v.x - s * v.y, s * v.x + c * v.y, v.z)
            }
            Along::Inclined => rodrigues(self.direction, self.sin, c) * v,
        }
    }

    #[inline]
    fn after(&self, m: &DMat3) -> DMat3 {
        match self.along {
            Along::Inclined => rodrigues(self.direction, self.sin, self.cos) * *m,
            _ => DMat3::from_cols(self.vector(m.x_axis), self.vector(m.y_axis), self.vector(m.z_axis)),
        }
    }
}

/// The rotation about a unit direction by the angle of this sine and cosine.
#[inline]
fn rodrigues(a: DVec3, sin: f64, cos: f64) -> DMat3 {
    let (n, s) = (a * (1.0 - cos), a * sin);
    DMat3::from_cols(
        DVec3::new(n.x * a.x + cos, n.x * a.y + s.z, n.x * a.z - s.y),
        DVec3::new(n.y * a.x - s.z, n.y * a.y + cos, n.y * a.z + s.x),
        DVec3::new(n.z * a.x + s.y, n.z * a.y - s.x, n.z * a.z + cos),
    )
}

impl Screw {
    /// The rotation by `angle` [rad] (Rodrigues).
    pub(super) fn turn(&self, angle: f64) -> DMat3 {
        let (sin, cos) = angle.sin_cos();
        self.turn_by(sin, cos)
    }

    /// The rotation by the angle of this sine and cosine.
    #[inline]
    pub(super) fn turn_by(&self, sin: f64, cos: f64) -> DMat3 {
        rodrigues(self.direction, sin, cos)
    }
}
