//! The time at which a part reaches furthest into the material of a line, by Newton's steps in place and time together.
//!
//! Source: at the furthest end the gauge does not change in time, so that an error of the time adds to the place with its square; both
//! are found in a few steps. It is a guess: whether it is the furthest end is asked by bounds afterwards (`furthest.rs`).

use super::chord::{LineFrom, curved_gauge_at};
use super::look::{Look, Mets};
use super::swept::SpanPoses;

/// Steps after which the time is taken as it is.
const STEPS: usize = 8;

/// Step in time that is small enough [span's parameter]: its square times the bend of the end's way is nothing.
const SMALL: f64 = 1e-5;

/// Longest step in time [span's parameter].
const LONG: f64 = 0.4;

/// Least rise of the gauge along the line that is followed.
const LEAST_SLOPE: f64 = 0.02;

impl Look<'_> {
    /// Looks at about the times at which the ends of the line in the part are carried furthest, those that lie in the material; none where
    /// the steps lead nowhere or the line is not met then.
    pub(super) fn at_furthest(&self) -> Mets<2> {
        let mut mets = Mets::new();
        let [low, high] = self.line.material;
        let from = LineFrom::new(self.line.start, self.line.along, &self.of.poses[1]);
        let [a, b] = [low, high].map(|s| from.gauge(self.part, s).value);
        // From the end of the material that lies deeper in the part.
        let (start, into) = if a < b { (low, 1.0) } else { (high, -1.0) };
        let Some(first) = self.follow(start, 0.0, into).and_then(|t| self.at(t)) else { return mets };
        mets.add(first);
        let (other, is_inside) = if into > 0.0 {
            (first.chord.lo, first.chord.lo > low)
        } else {
            (first.chord.hi, first.chord.hi < high)
        };
        if is_inside && let Some(second) = self.follow(other, first.t, -into).and_then(|t| self.at(t)) {
            mets.add(second);
        }
        mets
    }

    /// The time to which Newton's steps lead from a place on the line and a time, along the line in one direction.
    fn follow(&self, mut s: f64, mut t: f64, into: f64) -> Option<f64> {
        let (along, [low, high]) = (self.line.along, self.line.material);
        for _ in 0..STEPS {
            let pose = self.of.span.at(t);
            let mut place = self.line.start;
            place[along] += s;
            let (gauge, curves) = curved_gauge_at(self.part, &pose, place);
            let from_tip = place - pose.tip;
            let velocity = pose.velocity(from_tip);
            let rate = -gauge.normal.dot(velocity);
            let bends = curves.map(|c| c.dot(velocity));
            let second =
                bends[0] * bends[0] + bends[1] * bends[1] + SpanPoses::curved(&pose, gauge.normal, from_tip);
            // Where the gauge goes on falling, to the end of the time.
            let step = if second > 0.0 { -rate / second } else { -LONG.copysign(rate) };
            let next = (t + step.clamp(-LONG, LONG)).clamp(-0.5, 0.5);
            let slope = gauge.normal[along] * into;
            if !(slope > LEAST_SLOPE && next.is_finite()) {
                return None;
            }
            let moved = (next - t).abs();
            t = next;
            if moved < SMALL {
                break;
            }
            s = (s - into * gauge.value / slope).clamp(low, high);
        }
        Some(t)
    }
}
