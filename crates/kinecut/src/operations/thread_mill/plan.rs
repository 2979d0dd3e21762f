//! Planned milled threads: their moves, the wall of their crests, and what they say of themselves.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::ops::Range;
use std::sync::Arc;

use glam::DVec2;

use super::ThreadMillOperation;
use super::core::core;
use super::json::MilledThreadsJson;
use super::prove;
use super::section::section;
use crate::base::{Code, Finding, Result};
use crate::geom::{Outline, OutlineEdge};
use crate::holes::Wear;
use crate::operations::band::Band;
use crate::operations::core_hole::Core;
use crate::operations::kind::{self, Attempt, Checked as _};
use crate::operations::measured::Proof;
use crate::operations::wall::{CLEARANCE, WearKeys, write_worn_moves};
use crate::operations::wanted::{Wall, WantedWall};
use crate::operations::{Found, Judged, Pen, PostedPlan, RoundHole, Setting, Shown, Tally, WearRegister};
use crate::page::Section;
use crate::threading::{ThreadCutter, ThreadMillSpec, ThreadPlan, ThreadSide, plan_threads};

/// Largest wear of the register where the job does not say it [mm].
const USUAL_WEAR: f64 = 0.05;

/// Planned milled threads.
#[derive(Clone, Debug)]
pub struct PlannedThreadMilling {
    /// The operation.
    pub of: Arc<ThreadMillOperation>,
    /// In the planner's words.
    pub spec: ThreadMillSpec,
    /// The plan.
    pub plan: ThreadPlan,
    /// The core hole at each place, where it is known.
    pub cores: Vec<Option<Core>>,
    /// The items of the program.
    pub(super) items: Range<u32>,
    /// Largest deviation of the pitch diameter in the text [mm], once it was read.
    pub(super) deviation: Option<f64>,
}

/// Plans the threads.
///
/// # Errors
/// Those of the planner, and of the first core hole which the tool does not fit.
pub(super) fn planned(
    of: &Arc<ThreadMillOperation>,
    setting: &Setting<'_>,
) -> Result<Attempt<PlannedThreadMilling>> {
    let spec = spec(of, setting)?;
    let above = spec.retract_z > spec.top;
    if !above {
        let what = "the moves between threads run below the start of the thread";
        let finding = Finding::error(Code::JOB_VALUE, what).value_mm(spec.retract_z).bound_mm(spec.top);
        let help = "raise `clearance` above `top`, or the safe height of the setup";
        return Err(finding.help(help).key("clearance").into());
    }
    let plan = plan_threads(&spec).map_err(|mut e| {
        if of.table.points.is_none() && e.0.key.as_deref() == Some("points") {
            e.0.key = Some("pattern".to_owned());
        }
        // Diameter and pitch were said by the size.
        if of.table.size.is_some() && matches!(e.0.key.as_deref(), Some("diameter" | "pitch")) {
            e.0.key = Some("size".to_owned());
        }
        e
    })?;
    let mut findings = plan.findings.clone();
    let mut cores = vec![None; spec.places.len()];
    if spec.side == ThreadSide::Inside {
        let there = setting.holes();
        let mut doubts = Vec::new();
        for (i, place) in of.places.iter().enumerate() {
            let key = if of.table.points.is_some() { format!("points[{i}]") } else { "pattern".to_owned() };
            let (core, doubt) = core(of, &spec, place.at, &there).map_err(|e| e.under(&key))?;
            cores[i] = core;
            // Holes alike have one doubt.
            if doubts.is_empty() {
                doubts.extend(doubt.map(|f| f.key(key)));
            }
        }
        findings.extend(doubts);
    }
    let planned =
        PlannedThreadMilling { of: Arc::clone(of), spec, plan, cores, items: 0..0, deviation: None };
    Ok(Attempt::SetupPlan(planned, findings))
}

/// The operation in the planner's words.
fn spec(of: &ThreadMillOperation, setting: &Setting<'_>) -> Result<ThreadMillSpec> {
    let t = &of.table;
    let retract_z = t.clearance.unwrap_or(setting.clamping.safe_height);
    Ok(ThreadMillSpec {
        oversize: t.oversize,
        side: t.side,
        left_hand: of.is_left_hand(),
        sense: t.direction,
        top: t.top,
        infeed: t.infeed.clone().unwrap_or_else(|| vec![1.0]),
        spring_passes: t.spring_passes,
        wear: wear(of, setting)?,
        places: of.places.iter().map(|p| DVec2::from_array(p.at)).collect(),
        retract_z,
        approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, retract_z),
        ..ThreadMillSpec::new(
            of.thread,
            of.depth,
            ThreadCutter::of(&of.milling.tool, of.mill, t.profile),
            of.feed,
        )
    })
}

/// The wear register, read and checked.
fn wear(of: &ThreadMillOperation, setting: &Setting<'_>) -> Result<Option<Wear>> {
    let t = &of.table;
    let keys = WearKeys {
        register: t.wear_offset.as_deref(),
        largest: t.wear_largest,
        value: t.wear_value,
        full: false,
    };
    let wear = keys.wear(USUAL_WEAR)?;
    keys.check(setting, of.milling.tool.number, wear)?;
    Ok(wear)
}

