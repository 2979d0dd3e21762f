//! An involute as a chain of tangent circular arcs, for controls without involutes.
//!
//! Method: the involute of a regular polygon of side `r D` about the *same* base centre is a chain of tangent
//! arcs of equal angle `D` whose radii are `rho` at mid-angle; among equal-angle chains it needs the fewest arcs
//! for a tolerance `eps`: `D = (72 sqrt(3) eps / r)^(1/3)`. Its joints lie shifted along the path by about
//! `r D^2 / 12`, so the first and the last piece are a biarc from or to the exact end. In all at most four
//! arcs more than the equal-angle count ([`arcs_needed`]); two more are the most ever seen.
//!
//! Error: with `u` the outward normal and `q` the support function about the base centre, involute and arc at
//! equal tangent angle differ by `e = q_arc - q_inv` along the normal. Both are convex, so the true distance of
//! each arc point from the involute is at most the largest `|e|`, and `e` has its extremes at the ends of an arc
//! and where `(c - C) . t = r`: a closed form, evaluated for every arc that is not a copy of another.
//!
//! Notation: `C` base centre, `r` base radius, `t` tangent, `u` outward normal of a counter-clockwise curve
//! (`u = -n`), `rho` radius of curvature, `D` angle of an inner arc, `A` angle of an end biarc.

use std::f64::consts::PI;

use glam::DVec2;

use super::InvoluteRecord;
use crate::base::{Code, Finding, Result};

/// Angle of an end biarc in inner arcs, and the share of it that the arc at the free end turns. The other arc has
/// the radius that an inner arc would have there and turns 0.98 of its angle; tangency in the exact end then
/// leaves one unknown: with angles in units of `D`, `m^3/12 + m y'/2 = y` for the share `m` of the first arc,
/// where `y = s/12 - s^2/4 + s^3/6`, `y' = -1/12 + s/2 - s^2/2`, `s = 0.98`; `m = 0.64178`. Its error is then
/// 0.73 of an inner arc's. (At `s = 1` it would be 1.09, at `s = 0.94` the radius of the first arc nears zero.)
const END_ANGLE: f64 = 1.621_779_978_642;
/// See [`END_ANGLE`].
const END_SHARE: f64 = 0.395_725_676_167;
/// Relative difference of the end radii below which a record is a circle: rounding of radii, not shape.
const CIRCLE: f64 = 1e-13;
/// Most arcs a chain may have: a tolerance that asks for more is a slip of units, and would fill the memory.
const MOST_ARCS: f64 = 5e6;

/// A circular arc in the plane, or a straight piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarArc {
    /// First point [mm].
    pub start: DVec2,
    /// Last point [mm], bit for bit the start of the next arc of a chain.
    pub end: DVec2,
    /// Centre [mm]; the start point when straight.
    pub centre: DVec2,
    /// Angle turned, positive counter-clockwise [rad]; zero for a straight piece.
    pub sweep: f64,
}

impl PlanarArc {
    /// True for a straight piece.
    pub fn is_line(&self) -> bool {
        self.sweep == 0.0
    }

    /// Radius [mm]; zero when straight.
    pub fn radius(&self) -> f64 {
        (self.start - self.centre).length()
    }

    /// Arc length [mm].
    pub fn length(&self) -> f64 {
        if self.is_line() { self.start.distance(self.end) } else { self.radius() * self.sweep.abs() }
    }

    /// The point at the fraction `f` of its length [mm].
    pub fn point(&self, f: f64) -> DVec2 {
        if self.is_line() {
            return self.start.lerp(self.end, f);
        }
        self.centre + DVec2::from_angle(self.sweep * f).rotate(self.start - self.centre)
    }

    fn reversed(self) -> PlanarArc {
        PlanarArc { start: self.end, end: self.start, sweep: -self.sweep, ..self }
    }

    fn mirrored(self) -> PlanarArc {
        let m = |p: DVec2| DVec2::new(-p.x, p.y);
        PlanarArc { start: m(self.start), end: m(self.end), centre: m(self.centre), sweep: -self.sweep }
    }
}

/// Largest normal deviation of an inner arc of angle `angle` from the involute of base radius `r` [mm].
fn inner_error(r: f64, angle: f64) -> f64 {
    let half = 0.5 * angle;
    if half < SERIES {
        // r |x - (D/2) sin x / sin(D/2)| with cos x = sin(D/2)/(D/2): its first term is r D^3 / (72 sqrt 3).
        return r * angle.powi(3) / (72.0 * 3f64.sqrt()) * (1.0 + half * half / 6.0);
    }
    let x = (half.sin() / half).acos();
    r * (x - half * x.sin() / half.sin()).abs()
}

