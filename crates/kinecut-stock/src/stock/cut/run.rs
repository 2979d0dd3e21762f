//! Moves to tasks, tasks to tiles and strips, these to threads.

use std::f64::consts::{SQRT_2, TAU};

use glam::DVec2;
use rayon::prelude::*;

use super::axis::ToolFrame;
use super::effect::{Effects, Sum};
use super::hollow::standing;
use super::leaning::cut_leaning;
use super::piece::pieces;
use super::strip::Strip;
use super::task::{Task, TileLines, Tool};
use super::tile_axial::cut_along;
use super::{CutMove, CutOptions, MoveEffect, Stance, ToolBody};
use crate::base::{Code, Error, Finding, Progress, Result};
use crate::geom::CurveKind;
use crate::stock::tile::{TILE_EDGE, Tile};
use crate::stock::tri_dexel::{Grid, LINE_OFFSET};
use crate::stock::{Axis, DexelGrid, Lattice, TriDexel};
use crate::sweep::ToolMotion;

/// Moves sorted into tiles at once: bounds the memory of the lists and the time between two reports of progress.
const BATCH: usize = 512;

/// Smallest path tolerance [mm]: a tenth of an end point's rounding.
const FINEST: f64 = 1e-6;

/// Coordinates of a path beyond this are a slip [mm].
const REACH: f64 = 100_000.0;

/// Turns of a tool in one move beyond this are a slip.
const MOST_LEANING_TURNS: f64 = 1000.0;

/// Turns of one arc beyond this are a slip.
const MOST_TURNS: f64 = 100_000.0;

/// Takes what the moves sweep out of the stock, in order, and tells what each move does.
///
/// The end points that the move `i` leaves carry the cut id `options.first_cut + i + 1`. The result does not depend
/// on the number of threads.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::base::Silent;
/// use kinecut::geom::{Aabb, Line, Profile};
/// use kinecut::stock::TriDexel;
/// use kinecut::stock::cut::{CutMove, CutOptions, CutAxis, ToolBody, cut};
/// let plate = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
/// let mut stock = TriDexel::from_box(plate, 0.25).unwrap();
/// let tool = ToolBody::new(Profile::cylinder(8.0, 20.0).unwrap());
/// let slot = Line { start: [-10.0, 10.0, -3.0].into(), end: [50.0, 10.0, -3.0].into() };
/// let moves = [CutMove::new(slot, CutAxis::PlusZ, 0)];
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
    let lattice = *stock.lattice();
    let tools: Vec<Tool> = bodies.iter().map(|b| Tool::new(b, options, lattice.step)).collect();
    let mut effects = Vec::with_capacity(moves.len());
    progress.stage("cut", moves.len() as u64);
    let runs = moves.chunk_by(|a, b| a.stance.axis() == b.stance.axis()).flat_map(|run| run.chunks(BATCH));
    for batch in runs {
        let first = effects.len();
        let Some(axis) = batch[0].stance.axis() else {
            effects.extend(cut_leaning(stock, &tools, batch, first, options, progress)?);
            continue;
        };
        let frame = ToolFrame::new(axis);
        let mut errors = Vec::with_capacity(batch.len());
        let mut tasks: Vec<Task> = Vec::new();
        for (i, m) in batch.iter().enumerate() {
            let (list, error) = pieces(&m.curve, &frame, options.path_tolerance);
            errors.push(error);
            tasks.extend(list.into_iter().map(|piece| Task {
                piece,
                index: i as u32,
                cut: options.first_cut.wrapping_add((first + i) as u32).wrapping_add(1),
                removes: m.removes,
                watch: m.watch || tools[m.body as usize].hollow.is_some() && standing(&piece.plan).is_none(),
                frame,
                tool: &tools[m.body as usize],
                clearance: options.clearance,
                step: lattice.step,
                plan_box: piece.plan.bounds(),
            }));
        }
        let mut filled = vec![false; batch.len()];
        for task in tasks.iter().filter(|t| t.tool.hollow.is_some() && t.hollow().is_none()) {
            filled[task.index as usize] = true;
        }
        let mut sums: Vec<Sum> = batch.iter().map(|_| Sum::new(false)).collect();
        for grid in &mut stock.grids {
            if grid.axis == frame.axes[2] {
                cut_tiles(grid, &lattice, &tasks, &mut sums, progress);
            } else {
                cut_strips(grid, &lattice, &frame, &tasks, &mut sums, progress);
            }
        }
        if progress.cancelled() {
            return Err(Finding::error(Code::CANCELLED, "cutting was cancelled").into());
        }
        let done = sums.iter().zip(errors).zip(filled);
        effects.extend(done.map(|((sum, error), filled)| sum.effect(lattice.step, error, filled)));
        progress.advance(batch.len() as u64);
    }
    Ok(effects)
}

