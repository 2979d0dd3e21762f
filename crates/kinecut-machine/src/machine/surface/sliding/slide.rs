//! Motions by which a surface slides in itself: translations, rotations, screws.

use std::f64::consts::TAU;
use std::fmt;

use glam::DVec3;

/// A motion that carries every point of a surface along the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Slide {
    /// A translation along this unit direction.
    Shift {
        /// Unit direction.
        direction: DVec3,
    },
    /// A rotation, or a screw if the pitch is not zero.
    Turn {
        /// Unit direction of the axis.
        axis: DVec3,
        /// The point of the axis next to the middle of the samples [mm].
        point: DVec3,
        /// Advance [mm per rad]; positive for a right-handed screw.
        pitch: f64,
    },
}

impl Slide {
    /// Velocity of a point at unit speed or unit angular speed [mm].
    pub fn velocity(&self, p: DVec3) -> DVec3 {
        match *self {
            Slide::Shift { direction } => direction,
            Slide::Turn { axis, point, pitch } => axis.cross(p - point) + axis * pitch,
        }
    }

    /// Direction of the translation or of the axis: a unit vector.
    pub fn direction(&self) -> DVec3 {
        match *self {
            Slide::Shift { direction } => direction,
            Slide::Turn { axis, .. } => axis,
        }
    }

    /// Advance per turn [mm]; none for a translation.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use glam::DVec3;
    /// use kinecut::machine::surface::Slide;
    /// let thread = Slide::Turn { axis: DVec3::Z, point: DVec3::ZERO, pitch: 10.0 / std::f64::consts::TAU };
    /// assert!((thread.lead().unwrap() - 10.0).abs() < 1e-12);
    /// ```
    pub fn lead(&self) -> Option<f64> {
        match *self {
            Slide::Shift { .. } => None,
            Slide::Turn { pitch, .. } => Some(pitch * TAU),
        }
    }

    /// Angular velocity, and velocity of the point at the origin, at unit speed.
    pub fn twist(&self) -> [DVec3; 2] {
        match *self {
            Slide::Shift { direction } => [DVec3::ZERO, direction],
            Slide::Turn { axis, .. } => [axis, self.velocity(DVec3::ZERO)],
        }
    }
}

impl fmt::Display for Slide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = |v: DVec3, digits: i32| {
            let scale = 10f64.powi(digits);
            // Adding zero makes -0 to 0.
            let [x, y, z] = (v * scale).to_array().map(|c| c.round() / scale + 0.0);
            format!("({x}, {y}, {z})")
        };
        match *self {
            Slide::Shift { direction } => write!(f, "translation along {}", shown(direction, 6)),
            Slide::Turn { axis, point, pitch } => {
                if pitch == 0.0 {
                    write!(f, "rotation")?;
                } else {
                    let hand = if pitch > 0.0 { "right" } else { "left" };
                    let lead = (pitch.abs() * TAU * 1e6).round() / 1e6;
                    write!(f, "{hand}-handed screw of {lead} mm per turn")?;
                }
                write!(f, " about the axis through {} along {}", shown(point, 4), shown(axis, 6))
            }
        }
    }
}
