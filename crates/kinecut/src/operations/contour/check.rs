//! Contours, checked: the outline read and placed, speeds and feeds, the tool.

use std::sync::Arc;

use super::plan::{PlannedContour, planned};
use super::{ContourEntry, ContourTable, TabsTable};
use crate::base::bounded::{MAX_LENGTH, length, positive};
use crate::base::{Code, Finding, Result};
use crate::contouring::{ContourSide, Tabs};
use crate::cutting::{MillingCut, StartCut};
use crate::geom::{MeshEdge, Outline};
use crate::holes::CutterData;
use crate::operations::kind::{self, Attempt};
use crate::operations::named::NamedOutline;
use crate::operations::outlines::{OutlineEntry, OutlineKeys, outline_keys};
use crate::operations::{
    Around, CalledTool, CuttingKeys, FeedKeys, Milling, PlaneTable, Setting, feed_of, milling_of, spindle,
    tool_of, whole_revolutions,
};
use crate::tool::{Cutter, Hand};

/// Ramp where neither the job nor the tool says one [rad].
const USUAL_RAMP: f64 = 3.0 / 180.0 * std::f64::consts::PI;
/// Share of the feed at which the cutter goes down where the job does not say.
const DOWN: f64 = 0.5;
/// Length of contour for one tab where the job does not say their number [mm].
const TAB_EVERY: f64 = 150.0;
/// Most tabs of a loop.
const MOST_TABS: u32 = 1000;

/// Milling along a contour.
#[derive(Clone, Debug)]
pub struct ContourOperation {
    /// As written.
    pub table: ContourTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
    /// The outline in coordinates of the work offset.
    pub outline: Outline,
    /// Notes of the outline's reader.
    pub notes: Vec<String>,
    /// Feed along the contour [mm/s].
    pub feed: f64,
    /// Feed down [mm/s].
    pub plunge_feed: f64,
    /// Feed of finishing [mm/s].
    pub finish_feed: f64,
    /// Angle of the ramp [rad]; `None`: straight down.
    pub ramp: Option<f64>,
    /// Tabs.
    pub tabs: Option<Tabs>,
}

impl ContourOperation {
    /// Radius of the tool's corner [mm]: a wall is cut to size above it.
    pub(super) fn corner(&self) -> f64 {
        match self.milling.tool.cutter {
            Cutter::BullNose { corner_radius, .. } => corner_radius,
            _ => 0.0,
        }
    }

    /// Radius of the tool [mm].
    pub(super) fn radius(&self) -> f64 {
        0.5 * CutterData::of(&self.milling.tool).diameter
    }

    /// Whether the spindle turns counter-clockwise.
    pub(super) fn left_hand(&self) -> bool {
        self.milling.tool.limits.hand == Hand::Left
    }
}

impl kind::Checked for ContourOperation {
    type Plan = PlannedContour;

    const NOUN: &'static str = "contour";

    fn milling(&self) -> &Milling {
        &self.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut self.milling
    }

    fn finishing(&self) -> Option<MillingCut> {
        let finish = self.table.finish.as_ref().filter(|_| self.table.side != ContourSide::On)?;
        let depth = self.table.depth + self.table.breakthrough;
        Some(self.milling.beside_wall(finish.allowance, self.finish_feed, [finish.stepdown, Some(depth)]))
    }

    fn spring_passes(&self) -> u32 {
        self.table.finish.as_ref().map_or(0, |f| f.spring_passes)
    }

    fn name(&self) -> String {
        let [min, max] = self.outline.bounds();
        let size = max - min;
        let side = match self.table.side {
            ContourSide::Outside => "outside",
            ContourSide::Inside => "inside",
            ContourSide::On => "on",
            ContourSide::Left => "left of",
            ContourSide::Right => "right of",
        };
        let side = if self.outline.is_of_lines() { format!("{side} line") } else { side.to_owned() };
        let shown = |mm: f64| crate::page::trimmed(mm, 2);
        format!("contour {side} {} x {}", shown(size.x), shown(size.y))
    }

    fn is_left_hand(&self) -> bool {
        self.left_hand()
    }

    fn not_compared(&self) -> Option<&'static str> {
        (self.table.side == ContourSide::On).then_some("the groove that a contour on a line makes")
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedContour>> {
        planned(self, setting)
    }
}

impl kind::Table for ContourTable {
    type Of = ContourOperation;

    fn check(&self, around: &Around<'_>) -> Result<ContourOperation> {
        operation(self, around)
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn data(&mut self) -> Option<CuttingKeys<'_>> {
        let feed = Some(FeedKeys { feed: &mut self.feed, per_tooth: &mut self.feed_per_tooth });
        Some(CuttingKeys {
            speed: &mut self.speed,
            cutting_speed: &mut self.cutting_speed,
            feed,
            per_rev: None,
            cut: StartCut::Slot,
        })
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }

    fn named_outline(&self) -> Option<NamedOutline<'_>> {
        let (side, loops) = (self.side, self.loops);
        let (top, stock_to_leave, plane) = (self.top, self.stock_to_leave, self.plane());
        self.name.as_deref().map(|name| NamedOutline {
            name,
            keys: self.outline_keys(),
            side,
            loops,
            top,
            stock_to_leave,
            plane,
            from_edge: [false; 2],
            has_wall: side != ContourSide::On,
        })
    }

    fn file(&self) -> Option<(&'static str, &str)> {
        match &self.outline {
            Some(OutlineEntry::Name(name)) => Some(("outline", name)),
            _ => None,
        }
    }
}

