//! Places along a spiral, so that a parameter is found without the way from its start.

use super::Spiral;

/// Arc length and speed at equal steps of the parameter.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    /// Arc length from the start [mm], and its growth by the parameter counted from the start [mm].
    nodes: Vec<[f64; 2]>,
    step: f64,
}

impl Places {
    /// The places of a spiral.
    pub(crate) fn of(spiral: &Spiral) -> Places {
        let width = (spiral.to - spiral.from).abs();
        // The memory of a hundred thousand turns; beyond it steps are longer, and more places are sought by iteration.
        const MOST: f64 = 1e7;
        let count = (width / spiral.law.short()).ceil().clamp(1.0, MOST);
        let (step, d) = (width / count, spiral.direction());
        let mut nodes = Vec::with_capacity(count as usize + 1);
        let (mut length, mut last) = (0.0, spiral.from);
        for i in 0..=count as u64 {
            let u = spiral.from + d * (i as f64 * step);
            length += d * spiral.law.short_length(last, u);
            last = u;
            nodes.push([length, spiral.law.speed(u)]);
        }
        Places { nodes, step }
    }

    /// The parameter at an arc length from the start [mm].
    pub(crate) fn parameter(&self, spiral: &Spiral, s: f64) -> f64 {
        if s <= 0.0 || s >= spiral.length {
            return spiral.parameter(s);
        }
        let i = self.nodes.partition_point(|node| node[0] <= s).clamp(1, self.nodes.len() - 1) - 1;
        let ([from, slow], [to, fast]) = (self.nodes[i], self.nodes[i + 1]);
        // The parameter as a cubic of the arc length, then one step of Newton.
        let (way, share) = (to - from, (s - from) / (to - from));
        let slopes = [way / (slow * self.step), way / (fast * self.step)];
        let rest = 1.0 - share;
        let part =
            share * share * (3.0 - 2.0 * share) + share * rest * (rest * slopes[0] - share * slopes[1]);
        let d = spiral.direction();
        let node = spiral.from + d * (i as f64 * self.step);
        let guess = node + d * (part * self.step);
        let missing = s - from - d * spiral.law.short_length(node, guess);
        let correction = missing / spiral.law.speed(guess);
        /// Largest correction, in steps, after which another would change nothing: its square.
        const SMALL: f64 = 1e-6;
        // Beside a cusp the cubic is no guess.
        if !(correction.abs() <= SMALL * self.step) {
            return spiral.parameter(s);
        }
        guess + d * correction
    }
}
