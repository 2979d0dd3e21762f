//! The normal velocity of a parallel circle of the tool: `a cos theta + b sin theta + c` around it.

use std::f64::consts::PI;

use glam::DVec2;

use super::{ChainPiece, PieceShape};
use crate::machine::Twist;

/// The normal velocity around one parallel circle, by the angle about the axis; positive where the tool enters.
///
/// The spin of the tool about its axis is not in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalVelocity {
    /// Amplitude as a vector across the axis.
    pub across: DVec2,
    /// Mean value.
    pub mean: f64,
}

/// One of the two points of a parallel circle: the tool enters on the angles from the minus to the plus branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum GrazingBranch {
    /// At `psi + alpha`.
    Plus,
    /// At `psi - alpha`.
    Minus,
}

impl GrazingBranch {
    /// +1 or -1.
    pub fn sign(self) -> f64 {
        match self {
            GrazingBranch::Plus => 1.0,
            GrazingBranch::Minus => -1.0,
        }
    }

    /// Both, plus first.
    pub const BOTH: [GrazingBranch; 2] = [GrazingBranch::Plus, GrazingBranch::Minus];
}

impl NormalVelocity {
    /// Its value at an angle about the axis [rad].
    pub fn at(&self, theta: f64) -> f64 {
        let (sin, cos) = theta.sin_cos();
        self.across.dot(DVec2::new(cos, sin)) + self.mean
    }

    /// The angle of its largest value [rad].
    pub fn psi(&self) -> f64 {
        self.across.y.atan2(self.across.x)
    }

    /// Half of the angle within which the tool enters: 0 to pi [rad].
    pub fn alpha(&self) -> f64 {
        let d = self.across.length_squared() - self.mean * self.mean;
        match (d > 0.0, self.mean > 0.0) {
            (true, _) => d.sqrt().atan2(-self.mean),
            (false, true) => PI,
            (false, false) => 0.0,
        }
    }

    /// Square of the amplitude less that of the mean: positive where there are two grazing points.
    pub fn discriminant(&self) -> f64 {
        // As a product: the difference of the squares loses digits.
        let (r, c) = (self.across.length(), self.mean.abs());
        (r - c) * (r + c)
    }

    /// Unit vectors to both points, plus branch first, where the root of the discriminant is known better than from the
    /// coefficients. Along X where the velocity does not change around the circle.
    pub fn directions(&self, root: f64) -> [DVec2; 2] {
        let turned = self.across.perp() * root;
        let along = self.across * self.mean;
        // Its length is that of the amplitude, squared, but for rounding of the root.
        let scale = (root * root + self.mean * self.mean) * self.across.length_squared();
        if scale <= 0.0 || !scale.is_finite() {
            return [DVec2::X; 2];
        }
        let scale = 1.0 / scale.sqrt();
        [(turned - along) * scale, (-turned - along) * scale]
    }
}

/// The normal velocity of a piece of the chain as a function of its parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PieceVelocity {
    /// A line: `(fixed + u lever, mean)`, with the moment counted from the start.
    Line { fixed: DVec2, lever: DVec2, mean: f64 },
    /// An arc: `(cos phi centre - sin phi lever, sin phi axial)`.
    Arc { centre: DVec2, lever: DVec2, axial: f64 },
}

impl PieceVelocity {
    pub(super) fn new(piece: &ChainPiece, twist: &Twist) -> PieceVelocity {
        let a = twist.shift.truncate();
        let b = DVec2::new(twist.turn.y, -twist.turn.x);
        match piece.shape {
            PieceShape::Line { start, normal, .. } => PieceVelocity::Line {
                fixed: a * normal.x + b * (normal.x * start.y - normal.y * start.x),
                lever: b,
                mean: normal.y * twist.shift.z,
            },
            PieceShape::Arc { centre, .. } => {
                PieceVelocity::Arc { centre: a + b * centre.y, lever: b * centre.x, axial: twist.shift.z }
            }
        }
    }

    pub(super) fn at(&self, u: f64) -> NormalVelocity {
        match self {
            PieceVelocity::Line { .. } => self.with(u, (0.0, 1.0)),
            PieceVelocity::Arc { .. } => self.with(u, u.sin_cos()),
        }
    }

    /// The same, with sine and cosine of the parameter of an arc.
    pub(super) fn with(&self, u: f64, (sin, cos): (f64, f64)) -> NormalVelocity {
        match *self {
            PieceVelocity::Line { fixed, lever, mean } => NormalVelocity { across: fixed + lever * u, mean },
            PieceVelocity::Arc { centre, lever, axial } => {
                NormalVelocity { across: centre * cos - lever * sin, mean: axial * sin }
            }
        }
    }

    /// A bound of how fast its amplitude changes.
    pub(super) fn slope_size(&self) -> f64 {
        match *self {
            PieceVelocity::Line { lever, .. } => lever.length(),
            PieceVelocity::Arc { centre, lever, .. } => centre.length() + lever.length(),
        }
    }

    /// Its derivative by the parameter.
    pub(super) fn slope(&self, u: f64) -> NormalVelocity {
        match *self {
            PieceVelocity::Line { lever, .. } => NormalVelocity { across: lever, mean: 0.0 },
            PieceVelocity::Arc { centre, lever, axial } => {
                let (sin, cos) = u.sin_cos();
                NormalVelocity { across: -centre * sin - lever * cos, mean: axial * cos }
            }
        }
    }
}
