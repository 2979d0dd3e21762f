//! The whole question: the best placement, its proof, its neighbours.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::domain::Domain;
use super::objective::{Objective, Valued};
use super::polish::{local_minima, refine, refine_angle, refine_offset};
use super::prove::{pieces, prove};
use super::search::{Bounded, Found, Limits};
use super::straight::Straight;
use super::sweep::Sweep;
use super::{LocalMinimum, Optimum, Options, irreducible, sensitivity, width};
use crate::base::{Code, Finding, Progress, Result};
use crate::facing::{FaceCase, bad_length};
use crate::num::angle::wrap;

/// Local minima refined before the search.
const STARTS: usize = 8;
/// Lines times feed-parallel angles tried before the search: some hundredths of a second.
const PARALLEL_WORK: usize = 300_000;
/// Minima nearer than this in angle [rad] and, per radius, in offset are one.
const DISTINCT: [f64; 2] = [0.02, 0.01];

/// The placement of one straight pass with the least bad length, proven: no allowed placement is better than the
/// bound. Guards belong into the case's bad set ([`BadSet::guarded`](crate::facing::BadSet::guarded)).
///
/// The same result whatever the number of threads. When `progress` cancels, the best placement so far is given with
/// its bound, and `complete` is false.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::base::Silent;
/// use kinecut::facing::optimum::{Options, least_burr};
/// use kinecut::facing::{BadSet, FaceCase};
/// use kinecut::geom::Outline;
/// let corners = [(0.0, 0.0), (0.0, 50.0), (20.0, 50.0), (20.0, 20.0), (60.0, 20.0), (60.0, 0.0)];
/// let bracket = Outline::polygon(&corners.map(|(x, y)| dvec2(x, y)))?;
/// let case = FaceCase::new(bracket, 50.0, BadSet::below(90f64.to_radians())?)?;
/// let best = least_burr(&case, &Options::for_cutter(50.0), &Silent)?;
/// assert!(best.complete && best.gap() <= 1e-6 * case.weighted_perimeter());
/// // Fed along its first axis with the cutter centred it leaves more than twice as much.
/// assert!((best.value - 33.9436).abs() < 1e-3);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
///
/// # Errors
/// `KC1001` for options that make no sense or forbid every orientation, `KC1002` where the part fits into the cutter's
/// reach at no allowed orientation, `KC0009` when cancelled before any placement was found.
pub fn least_burr(case: &FaceCase, options: &Options, progress: &dyn Progress) -> Result<Optimum> {
    options.check(case)?;
    progress.stage("least burr", 1);
    let domain = Domain::new(case, options);
    let narrowest = width::narrowest(&domain);
    if domain.angles.is_empty() || domain.offsets(narrowest.1).iter().all(|s| s[0] > s[1]) {
        return Err(width::too_wide(&domain, options, narrowest));
    }
    let objective = Objective::new(case, &domain);
    let chords = Straight::new(&objective);
    let minima = starts(&objective, &chords, narrowest.1);
    let limits = Limits { gap: options.tolerance * case.weighted_perimeter(), max_nodes: options.max_nodes };
    let mut found = prove(&objective, &chords, minima.first().copied(), limits, progress);
    let Some(best) = found.best else {
        return Err(Finding::error(Code::CANCELLED, "cancelled before a placement was found").into());
    };
    let best = refined(&objective, &chords, best, Depth::Fine);
    settle(&mut found, best);
    let placement = domain.placement(best.1[0], best.1[1]);
    // The closed form has the last word, should the two differ by their rounding.
    let value = bad_length(case, placement);
    settle(&mut found, (value, best.1));
    progress.advance(1);
    let irreducible = if options.irreducible {
        irreducible::irreducible(case, &domain, found.lower, progress)
    } else {
        Vec::new()
    };
    Ok(Optimum {
        value,
        placement,
        lower_bound: found.lower,
        nodes: found.nodes,
        complete: found.complete,
        alternatives: alternatives(case, &domain, best.1, &minima, options.alternatives),
        irreducible,
        sensitivity: sensitivity::sensitivity(case, &domain, options, placement),
    })
}

/// Local minima found before the search, refined, best first.
fn starts(objective: &Objective, chords: &Straight, narrowest: f64) -> Vec<Valued> {
    let domain = objective.domain;
    let sample = |angles: &[f64]| -> Vec<Bounded> {
        angles.par_iter().map_init(Sweep::default, |sweep, &a| chords.least_at(a, sweep)).collect()
    };
    let angles: Vec<f64> =
        pieces(domain, chords.per_turn()).into_iter().map(|[a, b]| 0.5 * (a + b)).collect();
    let mut begin = local_minima(&sample(&angles), domain.angles == [[0.0, TAU]]);
    begin.truncate(STARTS);
    begin.extend(sample(&[narrowest]).into_iter().filter(|b| b.lower.is_finite()));
    let free: Vec<Valued> = begin
        .par_iter()
        .filter_map(|b| objective.near(b.at).map(|v| refined(objective, chords, v, Depth::Rough)))
        .collect();
    // Angles at which an edge is parallel to the feed: all, or as many as the work allows.
    let most = PARALLEL_WORK / (chords.size() + 1) + 1;
    let every = objective.parallel.len().div_ceil(most).max(1);
    let parallel: Vec<f64> =
        objective.parallel.iter().copied().filter(|a| domain.allows(*a)).step_by(every).collect();
    let mut at_parallel: Vec<Bounded> =
        sample(&parallel).into_iter().filter(|b| b.lower.is_finite()).collect();
    at_parallel.sort_by(|a, b| a.lower.total_cmp(&b.lower));
    at_parallel.truncate(STARTS);
    let radius = objective.case.radius;
    let window = [if objective.circular() { STEP } else { 1e2 * EXACT } * radius, EXACT * radius];
    let fixed = at_parallel.par_iter().filter_map(|b| {
        let start = objective.near(b.at)?;
        Some(refine_offset(start, window, |c| objective.near([b.at[0], c])))
    });
    let mut all = free;
    all.extend(fixed.collect::<Vec<_>>());
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all
}