/// Below this half angle the closed form loses digits (it is a difference of order D^3) and the series is used
/// with a positive second term that never makes the error too small.
const SERIES: f64 = 1e-3;

/// Equal-angle arcs with which an involute of base radius `r` [mm] and turned angle `turn` [rad] is met within
/// `eps` [mm], ends not counted: `ceil(turn (r / (72 sqrt 3 eps))^(1/3))`, corrected by the exact error.
///
/// ```
/// # use kinecut_geom as kinecut;
/// let r = 79.0 / (40.0 * std::f64::consts::PI);
/// assert_eq!(kinecut::geom::arcs_needed(r, 40.0 * std::f64::consts::PI, 0.001), 217);
/// ```
pub fn arcs_needed(r: f64, turn: f64, eps: f64) -> u64 {
    let (r, turn) = (r.abs(), turn.abs());
    let mut n = (turn * (r / (72.0 * 3f64.sqrt() * eps)).cbrt()).ceil().clamp(1.0, f64::MAX);
    while n < MOST_ARCS && (turn / n >= PI || inner_error(r, turn / n) > eps) {
        n += 1.0;
    }
    // Saturating: counts beyond the budget are refused by the chain.
    n as u64
}

/// The record as a chain of tangent arcs that leaves it by at most `eps` [mm] and ends exactly in its ends: at
/// most four arcs more than [`arcs_needed`]. A circle is one arc, a line one straight piece, a record of no
/// length an empty chain.
///
/// The tangent is continuous, also where the chain meets what came before and what follows.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::{InvoluteRecord, arc_chain};
/// let spiral = InvoluteRecord::new(4963.71639267187, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
/// assert!(arc_chain(&spiral, 0.001).unwrap().len() <= 217 + 4);
/// ```
///
/// # Errors
/// `KC0801` when `eps` is not positive, or so small that the chain would need millions of arcs.
pub fn arc_chain(record: &InvoluteRecord, eps: f64) -> Result<Vec<PlanarArc>> {
    if !(eps > 0.0 && eps.is_finite()) {
        return Err(Finding::error(Code::GEOMETRY, "the tolerance of an arc chain must be positive")
            .value_mm(eps)
            .bound_mm(0.0)
            .into());
    }
    if record.length() == 0.0 {
        return Ok(Vec::new());
    }
    let (start, end) = (record.start(), record.end());
    if record.is_line() {
        return Ok(vec![PlanarArc { start, end, centre: start, sweep: 0.0 }]);
    }
    let (rn, rk) = (record.start_radius(), record.end_radius());
    if (rk - rn).abs() <= CIRCLE * rn.abs() {
        let sweep = record.turn(record.length());
        return Ok(vec![PlanarArc { start, end, centre: record.base_centre(), sweep }]);
    }
    // Canonical form: counter-clockwise and away from the base circle.
    let inward = rk.abs() < rn.abs();
    let outward = if inward { record.reversed() } else { *record };
    let clockwise = outward.sense() < 0.0;
    let canonical = if clockwise { outward.mirrored() } else { outward };
    let mut arcs = Outward::new(&canonical).chain(eps)?;
    if clockwise {
        arcs.iter_mut().for_each(|a| *a = a.mirrored());
    }
    if inward {
        arcs.reverse();
        arcs.iter_mut().for_each(|a| *a = a.reversed());
    }
    // The reversed record's ends are computed; the given ones are the truth.
    if let Some(first) = arcs.first_mut() {
        first.start = start;
    }
    if let Some(last) = arcs.last_mut() {
        last.end = end;
    }
    Ok(arcs)
}

/// A counter-clockwise involute that leads away from its base circle, by turned angle from its start.
struct Outward {
    centre: DVec2,
    r: f64,
    /// Tangent angle and radius of curvature at the start.
    angle: f64,
    rho: f64,
    turn: f64,
    start: DVec2,
    end: DVec2,
}

impl Outward {
    fn new(record: &InvoluteRecord) -> Outward {
        Outward {
            centre: record.base_centre(),
            r: record.base_radius(),
            angle: record.start_angle(),
            rho: record.start_radius(),
            turn: record.turn(record.length()),
            start: record.start(),
            end: record.end(),
        }
    }

    fn tangent(&self, turned: f64) -> DVec2 {
        DVec2::from_angle(self.angle + turned)
    }

    fn rho(&self, turned: f64) -> f64 {
        self.rho + self.r * turned
    }

