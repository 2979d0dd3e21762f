//! A planned contour: its table in the planner's words, its moves, its wall.

use std::sync::Arc;

use glam::DVec2;

use super::ContourOperation;
use super::json::ContourJson;
use super::line::LongerLines;
use super::section::section;
use crate::base::bounded::{MAX_LENGTH, positive};
use crate::base::{Code, Finding, Result};
use crate::contouring::{ContourFinish, ContourPlan, ContourSide, ContourSpec, plan_contour};
use crate::geom::NearestEdge;
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
    let wear = of
        .table
        .finish
        .as_ref()
        .zip(spec.finish.and_then(|f| f.wear))
        .map(|(t, wear)| t.register(wear, &of.milling.tool));
    let mut findings = plan.findings.clone();
    findings.extend(loose(of, setting, &spec));
    Ok(Attempt::SetupPlan(PlannedContour { of: Arc::clone(of), spec, plan, wear }, findings))
}

/// The operation in the planner's words.
fn spec(setting: &Setting<'_>, of: &ContourOperation) -> Result<ContourSpec> {
    let t = &of.table;
    let wear = t.finish.as_ref().map(|f| f.wear(setting, &of.milling.tool)).transpose()?.flatten();
    let safe = setting.clamping.safe_height;
    let usual = ContourSpec::new(of.outline.clone(), t.depth, CutterData::of(&of.milling.tool), of.feed);
    let usual = match of.outline.is_of_lines() {
        true => {
            let lead = t.lead_radius.unwrap_or_else(|| usual.usual_lead());
            let longer = of.longer_lines(&setting.around(&of.milling), lead)?;
            let LongerLines { outline, extended, clear_ends } = longer;
            ContourSpec { outline, extended, clear_ends, ..usual }
        }
        false => usual,
    };
    // Beside the stock the cutter comes straight down.
    let ramp = if usual.clear_ends && t.entry.is_none() { None } else { of.ramp };
    Ok(ContourSpec {
        side: t.side,
        loops: t.loops,
        left_hand: of.left_hand(),
        sense: t.direction,
        top: t.top,
        breakthrough: t.breakthrough,
        stock_to_leave: t.stock_to_leave,
        stepdown: t.stepdown,
        loops_beside: loops_beside(setting, of)?,
        feed_at: t.feed_at,
        plunge_feed: of.plunge_feed,
        ramp,
        finish: t.finish.as_ref().map(|f| ContourFinish {
            allowance: f.allowance,
            feed: of.finish_feed,
            stepdown: f.stepdown,
            spring_passes: f.spring_passes,
            wear,
            corner_feed: f.corner_feed,
        }),
        onto_wall: t.finish.as_ref().and_then(|f| f.onto_wall(setting)),
        lead_radius: t.lead_radius,
        start: t.start.map(DVec2::from_array),
        overlap: t.overlap,
        tabs: of.tabs.clone(),
        retract_z: safe,
        approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, safe),
        ..usual
    })
}

/// The loops of roughing beside one another: as many as are given, or as the stock outside of the contour needs.
fn loops_beside(setting: &Setting<'_>, of: &ContourOperation) -> Result<Option<(u32, f64)>> {
    /// Most loops that are reckoned.
    const MOST: f64 = 1000.0;
    let t = &of.table;
    let refuse = |key: &str, what: &str, help: &str| {
        Err(Finding::error(Code::JOB_SHAPE, what).help(help).key(key).into())
    };
    let step = match (t.stepover, t.passes) {
        (None, None) => return Ok(None),
        (None, Some(_)) => {
            let help = "write the distance of the loops too, for example stepover = 4";
            return refuse("passes", "loops beside one another need their distance", help);
        }
        (Some(step), Some(passes)) => return Ok(Some((passes, step))),
        (Some(step), None) => positive("stepover", step, MAX_LENGTH, "mm")?,
    };
    if matches!(t.side, ContourSide::Inside | ContourSide::On) {
        let help = "write passes = 2, for example; or use a pocket, which clears all of the inside";
        return refuse("passes", "the number of loops inside of a contour is not given", help);
    }
    // As far out as the corner of the stock that is farthest from the contour.
    let around = setting.around(&of.milling);
    let near = NearestEdge::of(&of.outline);
    let corners = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| {
        let (x, y) = ([around.min.x, around.max.x][i], [around.min.y, around.max.y][j]);
        near.at(DVec2::new(x, y), f64::INFINITY).map_or(0.0, |n| n.distance)
    });
    let farthest = corners.into_iter().fold(0.0, f64::max);
    let beside = t.stock_to_leave + t.finish.as_ref().map_or(0.0, |f| f.allowance);
    let passes = 1.0 + ((farthest - beside - 2.0 * of.radius()) / step).ceil().max(0.0);
    if passes > MOST {
        let finding =
            Finding::error(Code::JOB_VALUE, "the stock beside the contour needs more loops than are made");
        return Err(finding
            .value(passes, "")
            .bound(MOST, "")
            .help("write a larger stepover, or passes")
            .key("stepover")
            .into());
    }
    Ok(Some((passes as u32, step)))
}

/// A warning where a part, or what is cut out of one, comes loose with the tool beside it.
fn loose(of: &ContourOperation, setting: &Setting<'_>, spec: &ContourSpec) -> Option<Finding> {
    if spec.tabs.is_some() || spec.side == ContourSide::On || of.outline.is_of_lines() {
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

    fn wants_nothing(&self) -> bool {
        self.spec.side == ContourSide::On
    }

    fn walls(&self) -> Vec<WantedWall> {
        let (spec, t) = (&self.spec, &self.of.table);
        if spec.side == ContourSide::On {
            return Vec::new();
        }
        // A wear register moves the wall: positive values leave stock.
        let leave = spec.stock_to_leave + self.wear.map_or(0.0, |w| w.value);
        let mut band = Band::beside(&self.cut_outline(), spec.side, (leave, spec.cutter.diameter));
        band.corners = uncut::fillets(&self.plan.uncut, spec.radius(), self.wear);
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
            let tabs = self
                .plan
                .loops
                .iter()
                .filter(|l| !l.finishing && l.farther == 0.0)
                .map(|l| l.tabs.len())
                .sum::<usize>();
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
        let beside = self.plan.loops.iter().filter(|l| l.farther == 0.0);
        let loops = beside.flat_map(|l| l.tabs.iter().map(|tab| (tab, l.finishing)));
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
