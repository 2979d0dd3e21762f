//! Translations that bring the tip to a point when the rotary axes stand: a linear system.
//!
//! The tip is `sum_j q_j R_j a_j + s`, with `R_j` the rotations before the translation `j` and `s` the tip with all
//! translations at zero.

use glam::{DMat3, DVec3};

use super::free::{Free, MOST_FREE};
use super::orient::Branch;

/// Three unit directions whose determinant is above this are solved by determinants, which one step of refinement
/// makes as good as an orthogonal solution.
const WELL_CONDITIONED: f64 = 1e-2;
/// A direction whose part across the others is shorter than this depends on them: rotary positions carry rounding of
/// 1e-16, and positions of 1e9 mm have no use.
const DEPENDENT: f64 = 1e-7;
/// A tip this near [mm] is reached.
const MISS: f64 = 1e-6;

/// Positions of the translations.
pub(super) struct Placed {
    /// By place among the free axes [mm].
    pub(super) values: [f64; MOST_FREE],
    /// Whether a translation depends on the others here and keeps its given position.
    pub(super) dependent: bool,
}

/// The positions for a tip in the machine frame, or the distance at which the tip stays away [mm].
pub(super) fn translations(
    free: &Free,
    branch: &Branch,
    tip: DVec3,
    given: &[f64],
) -> std::result::Result<Placed, f64> {
    let (columns, places, count, rest) = linear_system(free, branch, tip);
    let mut placed = Placed { values: [0.0; MOST_FREE], dependent: false };
    let matrix = DMat3::from_cols(columns[0], columns[1], columns[2]);
    let determinant = matrix.determinant();
    if count == 3 && determinant.abs() > WELL_CONDITIONED {
        let x = by_determinants(&matrix, determinant, rest);
        let x = x + by_determinants(&matrix, determinant, rest - matrix * x);
        for (k, value) in x.to_array().into_iter().enumerate() {
            placed.values[places[k]] = value;
        }
        return Ok(placed);
    }
    let mut start = [0.0; 3];
    for k in 0..count {
        start[k] = free.given(places[k], given);
    }
    let (x, independent) = by_projections(&columns[..count], rest, start);
    let reached: DVec3 = (0..count).map(|k| columns[k] * x[k]).sum();
    let distance = (rest - reached).length();
    if distance > MISS {
        return Err(distance);
    }
    for k in 0..count {
        placed.values[places[k]] = x[k];
    }
    placed.dependent = independent < count;
    Ok(placed)
}

/// Directions of the translations with their places and number, and what they have to bridge.
fn linear_system(free: &Free, branch: &Branch, tip: DVec3) -> ([DVec3; 3], [usize; 3], usize, DVec3) {
    let mut columns = [DVec3::ZERO; 3];
    let mut places = [0; 3];
    let mut count = 0;
    let mut point = free.tool.translation;
    for (k, screw) in free.screws().iter().enumerate().rev() {
        if screw.rotary {
            let turn = branch.turn_of(k);
            point = screw.point + turn * (point - screw.point);
            for column in &mut columns[..count] {
                *column = turn * *column;
            }
        } else {
            columns[count] = screw.direction;
            places[count] = k;
            count += 1;
        }
    }
    (columns, places, count, tip - point)
}

fn by_determinants(m: &DMat3, determinant: f64, b: DVec3) -> DVec3 {
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    DVec3::new(b.dot(y.cross(z)), b.dot(z.cross(x)), b.dot(x.cross(y))) / determinant
}

/// Solves by orthogonal projections, the longest remaining direction first; dependent ones keep their `start`. Returns
/// the positions and the number of independent directions. One step of refinement.
fn by_projections(columns: &[DVec3], rest: DVec3, start: [f64; 3]) -> ([f64; 3], usize) {
    let mut order = [0, 1, 2];
    let mut unit = [DVec3::ZERO; 3];
    // Upper triangle: part of the column `order[j]` along `unit[i]`.
    let mut along = [[0.0; 3]; 3];
    let mut left = [DVec3::ZERO; 3];
    left[..columns.len()].copy_from_slice(columns);
    let mut independent = 0;
    for i in 0..columns.len() {
        let longest = (i..columns.len())
            .max_by(|&p, &q| left[order[p]].length_squared().total_cmp(&left[order[q]].length_squared()));
        let Some(longest) = longest else { break };
        order.swap(i, longest);
        for row in &mut along[..i] {
            row.swap(i, longest);
        }
        let length = left[order[i]].length();
        if length < DEPENDENT {
            break;
        }
        unit[i] = left[order[i]] / length;
        along[i][i] = length;
        for j in i + 1..columns.len() {
            let part = unit[i].dot(left[order[j]]);
            along[i][j] = part;
            left[order[j]] -= unit[i] * part;
        }
        independent += 1;
    }
    let mut x = start;
    for _ in 0..2 {
        let reached: DVec3 = columns.iter().zip(x).map(|(column, value)| *column * value).sum();
        let mut step = [0.0; 3];
        for i in (0..independent).rev() {
            let mut part = unit[i].dot(rest - reached);
            for j in i + 1..independent {
                part -= along[i][j] * step[j];
            }
            step[i] = part / along[i][i];
        }
        for i in 0..independent {
            x[order[i]] += step[i];
        }
    }
    (x, independent)
}
