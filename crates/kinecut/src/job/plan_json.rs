//! `plan.json`: what was planned and posted, in the units of the shop (mm, mm/min, degrees, s).

use serde::Serialize;

use super::drill::{DrilledHoles, HoleJson, hole_json};
use super::face::FaceJson;
use super::outcome::{Outcome, SetupOutcome};
use super::shape::BoreMeasure;
use super::{Operation, ReadBack, json_text};
use crate::geom::{Curve, CurveKind, Law};
use crate::program::{Role, ToolNumber};
use crate::trace::Motion;

#[derive(Serialize)]
struct Plan<'a> {
    /// Version of this form.
    format: u32,
    kinecut: &'static str,
    title: &'a str,
    job: &'a str,
    setups: Vec<SetupPlan<'a>>,
    /// Volume of the raw stock, and what the program removes [mm3].
    stock_volume: f64,
    removed_volume: f64,
    /// The true removed volume is no farther off than this.
    removed_volume_bound: f64,
    bores: Vec<BoreFigures>,
}

#[derive(Serialize)]
struct SetupPlan<'a> {
    program: &'a str,
    control: &'static str,
    /// Time at programmed feeds [s].
    time: f64,
    /// Whether rapids are in the time.
    time_has_rapids: bool,
    /// Distance of the posted text from the plan [mm]; none of a program that others wrote.
    #[serde(skip_serializing_if = "Option::is_none")]
    read_back: Option<&'a ReadBack>,
    moves: Vec<MovePlan>,
    /// Zones and coordinates of drilled holes; Z from the height `zero` in the work offset.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    drillings: Vec<Drilling>,
    /// Milled faces, in coordinates of the work offset as the part lies when it is not turned.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    faces: Vec<Face>,
}

#[derive(Serialize)]
struct Face {
    operation: u32,
    /// As the sheet of `kinecut face`.
    plan: serde_json::Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    simulated: Option<FaceFigures>,
}

/// What was measured on the simulated stock.
#[derive(Serialize)]
struct FaceFigures {
    bad: f64,
    /// Length of the stock's walls at the outline, of others within it, and of edges that the stock does not have.
    matched: f64,
    strange: f64,
    missing: f64,
    /// Length on which the exit angle is not the plan's.
    differing: f64,
    largest_difference_deg: f64,
    /// Least and greatest height over the finished plane.
    height: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct Drilling {
    operation: u32,
    holes: Vec<HoleJson>,
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
        law: Law,
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
    json_text(&Plan {
        format: 1,
        kinecut: crate::VERSION,
        title: &outcome.job.title,
        job: &outcome.job_file,
        setups: outcome.setups.iter().map(|s| setup(outcome, s)).collect(),
        stock_volume: outcome.simulation.raw.value,
        removed_volume: outcome.removed.value,
        removed_volume_bound: outcome.removed.bound,
        bores: outcome.deviation.bores.iter().map(figures).collect(),
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

fn setup<'a>(outcome: &'a Outcome, s: &'a SetupOutcome) -> SetupPlan<'a> {
    let (time, time_has_rapids) = s.trace.duration();
    // Of a program that others wrote the moves are those of the text.
    let (trace, program) = match s.foreign {
        Some(_) => (&s.trace, &s.program),
        None => (&s.plan_trace, &s.planned.program),
    };
    let line = |item: u32| match s.foreign {
        Some(_) => s.lines.get(item as usize).copied().flatten(),
        None => s.line_of_planned(item),
    };
    let moves = trace.segments.iter().filter(|x| !x.alternative).map(|x| MovePlan {
        line: line(x.item).map(|l| l + 1),
        tool: x.tool,
        role: program.origin(x.item as usize).role,
        feed: match x.motion {
            Motion::Rapid => None,
            Motion::Feed(feed) => Some(feed * 60.0),
        },
        length: x.curve.length(),
        end: x.curve.end().to_array(),
        shape: shape(&x.curve),
    });
    SetupPlan {
        program: &s.file,
        control: s.control(&outcome.job).name(),
        time,
        time_has_rapids,
        read_back: s.foreign.is_none().then_some(&s.read_back),
        moves: moves.collect(),
        drillings: s.planned.drillings.iter().map(drilling).collect(),
        faces: faces(outcome, s),
    }
}

fn faces(outcome: &Outcome, s: &SetupOutcome) -> Vec<Face> {
    let operations: Vec<&Operation> = outcome.job.setups.iter().flat_map(|x| &x.operations).collect();
    let one = |face: &super::PlannedFace| {
        let Some(Operation::Face(operation)) = operations.get(face.operation as usize) else { return None };
        let flat = outcome.deviation.faces.iter().find(|f| f.operation == face.operation);
        let measured = outcome.faces.iter().find(|f| f.operation == face.operation);
        let simulated = measured.map(|m| FaceFigures {
            bad: m.bad,
            matched: m.matched,
            strange: m.strange,
            missing: m.missing,
            differing: m.differing,
            largest_difference_deg: m.largest.to_degrees(),
            height: flat.map(|f| f.height).filter(|h| h[0] <= h[1]),
        });
        Some(Face { operation: face.operation, plan: FaceJson { operation, face }.plan(), simulated })
    };
    s.planned.faces.iter().filter_map(one).collect()
}

fn drilling(d: &DrilledHoles) -> Drilling {
    Drilling { operation: d.operation, holes: d.holes.iter().map(hole_json).collect() }
}

fn shape(curve: &Curve) -> Shape {
    match *curve.kind() {
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
