//! Lines across the tool axis on sloping paths: per convex part, the side (a cylinder) and the foot.
//!
//! At a line of height w the part shows the section of the height w - tip(t). The side is on the line during a run
//! of fractions in which its radius is constant: `across.rs`. The foot's section grows or shrinks along the path:
//!
//! * cone on a line: discs whose radius changes in proportion: their hull, in closed form;
//! * torus on a line: x(t) +- sqrt(rho(t)^2 - (y - y(t))^2), concave and convex in t, over the run of fractions in
//!   which the section reaches the line (a straight line against the stadium of the torus' silhouette, closed form):
//!   the stationary point by bracketed Newton, for a ball in closed form;
//! * anything on an arc: sampled and refined (`across_helix.rs`).

use glam::{DVec2, DVec3};

use super::across::{CoveredSpan, Mark, disc, spans};
use super::across_helix::foot_on_arc;
use super::body::{ConvexPart, Foot};
use super::face::SweptFace;
use super::piece::MovePiece;
use super::plan::{LinePlan, Plan};
use crate::num::root::bracketed_newton;

/// The feature of the tool that leaves the surface at an end of a span.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// Foot or side.
    Flank,
    /// The lower edge, drawn along the slope.
    Edge,
    /// The upper edge.
    Rim,
}

/// A covered span with what cut its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SlopeSpan {
    pub(super) span: CoveredSpan,
    pub(super) lo: Cut,
    pub(super) hi: Cut,
}

/// The spans that one part covers, on its way along a sloping piece, of the line at `y` and height `w`.
/// `plan` is the piece's path with x along the line.
pub(super) fn slope_spans(
    part: &ConvexPart,
    piece: &MovePiece,
    plan: &Plan,
    y: f64,
    w: f64,
    mut each: impl FnMut(SlopeSpan),
) {
    let mut give = |span: CoveredSpan, run: &Run, low: Cut, high: Cut| {
        let cut = |mark: Mark| match mark.t {
            t if t <= run.from => run.limit(false, low, high),
            t if t >= run.to => run.limit(true, low, high),
            _ => Cut::Flank,
        };
        each(SlopeSpan { span, lo: cut(span.lo), hi: cut(span.hi) });
    };
    if let Some(run) = Run::new(piece, w, part.z1, part.top) {
        let low = if part.has_shoulder() { Cut::Edge } else { Cut::Flank };
        for span in spans(&plan.part(run.from, run.to), part.r1, y).as_slice() {
            give(run.stretched(*span), &run, low, Cut::Rim);
        }
    }
    if part.foot == Foot::Flat {
        return;
    }
    let Some(run) = Run::new(piece, w, part.z0, part.z1) else { return };
    let low = if part.has_edge() { Cut::Edge } else { Cut::Flank };
    let high = if part.has_shoulder() { Cut::Edge } else { Cut::Flank };
    match (plan, part.foot) {
        // A dot has no slope, a flat part no foot.
        (Plan::Dot(_), _) | (_, Foot::Flat) => {}
        (Plan::Line(line), Foot::Cone { .. }) => {
            let radii = [run.from, run.to].map(|t| part.radius(w - piece.tip(t)));
            let [start, end] = [run.from, run.to].map(|t| line.start + line.way * t);
            if let Some(span) = growing(start, end, radii, y) {
                give(run.stretched(span), &run, low, high);
            }
        }
        (Plan::Line(line), Foot::Torus { centre_radius, centre_z, radius }) => {
            let torus = TorusOnSlope { line, piece, centre_radius, centre_z, radius, y, w };
            if let Some(span) = torus.span(&run) {
                give(span, &run, low, high);
            }
        }
        (Plan::Arc(arc), _) => {
            foot_on_arc(part, arc, piece, (run.from, run.to), y, w, |span| give(span, &run, low, high));
        }
    }
}

/// A run of fractions in which the section at the line belongs to a zone of heights of the part.
struct Run {
    from: f64,
    to: f64,
    /// True if the lower (upper) limit of the zone, not an end of the path, ends the run at `from`, at `to`.
    low: [bool; 2],
    high: [bool; 2],
}

impl Run {
    fn new(piece: &MovePiece, w: f64, bottom: f64, top: f64) -> Option<Run> {
        let rise = piece.rise();
        let [at_low, at_high] = [bottom, top].map(|z| (w - z - piece.w[0]) / rise);
        // Rising, the part's top comes to the line first.
        let (first, last) = if rise > 0.0 { (at_high, at_low) } else { (at_low, at_high) };
        let (cut_first, cut_last) = (first > 0.0, last < 1.0);
        let (from, to) = (first.clamp(0.0, f64::INFINITY), last.clamp(f64::NEG_INFINITY, 1.0));
        let rising = rise > 0.0;
        (from <= to).then_some(Run {
            from,
            to,
            low: [cut_first && !rising, cut_last && rising],
            high: [cut_first && rising, cut_last && !rising],
        })
    }

