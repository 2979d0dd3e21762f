//! The part of a tool that enters at a moment: what can meet material, and what planners and the simulator ask.
//!
//! On each parallel circle the normal velocity is `R cos(theta - psi) + C`: the tool enters where `|theta - psi| < alpha`. Zero counts
//! as leaving, so that a face that slides in itself does not enter.

use std::f64::consts::PI;

use super::{Motion, PieceShape, ProfileChain, twist::clean};
use crate::machine::kinematics::Twist;
use crate::tool::ElementRole;

/// The part of one parallel circle that enters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entering {
    /// Nothing.
    Nothing,
    /// All of it.
    Whole,
    /// The arc to both sides of an angle about the tool's axis [rad].
    Arc {
        /// Its middle.
        middle: f64,
        /// Half of its width, between 0 and pi.
        half: f64,
    },
}

impl Entering {
    /// True if the circle enters at an angle about the axis [rad].
    pub fn holds(&self, theta: f64) -> bool {
        match *self {
            Entering::Nothing => false,
            Entering::Whole => true,
            Entering::Arc { middle, half } => {
                let away = (theta - middle).rem_euclid(2.0 * PI);
                away.min(2.0 * PI - away) < half
            }
        }
    }

    /// Width [rad].
    pub fn width(&self) -> f64 {
        match *self {
            Entering::Nothing => 0.0,
            Entering::Whole => 2.0 * PI,
            Entering::Arc { half, .. } => 2.0 * half,
        }
    }
}

/// A stretch of a piece that enters, as a whole or on an arc of each of its circles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnteringRegion {
    /// Piece of the chain.
    pub piece: usize,
    /// Parameter at the start.
    pub from: f64,
    /// Parameter at the end.
    pub to: f64,
    /// Its circles enter as a whole; else on the arc that [`ProfileChain::entering_at`] gives.
    pub whole: bool,
    /// Role of the piece.
    pub role: ElementRole,
}

impl ProfileChain {
    /// Part of a piece's parallel circle at a parameter that enters, under a twist in tool coordinates.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use std::f64::consts::FRAC_PI_2;
    /// use glam::DVec3;
    /// use kinecut::machine::kinematics::Twist;
    /// use kinecut::sweep::{Entering, ProfileChain};
    /// use kinecut::tool::{Contour, ContourElement, ElementRole};
    /// let pin = Contour::new(vec![
    ///     ContourElement::line([0.0, 0.0], [5.0, 0.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 0.0], [5.0, 30.0], ElementRole::Cutting),
    ///     ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
    /// ]);
    /// let chain = ProfileChain::new(&pin.unwrap());
    /// let ahead = Twist { turn: DVec3::ZERO, shift: DVec3::Y };
    /// // The front half of the flank enters, and nothing of the bottom.
    /// assert_eq!(chain.entering_at(&ahead, 2, 7.0), Entering::Arc { middle: FRAC_PI_2, half: FRAC_PI_2 });
    /// assert_eq!(chain.entering_at(&ahead, 0, 2.0), Entering::Nothing);
    /// ```
    pub fn entering_at(&self, twist: &Twist, piece: usize, u: f64) -> Entering {
        let twist = clean(twist, self.reach()).0;
        let velocity = self.normal_velocity(&twist, piece, u);
        if velocity.discriminant() > 0.0 {
            Entering::Arc { middle: velocity.psi(), half: velocity.alpha() }
        } else if velocity.mean > 0.0 {
            Entering::Whole
        } else {
            Entering::Nothing
        }
    }

    /// All entering stretches of the chain, in order.
    pub fn entering(&self, twist: &Twist) -> Vec<EnteringRegion> {
        let twist = clean(twist, self.reach()).0;
        let grazing = self.grazing(&twist);
        let mut all = Vec::new();
        if matches!(grazing.motion, Motion::Still | Motion::Spin) {
            return all;
        }
        for (piece, shape) in self.pieces().iter().enumerate() {
            let role = shape.role;
            let region = |from, to, whole| EnteringRegion { piece, from, to, whole, role };
            let mut at = shape.from;
            let whole = |from: f64, to: f64, all: &mut Vec<EnteringRegion>| {
                for (from, to) in self.of_one_sign(piece, from, to).into_iter().flatten() {
                    if self.normal_velocity(&twist, piece, 0.5 * (from + to)).mean > 0.0 {
                        all.push(region(from, to, true));
                    }
                }
            };
            for span in grazing.spans.iter().filter(|s| s.piece == piece) {
                whole(at, span.from, &mut all);
                all.push(region(span.from, span.to, false));
                at = span.to;
            }
            whole(at, shape.to, &mut all);
        }
        all
    }

    /// The parts of a stretch on which the normal does not pass across the axis.
    fn of_one_sign(&self, piece: usize, from: f64, to: f64) -> [Option<(f64, f64)>; 2] {
        if from == to {
            return [None; 2];
        }
        let level = (from.min(to) / PI).ceil() * PI;
        let arc = matches!(self.pieces()[piece].shape, PieceShape::Arc { .. });
        if arc && level > from.min(to) && level < from.max(to) {
            [Some((from, level)), Some((level, to))]
        } else {
            [Some((from, to)), None]
        }
    }
}
