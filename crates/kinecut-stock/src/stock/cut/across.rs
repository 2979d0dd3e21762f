//! Lines across the tool axis: where a disc on its way along a plan path covers a line y = const.
//!
//! A disc on a line covers a stadium, on an arc a sector of a ring with a disc at either end. All crossings are in
//! closed form.

use glam::DVec2;

use super::plan::{ArcPlan, LinePlan, Plan};

/// An end of a covered span.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Mark {
    /// Coordinate along the line.
    pub(super) x: f64,
    /// Unit vector from the centre of the disc that ends here to the end.
    pub(super) e: DVec2,
    /// Fraction of the path of that disc; for the wall along an arc only that it is between the ends.
    pub(super) t: f64,
    /// The end lies left of the path.
    pub(super) left: bool,
}

/// A covered span of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct CoveredSpan {
    pub(super) lo: Mark,
    pub(super) hi: Mark,
}

/// The covered spans of a line, at most [`Spans::MOST`], sorted and disjoint.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spans {
    list: [CoveredSpan; Spans::MOST],
    count: usize,
}

/// Spans nearer than this are one [mm]: the pieces of a ring overlap, and where they only touch this bridges
/// rounding; it is a hundredth of an end point's rounding.
const TOUCHING: f64 = 1e-7;

impl Spans {
    /// A ring sector and a line meet in two spans, and each end disc in one.
    const MOST: usize = 4;

    /// The spans in order.
    pub(super) fn as_slice(&self) -> &[CoveredSpan] {
        &self.list[..self.count]
    }

    /// Adds a span, joined with those that it meets.
    fn add(&mut self, mut new: CoveredSpan) {
        let mut kept = 0;
        for i in 0..self.count {
            let old = self.list[i];
            if old.hi.x < new.lo.x - TOUCHING || new.hi.x < old.lo.x - TOUCHING {
                self.list[kept] = old;
                kept += 1;
                continue;
            }
            if old.lo.x < new.lo.x {
                new.lo = old.lo;
            }
            if old.hi.x > new.hi.x {
                new.hi = old.hi;
            }
        }
        self.list[kept] = new;
        self.count = kept + 1;
    }
}

/// Spans of the line at `y` that a disc of radius `rho` covers on its way along a path [mm].
pub(super) fn spans(plan: &Plan, rho: f64, y: f64) -> Spans {
    let mut spans = Spans::default();
    match plan {
        Plan::Dot(p) => {
            if let Some(span) = disc(*p, rho, y, 0.0, DVec2::X) {
                spans.add(span);
            }
        }
        Plan::Line(line) => {
            if let (Some(lo), Some(hi)) = (extreme(line, rho, y, -1.0), extreme(line, rho, y, 1.0)) {
                spans.add(CoveredSpan { lo, hi });
            }
        }
        Plan::Arc(arc) => ring(arc, rho, y, &mut spans),
    }
    spans
}

/// Span of a disc at rest at the fraction `t` of a path of some direction.
pub(super) fn disc(centre: DVec2, rho: f64, y: f64, t: f64, way: DVec2) -> Option<CoveredSpan> {
    let d = y - centre.y;
    let half = ((rho - d) * (rho + d)).sqrt();
    // NaN when the disc does not reach.
    (half >= 0.0 && rho > 0.0).then(|| {
        let mark = |sign: f64| {
            let e = DVec2::new(sign * half, d) / rho;
            Mark { x: centre.x + sign * half, e, t, left: way.perp_dot(e) > 0.0 }
        };
        CoveredSpan { lo: mark(-1.0), hi: mark(1.0) }
    })
}

/// The end of the stadium towards `side` (+1 or -1).
fn extreme(line: &LinePlan, rho: f64, y: f64, side: f64) -> Option<Mark> {
    let w = line.way;
    let t = if w.y == 0.0 {
        if w.x * side > 0.0 { 1.0 } else { 0.0 }
    } else {
        // The wall's normal is square to the way and points to the side.
        let e = DVec2::new(w.y.abs(), -w.x.copysign(w.x * w.y)) * side;
        ((y - rho * e.y / line.length - line.start.y) / w.y).clamp(0.0, 1.0)
    };
    let centre = line.start + w * t;
    let d = y - centre.y;
    let half = ((rho - d) * (rho + d)).sqrt();
    (half >= 0.0 && rho > 0.0).then(|| {
        let e = DVec2::new(side * half, d) / rho;
        Mark { x: centre.x + side * half, e, t, left: w.perp_dot(e) > 0.0 }
    })
}

