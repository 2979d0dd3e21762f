//! `plan.json`: what was planned and posted, in the units of the shop (mm, mm/min, degrees, s).

use std::collections::BTreeMap;

use serde::Serialize;

use super::check::Job;
use super::cutting::{CuttingJson, cutting_json};
use super::draft::Draft;
use super::outcome::Outcome;
use super::setup_outcome::SetupOutcome;
use super::{ReadBack, Subject, json_text};
use crate::geom::{Curve, CurveKind, SpiralLaw};
use crate::motion::ProgramTime;
use crate::operations::OperationJson;
use crate::operations::measured::BoreMeasure;
use crate::program::{Role, ToolNumber};
use crate::trace::SegmentPace;

#[derive(Serialize)]
struct Plan<'a> {
    /// Version of this form.
    format: u32,
    kinecut: &'static str,
    title: &'a str,
    job: &'a str,
    setups: Vec<SetupJson<'a>>,
    /// Volumes; none of a draft.
    #[serde(flatten)]
    volumes: Option<Volumes>,
    /// Speeds and feeds that operations were given, with their origins.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    cutting: Vec<CuttingJson>,
    /// The bores as they were measured; none of a draft.
    #[serde(skip_serializing_if = "Option::is_none")]
    bores: Option<Vec<BoreFigures>>,
}

/// Volume of the raw stock, and what the program removes [mm3].
#[derive(Serialize)]
struct Volumes {
    stock_volume: f64,
    removed_volume: f64,
    /// The true removed volume is no farther off than this.
    removed_volume_bound: f64,
}

#[derive(Serialize)]
struct SetupJson<'a> {
    program: &'a str,
    control: &'static str,
    /// Time [s]: under the limits of the machine's axes where they are known, else at programmed feeds.
    time: f64,
    /// Whether rapids are in the time.
    time_has_rapids: bool,
    /// The same if jerk had no limit [s].
    #[serde(skip_serializing_if = "Option::is_none")]
    time_without_jerk_limit: Option<f64>,
    /// Distance of the posted text from the plan [mm]; none of a program that others wrote.
    #[serde(skip_serializing_if = "Option::is_none")]
    read_back: Option<&'a ReadBack>,
    /// Number of its moves.
    move_count: usize,
    /// The moves; of a program that others wrote they are in its text, which the hash names.
    #[serde(skip_serializing_if = "Option::is_none")]
    moves: Option<Vec<MovePlan>>,
    /// SHA-256 of the text of a program that others wrote.
    #[serde(skip_serializing_if = "Option::is_none")]
    program_sha256: Option<&'a str>,
    /// Lists of what the operations say of themselves, one for each kind that has something to say.
    #[serde(flatten)]
    operations: BTreeMap<&'static str, Vec<OperationJson>>,
}

#[derive(Serialize)]
struct MovePlan {
    /// Line of the program, from 1.
    line: Option<u32>,
    tool: Option<ToolNumber>,
    role: Role,
    /// mm/min; null for a rapid.
    feed: Option<f64>,
    length: f64,
    end: [f64; 3],
    #[serde(flatten)]
    shape: Shape,
}

#[derive(Serialize)]
#[serde(tag = "path", rename_all = "kebab-case")]
enum Shape {
    Line,
    Arc {
        centre: [f64; 3],
        sweep_deg: f64,
        rise: f64,
    },
    /// The six-number record: length, start, tangent angle [rad], radii of curvature.
    Involute {
        record: [f64; 6],
        base_radius: f64,
        base_centre: [f64; 2],
        rise: f64,
    },
    /// A spiral: its law about the origin, between two parameters [rad]; reflected (x -> -x) first if so, then turned
    /// [rad], then shifted.
    Spiral {
        law: SpiralLaw,
        parameters: [f64; 2],
        mirrored: bool,
        turned: f64,
        shift: [f64; 2],
        rise: f64,
    },
    /// A cubic Bezier curve by its control points.
    Cubic {
        points: [[f64; 3]; 4],
    },
}

#[derive(Serialize)]
struct BoreFigures {
    operation: u32,
    /// Of a round bore; of a conical one at the bottom.
    wanted_diameter: Option<f64>,
    measured_diameter: Option<[f64; 2]>,
    /// Least and greatest distance of the wall inside of the wanted one: positive where stock is left.
    wall_inside_wanted: Option<[f64; 2]>,
    floor_above_wanted: Option<[f64; 2]>,
    stock_left: f64,
    gouge: f64,
}

/// The plan of an outcome as JSON text; points in part coordinates.
pub fn plan_json(outcome: &Outcome) -> String {
    let subjects = &outcome.verdict.subjects;
    let one = |i: usize| setup(&outcome.job, &outcome.setups[i], subjects, lists(outcome, i));
    json_text(&Plan {
        format: 1,
        kinecut: crate::VERSION,
        title: &outcome.job.title,
        job: &outcome.job_file,
        setups: (0..outcome.setups.len()).map(one).collect(),
        volumes: Some(Volumes {
            stock_volume: outcome.simulation.raw.value,
            removed_volume: outcome.removed.value,
            removed_volume_bound: outcome.removed.bound,
        }),
        cutting: cutting_json(&outcome.job),
        bores: Some(outcome.deviation.bores.iter().map(figures).collect()),
    })
}

