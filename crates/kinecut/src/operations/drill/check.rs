//! Drilling operations, checked: keys that exclude each other, patterns, units.

use std::sync::Arc;

use super::holes::plan_holes;
use super::plan::{PlannedDrilling, planned};
use super::{DrillTable, ExitTable, FaceTable, SurfaceName};
use crate::base::bounded::{MAX_LENGTH, bounded, length, positive};
use crate::base::{Code, Error, Finding, Loader, Result};
use crate::cutting::StartCut;
use crate::drilling::{DrillMethod, FeedChoice};
use crate::geom::{Mesh, load_mesh};
use crate::operations::kind::{self, Attempt};
use crate::operations::places::{HolePlace, places};
use crate::operations::{
    Around, CalledTool, CuttingKeys, Milling, PlaneTable, Setting, milling_of, spindle, tool_of,
    whole_revolutions,
};
use crate::tool::{Cutter, Tool};

/// Drilling of one or many holes.
#[derive(Clone, Debug)]
pub struct DrillOperation {
    /// As written: the planner's own checks work on it.
    pub table: DrillTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
    /// Kind of drilling.
    pub method: DrillMethod,
    /// Speed of the spindle as the cutting speed has it [rad/s]; a program has whole revolutions per minute.
    pub exact_spindle: f64,
    /// Feeds.
    pub feed: FeedChoice,
    /// The holes in the order of drilling.
    pub holes: Vec<HolePlace>,
    /// The mesh whose surfaces are met, if one is named.
    pub body: Option<Mesh>,
}

impl DrillOperation {
    /// Diameter of the tool [mm].
    pub fn diameter(&self) -> f64 {
        self.milling.tool.cutter.diameter(self.milling.tool.flute_length)
    }
}

impl kind::Checked for DrillOperation {
    type Plan = PlannedDrilling;

    const NOUN: &'static str = "drilled hole";

    fn milling(&self) -> &Milling {
        &self.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut self.milling
    }

    fn name(&self) -> String {
        let (word, diameter) = (self.method.word(), self.table.reach_diameter.unwrap_or(self.diameter()));
        match &self.holes[..] {
            [one] => format!("{word} {diameter} at X{} Y{}", one.at[0], one.at[1]),
            many => format!("{word} {diameter}, {} holes", many.len()),
        }
    }

    fn not_compared(&self) -> Option<&'static str> {
        match self.method {
            DrillMethod::Countersinking => Some("the cone of a countersink"),
            DrillMethod::Counterboring => Some("the seat of a counterbore"),
            DrillMethod::Centring => Some("the start of a hole that a centre drill leaves"),
            DrillMethod::Drilling
            | DrillMethod::CoreDrilling
            | DrillMethod::Reaming
            | DrillMethod::StepDrilling => None,
        }
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedDrilling>> {
        Ok(planned(self, plan_holes(setting, self)?))
    }
}

impl kind::Table for DrillTable {
    type Of = DrillOperation;

    fn check(&self, around: &Around<'_>) -> Result<DrillOperation> {
        operation(self, around.tools, around.loader)
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn data(&mut self) -> Option<CuttingKeys<'_>> {
        let cut = match self.method {
            DrillMethod::Centring | DrillMethod::Countersinking => StartCut::Spot,
            DrillMethod::Reaming => StartCut::Ream,
            _ => StartCut::Drill,
        };
        Some(CuttingKeys {
            speed: &mut self.speed,
            cutting_speed: &mut self.cutting_speed,
            feed: None,
            per_rev: Some(&mut self.feed_per_rev),
            cut,
        })
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }

    fn file(&self) -> Option<(&'static str, &str)> {
        self.body.as_ref().map(|name| ("body", name.as_str()))
    }
}

fn operation(t: &DrillTable, tools: &[Tool], loader: &dyn Loader) -> Result<DrillOperation> {
    let tool = tool_of(&t.tool, tools)?;
    let Cutter::Drill { diameter, .. } = tool.cutter else {
        return Err(Finding::error(Code::JOB_REFERENCE, format!("{} is no drill", tool.number))
            .help("give the tool type = \"drill\" and a point")
            .key("tool")
            .into());
    };
    excluded(t)?;
    let about = ("reach_diameter", t.reach_diameter.unwrap_or(diameter));
    let exact_spindle = spindle(t.speed, t.cutting_speed, about)?;
    let feed = t.feed_per_rev.ok_or_else(|| {
        Finding::error(Code::JOB_SHAPE, "the operation needs a feed")
            .help("give feed_per_rev = { steady = 0.1 } (mm/rev)")
            .key("feed_per_rev")
    })?;
    for (key, value) in [("entry", feed.entry), ("exit", feed.exit)] {
        if let Some(value) = value {
            positive(&format!("feed_per_rev.{key}"), value, 100.0, "mm/rev")?;
        }
    }
    positive("feed_per_rev.steady", feed.steady, 100.0, "mm/rev")?;
    if let Some(peck) = t.peck {
        positive("peck.step", peck.step, MAX_LENGTH, "mm")?;
    }
    bounded("dwell", t.dwell, 0.0, 3600.0, "s")?;
    length("approach", t.approach, 0.0, 1000.0)?;
    length("overrun", t.overrun.unwrap_or(0.0), 0.0, 1000.0)?;
    length("surface_tolerance", t.surface_tolerance, 0.0, 1000.0)?;
    length("top", t.top, -MAX_LENGTH, MAX_LENGTH)?;
    for (key, value) in [
        ("length", t.length),
        ("depth", t.depth),
        ("tip", t.tip),
        ("reach_diameter", t.reach_diameter),
        ("clearance", t.clearance),
    ] {
        length(key, value.unwrap_or(0.0), -MAX_LENGTH, MAX_LENGTH)?;
    }
    if let Some(face) = &t.entry {
        face_numbers(face).map_err(|e| e.under("entry"))?;
    }
    if let Some(ExitTable::Face(face)) = &t.exit {
        face_numbers(face).map_err(|e| e.under("exit"))?;
    }
    if let Some(hole) = &t.pre_hole {
        pre_hole_numbers(hole).map_err(|e| e.under("pre_hole"))?;
    }
    for (i, bore) in t.cross_bores.iter().enumerate() {
        let numbers = || -> Result<()> {
            positive("diameter", bore.diameter, MAX_LENGTH, "mm")?;
            length("z", bore.z, -MAX_LENGTH, MAX_LENGTH)?;
            length("offset", bore.offset.unwrap_or(0.0), -MAX_LENGTH, MAX_LENGTH)?;
            place(bore.at, bore.direction)
        };
        numbers().map_err(|e| e.under(&format!("cross_bore[{i}]")))?;
    }
    let holes = places(t.points.as_deref(), t.pattern.as_ref())?;
    let spindle = if t.speed.is_none() { whole_revolutions(exact_spindle) } else { exact_spindle };
    let body = match &t.body {
        Some(name) => Some(load_mesh(name, loader).map_err(|e| e.under("body"))?),
        None => None,
    };
    Ok(DrillOperation {
        milling: milling_of(tool, spindle, t.coolant, t.tolerance)?,
        method: t.method,
        feed,
        exact_spindle,
        holes,
        body,
        table: t.clone(),
    })
}

