//! Machines from the configuration of LinuxCNC: its INI file and HAL files.
//!
//! A kinematics module is read as a chain of joints, never as its formulas: the chain is the same for forward, inverse
//! and drawing, where the modules hold each for itself and some disagree with themselves. The meaning of each module,
//! with the senses of its rotary axes, is in `module`; it was computed from the sources of LinuxCNC 2.9 and is tested
//! against their formulas.
//!
//! Nothing is taken in silence: every line of the files is reported as used or ignored, every missing value with what
//! is taken in its place.

mod hal;
mod ini;
mod limits;
mod module;

use serde::Serialize;

use super::{CoordinateCode, Machine};
use crate::base::{Code, Error, FileId, Finding, Result, Sources, Span};
use hal::Hal;
use ini::Ini;

/// Fate of a line.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fate {
    /// Its value went into the machine; its use, in words.
    Used(String),
    /// It says nothing about the chain of axes, or cannot be kept; the reason, in words.
    Ignored(String),
}

/// A line of a configuration, with its fate.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ImportedLine {
    /// Name of the file.
    pub file: String,
    /// Line, 1-based.
    pub line: u32,
    /// The line, with its section before a key.
    pub text: String,
    /// Fate of the line.
    pub fate: Fate,
}

/// A value that no line gives.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct MissingValue {
    /// Name of the value.
    pub name: String,
    /// The value taken in its place, in words.
    pub instead: String,
}

/// A machine from a configuration; as JSON all but the machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Import {
    /// The machine.
    #[serde(skip)]
    pub machine: Machine,
    /// Every line of the files that says something, in order.
    pub lines: Vec<ImportedLine>,
    /// Values that no line gives.
    pub missing: Vec<MissingValue>,
    /// The kinematics module.
    pub module: String,
    /// Remarks on this module, for the user.
    pub remarks: Vec<String>,
}

/// Names of the HAL files that an INI file names, as it spells them; those of LinuxCNC's own library (`LIB:`) and
/// scripts in TCL are left out.
pub fn hal_files(ini: &str) -> Vec<String> {
    let mut sources = Sources::default();
    let id = sources.add("", ini);
    let Ok(ini) = Ini::read(&sources, id) else { return Vec::new() };
    let named = ini.all("HAL", "HALFILE").chain(ini.all("HAL", "POSTGUI_HALFILE"));
    let names = named.filter_map(|entry| entry.value.split_whitespace().next());
    names.filter(|n| !n.starts_with("LIB:") && n.ends_with(".hal")).map(str::to_owned).collect()
}

/// Reads a machine from an INI file and HAL files, each a name and a text; `code` is the coordinate code for modules that
/// do not tell which axis carries which (trivkins).
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::linuxcnc::import;
/// let ini = "[KINS]\nKINEMATICS = xyzac-trt-kins\n[TRAJ]\nCOORDINATES = XYZAC\nLINEAR_UNITS = mm\n\
///            [HAL]\nHALCMD = setp xyzac-trt-kins.y-offset 20\n";
/// let import = import(("mill.ini", ini), &[], None).unwrap();
/// assert_eq!(import.machine.code.to_string(), "641203");
/// assert_eq!(import.machine.joint('A').unwrap().1.point.y, 20.0);
/// assert_eq!(import.machine.joint('C').unwrap().1.sense, -1.0); // the module's default sense is against ISO 841
/// ```
///
/// # Errors
/// `KC1141` for a text that is no INI file, a module that is not known or is refused, a missing or wrong value, each with
/// its place; `KC0702`, `KC0703` when the code is not one of these axes.
pub fn import(ini: (&str, &str), hal: &[(&str, &str)], code: Option<&CoordinateCode>) -> Result<Import> {
    let mut sources = Sources::default();
    let id = sources.add(ini.0, ini.1);
    let hal_ids: Vec<FileId> = hal.iter().map(|(name, text)| sources.add(*name, *text)).collect();
    let mut reading = Reading {
        ini: Ini::read(&sources, id)?,
        hal: Hal::default(),
        sources: &sources,
        missing: Vec::new(),
        remarks: Vec::new(),
    };
    reading.hal = Hal::read(&sources, &hal_ids, &mut reading.ini);
    let (module, mut machine, letters) = module::machine(&mut reading, code)?;
    limits::apply(&mut reading, &mut machine, &letters)?;
    if let Some(name) = reading.ini.take("EMC", "MACHINE", "name") {
        machine.name = name.value.chars().filter(|c| !c.is_control()).take(120).collect();
    }
    machine.check()?;
    let Reading { ini, hal, missing, remarks, .. } = reading;
    let mut lines = ini.lines(&sources);
    lines.extend(hal.lines(&sources));
    Ok(Import { machine, module, lines, missing, remarks })
}

/// A configuration while it is read.
struct Reading<'a> {
    ini: Ini,
    hal: Hal,
    sources: &'a Sources,
    missing: Vec<MissingValue>,
    remarks: Vec<String>,
}

impl Reading<'_> {
    fn missing(&mut self, name: impl Into<String>, instead: impl Into<String>) {
        self.missing.push(MissingValue { name: name.into(), instead: instead.into() });
    }

    /// A value of a pin in the units of the configuration, or `default`, which is then reported.
    fn pin(&mut self, module: &str, pin: &str, default: f64, what: &str) -> Result<f64> {
        match self.hal.take(module, pin, what) {
            None => {
                self.missing(format!("HAL pin {module}.{pin}"), format!("{default}, the module's default"));
                Ok(default)
            }
            Some((text, span)) => number(self.sources, &text, span, pin),
        }
    }
}

/// A number of a configuration.
fn number(sources: &Sources, text: &str, span: Span, what: &str) -> Result<f64> {
    let value = match text.to_ascii_lowercase().as_str() {
        "true" => Some(1.0),
        "false" => Some(0.0),
        other => other.parse::<f64>().ok().filter(|v| v.is_finite()),
    };
    value.ok_or_else(|| wrong(sources, span, format!("`{text}` of {what} is not a number")))
}

fn wrong(sources: &Sources, span: Span, message: String) -> Error {
    Finding::error(Code::MACHINE_IMPORT, message).at(sources.locate(span)).into()
}
