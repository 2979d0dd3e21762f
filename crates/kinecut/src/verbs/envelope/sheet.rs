//! The envelope of one tool in one move, computed.

use rayon::prelude::*;
use serde::Serialize;

use super::EnvelopeTable;
use super::given_move::{GivenMove, MoveSource};
use super::moving::motions;
use super::walls::{WallCell, walls};
use crate::base::bounded::{MAX_LENGTH, length};
use crate::base::{Code, Finding, Loader, Progress, Result};
use crate::geom::CurveKind;
use crate::job::contour::{chosen_contour, given_contour};
use crate::stock::{TrimmedEnvelope, trimmed_envelope};
use crate::sweep::{
    ConvexTool, Envelope, EnvelopePoint, Motion, ProfileChain, ToolMotion, arc_volume, line_volume,
    tool_volume,
};
use crate::tool::{Contour, ContourRead};

/// Tolerance of the mesh where none is wanted [mm].
pub(super) const TOLERANCE: f64 = 0.01;
/// Sample points where no number is wanted.
const POINTS: u32 = 400;
/// Most sample points: beyond it the text has gigabytes.
const MOST_POINTS: u32 = 1_000_000;
/// Least moments of the sample points; more are the root of their number.
const LEAST_MOMENTS: usize = 9;
/// Intervals of time of what changes over the move.
const STEPS: usize = 48;

/// Area and volume that enter at a moment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EnteringAt {
    /// Area of the tool that enters [mm2].
    pub area: f64,
    /// Closed grazing curves, and those that end at a face which grazes as a whole.
    pub curves: usize,
    /// Moment.
    pub t: f64,
    /// Volume that it enters by `t` [mm3].
    #[serde(rename = "volume_rate")]
    pub rate: f64,
}

/// The envelope of a move with all that is shown of it.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvelopeSheet {
    /// Title.
    pub title: String,
    /// The tool.
    pub contour: Contour,
    /// Its chain of pieces.
    pub chain: ProfileChain,
    /// The move.
    pub motion: ToolMotion,
    /// Motion of the tip or the tool, in words.
    pub way: &'static str,
    /// Rule for the positions between the ends, in words.
    pub mode: &'static str,
    /// Source of the move.
    pub source: MoveSource,
    /// Length of the way of the tip [mm].
    pub length: f64,
    /// Angle by which the tool's axis turns, along its way [rad].
    pub turn: f64,
    /// Share of the move that is swept.
    pub until: f64,
    /// Tolerance of the meshes [mm].
    pub tolerance: f64,
    /// The boundary of what is swept.
    pub trimmed: TrimmedEnvelope,
    /// The envelope with all that lies inside of what is swept.
    pub envelope: Envelope,
    /// Volume of the tool [mm3].
    pub tool_volume: f64,
    /// Volume in closed form, where there is one: straight moves and level arcs of a tool that does not turn [mm3].
    pub exact_volume: Option<f64>,
    /// Areas and volumes that enter over the move.
    pub entering: Vec<EnteringAt>,
    /// Cells of the walls.
    pub walls: Vec<WallCell>,
    /// Cusps at the moments of [`EnvelopeSheet::entering`].
    pub cusps: Vec<EnvelopePoint>,
    /// Number of sample points that are wanted.
    pub wanted_points: usize,
    /// Notes of the tool's reader.
    pub notes: Vec<String>,
    /// Findings.
    pub findings: Vec<Finding>,
}

/// The sheets of a table, one for each move; files come through `loader`.
///
/// # Errors
/// `KC1212` when the move is not given once, `KC1202` for a pose that is not rigid, `KC1203` for a move that cannot be made,
/// `KC1204` and `KC1205` for the tolerance, `KC0103` for invalid numbers; those of the tool, the machine and the job.
pub fn envelope_sheets(
    table: &EnvelopeTable,
    loader: &dyn Loader,
    progress: &dyn Progress,
) -> Result<Vec<EnvelopeSheet>> {
    crate::job::check::numbers::within(table)?;
    let given = given_contour(table.tool.as_ref(), table.tool_file.as_deref(), loader)?;
    let moves = motions(table, given.is_none(), loader)?;
    moves.into_iter().map(|moving| sheet(table, given.clone(), moving, progress)).collect()
}

