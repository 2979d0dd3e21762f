//! Stretches of the edges of a face by the burr that its milling leaves on them.

use super::{BurrChoice, BurrTable};
use crate::facing::exits::as_exit;
use crate::facing::passes::{EdgeStretch, Met, PassPath, exit_angle, path_burr};
use crate::facing::{BadPart, BadSet, FaceCase};
use crate::geom::OutlineEdge;

/// A face as it was milled: its outline, the bad exit angles, the cutter, and the way of its centre, all as the part lies.
#[derive(Clone, Debug, PartialEq)]
pub struct MilledEdges {
    /// Outline, cutter, bad exit angles.
    pub case: FaceCase,
    /// The way of the cutter's centre; each level runs the same.
    pub path: PassPath,
    /// The spindle turned counter-clockwise (M4).
    pub left_hand: bool,
}

/// The burr on a stretch of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BurrState {
    /// Teeth left here, and the burr is chosen.
    Chosen,
    /// Teeth left here, and it is not.
    Other,
    /// The cutter was lowered onto it: it has no exit angle.
    Lowered,
}

/// A stretch of an edge on which teeth have left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BurrPart {
    /// The edge.
    pub edge: usize,
    /// From and to along it, from its first point [mm].
    pub along: [f64; 2],
    /// Least and greatest exit angle [rad]; 0 to 0 where the cutter was lowered.
    pub exit_angles: [f64; 2],
    /// Greatest height by the table [mm]; `None` without one.
    pub height: Option<f64>,
    /// The burr.
    pub state: BurrState,
}

impl BurrPart {
    /// Length [mm].
    pub fn length(&self) -> f64 {
        self.along[1] - self.along[0]
    }
}

/// The stretches of a face's edges on which teeth leave, edge after edge, from its first point on; those where teeth enter, and what
/// the milling did not reach, are left out.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::burrs::{BurrChoice, BurrState, BurrTable, MilledEdges, burr_parts};
/// use kinecut::facing::passes::PassPath;
/// use kinecut::facing::{BadSet, FaceCase};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)])?;
/// let bad = BadSet::below(90f64.to_radians())?;
/// let case = FaceCase::new(plate, 50.0, bad.clone())?;
/// let path = PassPath::lines(&[vec![dvec2(-60.0, 30.0), dvec2(160.0, 30.0)]]);
/// let milled = MilledEdges { case, path, left_hand: false };
/// let table = BurrTable::new(vec![[0.0, 0.3], [90f64.to_radians(), 0.03]])?;
/// let parts = burr_parts(&milled, &BurrChoice::Bad(bad), Some(&table));
/// let chosen: Vec<_> = parts.iter().filter(|p| p.state == BurrState::Chosen).collect();
/// // The side on the right of the feed, where all teeth leave at 53.13 degrees, and half of the far end.
/// assert!((chosen.iter().map(|p| p.length()).sum::<f64>() - 130.0).abs() < 1e-9);
/// let side = chosen.iter().find(|p| p.length() > 99.0).ok_or("none")?;
/// assert!((side.height.ok_or("none")? - (0.3 - 0.003 * 53.130_102)).abs() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn burr_parts(milled: &MilledEdges, choice: &BurrChoice, table: Option<&BurrTable>) -> Vec<BurrPart> {
    // Each interval of exit angles has a weight of its own: so stretches are cut at all of its ends.
    let bounds = choice.bounds(table);
    let cells =
        bounds.windows(2).enumerate().map(|(i, w)| BadPart { from: w[0], to: w[1], weight: (i + 1) as f64 });
    let left = milled.left_hand;
    let seen = if left { milled.case.mirrored() } else { milled.case.clone() };
    // Ends that rise from 0 to pi, and weights below the largest: the set is one.
    let Ok(bad) = BadSet::new(cells.collect()) else { return Vec::new() };
    let case = FaceCase { bad, ..seen };
    let path = if left { milled.path.mirrored() } else { milled.path.clone() };
    let mut parts: Vec<BurrPart> = Vec::new();
    for stretch in &path_burr(&case, &path).stretches {
        let edge = &case.outline.edges()[stretch.edge];
        let Some(part) = part(edge, stretch, &case, &path, choice, table) else { continue };
        match parts.last_mut().filter(|last| joins(last, &part)) {
            Some(last) => *last = joined(last, &part),
            None => parts.push(part),
        }
    }
    if left {
        parts.iter_mut().for_each(|p| *p = mirrored(p, &case));
        parts.sort_by(|a, b| a.edge.cmp(&b.edge).then(a.along[0].total_cmp(&b.along[0])));
    }
    parts
}

