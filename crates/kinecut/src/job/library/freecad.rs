//! Tool bits of FreeCAD (`.fctb`) and its tool libraries (`.fctl`), which give bits their numbers.
//!
//! Values are texts with units. The angle of V-bits and chamfer mills is the whole one. A bull-nose mill of an older file has the
//! radius of its flat, or that of its torus.

use serde_json::Value;

use super::cone::{ConeKeys, cone};
use super::fields::{Fields, fit_name};
use super::own::too_many;
use super::quantity::{Quantity, quantity};
use super::{Library, LibraryFormat, LibraryTool, MOST_TOOLS};
use crate::base::{Code, FileKind, Finding, Loader, Location, Result};
use crate::job::file::{ToolTable, ToolType};
use crate::tool::Hand;

/// The fields of V-bits and chamfer mills.
const CONE: ConeKeys = ConeKeys {
    tip: "TipDiameter",
    largest: "Diameter",
    angle: "CuttingEdgeAngle",
    height: "CuttingEdgeHeight",
};

/// Reads a bit in a file of its own: it has no number.
pub(super) fn bit_file(file: &str, value: &Value) -> Result<Library> {
    let mut library = Library::of(file, LibraryFormat::FreeCadBit);
    let mut tool = bit(value, 0);
    tool.lacks("number", "a tool bit has none: give it by tools = { file, number }");
    library.tools.push(tool);
    Ok(library)
}

/// Reads a library; its bits come through `loader`. A bit that is not there is a tool without anything.
pub(super) fn library(file: &str, value: &Value, loader: &dyn Loader) -> Result<Library> {
    let mut library = Library::of(file, LibraryFormat::FreeCadLibrary);
    let entries = value.get("tools").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    if entries.len() > MOST_TOOLS {
        return Err(too_many(entries.len()).at(Location::whole_file(file)).into());
    }
    for (i, entry) in entries.iter().enumerate() {
        let wrong = |what: String| {
            let finding = Finding::error(Code::TOOL_FILE, what).at(Location::whole_file(file));
            finding.key(format!("tools[{i}]")).help("an entry is { \"nr\": 1, \"path\": \"bit.fctb\" }")
        };
        let Some(path) = entry.get("path").and_then(Value::as_str) else {
            return Err(wrong(format!("entry {} of the library names no tool bit", i + 1)).into());
        };
        let number = entry.get("nr").and_then(Value::as_u64).and_then(|n| u32::try_from(n).ok());
        let Some(number) = number else {
            return Err(wrong(format!("entry {} of the library has no number", i + 1)).into());
        };
        library.tools.push(match found(file, path, loader) {
            Ok((name, value)) => {
                library.files.push(name);
                bit(&value, number)
            }
            Err(why) => {
                let mut tool = LibraryTool::of(ToolTable::bare(number));
                tool.table.name = fit_name(path).0;
                for key in ["type", "diameter", "flute_length"] {
                    tool.lacks(key, why.clone());
                }
                tool
            }
        });
    }
    Ok(library)
}

/// The bit of a path: it counts from the folder `Bit` beside that of the library, or from that of the library.
fn found(file: &str, path: &str, loader: &dyn Loader) -> std::result::Result<(String, Value), String> {
    let path = path.replace('\\', "/");
    let folder = file.rsplit_once('/').map(|(folder, _)| folder);
    let in_folder = |folder: Option<&str>, rest: &str| match folder {
        Some(folder) if !folder.is_empty() => format!("{folder}/{rest}"),
        _ => rest.to_owned(),
    };
    let above = folder.map(|folder| folder.rsplit_once('/').map(|(above, _)| above));
    let beside = above.map(|above| in_folder(above, &format!("Bit/{path}")));
    let places = [beside, Some(in_folder(folder, &path)), Some(in_folder(folder, &format!("Bit/{path}")))];
    for name in places.into_iter().flatten() {
        if loader.read_as(&name, FileKind::Text).is_err() {
            continue;
        }
        let text = loader.read_text(&name).map_err(|e| e.0.message.clone())?;
        let value: Value = serde_json::from_str(text.trim_start_matches('\u{feff}'))
            .map_err(|e| format!("`{name}` is broken: {e}"))?;
        return Ok((name, value));
    }
    Err(format!("the tool bit `{}` cannot be read", path.escape_debug()))
}