    /// The joint of the polygon's involute with sides `r D` (of the involute itself for `D = 0`).
    fn joint(&self, turned: f64, step: f64) -> DVec2 {
        let t = self.tangent(turned);
        let half = 0.5 * step;
        let apothem = if half == 0.0 { self.r } else { self.r * half / half.tan() };
        self.centre - t.perp() * self.rho(turned) + t * apothem
    }

    /// True if an arc that turns from `a` to `b` [rad] leaves the involute by at most `eps` [mm].
    fn holds(&self, arc: &PlanarArc, a: f64, b: f64, eps: f64) -> bool {
        let off = arc.centre - self.centre;
        let error = |w: f64| arc.radius() - self.rho(w) - off.dot(self.tangent(w).perp());
        let ends = error(a).abs().max(error(b).abs());
        // Extremes where off . t = r.
        let reach = self.r / off.length();
        let inner = if reach < 1.0 { reach.acos() } else { 0.0 };
        [inner, -inner].into_iter().fold(ends, |most, side| {
            let w = crate::num::angle::wrap_positive(off.to_angle() + side - self.angle - a) + a;
            if w < b { most.max(error(w).abs()) } else { most }
        }) <= eps
    }

    /// The biarc between two points with tangents at the turned angles `a`, `middle` and `b`, if both arcs turn
    /// forward and stay within `eps`. The two radii solve `R1 w1 + R2 w2 = to - from`, with `w` the integral of the
    /// unit tangent over an arc.
    fn biarc(
        &self,
        (from, a): (DVec2, f64),
        middle: f64,
        (to, b): (DVec2, f64),
        eps: f64,
    ) -> Option<[PlanarArc; 2]> {
        let v = to - from;
        let chord = |a: f64, b: f64| self.tangent(0.5 * (a + b)) * (2.0 * (0.5 * (b - a)).sin());
        let (w1, w2) = (chord(a, middle), chord(middle, b));
        let area = w1.perp_dot(w2);
        let (r1, r2) = (v.perp_dot(w2) / area, w1.perp_dot(v) / area);
        if !(r1 > 0.0 && r2 > 0.0 && r1.is_finite() && r2.is_finite()) {
            return None;
        }
        let joint = from + w1 * r1;
        let arc = |start: DVec2, end: DVec2, t: DVec2, radius: f64, sweep: f64| PlanarArc {
            start,
            end,
            centre: start + t.perp() * radius,
            sweep,
        };
        let first = arc(from, joint, self.tangent(a), r1, middle - a);
        let second = arc(joint, to, self.tangent(middle), r2, b - middle);
        let held = first.sweep < PI
            && second.sweep < PI
            && self.holds(&first, a, middle, eps)
            && self.holds(&second, middle, b, eps);
        held.then_some([first, second])
    }

    fn chain(&self, eps: f64) -> Result<Vec<PlanarArc>> {
        let (start, end) = ((self.start, 0.0), (self.end, self.turn));
        if let Some(pair) = self.biarc(start, 0.5 * self.turn, end, eps) {
            return Ok(pair.to_vec());
        }
        let share = self.turn * (self.r / (72.0 * 3f64.sqrt() * eps)).cbrt() - 2.0 * END_ANGLE;
        let mut inner = share.ceil().clamp(0.0, f64::MAX);
        while inner < MOST_ARCS {
            if let Some(arcs) = self.with_inner(inner, eps) {
                return Ok(arcs);
            }
            inner += 1.0;
        }
        Err(Finding::error(Code::GEOMETRY, "an involute would need millions of arcs")
            .value_mm(eps)
            .help("use a larger tolerance")
            .into())
    }

