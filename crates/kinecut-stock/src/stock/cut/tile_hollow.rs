//! A tool with a hollow edge that moves along its axis, against lines along that axis.
//!
//! A line at a distance from the axis loses what lies between the edge there at the tool's lowest position and the
//! top of the tool at its highest; within the inner radius it loses nothing, and what the tool passes over there is
//! noted as its core.

use glam::{DVec2, DVec3};

use super::effect::{Effects, deeper, met};
use super::face::SweptFace;
use super::hollow::{Hollow, left_by};
use super::task::Task;
use crate::stock::tile::Tile;
use crate::stock::unfixed;

/// Cuts the line `l` over a point for a tool over `centre`; true when it was changed.
pub(super) fn cut_line(
    tile: &mut Tile,
    l: usize,
    over: DVec2,
    centre: DVec2,
    task: &Task,
    hollow: &Hollow,
    effects: &mut Effects,
) -> bool {
    let (low, high) = task.tip_range();
    let v = over - centre;
    let rho = v.length();
    let Some(reach) = hollow.reach(rho) else {
        if rho + task.clearance < hollow.inner() {
            core(tile, l, over, task, [low, high + hollow.top], effects);
        }
        return false;
    };
    let (lo, hi) = task.along(low + reach.height, high + hollow.top);
    let (length, ..) = met(tile.line(l), lo, hi);
    if length == 0 {
        return false;
    }
    if let Some(height) = hollow.touches(rho, task.clearance) {
        contact(tile, l, over, task, [height, hollow.top - task.clearance], length, effects);
    }
    if !task.removes {
        return false;
    }
    let (radial, axial) = left_by(reach.slope);
    let e = v.try_normalize().unwrap_or(DVec2::ZERO);
    let face =
        if reach.slope == 0.0 { SweptFace::Floor } else { SweptFace::side(true, task.piece.lowest(), false) };
    let foot = |at| {
        let normal = DVec3::new(radial * e.x, radial * e.y, axial);
        // On the axis of a sharp nub or tip.
        let normal = if normal == DVec3::ZERO { DVec3::Z } else { normal };
        task.end(at, normal, face.class(reach.segment))
    };
    let roof = |at| task.end(at, DVec3::NEG_Z, SweptFace::Roof.class(0));
    let [lower, upper] = if task.frame.sign > 0.0 { [foot(lo), roof(hi)] } else { [roof(lo), foot(hi)] };
    effects.of(task.index).removed += tile.subtract(l, lower, upper);
    true
}

/// Notes a contact of the edge with a line; `length` is the stretch of material that it meets there, `heights` are
/// those of the tool, made smaller by the clearance.
fn contact(
    tile: &Tile,
    l: usize,
    over: DVec2,
    task: &Task,
    heights: [f64; 2],
    length: i64,
    effects: &mut Effects,
) {
    let (low, high) = task.tip_range();
    let (lo, hi) = task.along(low + heights[0], high + heights[1]);
    let (inside, first, last) = met(tile.line(l), lo, hi);
    if inside == 0 {
        return;
    }
    let effect = effects.of(task.index);
    if length > effect.deepest {
        effect.deepest = length;
    }
    let [from, to] = task.piece.fractions;
    let rise = task.piece.rise();
    // A falling tool meets the highest material first, a rising one is in it from the beginning.
    let height = if task.frame.sign > 0.0 { unfixed(last) } else { -unfixed(first) };
    let down = if rise < 0.0 { (height - heights[0] - task.piece.w[0]) / rise } else { 0.0 };
    let t = from + (to - from) * down.clamp(0.0, 1.0);
    if effect.first.is_none_or(|(old, _)| t < old) {
        effect.first = Some((t, task.frame.stock(over.extend(height)).to_array()));
    }
}

/// Notes material within the tool.
fn core(tile: &Tile, l: usize, over: DVec2, task: &Task, heights: [f64; 2], effects: &mut Effects) {
    let (lo, hi) = task.along(heights[0] + task.clearance, heights[1] - task.clearance);
    let (length, first, last) = met(tile.line(l), lo, hi);
    if length > 0 {
        let height = if task.frame.sign > 0.0 { unfixed(last) } else { -unfixed(first) };
        deeper(&mut effects.of(task.index).core, length, || task.frame.stock(over.extend(height)).to_array());
    }
}
