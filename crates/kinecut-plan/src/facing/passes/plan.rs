//! The ways to mill a face, each with its bad length and its time: never one answer without its price.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;
use rayon::prelude::*;

use super::row_plan::{RowGrid, refined_rows};
use super::{
    Corner, Fill, FrameOptions, MilledRows, PassPath, PathBurr, RowWays, frames, path_burr, uncovered,
};
use crate::base::{Code, Finding, Progress, Result};
use crate::facing::{FaceCase, Placement};
use crate::num::angle::wrap;

/// Options with which passes are planned and timed.
#[derive(Clone, Debug, PartialEq)]
pub struct PassOptions {
    /// Amount by which the path must be nearer to each point of the face than the radius [mm].
    pub margin: f64,
    /// Distance from the part at which the cutter is lowered and lifted [mm].
    pub clearance: f64,
    /// Feed [mm/s].
    pub feed: f64,
    /// Rapid speed [mm/s].
    pub rapid: f64,
    /// Height by which the cutter is lifted for a link [mm].
    pub lift: f64,
    /// Number of rows tried beyond the least number that covers.
    pub more_rows: usize,
    /// Turns of the part at which rows are tried, besides the even ones and those that lay a long edge along the feed
    /// [rad].
    pub angles: Vec<f64>,
    /// Even turns of the part at which rows are tried, over half a turn.
    pub even_angles: usize,
    /// Distances of frames from the outer edge, in radii of the cutter, outside of the part positive.
    pub frames: Vec<f64>,
    /// Depth of the check that a plan covers the face, as in [`uncovered`].
    pub depth: u32,
}

impl Default for PassOptions {
    /// A margin of 0.5 mm, a clearance of 5 mm, 1 000 mm/min in feed, 20 m/min in rapid.
    fn default() -> PassOptions {
        PassOptions {
            margin: 0.5,
            clearance: 5.0,
            feed: 1000.0 / 60.0,
            rapid: 20_000.0 / 60.0,
            lift: 5.0,
            more_rows: 2,
            angles: Vec::new(),
            even_angles: 6,
            frames: vec![0.25, 0.0, -0.25, -0.5],
            depth: 9,
        }
    }
}

/// The kind of passes by which a face is milled.
#[derive(Clone, Debug, PartialEq)]
pub enum PassKind {
    /// One straight pass.
    Straight(Placement),
    /// Parallel rows.
    Rows {
        /// The rows.
        rows: MilledRows,
        /// Ways in which they were allowed to be fed.
        ways: RowWays,
        /// Offsets and ways were chosen for the least burr; else they are evenly spread.
        best: bool,
    },
    /// Along the outline.
    Frames(FrameOptions),
}

/// A way to mill the face with what it leaves and what it costs.
#[derive(Clone, Debug, PartialEq)]
pub struct PassPlan {
    /// Kind of its passes.
    pub kind: PassKind,
    /// Path of the cutter's centre in the part's frame.
    pub path: PassPath,
    /// Effect on the outline, by first contact.
    pub burr: PathBurr,
    /// A point of the face that it does not reach with the margin; only a straight pass as drawn may have one.
    pub uncovered: Option<DVec2>,
    /// Length in feed [mm].
    pub feed_length: f64,
    /// Time in feed and in rapid [s].
    pub time: f64,
    /// No other plan that covers the face leaves less burr in the same time or takes less time for the same burr.
    pub efficient: bool,
    /// Description in words.
    pub note: String,
}

impl PassPlan {
    /// The finding of a plan that leaves a part of the face: `KC1004` with the place.
    pub fn finding(&self) -> Option<Finding> {
        self.uncovered.map(|p| {
            Finding::error(Code::FACE_UNCUT, format!("{} leave a part of the face", self.note))
                .point([p.x, p.y, 0.0])
                .help("more rows, a smaller margin, or a larger cutter")
        })
    }
}

/// Time of a path [s]: feed and rapid [mm/s], each chain but the last lifted and lowered by `lift` [mm].
pub fn pass_time(path: &PassPath, feed: f64, rapid: f64, lift: f64) -> f64 {
    let links = path.chains.len().saturating_sub(1) as f64;
    path.feed_length() / feed + (path.link_length() + 2.0 * lift * links) / rapid
}

