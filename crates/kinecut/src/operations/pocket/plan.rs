//! A planned pocket: its table in the planners' words, its moves, its wall.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::PocketOperation;
use super::json::PocketJson;
use super::section::section;
use crate::base::{Code, Finding, Result};
use crate::clearing::{AS_WIDE, PocketPlan, PocketSpec, WALL_STOCK, plan_pocket, plan_slot};
use crate::contouring::{ContourFinish, ContourPlan, ContourSide, ContourSpec, plan_contour};
use crate::geom::{Line, Outline};
use crate::holes::{CutterData, PlannedMove, ToolpathPace, ToolpathRole};
use crate::operations::band::Band;
use crate::operations::kind::{self, Attempt, Checked as _};
use crate::operations::uncut;
use crate::operations::wall::{CLEARANCE, write_worn_moves};
use crate::operations::wanted::{Wall, WantedWall};
use crate::operations::{Found, Judged, MadePlane, Pen, PostedPlan, Setting, Shown, WearRegister};
use crate::page::Section;
use crate::tool::Cutter;

/// A planned pocket.
#[derive(Clone, Debug)]
pub struct PlannedPocket {
    /// The operation.
    pub of: Arc<PocketOperation>,
    /// Its clearing in the planner's words.
    pub spec: PocketSpec,
    /// The plan of the clearing.
    pub clearing: PocketPlan,
    /// The lap along the wall in the planner's words.
    pub lap: ContourSpec,
    /// The plan of the lap.
    pub wall: ContourPlan,
    /// The wear register of the finish.
    wear: Option<WearRegister>,
}

/// Depth of a level where the cutter is wholly in the stock and the job does not say it, in its diameter.
const FULL_STEPDOWN: f64 = 0.5;

/// Plans a pocket.
pub(crate) fn planned(of: &Arc<PocketOperation>, setting: &Setting<'_>) -> Result<Attempt<PlannedPocket>> {
    let (spec, lap) = specs(setting, of)?;
    let (clearing, wall) = match &of.slot {
        None => (plan_pocket(&spec)?, plan_contour(&lap)?),
        Some(slot) => {
            // Passes as wide as the slot have cut its walls.
            let is_cut = slot.width - 2.0 * lap.stock_to_leave <= spec.cutter.diameter + AS_WIDE;
            (plan_slot(&slot.of(&spec))?, if is_cut { ContourPlan::default() } else { plan_contour(&lap)? })
        }
    };
    let wear = of
        .table
        .finish
        .as_ref()
        .zip(lap.finish.and_then(|f| f.wear))
        .map(|(t, wear)| t.register(wear, &of.milling.tool));
    let own = loose(of, setting, &spec);
    let findings = clearing.findings.iter().chain(&wall.findings).cloned().chain(own).collect();
    Ok(Attempt::SetupPlan(PlannedPocket { of: Arc::clone(of), spec, clearing, lap, wall, wear }, findings))
}

/// The operation in the planners' words.
fn specs(setting: &Setting<'_>, of: &PocketOperation) -> Result<(PocketSpec, ContourSpec)> {
    let t = &of.table;
    let wear = t.finish.as_ref().map(|f| f.wear(setting, &of.milling.tool)).transpose()?.flatten();
    let cutter = CutterData::of(&of.milling.tool);
    let retract_z = setting.clamping.safe_height;
    let approach_z = (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, retract_z);
    let bottom = t.top - t.depth - t.breakthrough;
    let spec = PocketSpec {
        stock: over_stock(setting, of)?,
        holes: open_holes(setting, t.top, bottom),
        rest: of.rest,
        left_hand: of.left_hand(),
        sense: t.direction,
        engagement: of.engagement,
        top: t.top,
        breakthrough: t.breakthrough,
        stepdown: t.stepdown,
        allowance: t.stock_to_leave + t.finish.as_ref().map_or(0.0, |f| f.allowance),
        plunge_feed: of.feeds.down,
        link_feed: of.feeds.link,
        ramp: of.helix,
        entry: t.entry.and_then(|e| e.way).unwrap_or_default(),
        helix_radius: t.entry.and_then(|e| e.radius),
        lift: t.lift.unwrap_or(0.2),
        retract_z,
        approach_z,
        ..PocketSpec::new(of.outline.clone(), t.depth, cutter, of.feeds.pass)
    };
    // Passes as wide as the cutter have run in the middle: leads begin there.
    let is_full = of.slot.as_ref().is_some_and(|s| s.of(&spec).around().is_none());
    let spec =
        PocketSpec { stepdown: spec.stepdown.or(is_full.then_some(FULL_STEPDOWN * cutter.diameter)), ..spec };
    let lap = ContourSpec {
        side: ContourSide::Inside,
        left_hand: of.left_hand(),
        sense: t.direction,
        top: t.top,
        breakthrough: t.breakthrough,
        stock_to_leave: t.stock_to_leave,
        stepdown: spec.stepdown,
        feed_at: t.feed_at,
        plunge_feed: of.feeds.down,
        ramp: None,
        cleared: true,
        finish: t.finish.as_ref().map(|f| ContourFinish {
            allowance: if is_full { 0.0 } else { f.allowance + WALL_STOCK },
            feed: of.feeds.finish,
            stepdown: f.stepdown,
            spring_passes: f.spring_passes,
            wear,
            corner_feed: f.corner_feed,
        }),
        onto_wall: t.finish.as_ref().and_then(|f| f.onto_wall(setting)),
        lead_radius: t.lead_radius.or_else(|| of.slot.as_ref()?.lead_radius(&cutter, t.stock_to_leave)),
        retract_z,
        approach_z,
        ..ContourSpec::new(of.outline.clone(), t.depth, cutter, of.feeds.pass)
    };
    Ok((spec, lap))
}

