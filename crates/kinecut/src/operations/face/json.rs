//! A planned face as JSON, in the units of the shop: mm, degrees, s, mm/min. Everything is as the part lies, also
//! under an M4 spindle; edges and loops have their numbers in the outline as given, from 0.

use glam::DVec2;
use serde::Serialize;

use super::PlannedFace;
use crate::base::Finding;
use crate::base::unit::turn_in_degrees;
use crate::facing::optimum::{Irreducible, LocalMinimum, Optimum};
use crate::facing::passes::{EdgeStretch, Met};
use crate::facing::{
    MillingWay, Placement, Sweep, Tooth, ToothCrossing, ToothedLengths, bad_length, either_bad_length,
    toothed_lengths,
};
use crate::geom::OutlineEdge;

/// A plan; the fields of all tables are in the order of their names.
#[derive(Debug, Serialize)]
pub(crate) struct FaceJson {
    as_drawn: Option<AsDrawn>,
    bad_exit_angles: Vec<BadAngles>,
    chosen: usize,
    coordinates_turned: f64,
    cutter: CutterJson,
    guard: f64,
    levels: Vec<f64>,
    margin: f64,
    optimum: OptimumOrWhy,
    outline: OutlineJson,
    part_turned: f64,
    rule: String,
    stretches: Vec<StretchJson>,
    teeth_check: Option<TeethCheck>,
    ways: Vec<WayJson>,
}

#[derive(Debug, Serialize)]
struct AsDrawn {
    bad: f64,
    guarded: f64,
    placement: Placement,
}

#[derive(Debug, Serialize)]
struct BadAngles {
    from: f64,
    to: f64,
    weight: f64,
}

#[derive(Debug, Serialize)]
struct CutterJson {
    feed: f64,
    feed_per_revolution: f64,
    feed_per_tooth: f64,
    left_hand: bool,
    radius: f64,
    spindle_speed: f64,
    teeth: Vec<Tooth>,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum OptimumOrWhy {
    Optimum(Box<OptimumJson>),
    Why { error: Box<Finding> },
}

#[derive(Debug, Serialize)]
struct OptimumJson {
    alternatives: Vec<LocalMinimum>,
    complete: bool,
    gap: f64,
    irreducible: Vec<Irreducible>,
    lower_bound: f64,
    nodes: usize,
    placement: Placement,
    sensitivity: SensitivityJson,
    value: f64,
}

#[derive(Debug, Serialize)]
struct SensitivityJson {
    feed_parallel: Vec<usize>,
    offset_error: f64,
    turn_error: f64,
    worst: f64,
    worst_at: Placement,
}

#[derive(Debug, Serialize)]
struct OutlineJson {
    area: f64,
    edges: Vec<EdgeJson>,
    loops: Vec<Loop>,
    max: [f64; 2],
    min: [f64; 2],
    notes: Vec<String>,
    perimeter: f64,
}

#[derive(Debug, Serialize)]
struct EdgeJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    centre: Option<[f64; 2]>,
    end: [f64; 2],
    label: Option<String>,
    length: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    radius: Option<f64>,
    start: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    sweep: Option<f64>,
    weight: f64,
}

#[derive(Debug, Serialize)]
struct Loop {
    count: usize,
    first: usize,
    outer: bool,
}

#[derive(Debug, Serialize)]
struct WayJson {
    bad: f64,
    entries: f64,
    exits: f64,
    feed_length: f64,
    guarded: f64,
    lowered: f64,
    name: String,
    offset: Option<f64>,
    path: Vec<Vec<FacePieceJson>>,
    time: f64,
    turn: Option<f64>,
    unbeaten: bool,
    uncut: f64,
    unreached: Option<[f64; 2]>,
}

#[derive(Debug, Serialize)]
struct FacePieceJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    centre: Option<[f64; 2]>,
    end: [f64; 2],
    start: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    sweep: Option<f64>,
}

#[derive(Debug, Default, Serialize)]
struct StretchJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    chain: Option<usize>,
    edge: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    exit_angles: Option<[f64; 2]>,
    from: f64,
    met: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    piece: Option<usize>,
    to: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    weight: Option<f64>,
}

