//! A planned break of an edge: its table in the planner's words, its moves, its wall.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec2;

use super::EdgeOperation;
use super::burrs::{FoundBurrs, lowered_onto};
use super::webs::{Webs, warning};
use crate::base::{Code, Error, Finding, Result};
use crate::contouring::{ContourPlan, ContourSpec, CutPiece, EdgeBreak, OutlinePiece, plan_contour};
use crate::facing::burrs::{BurrPart, BurrPiece, BurrState};
use crate::geom::Outline;
use crate::holes::CutterData;
use crate::operations::band::{Band, Slope};
use crate::operations::kind::Attempt;
use crate::operations::wall::{CLEARANCE, write_told_moves};
use crate::operations::wanted::{Wall, WantedWall};
use crate::operations::{Judged, Pen, Setting, uncut};
use crate::page::trimmed;

/// Distance of the cutter from the edge where it comes down [mm].
const BESIDE: f64 = 0.05;
/// Way beyond the start that is cut twice where the job does not say [mm].
const OVERLAP: f64 = 1.0;
/// Most burrs of a piece that its comment names.
const NAMED: usize = 4;

/// A planned break of an edge.
#[derive(Clone, Debug)]
pub struct PlannedEdge {
    /// The operation.
    pub of: EdgeOperation,
    /// The way of its tip as a contour: that of a cutter whose radius is the distance of the tip from the wall.
    pub spec: ContourSpec,
    /// The plan.
    pub plan: ContourPlan,
    /// The burrs that it takes off, where it goes by them.
    pub(super) burrs: Option<FoundBurrs>,
    /// Whether its setup has operations besides it and the face, which may cut the same edges.
    among_others: bool,
}

/// Plans a break; `make` gives the plan of its kind.
pub(crate) fn planned<P>(
    of: &EdgeOperation,
    setting: &Setting<'_>,
    make: impl FnOnce(PlannedEdge) -> P,
) -> Result<Attempt<P>> {
    let tool = &of.milling.tool;
    let burrs = match &of.edges {
        Some(wanted) => {
            let outer = |l: usize| of.outline.loops().get(l).is_some_and(|l| of.is_wanted(l.outer));
            match FoundBurrs::of(wanted, setting, tool.cutter.diameter(tool.flute_length), outer)? {
                Ok(found) => Some(found),
                Err(note) => return Ok(Attempt::LeftOut(Box::new(note))),
            }
        }
        None => None,
    };
    let pieces = burrs.as_ref().map(|found| {
        let piece = |p: &BurrPiece| OutlinePiece { of_loop: p.of_loop, along: p.along };
        found.pieces.pieces.iter().map(piece).collect()
    });
    let spec = spec(setting, of, pieces);
    let plan = plan_contour(&spec).map_err(|e| in_its_words(e, &spec, &of.cut))?;
    // The planner tells of fillets: a break leaves webs.
    let mut findings = plan.findings.clone();
    findings.retain(|f| f.code != Code::CORNERS_STAY);
    findings.extend(warning(&plan.uncut, &of.cut));
    let planned = PlannedEdge { of: of.clone(), spec, plan, burrs, among_others: setting.others > 1 };
    if let Some(reason) = planned.cuts_nothing() {
        return Ok(Attempt::LeftOut(Box::new(reason)));
    }
    findings.extend(planned.left_warning());
    findings.extend(planned.lowered_warning());
    Ok(Attempt::SetupPlan(make(planned), findings))
}

/// The operation in the planner's words.
fn spec(setting: &Setting<'_>, of: &EdgeOperation, pieces: Option<Vec<OutlinePiece>>) -> ContourSpec {
    let cut = &of.cut;
    let safe = setting.clamping.safe_height;
    let tool = CutterData::of(&of.milling.tool);
    // Beside the edge it comes down in the air, where no tooth has to cut at the centre.
    let cutter =
        CutterData { diameter: 2.0 * cut.offset(), centre_cutting: true, max_ramp_angle: None, ..tool };
    ContourSpec {
        side: of.side,
        loops: of.loops,
        left_hand: of.is_left_hand(),
        sense: of.direction,
        top: of.top,
        stock_to_leave: of.stock_to_leave,
        plunge_feed: of.plunge_feed,
        ramp: None,
        pieces,
        room: Some(cut.top_radius() + of.stock_to_leave + BESIDE),
        lead_radius: of.lead_radius,
        start: of.start.map(DVec2::from_array),
        overlap: Some(of.overlap.unwrap_or(OVERLAP)),
        retract_z: safe,
        approach_z: (of.top + CLEARANCE).clamp(f64::NEG_INFINITY, safe),
        ..ContourSpec::new(of.outline.clone(), cut.depth(), cutter, of.feed)
    }
}

