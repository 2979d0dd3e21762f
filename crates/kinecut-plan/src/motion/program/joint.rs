//! A joint of two moves, and the curve that smooths it.
//!
//! At `u = 0` the axes `q` step in their first derivative by `p` and in their second by `r`. Within `|u| < L` the path becomes
//! `q + p G(u/L) L + r H(u/L) L^2`, which has a continuous second derivative:
//! `G(x) = (1 - |x|)^3 / 6`, `H(x) = x (1 - |x|)^3 / 12`. One joint alone leaves the path by at most
//! `|p| L/6 + |r| L^2 9/1024`. Joints that are closer together than their smoothings add up: the path is then the programmed
//! one seen through a window of that length, as a control's filters see it.

use super::super::AxisLimit;

/// Axes of a program: X Y Z A B C.
pub(super) const AXES: usize = 6;

/// Steps of the derivatives of the axes at a joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// Of the first derivative.
    pub(super) first: [f64; AXES],
    /// Of the second one.
    pub(super) second: [f64; AXES],
}

/// Distances by which a control may leave the path at joints: linear axes [mm], rotary ones [rad].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tolerance {
    pub(super) way: f64,
    pub(super) turn: f64,
}

impl Tolerance {
    /// The path is not left.
    pub(super) const NONE: Tolerance = Tolerance { way: 0.0, turn: 0.0 };
}

/// A joint that is passed without a stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    /// Its place in the run [mm].
    pub(super) at: f64,
    /// Half of the length over which it is smoothed [mm].
    pub(super) half: f64,
    pub(super) step: Step,
}

/// Largest value of `H`: at a quarter of the way.
const MOST_SECOND: f64 = 9.0 / 1024.0;

impl Step {
    /// Between the derivatives at the end of a move and those at the start of the next one.
    pub(super) fn between(before: &[[f64; 3]; AXES], after: &[[f64; 3]; AXES]) -> Step {
        let of = |d: usize| std::array::from_fn(|a| after[a][d] - before[a][d]);
        Step { first: of(0), second: of(1) }
    }

    /// True if nothing steps but by rounding.
    pub(super) fn is_none(&self) -> bool {
        const ROUNDING: f64 = 1e-9;
        self.first.iter().chain(&self.second).all(|d| d.abs() <= ROUNDING)
    }

    /// Sizes of both steps over these axes.
    fn sizes(&self, axes: std::ops::Range<usize>) -> [f64; 2] {
        let size = |d: &[f64]| d.iter().map(|v| v * v).sum::<f64>().sqrt();
        [size(&self.first[axes.clone()]), size(&self.second[axes])]
    }

    /// Half of the longest smoothing within a tolerance [mm].
    pub(super) fn longest(&self, tolerance: Tolerance) -> f64 {
        let half = |[first, second]: [f64; 2], allowed: f64| {
            // The positive root of m s L^2 + f/6 L = allowed, without cancellation.
            let (a, b) = (MOST_SECOND * second, first / 6.0);
            2.0 * allowed / (b + (b * b + 4.0 * a * allowed).sqrt())
        };
        let way = half(self.sizes(0..3), tolerance.way);
        let turn = half(self.sizes(3..6), tolerance.turn);
        [way, turn].into_iter().filter(|l| !l.is_nan()).fold(f64::INFINITY, f64::min)
    }

    /// Half of the shortest smoothing that may be passed at a rate [mm/s] with a share of the limits [mm].
    pub(super) fn needed(&self, rate: f64, share: f64, limits: &[Option<AxisLimit>; AXES]) -> f64 {
        let mut half = 0.0_f64;
        for (a, limit) in limits.iter().enumerate() {
            let Some(limit) = limit else { continue };
            let (p, r) = (self.first[a].abs(), self.second[a].abs());
            let (j, cube) = (share * limit.jerk, rate.powi(3));
            half = half.max(p * rate * rate / (share * limit.acceleration));
            half = half.max((p * cube / j).sqrt()).max(1.5 * r * cube / j);
        }
        half
    }

    /// Angle by which the linear axes turn [rad].
    pub(super) fn corner(&self) -> f64 {
        let [first, _] = self.sizes(0..3);
        2.0 * (0.5 * first).min(1.0).asin()
    }

    /// True if the direction steps by more than a control smooths on the way.
    pub(super) fn is_sharp(&self) -> bool {
        /// Step of the direction, about 10 degrees.
        const SHARP: f64 = 0.17;
        self.sizes(0..3)[0] > SHARP
    }

    /// Largest rate at which the middle of a smoothing over `half` can be passed evenly [mm/s], where the joint alone bends
    /// the path.
    pub(super) fn crossing(&self, half: f64, limits: &[Option<AxisLimit>; AXES]) -> f64 {
        let mut most = f64::INFINITY;
        for (a, limit) in limits.iter().enumerate() {
            let Some(limit) = limit else { continue };
            let (p, r) = (self.first[a].abs(), self.second[a].abs());
            most = most.min((limit.acceleration / (p / half + 0.5 * r)).sqrt());
            most = most.min((limit.jerk / (p / (half * half) + 1.5 * r / half)).cbrt());
        }
        most
    }
}

