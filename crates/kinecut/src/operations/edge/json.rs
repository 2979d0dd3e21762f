//! Planned breaks of edges as `plan.json` has them.

use serde::Serialize;

use super::PlannedEdge;
use super::burrs::FoundBurrs;
use crate::contouring::{ContourSide, CutPiece, EdgeBreak, LoopStretches, PlannedLoop};
use crate::facing::burrs::{BurrPart, BurrState};

/// A broken edge; lengths [mm], heights in the work offset.
#[derive(Debug, Serialize)]
pub(crate) struct EdgeJson {
    operation: u32,
    side: ContourSide,
    /// Z of the edge.
    top: f64,
    width: f64,
    /// Depth of the tip below the edge.
    depth: f64,
    /// Distance of the cutter's axis from the wall.
    offset: f64,
    /// Radius of the cutter at the edge.
    top_radius: f64,
    /// Of a V cutter.
    #[serde(skip_serializing_if = "Option::is_none")]
    tip_clearance: Option<f64>,
    /// Of a ball: depth of the middle below a straight chamfer.
    #[serde(skip_serializing_if = "Option::is_none")]
    hollow: Option<f64>,
    /// mm/min.
    feed: f64,
    plunge_feed: f64,
    loops: Vec<LoopJson>,
    /// Inside corners before which the break ends.
    webs: Vec<WebJson>,
    /// Burrs of the face before, where it goes by them.
    #[serde(skip_serializing_if = "Option::is_none")]
    burrs: Option<BurrsJson>,
}

/// Burrs of a face: treated and not.
#[derive(Debug, Serialize)]
struct BurrsJson {
    /// Number of the operation that has milled the face.
    face: u32,
    /// In the order of cutting.
    pieces: Vec<PieceJson>,
    not_treated: Vec<BurrJson>,
}

/// A piece that is cut without a break.
#[derive(Debug, Serialize)]
struct PieceJson {
    /// The stretches of the outline along which the break is cut.
    beside: Vec<BesideJson>,
    /// Whether the path is all of its loop.
    closed: bool,
    /// The chosen burrs on it.
    burrs: Vec<BurrJson>,
}

/// A stretch of a loop of the outline.
#[derive(Debug, Serialize)]
struct BesideJson {
    /// Index of the loop.
    #[serde(rename = "loop")]
    of_loop: usize,
    /// From and to along the loop, from its first point.
    along: [f64; 2],
}

/// A burr on a stretch of an edge.
#[derive(Debug, Serialize)]
struct BurrJson {
    edge: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    label: Option<String>,
    from: f64,
    to: f64,
    /// Least and greatest, degrees, as the face gives them; none where the cutter was lowered. Of a burr that is cut in part those of
    /// all of it, as its height.
    exit_angles: Option<[f64; 2]>,
    /// Greatest height, by the table of the job, interpolated.
    height: Option<f64>,
    /// Whether it was chosen.
    chosen: bool,
}

/// A loop of the path of the cutter's tip, or a piece of one.
#[derive(Debug, Serialize)]
struct LoopJson {
    outer: bool,
    start: [f64; 2],
    length: f64,
}

#[derive(Debug, Serialize)]
struct WebJson {
    at: [f64; 2],
    /// Length of the edge that it keeps; none where the cutter does not go between two loops.
    length: Option<f64>,
}

impl EdgeJson {
    /// Of a plan and the number of its operation.
    pub(crate) fn new(plan: &PlannedEdge, operation: u32) -> EdgeJson {
        let cut = &plan.of.cut;
        let one = |l: &PlannedLoop| LoopJson {
            outer: l.outer,
            start: l.edges.first().map_or([0.0; 2], |e| e.start.to_array()),
            length: l.length(),
        };
        let corners = plan.plan.uncut.iter();
        EdgeJson {
            operation,
            side: plan.spec.side,
            top: plan.of.top,
            width: cut.width(),
            depth: cut.depth(),
            offset: cut.offset(),
            top_radius: cut.top_radius(),
            tip_clearance: match cut {
                EdgeBreak::Chamfer(chamfer) => Some(chamfer.tip_clearance),
                EdgeBreak::Ball(_) => None,
            },
            hollow: match cut {
                EdgeBreak::Chamfer(_) => None,
                EdgeBreak::Ball(ball) => Some(ball.hollow()),
            },
            feed: plan.spec.feed * 60.0,
            plunge_feed: plan.spec.plunge_feed * 60.0,
            loops: plan.plan.loops.iter().map(one).collect(),
            webs: corners.map(|c| WebJson { at: c.at.to_array(), length: c.length }).collect(),
            burrs: plan.burrs.as_ref().map(|found| burrs(plan, found)),
        }
    }
}

fn burrs(plan: &PlannedEdge, found: &FoundBurrs) -> BurrsJson {
    let one = |p: &BurrPart| BurrJson {
        edge: p.edge,
        label: found.face.edges.case.outline.label(p.edge).map(str::to_owned),
        from: p.along[0],
        to: p.along[1],
        exit_angles: (p.state != BurrState::Lowered).then(|| found.shown_angles(p).map(f64::to_degrees)),
        height: p.height,
        chosen: p.state == BurrState::Chosen,
    };
    let outline = &found.face.edges.case.outline;
    let piece = |cut: &CutPiece| {
        let stretches = LoopStretches::new(outline, &cut.beside);
        let of = |of_loop: usize| {
            let own = stretches.of_loop(of_loop).iter();
            own.map(move |along| BesideJson { of_loop, along: *along }).collect::<Vec<_>>()
        };
        PieceJson {
            beside: (0..outline.loops().len()).flat_map(of).collect(),
            closed: cut.closed,
            burrs: found.treated(cut).iter().map(one).collect(),
        }
    };
    let others = found.parts.iter().filter(|p| p.state != BurrState::Chosen);
    BurrsJson {
        face: found.face.operation,
        pieces: plan.cut_pieces().map(piece).collect(),
        not_treated: plan.left().iter().chain(others).map(one).collect(),
    }
}
