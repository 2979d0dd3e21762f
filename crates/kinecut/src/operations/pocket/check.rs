//! Pockets, checked: the outline read and placed, speeds and feeds, the tool.

use std::sync::Arc;

use super::PocketTable;
use super::island::has_no_island;
use super::plan::{PlannedPocket, planned};
use super::rest::EarlierPocket;
use crate::base::bounded::{MAX_LENGTH, length, positive};
use crate::base::{Code, Finding, Result};
use crate::clearing::{CentreLine, EarlierCutter, PocketSpec, SlotSpec};
use crate::contouring::{ContourLoops, ContourSide};
use crate::cutting::{MillingCut, StartCut};
use crate::geom::{Outline, OutlineRead};
use crate::holes::CutterData;
use crate::operations::kind::{self, Attempt};
use crate::operations::named::NamedOutline;
use crate::operations::outlines::{OutlineEntry, outline_keys};
use crate::operations::{
    Around, CalledTool, CuttingKeys, FeedKeys, Milling, PlaneTable, Setting, feed_of, milling_of, spindle,
    tool_of, whole_revolutions,
};
use crate::tool::{Cutter, Hand};

/// Engagement where the job does not say it [deg].
pub(crate) const USUAL_ENGAGEMENT: f64 = 60.0;
/// Angle of the helix where neither the job nor the tool says one [deg].
const USUAL_HELIX: f64 = 3.0;
/// Share of the feed at which the cutter goes down, and by which it goes faster through what is cleared.
const DOWN: f64 = 0.5;
const THROUGH: f64 = 2.0;
/// Largest corner of a cutter, in its radius: beyond it passes leave ridges on the floor.
const CORNER: f64 = 0.25;

/// Milling of a pocket.
#[derive(Clone, Debug)]
pub struct PocketOperation {
    /// As written.
    pub table: PocketTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
    /// The outline in coordinates of the work offset.
    pub outline: Outline,
    /// Notes of the outline's reader.
    pub notes: Vec<String>,
    /// Engagement [rad].
    pub engagement: f64,
    /// Feeds of passes, down, through what is cleared, and of finishing [mm/s].
    pub feeds: PocketFeeds,
    /// Angle of the helix or ramp [rad].
    pub helix: f64,
    /// The cutter of the pocket before, where only what that one has left is cleared.
    pub rest: Option<EarlierCutter>,
    /// The centre line, where it is a slot.
    pub slot: Option<CentredSlot>,
}

/// The centre line of a slot, and its width [mm].
#[derive(Clone, Debug, PartialEq)]
pub struct CentredSlot {
    /// The centre line in coordinates of the work offset.
    pub line: CentreLine,
    /// Width.
    pub width: f64,
}

impl CentredSlot {
    /// It with all else of a pocket.
    pub(super) fn of(&self, pocket: &PocketSpec) -> SlotSpec {
        SlotSpec { line: self.line.clone(), width: self.width, pocket: pocket.clone() }
    }

    /// Radius of the arcs on which its wall is joined and left, for which there is room beside the opposite one [mm].
    pub(super) fn lead_radius(&self, cutter: &CutterData, leave: f64) -> Option<f64> {
        let radius = 0.5 * cutter.diameter;
        let room = 0.5 * self.width - leave - radius;
        let usual = if radius > 2.0 { 0.5 * radius } else { 1.0 };
        (room > 0.0 && room < usual).then_some(room)
    }
}

/// Feeds of a pocket [mm/s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PocketFeeds {
    /// Of passes and along the wall.
    pub pass: f64,
    /// Down.
    pub down: f64,
    /// Through what is cleared.
    pub link: f64,
    /// Of finishing.
    pub finish: f64,
}

impl PocketOperation {
    /// Radius of the tool's corner [mm]: a wall is cut to size above it.
    pub(super) fn corner(&self) -> f64 {
        match self.milling.tool.cutter {
            Cutter::BullNose { corner_radius, .. } => corner_radius,
            _ => 0.0,
        }
    }

    /// Whether the spindle turns counter-clockwise.
    pub(super) fn left_hand(&self) -> bool {
        self.milling.tool.limits.hand == Hand::Left
    }
}

impl kind::Checked for PocketOperation {
    type Plan = PlannedPocket;

    const NOUN: &'static str = "pocket";

    fn milling(&self) -> &Milling {
        &self.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut self.milling
    }

    fn finishing(&self) -> Option<MillingCut> {
        let finish = self.table.finish.as_ref()?;
        let depth = self.table.depth + self.table.breakthrough;
        Some(self.milling.beside_wall(finish.allowance, self.feeds.finish, [finish.stepdown, Some(depth)]))
    }

    fn spring_passes(&self) -> u32 {
        self.table.finish.as_ref().map_or(0, |f| f.spring_passes)
    }

    fn name(&self) -> String {
        let [min, max] = self.outline.bounds();
        let size = max - min;
        let shown = |mm: f64| crate::page::trimmed(mm, 2);
        let noun = if self.rest.is_some() { "rest of pocket" } else { "pocket" };
        format!("{noun} {} x {} x {}", shown(size.x), shown(size.y), shown(self.table.depth))
    }

    fn is_left_hand(&self) -> bool {
        self.left_hand()
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedPocket>> {
        planned(self, setting)
    }
}

impl kind::Table for PocketTable {
    type Of = PocketOperation;

