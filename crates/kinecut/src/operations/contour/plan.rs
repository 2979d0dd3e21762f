//! A planned contour: its table in the planner's words, its moves, its wall.

use std::sync::Arc;

use glam::DVec2;

use super::ContourOperation;
use super::json::ContourJson;
use super::section::section;
use crate::base::{Code, Finding, Result};
use crate::contouring::{ContourFinish, ContourPlan, ContourSide, ContourSpec, plan_contour};
use crate::holes::CutterData;
use crate::operations::band::{Band, TabPlace};
use crate::operations::kind::{self, Attempt, Checked as _};
use crate::operations::uncut;
use crate::operations::wall::{CLEARANCE, write_worn_moves};
use crate::operations::wanted::{Wall, WantedWall};
use crate::operations::{Found, Judged, Pen, PostedPlan, Setting, Shown, WearRegister};
use crate::page::Section;

/// A planned contour.
#[derive(Clone, Debug)]
pub struct PlannedContour {
    /// The operation.
    pub of: Arc<ContourOperation>,
    /// Its contour in the planner's words.
    pub spec: ContourSpec,
    /// The plan.
    pub plan: ContourPlan,
    /// The wear register of the finish.
    wear: Option<WearRegister>,
}

/// Plans a contour.
pub(super) fn planned(of: &Arc<ContourOperation>, setting: &Setting<'_>) -> Result<Attempt<PlannedContour>> {
    let spec = spec(setting, of)?;
    let plan = plan_contour(&spec)?;
    let wear =
        of.table.finish.as_ref().zip(spec.finish.and_then(|f| f.wear)).map(|(t, wear)| t.register(wear));
    let mut findings = plan.findings.clone();
    findings.extend(loose(of, setting, &spec));
    Ok(Attempt::SetupPlan(PlannedContour { of: Arc::clone(of), spec, plan, wear }, findings))
}

/// The operation in the planner's words.
fn spec(setting: &Setting<'_>, of: &ContourOperation) -> Result<ContourSpec> {
    let t = &of.table;
    let wear = t.finish.as_ref().map(|f| f.wear(setting, &of.milling.tool)).transpose()?.flatten();
    let safe = setting.clamping.safe_height;
    Ok(ContourSpec {
        side: t.side,
        loops: t.loops,
        left_hand: of.left_hand(),
        sense: t.direction,
        top: t.top,
        breakthrough: t.breakthrough,
        stock_to_leave: t.stock_to_leave,
        stepdown: t.stepdown,
        feed_at: t.feed_at,
        plunge_feed: of.plunge_feed,
        ramp: of.ramp,
        finish: t.finish.as_ref().map(|f| ContourFinish {
            allowance: f.allowance,
            feed: of.finish_feed,
            stepdown: f.stepdown,
            spring_passes: f.spring_passes,
            wear,
        }),
        lead_radius: t.lead_radius,
        start: t.start.map(DVec2::from_array),
        overlap: t.overlap,
        tabs: of.tabs.clone(),
        retract_z: safe,
        approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, safe),
        ..ContourSpec::new(of.outline.clone(), t.depth, CutterData::of(&of.milling.tool), of.feed)
    })
}

/// A warning where a part, or what is cut out of one, comes loose with the tool beside it.
fn loose(of: &ContourOperation, setting: &Setting<'_>, spec: &ContourSpec) -> Option<Finding> {
    if spec.tabs.is_some() || spec.side == ContourSide::On {
        return None;
    }
    let around = setting.around(&of.milling);
    // Stock that stays beside the contour may be what is held.
    let [from, to] = of.outline.bounds();
    let (low, high) = (around.min.truncate(), around.max.truncate());
    let is_wide = (from - low).max(high - to).max_element() > spec.cutter.diameter;
    let inside = spec.side == ContourSide::Inside || of.outline.loops().iter().any(|l| !l.outer);
    let is_through = setting.is_through(&of.milling, spec.bottom());
    (is_through && (is_wide || inside)).then(|| {
        Finding::warning(Code::SLUG, format!("{}: what it cuts out comes loose", of.name()))
            .help("leave tabs, for example tabs = { width = 4, height = 1 }, or hold it from below")
    })
}

impl kind::Plan for PlannedContour {
    type Json = ContourJson;

    const LIST: &'static str = "contours";