/// Numbers of a bit, each taken from `parameter`, or else from `attribute`.
struct Bit<'a> {
    fields: Fields<'a>,
    /// Lengths and angles without a unit, in words.
    bare: Vec<String>,
    bare_angles: Vec<String>,
    wrong: Vec<String>,
}

impl Bit<'_> {
    fn take(&mut self, key: &str) -> Option<Quantity> {
        for path in [format!("parameter.{key}"), format!("attribute.{key}")] {
            let Some(value) = self.fields.look(&path) else { continue };
            let number = value.as_f64().map(Quantity::Bare);
            let Some(read) = number.or_else(|| value.as_str().and_then(quantity)) else {
                self.fields.take(&path);
                self.wrong.push(format!("{path} (no number with a unit)"));
                return None;
            };
            self.fields.take(&path);
            return Some(read);
        }
        None
    }

    /// A length other than 0 [mm]; a number alone is one in mm, and said.
    fn length(&mut self, key: &str) -> Option<f64> {
        self.stated(key).filter(|length| *length != 0.0)
    }

    /// A length, 0 as a text too [mm].
    fn stated(&mut self, key: &str) -> Option<f64> {
        Some(match self.take(key)? {
            Quantity::Length(length) => length,
            Quantity::Bare(length) => {
                self.bare.push(format!("{key} as {length} mm"));
                length
            }
            Quantity::Angle(_) => {
                self.wrong.push(format!("{key} (an angle)"));
                return None;
            }
        })
    }

    /// Whether a key is a number of 0, which says nothing of most keys.
    fn is_nought(&self, key: &str) -> bool {
        [format!("parameter.{key}"), format!("attribute.{key}")]
            .iter()
            .any(|path| self.fields.there(path).and_then(Value::as_f64) == Some(0.0))
    }

    /// An angle (degrees).
    fn angle(&mut self, key: &str) -> Option<f64> {
        match self.take(key)? {
            Quantity::Angle(angle) => Some(angle),
            Quantity::Bare(angle) => {
                self.bare_angles.push(format!("{key} as {angle} degrees"));
                Some(angle)
            }
            Quantity::Length(_) => {
                self.wrong.push(format!("{key} (a length)"));
                None
            }
        }
    }
}

