//! Scores of a layout that follow from its code and sizes alone.
//!
//! The error gain is the variational method of Reshetov and Portman: each link `i` has a small error matrix `E_i`, the tip
//! moves by `sum A_0i E_i A_il r_l`. With independent errors of the same spread in all directions and axes anywhere in
//! their strokes (uniform, tool centre point controlled), the mean square is `sum 3 shift^2 + 2 turn^2 rho_i^2`, where
//! `rho_i^2` is the mean square distance of the tip from the carriage of link `i`: a twelfth of the squares of the strokes
//! that follow, of its own too when the carriage carries the work and passes below the tool, and the tool's length when it
//! carries the tool. Rotations in between change no distance, so the sum is exact in closed form.

use serde::Serialize;

use super::kind::rotaries;
use super::{Attitude, LinkErrors, Masses};
use crate::machine::{CoordinateCode, Elementary};

/// Scores that need no pose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Scores {
    /// Axes that carry the work.
    pub work_links: usize,
    /// Rotary axes that carry the work.
    pub work_rotaries: usize,
    /// Rotary axes that carry the tool; they are less stiff than tables.
    pub tool_rotaries: usize,
    /// Sum over the axes of the mass that each one moves.
    pub moved_mass: f64,
    /// Mass that the vertical axis lifts.
    pub lifted_mass: f64,
    /// Strokes of the translations that do not run on the bed, of the side where they are longer together [mm].
    pub overhang: f64,
    /// Root mean square shift of the tip by the errors of the links [mm].
    pub error_gain: f64,
}

impl Scores {
    /// Scores of a code with these strokes of X, Y, Z.
    pub fn new(
        code: &CoordinateCode,
        attitude: Attitude,
        stroke: [f64; 3],
        tool_length: f64,
        masses: &Masses,
        errors: &LinkErrors,
    ) -> Scores {
        let [work_rotaries, tool_rotaries] = rotaries(code);
        let vertical = match attitude {
            Attitude::Vertical => Elementary::Z,
            Attitude::Horizontal => Elementary::Y,
        };
        let (mut moved_mass, mut lifted_mass) = (0.0, 0.0);
        for (i, mass) in moved_masses(code, masses).enumerate() {
            moved_mass += mass;
            if code.word().0[i] == vertical {
                lifted_mass += mass;
            }
        }
        Scores {
            work_links: code.bed(),
            work_rotaries,
            tool_rotaries,
            moved_mass,
            lifted_mass,
            overhang: overhang(code, stroke),
            error_gain: error_gain(code, stroke, tool_length, errors),
        }
    }
}

/// Mass that each axis moves, in the order of the code: its own body and all bodies that it carries.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::{CoordinateCode, layouts::{Masses, moved_masses}};
/// let code = CoordinateCode::parse("2103").unwrap(); // Y carries the work, X carries Y, Z carries the tool
/// assert_eq!(moved_masses(&code, &Masses::default()).collect::<Vec<_>>(), [2.0, 3.0, 2.0]);
/// ```
pub fn moved_masses(code: &CoordinateCode, masses: &Masses) -> impl Iterator<Item = f64> {
    let motions = &code.word().0;
    (0..motions.len()).map(move |i| {
        let (end, carried) =
            if i < code.bed() { (masses.work, &motions[..=i]) } else { (masses.tool, &motions[i..]) };
        end + carried.iter().map(|&m| masses.of(m)).sum::<f64>()
    })
}

/// Stroke of a translation [mm]; zero for a rotation.
fn stroke_of(motion: Elementary, stroke: [f64; 3]) -> f64 {
    if motion.is_rotation() { 0.0 } else { stroke[usize::from(motion.digit()) - 1] }
}

fn overhang(code: &CoordinateCode, stroke: [f64; 3]) -> f64 {
    let (work, tool) = code.word().0.split_at(code.bed());
    // The axis on the bed runs on ways that carry it along its whole stroke.
    let side = |motions: &mut dyn Iterator<Item = &Elementary>| {
        motions.skip(1).map(|&m| stroke_of(m, stroke)).sum::<f64>()
    };
    f64::max(side(&mut work.iter().rev()), side(&mut tool.iter()))
}

