//! Tools as written in the job file, and their check.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::bounded::{length, positive, text};
use crate::base::unit::Deg;
use crate::base::{Code, Error, Finding, Result};
use crate::cutting::EdgeMaterial;
use crate::tool::{
    ChamferForm, Cutter, DrillPoint, Hand, Holder, Neck, Tap, ThreadMill, Tool, ToolLimits, ToolNumber,
    ToothSpacing,
};

/// Kinds of tools.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ToolType {
    /// Flat end mill.
    EndMill,
    /// Face mill; `entering_angle` and `corner_radius` say what its edge is like.
    FaceMill,
    /// Ball-nose end mill.
    BallNose,
    /// End mill with a corner radius.
    BullNose,
    /// Conical cutter.
    Tapered,
    /// Drill, countersink, reamer: a tool that works along its axis; its shape is given by `point`.
    Drill,
    /// Tap: `diameter` is the nominal one of the thread, `pitch` its pitch, `hand` its hand.
    Tap,
    /// Thread mill: `diameter` is that of the crests, `pitch` that of its thread; `rows`, `half_angle`, a neck.
    ThreadMill,
}

/// Materials of the edges of tools.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EdgeName {
    /// Cemented carbide.
    Carbide,
    /// High-speed steel.
    Hss,
}

/// A tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToolTable {
    /// Number on the control.
    #[schemars(example = 1)]
    pub number: u32,
    /// Name to show.
    #[serde(default)]
    pub name: Option<String>,
    /// Kind.
    #[serde(rename = "type")]
    pub kind: ToolType,
    /// Diameter (of a tapered cutter: of its flat tip, 0 for a sharp one; of a face mill: at the finished plane).
    #[schemars(example = 10)]
    pub diameter: f64,
    /// Corner radius of a bull-nose end mill, or of a face mill with an entering angle of 90 degrees.
    #[serde(default)]
    pub corner_radius: Option<f64>,
    /// Entering angle of a face mill (KAPR, between the edge and the finished plane), degrees; default 90. The diameter
    /// grows with the height: diameter + 2 flute_length / tan(entering_angle) at most.
    #[serde(default)]
    pub entering_angle: Option<f64>,
    /// Angle between axis and edge of a tapered cutter, degrees; of a thread mill half the angle between its flanks, default 30.
    #[serde(default)]
    pub half_angle: Option<f64>,
    /// Full point angle of a twist drill, degrees; default 118. Other points: see `point`.
    #[serde(default, with = "Deg::<Option<f64>>")]
    pub point_angle: Option<f64>,
    /// Point of a drill that is no plain twist drill: "flat", { double-ground = { .. } }, { gun = { .. } }, ..
    #[serde(default)]
    pub point: Option<DrillPoint>,
    /// Pitch of the thread that a tap or a thread mill makes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitch: Option<f64>,
    /// Form of a tap's lead (DIN 2197); default "C". Its longest lead is taken: 8, 5.5, 3, 5, 2, 1.5 pitches.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chamfer: Option<ChamferForm>,
    /// Length of a tap's lead, pitches, in place of `chamfer`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lead: Option<f64>,
    /// Length of a tap's point below its lead; default 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip_length: Option<f64>,
    /// Whether a tap forms its thread without chips; default false.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forming: Option<bool>,
    /// Rows of teeth of a thread mill along its axis; default 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<u32>,
    /// Diameter of a thread mill's neck, between the teeth and the shank; default: no neck.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub neck_diameter: Option<f64>,
    /// Height above the tip at which its neck ends; default: at the holder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub neck_length: Option<f64>,
    /// Height of the cutting part above the tip.
    #[schemars(example = 22)]
    pub flute_length: f64,
    /// Material of its edges, "carbide" or "hss", for values to start with; default carbide for mills, HSS for drills, reamers and
    /// taps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<EdgeName>,
    /// Number of teeth; default 2.
    #[serde(default)]
    #[schemars(example = 4)]
    pub teeth: Option<u32>,
    /// Angle of each tooth about the axis, degrees, ascending from 0; default: evenly spaced.
    #[serde(default)]
    pub tooth_angles: Option<Vec<f64>>,
    /// Distance of each tooth beyond the nominal radius; default 0.
    #[serde(default)]
    pub runout: Option<Vec<f64>>,
    /// Height of the holder's face above the tip; default: the flute length.
    #[serde(default)]
    pub stickout: Option<f64>,
    /// Diameter of the shank; default: that of the cutter.
    #[serde(default)]
    pub shank_diameter: Option<f64>,
    /// Name of the holder.
    #[serde(default)]
    pub holder: Option<String>,
    /// Length from the spindle's gauge point to the tip.
    #[serde(default)]
    pub gauge_length: Option<f64>,
    /// Whether it cuts at its centre and may plunge; default: true for a drill, ball-nose and for end mills up to
    /// 20 mm, false for larger ones, which mostly carry indexable inserts.
    #[serde(default)]
    pub centre_cutting: Option<bool>,
    /// Steepest ramp it may follow, degrees.
    #[serde(default)]
    pub max_ramp_angle: Option<f64>,
    /// The sense in which it cuts: "right" turns with M3, "left" with M4; default "right".
    #[serde(default)]
    pub hand: Hand,
    /// Largest speed of the spindle with it, rev/min.
    #[serde(default)]
    pub max_speed: Option<f64>,
    /// Largest feed, mm/min.
    #[serde(default)]
    pub max_feed: Option<f64>,
    /// Cutting data of it by material: `[[tool.preset]]`.
    #[serde(default, rename = "preset", skip_serializing_if = "Vec::is_empty")]
    pub presets: Vec<PresetTable>,
}

