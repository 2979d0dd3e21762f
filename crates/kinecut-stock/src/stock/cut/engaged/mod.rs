//! Engagement of tools along their moves: the material that each stretch of a move takes, and where it lies about the tool.
//!
//! The moves are cut in order, on all three grids. A line from which a move takes material tells at each of its points when the tool
//! comes there, at which angle from the direction of feed and at which height; ends of material on the lines are exact, so that a
//! pass much thinner than the distance of the lines is measured as what it is.
//!
//! **Error.** Angles are whole degrees; the arc of a stretch of the way, one and a half steps long (of a long move a 2048th), holds all
//! angles at which there is contact anywhere in it. Contact that no line crosses is missed: a move shorter than a step may seem to be in
//! air. A pass narrower than a step is as deep as the lines across it tell, up to a step too little. The three grids tell the volume of a
//! move each by itself; they are weighed, and [`adjust_volumes`] gives what the sum of all lacks to the material that is gone to the moves
//! on which they differ most.

mod taken;

use std::f64::consts::PI;
use std::ops::Range;

use rayon::prelude::*;

use self::taken::{ByPart, Taken, TakenLine};
use super::list::CutList;
use super::noted::{bounds_of, cut_noted, move_of};
use super::task::TileLines;
use super::way::{ToolWay, WaySpan};
use super::{CutMove, CutOptions, ToolBody};
use crate::base::{Progress, Result};
use crate::geom::Aabb;
use crate::stock::tile::TakenStretch;
use crate::stock::tri_dexel::Grid;
use crate::stock::{DexelGrid, TriDexel};

/// Moves that are made ready at once.
const AT_ONCE: usize = 2048;
/// Length of a stretch of a move in steps of the lattice.
const STRETCH: f64 = 1.5;
/// Most stretches of a move.
const MOST_STRETCHES: f64 = 2048.0;
/// Lines of a move whose counts by grid are enough to weigh the grids; of others those of the moves around count, too.
const ENOUGH: f64 = 200.0;
/// Moves around on either side.
const AROUND: usize = 16;

/// A stretch of a move on which its tool takes material.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EngagedStretch {
    /// Fraction of the move at its beginning.
    pub from: f64,
    /// Fraction of the move at its end.
    pub to: f64,
    /// Volume [mm^3].
    pub removed: f64,
    /// Arc about the tool's axis in which it is in contact, all parts together [rad]: at most a full turn.
    pub arc: f64,
    /// Height along the tool's axis over which it is in contact [mm].
    pub depth: f64,
    /// Width across the direction of feed over which it is in contact [mm].
    pub width: f64,
    /// Greatest velocity of the tool's surface into material, along its normal [mm by fraction of the move]: divided by the turns of
    /// the spindle and the teeth in the time of the move it is the greatest thickness of a chip.
    pub advance: f64,
}

/// The stretches of a move on which its tool takes material, in order; none in air.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MoveEngagement {
    /// The stretches.
    pub stretches: Vec<EngagedStretch>,
    /// Spread of its volume as the three grids tell it [mm^3].
    pub spread: f64,
}

impl MoveEngagement {
    /// Volume [mm^3].
    pub fn removed(&self) -> f64 {
        self.stretches.iter().fold(0.0, |sum, s| sum + s.removed)
    }

    /// Part of the way on which the tool takes material, from 0 to 1.
    pub fn share(&self) -> f64 {
        self.stretches.iter().fold(0.0, |sum, s| sum + s.to - s.from).clamp(0.0, 1.0)
    }
}