/// The outline of the stock's box where the pocket reaches over it.
fn over_stock(setting: &Setting<'_>, of: &PocketOperation) -> Result<Option<Outline>> {
    let around = setting.around(&of.milling);
    let (low, high) = (around.min.truncate(), around.max.truncate());
    let [min, max] = of.outline.bounds();
    let reaches_over = min.x < low.x || min.y < low.y || max.x > high.x || max.y > high.y;
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    reaches_over.then(|| Outline::polygon(&corners)).transpose()
}

/// A warning where islands come loose with the tool beside them.
fn loose(of: &PocketOperation, setting: &Setting<'_>, spec: &PocketSpec) -> Option<Finding> {
    let islands = of.outline.loops().iter().filter(|l| !l.outer).count();
    (islands > 0 && of.rest.is_none() && setting.is_through(&of.milling, spec.bottom())).then(|| {
        let what = format!("{}: {} comes loose", of.name(), uncut::count(islands, "island", "islands"));
        let what = if islands > 1 { what.replace("comes", "come") } else { what };
        let help = "hold it from below, leave a floor, or cut it out by a contour with tabs";
        Finding::warning(Code::SLUG, what).help(help)
    })
}

/// The round holes that are open from the top down to the bottom of a pocket: centre and radius.
fn open_holes(setting: &Setting<'_>, top: f64, bottom: f64) -> Vec<(DVec2, f64)> {
    let holes = setting.holes().into_iter();
    let open = holes.filter(|h| h.top >= top - 1e-6 && (h.through || h.bottom <= bottom + 1e-6));
    open.map(|h| (h.centre, 0.5 * h.diameter)).collect()
}

impl kind::Plan for PlannedPocket {
    type Json = PocketJson;

    const LIST: &'static str = "pockets";

    fn wear(&self) -> Option<WearRegister> {
        self.wear
    }

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        write_worn_moves(pen, &self.moves(), &self.of.milling, self.wear, self.lap.keeps_right());
        Ok(())
    }

    fn breakthrough(&self) -> f64 {
        self.of.table.breakthrough
    }

    fn walls(&self) -> Vec<WantedWall> {
        let (spec, t) = (&self.lap, &self.of.table);
        // A wear register moves the wall: positive values leave stock.
        let leave = spec.stock_to_leave + self.wear.map_or(0.0, |w| w.value);
        let mut band = Band::inside_of(&self.of.outline, leave);
        band.corners = uncut::fillets(&self.wall.uncut, spec.radius(), self.wear);
        // The wall is cut to size above the cutter's corner.
        band.foot = self.of.corner();
        let through = t.breakthrough > 0.0;
        let floor = spec.top - spec.depth;
        let wall = WantedWall {
            centre: band.middle,
            top: spec.top,
            floor: (!through).then_some(floor),
            bottom: floor + if through { 0.0 } else { band.foot },
            slug: 0.0,
            wall: Wall::Band(Arc::new(band)),
        };
        vec![wall]
    }

    fn made_plane(&self) -> Option<MadePlane> {
        let (spec, cutter) = (&self.lap, &self.of.milling.tool.cutter);
        let is_flat = matches!(cutter, Cutter::EndMill { .. } | Cutter::BullNose { .. });
        if !is_flat || self.of.table.breakthrough > 0.0 {
            return None;
        }
        let leave = spec.stock_to_leave + self.wear.map_or(0.0, |w| w.value.abs());
        let room = [spec.radius(), self.of.corner(), leave];
        Some(MadePlane::floor(self.of.outline.clone(), spec.top - spec.depth, room))
    }

    fn judge(&mut self, name: &str, _posted: &PostedPlan<'_>, _found: &Found<'_>) -> Judged {
        let unchecked = self.not_looked_at().map(|what| format!("{name}: {what}"));
        Judged { unchecked, ..Judged::default() }
    }

    fn sections(all: &[(&PlannedPocket, &Shown<'_>)]) -> Vec<Section> {
        all.iter().map(|(plan, shown)| section(plan, shown)).collect()
    }

    fn json(&self, shown: &Shown<'_>) -> Option<PocketJson> {
        Some(PocketJson::new(self, shown.number))
    }
}

impl PlannedPocket {
    /// All moves: the passes, then the laps along the wall.
    fn moves(&self) -> Vec<PlannedMove> {
        let mut moves = self.clearing.moves.clone();
        let ends = (moves.last().map(|m| m.curve.end()), self.wall.moves.first().map(|m| m.curve.start()));
        if let (Some(start), Some(end)) = ends
            && start.distance(end) > 1e-9
            && let Some(last) = moves.last().cloned()
        {
            let curve = Line { start, end: DVec3::new(end.x, end.y, end.z) }.into();
            moves.push(PlannedMove { role: ToolpathRole::Link, curve, pace: ToolpathPace::Rapid, ..last });
        }
        moves.extend(self.wall.moves.iter().cloned());
        moves
    }

    /// Parts of the wall that are not compared, in words.
    pub(super) fn not_looked_at(&self) -> Option<String> {
        let parts = uncut::in_words(&self.wall.uncut, self.lap.radius());
        (!parts.is_empty()).then(|| parts.join("; "))
    }
}
