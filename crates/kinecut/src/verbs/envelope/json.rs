//! The sheet as JSON: mm, degrees; rates by the whole move. The mesh itself is in the files of `--out`.

use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::{EnvelopeSheet, MoveSource};
use crate::geom::Rigid;
use crate::sweep::{Branch, EnvelopePoint, PieceKind, PieceShape};
use crate::verbs::grazing::role_name;

impl Serialize for EnvelopeSheet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.json().serialize(serializer)
    }
}

impl EnvelopeSheet {
    fn json(&self) -> Value {
        let bounds = self.envelope.mesh.bounds();
        let [walls, inside, hollow] = self.wall_areas();
        let piece = |(i, p): (usize, &crate::sweep::ChainPiece)| {
            json!({
                "what": self.piece_words(i), "role": role_name(p.role), "body": p.body,
                "parameter": if matches!(p.shape, PieceShape::Line { .. }) { "mm" } else { "deg" },
                "from": self.shown(i, p.from), "to": self.shown(i, p.to),
                "start": p.point(p.from).to_array(), "end": p.point(p.to).to_array(),
                "fan": p.kind != PieceKind::Element,
            })
        };
        let event = |e: &crate::sweep::EnvelopeEvent| json!({ "between": e.between, "before": e.before, "after": e.after });
        let entering = self
            .entering
            .iter()
            .map(|e| json!({ "t": e.t, "curves": e.curves, "area": e.area, "volume_rate": e.rate }));
        json!({
            "title": self.title,
            "way": self.way,
            "mode": self.mode,
            "source": source(&self.source),
            "length": self.length,
            "turn": self.turn.to_degrees(),
            "poses": [pose(&self.motion.pose(0.0)), pose(&self.motion.pose(1.0))],
            "pieces": self.chain.pieces().iter().enumerate().map(piece).collect::<Vec<_>>(),
            "tolerance": self.tolerance,
            "pose_error": self.envelope.pose_error,
            "moments": self.envelope.moments,
            "mesh": {
                "vertices": self.envelope.mesh.vertices.len(),
                "triangles": self.envelope.mesh.triangles.len(),
                "volume": self.envelope.mesh.volume(),
                "may_cut_itself": self.cuts_itself(),
                "bounds": [bounds.min.to_array(), bounds.max.to_array()],
            },
            "tool_volume": self.tool_volume,
            "exact_volume": self.exact_volume,
            "events": self.envelope.events.iter().map(event).collect::<Vec<_>>(),
            "walls": { "area": walls, "inside": inside, "of_hollow_edges": hollow },
            "cusps": self.cusps.iter().map(|p| self.point(p)).collect::<Vec<_>>(),
            "entering": entering.collect::<Vec<_>>(),
            "points": self.points.iter().map(|p| self.point(p)).collect::<Vec<_>>(),
            "notes": self.notes,
            "findings": self.findings,
        })
    }

    /// A parameter of a piece: mm of a line, degrees of an arc.
    fn shown(&self, piece: usize, u: f64) -> f64 {
        match self.chain.pieces().get(piece).map(|p| p.shape) {
            Some(PieceShape::Arc { .. }) => u.to_degrees(),
            _ => u,
        }
    }

    /// `second` is infinite on edges, which JSON has no number for: there it is null.
    fn point(&self, p: &EnvelopePoint) -> Value {
        json!({
            "t": p.t, "piece": p.piece, "branch": if p.branch == Branch::Plus { 1 } else { -1 },
            "u": self.shown(p.piece as usize, p.u), "theta": p.theta.to_degrees().rem_euclid(360.0),
            "point": p.point.to_array(), "normal": p.normal.to_array(),
            "second": p.second.is_finite().then_some(p.second),
            "on_boundary": p.is_on_boundary(), "role": role_name(p.role),
        })
    }
}

/// Rows of the matrix [R p].
fn pose(p: &Rigid) -> [[f64; 4]; 3] {
    let rows = p.rotation.transpose();
    let t = p.translation;
    [(rows.x_axis, t.x), (rows.y_axis, t.y), (rows.z_axis, t.z)].map(|(r, t)| [r.x, r.y, r.z, t])
}

fn source(source: &MoveSource) -> Value {
    match source {
        MoveSource::Way => json!("move"),
        MoveSource::Joints { machine, words: [from, to] } => {
            json!({ "machine": machine, "from": from, "to": to })
        }
        MoveSource::Screw => json!("screw"),
        MoveSource::Line { program, line, block, part: [part, of] } => {
            json!({ "program": program, "line": line, "block": block, "move": part, "of": of })
        }
    }
}
