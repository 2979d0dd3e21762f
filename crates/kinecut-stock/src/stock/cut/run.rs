//! Cutting a list of moves: what comes from outside is checked, runs of moves go to those that cut them.

use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use super::leaning::cut_leaning;
use super::list::CutList;
use super::upright::cut_upright;
use super::{CutMove, CutOptions, MoveEffect, Stance, ToolBody};
use crate::base::{Code, Error, Finding, Progress, Result};
use crate::geom::CurveKind;
use crate::stock::skimmed::Skimmed;
use crate::stock::{DexelGrid, TriDexel};
use crate::sweep::ToolMotion;

/// Moves sorted into tiles at once: bounds the memory of the lists and the time between two reports of progress.
pub(super) const BATCH: usize = 512;

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
    let list = CutList::new(bodies, moves.to_vec(), options, stock.lattice().step)?;
    cut_list(stock, &list, 0..moves.len(), progress)
}

/// As [`cut`], with moves made ready: a range of them. The moves are kept by the stock until they have cut all of its lines, which
/// happens when these are asked for.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::base::Silent;
/// use kinecut::geom::{Aabb, Line, Profile};
/// use kinecut::stock::TriDexel;
/// use kinecut::stock::cut::{CutAxis, CutList, CutMove, CutOptions, ToolBody, cut_list};
/// let plate = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
/// let mut stock = TriDexel::from_box(plate, 0.25).unwrap();
/// let tool = [ToolBody::new(Profile::cylinder(8.0, 20.0).unwrap())];
/// let slot = |z: f64| Line { start: [-10.0, 10.0, z].into(), end: [50.0, 10.0, z].into() };
/// let moves = [-1.0, -3.0].map(|z| CutMove::new(slot(z), CutAxis::PlusZ, 0)).to_vec();
/// let list = CutList::new(&tool, moves, &CutOptions::default(), 0.25).unwrap();
/// // A look at the stock between the two cuts.
/// let first = cut_list(&mut stock, &list, 0..1, &Silent).unwrap();
/// assert!((stock.volume() - 8000.0 + 320.0).abs() < 1e-6);
/// let second = cut_list(&mut stock, &list, 1..2, &Silent).unwrap();
/// assert!((first[0].removed + second[0].removed - 960.0).abs() < 1e-6);
/// stock.settle(&Silent);
/// assert!(stock.volumes().iter().all(|volume| (volume - 8000.0 + 960.0).abs() < 1e-3));
/// ```
///
/// # Errors
/// `KC0801` for a range that the list does not have, or a list for another step; `KC0009` as [`cut`].
pub fn cut_list(
    stock: &mut TriDexel,
    list: &Arc<CutList>,
    range: Range<usize>,
    progress: &dyn Progress,
) -> Result<Vec<MoveEffect>> {
    cut_as(stock, list, range, Order::InRuns, progress)
}

/// The way in which moves are cut; the lines are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    /// In long runs, as far as those tell all that has to be told.
    InRuns,
    /// In runs of which only the outcome counts, however short.
    #[cfg(test)]
    AtOnce,
    /// Line by line in the order of the moves: what the other way is compared with.
    #[cfg(test)]
    OneByOne,
}

impl Order {
    /// In runs, long or short.
    pub(super) fn is_in_runs(self) -> bool {
        match self {
            Order::InRuns => true,
            #[cfg(test)]
            Order::AtOnce => true,
            #[cfg(test)]
            Order::OneByOne => false,
        }
    }
}

/// Cuts moves in one of these ways.
pub(super) fn cut_as(
    stock: &mut TriDexel,
    list: &Arc<CutList>,
    range: Range<usize>,
    order: Order,
    progress: &dyn Progress,
) -> Result<Vec<MoveEffect>> {
    if range.start > range.end || range.end > list.moves.len() {
        return Err(Finding::error(Code::GEOMETRY, "the list has no moves there")
            .value(range.end as f64, "")
            .bound(list.moves.len() as f64, "")
            .into());
    }
    if list.step != stock.lattice().step {
        return Err(Finding::error(
            Code::GEOMETRY,
            "the moves were made ready for a stock with another step",
        )
        .value_mm(list.step)
        .bound_mm(stock.lattice().step)
        .into());
    }
    stock.take_back();
    let (lattice, bounds) = (*stock.lattice(), stock.bounds());
    let inside = bounds.grown(-lattice.step);
    let note = |mut skimmed: Skimmed, i: usize| {
        list.taken(i, inside).for_each(|part| skimmed.note(&lattice, bounds, part));
        skimmed
    };
    let mut effects = Vec::with_capacity(range.len());
    progress.stage("cut", range.len() as u64);
    // By one of the threads that share the work: none has to be woken for each of thousands of short runs.
    rayon::scope(|_| {
        let removing = range.clone().into_par_iter().with_min_len(BATCH).filter(|i| list.moves[*i].removes);
        let skimmed = removing.fold(|| Skimmed::WHOLE, note).reduce(|| Skimmed::WHOLE, Skimmed::with);
        stock.skimmed = stock.skimmed.with(skimmed);
        for stretch in list.stretches(range) {
            match list.moves[stretch.start].stance.axis() {
                Some(axis) => cut_upright(stock, (axis, order), list, stretch, &mut effects, progress)?,
                None => cut_leaning(stock, order, list, stretch, &mut effects, progress)?,
            }
        }
        Ok(effects)
    })
}

/// Whether the caller still waits for the result.
pub(super) fn still_wanted(progress: &dyn Progress) -> Result<()> {
    match progress.cancelled() {
        true => Err(Finding::error(Code::CANCELLED, "cutting was cancelled").into()),
        false => Ok(()),
    }
}

/// Checks what comes from outside.
pub(super) fn check(bodies: &[ToolBody], moves: &[CutMove], options: &CutOptions) -> Result<()> {
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