/// An error of the planner with the cures of a break.
fn in_its_words(error: Error, spec: &ContourSpec, cut: &EdgeBreak) -> Error {
    let key = error.0.key.clone().unwrap_or_default();
    match error.code() {
        Code::CUTTER_TOO_LARGE if key == "tool" => {
            let Error(finding) = error;
            let (smaller, key) = match cut {
                EdgeBreak::Chamfer(_) => ("write a smaller tip_clearance", "tip_clearance"),
                EdgeBreak::Ball(_) => ("take a smaller ball", "tool"),
            };
            let help = format!("{smaller}, or leave the loop out: loops = \"outer\", or by layer");
            finding.help(help).key(key).into()
        }
        Code::LEAD_ROOM => {
            let wide = trimmed(2.0 * spec.room.unwrap_or(0.0), 2);
            let Error(finding) = error;
            let smaller = match cut {
                EdgeBreak::Chamfer(_) => "write a smaller tip_clearance or width",
                EdgeBreak::Ball(_) => "take a smaller ball",
            };
            // Pieces have no start.
            let (other, key) = match spec.pieces.is_some() {
                true if key == "start" => ("leave the loop out by `loops`", "tool"),
                true => ("leave the loop out by `loops`", key.as_str()),
                false => ("give another start", key.as_str()),
            };
            let help = format!(
                "the cutter is {wide} mm wide at the edge and comes down beside it: {other}, or {smaller}"
            );
            finding.help(help).key(key).into()
        }
        _ => error,
    }
}

impl PlannedEdge {
    /// Writes its moves, each piece with its comment.
    pub(crate) fn write(&self, pen: &mut Pen<'_>) {
        let mut told: BTreeMap<usize, Vec<String>> = BTreeMap::new();
        if let Some(burrs) = &self.burrs {
            for cut in self.cut_pieces() {
                let parts = burrs.treated(cut);
                let texts = told.entry(cut.first_move).or_default();
                texts.extend(parts.iter().take(NAMED).map(|p| burrs.told(p).to_uppercase()));
                if parts.len() > NAMED {
                    texts.push(format!("AND {} MORE", parts.len() - NAMED));
                }
            }
        }
        let texts = |i: usize| told.get(&i).cloned().unwrap_or_default();
        write_told_moves(pen, &self.plan.moves, self.of.milling.coolant, None, texts);
    }

    /// The pieces that are cut, in their order.
    pub(super) fn cut_pieces(&self) -> impl Iterator<Item = &CutPiece> {
        self.plan.loops.iter().filter_map(|l| l.piece.as_ref())
    }

    /// Chosen burrs that are left.
    pub(super) fn left(&self) -> Vec<BurrPart> {
        self.burrs.as_ref().map_or_else(Vec::new, |found| found.left(self.cut_pieces()))
    }

    /// The reason to leave it out, where its path comes to no edge that it is to break.
    fn cuts_nothing(&self) -> Option<Finding> {
        let help = "nothing is cut, and the operation is left out";
        let (Some(found), Some(wanted)) = (&self.burrs, &self.of.edges) else {
            let what = "the outline has no edge on the loops that `loops` names";
            let none = Finding::warning(Code::JOB_SHAPE, what);
            return self.plan.moves.is_empty().then(|| none.help(help).key("loops"));
        };
        if self.cut_pieces().any(|cut| !found.treated(cut).is_empty()) {
            return None;
        }
        let length: f64 = self.left().iter().map(BurrPart::length).sum();
        let (whose, length) = (found.whose(), trimmed(length, 2));
        let what =
            format!("the cutter comes to none of the edges on which {whose} left burrs: {length} mm stay");
        let help = format!("{help}: take a smaller cutter, or take them off by hand");
        Some(Finding::warning(Code::BURRS, what).help(help).key(wanted.key()))
    }

