//! A path along an arc, seen along the tool axis: what is near to it, without asking for angles.

use glam::DVec2;

use super::super::plan::ArcPlan;
use super::sweep::{least, most};

/// An arc of at most half a turn.
#[derive(Clone, Copy)]
pub(super) struct Round {
    centre: DVec2,
    radius: f64,
    /// Unit vectors from the centre to the first and last point counter-clockwise.
    first: DVec2,
    last: DVec2,
    /// Height of the tip, if it is the same all along.
    pub(super) level: Option<f64>,
}

impl Round {
    pub(super) fn new(arc: &ArcPlan, level: Option<f64>) -> Round {
        Round { centre: arc.centre, radius: arc.radius, first: arc.first, last: arc.last, level }
    }

    /// From the centre to a point, its distance, and whether the arc passes the ray through it.
    #[inline(always)]
    fn seen(&self, x: f64, y: f64) -> (f64, f64, f64, bool) {
        let (vx, vy) = (x - self.centre.x, y - self.centre.y);
        let after = self.first.x * vy - self.first.y * vx >= 0.0;
        let before = vx * self.last.y - vy * self.last.x >= 0.0;
        (vx, vy, (vx * vx + vy * vy).sqrt(), after & before)
    }

    /// Squared distances of a place, from the centre, from the two ends.
    #[inline(always)]
    fn end_squares(&self, vx: f64, vy: f64) -> [f64; 2] {
        let square = |end: DVec2| {
            let (x, y) = (vx - end.x * self.radius, vy - end.y * self.radius);
            x * x + y * y
        };
        [square(self.first), square(self.last)]
    }

    /// Distance of a point from the path.
    #[inline(always)]
    pub(super) fn distance(&self, x: f64, y: f64) -> f64 {
        let (vx, vy, far, is_beside) = self.seen(x, y);
        let [a, b] = self.end_squares(vx, vy);
        let (on, end) = ((far - self.radius).abs(), least(a, b).sqrt());
        if is_beside { on } else { end }
    }

    /// The point of the path that is nearest to a point.
    #[inline(always)]
    pub(super) fn nearest(&self, x: f64, y: f64) -> (f64, f64) {
        let (vx, vy, far, is_beside) = self.seen(x, y);
        let [a, b] = self.end_squares(vx, vy);
        let (first, last) = (self.first, self.last);
        let (ex, ey) = if a <= b { (first.x, first.y) } else { (last.x, last.y) };
        let share = 1.0 / most(far, f64::MIN_POSITIVE);
        // At the centre all are as near.
        let (ux, uy) = if is_beside & (far > 0.0) { (vx * share, vy * share) } else { (ex, ey) };
        (self.centre.x + ux * self.radius, self.centre.y + uy * self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::plan::Plan;
    use super::super::super::tests::reference::Random;
    use super::*;

    #[test]
    fn distances_and_nearest_points_are_those_of_the_plan() {
        let mut random = Random(17);
        for i in 0..2000 {
            let (radius, sweep) = (random.within(0.1, 9.0), random.within(-3.1, 3.1));
            let arc = ArcPlan::new(random.plane(3.0), radius, random.within(-3.0, 3.0), sweep);
            let (round, plan) = (Round::new(&arc, None), Plan::Arc(arc));
            let q = if i % 50 == 0 { arc.centre } else { random.plane(12.0) };
            let d = round.distance(q.x, q.y);
            assert!((d - plan.distance_squared(q).sqrt()).abs() < 1e-12, "{arc:?} {q}");
            let near = DVec2::from(round.nearest(q.x, q.y));
            assert!((near.distance(q) - d).abs() < 1e-12, "{arc:?} {q}: {near}");
            assert!(plan.distance_squared(near) < 1e-20, "{arc:?} {q}: {near}");
        }
    }
}