    /// The feature that cuts at an end of the run.
    fn limit(&self, at_end: bool, low: Cut, high: Cut) -> Cut {
        let i = usize::from(at_end);
        if self.low[i] {
            low
        } else if self.high[i] {
            high
        } else {
            Cut::Flank
        }
    }

    /// A span of the part of the path in the run, with fractions of the whole path.
    fn stretched(&self, span: CoveredSpan) -> CoveredSpan {
        let stretch = |m: Mark| {
            // The ends exactly, so that they are recognised as ends.
            let t = match m.t {
                0.0 => self.from,
                1.0 => self.to,
                t => self.from + (self.to - self.from) * t,
            };
            Mark { t, ..m }
        };
        CoveredSpan { lo: stretch(span.lo), hi: stretch(span.hi) }
    }
}

/// The span of the line at `y` in the hull of discs whose radius changes in proportion from start to end.
fn growing(start: DVec2, end: DVec2, radii: [f64; 2], y: f64) -> Option<CoveredSpan> {
    let way = end - start;
    let length = way.length();
    let grow = radii[1] - radii[0];
    let mut span: Option<CoveredSpan> = None;
    let mut look = |t: f64| {
        let Some(new) = disc(start + way * t, radii[0] + grow * t, y, t, way) else { return };
        span = Some(span.map_or(new, |old| CoveredSpan {
            lo: if new.lo.x < old.lo.x { new.lo } else { old.lo },
            hi: if new.hi.x > old.hi.x { new.hi } else { old.hi },
        }));
    };
    look(0.0);
    look(1.0);
    // Common tangents: e . way = -grow.
    let m = grow / length;
    if m.abs() < 1.0 {
        let d = way / length;
        for side in [-1.0, 1.0] {
            let e = d * -m + d.perp() * (side * (1.0 - m * m).sqrt());
            let t = (y - start.y - radii[0] * e.y) / (way.y + grow * e.y);
            if t > 0.0 && t < 1.0 {
                look(t);
            }
        }
    }
    span
}

/// A torus foot on a sloping line, seen from the line at `y`, `w`.
struct TorusOnSlope<'a> {
    line: &'a LinePlan,
    piece: &'a MovePiece,
    centre_radius: f64,
    centre_z: f64,
    radius: f64,
    y: f64,
    w: f64,
}

