//! The joints of a run, in order.

use super::joint::{AXES, Joint};

/// Joints that are passed without a stop, with what is needed to find those whose smoothing covers a place.
pub(super) struct Joints {
    all: Vec<Joint>,
    /// End of the farthest smoothing of the joints up to each one [mm].
    reached: Vec<f64>,
    /// Start of the first smoothing of the joints from each one on [mm].
    begun: Vec<f64>,
    /// Length of cells at each joint [mm].
    sizes: Vec<f64>,
}

/// Cells over half of a smoothing.
const CELLS: f64 = 3.0;
/// Growth of cells away from a smoothing.
const GROWTH: f64 = 0.25;

impl Joints {
    /// These joints; their smoothings become shorter where together they leave the path by more than is allowed at one [mm].
    pub(super) fn within(all: Vec<Joint>, allowed: &[f64]) -> Joints {
        /// Rounds of shortening; a smoothing of half the length leaves the path by half as much at least.
        const ROUNDS: usize = 4;
        /// Share of what is allowed that a shorter one is to leave the path by: its marks are at other places.
        const SHARE: f64 = 0.98;
        let mut joints = Joints { all, reached: Vec::new(), begun: Vec::new(), sizes: Vec::new() };
        joints.index();
        for _ in 0..ROUNDS {
            let mut factors = vec![1.0_f64; joints.all.len()];
            for (joint, allowed) in joints.all.iter().zip(allowed) {
                for s in joint.marks() {
                    let left = joints.left_at(s);
                    if left > *allowed {
                        let factor = (SHARE * allowed / left).max(0.25);
                        joints.indices(s, |k| factors[k] = factors[k].min(factor));
                    }
                }
            }
            if factors.iter().all(|f| *f == 1.0) {
                break;
            }
            for (joint, factor) in joints.all.iter_mut().zip(factors) {
                joint.half *= factor;
            }
            joints.index();
        }
        joints
    }

    fn index(&mut self) {
        let all = &self.all;
        let mut most = f64::NEG_INFINITY;
        self.reached = all
            .iter()
            .map(|j| {
                most = most.max(j.at + j.half);
                most
            })
            .collect();
        let mut least = f64::INFINITY;
        self.begun = all
            .iter()
            .rev()
            .map(|j| {
                least = least.min(j.at - j.half);
                least
            })
            .collect();
        self.begun.reverse();
        let mut sizes: Vec<f64> = all.iter().map(|j| j.half / CELLS).collect();
        let gap = |k: usize| GROWTH * (all[k + 1].at - all[k].at);
        for k in 1..sizes.len() {
            sizes[k] = sizes[k].min(sizes[k - 1] + gap(k - 1));
        }
        for k in (1..sizes.len()).rev() {
            sizes[k - 1] = sizes[k - 1].min(sizes[k] + gap(k - 1));
        }
        self.sizes = sizes;
    }

    /// Calls with the index of each joint whose smoothing covers a place [mm].
    fn indices(&self, s: f64, mut f: impl FnMut(usize)) {
        let next = self.all.partition_point(|j| j.at <= s);
        for k in (0..next).rev() {
            if self.reached[k] < s {
                break;
            }
            f(k);
        }
        for k in next..self.all.len() {
            if self.begun[k] > s {
                break;
            }
            f(k);
        }
    }

    /// Calls with each joint whose smoothing may cover a place [mm].
    pub(super) fn about(&self, s: f64, mut f: impl FnMut(&Joint)) {
        self.indices(s, |k| f(&self.all[k]));
    }

    /// True if a smoothing covers a part of a stretch [mm].
    pub(super) fn covers(&self, [from, to]: [f64; 2]) -> bool {
        let next = self.all.partition_point(|j| j.at < to);
        let before = next > 0 && self.reached[next - 1] > from;
        before || self.begun.get(next).is_some_and(|begun| *begun < to)
    }

    /// The joint at a place [mm].
    pub(super) fn at(&self, s: f64) -> Option<&Joint> {
        let k = self.all.partition_point(|j| j.at < s);
        self.all.get(k).filter(|j| j.at == s)
    }

    /// Distance from the programmed path at a place, of the linear axes [mm].
    fn left_at(&self, s: f64) -> f64 {
        let mut shift = [0.0; AXES];
        self.about(s, |joint| joint.shift(s, &mut shift));
        shift[..3].iter().map(|v| v * v).sum::<f64>().sqrt()
    }

    /// All of them, in order.
    pub(super) fn all(&self) -> &[Joint] {
        &self.all
    }

    /// Distance from the programmed path about one of them, of the linear axes [mm]: at the joint and at quarters of its
    /// smoothing.
    pub(super) fn off(&self, joint: &Joint) -> f64 {
        joint.marks().into_iter().map(|s| self.left_at(s)).fold(0.0, f64::max)
    }

    /// True if no smoothing reaches over a place but that of the joint there [mm].
    pub(super) fn alone(&self, s: f64) -> bool {
        let mut others = 0;
        self.about(s, |joint| others += usize::from(joint.at != s && (s - joint.at).abs() < joint.half));
        others == 0
    }

    /// Both ends of the smoothings that no other one covers [mm].
    pub(super) fn ends(&self) -> impl Iterator<Item = f64> {
        let apart = |k: usize| {
            let j = &self.all[k];
            let before = k == 0 || self.reached[k - 1] <= j.at - j.half;
            let after = k + 1 == self.all.len() || self.begun[k + 1] >= j.at + j.half;
            before && after
        };
        let apart: Vec<usize> = (0..self.all.len()).filter(|k| apart(*k)).collect();
        apart.into_iter().flat_map(|k| [self.all[k].at - self.all[k].half, self.all[k].at + self.all[k].half])
    }

    /// Largest length of a cell about a place [mm].
    pub(super) fn finest(&self, s: f64) -> f64 {
        let next = self.all.partition_point(|j| j.at <= s);
        let of = |k: usize| {
            let beside = ((s - self.all[k].at).abs() - self.all[k].half).max(0.0);
            self.sizes[k] + GROWTH * beside
        };
        let before = next.checked_sub(1).map_or(f64::INFINITY, of);
        let after = if next < self.all.len() { of(next) } else { f64::INFINITY };
        before.min(after)
    }
}