    /// A warning about edges of the face onto which its cutter was lowered, and which the path does not break.
    fn lowered_warning(&self) -> Option<Finding> {
        let found = self.burrs.as_ref()?;
        let outline = &self.of.outline;
        let is_wanted = |p: &BurrPart| {
            outline.loops().iter().any(|l| l.edges.contains(&p.edge) && self.of.is_wanted(l.outer))
        };
        let others = found.others(BurrState::Lowered, self.cut_pieces());
        let left = others.iter().filter(|(p, run_over)| !run_over && is_wanted(p));
        let length: f64 = left.map(|(p, _)| p.length()).sum();
        (length > 0.0).then(|| {
            let what = format!("{}: {}", found.whose(), lowered_onto(length));
            let help = "they are not treated: look at them, or mill the face from beside the part";
            Finding::warning(Code::BURRS, what).help(help)
        })
    }

    /// A note about chosen burrs that are left.
    fn left_warning(&self) -> Option<Finding> {
        let left = self.left();
        let first = left.first()?;
        let outline = &self.of.outline;
        let edge = &outline.edges()[first.edge];
        let at = edge.at(0.5 * (first.along[0] + first.along[1]) / edge.length());
        let length: f64 = left.iter().map(BurrPart::length).sum();
        let count = uncut::count(left.len(), "stretch", "stretches");
        let message = format!(
            "burrs stay on {count} of {} mm in all: shorter than 0.5 mm, in corners, or on loops that are not cut",
            trimmed(length, 2)
        );
        let help = "the report lists them; take them off by hand, or cut all loops";
        Some(Finding::note(Code::BURRS, message).point([at.x, at.y, self.of.top]).help(help))
    }

    /// The walls that it wants: one for each piece, so that none of them is measured by another.
    pub(crate) fn walls(&self) -> Vec<WantedWall> {
        let (spec, cut) = (&self.spec, &self.of.cut);
        let band = Band::beside(&self.cut_outline(), spec.side, (spec.stock_to_leave, spec.cutter.diameter));
        let slope = Slope {
            top: spec.top,
            width: cut.width(),
            lean: match cut {
                EdgeBreak::Chamfer(chamfer) => chamfer.half_angle.tan(),
                EdgeBreak::Ball(ball) => ball.offset() / ball.top_radius(),
            },
            tip: spec.bottom(),
            ball: match cut {
                EdgeBreak::Chamfer(_) => None,
                EdgeBreak::Ball(ball) => Some(ball.radius),
            },
        };
        let mut band = band.leaning(slope);
        band.corners = uncut::fillets(&self.plan.uncut, spec.radius(), None);
        let wall = |band: Band| WantedWall {
            centre: band.middle,
            top: spec.top,
            floor: None,
            bottom: spec.top - cut.leg(),
            slug: 0.0,
            wall: Wall::Band(Arc::new(band)),
        };
        if self.spec.pieces.is_none() {
            return vec![wall(band)];
        }
        // Pieces are those of the whole outline: `cut_outline` has its loops in their order.
        let wanted = self.of.outline.loops().iter().enumerate().filter(|(_, l)| self.of.is_wanted(l.outer));
        let number: BTreeMap<usize, usize> = wanted.enumerate().map(|(new, (old, _))| (old, new)).collect();
        let piece = |cut: &CutPiece| {
            let on = cut.beside.iter().filter_map(|b| Some((*number.get(&b.of_loop)?, b.along)));
            wall(band.clone().only(on))
        };
        self.cut_pieces().map(piece).collect()
    }

    /// The parts of it that are not compared.
    pub(crate) fn judged(&self, name: &str) -> Judged {
        let webs = self.webs().in_words();
        let mut left = if webs.is_empty() { Vec::new() } else { vec![webs] };
        // The wall of the operation to which it refers is compared there.
        if !self.of.of_other {
            left.push(
                "the wall below it, which is compared where an operation of the job cuts it".to_owned(),
            );
        }
        if self.burrs.is_some() {
            left.push(
                "edges of the face beside its pieces; heights of burrs, which are not simulated".to_owned(),
            );
            if self.among_others {
                let what =
                    "whether operations before or after it cut these edges away, or leave burrs of their own";
                left.push(what.to_owned());
            }
        }
        let unchecked = (!left.is_empty()).then(|| format!("{name}: {}", left.join("; ")));
        Judged { unchecked, ..Judged::default() }
    }

    /// Edges that keep a web.
    pub(super) fn webs(&self) -> Webs {
        Webs::of(&self.plan.uncut)
    }

    /// The loops of the outline whose edges are broken, as an outline.
    fn cut_outline(&self) -> Outline {
        self.of.outline.with_loops(|l| self.of.is_wanted(l.outer))
    }
}