/// First step of refining, per radius: samples are about that far apart.
const STEP: f64 = 0.02;

/// Depth to which a minimum is refined.
#[derive(Clone, Copy, PartialEq)]
enum Depth {
    /// To be shown, and to prune by.
    Rough,
    /// As exact as numbers allow.
    Fine,
}

/// Steps at which refining ends, in radians or per radius.
const ROUGH: f64 = 1e-6;
const EXACT: f64 = 1e-12;

fn refined(objective: &Objective, chords: &Straight, start: Valued, depth: Depth) -> Valued {
    let [first, last] = if depth == Depth::Rough { [STEP, ROUGH] } else { [1e2 * ROUGH, EXACT] };
    if objective.circular() {
        let radius = objective.case.radius;
        return refine(start, [first * radius, last * radius], radius, |at| objective.near(at));
    }
    let mut sweep = Sweep::default();
    refine_angle(start, [first, last], |angle, below| {
        if !objective.domain.allows(angle) {
            return None;
        }
        let found = chords.least_at(angle, &mut sweep);
        if found.lower < below { objective.near(found.at) } else { None }
    })
}

/// Takes a refined value over.
fn settle(found: &mut Found, best: Valued) {
    found.best = Some(best);
    if best.0 < found.lower {
        found.lower = best.0;
    }
}

fn alternatives(
    case: &FaceCase,
    domain: &Domain,
    best: [f64; 2],
    minima: &[Valued],
    most: usize,
) -> Vec<LocalMinimum> {
    let mut kept = vec![best];
    let mut out = Vec::new();
    for (value, at) in minima {
        let apart = |k: &[f64; 2]| {
            wrap(k[0] - at[0]).abs() > DISTINCT[0] || (k[1] - at[1]).abs() > DISTINCT[1] * case.radius
        };
        if out.len() < most && kept.iter().all(apart) {
            kept.push(*at);
            out.push(LocalMinimum { value: *value, placement: domain.placement(at[0], at[1]) });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;
    use crate::base::Silent;
    use crate::facing::BadSet;
    use crate::facing::optimum::boxes::Boxes;
    use crate::facing::optimum::prove::{COARSE, roots};
    use crate::facing::optimum::search::search;
    use crate::geom::{Outline, OutlineEdge};

    fn bracket() -> FaceCase {
        let corners = [(0.0, 0.0), (60.0, 0.0), (60.0, 15.0), (15.0, 15.0), (15.0, 50.0), (0.0, 50.0)];
        let bracket = Outline::polygon(&corners.map(|(x, y)| dvec2(x, y))).unwrap();
        FaceCase::new(bracket, 50.0, BadSet::below(1.2).unwrap().guarded(0.02)).unwrap()
    }

    #[test]
    fn boxes_and_intervals_of_angles_agree_on_a_polygon() {
        let case = bracket();
        let domain = Domain::new(&case, &Options::for_cutter(50.0));
        let objective = Objective::new(&case, &domain);
        let limits = Limits { gap: 1e-4 * case.weighted_perimeter(), max_nodes: 100_000 };
        let straight = Straight::new(&objective);
        let a = search(&straight, roots(&domain, 360.0), None, limits, &Silent);
        let b = search(&Boxes(&objective), roots(&domain, COARSE), None, limits, &Silent);
        assert!(a.complete && b.complete, "{a:?} {b:?}");
        let (x, y) = (a.best.unwrap().0, b.best.unwrap().0);
        assert!(x >= b.lower - 1e-9 && y >= a.lower - 1e-9, "{a:?} {b:?}");
    }

    #[test]
    fn the_fast_objective_is_the_closed_form() {
        let hole = vec![OutlineEdge::arc(dvec2(8.0, 30.0), 4.0, 0.0, TAU)];
        let outline = Outline::new(vec![bracket().outline.edges().to_vec(), hole], vec![]).unwrap();
        let case = FaceCase { weights: vec![1.0, 2.0, 0.5, 0.0, 1.0, 3.0, 1.5], outline, ..bracket() };
        let domain = Domain::new(&case, &Options::for_cutter(50.0));
        let objective = Objective::new(&case, &domain);
        for k in 0..3000 {
            let angle = wrap(0.7 * f64::from(k));
            let local = 10.0 * f64::from(k).sin();
            let want = bad_length(&case, domain.placement(angle, local));
            assert!((objective.at([angle, local]) - want).abs() < 1e-9, "{angle} {local}");
        }
    }
}
