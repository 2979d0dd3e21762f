//! Tool libraries of Fusion: `{ "data": [tools and holders] }`, each with its own unit.
//!
//! Nothing is published of the format. What public readers agree on is taken; where they do not agree (the pitch of taps in
//! inches, the cutting speed of presets in inches, the angles of face mills) the value is named as not taken, or missing.

use serde_json::Value;

use super::cone::{ConeKeys, cone};
use super::fields::{Fields, Left, fit_name, says};
use super::own::too_many;
use super::quantity::{Quantity, quantity};
use super::shelf::Shelf;
use super::{Library, LibraryFormat, LibraryTool, MOST_TOOLS};
use crate::base::{Location, Result};
use crate::job::file::{PresetTable, ToolTable, ToolType};
use crate::tool::{Hand, HolderSegment};

/// The fields of a chamfer mill.
const CONE: ConeKeys = ConeKeys {
    tip: "geometry.tip-diameter",
    largest: "geometry.DC",
    angle: "geometry.TA",
    height: "geometry.LCF",
};
/// Share by which a cutting speed may be off from that of speed and diameter, by rounding.
const ROUNDED: f64 = 0.02;
/// Most segments of a holder, and most presets of a tool.
const MOST_PARTS: usize = 1000;

/// Reads a library.
pub(super) fn read(file: &str, value: &Value) -> Result<Library> {
    let mut library = Library::of(file, LibraryFormat::Fusion);
    let data = value.get("data").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    if data.len() > MOST_TOOLS {
        return Err(too_many(data.len()).at(Location::whole_file(file)).into());
    }
    let mut shelf = Shelf::default();
    for entry in data {
        if entry.get("type").and_then(Value::as_str) == Some("holder") {
            let name = entry.get("description").and_then(Value::as_str).unwrap_or_default();
            library.dropped.push(format!("holder `{}` without a tool", name.escape_debug()));
        } else {
            library.tools.push(tool(entry, &mut shelf));
        }
    }
    library.holders = shelf.holders();
    Ok(library)
}

fn tool(entry: &Value, shelf: &mut Shelf) -> LibraryTool {
    let mut fields = Fields::new(entry);
    let number = fields.number("post-process.number").filter(|n| *n >= 1.0 && *n <= 1e9 && n.fract() == 0.0);
    let mut tool = LibraryTool::of(ToolTable::bare(number.unwrap_or(0.0) as u32));
    if number.is_none() {
        tool.lacks("number", "no post-process.number");
    }
    let said = fields.text("description").or_else(|| fields.text("product-id")).unwrap_or_default();
    let (name, changed) = fit_name(said);
    tool.table.name = name;
    let unit = unit_of(&mut fields, "unit", "expressions.tool_unit");
    if unit.is_none() {
        tool.lacks("unit", "the file does not say what its lengths are counted in");
    }
    let unit = unit.unwrap_or(1.0);
    kind(&mut tool, &mut fields, unit);
    sizes(&mut tool, &mut fields, unit);
    holder(&mut tool, &mut fields, unit, shelf);
    presets(&mut tool, &mut fields, unit);
    tool.dropped.extend(fields.left().shown(""));
    if changed {
        tool.dropped.push("the end of description".to_owned());
    }
    tool
}

/// The unit of an object in mm.
fn unit_of(fields: &mut Fields<'_>, path: &str, expression: &str) -> Option<f64> {
    let word = fields.text(path).or_else(|| fields.text(expression))?;
    match word.trim_matches('\'') {
        "millimeters" => Some(1.0),
        "inches" => Some(25.4),
        _ => None,
    }
}