/// The tool of a bit.
fn bit(value: &Value, number: u32) -> LibraryTool {
    let mut bit =
        Bit { fields: Fields::new(value), bare: Vec::new(), bare_angles: Vec::new(), wrong: Vec::new() };
    let mut tool = LibraryTool::of(ToolTable::bare(number));
    let name = bit.fields.text("name").or_else(|| bit.fields.text("label")).unwrap_or_default();
    let (name, changed) = fit_name(name);
    tool.table.name = name;
    let shape = shape_of(&mut bit.fields);
    let kind = match shape.as_str() {
        "endmill" => Some(ToolType::EndMill),
        "ballend" => Some(ToolType::BallNose),
        "bullnose" | "torus" => Some(ToolType::BullNose),
        "vbit" | "chamfer" => Some(ToolType::Tapered),
        "drill" => Some(ToolType::Drill),
        "tap" => Some(ToolType::Tap),
        _ => None,
    };
    match kind {
        Some(kind) => tool.table.kind = kind,
        None => tool.lacks("type", format!("the shape `{}` is not taken", shape.escape_debug())),
    }
    match bit.length("Diameter") {
        Some(diameter) => tool.table.diameter = diameter,
        None => tool.lacks("diameter", "no Diameter"),
    }
    let flutes = bit.length("CuttingEdgeHeight").or_else(|| bit.length("CuttingEdgeLength"));
    match flutes {
        Some(flutes) => tool.table.flute_length = flutes,
        None => tool.lacks("flute_length", "no CuttingEdgeHeight"),
    }
    tool.table.shank_diameter = bit.length("ShankDiameter");
    tool.table.stickout = bit.length("Stickout");
    if let Some(teeth) = bit.take("Flutes") {
        match teeth {
            Quantity::Bare(teeth) if (1.0..=1000.0).contains(&teeth) && teeth.fract() == 0.0 => {
                tool.table.teeth = Some(teeth as u32);
            }
            _ => bit.wrong.push("Flutes (no whole number)".to_owned()),
        }
    }
    match kind {
        Some(ToolType::BullNose) => corner(&mut tool, &mut bit),
        Some(ToolType::Tapered) => {
            let tip = bit.stated("TipDiameter").or(bit.is_nought("TipDiameter").then_some(0.0));
            let half = bit.angle("CuttingEdgeAngle").map(|a| a / 2.0).filter(|a| *a > 0.0 && *a < 90.0);
            cone(&mut tool, tip, half, &CONE);
        }
        Some(ToolType::Drill) => match bit.angle("TipAngle") {
            Some(angle) => tool.table.point_angle = Some(angle.to_radians()),
            None => tool.lacks("point_angle", "no TipAngle"),
        },
        Some(ToolType::Tap) => {
            tool.table.pitch = bit.length("Pitch");
            if tool.table.pitch.is_none() {
                tool.lacks("pitch", "no Pitch");
            }
        }
        _ => {}
    }
    hand(&mut tool, &mut bit.fields);
    let is_imperial = |path: &str| {
        let units = bit.fields.look(path).and_then(Value::as_str);
        units.is_some_and(|units| units.eq_ignore_ascii_case("imperial"))
    };
    if !bit.bare.is_empty() && ["parameter.Units", "attribute.Units"].into_iter().any(is_imperial) {
        tool.lacks("unit", "its Units are Imperial, and its numbers have none");
        bit.bare.clear();
    }
    for path in ["version", "id", "parameter.Units", "attribute.Units"] {
        // They say of the file, not of the tool.
        bit.fields.take(path);
    }
    tool.dropped.extend(bit.fields.left().shown(""));
    tool.dropped.extend(bit.wrong);
    if changed {
        tool.dropped.push("the end of name".to_owned());
    }
    tool.assumed.extend(bit.bare);
    tool.assumed.extend(bit.bare_angles);
    tool
}

/// The shape in small letters and without signs: that of `shape-type`, or the name of its file.
fn shape_of(fields: &mut Fields<'_>) -> String {
    let file = fields.text("shape").unwrap_or_default();
    let stem = file.rsplit(['/', '\\']).next().unwrap_or(file);
    let stem = stem.split('.').next().unwrap_or(stem);
    let word = fields.text("shape-type").unwrap_or(stem);
    word.chars().filter(char::is_ascii_alphanumeric).collect::<String>().to_ascii_lowercase()
}

/// The corner radius of a bull-nose mill.
fn corner(tool: &mut LibraryTool, bit: &mut Bit<'_>) {
    let direct = bit.length("CornerRadius").or_else(|| bit.length("TorusRadius"));
    let flat = if direct.is_none() { bit.length("FlatRadius") } else { None };
    let by_flat = flat.filter(|_| tool.has("diameter")).map(|flat| tool.table.diameter / 2.0 - flat);
    tool.table.corner_radius = direct.or(by_flat);
    if tool.table.corner_radius.is_none() {
        tool.lacks("corner_radius", "no CornerRadius");
    }
}

/// The hand, from the sense in which the spindle turns.
fn hand(tool: &mut LibraryTool, fields: &mut Fields<'_>) {
    for path in ["parameter.SpindleDirection", "attribute.SpindleDirection"] {
        match fields.look(path).and_then(Value::as_str) {
            Some("Forward") => _ = fields.take(path),
            Some("Reverse") => {
                fields.take(path);
                tool.table.hand = Hand::Left;
            }
            _ => {}
        }
    }
}
