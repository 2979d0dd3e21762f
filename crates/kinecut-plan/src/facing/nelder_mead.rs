//! The paper's optimiser, kept as the baseline: Nelder and Mead's simplex (1965) in orientation and offset.
//!
//! The worst vertex of the triangle is replaced (the paper says the nearest): mirrored in the middle of the others,
//! stretched when that is best, drawn in when it is bad, or the whole triangle shrinks onto its best vertex. Points
//! that are not allowed, because they do not cover the part or break a constraint of the placement, are worse than any
//! that are, the more the farther: so an end compares with the certified optimum of the same constraints. It ends in a
//! local minimum: which one is a matter of the start.

use std::f64::consts::TAU;

use rayon::prelude::*;
use serde::Serialize;

use super::optimum::{AllowedPlacements, Options};
use super::{FaceCase, Objective, Placement};
use crate::base::{Code, Error, Finding, Progress, Result};
use crate::num::random::Random;

/// Steps, tolerances and limits of the simplex.
#[derive(Clone, Debug, PartialEq)]
pub struct NelderMead {
    /// First step in orientation [rad].
    pub angle_step: f64,
    /// First step in offset, per radius of the cutter.
    pub offset_step: f64,
    /// It ends when no vertex is farther from the best than this [rad and mm] ...
    pub placement_tolerance: f64,
    /// ... and no value differs from the best by more than this [mm].
    pub value_tolerance: f64,
    /// Most iterations.
    pub iterations: u32,
    /// Constraints of the placement; the limits of the search in them are not used.
    pub constraints: Options,
}

impl NelderMead {
    /// The same as [`NelderMead::within`] with this margin as the only constraint.
    pub fn with_margin(margin: f64) -> NelderMead {
        NelderMead::within(&Options { margin, ..Options::for_cutter(0.0) })
    }

    /// Steps of 10 degrees and a tenth of the radius, tolerances of 1e-7 and 1e-9, 400 iterations, and the constraints
    /// of these options.
    pub fn within(constraints: &Options) -> NelderMead {
        NelderMead {
            angle_step: 10f64.to_radians(),
            offset_step: 0.1,
            placement_tolerance: 1e-7,
            value_tolerance: 1e-9,
            iterations: 400,
            constraints: constraints.clone(),
        }
    }
}

/// The descent of a simplex: its start and its end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SimplexDescent {
    /// Placement at the start.
    pub start: Placement,
    /// Placement at the end; in JSON `end`.
    #[serde(rename = "end")]
    pub placement: Placement,
    /// The value there [mm]; more than the weighted perimeter if no point it saw is allowed.
    pub value: f64,
    /// Evaluations of the objective, points that are not allowed included.
    pub evaluations: u32,
}

/// A corner of the triangle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SimplexCorner {
    /// Its placement; the angle may lie beyond a full turn.
    #[serde(flatten)]
    pub placement: Placement,
    /// The value there [mm]; more than the weighted perimeter where the placement is not allowed.
    pub value: f64,
}

/// The triangle before an iteration, or at the end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SimplexStep {
    /// Its corners, the best first.
    pub corners: [SimplexCorner; 3],
    /// Evaluations of the objective so far.
    pub evaluations: u32,
}

/// Statistics of descents from many starts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DescentStatistics {
    /// Least value [mm].
    pub best: f64,
    /// Median of the values [mm].
    pub median: f64,
    /// Largest value [mm].
    pub worst: f64,
    /// Share of the starts that ended within 1 % of the optimum.
    pub within_one_percent: f64,
    /// Mean number of evaluations of a start.
    pub evaluations: f64,
}

impl SimplexDescent {
    /// True if the end is an allowed placement, so that its value is a bad length of this case.
    pub fn is_allowed(&self, case: &FaceCase) -> bool {
        self.value < beyond(case)
    }
}

/// More than any allowed placement's value [mm].
fn beyond(case: &FaceCase) -> f64 {
    case.weighted_perimeter() * case.bad.largest_weight() + 1.0
}