/// The plan of a draft as JSON text: that of its outcome without what only cutting tells.
pub fn draft_json(draft: &Draft) -> String {
    let setups = draft.setups.iter().enumerate();
    let setups = setups.map(|(i, done)| setup(&draft.job, done, &draft.subjects, draft.lists(i)));
    json_text(&Plan {
        format: 1,
        kinecut: crate::VERSION,
        title: &draft.job.title,
        job: &draft.job_file,
        setups: setups.collect(),
        volumes: None,
        cutting: cutting_json(&draft.job),
        bores: None,
    })
}

fn figures(m: &BoreMeasure) -> BoreFigures {
    BoreFigures {
        operation: m.operation,
        wanted_diameter: m.wanted_radius.map(|r| 2.0 * r),
        measured_diameter: m.radius().map(|r| r.map(|v| 2.0 * v)),
        wall_inside_wanted: m.wall[0].is_finite().then_some(m.wall),
        floor_above_wanted: m.floor.filter(|f| f[0].is_finite()),
        stock_left: m.left.depth,
        gouge: m.gouge.depth,
    }
}

/// A setup's program; a program that others wrote has its hash among the `subjects`, operations say of themselves what `lists` has.
fn setup<'a>(
    job: &Job,
    s: &'a SetupOutcome,
    subjects: &'a [Subject],
    lists: BTreeMap<&'static str, Vec<OperationJson>>,
) -> SetupJson<'a> {
    let trace = if s.external.is_some() { &s.trace } else { &s.plan_trace };
    let segments = || trace.segments.iter().filter(|x| !x.alternative);
    let moves = segments().map(|x| MovePlan {
        line: s.line_of_planned(x.item).map(|l| l + 1),
        tool: x.tool,
        role: s.planned.program.origin(x.item as usize).role,
        feed: match x.motion {
            SegmentPace::Rapid => None,
            SegmentPace::Feed(feed) => Some(feed * 60.0),
        },
        length: x.curve.length(),
        end: x.curve.end().to_array(),
        shape: shape(&x.curve),
    });
    SetupJson {
        program: &s.file,
        control: s.control(job).name(),
        time: s.seconds(),
        time_has_rapids: s.time.is_some() || s.trace.duration().1,
        time_without_jerk_limit: s.time.as_ref().map(ProgramTime::total_without_jerk),
        read_back: s.external.is_none().then_some(&s.read_back),
        move_count: segments().count(),
        moves: s.external.is_none().then(|| moves.collect()),
        program_sha256: s.external.as_ref().and_then(|_| hash_of(subjects, &s.file)),
        operations: lists,
    }
}

/// The hash of a program that others wrote, as the verdict has it.
fn hash_of<'a>(subjects: &'a [Subject], file: &str) -> Option<&'a str> {
    let own = subjects.iter().find(|s| s.file.as_deref() == Some(file))?;
    Some(&own.sha256)
}

/// The entries of a setup's operations, each in the list of its kind.
fn lists(outcome: &Outcome, setup: usize) -> BTreeMap<&'static str, Vec<OperationJson>> {
    OperationJson::lists(&outcome.shown(setup, &[], 0)).into_iter().collect()
}

fn shape(curve: &Curve) -> Shape {
    match curve.kind() {
        CurveKind::Line(_) => Shape::Line,
        CurveKind::Arc(arc) => Shape::Arc {
            centre: arc.centre.to_array(),
            sweep_deg: arc.sweep.to_degrees() * 1f64.copysign(arc.axis.z),
            rise: arc.rise,
        },
        CurveKind::Involute { record, frame, rise } => {
            let record = record.shifted(frame.point(glam::DVec3::ZERO).truncate());
            let start = record.start();
            let six = [
                record.length(),
                start.x,
                start.y,
                record.start_angle(),
                record.start_radius(),
                record.end_radius(),
            ];
            Shape::Involute {
                record: six,
                base_radius: record.base_radius(),
                base_centre: record.base_centre().to_array(),
                rise,
            }
        }
        CurveKind::Spiral { spiral, frame, rise } => {
            let (mirrored, turned, shift) = spiral.placement();
            Shape::Spiral {
                law: *spiral.law(),
                parameters: spiral.parameters(),
                mirrored,
                turned,
                shift: (shift + frame.point(glam::DVec3::ZERO).truncate()).to_array(),
                rise: rise.total(),
            }
        }
        CurveKind::Bezier { span, frame } => {
            Shape::Cubic { points: span.points().map(|p| frame.point(p.extend(0.0)).to_array()) }
        }
    }
}