/// A tool in a move.
pub(super) struct Moved {
    pub(super) title: String,
    pub(super) contour: Contour,
    pub(super) motion: ToolMotion,
    pub(super) until: f64,
    pub(super) way: &'static str,
    pub(super) mode: &'static str,
    pub(super) source: MoveSource,
    pub(super) notes: Vec<String>,
}

/// The tool of a table in one of its moves, up to the share that is wanted.
pub(super) fn moved(table: &EnvelopeTable, given: Option<ContourRead>, moving: GivenMove) -> Result<Moved> {
    let GivenMove { motion, way, mode, source, tool } = moving;
    let (name, contour, notes) = chosen_contour(given, tool)?;
    let mut title = table.title.clone().unwrap_or(name);
    if let MoveSource::Line { part, of, .. } = &source
        && *of > 1
    {
        title = format!("{title}{}move {part} of {of}", if title.is_empty() { "" } else { ", " });
    }
    let until = table.until.unwrap_or(1.0);
    if !(until > 0.0 && until <= 1.0) {
        return Err(Finding::error(Code::JOB_VALUE, "the share of the move is not above 0 and up to 1")
            .value(until, "")
            .bound(1.0, "")
            .key("until")
            .into());
    }
    let motion = if until < 1.0 { motion.until(until) } else { motion };
    Ok(Moved { title, contour, motion, until, way, mode, source, notes })
}

fn sheet(
    table: &EnvelopeTable,
    given: Option<ContourRead>,
    moving: GivenMove,
    progress: &dyn Progress,
) -> Result<EnvelopeSheet> {
    let Moved { title, contour, motion, until, way, mode, source, notes } = moved(table, given, moving)?;
    let points = table.points.unwrap_or(POINTS);
    if points > MOST_POINTS {
        return Err(Finding::error(Code::JOB_VALUE, "there are too many sample points")
            .value(f64::from(points), "")
            .bound(f64::from(MOST_POINTS), "")
            .key("points")
            .into());
    }
    let chain = ProfileChain::new(&contour);
    let tolerance = table.tolerance.unwrap_or(TOLERANCE);
    let envelope = chain.envelope(&motion, tolerance, progress).map_err(|e| match e.code() {
        Code::SWEEP_TOLERANCE | Code::SWEEP_TOO_FINE => e.under("tolerance"),
        _ => e,
    })?;
    let step = table.step.map(|step| length("step", step, 1e-4, MAX_LENGTH)).transpose()?;
    let trimmed = trimmed_envelope((&contour, &motion), tolerance, step, progress)?;
    let [length, turn] = way_and_turn(&motion);
    let moments: Vec<f64> = (0..=STEPS).map(|k| k as f64 / STEPS as f64).collect();
    let entering: Vec<EnteringAt> = moments.par_iter().map(|&t| entering_at(&chain, &motion, t)).collect();
    let cusps: Vec<Vec<EnvelopePoint>> = moments.par_iter().map(|&t| chain.cusps(&motion, t)).collect();
    let findings = Vec::from_iter(still(&chain, &motion, &moments));
    Ok(EnvelopeSheet {
        title,
        exact_volume: exact_volume(&contour, &motion),
        tool_volume: tool_volume(&contour),
        walls: walls(&chain, &motion),
        wanted_points: points as usize,
        cusps: cusps.concat(),
        contour,
        chain,
        motion,
        way,
        mode,
        source,
        length,
        turn,
        until,
        tolerance,
        trimmed,
        envelope,
        entering,
        notes,
        findings,
    })
}