/// Bad lengths nearer than this per weighted perimeter are the same for [`PassPlan::efficient`]: rounding.
pub(in crate::facing) const SAME_BAD: f64 = 1e-9;

/// Times nearer than this share are the same: rounding.
const SAME_TIME: f64 = 1e-9;

/// Places nearer than this per radius of the cutter are the same for two paths: far below what a machine tells apart.
pub(in crate::facing) const SAME_PLACE: f64 = 1e-7;

/// Most directions of edges along which rows are tried, the longest first.
const LONG_EDGES: usize = 6;

/// Edges within this of one direction are parallel [rad].
const PARALLEL: f64 = 1e-6;

/// Orientations that are refined for each number of rows and allowed ways.
const KEPT: usize = 1;

/// All plans, by time: one straight pass as drawn, the given straight passes (a certified optimum and its
/// alternatives), rows from the least number on with the best offsets (each way free, one way, there and back), even
/// rows as a baseline, frames with rings or rows inside. Plans that do not cover the face are left out, but for the
/// straight pass as drawn. Deterministic.
///
/// # Errors
/// `KC1001` for an option that is not usable, `KC0009` when cancelled.
pub fn pareto(
    case: &FaceCase,
    straight: &[Placement],
    options: &PassOptions,
    progress: &dyn Progress,
) -> Result<Vec<PassPlan>> {
    check(case, options)?;
    let middle = |angle: f64| {
        let [low, high] = case.outline.extent(DVec2::new(angle.sin(), angle.cos()));
        Placement { angle, offset: 0.5 * (low + high) }
    };
    let mut kinds = vec![PassKind::Straight(middle(0.0))];
    kinds.extend(straight.iter().map(|p| PassKind::Straight(*p)));
    for angle in [0.0, FRAC_PI_2] {
        let count = MilledRows::least(case, angle, options.margin).unwrap_or(1);
        for ways in [RowWays::Zigzag, RowWays::OneWay] {
            let rows = MilledRows::even(case, angle, count, ways);
            kinds.push(PassKind::Rows { rows, ways, best: false });
        }
    }
    progress.stage("rows", 1);
    kinds.extend(rows_of_all_angles(case, options, progress)?);
    progress.advance(1);
    for &outside in &options.frames {
        for (corner, fills) in [
            (Corner::Round, &[Fill::Rings, Fill::Rows(0.0), Fill::Rows(FRAC_PI_2)][..]),
            (Corner::Sharp, &[Fill::Rows(0.0)][..]),
        ] {
            for &fill in fills {
                let frame = FrameOptions {
                    outside: outside * case.radius,
                    corner,
                    fill,
                    holes: corner == Corner::Round,
                    margin: options.margin,
                    clearance: options.clearance,
                };
                kinds.push(PassKind::Frames(frame));
            }
        }
    }
    progress.stage("passes", kinds.len() as u64);
    let plans: Vec<Option<PassPlan>> = kinds
        .into_par_iter()
        .enumerate()
        .map(|(i, kind)| {
            let plan = if progress.cancelled() { None } else { plan(case, kind, options, i == 0) };
            progress.advance(1);
            plan
        })
        .collect();
    stopped(progress)?;
    let mut plans: Vec<PassPlan> = plans.into_iter().flatten().collect();
    // Stable: plans of one time keep the order of their kinds.
    plans.sort_by(|a, b| a.time.total_cmp(&b.time));
    let mut unlike: Vec<PassPlan> = Vec::new();
    for plan in plans {
        if !unlike.iter().any(|p| p.path.is_near(&plan.path, SAME_PLACE * case.radius)) {
            unlike.push(plan);
        }
    }
    let prices: Vec<_> = unlike.iter().map(|p| (p.burr.bad, p.time, p.uncovered.is_none())).collect();
    for (plan, worth) in unlike.iter_mut().zip(efficient(&prices, SAME_BAD * case.weighted_perimeter())) {
        plan.efficient = worth;
    }
    Ok(unlike)
}

