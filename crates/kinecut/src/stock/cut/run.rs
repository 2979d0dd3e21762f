//! Moves to tasks, tasks to tiles, tiles to threads.

use std::f64::consts::{SQRT_2, TAU};

use glam::DVec2;
use rayon::prelude::*;

use super::axis::Frame;
use super::effect::{Effects, Sum};
use super::piece::pieces;
use super::task::{Task, TileLines, Tool};
use super::tile_across::cut_across;
use super::tile_axial::cut_along;
use super::{CutMove, CutOptions, MoveEffect, ToolBody};
use crate::base::{Code, Error, Finding, Progress, Result};
use crate::geom::CurveKind;
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, DexelGrid, Lattice, TriDexel};

/// Moves binned at once: bounds the memory of the bins and the time between two reports of progress.
const BATCH: usize = 512;

/// Smallest path tolerance [mm]: a tenth of an end point's rounding.
const FINEST: f64 = 1e-6;

/// Coordinates of a path beyond this are a slip [mm].
const REACH: f64 = 100_000.0;

/// Turns of one arc beyond this are a slip.
const MOST_TURNS: f64 = 100_000.0;

/// Takes what the moves sweep out of the stock, in order, and tells what each move does.
///
/// The end points that the move `i` leaves carry the cut id `options.first_cut + i + 1`. The result does not depend
/// on the number of threads.
///
/// ```
/// use kinecut::base::Silent;
/// use kinecut::geom::{Aabb, Line, Profile};
/// use kinecut::stock::TriDexel;
/// use kinecut::stock::cut::{CutMove, CutOptions, ToolAxis, ToolBody, cut};
/// let plate = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
/// let mut stock = TriDexel::from_box(plate, 0.25).unwrap();
/// let tool = ToolBody { cutting: Profile::cylinder(8.0, 20.0).unwrap(), shank: vec![], holder: vec![] };
/// let slot = Line { start: [-10.0, 10.0, -3.0].into(), end: [50.0, 10.0, -3.0].into() };
/// let moves = [CutMove::new(slot, ToolAxis::PlusZ, 0)];
/// let effects = cut(&mut stock, &[tool], &moves, &CutOptions::default(), &Silent).unwrap();
/// assert!((effects[0].removed - 40.0 * 8.0 * 3.0).abs() < 1e-6);
/// assert!((stock.volume() - 8000.0 + 960.0).abs() < 1e-6);
/// ```
///
/// # Errors
/// `KC0801` for a move whose path is not finite or too far out, or that names no tool, and for options out of range:
/// the stock is then as it was. `KC0009` when cancelled: the stock is then cut in part and of no use.
pub fn cut(
    stock: &mut TriDexel,
    bodies: &[ToolBody],
    moves: &[CutMove],
    options: &CutOptions,
    progress: &dyn Progress,
) -> Result<Vec<MoveEffect>> {
    check(bodies, moves, options)?;
    let tools: Vec<Tool> = bodies.iter().map(|b| Tool::new(b, options)).collect();
    let lattice = *stock.lattice();
    let lines = stock.grids.each_ref().map(|grid| -> Vec<TileLines> {
        (0..grid.tiles.len()).map(|t| TileLines::new(grid, &lattice, t)).collect()
    });
    let mut bins = stock.grids.each_ref().map(|grid| vec![Vec::new(); grid.tiles.len()]);
    let mut effects = Vec::with_capacity(moves.len());
    progress.stage("cut", moves.len() as u64);
    for (batch, part) in moves.chunks(BATCH).enumerate() {
        let first = batch * BATCH;
        let mut errors = Vec::with_capacity(part.len());
        let mut tasks = Vec::new();
        for (i, m) in part.iter().enumerate() {
            let frame = Frame::new(m.axis);
            let (list, error) = pieces(&m.curve, &frame, options.path_tolerance);
            errors.push(error);
            tasks.extend(list.into_iter().map(|piece| Task {
                piece,
                index: i as u32,
                cut: options.first_cut.wrapping_add((first + i) as u32).wrapping_add(1),
                removes: m.removes,
                frame,
                tool: &tools[m.body as usize],
                plan_box: piece.plan.bounds(),
            }));
        }
        let mut sums: Vec<Sum> = part.iter().map(|_| Sum::new()).collect();
        for ((grid, lines), bins) in stock.grids.iter_mut().zip(&lines).zip(&mut bins) {
            fill_bins(bins, grid, &lattice, &tasks);
            cut_grid(grid, lines, bins, &tasks, &mut sums, progress);
        }
        if progress.cancelled() {
            return Err(Finding::error(Code::CANCELLED, "cutting was cancelled").into());
        }
        effects.extend(sums.iter().zip(errors).map(|(sum, error)| sum.effect(lattice.step, error)));
        progress.advance(part.len() as u64);
    }
    Ok(effects)
}

/// Cuts one grid with the tasks of some moves and adds up what each does.
fn cut_grid(
    grid: &mut Grid,
    lines: &[TileLines],
    bins: &[Vec<u32>],
    tasks: &[Task],
    sums: &mut [Sum],
    progress: &dyn Progress,
) {
    let axis = grid.axis;
    let work = grid.tiles.par_iter_mut().zip(bins).zip(lines);
    let done: Vec<Effects> = work
        .map(|((tile, bin), lines)| {
            let mut effects = Effects::default();
            if bin.is_empty() || progress.cancelled() {
                return effects;
            }
            let (width, height) = (lines.size[0] as u32, lines.size[1] as u32);
            let mut hull = tile.hull(width, height);
            for task in bin.iter().map(|i| &tasks[*i as usize]) {
                let Some((lo, hi)) = hull else { break };
                let changed = if task.frame.axes[2] == axis {
                    let (low, high) = task.tip_range();
                    let reach = task.along(low + task.tool.bottom, high + task.tool.top);
                    reach.0 < hi && lo < reach.1 && cut_along(tile, lines, task, &mut effects)
                } else {
                    cut_across(tile, lines, axis, task)
                };
                if changed {
                    hull = tile.hull(width, height);
                }
            }
            effects
        })
        .collect();
    for effect in done.iter().flat_map(Effects::iter) {
        sums[effect.index as usize].add(effect);
    }
}

