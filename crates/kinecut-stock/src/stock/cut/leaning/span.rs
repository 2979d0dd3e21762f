//! A motion in spans: tip and axis of each as cubics in a parameter from -1/2 to 1/2.
//!
//! A span goes through four poses of the motion. It is accepted when three more are off by no more than the tolerance at the
//! far end of the tool, when the tool turns by less than four degrees in it, is nearly straight on its way, and travels less than
//! its radius, or is straight: then the time at which a line is first or last in the tool is found from a few looks (`swept.rs`).

use glam::DVec3;

use crate::geom::Rigid;
use crate::sweep::ToolMotion;

/// Largest error of a point of the tool [mm]: a tenth of an end point's rounding.
const FINEST: f64 = 1e-6;

/// Largest turn of the axis in a span [rad].
const MOST_TURN: f64 = 4.0 / 180.0 * std::f64::consts::PI;

/// Largest part of a way in a span that no constant velocity explains [mm].
const MOST_BEND: f64 = 0.03;

/// Turn of a span up to which its way is straight, if it does not bend [rad].
const STRAIGHT: f64 = 1e-9;

/// Longest straight span as a part of the reach of the tool.
const STRAIGHT_WAY: f64 = 0.25;

/// Halvings after which a span is kept as it is, with its error.
const DEEPEST: u32 = 24;

/// A stretch of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) struct PoseSpan {
    /// Coefficients of the tip by powers of the parameter [mm].
    tip: [DVec3; 4],
    /// Coefficients of the axis.
    axis: [DVec3; 4],
    /// Fractions of the move at its start and end.
    pub(in super::super) fractions: [f64; 2],
}

/// A tool at one moment of a span, with rates by its parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) struct Pose {
    pub(in super::super) tip: DVec3,
    pub(in super::super) axis: DVec3,
    pub(in super::super) tip_rate: DVec3,
    pub(in super::super) axis_rate: DVec3,
}

/// Spans of a motion for a tool that reaches `reach` from its tip and may travel `travel` in one that is not straight [mm]; and the largest error of
/// a point of the tool [mm]. A stretch is left out where `is_far` says so of its ends, given what the way between them may be
/// off the straight one [mm].
pub(in super::super) fn spans(
    motion: &ToolMotion,
    reach: f64,
    travel: f64,
    is_far: impl Fn([Rigid; 2], f64) -> bool,
) -> (Vec<PoseSpan>, f64) {
    let mut list = Vec::new();
    let mut worst: f64 = 0.0;
    let mut open = vec![(0.0, 1.0, 0)];
    while let Some((from, to, depth)) = open.pop() {
        if is_far([from, to].map(|t| motion.pose(t)), motion.chord_error(from, to, reach)) {
            continue;
        }
        let span = PoseSpan::through(motion, [from, to]);
        let off = span.error(motion, reach);
        let (turn, bend) = (span.turn(), span.bend(reach));
        // On a straight way the chords of a line are convex in time however long it is.
        let most = if turn <= STRAIGHT && bend <= FINEST { STRAIGHT_WAY * reach } else { travel };
        let small = span.travel() <= most && turn <= MOST_TURN && bend <= MOST_BEND;
        let fits = off <= FINEST && small;
        if fits || depth >= DEEPEST {
            worst = worst.max(off);
            list.push(span);
        } else {
            let middle = 0.5 * (from + to);
            open.push((middle, to, depth + 1));
            open.push((from, middle, depth + 1));
        }
    }
    (list, worst)
}

impl PoseSpan {
    fn through(motion: &ToolMotion, fractions: [f64; 2]) -> PoseSpan {
        let [from, to] = fractions;
        let poses = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(|f| motion.pose(from + (to - from) * f));
        PoseSpan {
            tip: cubic(poses.map(|p| p.translation)),
            axis: cubic(poses.map(|p| p.rotation.z_axis)),
            fractions,
        }
    }

    /// Tip, axis and their rates.
    pub(in super::super) fn at(&self, t: f64) -> Pose {
        let value = |[a, b, c, d]: [DVec3; 4]| a + (b + (c + d * t) * t) * t;
        let rate = |[_, b, c, d]: [DVec3; 4]| b + (c * 2.0 + d * (3.0 * t)) * t;
        Pose {
            tip: value(self.tip),
            axis: value(self.axis),
            tip_rate: rate(self.tip),
            axis_rate: rate(self.axis),
        }
    }

    /// Coefficients of tip and axis by powers of the parameter.
    pub(super) fn cubics(&self) -> [[DVec3; 4]; 2] {
        [self.tip, self.axis]
    }

    /// Fraction of the move at a parameter.
    pub(in super::super) fn fraction(&self, t: f64) -> f64 {
        let [from, to] = self.fractions;
        from + (to - from) * (t + 0.5)
    }

    /// The part of the way of any point within `reach` of the tip that no constant velocity explains [mm].
    pub(in super::super) fn bend(&self, reach: f64) -> f64 {
        let of = |c: &[DVec3; 4]| 0.25 * c[2].length() + 0.125 * c[3].length();
        of(&self.tip) + reach * of(&self.axis)
    }

