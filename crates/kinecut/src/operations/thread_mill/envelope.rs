//! The pitch diameter that a helix gives, by the envelope of the tool's flanks, looked for and not computed.
//!
//! For the check of posted threads: it shares nothing with the planner. At a radius of the half-plane through the thread's axis
//! the flank that reaches farthest is looked for over the places of the tool, and the radius at which that is the pitch line
//! by halving.

use std::f64::consts::{PI, TAU};

/// Halvings of an interval: to the last bit.
const HALVINGS: u32 = 60;
/// Places of the tool in half a turn, of which the best is narrowed down.
const PLACES: u32 = 4096;

/// A thread as its flanks are cut [mm, rad].
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    /// Whether in a hole.
    pub(super) inside: bool,
    /// Pitch.
    pub(super) pitch: f64,
    /// Angle between flank and a plane across the axis.
    pub(super) half_angle: f64,
    /// Radius of the tool at its pitch line.
    pub(super) tool: f64,
}

impl Cut {
    /// Radius of the helix whose envelope has its pitch line at a radius.
    pub(super) fn helix_of(&self, pitch_radius: f64) -> f64 {
        // A tool that overcuts runs nearer to where it comes from: the axis of a hole, the open beside a boss.
        let plain = if self.inside { pitch_radius - self.tool } else { pitch_radius + self.tool };
        let [mut low, mut high] =
            if self.inside { [self.lead(), plain] } else { [plain, plain + 2.0 * self.pitch] };
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            // In a hole a wider helix cuts deeper, about a boss a narrower one.
            let too_deep = self.reach(middle, pitch_radius) > 0.0;
            if too_deep == self.inside { high = middle } else { low = middle }
        }
        0.5 * (low + high)
    }

    /// Climb by angle, seen along a flank: a helix of no larger radius leaves none.
    fn lead(&self) -> f64 {
        self.pitch / (TAU * self.half_angle.tan())
    }

    /// Radial way by which the flanks reach beyond the pitch line at a radius, from a helix.
    fn reach(&self, helix: f64, pitch_radius: f64) -> f64 {
        let lead = self.lead();
        let reach = |turned: f64| {
            let across =
                helix * helix + pitch_radius * pitch_radius - 2.0 * helix * pitch_radius * turned.cos();
            self.tool - across.max(0.0).sqrt() + lead * turned
        };
        // Up to where it falls for the first time: far beyond lies the next groove.
        let step = PI / f64::from(PLACES);
        let falls = |i: &u32| reach(f64::from(*i + 1) * step) < reach(f64::from(*i) * step);
        let best = f64::from((0..PLACES).find(falls).unwrap_or(PLACES)) * step;
        let [mut low, mut high] = [(best - step).max(0.0), best + step];
        for _ in 0..HALVINGS {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if reach(a) < reach(b) { low = a } else { high = b }
        }
        reach(0.5 * (low + high))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_helix_without_lead_is_plain_and_the_table_of_overcuts_is_met() {
        let half_angle = 30f64.to_radians();
        let flat = Cut { inside: true, pitch: 1e-9, half_angle, tool: 5.0 };
        assert!((flat.helix_of(9.0) - 4.0).abs() < 1e-9);
        // M20x2.5 with 14 inside: 0.0538 less at the helix of 3, of which half a hundredth is the change of that.
        let cut = Cut { inside: true, pitch: 2.5, half_angle, tool: 6.188101183952089 };
        assert!((cut.helix_of(9.188101183952089 + 0.05380391251193117) - 3.0).abs() < 1e-8);
        let cut = Cut { inside: false, pitch: 2.5, half_angle, tool: 7.278312163512968 };
        let reached = 9.188101183952089 - 0.011466351341523406;
        assert!((cut.helix_of(reached) - 16.466413347465057).abs() < 1e-8);
    }
}