/// Cutting data of a tool for a material.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PresetTable {
    /// The material, as `material` of a job names it.
    #[schemars(example = &"C45")]
    pub material: String,
    /// A word for it: "slotting".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Cutting speed, m/min; or give `speed`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = 120)]
    pub cutting_speed: Option<f64>,
    /// Spindle speed, rev/min.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = 3800)]
    pub speed: Option<f64>,
    /// Feed per tooth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = 0.05)]
    pub feed_per_tooth: Option<f64>,
    /// Feed per revolution, mm/rev.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feed_per_rev: Option<f64>,
    /// Feed, mm/min.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = 600)]
    pub feed: Option<f64>,
}

impl PresetTable {
    fn check(&self) -> Result<()> {
        text("material", &self.material)?;
        text("name", self.name.as_deref().unwrap_or_default())?;
        if self.speed.is_some() && self.cutting_speed.is_some() {
            let finding = Finding::error(Code::JOB_SHAPE, "`speed` and `cutting_speed` exclude each other");
            return Err(finding.help("give one of them").key("speed").into());
        }
        for (key, value, most, unit) in [
            ("cutting_speed", self.cutting_speed, 10_000.0, "m/min"),
            ("speed", self.speed, 200_000.0, "rev/min"),
            ("feed_per_tooth", self.feed_per_tooth, 100.0, "mm"),
            ("feed_per_rev", self.feed_per_rev, 100.0, "mm/rev"),
            ("feed", self.feed, 1e6, "mm/min"),
        ] {
            value.map(|v| positive(key, v, most, unit)).transpose()?;
        }
        Ok(())
    }
}

impl ToolTable {
    /// A tool of a number of which nothing else is known.
    pub(crate) fn bare(number: u32) -> ToolTable {
        ToolTable {
            number,
            name: None,
            kind: ToolType::EndMill,
            diameter: 0.0,
            corner_radius: None,
            entering_angle: None,
            half_angle: None,
            point_angle: None,
            point: None,
            rows: None,
            neck_diameter: None,
            neck_length: None,
            pitch: None,
            chamfer: None,
            lead: None,
            tip_length: None,
            forming: None,
            flute_length: 0.0,
            material: None,
            teeth: None,
            tooth_angles: None,
            runout: None,
            stickout: None,
            shank_diameter: None,
            holder: None,
            gauge_length: None,
            centre_cutting: None,
            max_ramp_angle: None,
            hand: Hand::Right,
            max_speed: None,
            max_feed: None,
            presets: Vec::new(),
        }
    }
}

