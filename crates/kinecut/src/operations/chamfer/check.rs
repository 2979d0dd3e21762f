//! Chamfers, checked: the outline read and placed, the V cutter wide enough, its tip off the floor.

use std::sync::Arc;

use super::ChamferTable;
use super::plan::{PlannedChamfer, planned};
use crate::base::bounded::{MAX_LENGTH, length, positive};
use crate::base::{Code, Error, Finding, Result};
use crate::contouring::{Chamfer, ContourLoops, ContourSide};
use crate::geom::Outline;
use crate::operations::kind::{self, Attempt};
use crate::operations::named::NamedOutline;
use crate::operations::outlines::{OutlineEntry, outline_keys};
use crate::operations::{
    Around, CalledTool, CuttingKeys, FeedKeys, Milling, PlaneTable, Setting, feed_of, milling_of, spindle,
    tool_of, whole_revolutions,
};
use crate::page::trimmed;
use crate::tool::{Cutter, Hand, Tool};

/// Share of the feed at which the cutter goes down where the job does not say.
const DOWN: f64 = 0.5;
/// Share of the tool's diameter that the tip lies below the chamfer where the job does not say.
const CLEAR: f64 = 0.1;
/// Least and greatest depth of the tip below the chamfer where the job does not say; the first also where it does [mm].
const TIP: [f64; 2] = [0.2, 0.5];
/// Radius of the cutter that stays beyond the edge [mm].
const BEYOND: f64 = 0.1;
/// Deviation of the width where the job does not say [mm].
const USUAL_TOLERANCE: f64 = 0.01;
/// Length that is rounding [mm].
const ROUNDING: f64 = 1e-9;

/// Chamfering along an outline.
#[derive(Clone, Debug)]
pub struct ChamferOperation {
    /// As written.
    pub table: ChamferTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
    /// The outline in coordinates of the work offset.
    pub outline: Outline,
    /// Side of the outline on which the cutter runs: outside or inside.
    pub side: ContourSide,
    /// Loops whose edges are chamfered.
    pub loops: ContourLoops,
    /// Height of the edge [mm].
    pub top: f64,
    /// Distance of the wall before the outline [mm].
    pub stock_to_leave: f64,
    /// Notes of the outline's reader.
    pub notes: Vec<String>,
    /// The chamfer and the place of the cutter's tip.
    pub chamfer: Chamfer,
    /// Feed along the edge [mm/s].
    pub feed: f64,
    /// Feed down [mm/s].
    pub plunge_feed: f64,
}

impl kind::Checked for ChamferOperation {
    type Plan = PlannedChamfer;

    const NOUN: &'static str = "chamfer";

    fn milling(&self) -> &Milling {
        &self.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut self.milling
    }

    fn name(&self) -> String {
        let [min, max] = self.outline.bounds();
        let size = max - min;
        let side = if self.side == ContourSide::Inside { "inside" } else { "outside" };
        let shown = |mm: f64| trimmed(mm, 2);
        format!("chamfer {} {side} {} x {}", shown(self.chamfer.width), shown(size.x), shown(size.y))
    }

    fn is_left_hand(&self) -> bool {
        self.milling.tool.limits.hand == Hand::Left
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedChamfer>> {
        planned(self, setting)
    }
}

impl kind::Table for ChamferTable {
    type Of = ChamferOperation;

    fn check(&self, around: &Around<'_>) -> Result<ChamferOperation> {
        operation(self, around)
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn data(&mut self) -> Option<CuttingKeys<'_>> {
        let feed = Some(FeedKeys { feed: &mut self.feed, per_tooth: &mut self.feed_per_tooth });
        Some(CuttingKeys { speed: &mut self.speed, cutting_speed: &mut self.cutting_speed, feed })
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }

    fn named_outline(&self) -> Option<NamedOutline<'_>> {
        // One that refers to another has no outline of its own to give.
        let own = outline_keys!(self);
        let name = self.name.as_deref().filter(|_| !own.is_empty())?;
        Some(NamedOutline {
            name,
            keys: own,
            side: self.side.unwrap_or_default().into(),
            loops: self.loops.unwrap_or_default(),
            top: self.top.unwrap_or_default(),
            stock_to_leave: self.stock_to_leave.unwrap_or_default(),
            plane: self.plane(),
        })
    }

    fn file(&self) -> Option<(&'static str, &str)> {
        match &self.outline {
            Some(OutlineEntry::Name(name)) => Some(("outline", name)),
            _ => None,
        }
    }
}

fn operation(t: &ChamferTable, around: &Around<'_>) -> Result<ChamferOperation> {
    let tool = tool_of(&t.tool, around.tools)?;
    let chamfer = chamfer(t, &tool)?;
    let edge = edge(t, around)?;
    length("top", edge.top, -MAX_LENGTH, MAX_LENGTH)?;
    length("stock_to_leave", edge.stock_to_leave, 0.0, MAX_LENGTH)?;
    for (i, v) in t.start.iter().flatten().enumerate() {
        length(&format!("start[{i}]"), *v, -MAX_LENGTH, MAX_LENGTH)?;
    }
    let diameter = 2.0 * chamfer.top_radius();
    let speed = whole_revolutions(spindle(t.speed, t.cutting_speed, ("width", diameter))?);
    let feed = feed_of("chamfer", t.feed, t.feed_per_tooth, speed, tool.teeth)?;
    let plunge_feed = match t.plunge_feed {
        Some(feed) => positive("plunge_feed", feed, 1e6, "mm/min")? / 60.0,
        None => DOWN * feed,
    };
    let read = edge.keys.read(around.loader).map_err(|e| if t.of.is_some() { at_of(e) } else { e })?;
    let tolerance = Some(t.tolerance.unwrap_or(USUAL_TOLERANCE));
    Ok(ChamferOperation {
        outline: read.outline,
        side: edge.side,
        loops: edge.loops,
        top: edge.top,
        stock_to_leave: edge.stock_to_leave,
        notes: read.notes,
        chamfer,
        feed,
        plunge_feed,
        milling: milling_of(tool, speed, t.coolant, tolerance)?,
        table: t.clone(),
    })
}