    /// The part of a way that neither constant velocity nor a steady turn of the tool explains: that of the tip [mm], and what each
    /// millimetre from the tip adds.
    pub(super) fn unsteady(&self) -> [f64; 2] {
        let [[_, _, c, d], [u, v, w, x]] = [self.tip, self.axis];
        // The rate of the turn, u x u'', by powers of the parameter.
        let rates = [
            2.0 * u.cross(w).length(),
            (6.0 * u.cross(x) + 2.0 * v.cross(w)).length(),
            6.0 * v.cross(x).length(),
            4.0 * w.cross(x).length(),
        ];
        let rate = rates[0] + 0.5 * (rates[1] + 0.5 * (rates[2] + 0.5 * rates[3]));
        [0.25 * c.length() + 0.375 * d.length(), 0.125 * rate]
    }

    /// Most that a point within `reach` of the tip moves away from its place at the middle [mm].
    pub(in super::super) fn stray(&self, reach: f64) -> f64 {
        0.5 * (self.tip[1].length() + reach * self.axis[1].length()) + self.bend(reach)
    }

    fn travel(&self) -> f64 {
        self.tip[1].length() + 2.0 * self.tip[2].length() + self.tip[3].length()
    }

    /// Turn of the axis, at most [rad].
    pub(in super::super) fn turn(&self) -> f64 {
        self.axis[1].length() + 2.0 * self.axis[2].length() + self.axis[3].length()
    }

    /// Largest error of a point within `reach` of the tip at three moments between the poses of the cubics.
    fn error(&self, motion: &ToolMotion, reach: f64) -> f64 {
        let off = |f: f64| {
            let (pose, own) = (motion.pose(self.fraction(f - 0.5)), self.at(f - 0.5));
            own.tip.distance(pose.translation) + reach * own.axis.distance(pose.rotation.z_axis)
        };
        [1.0 / 6.0, 0.5, 5.0 / 6.0].map(off).into_iter().fold(0.0, |a, b| if b > a { b } else { a })
    }
}

/// The cubic that takes four values at -1/2, -1/6, 1/6 and 1/2.
fn cubic([a, b, c, d]: [DVec3; 4]) -> [DVec3; 4] {
    [
        (9.0 * (b + c) - (a + d)) / 16.0,
        (27.0 * (c - b) - (d - a)) / 8.0,
        9.0 * (a + d - b - c) / 4.0,
        4.5 * (d - a - 3.0 * (c - b)),
    ]
}

impl Pose {
    /// Velocity of a point that is carried along, its place given from the tip [mm by the span's parameter]. The turn about the
    /// tool's own axis is left out.
    pub(in super::super) fn velocity(&self, from_tip: DVec3) -> DVec3 {
        self.tip_rate + self.axis_rate * from_tip.dot(self.axis) - self.axis * from_tip.dot(self.axis_rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Line;

    #[test]
    fn a_long_way_has_spans_where_it_passes_the_stock_only() {
        let line = Line { start: DVec3::new(-50_000.0, 1.0, 0.0), end: DVec3::new(40_000.0, 1.0, 0.0) };
        let motion = ToolMotion::fixed(line.into(), DVec3::new(0.3, 0.0, 1.0)).unwrap();
        let is_far = |ends: [Rigid; 2], off: f64| {
            let x = ends.map(|pose| pose.translation.x);
            x[1] < -10.0 - off || x[0] > 10.0 + off
        };
        let (list, error) = spans(&motion, 20.0, 0.05, is_far);
        assert!(error < FINEST && (4..40).contains(&list.len()), "{} {error}", list.len());
        for pair in list.windows(2) {
            assert_eq!(pair[0].fractions[1], pair[1].fractions[0]);
        }
    }

    #[test]
    fn spans_keep_to_their_motion_and_know_their_rates() {
        let line = Line { start: DVec3::ZERO, end: DVec3::new(9.0, 4.0, -2.0) };
        let motion =
            ToolMotion::between(line.into(), DVec3::new(0.2, -0.5, 1.0), DVec3::new(-1.0, 0.3, 0.4)).unwrap();
        let (list, error) = spans(&motion, 30.0, 1.0, |_, _| false);
        assert!(error <= FINEST && list.len() > 30, "{}", list.len());
        for span in &list {
            for t in [-0.5, -0.31, 0.0, 0.22, 0.5] {
                let (pose, own) = (motion.pose(span.fraction(t)), span.at(t));
                assert!(own.tip.distance(pose.translation) < 1e-9);
                assert!(own.axis.distance(pose.rotation.z_axis) < 1e-7);
                let h = 1e-4;
                let (a, b) = (span.at(t - h), span.at(t + h));
                assert!(((b.tip - a.tip) / (2.0 * h)).distance(own.tip_rate) < 1e-6);
                assert!(((b.axis - a.axis) / (2.0 * h)).distance(own.axis_rate) < 1e-6);
            }
        }
    }
}