impl DescentStatistics {
    /// The statistics of descents against the optimum [mm]; none of no descents.
    pub fn of(descents: &[SimplexDescent], optimum: f64) -> Option<DescentStatistics> {
        let mut values: Vec<f64> = descents.iter().map(|d| d.value).collect();
        values.sort_by(f64::total_cmp);
        let (&best, &worst) = (values.first()?, values.last()?);
        let n = values.len();
        let median = 0.5 * (values[(n - 1) / 2] + values[n / 2]);
        // A share of nothing is nothing: an optimum of 0 is hit to the tolerance of the values.
        let near = |v: &&f64| **v <= 1.01 * optimum + 1e-9;
        let within_one_percent = values.iter().filter(near).count() as f64 / n as f64;
        let evaluations = descents.iter().map(|d| f64::from(d.evaluations)).sum::<f64>() / n as f64;
        Some(DescentStatistics { best, median, worst, within_one_percent, evaluations })
    }
}

/// Runs the simplex from a start.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::{BadSet, FaceCase, NelderMead, Objective, Placement, descend};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)])?;
/// let case = FaceCase::new(plate, 80.0, BadSet::below(90f64.to_radians())?)?;
/// let start = Placement { angle: 0.3, offset: 40.0 };
/// let end = descend(&case, &Objective::Limit, &NelderMead::with_margin(1.0), start)?;
/// assert!(end.value < 160.0 && end.evaluations < 800);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
///
/// # Errors
/// As [`Objective::value`]; `KC1001` for constraints that make no sense.
pub fn descend(
    case: &FaceCase,
    objective: &Objective,
    options: &NelderMead,
    start: Placement,
) -> Result<SimplexDescent> {
    let allowed = AllowedPlacements::new(case, &options.constraints)?;
    run(case, objective, options, &allowed, start, |_, _| Ok(()))
}

/// Runs the simplex from a start, with each triangle on its way; of an outline of many edges that takes seconds.
///
/// # Errors
/// As [`descend`]; `KC0009` when cancelled.
pub fn descend_steps(
    case: &FaceCase,
    objective: &Objective,
    options: &NelderMead,
    start: Placement,
    progress: &dyn Progress,
) -> Result<(SimplexDescent, Vec<SimplexStep>)> {
    let mut steps = Vec::new();
    let corner =
        |v: Vertex| SimplexCorner { placement: Placement { angle: v.x[0], offset: v.x[1] }, value: v.value };
    let allowed = AllowedPlacements::new(case, &options.constraints)?;
    progress.stage("walk", u64::from(options.iterations));
    let descent = run(case, objective, options, &allowed, start, |simplex, evaluations| {
        steps.push(SimplexStep { corners: simplex.map(corner), evaluations });
        progress.advance(1);
        if progress.cancelled() { Err(cancelled()) } else { Ok(()) }
    })?;
    Ok((descent, steps))
}

fn cancelled() -> Error {
    Finding::error(Code::CANCELLED, "the work was cancelled").into()
}

fn run(
    case: &FaceCase,
    objective: &Objective,
    options: &NelderMead,
    allowed: &AllowedPlacements<'_>,
    start: Placement,
    mut seen: impl FnMut([Vertex; 3], u32) -> Result<()>,
) -> Result<SimplexDescent> {
    let worst = beyond(case);
    let evaluations = std::cell::Cell::new(0);
    let at = |x: [f64; 2]| -> Result<Vertex> {
        evaluations.set(evaluations.get() + 1);
        let short = allowed.shortfall(Placement { angle: x[0], offset: x[1] });
        // Rounding of a point at the bound.
        if short > 1e-9 {
            return Ok(Vertex { x, value: worst + short });
        }
        let value = objective.value(case, Placement { angle: x[0], offset: x[1] })?;
        Ok(Vertex { x, value })
    };
    let x = [start.angle, start.offset];
    let mut simplex = [
        at(x)?,
        at([x[0] + options.angle_step, x[1]])?,
        at([x[0], x[1] + options.offset_step * case.radius])?,
    ];
    simplex.sort_by(Vertex::order);
    seen(simplex, evaluations.get())?;
    for _ in 0..options.iterations {
        let [best, middle, last] = simplex;
        let far = [middle, last].iter().any(|v| {
            (0..2).any(|i| (v.x[i] - best.x[i]).abs() > options.placement_tolerance)
                || (v.value - best.value).abs() > options.value_tolerance
        });
        if !far {
            break;
        }
        let centre = [0.5 * (best.x[0] + middle.x[0]), 0.5 * (best.x[1] + middle.x[1])];
        let away = |share: f64| [0, 1].map(|i| centre[i] + share * (centre[i] - last.x[i]));
        let mirrored = at(away(1.0))?;
        let taken = if mirrored.value < best.value {
            let stretched = at(away(2.0))?;
            Some(if stretched.value < mirrored.value { stretched } else { mirrored })
        } else if mirrored.value < middle.value {
            Some(mirrored)
        } else if mirrored.value < last.value {
            let drawn = at(away(0.5))?;
            (drawn.value <= mirrored.value).then_some(drawn)
        } else {
            let drawn = at(away(-0.5))?;
            (drawn.value < last.value).then_some(drawn)
        };
        if let Some(vertex) = taken {
            simplex[2] = vertex;
        } else {
            for vertex in &mut simplex[1..] {
                *vertex = at([0, 1].map(|i| best.x[i] + 0.5 * (vertex.x[i] - best.x[i])))?;
            }
        }
        simplex.sort_by(Vertex::order);
        seen(simplex, evaluations.get())?;
    }
    let Vertex { x, value } = simplex[0];
    let placement = Placement { angle: x[0].rem_euclid(TAU), offset: x[1] };
    Ok(SimplexDescent { start, placement, value, evaluations: evaluations.get() })
}

