//! A machine in words: its code, its axes at home, what of a configuration was used.

mod drawn;
mod wants;

use std::borrow::Cow;

use serde::Serialize;

use super::Answer;
use super::poses::{number, triple};
use crate::base::{Finding, Result};
use crate::geom::{Rigid, Solid};
use crate::job::machine::Loaded;
use crate::job::machine::write::link_name;
use crate::machine::linuxcnc::{Fate, Import, ImportedLine};
use crate::machine::{Body, Joint, Machine, Preset, presets};
use crate::page::{Block, Cell, Fact, Row, Section, Table};

pub(crate) use drawn::rows;
pub use drawn::{Drawn, DrawnBody, LinkMotion, MachinePose, drawn, pose};
pub use wants::MachineWants;

/// An axis in the units of the shop.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AxisSheet {
    /// Letter.
    pub axis: char,
    /// Digit of the code.
    pub digit: u8,
    /// Whether it carries the work.
    pub work_side: bool,
    /// Whether it turns.
    pub rotary: bool,
    /// Direction at home.
    pub direction: [f64; 3],
    /// A point of the axis of a rotation at home [mm].
    pub point: Option<[f64; 3]>,
    /// Sense of the control's values.
    pub sense: f64,
    /// Least and greatest position [mm or deg].
    pub travel: Option<[f64; 2]>,
    /// Rapid speed [mm/min or rev/min].
    pub rapid: Option<f64>,
    /// Acceleration [m/s2 or deg/s2].
    pub acceleration: Option<f64>,
    /// Jerk [m/s3 or deg/s3].
    pub jerk: Option<f64>,
}

/// A body of a machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodySheet {
    /// Its name; may be empty.
    pub name: String,
    /// The link that carries it: "bed", or an axis.
    pub link: String,
    /// "box", "cylinder" or "mesh".
    pub form: &'static str,
    /// The mesh file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Least corner of the box about it with all axes at zero [mm].
    pub min: [f64; 3],
    /// Greatest corner of that box [mm].
    pub max: [f64; 3],
}

/// A machine in the units of the shop.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MachineSheet {
    /// Name.
    pub name: String,
    /// Digits of the code.
    pub code: String,
    /// The chain as ISO 10791 writes it.
    pub iso: String,
    /// The code's canonical form, without the bed: machines of one form move the same.
    pub canonical: String,
    /// The axes from workpiece to tool.
    pub axes: Vec<AxisSheet>,
    /// The gauge point at home [mm].
    pub spindle_point: [f64; 3],
    /// Direction of the spindle at home, from tool into spindle.
    pub spindle_direction: [f64; 3],
    /// Whether the table's frame is that of the machine.
    pub work_at_machine: bool,
    /// Bodies of its links.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<BodySheet>,
}

impl MachineSheet {
    /// The sheet of a machine.
    pub fn of(machine: &Machine) -> MachineSheet {
        let bed = machine.code.bed();
        MachineSheet {
            name: machine.name.clone(),
            code: machine.code.to_string(),
            iso: machine.code.iso(),
            canonical: machine.code.word().canonical().to_string(),
            axes: machine.joints.iter().enumerate().map(|(i, j)| axis(j, i < bed)).collect(),
            spindle_point: machine.spindle.translation.to_array(),
            spindle_direction: machine.spindle.rotation.z_axis.to_array(),
            work_at_machine: machine.work == Rigid::IDENTITY,
            bodies: machine.bodies.iter().map(|b| body(machine, b)).collect(),
        }
    }

    /// As a person reads it.
    fn section(&self) -> Section {
        let spindle = format!("at {} along {}", triple(self.spindle_point), triple(self.spindle_direction));
        let facts = vec![
            Fact::new("ISO 10791", self.iso.as_str()),
            Fact::new("Canonical form", self.canonical.as_str()),
            Fact::new("Spindle", spindle),
        ];
        let heads = "Axis; Motion; Direction; Through; Sense; Travel";
        let axis = |a: &AxisSheet| {
            let unit = if a.rotary { "deg" } else { "mm" };
            let travel = a.travel.map(|[min, max]| format!("{} .. {} {unit}", number(min), number(max)));
            row([
                format!("{}{}", a.axis, if a.work_side { "'" } else { "" }),
                if a.rotary { "about" } else { "along" }.to_owned(),
                triple(a.direction),
                a.point.map_or_else(String::new, triple),
                if a.sense < 0.0 { "against ISO 841" } else { "" }.to_owned(),
                travel.unwrap_or_default(),
            ])
        };
        let mut section = Section::new(format!("{} {}", self.code, self.name).trim_end())
            .with(Block::Facts(facts))
            .with(Table::new("Axes from workpiece to tool, at home", heads).rows(self.axes.iter().map(axis)));
        if !self.bodies.is_empty() {
            let heads = "On; Name; Form; File; From; To";
            let body = |b: &BodySheet| {
                let (file, form) = (b.file.clone().unwrap_or_default(), b.form.to_owned());
                row([b.link.clone(), b.name.clone(), form, file, triple(b.min), triple(b.max)])
            };
            section = section.with(Table::new("Bodies", heads).rows(self.bodies.iter().map(body)));
        }
        section
    }
}

fn row<const N: usize>(cells: [String; N]) -> Row {
    Row::new(cells.map(Cell::new).to_vec())
}