/// For each tile of a grid the tasks that may reach it, in order.
fn fill_bins(bins: &mut [Vec<u32>], grid: &Grid, lattice: &Lattice, tasks: &[Task]) {
    bins.iter_mut().for_each(Vec::clear);
    let (a, b) = grid.axis.others();
    let across = grid.tiles_across();
    let half = 0.5 * lattice.step * f64::from(TILE_EDGE - 1);
    for (i, task) in tasks.iter().enumerate() {
        let along_tool = task.frame.axes[2] == grid.axis;
        // Shank and holder are looked at along the tool axis only.
        let tool = task.tool;
        let (radius, bottom, top) = if along_tool {
            (tool.radius, tool.bottom, tool.top)
        } else {
            (tool.cutting.radius, tool.cutting.bottom, tool.cutting.top)
        };
        let (low, high) = task.tip_range();
        let (min, max) = (task.plan_box.0 - radius, task.plan_box.1 + radius);
        let local = [(min.x, max.x), (min.y, max.y), (low + bottom, high + top)];
        let range = |k: usize| {
            let axis = [a, b][k];
            let of = task.frame.axes.iter().position(|x| *x == axis).map_or((0.0, 0.0), |p| local[p]);
            let of = if task.frame.axes[2] == axis && task.frame.sign < 0.0 { (-of.1, -of.0) } else { of };
            let origin = lattice.origin[axis.index()];
            // One line more on either side than needed.
            let tile =
                |x: f64, more: f64| (((x - origin) / lattice.step + more) / f64::from(TILE_EDGE)).floor();
            let (from, to) = (tile(of.0, -1.0), tile(of.1, 1.0));
            let last = f64::from(across[k]) - 1.0;
            if to < 0.0 || from > last {
                1..1
            } else {
                from.clamp(0.0, last) as usize..to.clamp(0.0, last) as usize + 1
            }
        };
        let (columns, rows) = (range(0), range(1));
        for row in rows {
            for column in columns.clone() {
                if along_tool {
                    let middle =
                        |axis: Axis, tile: usize| lattice.coordinate(axis, tile as u32 * TILE_EDGE) + half;
                    let (p, q) = (middle(a, column), middle(b, row));
                    let centre = if task.frame.sign > 0.0 { DVec2::new(p, q) } else { DVec2::new(q, p) };
                    // Half a diagonal, one step more on either side than needed.
                    let reach = radius + (half + lattice.step) * SQRT_2;
                    if task.piece.plan.distance_squared(centre) > reach * reach {
                        continue;
                    }
                }
                bins[row * across[0] as usize + column].push(i as u32);
            }
        }
    }
}

/// Checks what comes from outside.
fn check(bodies: &[ToolBody], moves: &[CutMove], options: &CutOptions) -> Result<()> {
    for (key, value, least) in
        [("path_tolerance", options.path_tolerance, FINEST), ("clearance", options.clearance, 0.0)]
    {
        if !(value.is_finite() && value >= least) {
            return Err(Finding::error(Code::GEOMETRY, "an option of cutting is out of range")
                .value_mm(value)
                .bound_mm(least)
                .key(key)
                .into());
        }
    }
    for (i, body) in bodies.iter().enumerate() {
        if let Some((_, z)) = body.shank.iter().chain(&body.holder).find(|(_, z)| !z.is_finite()) {
            return Err(Finding::error(Code::GEOMETRY, "a height of the shank or holder is not finite")
                .value_mm(*z)
                .key(format!("bodies[{i}]"))
                .into());
        }
    }
    for (i, m) in moves.iter().enumerate() {
        check_move(m, bodies.len()).map_err(|e| e.under(&format!("moves[{i}]")))?;
    }
    Ok(())
}

fn check_move(m: &CutMove, bodies: usize) -> Result<()> {
    let fail = |what: &str, value: f64, bound: f64, key: &str| -> Error {
        Finding::error(Code::GEOMETRY, what).value(value, "").bound(bound, "").key(key).into()
    };
    if m.body as usize >= bodies {
        return Err(fail("a move names a tool that is not there", f64::from(m.body), bodies as f64, "body"));
    }
    let (start, end) = (m.curve.start(), m.curve.end());
    let far = start.abs().max_element().max(end.abs().max_element()).max(m.curve.length());
    // Also for NaN, which `max` may pass over.
    if !(start.is_finite() && end.is_finite() && far.is_finite()) {
        return Err(fail("the path of a move is not finite", f64::NAN, REACH, "curve"));
    }
    let turns = match m.curve.kind() {
        CurveKind::Arc(arc) => arc.sweep.abs() / TAU,
        CurveKind::Involute { record, .. } => record.turn(record.length()).abs() / TAU,
        _ => 0.0,
    };
    if turns > MOST_TURNS {
        return Err(fail("an arc has too many turns", turns, MOST_TURNS, "curve"));
    }
    if start.abs().max_element().max(end.abs().max_element()) > REACH {
        return Err(fail("the path of a move is too far out", far, REACH, "curve"));
    }
    Ok(())
}