/// Runs the simplex from `starts` random allowed placements, in parallel; the same `seed` gives the same
/// descents.
///
/// # Errors
/// As [`random_placements`] and [`Objective::value`]; `KC0009` when cancelled.
pub fn descents(
    case: &FaceCase,
    objective: &Objective,
    options: &NelderMead,
    starts: u32,
    seed: u64,
    progress: &dyn Progress,
) -> Result<Vec<SimplexDescent>> {
    let starts = random_placements(case, &options.constraints, starts, seed)?;
    progress.stage("descents", starts.len() as u64);
    let allowed = AllowedPlacements::new(case, &options.constraints)?;
    let still_wanted = || if progress.cancelled() { Err(cancelled()) } else { Ok(()) };
    let one = |start: &Placement| {
        still_wanted()?;
        let descent = run(case, objective, options, &allowed, *start, |_, _| still_wanted());
        progress.advance(1);
        descent
    };
    starts.par_iter().map(one).collect()
}

/// Orientations tried for each random placement that is allowed: with a share of 1 in 1000 of them allowed, one in
/// 50 000 searches would fail.
const TRIES: u32 = 10_000;

/// Random allowed placements: orientations evenly among those that have any, offsets evenly among those that are allowed
/// there.
///
/// # Errors
/// `KC1001` for constraints that make no sense; `KC1002` when no orientation is found in which the cutter covers the part
/// within them.
pub fn random_placements(
    case: &FaceCase,
    constraints: &Options,
    count: u32,
    seed: u64,
) -> Result<Vec<Placement>> {
    let allowed = AllowedPlacements::new(case, constraints)?;
    let mut random = Random(seed);
    let mut placements = Vec::new();
    for _ in 0..count {
        let mut tries = 0;
        loop {
            let angle = TAU * random.share();
            let spans = allowed.offsets(angle);
            if !spans.is_empty() {
                let room: f64 = spans.iter().map(|s| s[1] - s[0]).sum();
                let mut left = random.share() * room;
                let inside = spans.iter().find_map(|s| {
                    let here = s[0] + left;
                    left -= s[1] - s[0];
                    (left <= 0.0).then_some(here)
                });
                // Rounding may carry the last place beyond its end.
                let offset = inside.unwrap_or(spans[spans.len() - 1][1]);
                placements.push(Placement { angle, offset });
                break;
            }
            tries += 1;
            if tries > TRIES {
                return Err(Finding::error(
                    Code::FACE_TOO_WIDE,
                    "no orientation was found in which the cutter covers the part as it is allowed to",
                )
                .value(f64::from(TRIES), "orientations")
                .help("take a larger cutter or several passes, or allow more placements")
                .into());
            }
        }
    }
    Ok(placements)
}

#[derive(Clone, Copy)]
struct Vertex {
    x: [f64; 2],
    value: f64,
}

impl Vertex {
    fn order(&self, other: &Vertex) -> std::cmp::Ordering {
        self.value.total_cmp(&other.value)
    }
}
