//! Bound on the distance of a proportional move of the axes from the straight move of the tip.
//!
//! A curve `P(s)` on [0, 1] stays within `max |P''| / 8` of its chord. Here
//! `|P''| <= sum_i w_i^2 r_i + 2 sum_(i<j) |w_i w_j| r_j + 2 sum_i |w_i| v_i`, with `w_i` the travel of the rotary axis `i`,
//! `r_i` the distance of the tip from it, and `v_i` the travel of the translations between it and the tool.

use glam::DVec3;

use super::super::Kinematics;
use super::proportional;

/// Places of the move at which the distances of the tip from the axes are taken: they change slowly.
const PLACES: usize = 9;

impl Kinematics {
    /// A bound on how far the tip leaves its straight move when all axes move in proportion [mm]; distances from the axes
    /// are taken at nine places of the move.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::Machine;
    /// let chain = Machine::preset("mill4_xyza").unwrap().kinematics(0.0);
    /// let bound = chain.linear_bound(&[0.0; 4], &[0.1, 0.0, 0.0, 0.0]);
    /// assert!((bound - 50.0 * 0.1 * 0.1 / 8.0).abs() < 1e-12); // A turns at a radius of 50 mm
    /// ```
    pub fn linear_bound(&self, from: &[f64], to: &[f64]) -> f64 {
        let travel = |i: usize| to.get(i).unwrap_or(&0.0) - from.get(i).unwrap_or(&0.0);
        let screws = &self.screws[..self.count];
        let mut distance = [0.0; crate::machine::MOST_JOINTS];
        for place in 0..PLACES {
            let q = proportional(from, to, place as f64 / (PLACES - 1) as f64);
            // The tip seen from each axis: with the joints before it at home.
            let mut tip = self.tool.translation;
            for (i, screw) in screws.iter().enumerate().rev() {
                let value = q.get(i).copied().unwrap_or(0.0);
                if screw.rotary {
                    let arm = tip - screw.point;
                    let radius = (arm - screw.direction * screw.direction.dot(arm)).length();
                    if radius > distance[i] {
                        distance[i] = radius;
                    }
                    tip = screw.point + screw.turn(value) * arm;
                } else {
                    tip += screw.direction * value;
                }
            }
        }
        let mut sum = 0.0;
        for i in (0..self.count).filter(|&i| screws[i].rotary) {
            let turn = travel(i).abs();
            sum += turn * turn * distance[i];
            // Translations with no rotation between them add as vectors, others by their lengths.
            let (mut shift, mut shifts) = (DVec3::ZERO, 0.0);
            for j in i + 1..self.count {
                if screws[j].rotary {
                    sum += 2.0 * turn * travel(j).abs() * distance[j];
                    shifts += shift.length();
                    shift = DVec3::ZERO;
                } else {
                    shift += screws[j].direction * travel(j);
                }
            }
            sum += 2.0 * turn * (shifts + shift.length());
        }
        sum / 8.0
    }
}
