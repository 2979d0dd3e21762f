//! Lines along the tool axis: the interval that a moving tool part covers.
//!
//! Over a point at plan distance rho the part begins at tip + h(rho), h convex and not falling. The lowest reach is
//! the minimum of tip(t) + h(rho(t)); on a level path it is at the nearest point of the path. On a slope let x be the
//! way from the foot of the perpendicular downhill: -k x + h(sqrt(l^2 + x^2)) is convex, with the closed forms
//!
//! | part | x |
//! |---|---|
//! | cylinder | the end of its reach |
//! | cone h = c rho | k l / sqrt(c^2 - k^2), or the end of its reach when k >= c |
//! | ball | k sqrt(R^2 - l^2) / sqrt(1 + k^2) |
//! | torus | from the root S of (d + r S)^2 ((1 + k^2) - k^2 / S^2) = l^2, monotone in S |
//!
//! and x is kept on the path. Helices: `axial_helix.rs`.

use glam::{DVec2, DVec3};

use super::axial_helix::lowest_on_helix;
use super::body::{ConvexPart, Foot, Touch};
use super::face::{Station, SweptFace};
use super::piece::MovePiece;
use super::plan::{LinePlan, Plan};
use crate::num::root::bracketed_newton;

/// An interval that a part removes from a line along the tool axis, in the tool frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    /// Lower and upper height.
    pub(super) lo: f64,
    pub(super) hi: f64,
    /// Fractions of the piece and touching features; on a level path the fraction is left open (NaN).
    pub(super) lo_at: (f64, Touch),
    pub(super) hi_at: (f64, Touch),
}

impl Hit {
    /// True if both ends are left by flat faces.
    pub(super) fn is_flat(&self) -> bool {
        self.lo_at.1 == Touch::Disc && self.hi_at.1 == Touch::Top
    }
}

/// The intervals in which a part on its way along a piece meets the line over `q`.
pub(super) fn hits(part: &ConvexPart, piece: &MovePiece, q: DVec2, mut each: impl FnMut(Hit)) {
    let rise = piece.rise();
    let standing = matches!(piece.plan, Plan::Dot(_));
    if rise == 0.0 || standing {
        let d2 = piece.plan.distance_squared(q);
        if d2 > part.r1 * part.r1 {
            return;
        }
        let t = match (standing, rise < 0.0) {
            (true, true) => 1.0,
            (true, false) => 0.0,
            (false, _) => f64::NAN,
        };
        let [low, high] = if rise < 0.0 { [piece.w[1], piece.w[0]] } else { piece.w };
        let (lo, touch) = if d2 <= part.r0 * part.r0 {
            (low + part.z0, Touch::Disc)
        } else {
            (low + part.height(d2.sqrt()), Touch::Foot)
        };
        return each(Hit { lo, hi: high + part.top, lo_at: (t, touch), hi_at: (t, Touch::Top) });
    }
    for window in piece.plan.windows(q, part.r1).iter() {
        let (t, touch) = match &piece.plan {
            // Handled above; a dot has no slope.
            Plan::Dot(_) => (0.0, Touch::Disc),
            Plan::Line(line) => lowest_on_slope(part, line, rise, q, window),
            Plan::Arc(arc) => lowest_on_helix(part, arc, rise, q, window),
        };
        let rho = piece.plan.point(t).distance(q);
        // A root found to rounding may lie a hair outside the part.
        let lo = piece.tip(t) + part.height(rho.clamp(0.0, part.r1));
        let last = if rise > 0.0 { window.1 } else { window.0 };
        let hi_touch = if last > 0.0 && last < 1.0 { Touch::Rim } else { Touch::Top };
        each(Hit { lo, hi: piece.tip(last) + part.top, lo_at: (t, touch), hi_at: (last, hi_touch) });
    }
}

