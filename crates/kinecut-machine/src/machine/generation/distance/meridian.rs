//! Distance from a body of revolution given by its meridian of lines and arcs.
//!
//! The problem is plane: the nearest piece of the meridian gives the distance, and the side of its normal the sign;
//! where two pieces meet in the nearest point the sum of both normals decides (the plane case of Baerentzen and
//! Aanaes, 2005).

use glam::{DVec2, DVec3};

use super::Distance;
use crate::base::{Code, Finding, Result};
use crate::geom::{Profile, ProfileElement};

/// A piece of a meridian, in (radius, height) [mm], from its first to its second end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeridianPiece {
    /// A straight line: a cone, a cylinder, a disc.
    Line {
        /// First end [mm].
        from: DVec2,
        /// Second end [mm].
        to: DVec2,
    },
    /// A circular arc: a torus, a ball.
    Arc {
        /// Centre [mm].
        centre: DVec2,
        /// Radius [mm].
        radius: f64,
        /// Angle of the first end [rad].
        from: f64,
        /// Signed angle to the second end [rad], at most a whole turn.
        sweep: f64,
    },
}

impl MeridianPiece {
    fn ends(&self) -> (DVec2, DVec2) {
        match *self {
            MeridianPiece::Line { from, to } => (from, to),
            MeridianPiece::Arc { centre, radius, from, sweep } => {
                let at = |angle: f64| centre + DVec2::from_angle(angle) * radius;
                (at(from), at(from + sweep))
            }
        }
    }

    /// Normals at both ends, to the right of the piece: out of the material.
    fn normals(&self) -> (DVec2, DVec2) {
        match *self {
            MeridianPiece::Line { from, to } => {
                let n = -(to - from).perp().normalize_or_zero();
                (n, n)
            }
            MeridianPiece::Arc { from, sweep, .. } => {
                let at = |angle: f64| DVec2::from_angle(angle) * sweep.signum();
                (at(from), at(from + sweep))
            }
        }
    }

    /// The nearest point, its normal, and the end that it is: -1 first, 0 none, 1 second.
    fn nearest(&self, p: DVec2) -> (DVec2, DVec2, i8) {
        let (from, to) = self.ends();
        let ends = self.normals();
        match *self {
            MeridianPiece::Line { .. } => {
                let along = to - from;
                let squared = along.length_squared();
                let share = if squared > 0.0 { (p - from).dot(along) / squared } else { 0.0 };
                if share <= 0.0 {
                    (from, ends.0, -1)
                } else if share >= 1.0 {
                    (to, ends.1, 1)
                } else {
                    (from + along * share, ends.0, 0)
                }
            }
            MeridianPiece::Arc { centre, radius, from: angle, sweep } => {
                let to_point = (p - centre).try_normalize().unwrap_or(DVec2::from_angle(angle));
                let turned = (to_point.to_angle() - angle) * sweep.signum();
                if turned.rem_euclid(std::f64::consts::TAU) <= sweep.abs() {
                    (centre + to_point * radius, to_point * sweep.signum(), 0)
                } else if p.distance_squared(from) <= p.distance_squared(to) {
                    (from, ends.0, -1)
                } else {
                    (to, ends.1, 1)
                }
            }
        }
    }
}

/// A body of revolution about Z. Its meridian has the material on the left, and runs from the axis to the axis or is
/// closed.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use glam::DVec3;
/// use kinecut::geom::Profile;
/// use kinecut::machine::generation::{Distance, Meridian};
/// let mill = Meridian::of_profile(&Profile::bull_nose(20.0, 2.0, 50.0).unwrap());
/// assert_eq!(mill.signed(DVec3::new(13.0, 0.0, 25.0)), 3.0);
/// assert_eq!(mill.signed(DVec3::new(0.0, 5.0, -1.5)), 1.5);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Meridian {
    pieces: Vec<MeridianPiece>,
    closed: bool,
}