/// Cuts the grid along the tool axis, tile by tile, and adds up what each move does.
fn cut_tiles(grid: &mut Grid, lattice: &Lattice, tasks: &[Task], sums: &mut [Sum], progress: &dyn Progress) {
    let bins = bins(grid, lattice, tasks);
    let lines: Vec<TileLines> = (0..grid.tiles.len()).map(|t| TileLines::new(grid, lattice, t)).collect();
    let work = grid.tiles.par_iter_mut().zip(&bins).zip(&lines);
    let done: Vec<Effects> = work
        .map(|((tile, bin), lines)| {
            let mut effects = Effects::default();
            if bin.is_empty() || progress.cancelled() {
                return effects;
            }
            let (width, height) = (lines.size[0] as u32, lines.size[1] as u32);
            let mut hull = tile.hull(width, height);
            for task in bin.iter().map(|i| &tasks[*i as usize]) {
                let Some(material) = hull else { break };
                if cut_along(tile, lines, task, material, &mut effects) {
                    hull = tile.hull(width, height);
                }
            }
            effects
        })
        .collect();
    for effect in done.iter().flat_map(Effects::iter) {
        sums[effect.index as usize].add(effect, 0);
    }
}

/// For each tile of the grid along the tool axis the tasks that may reach it, in order.
fn bins(grid: &Grid, lattice: &Lattice, tasks: &[Task]) -> Vec<Vec<u32>> {
    let mut bins = vec![Vec::new(); grid.tiles.len()];
    let across = grid.tiles_across();
    let (a, b) = grid.axis.others();
    let half = 0.5 * lattice.step * f64::from(TILE_EDGE - 1);
    let middles = [(a, across[0]), (b, across[1])].map(|(axis, n)| -> Vec<f64> {
        (0..n).map(|t| lattice.coordinate(axis, t * TILE_EDGE) + half).collect()
    });
    for (i, task) in tasks.iter().enumerate() {
        let swapped = task.frame.sign < 0.0;
        // Half a diagonal, one step more on either side than needed.
        let reach = task.tool.radius + (half + lattice.step) * SQRT_2;
        let (min, max) = (task.plan_box.0 - reach, task.plan_box.1 + reach);
        let (x, y) =
            if swapped { ((min.y, max.y), (min.x, max.x)) } else { ((min.x, max.x), (min.y, max.y)) };
        let range = |k: usize, (from, to): (f64, f64)| {
            let m: &[f64] = &middles[k];
            m.partition_point(|c| *c < from)..m.partition_point(|c| *c <= to)
        };
        for row in range(1, y) {
            for column in range(0, x) {
                let (p, q) = (middles[0][column], middles[1][row]);
                let centre = if swapped { DVec2::new(q, p) } else { DVec2::new(p, q) };
                if task.piece.plan.distance_squared(centre) <= reach * reach {
                    bins[row * across[0] as usize + column].push(i as u32);
                }
            }
        }
    }
    bins
}