impl TorusOnSlope<'_> {
    fn span(&self, run: &Run) -> Option<CoveredSpan> {
        let (from, to) = self.reach()?;
        let (from, to) = (from.max(run.from), to.min(run.to));
        // Also false for NaN.
        (from <= to)
            .then(|| CoveredSpan { lo: self.extreme(from, to, -1.0), hi: self.extreme(from, to, 1.0) })
    }

    /// The fractions at which the section reaches the line: there the point (y - y(t), w - tip(t)) lies in the
    /// silhouette of the torus: two discs and all between them, or what two discs share if the arc is centred beyond the axis.
    fn reach(&self) -> Option<(f64, f64)> {
        let p = DVec2::new(self.y - self.line.start.y, self.w - self.piece.w[0] - self.centre_z);
        let v = DVec2::new(-self.line.way.y, -self.piece.rise());
        let beyond = self.centre_radius < 0.0;
        let (mut from, mut to) =
            if beyond { (f64::NEG_INFINITY, f64::INFINITY) } else { (f64::INFINITY, f64::NEG_INFINITY) };
        for side in [-1.0, 1.0] {
            let q = p - DVec2::X * (side * self.centre_radius);
            // |q + v t| = radius; v is not zero on a slope.
            let (a, b, c) = (v.length_squared(), q.dot(v), q.length_squared() - self.radius * self.radius);
            let root = (b * b - a * c).sqrt();
            let (first, last) = ((-b - root) / a, (-b + root) / a);
            if beyond {
                // Not a number where the disc is missed: no range then.
                from = if first <= from { from } else { first };
                to = if last >= to { to } else { last };
            } else if root >= 0.0 {
                from = from.min(first);
                to = to.max(last);
            }
        }
        // The flat sides of the stadium: |z| = radius, |y| <= centre radius.
        for side in [-1.0, 1.0] {
            let t = (side * self.radius - p.y) / v.y;
            if (p.x + v.x * t).abs() <= self.centre_radius {
                from = from.min(t);
                to = to.max(t);
            }
        }
        (from <= to).then_some((from, to))
    }

    /// Square of half the chord at a fraction, with its first and second derivative by the fraction.
    fn chord(&self, t: f64) -> (f64, f64, f64) {
        let (h, climb) = (self.centre_z - (self.w - self.piece.tip(t)), -self.piece.rise());
        // Kept a hair inside the torus, where the slopes are finite.
        let m2 =
            ((self.radius - h) * (self.radius + h)).clamp(1e-18 * self.radius * self.radius, f64::INFINITY);
        let m = m2.sqrt();
        let rho = self.centre_radius + m;
        let (r1, r2) = (h / m * climb, -self.radius * self.radius / (m2 * m) * climb * climb);
        let (d, d1) = (self.y - self.line.start.y - self.line.way.y * t, -self.line.way.y);
        ((rho - d) * (rho + d), 2.0 * (rho * r1 - d * d1), 2.0 * (r1 * r1 + rho * r2 - d1 * d1))
    }

    /// The farthest end towards `side` over a range of fractions, for a ball: its squared half chord
    /// a0 - a (t - m)^2 is a parabola, and s t + sqrt(a0 - a (t - m)^2) is greatest at t - m = s sqrt(a0 / (a (a + s^2))).
    fn extreme_of_ball(&self, from: f64, to: f64, side: f64) -> f64 {
        let (v, climb) = (self.line.way.y, self.piece.rise());
        let (d, h) = (self.y - self.line.start.y, self.w - self.piece.w[0] - self.centre_z);
        let a = v * v + climb * climb;
        let m = (d * v + h * climb) / a;
        let (dm, hm) = (d - v * m, h - climb * m);
        let a0 = (self.radius * self.radius - dm * dm - hm * hm).clamp(0.0, f64::INFINITY);
        let s = side * self.line.way.x;
        (m + s * (a0 / (a * (a + s * s))).sqrt()).clamp(from, to)
    }

    /// The farthest end towards `side` over a range of fractions.
    fn extreme(&self, from: f64, to: f64, side: f64) -> Mark {
        /// Halvings of a range down to rounding.
        const LIMIT: u32 = 60;
        // Minus the slope of the coordinate towards the side: increasing.
        let slope = |t: f64| {
            let (a, a1, a2) = self.chord(t);
            let q = a.clamp(1e-24, f64::INFINITY).sqrt();
            (-side * self.line.way.x - 0.5 * a1 / q, -0.5 * a2 / q + 0.25 * a1 * a1 / (q * q * q))
        };
        let t = if self.centre_radius == 0.0 {
            self.extreme_of_ball(from, to, side)
        } else if slope(from).0 >= 0.0 {
            from
        } else if slope(to).0 <= 0.0 {
            to
        } else {
            bracketed_newton(slope, 0.5 * (from + to), from, to, LIMIT).0
        };
        let half = self.chord(t).0.clamp(0.0, f64::INFINITY).sqrt();
        let centre = self.line.start + self.line.way * t;
        let e = DVec2::new(side * half, self.y - centre.y);
        let e = e.try_normalize().unwrap_or(DVec2::X * side);
        Mark { x: centre.x + side * half, e, t, left: self.line.way.perp_dot(e) > 0.0 }
    }
}

/// Normal of the remaining material (x, y across, w up) at an end of a span, and the face of the part.
pub(super) fn surface(
    part: &ConvexPart,
    piece: &MovePiece,
    plan: &Plan,
    w: f64,
    mark: &Mark,
    cut: Cut,
) -> (DVec3, SweptFace) {
    let e = mark.e;
    let speed = plan.speed(mark.t);
    let (forward, rise) = (e.dot(speed), piece.rise());
    let edge = |up: f64| {
        let n = DVec3::new(-rise * e.x, -rise * e.y, forward) * 1f64.copysign(forward) * up;
        if n == DVec3::ZERO { DVec3::Z * up } else { n }
    };
    match cut {
        Cut::Edge => (edge(1.0), SweptFace::Trough),
        Cut::Rim => (edge(-1.0), SweptFace::Roof),
        Cut::Flank => {
            let z = (w - piece.tip(mark.t)).clamp(part.z0, part.top);
            let (nx, nz) = part.side_normal(z);
            let foot = z < part.z1;
            (DVec3::new(-nx * e.x, -nx * e.y, -nz), SweptFace::side(foot, piece.station(mark.t), mark.left))
        }
    }
}