impl ToolTable {
    /// The material of its edges: what it says, else the lower speed of the two, but for what is mostly of carbide.
    pub(in crate::job) fn edge_material(&self) -> EdgeMaterial {
        let is_mill = !matches!(self.kind, ToolType::Drill | ToolType::Tap);
        match self.material {
            Some(EdgeName::Carbide) => EdgeMaterial::Carbide,
            Some(EdgeName::Hss) => EdgeMaterial::Hss,
            None if is_mill => EdgeMaterial::Carbide,
            None => EdgeMaterial::Hss,
        }
    }
}

/// The holders by name, checked.
///
/// # Errors
/// One finding with the key of the first wrong value.
pub(in crate::job) fn holders(given: &[Holder]) -> Result<BTreeMap<&str, &Holder>> {
    let mut holders = BTreeMap::new();
    for (i, holder) in given.iter().enumerate() {
        text(&format!("holder[{i}].name"), &holder.name)?;
        holder.profiles(0.0).map_err(|e| e.under(&format!("holder[{i}].segments")))?;
        if holders.insert(holder.name.as_str(), holder).is_some() {
            return Err(Finding::error(
                Code::JOB_VALUE,
                format!("holder `{}` is defined twice", holder.name),
            )
            .key(format!("holder[{i}].name"))
            .into());
        }
    }
    Ok(holders)
}

/// The tools, checked.
///
/// # Errors
/// One finding with the key of the first wrong value.
pub(in crate::job) fn tools(tables: &[ToolTable], holders: &BTreeMap<&str, &Holder>) -> Result<Vec<Tool>> {
    let mut tools: Vec<Tool> = Vec::with_capacity(tables.len());
    for (i, table) in tables.iter().enumerate() {
        let tool = tool(table, holders).map_err(|e| e.under(&format!("tool[{i}]")))?;
        if tools.iter().any(|t| t.number == tool.number) {
            return Err(Finding::error(Code::JOB_VALUE, format!("{} is defined twice", tool.number))
                .key(format!("tool[{i}].number"))
                .into());
        }
        tools.push(tool);
    }
    Ok(tools)
}