/// Lengths that the real teeth leave under the way chosen, if that is one straight pass.
#[derive(Debug, Serialize)]
struct TeethCheck {
    back: Option<ToothedLengths>,
    either_in_the_limit: f64,
    front: Option<ToothedLengths>,
}

/// A crossing of a tooth.
#[derive(Debug, Serialize)]
pub(crate) struct Event {
    chip_thickness: f64,
    edge: usize,
    exit: bool,
    exit_angle: f64,
    front: bool,
    point: [f64; 2],
    share: f64,
    spindle_turned: f64,
    tooth: u32,
}

impl PlannedFace {
    /// The plan as JSON.
    pub(crate) fn plan_json(&self) -> FaceJson {
        let (plan, operation) = (&self.plan, &self.of);
        let bad = operation.case.bad.parts().iter();
        let bad = bad.map(|p| BadAngles { from: deg(p.from), to: deg(p.to), weight: p.weight });
        FaceJson {
            as_drawn: plan.as_drawn.map(|p| AsDrawn {
                bad: bad_length(&plan.case, p),
                guarded: bad_length(&plan.guarded, p),
                placement: self.seen(p),
            }),
            bad_exit_angles: bad.collect(),
            chosen: plan.chosen,
            coordinates_turned: deg(self.coordinates_turned),
            cutter: self.cutter_json(),
            guard: deg(operation.guard),
            levels: operation.levels.clone(),
            margin: operation.margin,
            optimum: match &plan.optimum {
                Ok(optimum) => OptimumOrWhy::Optimum(Box::new(self.optimum_json(optimum))),
                Err(finding) => OptimumOrWhy::Why { error: Box::new(finding.clone()) },
            },
            outline: self.outline_json(),
            part_turned: deg(self.part_turned),
            rule: operation.rule.clone(),
            stretches: self.chosen().burr.stretches.iter().map(|s| self.stretch_json(s)).collect(),
            teeth_check: self.teeth_check(),
            ways: plan.ways.iter().map(|w| self.way_json(w)).collect(),
        }
    }

    /// A placement as the part lies.
    pub(crate) fn seen(&self, p: Placement) -> Placement {
        if self.plan.left_hand { p.mirrored() } else { p }
    }

    fn point_json(&self, p: DVec2) -> [f64; 2] {
        if self.plan.left_hand { [p.x, 0.0 - p.y] } else { p.to_array() }
    }

    fn outline_json(&self) -> OutlineJson {
        let case = &self.of.case;
        let outline = &case.outline;
        let edge = |(i, e): (usize, &OutlineEdge)| EdgeJson {
            centre: e.turn.map(|t| t.centre.to_array()),
            end: e.end.to_array(),
            label: outline.label(i).map(str::to_owned),
            length: e.length(),
            radius: e.turn.map(|t| t.radius),
            start: e.start.to_array(),
            sweep: e.turn.map(|t| deg(t.sweep)),
            weight: case.weights[i],
        };
        let loops = outline.loops().iter();
        let loops = loops.map(|l| Loop { count: l.edges.len(), first: l.edges.start, outer: l.outer });
        let [min, max] = outline.bounds();
        OutlineJson {
            area: outline.area(),
            edges: outline.edges().iter().enumerate().map(edge).collect(),
            loops: loops.collect(),
            max: max.to_array(),
            min: min.to_array(),
            notes: self.of.notes.clone(),
            perimeter: outline.perimeter(),
        }
    }

    fn feed_per_tooth(&self) -> f64 {
        self.feed_per_revolution / self.teeth.len().max(1) as f64
    }

    fn cutter_json(&self) -> CutterJson {
        CutterJson {
            feed: self.of.feed * 60.0,
            feed_per_revolution: self.feed_per_revolution,
            feed_per_tooth: self.feed_per_tooth(),
            left_hand: self.plan.left_hand,
            radius: self.of.case.radius,
            spindle_speed: 60.0 * self.of.feed / self.feed_per_revolution,
            teeth: self.teeth.clone(),
        }
    }

