//! Positions of the joints between the nodes of a way, as a control interpolates sampled laws.

use super::{TaskMotion, VariableLaw};
use crate::machine::JointValues;

impl TaskMotion {
    /// Positions at values of the variables [mm or rad]: settings and affine laws exactly, sampled laws by cubics through
    /// four neighbouring nodes in each variable. Values outside of the ranges are continued.
    pub fn positions_at(&self, u: [f64; 2]) -> JointValues {
        let spans = [0, 1].map(|k| Stencil::new(self.domain[k], self.nodes[k], u[k]));
        let mut q = JointValues::zero(self.laws.len());
        for (joint, (value, law)) in q.iter_mut().zip(&self.laws).enumerate() {
            *value = match law.law {
                VariableLaw::Setting(set) => set,
                VariableLaw::Affine { at_start, slopes } => {
                    at_start + (0..2).map(|k| slopes[k] * (u[k] - self.domain[k][0])).sum::<f64>()
                }
                VariableLaw::Sampled => {
                    spans[0].sum(|i| spans[1].sum(|j| self.positions[i * self.nodes[1] + j][joint]))
                }
            };
        }
        q
    }
}

/// Up to four nodes around a value, with the weights of Lagrange's polynomial through them.
struct Stencil {
    first: usize,
    weights: [f64; 4],
    count: usize,
}

impl Stencil {
    fn new([from, to]: [f64; 2], nodes: usize, value: f64) -> Stencil {
        let count = nodes.clamp(1, 4);
        let mut weights = [0.0; 4];
        if nodes < 2 || !(to > from) {
            weights[0] = 1.0;
            return Stencil { first: 0, weights, count: 1 };
        }
        let place = (value - from) / (to - from) * (nodes - 1) as f64;
        let first = (place.floor() - 1.0).clamp(0.0, (nodes - count) as f64) as usize;
        for (i, weight) in weights[..count].iter_mut().enumerate() {
            *weight = (0..count)
                .filter(|&j| j != i)
                .map(|j| (place - (first + j) as f64) / (i as f64 - j as f64))
                .product();
        }
        Stencil { first, weights, count }
    }

    fn sum(&self, f: impl Fn(usize) -> f64) -> f64 {
        (0..self.count).map(|i| self.weights[i] * f(self.first + i)).sum()
    }
}