/// One tool, checked.
///
/// # Errors
/// One finding with the key of the first wrong value, counted from its table.
pub(in crate::job) fn tool(t: &ToolTable, holders: &BTreeMap<&str, &Holder>) -> Result<Tool> {
    for (i, preset) in t.presets.iter().enumerate() {
        preset.check().map_err(|e| e.under(&format!("preset[{i}]")))?;
    }
    let diameter = length("diameter", t.diameter, 0.0, 1000.0)?;
    let misfit = |key: &str, wanted: bool, given: bool| match (wanted, given) {
        (true, false) => {
            let finding = Finding::error(Code::JOB_SHAPE, format!("a {} needs {key}", kind_name(t.kind)));
            Err(Error::from(finding.help(needed(key)).key("type")))
        }
        (false, true) => {
            Err(Finding::error(Code::JOB_SHAPE, format!("a {} has no {key}", kind_name(t.kind)))
                .key(key)
                .into())
        }
        _ => Ok(()),
    };
    if t.kind != ToolType::FaceMill {
        misfit("corner_radius", t.kind == ToolType::BullNose, t.corner_radius.is_some())?;
        misfit("entering_angle", false, t.entering_angle.is_some())?;
    }
    let is_thread_mill = t.kind == ToolType::ThreadMill;
    if !is_thread_mill {
        misfit("half_angle", t.kind == ToolType::Tapered, t.half_angle.is_some())?;
    }
    misfit("point_angle", t.kind == ToolType::Drill && t.point_angle.is_some(), t.point_angle.is_some())?;
    misfit("point", t.kind == ToolType::Drill && t.point.is_some(), t.point.is_some())?;
    let is_tap = t.kind == ToolType::Tap;
    misfit("pitch", is_tap || is_thread_mill, t.pitch.is_some())?;
    for (key, given) in [
        ("rows", t.rows.is_some()),
        ("neck_diameter", t.neck_diameter.is_some()),
        ("neck_length", t.neck_length.is_some()),
    ] {
        misfit(key, is_thread_mill && given, given)?;
    }
    for (key, given) in [
        ("chamfer", t.chamfer.is_some()),
        ("lead", t.lead.is_some()),
        ("tip_length", t.tip_length.is_some()),
        ("forming", t.forming.is_some()),
    ] {
        misfit(key, is_tap && given, given)?;
    }
    let cutter = match t.kind {
        ToolType::EndMill => Cutter::EndMill { diameter },
        ToolType::FaceMill => face_mill(t, diameter)?,
        ToolType::BallNose => Cutter::BallNose { diameter },
        ToolType::BullNose => Cutter::BullNose { diameter, corner_radius: t.corner_radius.unwrap_or(0.0) },
        ToolType::Tapered => {
            Cutter::Tapered { tip_diameter: diameter, half_angle: t.half_angle.unwrap_or(0.0).to_radians() }
        }
        ToolType::Drill => {
            Cutter::Drill { diameter, point: DrillPoint::of_keys(t.point.as_ref(), t.point_angle, diameter)? }
        }
        ToolType::Tap => Cutter::Tap(tap(t, diameter)?),
        ToolType::ThreadMill => Cutter::ThreadMill(thread_mill(t, diameter)?),
    };
    cutter.check()?;
    let flute_length = length("flute_length", t.flute_length, 0.0, 2000.0)?;
    let body_diameter = cutter.diameter(flute_length);
    let centre_cutting = t.centre_cutting.unwrap_or(match t.kind {
        ToolType::Drill | ToolType::Tap | ToolType::BallNose | ToolType::Tapered => true,
        // Solid end mills are ground to the centre; larger cutters mostly carry inserts around a hole.
        ToolType::EndMill | ToolType::BullNose => diameter <= 20.0,
        ToolType::FaceMill | ToolType::ThreadMill => false,
    });
    let holder = match &t.holder {
        None => None,
        Some(name) => Some(holders.get(name.as_str()).copied().cloned().ok_or_else(|| {
            Finding::error(Code::JOB_REFERENCE, format!("holder `{name}` is not defined"))
                .help("define it with [[holder]]")
                .key("holder")
        })?),
    };
    let tool = Tool {
        number: ToolNumber(t.number),
        name: text("name", t.name.as_deref().unwrap_or(kind_name(t.kind)))?,
        cutter,
        teeth: t.teeth.unwrap_or(2),
        spacing: ToothSpacing {
            angles: t.tooth_angles.iter().flatten().map(|a| a.to_radians()).collect(),
            runout: t.runout.clone().unwrap_or_default(),
        },
        flute_length,
        stickout: length("stickout", t.stickout.unwrap_or(flute_length), 0.0, 2000.0)?,
        shank_diameter: length("shank_diameter", t.shank_diameter.unwrap_or(body_diameter), 0.0, 1000.0)?,
        holder,
        centre_cutting,
        max_ramp_angle: t.max_ramp_angle.map(f64::to_radians),
        gauge_length: t.gauge_length,
        limits: limits(t)?,
        elasticity: elasticity(t),
    };
    tool.check()?;
    Ok(tool)
}

/// Modulus of elasticity of a tool (N/mm2): mills that do not say it are of carbide, but for those that mostly carry inserts in a body
/// of their maker's choice.
fn elasticity(t: &ToolTable) -> Option<f64> {
    /// Diameter up to which a mill is mostly of one piece [mm].
    const SOLID: f64 = 20.0;
    let has_inserts = t.kind == ToolType::FaceMill || t.material.is_none() && t.diameter > SOLID;
    (!has_inserts).then(|| t.edge_material().elasticity())
}

/// An example of a key that a kind of tool needs.
fn needed(key: &str) -> &'static str {
    match key {
        "corner_radius" => "give corner_radius = 1 (mm)",
        "half_angle" => "give half_angle = 45 (degrees)",
        "pitch" => "give pitch = 1.25 (mm)",
        _ => "",
    }
}