fn check(case: &FaceCase, options: &PassOptions) -> Result<()> {
    let refuse = |what: &str, value: f64, bound: f64, unit: &str| -> Result<()> {
        Err(Finding::error(Code::FACE_CASE, what).value(value, unit).bound(bound, unit).into())
    };
    if !(options.margin >= 0.0 && options.margin < case.radius) {
        return refuse(
            "the margin lies between 0 and the radius of the cutter",
            options.margin,
            case.radius,
            "mm",
        );
    }
    for (what, value) in [("feed", options.feed), ("rapid speed", options.rapid)] {
        if !(value > 0.0 && value.is_finite()) {
            return refuse(&format!("the {what} must be positive"), value, 0.0, "mm/s");
        }
    }
    for (what, value) in [("clearance", options.clearance), ("lift", options.lift)] {
        if !(value >= 0.0 && value.is_finite()) {
            return refuse(&format!("the {what} must not be negative"), value, 0.0, "mm");
        }
    }
    if let Some(angle) = options.angles.iter().find(|a| !a.is_finite()) {
        return refuse("the turn of the part must be a number", *angle, 0.0, "rad");
    }
    Ok(())
}

fn stopped(progress: &dyn Progress) -> Result<()> {
    if progress.cancelled() {
        return Err(Finding::error(Code::CANCELLED, "the search for passes was stopped").into());
    }
    Ok(())
}

/// Turns of the part at which rows are tried, over half a turn; both orders of the rows are tried at each.
fn angles(case: &FaceCase, options: &PassOptions) -> Vec<f64> {
    let half = |a: f64| a.rem_euclid(PI);
    let mut lengths: Vec<(f64, f64)> = Vec::new();
    for (edge, weight) in case.outline.edges().iter().zip(&case.weights).filter(|(e, _)| e.turn.is_none()) {
        let along = half(-edge.heading(0.0));
        match lengths.iter_mut().find(|(a, _)| wrap(2.0 * (along - a)).abs() < 2.0 * PARALLEL) {
            Some((_, length)) => *length += edge.length() * weight,
            None => lengths.push((along, edge.length() * weight)),
        }
    }
    lengths.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut angles: Vec<f64> = vec![0.0, FRAC_PI_2];
    angles.extend(lengths.iter().take(LONG_EDGES).map(|l| l.0));
    angles.extend(options.angles.iter().map(|a| half(*a)));
    angles.extend((0..options.even_angles).map(|k| PI * k as f64 / options.even_angles as f64));
    let mut unlike: Vec<f64> = Vec::new();
    for angle in angles {
        if unlike.iter().all(|a| wrap(2.0 * (angle - a)).abs() > 2.0 * PARALLEL) {
            unlike.push(angle);
        }
    }
    unlike
}

fn rows_of_all_angles(
    case: &FaceCase,
    options: &PassOptions,
    progress: &dyn Progress,
) -> Result<Vec<PassKind>> {
    let angles = angles(case, options);
    let least = angles.iter().filter_map(|a| MilledRows::least(case, *a, options.margin)).min().unwrap_or(1);
    let most = least + options.more_rows;
    let mut wanted = Vec::new();
    for count in least..=most {
        let ways: &[RowWays] =
            if count == 1 { &[RowWays::Free] } else { &[RowWays::Free, RowWays::OneWay, RowWays::Zigzag] };
        wanted.extend(ways.iter().map(|&w| (count, w)));
    }
    // Rising rows of the part turned by half a turn are its falling rows.
    let turned: Vec<f64> = angles.iter().flat_map(|a| [*a, a + PI]).collect();
    let found: Vec<Vec<Option<(f64, MilledRows)>>> = turned
        .par_iter()
        .map(|&angle| {
            let grid =
                if progress.cancelled() { None } else { RowGrid::new(case, angle, most, options.margin) };
            let rows = |&(count, ways): &(usize, RowWays)| {
                let rows = grid.as_ref()?.rows(count, ways)?;
                Some((rows.bad_length(case), rows))
            };
            wanted.iter().map(rows).collect()
        })
        .collect();
    stopped(progress)?;
    let mut chosen: Vec<(MilledRows, RowWays)> = Vec::new();
    for (i, &(_, ways)) in wanted.iter().enumerate() {
        let mut group: Vec<&(f64, MilledRows)> =
            found.iter().filter_map(|of_angle| of_angle[i].as_ref()).collect();
        group.sort_by(|a, b| a.0.total_cmp(&b.0));
        // Always the best at the part's own axes too: others ask for a turned set-up.
        let own = group.iter().position(|(_, r)| (2.0 * r.angle).sin().abs() < PARALLEL);
        let kept = group.iter().take(KEPT).chain(own.filter(|i| *i >= KEPT).map(|i| &group[i]));
        chosen.extend(kept.map(|(_, rows)| (rows.clone(), ways)));
    }
    let kinds = chosen
        .into_par_iter()
        .map(|(rows, ways)| {
            let rows = if progress.cancelled() { rows } else { refined_rows(case, rows, options.margin) };
            PassKind::Rows { rows, ways, best: true }
        })
        .collect();
    stopped(progress)?;
    Ok(kinds)
}

