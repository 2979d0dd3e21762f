//! Frames: the outline followed at a distance with the edge on the left of the feed, then the inside filled.
//!
//! With the edge on the left and an M3 spindle every tooth enters where it meets the edge: no burr. It fails where the
//! same sweep first touches another loop, at webs and bores narrower than the cutter: every start, lead and frame of a
//! hole is chosen by what the path then leaves.

use glam::DVec2;

use super::offset::{Corner, offset_loops};
use super::row_cost::RowCost;
use super::{PassPath, path_burr, uncovered};
use crate::facing::FaceCase;
use crate::geom::{Outline, OutlineEdge};

/// Options of a frame: distance, corners, and the passes inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameOptions {
    /// Distance of the cutter's centre from the outer edge, outside of the part positive [mm].
    pub outside: f64,
    /// Way of the centre round corners.
    pub corner: Corner,
    /// Passes that mill the inside.
    pub fill: Fill,
    /// Holes as wide as the cutter's radius may have frames of their own, at the distances of [`FrameOptions::HOLES`];
    /// each that lessens the bad length gets one. In narrower ones the cutter meets the far side as soon as the near
    /// one.
    pub holes: bool,
    /// Amount by which the path must be nearer to each point of the face than the radius [mm].
    pub margin: f64,
    /// Distance from the part at which the cutter is lowered and lifted [mm].
    pub clearance: f64,
}

/// Passes that mill the face within the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fill {
    /// Nothing.
    Nothing,
    /// Offsets of the frame inward, ring after ring.
    Rings,
    /// Rows along x of the part turned by this angle [rad].
    Rows(f64),
}

impl FrameOptions {
    /// Distances at which frames of holes are tried, in radii of the cutter, into the hole positive.
    pub const HOLES: [f64; 4] = [0.25, 0.0, -0.25, -0.5];
}

/// Distances between rings that are tried, in reaches of the cutter: wide ones leave spots at corners.
const RINGS: [f64; 6] = [1.95, 1.7, 1.5, 1.3, 1.1, 0.9];

/// Most rings: far more than any face takes that has fewer than a thousand cutters across.
const MOST_RINGS: usize = 1000;

/// Least distance between rings, in reaches: where a smaller one would be needed the face counts as not covered.
const INNERMOST: f64 = 0.02;

/// Depth of the check for spots: 1/512 of the face.
const SPOTS: u32 = 9;

/// Starts of a frame that are tried: evenly spread over its corners.
const STARTS: usize = 8;

/// Frames along the outline with what mills the inside; none where the offset has no loop or the inside is not covered
/// by what `fill` says ([`Fill::Nothing`] leaves it).
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::passes::{Corner, Fill, FrameOptions, frames, path_burr};
/// use kinecut::facing::{BadSet, FaceCase};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(200.0, 0.0), dvec2(200.0, 120.0), dvec2(0.0, 120.0)])?;
/// let case = FaceCase::new(plate, 40.0, BadSet::below(90f64.to_radians())?)?;
/// let options = FrameOptions {
///     outside: 10.0,
///     corner: Corner::Sharp,
///     fill: Fill::Rings,
///     holes: false,
///     margin: 0.8,
///     clearance: 5.0,
/// };
/// let path = frames(&case, &options).expect("a plate has a frame");
/// let burr = path_burr(&case, &path);
/// assert!(burr.bad == 0.0 && burr.uncut == 0.0);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn frames(case: &FaceCase, options: &FrameOptions) -> Option<PassPath> {
    let reach = case.radius - options.margin;
    if !(reach > 0.0 && options.outside < reach && options.margin >= 0.0 && options.clearance >= 0.0) {
        return None;
    }
    let outer = case.outline.with_loops(|l| l.outer);
    let run = case.radius + options.clearance;
    let mut path = PassPath::default();
    let first = offset_loops(&outer, options.outside, options.corner);
    if first.is_empty() {
        return None;
    }
    let filled = options.fill != Fill::Nothing;
    for (i, one) in first.iter().enumerate() {
        path = with_frame(case, &path, one, run, !filled || i + 1 < first.len());
    }
    let complete = |path: &PassPath| match options.fill {
        Fill::Nothing => Some(path.clone()),
        Fill::Rings => rings(case, path, &outer, options, reach),
        Fill::Rows(angle) => rows(case, path, angle, options, reach),
    };
    let mut best = complete(&path)?;
    if options.holes {
        let mut bad = path_burr(case, &best).bad;
        let holes = case.outline.loops().iter().filter(|l| !l.outer);
        for hole in holes.map(|own| case.outline.with_loops(|l| l == own)) {
            if width(&hole) < case.radius {
                continue;
            }
            let mut chosen = None;
            for share in FrameOptions::HOLES {
                let around = offset_loops(&hole, share * case.radius, Corner::Round);
                let with = around.iter().fold(path.clone(), |p, one| with_frame(case, &p, one, run, !filled));
                let Some(whole) = complete(&with).filter(|_| !around.is_empty()) else { continue };
                let left = path_burr(case, &whole).bad;
                // A frame that gains nothing worth its time is left out.
                if left < bad - 1e-3 * case.radius {
                    (bad, chosen) = (left, Some((with, whole)));
                }
            }
            if let Some((with, whole)) = chosen {
                (path, best) = (with, whole);
            }
        }
    }
    Some(best)
}

/// The lesser side of the box around a loop [mm].
fn width(one: &Outline) -> f64 {
    let [low, high] = one.bounds();
    (high - low).min_element()
}