/// Fraction of the lowest reach over `q` on a sloping line, within a window of fractions.
fn lowest_on_slope(
    part: &ConvexPart,
    line: &LinePlan,
    rise: f64,
    q: DVec2,
    window: (f64, f64),
) -> (f64, Touch) {
    let v = q - line.start;
    let along = v.dot(line.way) / line.length;
    let l = (v.perp_dot(line.way) / line.length).abs();
    let k = rise.abs() / line.length;
    let leg = |rho: f64| ((rho - l) * (rho + l)).clamp(0.0, f64::INFINITY).sqrt();
    let reach = leg(part.r1);
    let free = match part.foot {
        Foot::Flat => f64::INFINITY,
        Foot::Cone { rise: c } if c > k => k * l / ((c - k) * (c + k)).sqrt(),
        Foot::Cone { .. } => f64::INFINITY,
        Foot::Torus { centre_radius: 0.0, radius, .. } => {
            k * ((radius - l) * (radius + l)).clamp(0.0, f64::INFINITY).sqrt() / k.hypot(1.0)
        }
        Foot::Torus { centre_radius, radius, .. } => {
            leg(centre_radius + radius * torus_root(centre_radius, radius, k, l))
        }
    };
    // The cone and the torus are met beyond the disc only.
    let edge = leg(part.r0);
    let (x, touch) = if free >= reach {
        (reach, Touch::Edge)
    } else if free > edge || !part.has_edge() {
        (free, Touch::Foot)
    } else {
        (edge, Touch::Edge)
    };
    let t = (along - x.copysign(rise)) / line.length;
    if !(0.0..=1.0).contains(&t) {
        let t = t.clamp(0.0, 1.0);
        let rho = (line.start + line.way * t).distance(q);
        return (t, if rho <= part.r0 { Touch::Disc } else { Touch::Foot });
    }
    (t.clamp(window.0, window.1), touch)
}

/// The root S in (k / sqrt(1 + k^2), 1] of (d + r S)^2 ((1 + k^2) - k^2 / S^2) = l^2: the sine of the angle of the
/// torus' normal from its axis, where a torus with tube radius r about a circle of radius d, drawn along a slope k,
/// is met at the lateral distance l.
fn torus_root(d: f64, r: f64, k: f64, l: f64) -> f64 {
    /// Halvings of [0, 1] down to rounding.
    const LIMIT: u32 = 60;
    let least = k / k.hypot(1.0);
    let f = |s: f64| {
        let rho = d + r * s;
        let g = 1.0 + k * k - k * k / (s * s);
        (rho * rho * g - l * l, 2.0 * r * rho * g + rho * rho * 2.0 * k * k / (s * s * s))
    };
    bracketed_newton(f, 1.0, least, 1.0, LIMIT).0
}

/// Normal of the remaining material at an end of a hit, and the face of the part that left it.
pub(super) fn surface(
    part: &ConvexPart,
    piece: &MovePiece,
    q: DVec2,
    at: (f64, Touch),
) -> (DVec3, SweptFace) {
    let t = if at.0.is_nan() { piece.plan.nearest(q) } else { at.0 };
    let v = q - piece.plan.point(t);
    let rho = v.length();
    let e = if rho > 0.0 { v / rho } else { DVec2::ZERO };
    let speed = piece.plan.speed(t);
    // Gradient of the height at which an edge circle reaches: rise e / (e . speed).
    let (forward, rise) = (e.dot(speed), piece.rise());
    let edge = |up: f64| {
        let n = DVec3::new(-rise * e.x, -rise * e.y, forward) * 1f64.copysign(forward) * up;
        if n == DVec3::ZERO { DVec3::Z * up } else { n }
    };
    match at.1 {
        Touch::Disc => (DVec3::Z, SweptFace::Floor),
        Touch::Foot => {
            let (nx, nz) = foot_normal(part, rho);
            let n = DVec3::new(-nx * e.x, -nx * e.y, -nz);
            (n, SweptFace::side(true, piece.station(t), speed.perp_dot(e) > 0.0))
        }
        Touch::Edge => (edge(1.0), SweptFace::Trough),
        Touch::Top => (DVec3::NEG_Z, SweptFace::Roof),
        Touch::Rim => (edge(-1.0), SweptFace::Roof),
    }
}

/// Outward normal of the foot at a distance from the axis: that of the foot also at its upper end.
fn foot_normal(part: &ConvexPart, rho: f64) -> (f64, f64) {
    match part.foot {
        Foot::Flat => (0.0, -1.0),
        Foot::Cone { rise } => (rise / rise.hypot(1.0), -1.0 / rise.hypot(1.0)),
        Foot::Torus { centre_radius, radius, .. } => {
            let nx = ((rho - centre_radius) / radius).clamp(0.0, 1.0);
            (nx, -((1.0 - nx) * (1.0 + nx)).sqrt())
        }
    }
}

impl MovePiece {
    /// The station of a fraction of the piece on its move.
    pub(super) fn station(&self, t: f64) -> Station {
        Station::at(self.fractions[0] + (self.fractions[1] - self.fractions[0]) * t)
    }
}