/// Takes what the moves sweep out of the stock, in order, and tells of each how its tool is engaged. Shanks and holders are left out,
/// and moves that remove nothing. The result does not depend on the number of threads.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::base::Silent;
/// use kinecut::geom::{Aabb, Line, Profile};
/// use kinecut::stock::TriDexel;
/// use kinecut::stock::cut::{CutAxis, CutMove, ToolBody, engagements};
/// let plate = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
/// let mut stock = TriDexel::from_box(plate, 0.5).unwrap();
/// let tool = ToolBody::new(Profile::cylinder(8.0, 20.0).unwrap());
/// // A side of the plate is cut down by 1 mm, 3 mm deep.
/// let side = Line { start: [-10.0, 23.0, -3.0].into(), end: [50.0, 23.0, -3.0].into() };
/// let found = engagements(&mut stock, &[tool], &[CutMove::new(side, CutAxis::PlusZ, 0)], &Silent).unwrap();
/// assert!((found[0].removed() / 120.0 - 1.0).abs() < 1e-3);
/// let middle = found[0].stretches[found[0].stretches.len() / 2];
/// // cos(arc) = 1 - 1 / 4; the chip is thickest where the tool enters or leaves the side of the plate: sin(arc) of the advance.
/// let arc = 0.75f64.acos();
/// assert!((middle.arc - arc).to_degrees().abs() < 1.5);
/// assert!((middle.depth - 3.0).abs() < 1e-4 && (middle.width - 1.0).abs() < 1e-3);
/// assert!((middle.advance / 60.0 - arc.sin()).abs() < 0.02);
/// ```
///
/// # Errors
/// As [`cut`](super::cut()).
pub fn engagements(
    stock: &mut TriDexel,
    bodies: &[ToolBody],
    moves: &[CutMove],
    progress: &dyn Progress,
) -> Result<Vec<MoveEngagement>> {
    let step = stock.lattice().step;
    let bare = |body: &ToolBody| ToolBody { shank: vec![], holder: vec![], ..body.clone() };
    let bodies: Vec<ToolBody> = bodies.iter().map(bare).collect();
    stock.settle(progress);
    progress.stage("engagement", moves.len() as u64);
    let mut all = vec![MoveEngagement::default(); moves.len()];
    let removing: Vec<usize> = (0..moves.len()).filter(|i| moves[*i].removes).collect();
    for some in removing.chunks(AT_ONCE) {
        let own = some.iter().map(|i| CutMove { watch: false, ..moves[*i].clone() }).collect();
        let list = CutList::new(&bodies, own, &CutOptions::default(), step)?;
        for (number, engagement) in of_list(stock, &list, progress)? {
            all[some[number]] = engagement;
        }
        progress.advance(some.len() as u64);
    }
    Ok(all)
}