impl Meridian {
    /// A body with this meridian.
    ///
    /// # Errors
    /// `KC1131` when it is empty, has a gap, a negative radius or a number that is not finite, or neither is closed nor
    /// ends on the axis on both sides.
    pub fn new(pieces: Vec<MeridianPiece>) -> Result<Meridian> {
        let fail = |what: &str, value: f64| {
            Err(Finding::error(Code::GENERATION_INPUT, format!("the meridian of a body {what}"))
                .value_mm(value)
                .help("give lines and arcs end to end, from the axis to the axis or closed, material on the left")
                .into())
        };
        let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else { return fail("is empty", 0.0) };
        for (i, piece) in pieces.iter().enumerate() {
            let (from, to) = piece.ends();
            let lowest = match *piece {
                MeridianPiece::Line { .. } => from.x.min(to.x),
                MeridianPiece::Arc { .. } => piece.nearest(DVec2::new(-FAR, from.y)).0.x,
            };
            if !(from.is_finite() && to.is_finite()) {
                return fail("has a number that is not finite", f64::NAN);
            }
            if lowest < -JOINT {
                return fail("crosses the axis", lowest);
            }
            if i > 0 && pieces[i - 1].ends().1.distance(from) > JOINT {
                return fail("has a gap", pieces[i - 1].ends().1.distance(from));
            }
        }
        let (start, end) = (first.ends().0, last.ends().1);
        let closed = start.distance(end) <= JOINT;
        if !closed && (start.x > JOINT || end.x > JOINT) {
            return fail("is open away from the axis", start.x.max(end.x));
        }
        Ok(Meridian { pieces, closed })
    }

    /// The body of a tool's profile, closed by its top.
    pub fn of_profile(profile: &Profile) -> Meridian {
        let mut pieces = Vec::with_capacity(profile.elements().len() + 4);
        let mut at = DVec2::new(0.0, profile.bottom());
        let line = |pieces: &mut Vec<MeridianPiece>, from: DVec2, to: DVec2| {
            if from != to {
                pieces.push(MeridianPiece::Line { from, to });
            }
        };
        for element in profile.elements() {
            match *element {
                ProfileElement::Cone { z0, r0, z1, r1 } => {
                    line(&mut pieces, at, DVec2::new(r0, z0));
                    line(&mut pieces, DVec2::new(r0, z0), DVec2::new(r1, z1));
                    at = DVec2::new(r1, z1);
                }
                ProfileElement::Torus { centre_radius, centre_z, radius, z0, z1 } => {
                    let angle = |z: f64| ((z - centre_z) / radius).clamp(-1.0, 1.0).asin();
                    let (from, to) = (angle(z0), angle(z1));
                    let centre = DVec2::new(centre_radius, centre_z);
                    let arc = MeridianPiece::Arc { centre, radius, from, sweep: to - from };
                    line(&mut pieces, at, arc.ends().0);
                    pieces.push(arc);
                    at = arc.ends().1;
                }
            }
        }
        line(&mut pieces, at, DVec2::new(0.0, at.y));
        Meridian { pieces, closed: false }
    }

    /// The normal of the piece that joins another in the end of `piece` that is nearest; on the axis the mirrored one.
    fn neighbour(&self, piece: usize, end: i8, normal: DVec2) -> DVec2 {
        let n = self.pieces.len();
        match (piece, end) {
            (0, -1) if !self.closed => DVec2::new(-normal.x, normal.y),
            (i, 1) if i + 1 == n && !self.closed => DVec2::new(-normal.x, normal.y),
            (i, -1) => self.pieces[(i + n - 1) % n].normals().1,
            (i, _) => self.pieces[(i + 1) % n].normals().0,
        }
    }
}

impl Distance for Meridian {
    fn signed(&self, p: DVec3) -> f64 {
        let p = DVec2::new(p.truncate().length(), p.z);
        let mut best = (f64::INFINITY, DVec2::ZERO, DVec2::ZERO);
        for (i, piece) in self.pieces.iter().enumerate() {
            let (foot, mut normal, end) = piece.nearest(p);
            let squared = p.distance_squared(foot);
            if squared < best.0 {
                if end != 0 {
                    normal += self.neighbour(i, end, normal);
                }
                best = (squared, foot, normal);
            }
        }
        let (squared, foot, normal) = best;
        if normal.dot(p - foot) < 0.0 { -squared.sqrt() } else { squared.sqrt() }
    }
}

/// Gap that rounding of sines and roots may leave between two pieces [mm].
const JOINT: f64 = 1e-9;
/// Farther left than any meridian [mm]: the point of an arc nearest to it is its least radius.
const FAR: f64 = 1e9;