impl Joint {
    /// Places at which the path is left most: a step of direction counts at the joint, one of curvature at a quarter of
    /// each half [mm].
    pub(super) fn marks(&self) -> [f64; 5] {
        [-0.5, -0.25, 0.0, 0.25, 0.5].map(|part| self.at + part * self.half)
    }

    /// Adds what the smoothing changes to the derivatives of the axes at a place [mm].
    pub(super) fn smooth(&self, s: f64, jets: &mut [[f64; 3]; AXES]) {
        let half = self.half;
        let x = (s - self.at) / half;
        if x.abs() >= 1.0 {
            return;
        }
        // Both halves are alike: G is even, H is odd.
        let (near, sign) = (1.0 - x.abs(), if x < 0.0 { 1.0 } else { -1.0 });
        let y = x.abs();
        let g = [sign * 0.5 * near * near, near / half, sign / (half * half)];
        let h = [
            half / 12.0 * near * near * (1.0 - 4.0 * y),
            sign * 0.5 * near * (1.0 - 2.0 * y),
            0.5 / half * (3.0 - 4.0 * y),
        ];
        for (a, jet) in jets.iter_mut().enumerate() {
            for d in 0..3 {
                jet[d] += self.step.first[a] * g[d] + self.step.second[a] * h[d];
            }
        }
    }

    /// Adds what the smoothing changes to the positions of the axes at a place [mm].
    pub(super) fn shift(&self, s: f64, positions: &mut [f64; AXES]) {
        let x = (s - self.at) / self.half;
        if x.abs() >= 1.0 {
            return;
        }
        let near = (1.0 - x.abs()).powi(3);
        for (a, q) in positions.iter_mut().enumerate() {
            *q += self.step.first[a] * self.half * near / 6.0
                + self.step.second[a] * self.half * self.half * x * near / 12.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smoothed_joint_is_continuous_to_the_second_derivative_and_within_its_tolerance() {
        // Before: straight along X; after: turned by 40 degrees and curved.
        let angle = 40f64.to_radians();
        let (t, k) = ([angle.cos(), angle.sin()], 0.3);
        let before = [[1.0, 0.0, 0.0], [0.0; 3], [0.0; 3], [0.0; 3], [0.0; 3], [0.0; 3]];
        let mut after = before;
        after[0] = [t[0], -k * t[1], 0.0];
        after[1] = [t[1], k * t[0], 0.0];
        let step = Step::between(&before, &after);
        let tolerance = Tolerance { way: 0.02, turn: 1.0 };
        let half = step.longest(tolerance);
        let joint = Joint { at: 5.0, half, step };
        // Positions: two parabolas that meet at (0, 0), smoothed.
        let place = |s: f64| {
            let u = s - 5.0;
            let mut q = [0.0; AXES];
            for a in 0..2 {
                let jets = if u < 0.0 { before[a] } else { after[a] };
                q[a] = jets[0] * u + 0.5 * jets[1] * u * u;
            }
            joint.shift(s, &mut q);
            q
        };
        let jets = |s: f64| {
            let u = s - 5.0;
            let mut jets = if u < 0.0 { before } else { after };
            for jet in &mut jets {
                jet[0] += jet[1] * u;
            }
            joint.smooth(s, &mut jets);
            jets
        };
        let mut farthest = 0.0_f64;
        for i in 0..=400 {
            let s = 5.0 + half * 1.1 * (f64::from(i) / 200.0 - 1.0);
            let h = 1e-5;
            for a in 0..2 {
                let slope = (place(s + h)[a] - place(s - h)[a]) / (2.0 * h);
                assert!((slope - jets(s)[a][0]).abs() < 1e-6, "{i} {a}");
                let bend = (jets(s + h)[a][0] - jets(s - h)[a][0]) / (2.0 * h);
                assert!((bend - jets(s)[a][1]).abs() < 2e-3, "{i} {a} {bend} {}", jets(s)[a][1]);
            }
            let u = s - 5.0;
            let off = |jets: &[[f64; 3]; AXES]| {
                (0..2)
                    .map(|a| (place(s)[a] - jets[a][0] * u - 0.5 * jets[a][1] * u * u).powi(2))
                    .sum::<f64>()
                    .sqrt()
            };
            farthest = farthest.max(if u < 0.0 { off(&before) } else { off(&after) });
        }
        assert!(farthest <= 0.02 && farthest > 0.015, "{farthest}");
        for s in [5.0 - half, 5.0, 5.0 + half] {
            let (left, right) = (jets(s - 1e-10), jets(s + 1e-10));
            for a in 0..2 {
                assert!((left[a][1] - right[a][1]).abs() < 1e-7, "{s} {a}");
            }
        }
    }
}