    fn check(&self, around: &Around<'_>) -> Result<PocketOperation> {
        let Some(name) = &self.rest else {
            return checked(self, "pocket", around, || {
                let read = outline_keys!(self).of_pocket().read(around.loader)?;
                // Of a boss that is the wrong edge, which is said below.
                if read.edge.is_some_and(|edge| !edge.material_inside) {
                    has_no_island(self, &read.outline, around.loader)?;
                }
                Ok(read)
            });
        };
        let earlier = EarlierPocket::find(name, around.before)?;
        let read = || outline_keys!(earlier.outline).of_pocket().read(around.loader);
        let of = checked(self, "pocket", around, read)?;
        let cutter = earlier.cutter(self, &of.milling.tool, around)?;
        Ok(PocketOperation { rest: Some(cutter), ..of })
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn data(&mut self) -> Option<CuttingKeys<'_>> {
        let cut = StartCut::Side(self.engagement.unwrap_or(USUAL_ENGAGEMENT).to_radians());
        let feed = Some(FeedKeys { feed: &mut self.feed, per_tooth: &mut self.feed_per_tooth });
        Some(CuttingKeys {
            speed: &mut self.speed,
            cutting_speed: &mut self.cutting_speed,
            feed,
            per_rev: None,
            cut,
        })
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }

    fn named_outline(&self) -> Option<NamedOutline<'_>> {
        let (top, stock_to_leave, plane) = (self.top, self.stock_to_leave, self.plane());
        // One of a rest has no outline of its own: others refer to that of the pocket before.
        self.name.as_deref().filter(|_| self.rest.is_none()).map(|name| NamedOutline {
            name,
            keys: outline_keys!(self).of_pocket(),
            side: ContourSide::Inside,
            loops: ContourLoops::All,
            top,
            stock_to_leave,
            plane,
            from_edge: [false; 2],
            has_wall: true,
        })
    }

    fn file(&self) -> Option<(&'static str, &str)> {
        match &self.outline {
            Some(OutlineEntry::Name(name)) => Some(("outline", name)),
            _ => None,
        }
    }
}

/// A pocket, or what is cleared like one, by its noun; `outline` reads the outline, once all before it is right.
///
/// # Errors
/// One finding with the key of the first wrong value.
pub(crate) fn checked(
    t: &PocketTable,
    noun: &str,
    around: &Around<'_>,
    outline: impl FnOnce() -> Result<OutlineRead>,
) -> Result<PocketOperation> {
    let tool = tool_of(&t.tool, around.tools)?;
    let (diameter, corner) = match tool.cutter {
        Cutter::EndMill { diameter } => (diameter, 0.0),
        Cutter::BullNose { diameter, corner_radius } => (diameter, corner_radius),
        _ => {
            let what = format!("{} has no cylindrical edge and flat end", tool.number);
            let finding = Finding::error(Code::JOB_REFERENCE, what);
            return Err(finding.help("use an end mill").key("tool").into());
        }
    };
    if corner > CORNER * 0.5 * diameter {
        let what =
            format!("the cutter's corner is too large for a {noun}: its passes leave ridges on the floor");
        return Err(Finding::error(Code::JOB_REFERENCE, what)
            .value_mm(corner)
            .bound_mm(CORNER * 0.5 * diameter)
            .help("use an end mill with a smaller corner")
            .key("tool")
            .into());
    }
    let speed = whole_revolutions(spindle(t.speed, t.cutting_speed, ("tool", diameter))?);
    let pass = feed_of(noun, t.feed, t.feed_per_tooth, speed, tool.teeth)?;
    let per_second = |key: &str, value: Option<f64>, usual: f64| match value {
        Some(value) => Ok(positive(key, value, 1e6, "mm/min")? / 60.0),
        None => Ok::<f64, crate::base::Error>(usual),
    };
    length("top", t.top, -MAX_LENGTH, MAX_LENGTH)?;
    positive("depth", t.depth, MAX_LENGTH, "mm")?;
    length("breakthrough", t.breakthrough, 0.0, MAX_LENGTH)?;
    let engagement = t.engagement.unwrap_or(USUAL_ENGAGEMENT).to_radians();
    let entry = t.entry.unwrap_or_default();
    let usual = USUAL_HELIX.to_radians();
    let helix = match entry.helix {
        Some(angle) => positive("entry.helix", angle, 45.0, "deg")?.to_radians(),
        None => tool.max_ramp_angle.map_or(usual, |most| most.min(usual)),
    };
    let read = outline()?;
    if read.edge.is_some_and(|edge| edge.material_inside) {
        let what = format!("the edge at `edge_at` is that of a boss or a plate: it encloses no {noun}");
        let help = "write a point on the edge of the pocket; around a boss a contour cuts";
        return Err(Finding::error(Code::JOB_SHAPE, what).help(help).key("edge_at").into());
    }
    let feeds = PocketFeeds {
        pass,
        down: per_second("plunge_feed", t.plunge_feed, DOWN * pass)?,
        link: per_second("link_feed", t.link_feed, THROUGH * pass)?,
        finish: per_second("finish.feed", t.finish.as_ref().and_then(|f| f.feed), pass)?,
    };
    Ok(PocketOperation {
        outline: read.outline,
        notes: read.notes,
        engagement,
        feeds,
        helix,
        rest: None,
        slot: None,
        milling: milling_of(tool, speed, t.coolant, t.tolerance)?,
        table: t.clone(),
    })
}