/// The spans of a ring sector with its end discs.
fn ring(arc: &ArcPlan, rho: f64, y: f64, spans: &mut Spans) {
    let d = y - arc.centre.y;
    let (outer, inner) = (arc.radius + rho, arc.radius - rho);
    let reach = ((outer - d) * (outer + d)).sqrt();
    if !(reach >= 0.0 && rho > 0.0) {
        return;
    }
    let forward = arc.sweep >= 0.0;
    for (v, is_start) in [(arc.first, forward), (arc.last, !forward)] {
        let way = v.perp() * arc.sweep;
        if let Some(span) = disc(arc.centre + v * arc.radius, rho, y, if is_start { 0.0 } else { 1.0 }, way) {
            spans.add(span);
        }
    }
    // Crossings with the two circles; left of a counter-clockwise path is inside.
    let wall = |x: f64, radius: f64, is_outer: bool| {
        let e = DVec2::new(x, d) / if is_outer { radius } else { -radius };
        Mark { x: arc.centre.x + x, e, t: 0.5, left: is_outer != forward }
    };
    let hole = if inner > 0.0 { ((inner - d) * (inner + d)).sqrt() } else { f64::NAN };
    let Some((from, to)) = sector(arc, d) else { return };
    let mut clipped = |lo: Mark, hi: Mark| {
        // A cut by the sector's side lies inside the end disc there.
        let inside = |x: f64| Mark { x: arc.centre.x + x, e: DVec2::X, t: 0.5, left: false };
        let lo = if arc.centre.x + from > lo.x { inside(from) } else { lo };
        let hi = if arc.centre.x + to < hi.x { inside(to) } else { hi };
        if lo.x < hi.x {
            spans.add(CoveredSpan { lo, hi });
        }
    };
    let (left, right) = (wall(-reach, outer, true), wall(reach, outer, true));
    if hole > 0.0 {
        clipped(left, wall(-hole, inner, false));
        clipped(wall(hole, inner, false), right);
    } else {
        clipped(left, right);
    }
}

/// The part of a line at the height `d` over the centre that lies in the sector of an arc.
fn sector(arc: &ArcPlan, d: f64) -> Option<(f64, f64)> {
    let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
    // first x v >= 0 and v x last >= 0, each a + b x >= 0.
    for (a, b) in [(arc.first.x * d, -arc.first.y), (-arc.last.x * d, arc.last.y)] {
        if b > 0.0 {
            from = from.max(-a / b);
        } else if b < 0.0 {
            to = to.min(-a / b);
        } else if a < 0.0 {
            return None;
        }
    }
    (from < to).then_some((from, to))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn plans() -> impl Strategy<Value = Plan> {
        let point = || (-9.0..9.0, -9.0..9.0).prop_map(|(x, y): (f64, f64)| DVec2::new(x, y));
        let line = (point(), point()).prop_map(|(a, b)| Plan::line(a, b));
        let level = (point(), -9.0..9.0).prop_map(|(a, d): (DVec2, f64)| Plan::line(a, a + DVec2::X * d));
        let angle = prop_oneof![-4.0..4.0, Just(0.0), Just(PI / 2.0), Just(PI), Just(-PI / 2.0)];
        let sweep = prop_oneof![-PI..PI, Just(PI), Just(-PI), Just(PI / 2.0)];
        let arc = (point(), 0.5..8.0, angle, sweep)
            .prop_map(|(c, r, a, s): (DVec2, f64, f64, f64)| Plan::Arc(ArcPlan::new(c, r, a, s)));
        prop_oneof![point().prop_map(Plan::Dot), line, level, arc.clone(), arc]
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(400))]
        /// A point of the line is covered when a dense sample of the path comes near enough.
        #[test]
        fn spans_are_the_union_of_discs(plan in plans(), rho in 0.3..7.0, y in -15.0..15.0) {
            let n = 3000;
            let path: Vec<DVec2> = (0..=n).map(|i| plan.point(f64::from(i) / f64::from(n))).collect();
            let found = spans(&plan, rho, y);
            let found = found.as_slice();
            for i in 0..400 {
                let p = DVec2::new(-20.0 + 0.1 * f64::from(i) + 0.037, y);
                let near = path.iter().map(|c| c.distance(p)).fold(f64::INFINITY, f64::min);
                let inside = found.iter().any(|s| s.lo.x <= p.x && p.x <= s.hi.x);
                prop_assert!(inside == (near <= rho) || (near - rho).abs() < 1e-3, "{} {} {:?}", p, near, found);
            }
            for mark in found.iter().flat_map(|s| [s.lo, s.hi]) {
                let p = DVec2::new(mark.x, y);
                let c = p - mark.e * rho;
                prop_assert!((mark.e.length() - 1.0).abs() < 1e-9);
                let t = plan.nearest(c);
                prop_assert!(plan.point(t).distance(c) < 1e-6, "{:?} is no end of {:?}", mark, plan);
                if t > 1e-6 && t < 1.0 - 1e-6 {
                    prop_assert_eq!(mark.left, plan.speed(t).perp_dot(mark.e) > 0.0);
                }
                if mark.t == 0.0 || mark.t == 1.0 {
                    prop_assert!(plan.point(mark.t).distance(c) < 1e-9);
                }
            }
        }
    }
}