/// Type, and what belongs to it alone.
fn kind(tool: &mut LibraryTool, fields: &mut Fields<'_>, unit: f64) {
    let word = fields.look("type").and_then(Value::as_str).unwrap_or_default();
    let kind = match word {
        "flat end mill" => ToolType::EndMill,
        "ball end mill" => ToolType::BallNose,
        "bull nose end mill" => ToolType::BullNose,
        "face mill" => ToolType::FaceMill,
        "chamfer mill" => ToolType::Tapered,
        "drill" | "spot drill" => ToolType::Drill,
        "tap right hand" | "tap left hand" => ToolType::Tap,
        other => {
            return tool.lacks("type", format!("`{}` is not taken", other.escape_debug()));
        }
    };
    fields.take("type");
    tool.table.kind = kind;
    match kind {
        ToolType::BallNose => {
            let radius = fields.look("geometry.RE").and_then(Value::as_f64);
            let diameter = fields.look("geometry.DC").and_then(Value::as_f64);
            // Half the diameter says nothing new.
            if radius.zip(diameter).is_some_and(|(r, d)| (2.0 * r - d).abs() <= 1e-3 * d) {
                fields.take("geometry.RE");
            }
        }
        ToolType::BullNose => {
            tool.table.corner_radius = fields.number("geometry.RE").map(|r| r * unit);
            if tool.table.corner_radius.is_none() {
                tool.lacks("corner_radius", "no geometry.RE");
            }
        }
        ToolType::FaceMill => {
            tool.table.corner_radius = fields.number("geometry.RE").map(|r| r * unit);
            if fields.look("geometry.TA").is_some() {
                tool.lacks("entering_angle", "readers do not agree on the geometry.TA of face mills");
            }
        }
        ToolType::Drill => match fields.number("geometry.SIG") {
            Some(angle) => tool.table.point_angle = Some(angle.to_radians()),
            None => tool.lacks("point_angle", "no geometry.SIG"),
        },
        ToolType::Tap => {
            tool.table.hand = if word == "tap left hand" { Hand::Left } else { Hand::Right };
            match fields.look("geometry.TP").filter(|_| unit == 1.0).and_then(Value::as_f64) {
                Some(pitch) => {
                    tool.table.pitch = Some(pitch);
                    fields.take("geometry.TP");
                }
                None if unit == 1.0 => tool.lacks("pitch", "no geometry.TP"),
                None => tool.lacks("pitch", "readers do not agree on the unit of geometry.TP in inches"),
            }
        }
        ToolType::EndMill | ToolType::Tapered | ToolType::ThreadMill => {}
    }
}

/// Lengths, teeth, hand.
fn sizes(tool: &mut LibraryTool, fields: &mut Fields<'_>, unit: f64) {
    let mut length = |path: &str| fields.number(path).map(|v| v * unit);
    let stated = length("geometry.DC");
    let (cutting, tip) = (length("geometry.LCF"), length("geometry.tip-diameter"));
    tool.table.stickout = length("geometry.LB");
    tool.table.shank_diameter = length("geometry.SFDM");
    let diameter = expressed(tool, fields, stated);
    match diameter {
        Some(diameter) => tool.table.diameter = diameter,
        None => tool.lacks("diameter", "no geometry.DC"),
    }
    match cutting {
        Some(cutting) => tool.table.flute_length = cutting,
        None => tool.lacks("flute_length", "no geometry.LCF"),
    }
    if tool.table.kind == ToolType::Tapered && tool.has("type") {
        let half = fields.number("geometry.TA").filter(|a| *a > 0.0 && *a < 90.0);
        // A number of 0 is a sharp tip that the file states.
        let sharp = fields.there("geometry.tip-diameter").and_then(Value::as_f64) == Some(0.0);
        let tip = tip.or(sharp.then_some(0.0));
        cone(tool, tip, half, &CONE);
    } else if let Some(tip) = tip {
        tool.dropped.push(format!("geometry.tip-diameter ({tip} mm)"));
    }
    let teeth = fields.look("geometry.NOF").and_then(Value::as_u64).and_then(|n| u32::try_from(n).ok());
    if let Some(teeth) = teeth {
        tool.table.teeth = Some(teeth);
        fields.take("geometry.NOF");
    }
    // The type of a tap says its hand.
    if tool.table.kind != ToolType::Tap && entry_says_left(fields) {
        tool.table.hand = Hand::Left;
    }
    fields.take("geometry.HAND");
}

/// Whether `geometry.HAND` is there and false.
fn entry_says_left(fields: &Fields<'_>) -> bool {
    fields.there("geometry.HAND").and_then(Value::as_bool) == Some(false)
}

/// The diameter [mm]: an expression counts before the number that it was once worth.
fn expressed(tool: &mut LibraryTool, fields: &mut Fields<'_>, stated: Option<f64>) -> Option<f64> {
    let text = fields.look("expressions.tool_diameter").and_then(Value::as_str).unwrap_or_default();
    let Some(Quantity::Length(length)) = quantity(text) else { return stated };
    fields.take("expressions.tool_diameter");
    if let Some(stated) = stated.filter(|stated| (stated - length).abs() > 1e-6 * length.abs()) {
        tool.dropped.push(format!("geometry.DC ({stated} mm: the expression says {length} mm)"));
    }
    Some(length)
}

