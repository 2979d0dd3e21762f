//! The whole question: the best placement, its proof, its neighbours.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use rayon::prelude::*;

use super::domain::Domain;
use super::lines::Lines;
use super::polish::{local_minima, refine_angle};
use super::search::{Bounded, Limits, Node, Relaxation, search};
use super::straight::Straight;
use super::sweep::Sweep;
use super::{LocalMinimum, Optimum, Options, Sensitivity};
use crate::base::{Code, Finding, Progress, Result};
use crate::facing::FaceCase;
use crate::num::angle::wrap_positive;

const GRID: usize = 360;

pub fn least_burr(case: &FaceCase, options: &Options, progress: &dyn Progress) -> Result<Optimum> {
    options.check(case)?;
    let domain = Domain::new(case, options);
    let gap = options.tolerance * case.weighted_perimeter();
    let problem = Straight { case, domain: &domain, lines: Lines::new(case, &domain) };
    // angles
    let mut angles: Vec<f64> = vec![];
    for [a, b] in &domain.angles {
        let n = (((b - a) / TAU * GRID as f64).ceil() as usize).max(1);
        angles.extend((0..n).map(|i| a + (b - a) * (i as f64 + 0.5) / n as f64));
    }
    let t0 = std::time::Instant::now();
    let samples: Vec<Bounded> =
        angles.par_iter().map_init(Sweep::default, |s, &a| problem.least_at(a, s)).collect();
    let mut parallel: Vec<f64> = case
        .outline
        .edges()
        .iter()
        .filter(|e| e.turn.is_none())
        .flat_map(|e| [-e.heading(0.0), PI - e.heading(0.0)])
        .map(wrap_positive)
        .collect();
    parallel.sort_by(f64::total_cmp);
    parallel.dedup();
    let at_parallel: Vec<Option<(f64, [f64; 2])>> = parallel
        .par_iter()
        .map_init(Sweep::default, |s, &a| {
            let b = problem.least_at(a, s);
            b.lower.is_finite().then(|| problem.value(b.at).map(|v| (v, b.at))).flatten()
        })
        .collect();
    let t1 = std::time::Instant::now();
    let mut starts = local_minima(&samples, true);
    starts.truncate(8);
    let mut polished: Vec<(f64, [f64; 2])> = starts
        .par_iter()
        .map_init(Sweep::default, |s, b| {
            let start = (problem.value(b.at).unwrap_or(f64::INFINITY), b.at);
            refine_angle(start, TAU / GRID as f64, |angle| {
                let b = problem.least_at(angle, s);
                if !b.lower.is_finite() {
                    return None;
                }
                problem.value(b.at).map(|v| (v, b.at))
            })
        })
        .collect();
    polished.extend(at_parallel.into_iter().flatten());
    polished.sort_by(|a, b| a.0.total_cmp(&b.0));
    let t2 = std::time::Instant::now();
    let best = polished.first().copied();
    let roots: Vec<Node> = domain
        .angles
        .iter()
        .flat_map(|&[a, b]| {
            let n = (((b - a) / TAU * GRID as f64).ceil() as usize).max(1);
            (0..n).map(move |i| Node {
                angle: [a + (b - a) * i as f64 / n as f64, a + (b - a) * (i + 1) as f64 / n as f64],
                offset: [f64::NEG_INFINITY, f64::INFINITY],
            })
        })
        .collect();
    let found = search(&problem, roots, best, Limits { gap, max_nodes: options.max_nodes }, progress);
    let t3 = std::time::Instant::now();
    if std::env::var("TIMES").is_ok() {
        eprintln!(
            "grid {:?} polish {:?} search {:?} start {:?} end {:?}",
            t1 - t0,
            t2 - t1,
            t3 - t2,
            best,
            found
        );
    }
    let Some((value, at)) = found.best else { return Err(Finding::error(Code::FACE_TOO_WIDE, "x").into()) };
    let placement = domain.placement(at[0], at[1]);
    Ok(Optimum {
        value,
        placement,
        lower_bound: found.lower,
        nodes: found.nodes,
        complete: found.complete,
        alternatives: vec![],
        irreducible: vec![],
        sensitivity: Sensitivity { worst: value, worst_at: placement, feed_parallel: vec![] },
    })
}