/// Cuts the moves of a list, and tells of those that take something how their tools are engaged.
fn of_list(
    stock: &mut TriDexel,
    list: &CutList,
    progress: &dyn Progress,
) -> Result<Vec<(usize, MoveEngagement)>> {
    let (lattice, count) = (*stock.lattice(), list.moves.len());
    let taken = cut_noted(stock, list, progress)?;
    let mut is_used = vec![false; count];
    for stretch in taken.iter().flatten().flatten() {
        is_used[move_of(stretch.cut)] = true;
    }
    let ways = (0..count).into_par_iter().map(|i| is_used[i].then(|| way(list, i)).transpose());
    let ways: Vec<Option<(ToolWay<'_>, u32)>> = ways.collect::<Result<_>>()?;
    let mut by_part = ByPart::new();
    for (grid, taken) in stock.grids.iter().zip(&taken) {
        let one = |(t, taken): (usize, &Vec<TakenStretch>)| {
            let lines = TileLines::new(grid, &lattice, t);
            of_tile(grid, &lines, lattice.step, taken, &ways)
        };
        let done: Vec<ByPart> = taken.par_iter().enumerate().map(one).collect();
        for (key, taken) in done.into_iter().flatten() {
            by_part.entry(key).and_modify(|known| known.join(&taken)).or_insert(taken);
        }
    }
    let by_part: Vec<OfPart> = by_part.into_iter().collect();
    let by_move: Vec<&[OfPart]> = by_part.chunk_by(|a, b| a.0.0 == b.0.0).collect();
    let lines: Vec<[f64; 3]> = by_move.iter().map(|own| lines(own)).collect();
    let one = |(place, own): (usize, &&[OfPart])| {
        let index = own[0].0.0 as usize;
        let parts = ways[index].as_ref().map_or(1, |(_, parts)| *parts);
        let weights = weights(&lines, place);
        (index, engagement(own, parts, weights))
    };
    Ok(by_move.iter().enumerate().map(one).collect())
}

/// A stretch of a move, by both their indices, and what it takes.
type OfPart = ((u32, u32), Taken);

/// The way of a move, and the number of its stretches.
fn way(list: &CutList, index: usize) -> Result<(ToolWay<'_>, u32)> {
    let way = ToolWay::of_move(list, index)?;
    let parts = (way.length() / (STRETCH * list.step)).ceil().clamp(1.0, MOST_STRETCHES) as u32;
    Ok((way, parts))
}

/// Material that moves have taken from the lines of a tile.
fn of_tile(
    grid: &Grid,
    lines: &TileLines,
    step: f64,
    taken: &[TakenStretch],
    ways: &[Option<(ToolWay<'_>, u32)>],
) -> ByPart {
    let mut all = ByPart::new();
    // Moves come to a tile one after the other.
    for own in taken.chunk_by(|a, b| a.cut == b.cut) {
        let index = move_of(own[0].cut);
        let Some((way, parts)) = &ways[index] else { continue };
        let near = if way.is_closed() { Vec::new() } else { way.near(bounds_of(grid, lines, own)) };
        let mut nearer: Vec<&WaySpan> = Vec::new();
        for stretch in own {
            let [low, high] = stretch.points(grid.axis, lines);
            nearer.clear();
            nearer.extend(near.iter().filter(|span| span.meets(Aabb { min: low, max: high })));
            let along = grid.axis.index();
            let mut start = low;
            start[along] = 0.0;
            let line =
                TakenLine { index: index as u32, parts: *parts, way, near: &nearer, start, along, step };
            line.note(stretch, &mut all);
        }
    }
    all
}

/// The engagement of a move.
fn engagement(own: &[OfPart], parts: u32, weights: [f64; 3]) -> MoveEngagement {
    let count = f64::from(parts);
    let stretch = |((_, part), taken): &OfPart| EngagedStretch {
        from: f64::from(*part) / count,
        to: f64::from(*part + 1) / count,
        removed: (0..3).map(|k| weights[k] * taken.volume[k]).sum(),
        arc: f64::from(taken.degrees()) * PI / 180.0,
        depth: taken.depth(),
        width: taken.width(),
        advance: taken.advance,
    };
    let stretches: Vec<EngagedStretch> = own.iter().map(stretch).collect();
    let removed: f64 = stretches.iter().map(|s| s.removed).sum();
    let by_grid = [0, 1, 2].map(|k| own.iter().map(|(_, taken)| taken.volume[k]).sum::<f64>());
    let spread = (0..3).map(|k| weights[k] * (by_grid[k] - removed).powi(2)).sum::<f64>().sqrt();
    MoveEngagement { stretches, spread }
}

/// Lines that are cut, by grid.
fn lines(taken: &[OfPart]) -> [f64; 3] {
    let all = |k: usize| taken.iter().map(|(_, taken)| f64::from(taken.lines[k])).sum();
    [0, 1, 2].map(all)
}

/// Weights of the grids for the volume of a move: a grid whose lines a thin body crosses more often tells its volume the better.
fn weights(lines: &[[f64; 3]], number: usize) -> [f64; 3] {
    let own = lines[number];
    let counts = if own.iter().sum::<f64>() >= ENOUGH {
        own
    } else {
        let around: Range<usize> = number.saturating_sub(AROUND)..lines.len().min(number + AROUND + 1);
        lines[around].iter().fold([0.0; 3], |a, b| [0, 1, 2].map(|k| a[k] + b[k]))
    };
    let squares = counts.map(|n| n * n);
    let sum: f64 = squares.iter().sum();
    if sum > 0.0 { squares.map(|n| n / sum) } else { [1.0 / 3.0; 3] }
}

/// Gives what the sum of the volumes of moves lacks to the volume that is gone to those whose volumes are least certain: an adjustment by
/// least squares [mm^3].
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::stock::cut::{EngagedStretch, MoveEngagement, adjust_volumes};
/// let of = |removed: f64, spread: f64| {
///     let all = EngagedStretch { from: 0.0, to: 1.0, removed, ..EngagedStretch::default() };
///     MoveEngagement { stretches: vec![all], spread }
/// };
/// let mut moves = [of(100.0, 4.0), of(5.0, 0.0)];
/// adjust_volumes(&mut moves, 107.0);
/// assert_eq!(moves.map(|m| m.removed()), [102.0, 5.0]);
/// ```
pub fn adjust_volumes<'a>(moves: impl IntoIterator<Item = &'a mut MoveEngagement>, gone: f64) {
    let moves: Vec<&mut MoveEngagement> = moves.into_iter().collect();
    let sum: f64 = moves.iter().map(|m| m.removed()).sum();
    let whole: f64 = moves.iter().map(|m| m.spread * m.spread).sum();
    if whole <= 0.0 {
        return;
    }
    for own in moves {
        let removed = own.removed();
        let factor = 1.0 + (gone - sum) * own.spread * own.spread / (whole * removed);
        for stretch in own.stretches.iter_mut().filter(|_| factor.is_finite()) {
            stretch.removed *= factor.max(0.0);
        }
    }
}
