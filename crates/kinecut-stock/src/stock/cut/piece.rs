//! Moves cut into pieces that the kernels know: point, line, arc of at most half a turn, each with a constant rise.
//!
//! Lines, arcs and helices about the tool axis are exact. An involute becomes arcs through three of its points at
//! equal turns; each arc is checked where it is farthest off, and halved until it is within the tolerance. A cubic becomes
//! tangent arcs, measured alike. Any other curve becomes a polyline. By the pose-error principle the swept body is off by no more than the path.
//!
//! Source: the arc through start, middle and end of a curve of curvature slope r / rho^3 leaves it by
//! r D^3 / (72 sqrt 3) over the turn D, most at the fractions 1/2 -+ 1/(2 sqrt 3).

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::axis::ToolFrame;
use super::face::Station;
use super::plan::{ArcPlan, Plan};
use crate::geom::{CubicSpan, Curve, CurveKind, InvoluteRecord, PlanarArc, Rigid};
use crate::num::angle::wrap;

/// One piece of a move, in the frame of its tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MovePiece {
    /// Path across the tool axis.
    pub(super) plan: Plan,
    /// Height of the tip at its start and end [mm].
    pub(super) w: [f64; 2],
    /// Fractions of the move at its start and end.
    pub(super) fractions: [f64; 2],
}

impl MovePiece {
    /// Height of the tip at a fraction of the piece.
    pub(super) fn tip(&self, t: f64) -> f64 {
        self.w[0] + (self.w[1] - self.w[0]) * t
    }

    /// The end of the move at which a standing tool is lowest.
    pub(super) fn lowest(&self) -> Station {
        self.station(if self.rise() < 0.0 { 1.0 } else { 0.0 })
    }

    /// Rise from start to end.
    pub(super) fn rise(&self) -> f64 {
        self.w[1] - self.w[0]
    }
}

/// Sideways error [mm] up to which an axis counts as parallel to the tool axis: a tenth of an end point's rounding.
const PARALLEL: f64 = 1e-6;

/// The pieces of a curve, and how far they may leave it [mm].
pub(super) fn pieces(curve: &Curve, frame: &ToolFrame, tolerance: f64) -> (Vec<MovePiece>, f64) {
    let local = curve.moved(&frame.rotation());
    let mut list = Vec::new();
    match local.kind() {
        CurveKind::Line(line) => {
            let plan = Plan::line(line.start.truncate(), line.end.truncate());
            list.push(MovePiece { plan, w: [line.start.z, line.end.z], fractions: [0.0, 1.0] });
        }
        CurveKind::Arc(arc)
            if arc.axis.truncate().length() * (2.0 * arc.radius() + arc.rise.abs()) <= PARALLEL =>
        {
            let upright = 1f64.copysign(arc.axis.z);
            turns(&mut list, arc.start, arc.centre.truncate(), arc.sweep * upright, arc.rise * upright);
        }
        CurveKind::Involute { record, frame, rise }
            if frame.vector(DVec3::Z).truncate().length() * (record.length() + rise.abs()) <= PARALLEL =>
        {
            let involute = Involute { record: &record, frame: &frame, rise, tolerance };
            return (involute.pieces(), tolerance);
        }
        CurveKind::Bezier { span, frame }
            if frame.vector(DVec3::Z).truncate().length() * span.length() <= PARALLEL
                && cubic(&mut list, &span, &frame, tolerance) =>
        {
            return (list, tolerance);
        }
        _ => {
            let points = local.polyline(tolerance);
            let n = (points.len() - 1).max(1) as f64;
            for (i, ends) in points.windows(2).enumerate() {
                let plan = Plan::line(ends[0].truncate(), ends[1].truncate());
                let fractions = [i as f64 / n, (i + 1) as f64 / n];
                list.push(MovePiece { plan, w: [ends[0].z, ends[1].z], fractions });
            }
            return (list, tolerance);
        }
    }
    (list, 0.0)
}

/// Pieces of a cubic; false if no arcs are within the tolerance (at a cusp).
fn cubic(list: &mut Vec<MovePiece>, span: &CubicSpan, frame: &Rigid, tolerance: f64) -> bool {
    let Ok(arcs) = span.arcs(tolerance) else { return false };
    let upright = 1f64.copysign(frame.vector(DVec3::Z).z);
    let length: f64 = arcs.iter().map(PlanarArc::length).sum();
    let mut done = 0.0;
    for arc in &arcs {
        let [start, centre, end] = [arc.start, arc.centre, arc.end].map(|p| frame.point(p.extend(0.0)));
        let from = list.len();
        if arc.is_line() {
            let plan = Plan::line(start.truncate(), end.truncate());
            list.push(MovePiece { plan, w: [start.z, end.z], fractions: [0.0, 1.0] });
        } else {
            turns(list, start, centre.truncate(), arc.sweep * upright, 0.0);
        }
        let share = arc.length() / length;
        for piece in &mut list[from..] {
            piece.fractions = piece.fractions.map(|f| done + share * f);
        }
        done += share;
    }
    if let Some(last) = list.last_mut() {
        last.fractions[1] = 1.0;
    }
    true
}