/// Hand of the tool, and limits of its speed and feed.
fn limits(t: &ToolTable) -> Result<ToolLimits> {
    let limit = |key: &str, value: Option<f64>, most: f64, unit: &str, factor: f64| -> Result<Option<f64>> {
        value.map(|v| Ok(positive(key, v, most, unit)? * factor)).transpose()
    };
    Ok(ToolLimits {
        hand: t.hand,
        max_speed: limit("max_speed", t.max_speed, 1e6, "rev/min", TAU / 60.0)?,
        max_feed: limit("max_feed", t.max_feed, 1e6, "mm/min", 1.0 / 60.0)?,
    })
}

/// The thread of a tap, and the length of its end.
fn tap(t: &ToolTable, diameter: f64) -> Result<Tap> {
    if t.lead.is_some() && t.chamfer.is_some() {
        let finding = Finding::error(Code::JOB_SHAPE, "`lead` and `chamfer` exclude each other");
        return Err(finding.help("give one of them").key("lead").into());
    }
    Ok(Tap {
        diameter,
        pitch: t.pitch.unwrap_or(0.0),
        lead: t.lead.unwrap_or(t.chamfer.unwrap_or_default().longest()),
        tip: t.tip_length.unwrap_or(0.0),
        forming: t.forming.unwrap_or(false),
    })
}

/// The teeth of a thread mill, and its neck.
fn thread_mill(t: &ToolTable, diameter: f64) -> Result<ThreadMill> {
    /// Half angle of the metric profile, degrees.
    const METRIC: f64 = 30.0;
    let neck = match (t.neck_diameter, t.neck_length) {
        (None, None) => None,
        (Some(diameter), top) => {
            let top = top.or(t.stickout).unwrap_or(t.flute_length);
            Some(Neck { diameter, top: length("neck_length", top, 0.0, 2000.0)? })
        }
        (None, Some(_)) => {
            let finding = Finding::error(Code::JOB_SHAPE, "the neck of a thread mill needs neck_diameter");
            return Err(finding.help("give neck_diameter = 6 (mm)").key("neck_length").into());
        }
    };
    Ok(ThreadMill {
        diameter,
        pitch: t.pitch.unwrap_or(0.0),
        rows: t.rows.unwrap_or(1),
        half_angle: t.half_angle.unwrap_or(METRIC).to_radians(),
        neck,
    })
}

/// The cutter of a face mill: its edge rises at the entering angle from the finished plane.
fn face_mill(t: &ToolTable, diameter: f64) -> Result<Cutter> {
    let entering = t.entering_angle.unwrap_or(90.0);
    if !(entering > 0.0 && entering <= 90.0) {
        return Err(Finding::error(
            Code::TOOL_VALUE,
            "the entering angle lies above 0 and at most at 90 degrees",
        )
        .value(entering, "deg")
        .bound(90.0, "deg")
        .key("entering_angle")
        .into());
    }
    match (entering < 90.0, t.corner_radius) {
        (true, Some(_)) => Err(Finding::error(
            Code::JOB_SHAPE,
            "a face mill has a corner radius only with an entering angle of 90 degrees",
        )
        .help("leave one of them out")
        .key("corner_radius")
        .into()),
        (true, None) => {
            Ok(Cutter::Tapered { tip_diameter: diameter, half_angle: (90.0 - entering).to_radians() })
        }
        (false, Some(corner_radius)) => Ok(Cutter::BullNose { diameter, corner_radius }),
        (false, None) => Ok(Cutter::EndMill { diameter }),
    }
}

/// A kind in words.
pub(in crate::job) fn kind_name(kind: ToolType) -> &'static str {
    match kind {
        ToolType::EndMill => "end mill",
        ToolType::FaceMill => "face mill",
        ToolType::BallNose => "ball-nose end mill",
        ToolType::BullNose => "bull-nose end mill",
        ToolType::Tapered => "tapered mill",
        ToolType::Drill => "drill",
        ToolType::Tap => "tap",
        ToolType::ThreadMill => "thread mill",
    }
}