fn plan(case: &FaceCase, kind: PassKind, options: &PassOptions, keep: bool) -> Option<PassPlan> {
    let run = case.radius + options.clearance;
    let path = match &kind {
        PassKind::Straight(placement) => {
            PassPath::straight(*placement, case.outline.extent(placement.feed_in_part()), run)
        }
        PassKind::Rows { rows, .. } => rows.path(case, run),
        PassKind::Frames(frame) => frames(case, frame)?,
    };
    let uncovered = uncovered(case, &path, options.margin, options.depth);
    if uncovered.is_some() && !keep {
        return None;
    }
    let note = note(&kind, case.radius);
    let time = pass_time(&path, options.feed, options.rapid, options.lift);
    let burr = path_burr(case, &path);
    let feed_length = path.feed_length();
    Some(PassPlan { kind, path, burr, uncovered, feed_length, time, efficient: false, note })
}

fn note(kind: &PassKind, radius: f64) -> String {
    match kind {
        PassKind::Straight(p) => {
            format!("one straight pass, part turned by {:.1} deg", p.angle.to_degrees())
        }
        PassKind::Rows { rows, ways, best } => {
            let ways = match ways {
                RowWays::Free => "each its better way",
                RowWays::OneWay => "one way",
                RowWays::Zigzag => "there and back",
            };
            let spread = if *best { "at their best offsets" } else { "evenly spread" };
            let (n, turn) = (rows.rows.len(), wrap(rows.angle).to_degrees());
            format!("{n} rows {spread}, {ways}, part turned by {turn:.1} deg")
        }
        PassKind::Frames(f) => {
            let inside = match f.fill {
                Fill::Nothing => "nothing inside".to_string(),
                Fill::Rings => "rings inside".to_string(),
                Fill::Rows(angle) => format!("rows inside at {:.1} deg", angle.to_degrees()),
            };
            let corners = if f.corner == Corner::Round { "round" } else { "sharp" };
            let place = if f.outside >= 0.0 { "outside" } else { "inside" };
            let d = f.outside.abs();
            format!(
                "frames, centre {d:.1} mm {place} of the edge ({:.2} R), {corners} corners, {inside}",
                d / radius
            )
        }
    }
}

/// The ways that are worth their time, of ways given by (bad length, time, true if it covers the face): no other that
/// covers leaves less in the same time or takes less time for the same; of equal ones the first. Bad lengths within
/// `near` are the same.
pub(in crate::facing) fn efficient(ways: &[(f64, f64, bool)], near: f64) -> Vec<bool> {
    let worth = |(i, &(bad, time, covers)): (usize, &(f64, f64, bool))| {
        let beaten = ways.iter().enumerate().any(|(j, &(other, takes, whole))| {
            let soon = SAME_TIME * time;
            let better = other < bad - near || takes < time - soon;
            j != i && whole && other <= bad + near && takes <= time + soon && (better || j < i)
        });
        covers && !beaten
    };
    ways.iter().enumerate().map(worth).collect()
}