/// Pieces of an arc or helix of at most half a turn; a flat arc of more than a turn is one full circle.
fn turns(list: &mut Vec<MovePiece>, start: DVec3, centre: DVec2, sweep: f64, rise: f64) {
    let sweep = if rise == 0.0 { sweep.clamp(-TAU, TAU) } else { sweep };
    let v = start.truncate() - centre;
    let (radius, angle) = (v.length(), v.to_angle());
    // Rounding must not make three pieces of a full circle.
    let n = (sweep.abs() / PI - 1e-9).ceil().clamp(1.0, 1e9);
    for i in 0..n as u64 {
        let fractions = [i as f64 / n, (i + 1) as f64 / n];
        let w = fractions.map(|f| start.z + rise * f);
        let plan = match sweep {
            0.0 => Plan::Dot(start.truncate()),
            _ => Plan::Arc(ArcPlan::new(centre, radius, angle + sweep * fractions[0], sweep / n)),
        };
        list.push(MovePiece { plan, w, fractions });
    }
}

/// An involute in a plane across the tool axis.
struct Involute<'a> {
    record: &'a InvoluteRecord,
    frame: &'a Rigid,
    rise: f64,
    tolerance: f64,
}

impl Involute<'_> {
    fn pieces(&self) -> Vec<MovePiece> {
        /// Largest turn of an arc [rad]: beyond it the error formula is no longer a good guess.
        const MOST: f64 = 0.5;
        let record = self.record;
        let turn = record.turn(record.length()).abs();
        let mut list = Vec::new();
        if record.is_line() || turn == 0.0 {
            self.push_line(&mut list, 0.0, record.length());
            return list;
        }
        let base = record.base_radius().abs();
        // Aimed below the bound at which an arc is halved.
        let step = (72.0 * 3f64.sqrt() * 0.85 * self.tolerance / base).cbrt().clamp(1e-6, MOST);
        let n = (turn / step).ceil().clamp(1.0, 1e9);
        for i in 0..n as u64 {
            self.arc(&mut list, turn * (i as f64 / n), turn * ((i + 1) as f64 / n), 0);
        }
        list
    }

    /// The curve at an arc length of the record.
    fn at(&self, s: f64) -> DVec3 {
        let length = self.record.length();
        let p = self.record.at(s).p;
        let z = if length > 0.0 { self.rise * s / length } else { 0.0 };
        self.frame.point(DVec3::new(p.x, p.y, z))
    }

    fn push_line(&self, list: &mut Vec<MovePiece>, s0: f64, s1: f64) {
        let (a, b) = (self.at(s0), self.at(s1));
        let length = self.record.length();
        let fractions = if length > 0.0 { [s0 / length, s1 / length] } else { [0.0, 1.0] };
        list.push(MovePiece { plan: Plan::line(a.truncate(), b.truncate()), w: [a.z, b.z], fractions });
    }

    /// The arc between two turns, halved when it is too far off.
    fn arc(&self, list: &mut Vec<MovePiece>, from: f64, to: f64, depth: u32) {
        /// Each halving divides the error by eight at least; twelve reach rounding.
        const DEEPEST: u32 = 12;
        let s = |turn: f64| self.record.length_at_turn(turn);
        let at = |f: f64| self.at(s(from + (to - from) * f));
        let [a, m, b] = [0.0, 0.5, 1.0].map(at);
        let Some(plan) = through(a.truncate(), m.truncate(), b.truncate()) else {
            return self.push_line(list, s(from), s(to));
        };
        let w = [a.z, b.z];
        let off = [0.1, 0.2113, 0.5, 0.7887, 0.9].map(|f| {
            let p = at(f);
            let v = p.truncate() - plan.centre;
            let t = plan.progress(v) / plan.sweep.abs();
            (v.length() - plan.radius).hypot(p.z - (w[0] + (w[1] - w[0]) * t))
        });
        let worst = off.into_iter().fold(0.0, f64::max);
        // A tenth is kept for what lies between the samples.
        if worst > 0.9 * self.tolerance && depth < DEEPEST {
            let middle = 0.5 * (from + to);
            self.arc(list, from, middle, depth + 1);
            return self.arc(list, middle, to, depth + 1);
        }
        let fractions = [s(from), s(to)].map(|s| s / self.record.length());
        list.push(MovePiece { plan: Plan::Arc(plan), w, fractions });
    }
}