    fn wear(&self) -> Option<WearRegister> {
        self.wear
    }

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        write_worn_moves(pen, &self.plan.moves, &self.of.milling, self.wear, self.spec.keeps_right());
        Ok(())
    }

    fn breakthrough(&self) -> f64 {
        self.of.table.breakthrough
    }

    fn walls(&self) -> Vec<WantedWall> {
        let (spec, t) = (&self.spec, &self.of.table);
        if spec.side == ContourSide::On {
            return Vec::new();
        }
        let outline = self.cut_outline();
        // A wear register moves the wall: positive values leave stock.
        let leave = spec.stock_to_leave + self.wear.map_or(0.0, |w| w.value);
        let mut band = Band::new(&outline, spec.side == ContourSide::Outside, leave, spec.cutter.diameter);
        band.corners = uncut::fillets(&self.plan.uncut, spec.radius());
        band.tabs = self.tabs();
        let through = t.breakthrough > 0.0;
        let floor = spec.top - spec.depth;
        // The wall is cut to size above the cutter's corner.
        band.foot = self.of.corner();
        let bottom = floor + if through { 0.0 } else { band.foot };
        let wall = WantedWall {
            centre: band.middle,
            top: spec.top,
            floor: (!through).then_some(floor),
            bottom,
            slug: 0.0,
            wall: Wall::Band(Arc::new(band)),
        };
        vec![wall]
    }

    fn judge(&mut self, name: &str, _posted: &PostedPlan<'_>, _found: &Found<'_>) -> Judged {
        let unchecked = self.not_looked_at().map(|what| format!("{name}: {what}"));
        Judged { unchecked, ..Judged::default() }
    }

    fn sections(all: &[(&PlannedContour, &Shown<'_>)]) -> Vec<Section> {
        all.iter().map(|(plan, shown)| section(plan, shown)).collect()
    }

    fn json(&self, shown: &Shown<'_>) -> Option<ContourJson> {
        Some(ContourJson::new(self, shown.number))
    }
}

impl PlannedContour {
    /// The loops of the outline that are cut, as an outline.
    fn cut_outline(&self) -> crate::geom::Outline {
        use crate::contouring::ContourLoops;
        let outline = &self.of.outline;
        let wanted = |outer: bool| match self.spec.loops {
            ContourLoops::All => true,
            ContourLoops::Outer => outer,
            ContourLoops::Inner => !outer,
        };
        outline.with_loops(|l| wanted(l.outer))
    }

    /// Parts of the wall that are not compared, in words.
    pub(super) fn not_looked_at(&self) -> Option<String> {
        let tabs = self.tabs();
        let mut parts = uncut::in_words(&self.plan.uncut, self.spec.radius());
        if let Some(longest) = tabs.iter().map(|tab| 2.0 * tab.radius).max_by(f64::total_cmp) {
            // Roughing and finishing have their tabs at one place.
            let tabs = self.plan.loops.iter().filter(|l| !l.finishing).map(|l| l.tabs.len()).sum::<usize>();
            let each = if tabs == 1 { "" } else { " at each" };
            let length = crate::page::trimmed(longest, 1);
            let top = crate::page::trimmed(self.spec.bottom() + self.tab_height(), 2);
            let tabs = uncut::count(tabs, "tab", "tabs");
            parts.push(format!("the wall at {tabs}, over a length of {length} mm{each}, below Z {top}"));
        }
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    /// Height of tabs over the bottom of the cut [mm].
    fn tab_height(&self) -> f64 {
        self.spec.breakthrough + self.spec.tabs.as_ref().map_or(0.0, |t| t.height)
    }

    /// The places of all tabs, and how far they may reach.
    fn tabs(&self) -> Vec<TabPlace> {
        let top = self.spec.bottom() + self.tab_height();
        let loops = self.plan.loops.iter().flat_map(|l| l.tabs.iter().map(|tab| (tab, l.finishing)));
        // The cutter is lifted on this length, comes up and down beside it, and cuts its radius farther.
        loops
            .map(|(tab, finishing)| {
                let slopes = self.spec.slopes(self.tab_height(), finishing && self.wear.is_some());
                let slope = if slopes[0] > slopes[1] { slopes[0] } else { slopes[1] };
                let radius = 0.5 * tab.lifted() + slope + 2.0 * self.spec.radius();
                TabPlace { at: tab.at, radius, top: top + 1e-3 }
            })
            .collect()
    }
}