/// The holder of the tool: segments from the tool upwards, in a unit of their own.
fn holder(tool: &mut LibraryTool, fields: &mut Fields<'_>, unit: f64, shelf: &mut Shelf) {
    let assembly = fields.look("geometry.assemblyGaugeLength").and_then(Value::as_f64);
    let Some(segments) = fields.look("holder.segments").and_then(Value::as_array) else { return };
    let Some(own) = unit_of(fields, "holder.unit", "holder.expressions.tool_unit") else {
        return tool.dropped.push("holder (it has no unit)".to_owned());
    };
    let size = |segment: &Value, key: &str| segment.get(key).and_then(Value::as_f64).map(|v| v * own);
    let one = |segment: &Value| {
        Some(HolderSegment {
            height: size(segment, "height")?,
            lower_diameter: size(segment, "lower-diameter")?,
            upper_diameter: Some(size(segment, "upper-diameter")?),
        })
    };
    let segments: Option<Vec<HolderSegment>> = segments.iter().take(MOST_PARTS).map(one).collect();
    let Some(segments) = segments.filter(|all| !all.is_empty()) else {
        return tool.dropped.push("holder.segments (not as numbers)".to_owned());
    };
    fields.take("holder.segments");
    fields.take("holder.type");
    let said = fields.text("holder.description").or_else(|| fields.text("holder.product-id"));
    let name = fit_name(said.unwrap_or("holder")).0.unwrap_or_else(|| "holder".to_owned());
    tool.table.holder = Some(shelf.name(&name, segments));
    let gauge = fields.number("holder.gaugeLength").map(|v| v * own);
    if let Some(assembly) = assembly {
        fields.take("geometry.assemblyGaugeLength");
        tool.table.gauge_length = Some(assembly * unit);
    } else if let Some((gauge, stickout)) = gauge.zip(tool.table.stickout) {
        tool.table.gauge_length = Some(gauge + stickout);
    }
}

/// Cutting data by material. A cutting speed is taken where it is that of speed and diameter in m/min, so that its unit is known;
/// never that of a cone, which belongs to its largest diameter: an operation reckons with that at the top of its chamfer.
fn presets(tool: &mut LibraryTool, fields: &mut Fields<'_>, unit: f64) {
    let Some(list) = fields.take("start-values.presets").and_then(Value::as_array) else { return };
    let diameter = fields.look("geometry.DC").and_then(Value::as_f64).map(|d| d * unit);
    let is_cone = tool.table.kind == ToolType::Tapered;
    let (mut left, mut unnamed) = (Left::default(), false);
    for preset in list.iter().take(MOST_PARTS) {
        let mut own = Fields::new(preset);
        let name = own.text("name").and_then(|name| fit_name(name).0);
        let material = own.text("material.query").and_then(|name| fit_name(name).0).or_else(|| name.clone());
        let Some(material) = material else {
            unnamed = true;
            continue;
        };
        let positive = |v: &f64| *v > 0.0;
        let turns = own.number("n").filter(positive);
        let cutting = own.look("v_c").and_then(Value::as_f64).filter(positive);
        let by_turns = turns.zip(diameter).map(|(n, d)| std::f64::consts::PI * d * n / 1000.0);
        let same = cutting.zip(by_turns).is_some_and(|(v, by)| (v - by).abs() <= ROUNDED * by) && !is_cone;
        if same {
            own.take("v_c");
        }
        let per_rev = own.look("use-feed-per-revolution").is_some();
        own.take("use-feed-per-revolution");
        tool.table.presets.push(PresetTable {
            name: name.filter(|name| *name != material),
            material,
            cutting_speed: cutting.filter(|_| same),
            speed: turns.filter(|_| !same),
            feed_per_tooth: own.number("f_z").filter(positive).map(|v| v * unit),
            feed_per_rev: per_rev.then(|| own.number("f_n")).flatten().filter(positive).map(|v| v * unit),
            feed: own.number("v_f").filter(positive).map(|v| v * unit),
        });
        left.add(&own);
    }
    tool.dropped.extend(left.shown("start-values.presets."));
    if unnamed {
        tool.dropped.push("start-values.presets without a material".to_owned());
    }
    if list.len() > MOST_PARTS && list[MOST_PARTS..].iter().any(says) {
        tool.dropped.push(format!("start-values.presets beyond {MOST_PARTS}"));
    }
}
