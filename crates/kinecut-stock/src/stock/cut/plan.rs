//! The path of a piece of move seen along the tool axis: a point, a straight line, or an arc of at most half a turn.
//!
//! A fraction `t` from 0 to 1 runs along the path at constant speed.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, Vec2Swizzles};

use crate::num::angle::wrap;

/// Path in the plane across the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Plan {
    /// The tool is at rest, or moves along its axis.
    Dot(DVec2),
    /// A straight line of positive length.
    Line(LinePlan),
    /// An arc of at most half a turn.
    Arc(ArcPlan),
}

/// A straight path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LinePlan {
    pub(super) start: DVec2,
    /// Start to end.
    pub(super) way: DVec2,
    /// Its length, positive.
    pub(super) length: f64,
}

/// A circular path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ArcPlan {
    pub(super) centre: DVec2,
    pub(super) radius: f64,
    /// Polar angle of the start.
    pub(super) angle: f64,
    /// Angle turned, positive counter-clockwise, at most half a turn.
    pub(super) sweep: f64,
    /// Unit vectors from the centre to the first and last point counter-clockwise.
    pub(super) first: DVec2,
    pub(super) last: DVec2,
}

impl ArcPlan {
    pub(super) fn new(centre: DVec2, radius: f64, angle: f64, sweep: f64) -> ArcPlan {
        let (a, b) = (DVec2::from_angle(angle), DVec2::from_angle(angle + sweep));
        let (first, last) = if sweep >= 0.0 { (a, b) } else { (b, a) };
        ArcPlan { centre, radius, angle, sweep, first, last }
    }

    /// True if a direction from the centre lies in the sector of the arc.
    pub(super) fn in_sector(&self, v: DVec2) -> bool {
        self.first.perp_dot(v) >= 0.0 && v.perp_dot(self.last) >= 0.0
    }

    /// Angle from the start to a direction, in the sense of the path, in (-pi, pi].
    pub(super) fn progress(&self, v: DVec2) -> f64 {
        wrap(1f64.copysign(self.sweep) * (v.to_angle() - self.angle))
    }
}

/// The fractions of a path from which the tool reaches a point: at most two runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Windows {
    runs: [(f64, f64); 2],
    count: usize,
}

impl Windows {
    const ALL: Windows = Windows { runs: [(0.0, 1.0); 2], count: 1 };

    fn push(&mut self, from: f64, to: f64) {
        if from <= to && self.count < 2 {
            self.runs[self.count] = (from, to);
            self.count += 1;
        }
    }

    /// First and last fraction of each run, in order.
    pub(super) fn iter(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.runs[..self.count].iter().copied()
    }
}

impl Plan {
    /// A line, or a dot when the line is shorter than the tool path can tell [mm].
    pub(super) fn line(start: DVec2, end: DVec2) -> Plan {
        /// A tenth of an atom: below it the direction of a path is rounding.
        const NO_LENGTH: f64 = 1e-11;
        let way = end - start;
        let length = way.length();
        if length > NO_LENGTH { Plan::Line(LinePlan { start, way, length }) } else { Plan::Dot(start) }
    }

    /// The point at a fraction.
    pub(super) fn point(&self, t: f64) -> DVec2 {
        match self {
            Plan::Dot(p) => *p,
            Plan::Line(line) => line.start + line.way * t,
            Plan::Arc(arc) => arc.centre + DVec2::from_angle(arc.angle + arc.sweep * t) * arc.radius,
        }
    }

    /// Derivative of the point by the fraction.
    pub(super) fn speed(&self, t: f64) -> DVec2 {
        match self {
            Plan::Dot(_) => DVec2::ZERO,
            Plan::Line(line) => line.way,
            Plan::Arc(arc) => DVec2::from_angle(arc.angle + arc.sweep * t).perp() * (arc.radius * arc.sweep),
        }
    }

    /// Squared distance of a point from the path.
    pub(super) fn distance_squared(&self, q: DVec2) -> f64 {
        match self {
            Plan::Dot(p) => q.distance_squared(*p),
            Plan::Line(line) => {
                let v = q - line.start;
                let t = (v.dot(line.way) / (line.length * line.length)).clamp(0.0, 1.0);
                (v - line.way * t).length_squared()
            }
            Plan::Arc(arc) => {
                let v = q - arc.centre;
                if arc.in_sector(v) {
                    let d = v.length() - arc.radius;
                    d * d
                } else {
                    v.distance_squared(arc.first * arc.radius).min(v.distance_squared(arc.last * arc.radius))
                }
            }
        }
    }

    /// Fraction of the point of the path nearest to `q`.
    pub(super) fn nearest(&self, q: DVec2) -> f64 {
        match self {
            Plan::Dot(_) => 0.0,
            Plan::Line(line) => {
                ((q - line.start).dot(line.way) / (line.length * line.length)).clamp(0.0, 1.0)
            }
            Plan::Arc(arc) => {
                let v = q - arc.centre;
                if arc.in_sector(v) && v != DVec2::ZERO {
                    let p = arc.progress(v) / arc.sweep.abs();
                    return p.clamp(0.0, 1.0);
                }
                let ends = [arc.first, arc.last].map(|e| v.distance_squared(e * arc.radius));
                let first_is_nearer = ends[0] <= ends[1];
                if first_is_nearer == (arc.sweep >= 0.0) { 0.0 } else { 1.0 }
            }
        }
    }

