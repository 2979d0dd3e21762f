//! The walls of an envelope as cells between moments: the share of them inside of the swept
//! volume, judged by neighbouring moments.
//!
//! A cell joins the same part of the same span at two moments. Where spans begin or end between the two, nothing is joined: the
//! share that is asked for does not feel it.

use glam::DVec3;
use rayon::prelude::*;

use crate::sweep::{GrazingSpan, ProfileChain, ToolMotion};

/// Cells along each branch of a span.
const PARTS: usize = 12;
/// Intervals of time.
pub(crate) const STEPS: usize = 48;

/// A cell of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallCell {
    /// Its middle [workpiece, mm].
    pub middle: DVec3,
    /// Its area [mm2].
    pub area: f64,
    /// Whether it lies inside of the volume that neighbouring moments sweep.
    pub inside: bool,
    /// Whether it is traced by a hollow edge, where stacked parts of a tool meet: a hollow edge never bounds the swept
    /// volume.
    pub hollow: bool,
}

/// The curves of a moment.
struct Row {
    spans: Vec<GrazingSpan>,
    /// For each span and branch the places of its parts.
    lines: Vec<[Vec<DVec3>; 2]>,
    /// For each span and branch whether the middles of its parts are inside.
    inside: Vec<[Vec<bool>; 2]>,
}

/// All cells of a move, in order of time.
pub(crate) fn walls(chain: &ProfileChain, motion: &ToolMotion) -> Vec<WallCell> {
    let rows: Vec<Row> =
        (0..=STEPS).into_par_iter().map(|k| row(chain, motion, k as f64 / STEPS as f64)).collect();
    rows.windows(2).flat_map(|pair| between(chain, &pair[0], &pair[1])).collect()
}

fn row(chain: &ProfileChain, motion: &ToolMotion, t: f64) -> Row {
    let jet = motion.at(t);
    let grazing = chain.grazing(&jet.twist);
    let line = |span: &GrazingSpan| {
        let points: Vec<_> =
            (0..=PARTS).map(|k| chain.grazing_points(span, k as f64 / PARTS as f64)).collect();
        [0, 1].map(|branch| points.iter().map(|p| jet.pose.point(p[branch].point)).collect())
    };
    let lines = grazing.spans.iter().map(line).collect();
    let middles = chain.envelope_points(motion, t, PARTS);
    let inside = middles
        .chunks(2 * PARTS)
        .map(|of_span| {
            let on =
                |branch: usize| of_span.iter().skip(branch).step_by(2).map(|p| !p.is_on_boundary()).collect();
            [on(0), on(1)]
        })
        .collect();
    Row { spans: grazing.spans, lines, inside }
}

fn between(chain: &ProfileChain, before: &Row, after: &Row) -> Vec<WallCell> {
    let mut cells = Vec::new();
    // Of two spans of a piece the first and the second belong together while their folds are alike.
    let order = |row: &Row, i: usize| row.spans[..i].iter().filter(|s| s.piece == row.spans[i].piece).count();
    for (i, span) in before.spans.iter().enumerate() {
        let same = |j: &usize| {
            let other = &after.spans[*j];
            other.piece == span.piece && other.folds == span.folds && order(after, *j) == order(before, i)
        };
        let Some(j) = (0..after.spans.len()).find(same) else { continue };
        let piece = &chain.pieces()[span.piece];
        let hollow = piece.is_fan() && !piece.is_convex();
        for branch in 0..2 {
            let (a, b) = (&before.lines[i][branch], &after.lines[j][branch]);
            for k in 0..PARTS {
                let (p, q, r, s) = (a[k], a[k + 1], b[k], b[k + 1]);
                let area = 0.5 * ((q - p).cross(r - p).length() + (q - s).cross(r - s).length());
                let inside = before.inside[i][branch][k] && after.inside[j][branch][k];
                cells.push(WallCell { middle: 0.25 * (p + q + r + s), area, inside, hollow });
            }
        }
    }
    cells
}
