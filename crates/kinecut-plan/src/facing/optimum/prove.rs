//! The proof of a least value: the search by the bounds that suit the outline, from pieces of the turn.

use std::f64::consts::TAU;

use super::boxes::Boxes;
use super::domain::{Domain, Turned};
use super::objective::{Objective, Valued};
use super::search::{Found, Limits, Node, search};
use super::straight::Straight;
use crate::base::Progress;
use crate::facing::FaceCase;

/// Angular cells per turn when boxes are split in the offset too.
pub(super) const COARSE: f64 = 90.0;

/// Proves a value, with what is known before.
pub(super) fn prove(
    objective: &Objective,
    straight: &Straight,
    best: Option<Valued>,
    limits: Limits,
    progress: &dyn Progress,
) -> Found {
    let domain = objective.domain;
    if objective.circular() {
        search(&Boxes(objective), roots(domain, COARSE), best, limits, progress)
    } else {
        search(straight, roots(domain, straight.per_turn()), best, limits, progress)
    }
}

/// A certified bound of the value over the domain.
pub(super) fn bound(case: &FaceCase, domain: &Domain, limits: Limits, progress: &dyn Progress) -> f64 {
    let objective = Objective::new(case, domain);
    prove(&objective, &Straight::new(&objective), None, limits, progress).lower
}

/// The allowed angles in pieces, with offsets that hold all allowed ones; `per_turn` of them in a full turn.
pub(super) fn roots(domain: &Domain, per_turn: f64) -> Vec<Node> {
    let pieces = pieces(domain, per_turn);
    let whole = pieces.into_iter().map(|angle| {
        let spans = domain.offsets_over(&Turned::new(angle));
        let offset =
            spans.into_iter().filter(|s| s[0] <= s[1]).fold([f64::INFINITY, f64::NEG_INFINITY], |a, s| {
                [if s[0] < a[0] { s[0] } else { a[0] }, if s[1] > a[1] { s[1] } else { a[1] }]
            });
        Node { angle, offset }
    });
    whole.filter(|n| n.offset[0] <= n.offset[1]).collect()
}

pub(super) fn pieces(domain: &Domain, per_turn: f64) -> Vec<[f64; 2]> {
    let mut out = Vec::new();
    for &[from, to] in &domain.angles {
        let n = ((to - from) / TAU * per_turn).ceil();
        let n = if n > 1.0 { n } else { 1.0 };
        let at = |i: usize| from + (to - from) * i as f64 / n;
        out.extend((0..n as usize).map(|i| [at(i), at(i + 1)]));
    }
    out
}