/// The edge: that which the table says, the rest of it that of the operation to which it refers.
fn edge<'a>(t: &'a ChamferTable, around: &Around<'a>) -> Result<NamedOutline<'a>> {
    let own = outline_keys!(t);
    let name = t.name.as_deref().unwrap_or_default();
    let of = match &t.of {
        Some(of) if own.is_empty() => NamedOutline { name, ..NamedOutline::find(of, around.before)? },
        Some(_) => {
            let finding = Finding::error(Code::JOB_SHAPE, "`of` and an outline exclude each other");
            return Err(finding.help("give one of them").key("of").into());
        }
        None => NamedOutline {
            name,
            keys: own,
            side: ContourSide::Outside,
            loops: ContourLoops::All,
            top: 0.0,
            stock_to_leave: 0.0,
            plane: t.plane.as_ref(),
        },
    };
    let edge = NamedOutline {
        side: t.side.map_or(of.side, ContourSide::from),
        loops: t.loops.unwrap_or(of.loops),
        top: t.top.unwrap_or(of.top),
        stock_to_leave: t.stock_to_leave.unwrap_or(of.stock_to_leave),
        ..of
    };
    if edge.plane != t.plane.as_ref() {
        let finding = Finding::error(Code::JOB_SHAPE, "the operation that `of` names works in another plane");
        return Err(finding.help("give both the same plane").key("of").into());
    }
    if edge.side == ContourSide::On {
        let finding =
            Finding::error(Code::JOB_SHAPE, "the contour that `of` names runs on its line and has no side");
        return Err(finding.help("say it here: side = \"outside\" or \"inside\"").key("of").into());
    }
    Ok(edge)
}

/// An error of the outline of the operation to which a table refers.
fn at_of(Error(mut finding): Error) -> Error {
    finding.key = None;
    finding.key("of").into()
}

/// The chamfer, for which the tool is wide enough and the wall high enough.
fn chamfer(t: &ChamferTable, tool: &Tool) -> Result<Chamfer> {
    let Cutter::Tapered { tip_diameter, half_angle } = tool.cutter else {
        let finding = Finding::error(Code::JOB_REFERENCE, format!("{} has no conical edge", tool.number));
        return Err(finding
            .help("use a tapered tool: type = \"tapered\" with half_angle")
            .key("tool")
            .into());
    };
    let diameter = tool.cutter.diameter(tool.flute_length);
    let [least, most] = TIP;
    let tip_clearance = length(
        "tip_clearance",
        t.tip_clearance.unwrap_or((CLEAR * diameter).clamp(least, most)),
        least,
        MAX_LENGTH,
    )?;
    let width = positive("width", t.width, MAX_LENGTH, "mm")?;
    let chamfer = Chamfer { width, half_angle, tip_diameter, tip_clearance };
    let (needed, given) = (chamfer.top_radius(), 0.5 * diameter);
    if needed > given - BEYOND + ROUNDING {
        let what = format!("the chamfer needs more radius of the cutter than {} has", tool.number);
        let widest = given - BEYOND - chamfer.offset();
        let help = match widest > 0.0 {
            true => format!("write width = {} at most, or a smaller tip_clearance", floored(widest)),
            false => "write a smaller tip_clearance, or take a larger cutter".to_owned(),
        };
        let finding = Finding::error(Code::PLAN_VALUE, what).value_mm(rounded(needed));
        return Err(finding.bound_mm(rounded(given - BEYOND)).help(help).key("width").into());
    }
    if let Some(wall) = t.wall_height {
        let wall = positive("wall_height", wall, MAX_LENGTH, "mm")?;
        if chamfer.depth() > wall + ROUNDING {
            let what = "the V cutter's tip would touch the floor below the edge";
            let [clearance, widest] = [wall - chamfer.leg(), (wall - least) * half_angle.tan()];
            let (key, help) = if clearance >= least - ROUNDING {
                let fits = floored(clearance);
                (
                    "tip_clearance",
                    format!("largest here: tip_clearance = {fits} with width = {}", trimmed(width, 4)),
                )
            } else if widest > 0.0 {
                ("width", format!("largest here: width = {} with tip_clearance = {least}", floored(widest)))
            } else {
                ("wall_height", format!("the tip needs {least} mm: take another cutter"))
            };
            let finding = Finding::error(Code::PLAN_VALUE, what).value_mm(rounded(chamfer.depth()));
            return Err(finding.bound_mm(wall).help(help).key(key).into());
        }
    }
    Ok(chamfer)
}

/// A length as messages show it [mm].
fn rounded(mm: f64) -> f64 {
    (mm * 1e4).round() / 1e4
}

/// A largest length in words, that still fits as written [mm].
fn floored(mm: f64) -> String {
    trimmed(((mm + ROUNDING) * 1e3).floor() / 1e3, 3)
}
