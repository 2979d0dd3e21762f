//! The sheet as JSON: mm, degrees, mm/min, degrees/min; parameters of arcs in degrees.

use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::{GrazingSheet, MotionSource};
use crate::geom::Rigid;
use crate::sweep::{Branch, GrazingPoint, PieceKind, PieceShape, SegmentKind};
use crate::tool::Role;

/// Seconds of a minute.
const MINUTE: f64 = 60.0;

/// The sheet as JSON; `points` of each curve keep its chords to the tolerance.
impl Serialize for GrazingSheet {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.json().serialize(serializer)
    }
}

impl GrazingSheet {
    fn json(&self) -> Value {
        let pieces = self.chain.pieces();
        let deg = |piece: usize, u: f64| match pieces[piece].shape {
            PieceShape::Line { .. } => u,
            PieceShape::Arc { .. } => u.to_degrees(),
        };
        let spans = self.spans.iter().map(|s| {
            let span = &s.span;
            json!({
                "piece": span.piece, "kind": kind_name(span.kind), "role": role_name(pieces[span.piece].role),
                "from": deg(span.piece, span.from), "to": deg(span.piece, span.to), "folds": span.folds,
                "lengths": s.lengths,
            })
        });
        let loops = self.loops.iter().zip(&self.grazing.loops).map(|(l, of)| {
            let points = self.chain.curve(&self.grazing, of, self.tolerance);
            json!({
                "spans": [l.spans.start, l.spans.end], "closed": l.closed, "winding": l.winding, "length": l.length,
                "points": points.iter().map(|p| self.point(p)).collect::<Vec<_>>(),
            })
        });
        let piece = |(i, e): (usize, &crate::sweep::EnteredArea)| {
            let p = &pieces[i];
            json!({
                "what": self.piece_words(i), "role": role_name(p.role), "body": p.body,
                "parameter": if matches!(p.shape, PieceShape::Line { .. }) { "mm" } else { "deg" },
                "from": deg(i, p.from), "to": deg(i, p.to),
                "start": p.point(p.from).to_array(), "end": p.point(p.to).to_array(),
                "fan": p.kind != PieceKind::Element,
                "area": e.area, "entering_area": e.entering, "entering_share": e.share,
                "gained": e.gained * MINUTE, "lost": e.lost * MINUTE,
            })
        };
        let [area, entering] = self.areas();
        let [gained, lost] = self.rates();
        json!({
            "title": self.title,
            "motion": self.motion_words(),
            "twist": {
                "velocity": (self.twist.shift * MINUTE).to_array(),
                "turn": (self.twist.turn * MINUTE).to_array().map(f64::to_degrees),
            },
            "source": source(&self.source),
            "pieces": self.entering.iter().enumerate().map(piece).collect::<Vec<_>>(),
            "loops": loops.collect::<Vec<_>>(),
            "spans": spans.collect::<Vec<_>>(),
            "circles": self.grazing.circles.iter().map(|&(i, u)| json!({
                "piece": i, "at": deg(i, u), "radius": pieces[i].point(u).x, "z": pieces[i].point(u).y,
            })).collect::<Vec<_>>(),
            "whole": self.grazing.whole,
            "touching": self.grazing.touching,
            "entering": { "area": area, "entering_area": entering, "gained": gained * MINUTE, "lost": lost * MINUTE },
            "tolerance": self.tolerance,
            "notes": self.notes,
            "findings": self.findings,
        })
    }

    fn point(&self, p: &GrazingPoint) -> Value {
        let u = match self.chain.pieces()[p.piece as usize].shape {
            PieceShape::Line { .. } => p.u,
            PieceShape::Arc { .. } => p.u.to_degrees(),
        };
        json!({
            "piece": p.piece, "branch": if p.branch == Branch::Plus { 1 } else { -1 }, "u": u,
            "theta": p.theta().to_degrees().rem_euclid(360.0),
            "point": p.point.to_array(), "normal": p.normal.to_array(),
        })
    }
}

fn source(source: &MotionSource) -> Value {
    let pose = |p: &Rigid| {
        let rows = p.rotation.transpose();
        let t = p.translation;
        [(rows.x_axis, t.x), (rows.y_axis, t.y), (rows.z_axis, t.z)].map(|(r, t)| [r.x, r.y, r.z, t])
    };
    match source {
        MotionSource::Twist => json!("twist"),
        MotionSource::Pose(p) => json!({ "pose": pose(p) }),
        MotionSource::Moment { program, line, block, part, pose: p } => {
            json!({ "program": program, "line": line, "block": block, "part": part, "pose": pose(p) })
        }
    }
}

/// Name of a kind of segment, as in JSON.
pub fn kind_name(kind: SegmentKind) -> &'static str {
    match kind {
        SegmentKind::Generator => "generator",
        SegmentKind::ConeCurve => "cone-curve",
        SegmentKind::DiscChord => "disc-chord",
        SegmentKind::SphereArc => "sphere-arc",
        SegmentKind::TorusOuter => "torus-outer",
        SegmentKind::TorusInner => "torus-inner",
        SegmentKind::EdgeArc => "edge-arc",
        SegmentKind::Join => "join",
    }
}

/// Name of a role, as in JSON.
pub fn role_name(role: Role) -> &'static str {
    match role {
        Role::Cutting => "cutting",
        Role::Shank => "shank",
        Role::Holder => "holder",
    }
}