    /// The chain with so many inner arcs, if it stays within `eps`.
    fn with_inner(&self, inner: f64, eps: f64) -> Option<Vec<PlanarArc>> {
        // Without inner arcs the biarcs meet on the involute itself; then equal angles are best.
        let (step, ends, part) = if inner == 0.0 {
            (0.0, 0.5 * self.turn, 0.5)
        } else {
            let step = self.turn / (inner + 2.0 * END_ANGLE);
            (step, END_ANGLE * step, END_SHARE)
        };
        if step >= PI || inner_error(self.r, step) > eps {
            return None;
        }
        let (a, b) = (ends, self.turn - ends);
        let head = self.biarc((self.start, 0.0), part * ends, (self.joint(a, step), a), eps)?;
        let tail =
            self.biarc((self.joint(b, step), b), self.turn - part * ends, (self.end, self.turn), eps)?;
        let count = inner as usize;
        let mut arcs = Vec::with_capacity(count + 4);
        arcs.extend(head);
        let (half, reach) =
            (0.5 * step, if step > 0.0 { self.r * 0.5 * step / (0.5 * step).sin() } else { self.r });
        let mut from = head[1].end;
        for i in 0..count {
            let a = ends + step * i as f64;
            // The tail starts bit for bit where the last inner arc ends.
            let to = if i + 1 == count { tail[0].start } else { self.joint(a + step, step) };
            let centre = self.centre + self.tangent(a + half) * reach;
            arcs.push(PlanarArc { start: from, end: to, centre, sweep: step });
            from = to;
        }
        arcs.extend(tail);
        Some(arcs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Distance from a point to the involute: its tangent points seen from the point are where the normal passes
    /// through it; found by bisection on the record itself, nothing of the chain is used.
    fn distance(record: &InvoluteRecord, p: DVec2, guess: f64, window: f64) -> f64 {
        let f = |s: f64| {
            let j = record.at(s);
            (p - j.p).dot(j.d1)
        };
        let (mut lo, mut hi) = ((guess - window).max(0.0), (guess + window).min(record.length()));
        for _ in 0..60 {
            let m = 0.5 * (lo + hi);
            if f(m) > 0.0 { lo = m } else { hi = m }
        }
        (record.at(0.5 * (lo + hi)).p - p).length()
    }

    /// Checks joints, tangents and the true deviation; returns the count.
    fn verify(record: &InvoluteRecord, eps: f64) -> usize {
        let arcs = arc_chain(record, eps).unwrap();
        let size = record.start_radius().abs().max(record.end_radius().abs());
        let noise = 1e-11 * (size + record.start().length());
        assert_eq!(arcs[0].start, record.start());
        assert_eq!(arcs[arcs.len() - 1].end, record.end());
        let tangent = |a: &PlanarArc, at_end: bool| {
            let p = if at_end { a.end } else { a.start };
            (p - a.centre).normalize_or_zero().perp() * a.sweep.signum()
        };
        // An arc shorter than the noise has no direction to speak of.
        let bend = |a: &PlanarArc, b: &PlanarArc| 4.0 * noise * (1.0 / a.radius() + 1.0 / b.radius());
        for w in arcs.windows(2) {
            assert_eq!(w[0].end, w[1].start);
            let angle = (tangent(&w[0], true) - tangent(&w[1], false)).length();
            assert!(angle < bend(&w[0], &w[1]), "break {angle} {w:?}");
        }
        for (arc, s, at_end) in [(&arcs[0], 0.0, false), (&arcs[arcs.len() - 1], record.length(), true)] {
            let d1 = record.at(s).d1;
            assert!((tangent(arc, at_end) - d1).length() < bend(arc, arc), "{arc:?} {d1}");
        }
        let total = record.turn(record.length());
        let mut turned = 0.0;
        for (i, arc) in arcs.iter().enumerate() {
            assert!((arc.point(1.0) - arc.end).length() < noise, "{arc:?}");
            assert!(arc.sweep * total > 0.0);
            // Both ends wholly, of a long middle every so many: the inner arcs are copies.
            if i > 5 && i + 6 < arcs.len() && i % (1 + arcs.len() / 40) != 0 {
                turned += arc.sweep;
                continue;
            }
            for i in 0..=12 {
                let f = f64::from(i) / 12.0;
                let s = record.length_at_turn(turned + arc.sweep * f);
                let window = (record.length_at_turn(turned + arc.sweep * (f + 0.6)) - s)
                    .abs()
                    .max(
                        (record.length_at_turn((turned + arc.sweep * (f - 0.6)).abs().min(total.abs())) - s)
                            .abs(),
                    )
                    .max(10.0 * eps);
                let d = distance(record, arc.point(f), s, window);
                assert!(d <= eps * (1.0 + 1e-9) + noise, "deviation {d} > {eps}: {arc:?} of {record:?}");
            }
            turned += arc.sweep;
        }
        assert!((turned - total).abs() < 1e-9, "{turned} {total}");
        arcs.len()
    }

    #[test]
    fn the_papers_spiral_needs_the_count_of_the_closed_form() {
        let spiral = InvoluteRecord::new(20.0 * 79.0 * PI, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
        for (eps, arcs) in [(0.01, 102), (0.001, 217), (0.0001, 465)] {
            assert_eq!(arcs_needed(spiral.base_radius(), 40.0 * PI, eps), arcs);
            let n = verify(&spiral, eps);
            assert!((arcs..=arcs + 4).contains(&(n as u64)), "{n} for {arcs}");
        }
    }

    #[test]
    fn the_deviation_bound_is_reached_not_wasted() {
        let spiral = InvoluteRecord::new(20.0 * 79.0 * PI, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
        let arcs = arc_chain(&spiral, 1e-3).unwrap();
        let arc = arcs[arcs.len() / 2];
        let turned: f64 = arcs[..arcs.len() / 2].iter().map(|a| a.sweep).sum();
        let most = (0..=200).fold(0f64, |m, i| {
            let f = f64::from(i) / 200.0;
            m.max(distance(&spiral, arc.point(f), spiral.length_at_turn(turned + arc.sweep * f), 30.0))
        });
        assert!(most > 0.95e-3 && most <= 1e-3, "{most}");
    }

    #[test]
    fn circles_lines_and_nothing() {
        let circle = InvoluteRecord::new(20.0 * PI, [3.0, -10.0], 0.0, 10.0, 10.0).unwrap();
        let arcs = arc_chain(&circle, 1e-3).unwrap();
        assert_eq!(arcs.len(), 1);
        assert!(
            (arcs[0].sweep - 2.0 * PI).abs() < 1e-14
                && (arcs[0].centre - DVec2::new(3.0, 0.0)).length() < 1e-14
        );
        let clockwise = arc_chain(&circle.mirrored(), 1e-3).unwrap();
        assert!((clockwise[0].sweep + 2.0 * PI).abs() < 1e-14);
        let line = InvoluteRecord::new(5.0, [1.0, 2.0], 0.0, f64::INFINITY, f64::INFINITY).unwrap();
        let arcs = arc_chain(&line, 1e-3).unwrap();
        assert!(arcs.len() == 1 && arcs[0].is_line() && arcs[0].point(0.5) == DVec2::new(3.5, 2.0));
        assert!(
            arc_chain(&InvoluteRecord::new(0.0, [1.0, 2.0], 0.0, 1.0, 1.0).unwrap(), 1e-3)
                .unwrap()
                .is_empty()
        );
        for eps in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(arc_chain(&circle, eps).unwrap_err().code(), Code::GEOMETRY);
        }
        let huge = InvoluteRecord::new(1e6, [0.0, 0.0], 0.0, 0.0, 100.0).unwrap();
        assert_eq!(arc_chain(&huge, 1e-18).unwrap_err().code(), Code::GEOMETRY);
    }

    #[test]
    fn a_long_coarse_spiral_from_just_outside_its_cusp_needs_three_more() {
        let (r, turned, eps) = (0.08492305193837132, 80.27403224994812, 10f64.powf(-1.5375317959730908));
        let record =
            InvoluteRecord::new(0.5 * r * turned * turned, [4.0, -3.0], 0.0, 0.0, r * turned).unwrap();
        let (n, needed) = (verify(&record, eps) as u64, arcs_needed(r, turned, eps));
        assert!(n <= needed + 4, "{n} arcs, {needed} needed");
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn any_involute_is_met_within_the_tolerance(
            r in 0.02..10.0f64, from in 0.0..40.0f64, turned in 0.01..90.0f64, log_eps in -5.0..-1.5f64,
            angle in -7.0..7.0f64, cw: bool, inward: bool, cusp: bool,
        ) {
            let a = if cusp { 0.0 } else { from };
            let b = a + turned;
            let eps = 10f64.powf(log_eps);
            let plain = InvoluteRecord::new(0.5 * r * (b - a) * (b + a), [4.0, -3.0], angle, r * a, r * b).unwrap();
            let record = if cw { plain.mirrored() } else { plain };
            let record = if inward { record.reversed() } else { record };
            let n = verify(&record, eps) as u64;
            let needed = arcs_needed(r, turned, eps);
            prop_assert!(n <= needed + 4, "{n} arcs, {needed} needed");
        }

        #[test]
        fn nearly_circular_records_are_served(
            growth in -10.0..0.0f64, turned in 0.1..20.0f64, log_eps in -5.0..-1.0f64,
        ) {
            let (rn, rk) = (40.0, 40.0 + 10f64.powf(growth));
            let record = InvoluteRecord::new(0.5 * (rn + rk) * turned, [0.0, 0.0], 1.0, rn, rk).unwrap();
            let n = verify(&record, 10f64.powf(log_eps)) as u64;
            prop_assert!(n <= arcs_needed(record.base_radius(), turned, 10f64.powf(log_eps)) + 4);
        }
    }
}