fn body(machine: &Machine, body: &Body) -> BodySheet {
    let bounds = body.bounds();
    BodySheet {
        name: body.name.clone(),
        link: link_name(machine, body.link),
        form: match body.solid {
            Solid::Box(_) => "box",
            Solid::Cylinder { .. } => "cylinder",
            Solid::Mesh(_) => "mesh",
        },
        file: body.file.clone(),
        min: bounds.min.to_array(),
        max: bounds.max.to_array(),
    }
}

fn axis(j: &Joint, work_side: bool) -> AxisSheet {
    let rotary = j.motion.is_rotation();
    let unit = |v: f64| if rotary { v.to_degrees() } else { v };
    let [speed, change] =
        if rotary { [60.0 / std::f64::consts::TAU, 1f64.to_degrees()] } else { [60.0, 1e-3] };
    AxisSheet {
        axis: j.letter,
        digit: j.motion.digit(),
        work_side,
        rotary,
        direction: j.direction.to_array(),
        point: rotary.then(|| j.point.to_array()),
        sense: j.sense,
        travel: j.travel.map(|t| t.map(unit)),
        rapid: j.dynamics.rapid.map(|v| v * speed),
        acceleration: j.dynamics.acceleration.map(|v| v * change),
        jerk: j.dynamics.jerk.map(|v| v * change),
    }
}

/// A machine, and what of a configuration it was read from.
#[derive(Clone, Debug, Serialize)]
pub struct MachineAnswer {
    /// The machine.
    #[serde(flatten)]
    pub sheet: MachineSheet,
    /// Use of the lines of a configuration of LinuxCNC.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub import: Option<Import>,
    /// The machine at positions of its axes, if they are given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pose: Option<MachinePose>,
    /// Its bodies with their faces, if they are wanted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drawn: Option<Drawn>,
    /// A drawing, if it is wanted.
    #[serde(skip)]
    pub svg: String,
}

impl MachineAnswer {
    /// The answer about a machine as it was loaded.
    pub fn of(loaded: Loaded) -> MachineAnswer {
        MachineAnswer {
            sheet: MachineSheet::of(&loaded.machine),
            import: loaded.import,
            pose: None,
            drawn: None,
            svg: String::new(),
        }
    }
}

impl Answer for MachineAnswer {
    fn sections(&self) -> Vec<Section> {
        let sheet = std::iter::once(self.sheet.section());
        sheet.chain(self.import.as_ref().map(imported)).chain(self.pose.as_ref().map(posed)).collect()
    }

    fn findings(&self) -> Vec<&Finding> {
        self.pose.iter().flat_map(|pose| &pose.findings).collect()
    }

    /// A position beyond its travel is an answer that says no.
    fn is_no(&self) -> bool {
        !self.findings().is_empty()
    }

    fn svg(&self) -> Result<String> {
        Ok(self.svg.clone())
    }
}

/// A machine as a machine file.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct MachineFile {
    /// The text.
    pub toml: String,
    /// A drawing, if it is wanted.
    #[serde(skip)]
    pub svg: String,
}

impl Answer for MachineFile {
    fn sections(&self) -> Vec<Section> {
        Vec::new()
    }

    fn data(&self) -> Cow<'_, str> {
        Cow::Borrowed(&self.toml)
    }

    fn svg(&self) -> Result<String> {
        Ok(self.svg.clone())
    }
}

/// The machines known by name.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct KnownMachines(Vec<KnownMachine>);

#[derive(Clone, Debug, Serialize)]
struct KnownMachine {
    code: &'static str,
    name: &'static str,
    note: &'static str,
}

impl KnownMachines {
    /// All of them.
    pub fn all() -> KnownMachines {
        let one = |p: &Preset| KnownMachine { code: p.code, name: p.name, note: p.note };
        KnownMachines(presets().iter().map(one).collect())
    }
}

impl Answer for KnownMachines {
    fn sections(&self) -> Vec<Section> {
        let one = |m: &KnownMachine| row([m.name, m.code, m.note].map(str::to_owned));
        vec![Section::default().with(Table::new("", "Name; Code; Machine").rows(self.0.iter().map(one)))]
    }
}

fn posed(pose: &MachinePose) -> Section {
    let facts = vec![Fact::new("tip", triple(pose.tip)), Fact::new("axis", triple(pose.axis))];
    Section::new(pose.joints.words()).with(Block::Facts(facts))
}

/// Use of each line of a configuration: the used ones first, the others last.
fn imported(import: &Import) -> Section {
    let line =
        |word: &str, l: &ImportedLine, why: &str| format!("{word} {}:{}: {} ({why})", l.file, l.line, l.text);
    let used = import.lines.iter().filter_map(|l| match &l.fate {
        Fate::Used(what) => Some(line("used", l, what)),
        Fate::Ignored(_) => None,
    });
    let ignored = import.lines.iter().filter_map(|l| match &l.fate {
        Fate::Ignored(why) => Some(line("ignored", l, why)),
        Fate::Used(_) => None,
    });
    let missing = import.missing.iter().map(|m| format!("missing {}: {}", m.name, m.instead));
    let remarks = import.remarks.iter().map(|remark| format!("note: {remark}"));
    let lines = used.chain(missing).chain(remarks).chain(ignored).collect();
    Section::new(format!("From {}", import.module)).with(Block::List(lines))
}