/// Keys that exclude each other, or need another.
fn excluded(t: &DrillTable) -> Result<()> {
    let fail = |key: &str, what: &str, help: &str| -> Result<()> {
        Err(Finding::error(Code::JOB_SHAPE, what).help(help).key(key).into())
    };
    let ends = [t.depth.is_some(), t.tip.is_some(), t.reach_diameter.is_some(), t.exit.is_some()];
    if ends.iter().filter(|e| **e).count() > 1 {
        return fail(
            "exit",
            "`exit`, `depth`, `tip` and `reach_diameter` exclude each other",
            "say in one way where the hole ends",
        );
    }
    if t.entry.is_none() && t.exit.is_some() {
        return fail("exit", "an exit needs an entry", "give `entry` too, or leave both to the body");
    }
    if t.entry.is_some() && t.body.is_some() {
        return fail("body", "`entry` and `body` exclude each other", "leave one of them out");
    }
    if t.entry.is_some() && !ends.contains(&true) {
        return fail(
            "entry",
            "the hole has no end",
            "give `exit`, `depth`, `tip` or `reach_diameter`, or leave the surfaces to the body",
        );
    }
    if let (Some(FaceTable { surface: SurfaceName::Plane, .. }), Some(ExitTable::Same), None) =
        (&t.entry, &t.exit, t.length)
    {
        return fail("exit", "a parallel plane needs its distance", "give `length`");
    }
    Ok(())
}

fn face_numbers(face: &FaceTable) -> Result<()> {
    let shape = |key: &str, what: &str, help: &str| -> Error {
        Finding::error(Code::JOB_SHAPE, what).help(help).key(key).into()
    };
    match (face.surface, face.radius, face.inclination) {
        (SurfaceName::Plane, Some(_), _) => {
            return Err(shape("radius", "a plane has no radius", "leave it out"));
        }
        (SurfaceName::OuterCylinder | SurfaceName::InnerCylinder, None, _) => {
            return Err(shape("surface", "a cylinder needs a radius", "give radius = .."));
        }
        (SurfaceName::OuterCylinder | SurfaceName::InnerCylinder, _, Some(_)) => {
            return Err(shape("inclination", "a cylinder has no inclination", "leave it out"));
        }
        _ => {}
    }
    if face.offset.is_some() && face.at.is_some() {
        return Err(shape("offset", "`offset` and `at` exclude each other", "give one of them"));
    }
    // Zero and less are refused by the planner, with the bound of the field.
    length("radius", face.radius.unwrap_or(1.0), -MAX_LENGTH, MAX_LENGTH)?;
    bounded("inclination", face.inclination.unwrap_or(0.0), -360.0, 360.0, "deg")?;
    length("offset", face.offset.unwrap_or(0.0), -MAX_LENGTH, MAX_LENGTH)?;
    place(face.at, face.direction)
}

fn place(at: Option<[f64; 2]>, direction: Option<f64>) -> Result<()> {
    for (i, v) in at.unwrap_or_default().into_iter().enumerate() {
        length(&format!("at[{i}]"), v, -MAX_LENGTH, MAX_LENGTH)?;
    }
    bounded("direction", direction.unwrap_or(0.0), -360.0, 360.0, "deg")?;
    Ok(())
}

fn pre_hole_numbers(hole: &super::PreHoleTable) -> Result<()> {
    positive("diameter", hole.diameter, MAX_LENGTH, "mm")?;
    for (i, v) in hole.offset.unwrap_or_default().into_iter().enumerate() {
        length(&format!("offset[{i}]"), v, -MAX_LENGTH, MAX_LENGTH)?;
    }
    length("bottom", hole.bottom.unwrap_or(0.0), -MAX_LENGTH, MAX_LENGTH)?;
    let angle = positive("bottom_angle", hole.bottom_angle.unwrap_or(180.0), 180.0, "deg")?;
    if hole.bottom.is_none() && angle != 180.0 {
        return Err(Finding::error(Code::JOB_SHAPE, "an angle of the bottom needs the bottom")
            .help("give bottom = -20 (mm)")
            .key("bottom_angle")
            .into());
    }
    Ok(())
}