/// The path with one more closed frame, begun and left where it leaves the least burr. The cutter comes straight from
/// outside the part, and if it is to leave goes straight off it where that costs nothing.
fn with_frame(case: &FaceCase, path: &PassPath, frame: &[OutlineEdge], run: f64, leave: bool) -> PassPath {
    let step = frame.len().div_ceil(STARTS).max(1);
    let mut best: Option<(f64, f64, PassPath)> = None;
    for first in (0..frame.len()).step_by(step) {
        let mut chain: Vec<OutlineEdge> = frame[first..].iter().chain(&frame[..first]).copied().collect();
        let (start, end) = (chain[0], chain[chain.len() - 1]);
        let back = -DVec2::from_angle(start.heading(0.0));
        let from = beside(case, start.start, back, run);
        if from != start.start {
            chain.insert(0, OutlineEdge::line(from, start.start));
        }
        let mut leads = vec![chain.clone()];
        let away = beside(case, end.end, DVec2::from_angle(end.heading(1.0)), run);
        // Off the part only where that is not across it.
        if leave && away != end.end && away.distance(end.end) < 3.0 * run {
            chain.push(OutlineEdge::line(end.end, away));
            leads.insert(0, chain);
        }
        for chain in leads {
            let mut trial = path.clone();
            trial.chains.push(chain);
            let bad = path_burr(case, &trial).bad;
            let length = trial.feed_length();
            // Lengths decide between starts only; a lead-out is not saved for its length.
            let better = best.as_ref().is_none_or(|(b, l, _)| {
                bad < b - 1e-9 * case.radius || bad < b + 1e-9 * case.radius && length < l - 2.0 * run
            });
            if better {
                best = Some((bad, length, trial));
            }
        }
    }
    best.map_or_else(|| path.clone(), |(_, _, p)| p)
}

/// The point on a ray that is at least `run` beyond the box around the part.
fn beside(case: &FaceCase, from: DVec2, along: DVec2, run: f64) -> DVec2 {
    let [low, high] = case.outline.bounds();
    let (low, high) = (low - DVec2::splat(run), high + DVec2::splat(run));
    if from.cmplt(low).any() || from.cmpgt(high).any() {
        return from;
    }
    let exit = |at: f64, along: f64, low: f64, high: f64| {
        if along > 0.0 {
            (high - at) / along
        } else if along < 0.0 {
            (low - at) / along
        } else {
            f64::INFINITY
        }
    };
    let gone = exit(from.x, along.x, low.x, high.x).min(exit(from.y, along.y, low.y, high.y));
    if gone.is_finite() { from + gone * along } else { from }
}

/// The path continued in feed, straight to the nearest corner of a loop and round it.
fn with_ring(path: &mut PassPath, ring: &[OutlineEdge]) {
    let Some(chain) = path.chains.last_mut() else { return };
    let Some(end) = chain.last().map(|e| e.end) else { return };
    let gap = |i: &usize| ring[*i].start.distance_squared(end);
    let Some(first) = (0..ring.len()).min_by(|a, b| gap(a).total_cmp(&gap(b))) else { return };
    if ring[first].start != end {
        chain.push(OutlineEdge::line(end, ring[first].start));
    }
    chain.extend(ring[first..].iter().chain(&ring[..first]));
}

/// Rings inward from the frame until the face is covered.
fn rings(
    case: &FaceCase,
    path: &PassPath,
    outer: &Outline,
    options: &FrameOptions,
    reach: f64,
) -> Option<PassPath> {
    RINGS.iter().find_map(|step| {
        let mut rings = path.clone();
        let mut depth = -options.outside;
        for _ in 0..MOST_RINGS {
            if uncovered(case, &rings, options.margin, SPOTS).is_none() {
                return Some(rings);
            }
            // If the next ring has vanished, one nearer by halves that has not.
            let (mut gap, mut found) = (step * reach, Vec::new());
            while found.is_empty() && gap > INNERMOST * reach {
                found = offset_loops(outer, -(depth + gap), Corner::Round);
                depth += if found.is_empty() { 0.0 } else { gap };
                gap *= 0.5;
            }
            if found.is_empty() {
                return None;
            }
            found.iter().for_each(|ring| with_ring(&mut rings, ring));
        }
        None
    })
}

/// Rows there and back over what the frame leaves, in one chain.
fn rows(
    case: &FaceCase,
    path: &PassPath,
    angle: f64,
    options: &FrameOptions,
    reach: f64,
) -> Option<PassPath> {
    if uncovered(case, path, options.margin, SPOTS).is_none() {
        return Some(path.clone());
    }
    let cost = RowCost::new(case, angle);
    // Heights along the edge that the frame covers.
    let band = reach - options.outside;
    let [low, high] = [cost.heights[0] + band, cost.heights[1] - band];
    let count = ((high - low) / (2.0 * reach)).ceil().max(1.0);
    let mut filled = path.clone();
    let back = DVec2::from_angle(-angle);
    for k in 0..count as usize {
        let y = low + (high - low) * (k as f64 + 0.5) / count;
        let Some([least, most]) = cost.extent(y) else { continue };
        let (least, most) = (least + band, most - band);
        let middle = 0.5 * (least + most);
        let ends = if least < most { [least, most] } else { [middle, middle] };
        let mut ends = ends.map(|x| back.rotate(DVec2::new(x, y)));
        let Some(chain) = filled.chains.last_mut() else { continue };
        let Some(from) = chain.last().map(|e| e.end) else { continue };
        if from.distance_squared(ends[1]) < from.distance_squared(ends[0]) {
            ends.reverse();
        }
        for w in [[from, ends[0]], ends].iter().filter(|w| w[0] != w[1]) {
            chain.push(OutlineEdge::line(w[0], w[1]));
        }
    }
    uncovered(case, &filled, options.margin, SPOTS).is_none().then_some(filled)
}