/// Cuts a grid across the tool axis, strip by strip, and adds up what each move meets.
fn cut_strips(
    grid: &mut Grid,
    lattice: &Lattice,
    frame: &ToolFrame,
    tasks: &[Task],
    sums: &mut [Sum],
    progress: &dyn Progress,
) {
    let axis = grid.axis;
    let (a, b) = axis.others();
    let (up, side) = if a == frame.axes[2] { (0, b) } else { (1, a) };
    let coordinates = |axis: Axis| -> Vec<f64> {
        (0..lattice.counts[axis.index()]).map(|i| lattice.coordinate(axis, i) + LINE_OFFSET).collect()
    };
    let (rows, heights) = (coordinates(side), coordinates(frame.axes[2]));
    let across = grid.tiles_across();
    let mut columns: Vec<Vec<&mut Tile>> = Vec::new();
    columns.resize_with(across[1 - up] as usize, Vec::new);
    for (t, tile) in grid.tiles.iter_mut().enumerate() {
        let place = [t % across[0] as usize, t / across[0] as usize];
        columns[place[1 - up]].push(tile);
    }
    let work = columns.into_par_iter().zip(rows.par_chunks(TILE_EDGE as usize));
    let done: Vec<Effects> = work
        .map(|(tiles, rows)| {
            let mut strip = Strip::new(tiles, up, rows, &heights);
            let mut effects = Effects::default();
            for task in tasks {
                if progress.cancelled() {
                    break;
                }
                strip.pass(axis, task, &mut effects);
            }
            effects
        })
        .collect();
    let direction = if axis == frame.axes[0] { 1 } else { 2 };
    for effect in done.iter().flat_map(Effects::iter) {
        sums[effect.index as usize].add(effect, direction);
    }
}

/// Checks what comes from outside.
fn check(bodies: &[ToolBody], moves: &[CutMove], options: &CutOptions) -> Result<()> {
    let values = [("path_tolerance", options.path_tolerance, FINEST), ("clearance", options.clearance, 0.0)];
    for (key, value, least) in values {
        if !(value.is_finite() && value >= least) {
            return Err(Finding::error(Code::GEOMETRY, "an option of cutting is out of range")
                .value_mm(value)
                .bound_mm(least)
                .key(key)
                .into());
        }
    }
    for (i, body) in bodies.iter().enumerate() {
        check_edge(body).map_err(|e| e.under(&format!("bodies[{i}]")))?;
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

/// Checks that the edge of a body lies in its cutting part.
fn check_edge(body: &ToolBody) -> Result<()> {
    /// Rounding of sines and roots where both were computed [mm].
    const SAME: f64 = 1e-9;
    let Some(edge) = &body.edge else { return Ok(()) };
    let (extent, profile) = (edge.extent(), &body.cutting);
    let limits = [
        (edge.outer_radius(), profile.max_radius()),
        (profile.bottom(), extent[0]),
        (extent[1], profile.top()),
    ];
    match limits.into_iter().find(|(value, bound)| *value > bound + SAME) {
        Some((value, bound)) => {
            Err(Finding::error(Code::GEOMETRY, "an edge reaches out of its cutting part")
                .value_mm(value)
                .bound_mm(bound)
                .key("edge")
                .into())
        }
        None => Ok(()),
    }
}

fn check_move(m: &CutMove, bodies: usize) -> Result<()> {
    let fail = |what: &str, value: f64, bound: f64, key: &str| -> Error {
        Finding::error(Code::GEOMETRY, what).value(value, "").bound(bound, "").key(key).into()
    };
    if m.body as usize >= bodies {
        return Err(fail("a move names a tool that is not there", f64::from(m.body), bodies as f64, "body"));
    }
    if let Stance::Leaning(motion) = &m.stance {
        check_motion(motion, &fail)?;
    }
    let (start, end) = (m.curve.start(), m.curve.end());
    if !(start.is_finite() && end.is_finite() && m.curve.length().is_finite()) {
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
    let far = start.abs().max_element().max(end.abs().max_element());
    if far > REACH {
        return Err(fail("the path of a move is too far out", far, REACH, "curve"));
    }
    Ok(())
}

/// Checks a motion by its ends and its middle.
fn check_motion(motion: &ToolMotion, fail: &dyn Fn(&str, f64, f64, &str) -> Error) -> Result<()> {
    for t in [0.0, 0.5, 1.0] {
        let jet = motion.at(t);
        let (far, turns) = (jet.pose.translation.abs().max_element(), jet.twist.turn.length() / TAU);
        if !(far <= REACH) {
            return Err(fail("the path of a move is too far out", far, REACH, "stance"));
        }
        if !(turns <= MOST_LEANING_TURNS) {
            return Err(fail("a tool turns over too often in one move", turns, MOST_LEANING_TURNS, "stance"));
        }
    }
    Ok(())
}