/// Root mean square shift of the tip by the errors of the links [mm]; see the head of the file.
fn error_gain(code: &CoordinateCode, stroke: [f64; 3], tool_length: f64, errors: &LinkErrors) -> f64 {
    let motions = &code.word().0;
    let (mut after, mut sum) = (0.0, 0.0);
    for (i, &motion) in motions.iter().enumerate().rev() {
        let own = stroke_of(motion, stroke).powi(2) / 12.0;
        let square = if i < code.bed() { after + own } else { after + tool_length * tool_length };
        sum += 3.0 * errors.shift * errors.shift + 2.0 * errors.turn * errors.turn * square;
        after += own;
    }
    sum.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, DVec3};

    const STROKE: [f64; 3] = [600.0, 400.0, 300.0];
    const LENGTH: f64 = 150.0;

    /// Numbers without pattern from 0 to 1.
    fn noise(n: &mut u64) -> f64 {
        *n = n.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*n >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Mean square shift of the tip by drawing errors and poses at random, carriage by carriage.
    fn drawn(text: &str, errors: &LinkErrors) -> f64 {
        let code = CoordinateCode::parse(text).unwrap();
        let motions = &code.word().0;
        let (mut n, mut sum, draws) = (7, 0.0, 20_000);
        for _ in 0..draws {
            let values: Vec<f64> = motions
                .iter()
                .map(|&m| {
                    let x = noise(&mut n) - 0.5;
                    if m.is_rotation() { 6.0 * x } else { STROKE[usize::from(m.digit()) - 1] * x }
                })
                .collect();
            let mut shift = DVec3::ZERO;
            for i in 0..motions.len() {
                // From the carriage to the tip: on the work side its own motion still follows.
                let first = if i < code.bed() { i } else { i + 1 };
                let end = if i < code.bed() { DVec3::ZERO } else { DVec3::Z * -LENGTH };
                let lever = (first..motions.len()).rev().fold(end, |p, j| {
                    let axis = motions[j].direction().unwrap();
                    if motions[j].is_rotation() {
                        DMat3::from_axis_angle(axis, values[j]) * p
                    } else {
                        p + axis * values[j]
                    }
                });
                // Uniform with deviation one: the square of the half width is three.
                let mut vector = || DVec3::from_array([0; 3].map(|_| (noise(&mut n) - 0.5) * 12f64.sqrt()));
                shift += vector() * errors.shift;
                shift += (vector() * errors.turn).cross(lever);
            }
            sum += shift.length_squared();
        }
        (sum / f64::from(draws)).sqrt()
    }

    #[test]
    fn the_error_gain_is_that_of_random_errors() {
        let errors = LinkErrors { shift: 0.004, turn: 3e-5 };
        for text in ["2103", "641203", "612035", "012365", "321064"] {
            let code = CoordinateCode::parse(text).unwrap();
            let (gain, drawn) = (error_gain(&code, STROKE, LENGTH, &errors), drawn(text, &errors));
            assert!((gain - drawn).abs() < 0.01 * gain, "{text}: {gain} {drawn}");
        }
    }

    #[test]
    fn what_moves_what_follows_from_the_bed() {
        let scores = |text: &str, attitude| {
            let code = CoordinateCode::parse(text).unwrap();
            Scores::new(&code, attitude, STROKE, LENGTH, &Masses::default(), &LinkErrors::default())
        };
        let gantry = scores("0123", Attitude::Vertical);
        assert_eq!((gantry.work_links, gantry.moved_mass, gantry.lifted_mass), (0, 9.0, 2.0));
        assert_eq!(gantry.overhang, 700.0); // Y and Z on X
        let cross_table = scores("2103", Attitude::Vertical);
        assert_eq!((cross_table.moved_mass, cross_table.overhang), (7.0, 400.0)); // Y on X
        assert_eq!(scores("2103", Attitude::Horizontal).lifted_mass, 2.0); // Y with the work
        let five = scores("612035", Attitude::Vertical);
        assert_eq!((five.work_rotaries, five.tool_rotaries), (1, 1));
        assert!(cross_table.error_gain < five.error_gain);
    }
}
