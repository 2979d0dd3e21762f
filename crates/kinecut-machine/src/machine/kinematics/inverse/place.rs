//! Translations that bring the tip to a point at given rotary positions: a linear system.
//!
//! The tip is `sum_j q_j R_j a_j + s`, with `R_j` the rotations before the translation `j` and `s` the tip with all
//! translations at zero. The system is set up in the frame in which most translations keep their directions, so that
//! mostly the right side alone is turned.

use glam::DVec3;

use super::free::{Free, MOST_FREE};
use super::orient::Branch;

/// Three unit directions whose determinant is above this are solved by determinants, which one step of refinement
/// makes as good as an orthogonal solution.
const WELL_CONDITIONED: f64 = 1e-2;
/// Above this, determinants are as good as that without refinement.
const NEARLY_SQUARE: f64 = 0.5;
/// A direction whose part across the others is shorter than this depends on them: rotary positions carry rounding of
/// 1e-16, and positions of 1e9 mm have no use.
const DEPENDENT: f64 = 1e-7;
/// A tip this near [mm] is reached.
const MISS: f64 = 1e-6;

/// Positions of the translations.
pub(super) struct Placed {
    /// By place among the free axes [mm].
    pub(super) values: [f64; MOST_FREE],
    /// True if a translation depends on the others here and keeps its given position.
    pub(super) dependent: bool,
}

/// The positions for a tip in the machine frame, or the distance at which the tip stays away [mm].
#[inline]
pub(super) fn translations(
    free: &Free,
    branch: &Branch,
    tip: DVec3,
    given: &[f64],
) -> std::result::Result<Placed, f64> {
    let (columns, places, count, rest) = linear_system(free, branch, tip);
    let mut placed = Placed { values: [0.0; MOST_FREE], dependent: false };
    let [a, b, c] = columns;
    let sides = [b.cross(c), c.cross(a), a.cross(b)];
    let determinant = a.dot(sides[0]);
    if count == 3 && determinant.abs() > WELL_CONDITIONED {
        let solve = |b: DVec3| DVec3::from_array(sides.map(|side| side.dot(b))) / determinant;
        let mut x = solve(rest);
        if determinant.abs() < NEARLY_SQUARE {
            x += solve(rest - (a * x.x + b * x.y + c * x.z));
        }
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
#[inline]
fn linear_system(free: &Free, branch: &Branch, tip: DVec3) -> ([DVec3; 3], [usize; 3], usize, DVec3) {
    let screws = free.screws();
    // Translations before the first rotation, between both, after the last; the frame of most of them.
    let mut groups = [0usize; 3];
    let mut group = 0;
    for screw in screws {
        if screw.rotary {
            group += 1;
        } else {
            groups[group] += 1;
        }
    }
    let frame = if groups[0] >= 2 {
        0
    } else if groups[2] >= 2 {
        2
    } else {
        1
    };
    let turns = branch.turns();
    let mut columns = [DVec3::ZERO; 3];
    let mut places = [0; 3];
    let mut count = 0;
    let mut group = 0;
    let (mut near, mut far) = (tip, free.tool.translation);
    for (k, screw) in screws.iter().enumerate() {
        if screw.rotary {
            if group < frame {
                near = screw.point + turns[group].transpose() * (near - screw.point);
            }
            group += 1;
            continue;
        }
        let mut column = screw.direction;
        for turn in turns.iter().take(group).skip(frame).rev() {
            column = *turn * column;
        }
        for turn in turns.iter().take(frame).skip(group) {
            column = turn.transpose() * column;
        }
        columns[count] = column;
        places[count] = k;
        count += 1;
    }
    for screw in screws.iter().rev().filter(|screw| screw.rotary) {
        group -= 1;
        if group >= frame {
            far = screw.point + turns[group] * (far - screw.point);
        }
    }
    (columns, places, count, near - far)
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