impl PlannedThreadMilling {
    /// Value of the wear register with which the program is simulated [mm]: positive leaves stock.
    pub(super) fn wear_value(&self) -> f64 {
        self.wear_of_table().map_or(0.0, |w| w.value)
    }

    fn wear_of_table(&self) -> Option<WearRegister> {
        let value = self.of.table.wear_value.unwrap_or(0.0);
        self.spec.wear.map(|w| WearRegister { number: w.register, value, radius: 0.0 })
    }

    /// Radius of the wall that the crests leave [mm].
    pub(super) fn crest_radius(&self) -> f64 {
        let (centre, tool) = (self.plan.radii[1], 0.5 * self.spec.cutter.mill.diameter);
        match self.spec.side {
            ThreadSide::Inside => centre + tool - self.wear_value(),
            ThreadSide::Outside => centre - tool + self.wear_value(),
        }
    }

    /// Whether the wall of the crests is one that can be measured: a cylinder.
    fn has_wall(&self) -> bool {
        self.spec.thread.taper == 0.0
    }

    /// Heights of the wall of the crests that is measured: where it is all round, since in its first turn the lowest tooth rises by a
    /// pitch; `None` where that is nothing.
    fn wall_heights(&self) -> Option<[f64; 2]> {
        let [top, bottom] = [self.spec.top, self.spec.top - self.spec.depth + 0.5 * self.spec.thread.pitch];
        (bottom < top).then_some([top, bottom])
    }

    /// Why the wall of the crests is not measured, if it is not.
    fn unmeasured(&self) -> Option<&'static str> {
        if !self.has_wall() {
            Some("in the simulated part, which is a cone of steps")
        } else if self.wall_heights().is_none() {
            Some(
                "in the simulated part: the thread is at most half a pitch deep, nowhere with crests all round",
            )
        } else {
            None
        }
    }

    /// The wall of the crests at a place.
    fn wall(&self, centre: DVec2) -> Option<WantedWall> {
        let (spec, radius) = (&self.spec, self.crest_radius());
        let [top, bottom] = self.wall_heights()?;
        let (wall, centre) = match spec.side {
            ThreadSide::Inside => (Wall::Round { radii: [radius; 2], heights: [top, bottom] }, centre),
            ThreadSide::Outside => {
                let circle = OutlineEdge::arc(centre, radius, -FRAC_PI_2, TAU);
                let outline = Outline::new(vec![vec![circle]], Vec::new()).ok()?;
                let band = Band::new(&outline, true, 0.0, spec.cutter.mill.diameter);
                let middle = band.middle;
                (Wall::Band(Arc::new(band)), middle)
            }
        };
        Some(WantedWall { centre, wall, top, floor: None, bottom, slug: 0.0 })
    }
}

impl kind::Plan for PlannedThreadMilling {
    type Json = MilledThreadsJson;

    const LIST: &'static str = "milled_threads";

    fn wear(&self) -> Option<WearRegister> {
        self.wear_of_table()
    }

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        let wear = self.wear_of_table();
        // The material that stays lies outside of a way round in a hole, and inside of one about a boss.
        let inside = self.spec.side == ThreadSide::Inside;
        let keeps_right = self.plan.travel.counter_clockwise == inside;
        let from = pen.program.items.len() as u32;
        write_worn_moves(pen, &self.plan.moves, &self.of.milling, wear, keeps_right);
        self.items = from..pen.program.items.len() as u32;
        Ok(())
    }

    /// The lowest tooth runs out of a hole that is open below.
    fn breakthrough(&self) -> f64 {
        let open = self.spec.side == ThreadSide::Outside || self.cores.iter().flatten().any(|c| c.through);
        let below = self.spec.top - self.spec.depth - self.spec.lowest();
        if open { below } else { 0.0 }
    }

    fn walls(&self) -> Vec<WantedWall> {
        if !self.has_wall() {
            return Vec::new();
        }
        self.spec.places.iter().filter_map(|at| self.wall(*at)).collect()
    }

    /// The core hole is there as before.
    fn holes(&self) -> Vec<RoundHole> {
        Vec::new()
    }

    fn judge(&mut self, name: &str, posted: &PostedPlan<'_>, _found: &Found<'_>) -> Judged {
        let (mut judged, deviation) = prove::judged(self, posted);
        self.deviation = deviation;
        judged.unchecked = self.unmeasured().map(|why| format!("{name}: the wall of the crests {why}"));
        judged
    }

    fn sum_up(tallies: &[Tally], _step: f64) -> (Option<Proof>, Option<String>) {
        prove::sum_up(tallies)
    }

    fn sections(all: &[(&PlannedThreadMilling, &Shown<'_>)]) -> Vec<Section> {
        all.iter().map(|(plan, shown)| section(plan, shown)).collect()
    }

    fn json(&self, shown: &Shown<'_>) -> Option<MilledThreadsJson> {
        Some(MilledThreadsJson::new(self, shown.number))
    }
}