impl EnvelopeSheet {
    /// Areas [mm2]: walls; walls inside of the swept volume (judged by neighbouring moments); of those, traced by
    /// hollow edges.
    pub fn wall_areas(&self) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for c in &self.walls {
            sums[0] += c.area;
            sums[1] += if c.inside { c.area } else { 0.0 };
            sums[2] += if c.inside && c.hollow { c.area } else { 0.0 };
        }
        sums
    }

    /// Whether the mesh of the envelope may cut itself, judged by neighbouring moments.
    pub fn cuts_itself(&self) -> bool {
        !self.cusps.is_empty() || self.walls.iter().any(|c| c.inside)
    }

    /// Points of the grazing curves at equal moments, as many as are wanted if there are as many.
    pub fn points(&self) -> Vec<EnvelopePoint> {
        let (chain, motion, wanted) = (&self.chain, &self.motion, self.wanted_points);
        if wanted == 0 {
            return Vec::new();
        }
        let moments = LEAST_MOMENTS.max((wanted as f64).sqrt() as usize);
        let each = wanted.div_ceil(moments);
        let at = |k: usize| -> Vec<EnvelopePoint> {
            let t = k as f64 / (moments - 1) as f64;
            let spans = chain.grazing(&motion.at(t).twist).spans.len();
            let count = each.div_ceil(2 * spans.max(1)).max(1);
            let all = chain.envelope_points(motion, t, count);
            let keep = each.min(all.len());
            (0..keep).map(|i| all[i * all.len() / keep]).collect()
        };
        let all: Vec<EnvelopePoint> = (0..moments).into_par_iter().flat_map_iter(at).collect();
        let keep = wanted.min(all.len());
        (0..keep).map(|i| all[i * all.len() / keep]).collect()
    }

    /// A piece in words: its number in the chain and what it is.
    pub fn piece_words(&self, index: usize) -> String {
        crate::verbs::grazing::piece_words(&self.chain, index)
    }

    /// The moments at the start, in the middle and at the end.
    pub fn main_moments(&self) -> [EnteringAt; 3] {
        let nothing = EnteringAt { t: 0.0, curves: 0, area: 0.0, rate: 0.0 };
        [0, STEPS / 2, STEPS].map(|k| self.entering.get(k).copied().unwrap_or(nothing))
    }
}

pub(super) fn entering_at(chain: &ProfileChain, motion: &ToolMotion, t: f64) -> EnteringAt {
    let twist = motion.at(t).twist;
    let grazing = chain.grazing(&twist);
    let areas = chain.entered_areas(&twist, &grazing);
    let sum = |of: fn(&crate::sweep::EnteredArea) -> f64| areas.iter().map(of).sum();
    EnteringAt { t, curves: grazing.loops.len(), area: sum(|a| a.entering), rate: sum(|a| a.gained) }
}

/// Length of the tip's way and the angle that the axis sweeps, by Simpson's rule: exact for every move at constant rates.
pub(super) fn way_and_turn(motion: &ToolMotion) -> [f64; 2] {
    /// Panels: a smooth move over many turns is followed to eight digits.
    const PANELS: u32 = 256;
    let mut sums = [0.0; 2];
    for k in 0..=2 * PANELS {
        let weight = match k {
            0 => 1.0,
            k if k == 2 * PANELS => 1.0,
            k if k % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let twist = motion.at(f64::from(k) / f64::from(2 * PANELS)).twist;
        sums[0] += weight * twist.shift.length();
        sums[1] += weight * twist.turn.truncate().length();
    }
    sums.map(|s| s / f64::from(6 * PANELS))
}

/// The volume of a straight move, and of a level arc, of a tool that does not turn; of other moves and of tools that are not convex
/// none is known.
fn exact_volume(contour: &Contour, motion: &ToolMotion) -> Option<f64> {
    /// Sine of the angle between tool and axis of an arc that is rounding.
    const ALONG: f64 = 1e-12;
    let (curve, axis) = motion.as_fixed()?;
    match curve.kind() {
        CurveKind::Line(line) if ConvexTool::new(contour).is_some() => {
            let back = motion.pose(0.0).rotation.transpose();
            Some(line_volume(contour, back * (line.end - line.start)))
        }
        CurveKind::Arc(arc) if arc.rise == 0.0 && arc.axis.cross(axis).length() <= ALONG => {
            arc_volume(contour, arc.radius(), arc.sweep)
        }
        _ => None,
    }
}

/// A warning where the tool sweeps itself at all of these moments.
pub(super) fn still(chain: &ProfileChain, motion: &ToolMotion, moments: &[f64]) -> Option<Finding> {
    let is_still =
        |t: &f64| matches!(chain.grazing(&motion.at(*t).twist).motion, Motion::Still | Motion::Spin);
    let what = "the tool does not move, or turns about its own axis alone: it sweeps itself, and the mesh is the tool";
    moments.iter().all(is_still).then(|| Finding::warning(Code::NO_MOTION, what))
}