    /// The fractions at which the path is within `reach` of `q`.
    pub(super) fn windows(&self, q: DVec2, reach: f64) -> Windows {
        let mut windows = Windows::default();
        match self {
            Plan::Dot(p) => {
                if q.distance_squared(*p) <= reach * reach {
                    windows = Windows::ALL;
                }
            }
            Plan::Line(line) => {
                let v = q - line.start;
                let along = v.dot(line.way) / line.length;
                let beside = v.perp_dot(line.way) / line.length;
                let half = (reach - beside) * (reach + beside);
                if half >= 0.0 {
                    let half = half.sqrt();
                    windows.push(
                        ((along - half) / line.length).clamp(0.0, f64::INFINITY),
                        ((along + half) / line.length).clamp(f64::NEG_INFINITY, 1.0),
                    );
                }
            }
            Plan::Arc(arc) => {
                let v = q - arc.centre;
                let far = v.length();
                // Law of cosines: distance = reach at the angle gamma from the direction of q.
                let cos = (arc.radius * arc.radius + far * far - reach * reach) / (2.0 * arc.radius * far);
                if cos <= -1.0 || far == 0.0 && arc.radius <= reach {
                    return Windows::ALL;
                }
                if cos > 1.0 || cos.is_nan() {
                    return windows;
                }
                let (middle, gamma, whole) = (arc.progress(v), cos.clamp(-1.0, 1.0).acos(), arc.sweep.abs());
                for turn in [-TAU, 0.0, TAU] {
                    let (from, to) = (middle + turn - gamma, middle + turn + gamma);
                    if to >= 0.0 && from <= whole {
                        windows.push((from / whole).clamp(0.0, 1.0), (to / whole).clamp(0.0, 1.0));
                    }
                }
            }
        }
        windows
    }

    /// The part between two fractions.
    pub(super) fn part(&self, from: f64, to: f64) -> Plan {
        match self {
            Plan::Dot(p) => Plan::Dot(*p),
            Plan::Line(_) if from <= 0.0 && to >= 1.0 => *self,
            Plan::Line(_) => Plan::line(self.point(from), self.point(to)),
            Plan::Arc(_) if from <= 0.0 && to >= 1.0 => *self,
            Plan::Arc(arc) => Plan::Arc(ArcPlan::new(
                arc.centre,
                arc.radius,
                arc.angle + arc.sweep * from,
                arc.sweep * (to - from),
            )),
        }
    }

    /// The path with its two coordinates exchanged.
    pub(super) fn mirrored(&self) -> Plan {
        match self {
            Plan::Dot(p) => Plan::Dot(p.yx()),
            Plan::Line(line) => Plan::Line(LinePlan { start: line.start.yx(), way: line.way.yx(), ..*line }),
            Plan::Arc(arc) => Plan::Arc(ArcPlan {
                centre: arc.centre.yx(),
                radius: arc.radius,
                angle: 0.5 * PI - arc.angle,
                sweep: -arc.sweep,
                first: arc.last.yx(),
                last: arc.first.yx(),
            }),
        }
    }

    /// Least and greatest coordinates.
    pub(super) fn bounds(&self) -> (DVec2, DVec2) {
        let (a, b) = (self.point(0.0), self.point(1.0));
        let (mut min, mut max) = (a.min(b), a.max(b));
        if let Plan::Arc(arc) = self {
            for v in
                [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y].into_iter().filter(|v| arc.in_sector(*v))
            {
                min = min.min(arc.centre + v * arc.radius);
                max = max.max(arc.centre + v * arc.radius);
            }
        }
        (min, max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn plans() -> impl Strategy<Value = Plan> {
        let point = || (-9.0..9.0, -9.0..9.0).prop_map(|(x, y): (f64, f64)| DVec2::new(x, y));
        let line = (point(), point()).prop_map(|(a, b)| Plan::line(a, b));
        let arc = (point(), 0.5..8.0, -4.0..4.0, -PI..PI)
            .prop_map(|(c, r, a, s): (DVec2, f64, f64, f64)| Plan::Arc(ArcPlan::new(c, r, a, s)));
        prop_oneof![point().prop_map(Plan::Dot), line, arc]
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn nearest_and_windows_agree_with_samples(plan in plans(), x in -20.0..20.0, y in -20.0..20.0, reach in 0.5..25.0) {
            let q = DVec2::new(x, y);
            let n = 4000;
            let sampled: Vec<f64> = (0..=n).map(|i| plan.point(f64::from(i) / f64::from(n)).distance(q)).collect();
            let least = sampled.iter().copied().fold(f64::INFINITY, f64::min);
            let d = plan.distance_squared(q).sqrt();
            prop_assert!(d <= least + 1e-12 && d > least - 0.01);
            prop_assert!((plan.point(plan.nearest(q)).distance(q) - d).abs() < 1e-9);
            let windows = plan.windows(q, reach);
            let mut at: f64 = -1.0;
            for (from, to) in windows.iter() {
                prop_assert!(from >= at && to <= 1.0);
                at = to;
            }
            for (i, d) in sampled.iter().enumerate() {
                let t = i as f64 / f64::from(n);
                let inside = windows.iter().any(|w| w.0 <= t && t <= w.1);
                prop_assert!(inside == (*d <= reach) || (d - reach).abs() < 1e-9, "{} {} {}", t, d, reach);
            }
            let (min, max) = plan.bounds();
            for i in 0..=50 {
                let p = plan.point(f64::from(i) / 50.0);
                prop_assert!(p.cmpge(min - 1e-12).all() && p.cmple(max + 1e-12).all());
                let m = plan.mirrored().point(f64::from(i) / 50.0);
                prop_assert!(m.yx().distance(p) < 1e-12);
                let h = 1e-6;
                let t = 0.01 + 0.98 * f64::from(i) / 50.0;
                let speed = (plan.point(t + h) - plan.point(t - h)) / (2.0 * h);
                prop_assert!(speed.distance(plan.speed(t)) < 1e-6);
            }
            let part = plan.part(0.25, 0.75);
            prop_assert!(part.point(0.5).distance(plan.point(0.5)) < 1e-12);
        }
    }
}
