//! The objective over all placements, for pictures.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::Options;
use super::domain::Domain;
use super::objective::Objective;
use crate::base::{Code, Finding, Progress, Result, Silent};
use crate::facing::FaceCase;

/// Values over orientation and share of the offset's range.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectiveMap {
    /// Number of angles: the i-th is 2 pi i / columns.
    pub columns: usize,
    /// Number of shares: the j-th is j / (rows - 1) of the range allowed at the angle, from its least offset.
    pub rows: usize,
    /// Weighted bad lengths [mm], angle by angle; `None` where no placement is allowed.
    pub values: Vec<Option<f64>>,
    /// Least and greatest offset allowed at each angle [mm]; the first exceeds the second where no offset is allowed.
    pub offsets: Vec<[f64; 2]>,
}

/// Fewest columns and rows of a map of an outline of many edges.
const LEAST: [usize; 2] = [36, 9];
/// Most values of a single edge that a map works out: above, it has fewer columns and rows. Outlines of up to 4000 edges
/// have maps of 180 by 41.
const MOST_WORK: f64 = 3e7;

/// Columns and rows of a map of an outline with so many edges that it is worked out in a second or two, and at most these.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::facing::optimum::map_size;
/// assert_eq!(map_size([180, 41], 400), [180, 41]);
/// assert_eq!(map_size([180, 41], 20_000), [81, 18]);
/// ```
pub fn map_size([columns, rows]: [usize; 2], edges: usize) -> [usize; 2] {
    let work = columns as f64 * rows as f64 * edges as f64;
    let share = if work > MOST_WORK { (MOST_WORK / work).sqrt() } else { 1.0 };
    let less = |n: usize, least: usize| ((share * n as f64) as usize).max(least);
    [less(columns, LEAST[0]), less(rows, LEAST[1])]
}

/// The weighted bad length over a grid of placements, forbidden orientations left out.
///
/// # Errors
/// `KC1001` for options that make no sense.
pub fn objective_map(
    case: &FaceCase,
    options: &Options,
    columns: usize,
    rows: usize,
) -> Result<ObjectiveMap> {
    objective_map_watched(case, options, [columns, rows], &Silent)
}

/// The same for a map that may be given up: of an outline of many edges it takes seconds.
///
/// # Errors
/// As [`objective_map`]; `KC0009` when cancelled.
pub fn objective_map_watched(
    case: &FaceCase,
    options: &Options,
    [columns, rows]: [usize; 2],
    progress: &dyn Progress,
) -> Result<ObjectiveMap> {
    options.check(case)?;
    progress.stage("map", columns as u64);
    let domain = Domain::new(case, options);
    let objective = Objective::new(case, &domain);
    let column = |i: usize| {
        if progress.cancelled() {
            return Err(Finding::error(Code::CANCELLED, "the work was cancelled").into());
        }
        progress.advance(1);
        let angle = TAU * i as f64 / columns as f64;
        let spans = if domain.allows(angle) { domain.offsets(angle) } else { [[1.0, 0.0]; 2] };
        let open: Vec<[f64; 2]> = spans.into_iter().filter(|s| s[0] <= s[1]).collect();
        let (Some(first), Some(last)) = (open.first(), open.last()) else {
            return Ok(([f64::INFINITY, f64::NEG_INFINITY], vec![None; rows]));
        };
        let range = [first[0], last[1]];
        let values = (0..rows).map(|j| {
            let share = if rows > 1 { j as f64 / (rows - 1) as f64 } else { 0.5 };
            let local = range[0] + share * (range[1] - range[0]);
            // A distance from the middle shuts a part of the range.
            let inside = open.iter().any(|s| s[0] <= local && local <= s[1]);
            inside.then(|| objective.at([angle, local]))
        });
        let shift = domain.placement(angle, 0.0).offset;
        Ok((range.map(|c| c + shift), values.collect()))
    };
    let made: Result<Vec<_>> = (0..columns).into_par_iter().map(column).collect();
    let (offsets, values): (Vec<[f64; 2]>, Vec<Vec<Option<f64>>>) = made?.into_iter().unzip();
    Ok(ObjectiveMap { columns, rows, values: values.into_iter().flatten().collect(), offsets })
}