impl ContourTable {
    /// The keys that say its outline.
    fn outline_keys(&self) -> OutlineKeys<'_> {
        OutlineKeys { polyline: self.polyline.as_deref(), ..outline_keys!(self) }
    }
}

/// Checks that a cutter beside an edge of a mesh does not run in its material; on the edge it may.
fn beside_material(edge: &MeshEdge, side: ContourSide) -> Result<()> {
    let (own, place, word) = match edge.material_inside {
        true => (ContourSide::Outside, "within", "outside"),
        false => (ContourSide::Inside, "around", "inside"),
    };
    if side == own || side == ContourSide::On {
        return Ok(());
    }
    let what = format!("the cutter would run in the material, which lies {place} the edge at `edge_at`");
    let help = format!("write side = \"{word}\", or a point on another edge");
    Err(Finding::error(Code::JOB_SHAPE, what).help(help).key("side").into())
}

fn operation(t: &ContourTable, around: &Around<'_>) -> Result<ContourOperation> {
    let tool = tool_of(&t.tool, around.tools)?;
    let (Cutter::EndMill { diameter } | Cutter::BullNose { diameter, .. }) = tool.cutter else {
        let finding = Finding::error(Code::JOB_REFERENCE, format!("{} has no cylindrical edge", tool.number));
        return Err(finding.help("use an end mill").key("tool").into());
    };
    let speed = whole_revolutions(spindle(t.speed, t.cutting_speed, ("tool", diameter))?);
    let feed = feed_of("contour", t.feed, t.feed_per_tooth, speed, tool.teeth)?;
    let per_second = |key: &str, value: Option<f64>, usual: f64| match value {
        Some(value) => Ok(positive(key, value, 1e6, "mm/min")? / 60.0),
        None => Ok::<f64, crate::base::Error>(usual),
    };
    length("top", t.top, -MAX_LENGTH, MAX_LENGTH)?;
    positive("depth", t.depth, MAX_LENGTH, "mm")?;
    length("breakthrough", t.breakthrough, 0.0, MAX_LENGTH)?;
    for (i, v) in t.start.iter().flatten().enumerate() {
        length(&format!("start[{i}]"), *v, -MAX_LENGTH, MAX_LENGTH)?;
    }
    if let Some(extend) = t.extend {
        length("extend", extend, 0.0, MAX_LENGTH)?;
    }
    let read = t.outline_keys().read_beside(t.side, around.loader)?;
    if let Some(edge) = &read.edge {
        beside_material(edge, t.side)?;
    }
    if let Some(extend) = t.extend.filter(|_| !read.outline.is_of_lines()) {
        let finding = Finding::error(Code::JOB_SHAPE, "a closed contour has no ends").value_mm(extend);
        return Err(finding.help("leave out `extend`").key("extend").into());
    }
    let tabs = t.tabs.as_ref().map(|tabs| checked_tabs(tabs, &read.outline).map_err(|e| e.under("tabs")));
    Ok(ContourOperation {
        outline: read.outline,
        notes: read.notes,
        plunge_feed: per_second("plunge_feed", t.plunge_feed, DOWN * feed)?,
        finish_feed: per_second("finish.feed", t.finish.as_ref().and_then(|f| f.feed), feed)?,
        ramp: match t.entry {
            Some(ContourEntry::Plunge) => None,
            Some(ContourEntry::Ramp(angle)) => Some(angle.to_radians()),
            None => Some(tool.max_ramp_angle.map_or(USUAL_RAMP, |most| most.min(USUAL_RAMP))),
        },
        feed,
        tabs: tabs.transpose()?,
        milling: milling_of(tool, speed, t.coolant, t.tolerance)?,
        table: t.clone(),
    })
}

fn checked_tabs(t: &TabsTable, outline: &Outline) -> Result<Tabs> {
    if t.count.is_some() && t.places.is_some() {
        let finding = Finding::error(Code::JOB_SHAPE, "`count` and `places` exclude each other");
        return Err(finding.help("give the number of tabs or their places").key("count").into());
    }
    let usual = (outline.perimeter() / TAB_EVERY).ceil().clamp(3.0, f64::from(MOST_TABS)) as u32;
    let count = t.count.unwrap_or(usual);
    if !(1..=MOST_TABS).contains(&count) {
        let finding = Finding::error(Code::JOB_VALUE, "a number of tabs is out of range");
        return Err(finding
            .value(f64::from(count), "tabs")
            .bound(f64::from(MOST_TABS), "tabs")
            .help("leave `tabs` out for none")
            .key("count")
            .into());
    }
    for (i, place) in t.places.iter().flatten().enumerate() {
        for v in place {
            length(&format!("places[{i}]"), *v, -MAX_LENGTH, MAX_LENGTH)?;
        }
    }
    Ok(Tabs {
        count,
        width: positive("width", t.width, MAX_LENGTH, "mm")?,
        height: positive("height", t.height, MAX_LENGTH, "mm")?,
        shape: t.shape,
        finish: t.finish,
        places: t.places.iter().flatten().map(|p| glam::DVec2::from_array(*p)).collect(),
    })
}