/// The burr of a stretch; none where teeth enter or nothing was cut.
fn part(
    edge: &OutlineEdge,
    stretch: &EdgeStretch,
    case: &FaceCase,
    path: &PassPath,
    choice: &BurrChoice,
    table: Option<&BurrTable>,
) -> Option<BurrPart> {
    let along = [stretch.from, stretch.to].map(|s| s * edge.length());
    let one = BurrPart {
        edge: stretch.edge,
        along,
        exit_angles: [0.0; 2],
        height: None,
        state: BurrState::Lowered,
    };
    let (chain, piece) = match stretch.met {
        Met::Lowered { .. } => return Some(one),
        Met::First { chain, piece, exit: true, .. } => (chain, piece),
        Met::First { .. } | Met::Never => return None,
    };
    let piece = path.chains.get(chain)?.get(piece)?;
    let exit_angles = range(edge, stretch, piece, case.radius);
    let height = table.map(|t| {
        let [a, b] = exit_angles.map(|psi| t.at(psi));
        if a > b { a } else { b }
    });
    let middle = as_exit(exit_angle(edge, 0.5 * (stretch.from + stretch.to), piece, case.radius));
    let state = if choice.takes(middle, table) { BurrState::Chosen } else { BurrState::Other };
    Some(BurrPart { exit_angles, height, state, ..one })
}

/// Least and greatest exit angle on a stretch: along a line under a straight piece it only rises or falls, elsewhere it may turn.
fn range(edge: &OutlineEdge, stretch: &EdgeStretch, piece: &OutlineEdge, radius: f64) -> [f64; 2] {
    /// Parts in which turns of the angle are looked for.
    const PARTS: u32 = 32;
    /// Steps of the golden section: to a millionth of a part.
    const STEPS: u32 = 30;
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let at = |share: f64| {
        let s = stretch.from + share * (stretch.to - stretch.from);
        // Rounding may take an end beyond 0 or pi.
        as_exit(exit_angle(edge, s, piece, radius)).clamp(0.0, std::f64::consts::PI)
    };
    let is_even = edge.turn.is_none() && piece.turn.is_none();
    let parts = if is_even { 1 } else { PARTS };
    let share = |i: u32| f64::from(i) / f64::from(parts);
    let pick = |sign: f64| {
        let value = |s: f64| sign * at(s);
        let (mut best, mut of) = (value(0.0), 0);
        for i in 1..=parts {
            if value(share(i)) > best {
                (best, of) = (value(share(i)), i);
            }
        }
        if is_even {
            return sign * best;
        }
        let (mut low, mut high) = (share(of.saturating_sub(1)), share((of + 1).min(parts)));
        for _ in 0..STEPS {
            let width = GOLDEN * (high - low);
            if value(high - width) > value(low + width) { high = low + width } else { low = high - width }
        }
        let turned = value(0.5 * (low + high));
        sign * if turned > best { turned } else { best }
    };
    [pick(-1.0), pick(1.0)]
}

/// Whether a part goes on from another.
fn joins(last: &BurrPart, next: &BurrPart) -> bool {
    /// Gap between stretches that is rounding [mm].
    const ROUNDING: f64 = 1e-9;
    last.edge == next.edge && last.state == next.state && next.along[0] - last.along[1] <= ROUNDING
}

fn joined(last: &BurrPart, next: &BurrPart) -> BurrPart {
    let [a, b] = [last.exit_angles, next.exit_angles];
    let higher = last.height.zip(next.height).map(|(a, b)| if a > b { a } else { b });
    BurrPart {
        along: [last.along[0], next.along[1]],
        exit_angles: [if a[0] < b[0] { a[0] } else { b[0] }, if a[1] > b[1] { a[1] } else { b[1] }],
        height: higher,
        ..*last
    }
}

/// A part of the mirrored outline on the outline itself.
fn mirrored(part: &BurrPart, case: &FaceCase) -> BurrPart {
    let of = case.outline.loops().iter().find(|l| l.edges.contains(&part.edge));
    let length = case.outline.edges()[part.edge].length();
    BurrPart {
        edge: of.map_or(part.edge, |l| l.edges.start + l.edges.end - 1 - part.edge),
        along: [length - part.along[1], length - part.along[0]],
        ..*part
    }
}
