//! A planned face as JSON, in the units of the shop: mm, degrees, s, mm/min. Everything is as the part lies, also
//! under an M4 spindle; edges and loops have their numbers in the outline as given, from 0.

use std::f64::consts::TAU;

use glam::DVec2;
use serde_json::{Value, json};

use super::PlannedFace;
use crate::facing::optimum::Optimum;
use crate::facing::passes::{EdgeStretch, Met};
use crate::facing::{
    Crossing, Placement, Sweep, ToothedLengths, Way, bad_length, either_bad_length, toothed_lengths,
};
use crate::geom::OutlineEdge;

/// A planned face to be written.
pub(crate) struct FaceJson<'a> {
    /// The plan.
    pub(crate) face: &'a PlannedFace,
}

impl FaceJson<'_> {
    /// The plan.
    pub(crate) fn plan(&self) -> Value {
        let plan = &self.face.plan;
        let operation = &self.face.of;
        let bad = operation.case.bad.parts().iter();
        let bad = bad.map(|p| json!({ "from": deg(p.from), "to": deg(p.to), "weight": p.weight }));
        json!({
            "rule": operation.rule,
            "bad_exit_angles": bad.collect::<Vec<_>>(),
            "guard": deg(operation.guard),
            "margin": operation.margin,
            "levels": operation.levels,
            "outline": self.outline(),
            "cutter": self.cutter(),
            "optimum": match &plan.optimum {
                Ok(optimum) => self.optimum(optimum),
                Err(finding) => json!({ "error": finding }),
            },
            "as_drawn": plan.as_drawn.map(|p| json!({
                "placement": self.placement(p),
                "bad": bad_length(&plan.case, p),
                "guarded": bad_length(&plan.guarded, p),
            })),
            "chosen": plan.chosen,
            "part_turned": deg(self.face.part_turned),
            "coordinates_turned": deg(self.face.coordinates_turned),
            "ways": plan.ways.iter().map(|w| self.way(w)).collect::<Vec<_>>(),
            "stretches": self.face.chosen().burr.stretches.iter().map(|s| self.stretch(s)).collect::<Vec<_>>(),
            "teeth_check": self.teeth_check(),
        })
    }

    pub(crate) fn placement(&self, p: Placement) -> Value {
        let seen = if self.face.plan.left_hand { p.mirrored() } else { p };
        json!({ "turn": turn(seen.angle), "offset": seen.offset })
    }

    pub(crate) fn point(&self, p: DVec2) -> [f64; 2] {
        if self.face.plan.left_hand { [p.x, 0.0 - p.y] } else { p.to_array() }
    }

    /// An edge of the plan and a share of its length, in the outline as given. To mirror twice is to mirror not at all.
    pub(crate) fn as_given(&self, edge: usize, s: f64) -> (usize, f64) {
        self.face.as_planned(edge, s)
    }

    pub(crate) fn outline(&self) -> Value {
        let case = &self.face.of.case;
        let outline = &case.outline;
        let edge = |(i, e): (usize, &OutlineEdge)| {
            let mut value = json!({
                "start": e.start.to_array(),
                "end": e.end.to_array(),
                "length": e.length(),
                "label": outline.label(i),
                "weight": case.weights[i],
            });
            if let Some(t) = e.turn {
                value["centre"] = json!(t.centre.to_array());
                value["radius"] = json!(t.radius);
                value["sweep"] = json!(deg(t.sweep));
            }
            value
        };
        let loops = outline.loops().iter();
        let loops =
            loops.map(|l| json!({ "first": l.edges.start, "count": l.edges.len(), "outer": l.outer }));
        let [min, max] = outline.bounds();
        json!({
            "edges": outline.edges().iter().enumerate().map(edge).collect::<Vec<_>>(),
            "loops": loops.collect::<Vec<_>>(),
            "perimeter": outline.perimeter(),
            "area": outline.area(),
            "min": min.to_array(),
            "max": max.to_array(),
            "notes": self.face.of.notes,
        })
    }

    pub(crate) fn cutter(&self) -> Value {
        let face = &self.face;
        let teeth = face.teeth.iter().map(|t| json!({ "phase": deg(t.phase), "radius": t.radius }));
        json!({
            "radius": self.face.of.case.radius,
            "left_hand": face.plan.left_hand,
            "teeth": teeth.collect::<Vec<_>>(),
            "feed": self.face.of.feed * 60.0,
            "feed_per_revolution": face.feed_per_revolution,
            "feed_per_tooth": face.feed_per_revolution / face.teeth.len().max(1) as f64,
            "spindle_speed": 60.0 * self.face.of.feed / face.feed_per_revolution,
        })
    }

    pub(crate) fn optimum(&self, o: &Optimum) -> Value {
        let [angle, offset] = super::plan::options(&self.face.of, false).set_up_error;
        let alternative = |a: &crate::facing::optimum::LocalMinimum| json!({ "value": a.value, "placement": self.placement(a.placement) });
        let irreducible = |i: &crate::facing::optimum::Irreducible| json!({ "loop": i.outline_loop, "length": i.length, "share": i.share });
        let parallel = o.sensitivity.feed_parallel.iter().map(|&e| self.as_given(e, 0.0).0);
        json!({
            "value": o.value,
            "placement": self.placement(o.placement),
            "lower_bound": o.lower_bound,
            "gap": o.gap(),
            "nodes": o.nodes,
            "complete": o.complete,
            "alternatives": o.alternatives.iter().map(alternative).collect::<Vec<_>>(),
            "irreducible": o.irreducible.iter().map(irreducible).collect::<Vec<_>>(),
            "sensitivity": {
                "turn_error": deg(angle),
                "offset_error": offset,
                "worst": o.sensitivity.worst,
                "worst_at": self.placement(o.sensitivity.worst_at),
                "feed_parallel": parallel.collect::<Vec<_>>(),
            },
        })
    }

    pub(crate) fn way(&self, w: &Way) -> Value {
        let left = self.face.plan.left_hand;
        let path = if left { w.path.mirrored() } else { w.path.clone() };
        let piece = |e: &OutlineEdge| match e.turn {
            None => json!({ "start": e.start.to_array(), "end": e.end.to_array() }),
            Some(t) => json!({
                "start": e.start.to_array(),
                "end": e.end.to_array(),
                "centre": t.centre.to_array(),
                "sweep": deg(t.sweep),
            }),
        };
        let chains = path.chains.iter().map(|c| c.iter().map(piece).collect::<Vec<_>>());
        let seen = |v: f64| if left { -v } else { v };
        json!({
            "name": w.name,
            "turn": w.angle.map(|a| turn(seen(a))),
            "offset": w.offset.map(seen),
            "bad": w.bad,
            "guarded": w.guarded,
            "exits": w.burr.exits,
            "entries": w.burr.entries,
            "uncut": w.burr.uncut,
            "lowered": w.burr.lowered,
            "feed_length": w.feed_length,
            "time": w.time,
            "unreached": w.unreached.map(|p| self.point(DVec2::from_array(p))),
            "unbeaten": w.unbeaten,
            "path": chains.collect::<Vec<_>>(),
        })
    }

    pub(crate) fn stretch(&self, s: &EdgeStretch) -> Value {
        let ends = [self.as_given(s.edge, s.from), self.as_given(s.edge, s.to)];
        let turned = self.face.plan.left_hand;
        let [from, to] = if turned { [ends[1].1, ends[0].1] } else { [ends[0].1, ends[1].1] };
        let mut value = json!({ "edge": ends[0].0, "from": from, "to": to });
        match s.met {
            Met::Never => value["met"] = json!("never"),
            Met::Lowered { chain } => {
                value["met"] = json!("lowered");
                value["chain"] = json!(chain);
            }
            Met::First { chain, piece, angles: [a, b], exit, weight } => {
                value["met"] = json!(if exit { "exit" } else { "entry" });
                value["chain"] = json!(chain);
                value["piece"] = json!(piece);
                let angles = if turned { [b, a] } else { [a, b] };
                value["exit_angles"] = json!(angles.map(f64::to_degrees));
                value["weight"] = json!(weight);
            }
        }
        value
    }

    /// What the real teeth leave under the way chosen, if that is one straight pass.
    pub(crate) fn teeth_check(&self) -> Value {
        let Some(pass) = self.face.toothed_pass() else { return Value::Null };
        let case = &self.face.plan.case;
        let lengths = |t: ToothedLengths| json!({ "bad": t.bad, "exits": t.exits, "entries": t.entries, "uncrossed": t.uncrossed });
        // A feed at which crossings cannot be counted leaves the limit, which is in `ways`.
        let half = |sweep| toothed_lengths(case, &pass, sweep).ok().map(lengths);
        json!({
            "front": half(Sweep::Front),
            "back": half(Sweep::Back),
            "either_in_the_limit": either_bad_length(case, pass.placement),
        })
    }

    pub(crate) fn event(&self, c: &Crossing) -> Value {
        let (edge, share) = self.as_given(c.edge as usize, c.share);
        json!({
            "tooth": c.tooth,
            "edge": edge,
            "share": share,
            "spindle_turned": deg(c.time),
            "point": self.point(c.point),
            "exit": c.exit,
            "front": c.front,
            "exit_angle": deg(c.exit_angle()),
            "chip_thickness": c.chip_thickness(self.face.feed_per_revolution / self.face.teeth.len().max(1) as f64),
        })
    }
}

pub(crate) fn deg(rad: f64) -> f64 {
    rad.to_degrees()
}

/// A turn in degrees, 0 included and 360 excluded.
pub(crate) fn turn(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU).to_degrees();
    if turned < 360.0 { turned } else { 0.0 }
}