    fn optimum_json(&self, o: &Optimum) -> OptimumJson {
        let [angle, offset_error] = super::plan::options(&self.of, false).set_up_error;
        let alternatives = o.alternatives.iter();
        let alternatives = alternatives.map(|a| LocalMinimum { placement: self.seen(a.placement), ..*a });
        OptimumJson {
            alternatives: alternatives.collect(),
            complete: o.complete,
            gap: o.gap(),
            irreducible: o.irreducible.clone(),
            lower_bound: o.lower_bound,
            nodes: o.nodes,
            placement: self.seen(o.placement),
            sensitivity: SensitivityJson {
                feed_parallel: o
                    .sensitivity
                    .feed_parallel
                    .iter()
                    .map(|&e| self.as_planned(e, 0.0).0)
                    .collect(),
                offset_error,
                turn_error: deg(angle),
                worst: o.sensitivity.worst,
                worst_at: self.seen(o.sensitivity.worst_at),
            },
            value: o.value,
        }
    }

    fn way_json(&self, w: &MillingWay) -> WayJson {
        let left = self.plan.left_hand;
        let path = if left { w.path.mirrored() } else { w.path.clone() };
        let piece = |e: &OutlineEdge| FacePieceJson {
            centre: e.turn.map(|t| t.centre.to_array()),
            end: e.end.to_array(),
            start: e.start.to_array(),
            sweep: e.turn.map(|t| deg(t.sweep)),
        };
        let seen = |v: f64| if left { -v } else { v };
        WayJson {
            bad: w.bad,
            entries: w.burr.entries,
            exits: w.burr.exits,
            feed_length: w.feed_length,
            guarded: w.guarded,
            lowered: w.burr.lowered,
            name: w.name.clone(),
            offset: w.offset.map(seen),
            path: path.chains.iter().map(|c| c.iter().map(piece).collect()).collect(),
            time: w.time,
            turn: w.angle.map(|a| turn_in_degrees(seen(a))),
            unbeaten: w.unbeaten,
            uncut: w.burr.uncut,
            unreached: w.unreached.map(|p| self.point_json(DVec2::from_array(p))),
        }
    }

    /// An edge of the plan and a share of its length are those of the outline as given: to mirror twice is to mirror not at
    /// all.
    fn stretch_json(&self, s: &EdgeStretch) -> StretchJson {
        let ends = [self.as_planned(s.edge, s.from), self.as_planned(s.edge, s.to)];
        let turned = self.plan.left_hand;
        let [from, to] = if turned { [ends[1].1, ends[0].1] } else { [ends[0].1, ends[1].1] };
        let stretch = StretchJson { edge: ends[0].0, from, to, ..StretchJson::default() };
        match s.met {
            Met::Never => StretchJson { met: "never", ..stretch },
            Met::Lowered { chain } => StretchJson { met: "lowered", chain: Some(chain), ..stretch },
            Met::First { chain, piece, angles: [a, b], exit, weight } => StretchJson {
                met: if exit { "exit" } else { "entry" },
                chain: Some(chain),
                piece: Some(piece),
                exit_angles: Some(if turned { [b, a] } else { [a, b] }.map(f64::to_degrees)),
                weight: Some(weight),
                ..stretch
            },
        }
    }

    fn teeth_check(&self) -> Option<TeethCheck> {
        let pass = self.toothed_pass()?;
        let case = &self.plan.case;
        // A feed at which crossings cannot be counted leaves the limit, which is in `ways`.
        let half = |sweep| toothed_lengths(case, &pass, sweep).ok();
        Some(TeethCheck {
            back: half(Sweep::Back),
            either_in_the_limit: either_bad_length(case, pass.placement),
            front: half(Sweep::Front),
        })
    }

    /// A crossing as JSON.
    pub(crate) fn event_json(&self, c: &ToothCrossing) -> Event {
        let (edge, share) = self.as_planned(c.edge as usize, c.share);
        Event {
            chip_thickness: c.chip_thickness(self.feed_per_tooth()),
            edge,
            exit: c.exit,
            exit_angle: deg(c.exit_angle()),
            front: c.front,
            point: self.point_json(c.point),
            share,
            spindle_turned: deg(c.time),
            tooth: c.tooth,
        }
    }
}

fn deg(rad: f64) -> f64 {
    rad.to_degrees()
}