/// The arc through three points; `None` when they lie on a line.
fn through(a: DVec2, m: DVec2, b: DVec2) -> Option<ArcPlan> {
    let (u, v) = (m - a, b - a);
    let twice = 2.0 * u.perp_dot(v);
    let (uu, vv) = (u.length_squared(), v.length_squared());
    let c = DVec2::new(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / twice;
    let radius = c.length();
    // A kilometre of radius over a chord of a part is a line within nanometres.
    if !(radius.is_finite() && radius < 1e6 && vv > 0.0) {
        return None;
    }
    let angle = (-c).to_angle();
    let sweep = wrap((v - c).to_angle() - angle);
    Some(ArcPlan::new(a + c, radius, angle, sweep))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Arc;
    use crate::stock::cut::CutAxis;

    /// Largest distance of dense points of the curve from the pieces and largest gap between pieces.
    fn compare(curve: &Curve, list: &[MovePiece], frame: &ToolFrame) -> f64 {
        let mut worst: f64 = 0.0;
        for pair in list.windows(2) {
            worst = worst.max(pair[0].plan.point(1.0).distance(pair[1].plan.point(0.0)));
            worst = worst.max((pair[0].w[1] - pair[1].w[0]).abs());
        }
        let back = frame.rotation();
        for i in 0..=20_000 {
            let p = back.point(curve.at(curve.length() * f64::from(i) / 20_000.0).p);
            let q = p.truncate();
            let near = list
                .iter()
                .map(|piece| {
                    let t = match &piece.plan {
                        Plan::Line(line) => {
                            let d = line.way.extend(piece.rise());
                            let v = p - line.start.extend(piece.w[0]);
                            (v.dot(d) / d.length_squared()).clamp(0.0, 1.0)
                        }
                        plan => plan.nearest(q),
                    };
                    piece.plan.point(t).distance(q).hypot(piece.tip(t) - p.z)
                })
                .fold(f64::INFINITY, f64::min);
            worst = worst.max(near);
        }
        worst
    }

    #[test]
    fn an_involute_is_within_a_quarter_micron_of_its_arcs() {
        let record = InvoluteRecord::new(4963.71639267187, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
        let frame = ToolFrame::new(CutAxis::PlusZ);
        for rise in [0.0, -3.0] {
            let curve = Curve::involute(record, -3.0, rise);
            let (list, bound) = pieces(&curve, &frame, 2.5e-4);
            assert_eq!(bound, 2.5e-4);
            assert!((340..380).contains(&list.len()), "{}", list.len());
            let worst = compare(&curve, &list, &frame);
            assert!(worst < 2.5e-4 && worst > 1e-4, "{worst}");
            assert_eq!(list[0].fractions[0], 0.0);
            assert_eq!(list[list.len() - 1].fractions[1], 1.0);
        }
        // Clockwise, seen from below.
        let curve = Curve::involute(record.mirrored(), 1.0, 0.0);
        let below = ToolFrame::new(CutAxis::MinusZ);
        let (list, _) = pieces(&curve, &below, 1e-3);
        assert!(compare(&curve, &list, &below) < 1e-3);
    }

    #[test]
    fn a_cubic_is_within_the_tolerance_of_its_arcs_from_above_and_below() {
        let points = [[0.0, 0.0], [30.0, 5.0], [-5.0, 20.0], [20.0, 25.0]].map(DVec2::from_array);
        let curve = Curve::cubic(CubicSpan::new(points).unwrap(), -2.0);
        for axis in [CutAxis::PlusZ, CutAxis::MinusZ] {
            let frame = ToolFrame::new(axis);
            let (list, bound) = pieces(&curve, &frame, 1e-3);
            assert_eq!(bound, 1e-3);
            assert!(
                list.len() < 130 && list.iter().any(|p| matches!(p.plan, Plan::Arc(_))),
                "{}",
                list.len()
            );
            let worst = compare(&curve, &list, &frame);
            assert!(worst < 1e-3 && worst > 3e-4, "{worst}");
            let ends = (list[0].fractions[0], list[list.len() - 1].fractions[1]);
            assert_eq!(ends, (0.0, 1.0));
        }
        // Across the tool axis it is a polyline; so is one with a cusp.
        let side = ToolFrame::new(CutAxis::PlusX);
        let (list, _) = pieces(&curve, &side, 1e-3);
        assert!(compare(&curve, &list, &side) < 1e-3);
    }

    #[test]
    fn arcs_about_the_tool_axis_are_exact_and_others_within_the_tolerance() {
        let start = DVec3::new(3.0, 4.0, 1.0);
        for axis in CutAxis::ALL {
            let frame = ToolFrame::new(axis);
            for (along, rise, sweep) in
                [(axis.vector(), 2.0, 15.0), (-axis.vector(), 2.0, -15.0), (axis.vector(), 0.0, 4.0)]
            {
                let curve = Curve::from(Arc::new(start, DVec3::ZERO, along, sweep, rise).unwrap());
                let (list, bound) = pieces(&curve, &frame, 0.01);
                assert_eq!(bound, 0.0);
                assert!(compare(&curve, &list, &frame) < 1e-12);
                assert_eq!(list.len(), (sweep.abs() / PI).ceil() as usize);
            }
        }
        let tilted = Curve::from(Arc::new(start, DVec3::ZERO, DVec3::new(1.0, 2.0, 0.5), 2.0, 1.0).unwrap());
        let frame = ToolFrame::new(CutAxis::PlusZ);
        let (list, bound) = pieces(&tilted, &frame, 0.001);
        assert_eq!(bound, 0.001);
        assert!(compare(&tilted, &list, &frame) < 0.001);
        let circles = Curve::from(Arc::new(start, DVec3::ZERO, DVec3::Z, 40.0, 0.0).unwrap());
        assert_eq!(pieces(&circles, &frame, 0.001).0.len(), 2);
    }
}
