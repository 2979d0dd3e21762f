//! The sheet as JSON: mm, degrees; rates by the whole move. The mesh itself is in the files of `--out`.

use serde::{Serialize, Serializer};

use super::{EnteringAt, EnvelopeSheet, MoveSource};
use crate::base::Finding;
use crate::geom::Mesh;
use crate::sweep::{EnvelopeEvent, EnvelopePoint};
use crate::tool::ElementRole;
use crate::verbs::grazing::json::{PieceJson, matrix, parameter, sign, turned};

/// The fields of all tables stand in the order of their names.
#[derive(Serialize)]
struct SheetJson<'a> {
    cusps: Vec<PointJson>,
    entering: &'a [EnteringAt],
    events: &'a [EnvelopeEvent],
    exact_volume: Option<f64>,
    findings: &'a [Finding],
    length: f64,
    mesh: MeshJson,
    mode: &'static str,
    moments: &'a [f64],
    notes: &'a [String],
    pieces: Vec<PieceJson>,
    points: Vec<PointJson>,
    pose_error: f64,
    poses: [[[f64; 4]; 3]; 2],
    source: &'a MoveSource,
    title: &'a str,
    tolerance: f64,
    tool_volume: f64,
    turn: f64,
    until: f64,
    untrimmed: UntrimmedJson,
    walls: WallsJson,
    way: &'static str,
}

#[derive(Serialize)]
struct MeshJson {
    bounds: [[f64; 3]; 2],
    deeper: usize,
    deepest: f64,
    looked_at: usize,
    step: f64,
    triangles: usize,
    vertices: usize,
    volume: f64,
    volume_of_lines: f64,
}

#[derive(Serialize)]
struct UntrimmedJson {
    bounds: [[f64; 3]; 2],
    may_cut_itself: bool,
    triangles: usize,
    vertices: usize,
    volume: f64,
}

fn bounds(mesh: &Mesh) -> [[f64; 3]; 2] {
    let bounds = mesh.bounds();
    [bounds.min.to_array(), bounds.max.to_array()]
}

/// `second` is infinite on edges, which JSON has no number for: there it is null.
#[derive(Serialize)]
struct PointJson {
    branch: i8,
    normal: [f64; 3],
    on_boundary: bool,
    piece: u32,
    point: [f64; 3],
    role: ElementRole,
    second: Option<f64>,
    t: f64,
    theta: f64,
    u: f64,
}

#[derive(Serialize)]
struct WallsJson {
    area: f64,
    inside: f64,
    of_hollow_edges: f64,
}

impl Serialize for EnvelopeSheet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (envelope, trimmed) = (&self.envelope, &self.trimmed);
        let [area, inside, of_hollow_edges] = self.wall_areas();
        let pieces = (0..self.chain.pieces().len()).map(|i| PieceJson::of(&self.chain, i, None));
        let sheet = SheetJson {
            cusps: self.cusps.iter().map(|p| self.point(p)).collect(),
            entering: &self.entering,
            events: &envelope.events,
            exact_volume: self.exact_volume,
            findings: &self.findings,
            length: self.length,
            mesh: MeshJson {
                bounds: bounds(&trimmed.mesh),
                deeper: trimmed.deeper,
                deepest: trimmed.deepest,
                looked_at: trimmed.looked_at,
                step: trimmed.step,
                triangles: trimmed.mesh.triangles.len(),
                vertices: trimmed.mesh.vertices.len(),
                volume: trimmed.mesh.volume(),
                volume_of_lines: trimmed.volume,
            },
            mode: self.mode,
            moments: &envelope.moments,
            notes: &self.notes,
            pieces: pieces.collect(),
            points: self.points().iter().map(|p| self.point(p)).collect(),
            pose_error: envelope.pose_error,
            poses: [0.0, 1.0].map(|t| matrix(&self.motion.pose(t))),
            source: &self.source,
            title: &self.title,
            tolerance: self.tolerance,
            tool_volume: self.tool_volume,
            turn: self.turn.to_degrees(),
            until: self.until,
            untrimmed: UntrimmedJson {
                bounds: bounds(&envelope.mesh),
                may_cut_itself: self.cuts_itself(),
                triangles: envelope.mesh.triangles.len(),
                vertices: envelope.mesh.vertices.len(),
                volume: envelope.mesh.volume(),
            },
            walls: WallsJson { area, inside, of_hollow_edges },
            way: self.way,
        };
        sheet.serialize(serializer)
    }
}

impl EnvelopeSheet {
    fn point(&self, p: &EnvelopePoint) -> PointJson {
        PointJson {
            branch: sign(p.branch),
            normal: p.normal.to_array(),
            on_boundary: p.is_on_boundary(),
            piece: p.piece,
            point: p.point.to_array(),
            role: p.role,
            second: Some(p.second).filter(|s| s.is_finite()),
            t: p.t,
            theta: turned(p.theta),
            u: self.chain.pieces().get(p.piece as usize).map_or(p.u, |of| parameter(of, p.u)),
        }
    }
}
