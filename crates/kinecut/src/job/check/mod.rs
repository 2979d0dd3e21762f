//! From the job file to a checked job: every number finite and bounded, every name resolved, units turned into
//! those used inside (mm, s, rad).

mod body;
mod drill;
mod face;
pub(crate) mod machine;
pub(crate) mod numbers;
mod path;
mod point;
mod program;
mod setup;
mod step;
mod tool;

pub use drill::{DrillOperation, HolePlace};
pub use face::FaceOperation;
pub use path::PathOperation;
pub(super) use point::drill_point;
pub use program::JobProgram;
pub(super) use setup::{ABOVE_STOCK, corners};

use std::borrow::Cow;
use std::f64::consts::TAU;

use glam::DVec3;

use super::face::StockOutline;
use super::file::{
    BoreTable, CoolantName, DrilledTable, EllipseTable, JobFile, MachineEntry, OperationTable,
    OrientationName, StockTable,
};
use crate::base::{Code, Error, FileKind, Finding, Loader, Location, Result};
use crate::geom::{Aabb, Mesh, Rigid, Solid};
use crate::machine::Machine;
use crate::nc::{Control, PostSettings};
use crate::program::{Branch, Coolant, Setup, WorkOffset};
use crate::tool::Tool;

/// Largest length in a job [mm]: ten metres, beyond which it is a slip of the pen, and far within the range of the
/// stock's fixed point numbers.
pub const MAX_LENGTH: f64 = 10_000.0;

/// A checked job; mm, s, rad.
#[derive(Clone, Debug)]
pub struct Job {
    /// Title.
    pub title: String,
    /// How to write for the control.
    pub post: PostSettings,
    /// How the program says the directions of its tool.
    pub orientation: OrientationName,
    /// The machine, if given.
    pub machine: Option<Machine>,
    /// Tools by number.
    pub tools: Vec<Tool>,
    /// Raw stock [part coordinates].
    pub stock: Solid,
    /// Holes that the raw stock already has.
    pub drilled: Vec<Drilled>,
    /// The wanted part.
    pub design: Option<Design>,
    /// Distance of the lines of the stock model [mm].
    pub step: f64,
    /// Largest memory of the stock model [bytes].
    pub memory: u64,
    /// Clampings, in order.
    pub setups: Vec<JobSetup>,
}

/// A round hole along Z that the raw stock already has [part coordinates].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drilled {
    /// Centre of the lower end.
    pub base: DVec3,
    /// Diameter [mm].
    pub diameter: f64,
    /// Height [mm].
    pub height: f64,
}

/// The wanted part as a mesh.
#[derive(Clone, Debug)]
pub struct Design {
    /// Surface [part coordinates].
    pub mesh: Mesh,
    /// Largest allowed distance of the cut surface from it [mm].
    pub tolerance: f64,
}

/// A clamping with its operations.
#[derive(Clone, Debug)]
pub struct JobSetup {
    /// As the program knows it.
    pub setup: Setup,
    /// Its work offset.
    pub offset: WorkOffset,
    /// Height above the work zero between operations [mm].
    pub safe_height: f64,
    /// Height of the table above the work zero [mm], if it is known.
    pub table: Option<f64>,
    /// Depth to which a tool may go below the stock beside the length of its point [mm].
    pub breakthrough: f64,
    /// Operations.
    pub operations: Vec<Operation>,
    /// A program that others wrote, in place of operations.
    pub program: Option<JobProgram>,
}

impl JobSetup {
    /// Height above the work zero that is assumed for a retracted tool where the machine position is not known [mm].
    pub(crate) fn retract_height(&self) -> f64 {
        /// Distance above the safe height [mm].
        const RETRACTED_ABOVE_SAFE: f64 = 100.0;
        self.safe_height + RETRACTED_ABOVE_SAFE
    }

    /// Maps part coordinates into those of an operation: of its tilted plane, or of the work offset.
    pub fn to_operation(&self, operation: &Operation) -> Rigid {
        let placed = self.at(operation);
        let work = placed.setup.work_offsets.get(&placed.offset).copied().unwrap_or(Rigid::IDENTITY);
        work.inverse().after(&placed.setup.part_on_table)
    }

    /// The setup as an operation sees it: with its tilted plane in the place of the work offset.
    pub fn at(&self, operation: &Operation) -> Cow<'_, JobSetup> {
        let Some(plane) = operation.milling().plane else { return Cow::Borrowed(self) };
        let mut setup = JobSetup { operations: Vec::new(), ..self.clone() };
        for work in setup.setup.work_offsets.values_mut() {
            *work = work.after(&plane.motion);
        }
        setup.safe_height = plane.safe_height;
        Cow::Owned(setup)
    }
}

/// An operation of a job.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Operation {
    /// Milling of a bore.
    Bore(BoreOperation),
    /// Milling of an elliptic pocket.
    Ellipse(EllipseOperation),
    /// Drilling.
    Drill(Box<DrillOperation>),
    /// Milling of a face.
    Face(Box<FaceOperation>),
    /// A tool path that comes from elsewhere.
    Path(Box<PathOperation>),
}

/// What every milling operation has.
#[derive(Clone, Debug)]
pub struct Milling {
    /// The tool.
    pub tool: Tool,
    /// Spindle speed [rad/s].
    pub spindle: f64,
    /// Coolant.
    pub coolant: Coolant,
    /// Largest allowed deviation of wall and floor [mm].
    pub tolerance: f64,
    /// The tilted plane, if it works in one.
    pub plane: Option<JobPlane>,
}

/// A tilted plane of an operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JobPlane {
    /// Maps coordinates of the plane into those of the work offset.
    pub motion: Rigid,
    /// Choice of the rotary axes.
    pub branch: Branch,
    /// Height above the plane between operations [mm].
    pub safe_height: f64,
}

/// Milling of a bore.
#[derive(Clone, Debug)]
pub struct BoreOperation {
    /// As written: the planner's own checks work on it.
    pub table: BoreTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
}

/// Milling of an elliptic pocket.
#[derive(Clone, Debug)]
pub struct EllipseOperation {
    /// As written: the planner's own checks work on it.
    pub table: EllipseTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
}

impl Operation {
    /// Tool, speed, coolant, tolerance.
    pub fn milling(&self) -> &Milling {
        match self {
            Operation::Bore(bore) => &bore.milling,
            Operation::Ellipse(pocket) => &pocket.milling,
            Operation::Drill(drill) => &drill.milling,
            Operation::Face(face) => &face.milling,
            Operation::Path(path) => &path.milling,
        }
    }

    fn milling_mut(&mut self) -> &mut Milling {
        match self {
            Operation::Bore(bore) => &mut bore.milling,
            Operation::Ellipse(pocket) => &mut pocket.milling,
            Operation::Drill(drill) => &mut drill.milling,
            Operation::Face(face) => &mut face.milling,
            Operation::Path(path) => &mut path.milling,
        }
    }

    /// What a person calls it: kind, size, place.
    pub fn name(&self) -> String {
        match self {
            Operation::Bore(bore) => {
                let t = &bore.table;
                format!("bore {} at X{} Y{}", t.diameter, t.at[0], t.at[1])
            }
            Operation::Ellipse(pocket) => {
                let t = &pocket.table;
                let [a, b] = t.half_axes;
                format!("elliptic pocket {} x {} at X{} Y{}", 2.0 * a, 2.0 * b, t.at[0], t.at[1])
            }
            Operation::Drill(drill) => drill.name(),
            Operation::Face(face) => face.name(),
            Operation::Path(path) => path.name(),
        }
    }
}

/// Checks a job file.
///
/// # Errors
/// One finding with the key of the first wrong value; the loader's and mesh reader's errors for files it names.
pub fn check(file: &JobFile, name: &str, loader: &dyn Loader) -> Result<Job> {
    if file.format != 1 {
        return Err(Finding::error(Code::JOB_VALUE, "this program reads job format 1")
            .value(f64::from(file.format), "")
            .bound(1.0, "")
            .cure("write format = 1")
            .key("format")
            .into());
    }
    numbers::within(file)?;
    let stock = stock(&file.stock, loader).map_err(|e| e.under("stock"))?;
    let holders = tool::holders(&file.holders)?;
    let tools = tool::tools(&file.tools, &holders)?;
    let machine = match &file.machine {
        Some(MachineEntry::Table(table)) => Some(
            machine::machine(table, loader)
                .and_then(|m| machine::three_translations(&m).map(|()| m))
                .map_err(|e| e.under("machine"))?,
        ),
        Some(MachineEntry::File(name)) => {
            return Err(
                Finding::error(Code::JOB_REFERENCE, format!("machine file `{name}` was not read")).into()
            );
        }
        None => None,
    };
    let bounds = stock.bounds();
    let memory = positive("simulate.memory", file.simulate.memory.unwrap_or(2000.0), 1e6, "MB")?;
    let design = file.design.as_ref().map(|d| {
        let mesh = mesh(&d.mesh, loader).map_err(|e| e.under("design.mesh"))?;
        Ok::<_, Error>(Design { mesh, tolerance: length("design.tolerance", d.tolerance, 1e-6, 100.0)? })
    });
    if file.setups.is_empty() {
        return Err(Finding::error(Code::JOB_SHAPE, "a job needs a setup").cure("add [[setup]]").into());
    }
    let drilled = file
        .drilled
        .iter()
        .enumerate()
        .map(|(i, d)| drilled(d).map_err(|e| e.under(&format!("drilled[{i}]"))));
    let drilled: Vec<Drilled> = drilled.collect::<Result<_>>()?;
    let step = match file.simulate.step {
        Some(step) => length("simulate.step", step, 1e-4, MAX_LENGTH)?,
        None => step::default_step(bounds, step::thinnest(&tools, &drilled), memory * 1e6),
    };
    let control = Control::parse(&file.post.control).map_err(|e| e.under("post.control"))?;
    let said = (orientation(file.post.orientation, control)?, control);
    let mut setups = Vec::with_capacity(file.setups.len());
    for (i, table) in file.setups.iter().enumerate() {
        let setup = setup::setup(i, table, &tools, (&stock, &drilled), (machine.as_ref(), said), loader)
            .map_err(|e| e.under(&format!("setup[{i}]")))?;
        setups.push(setup);
    }
    Ok(Job {
        title: text("title", file.title.as_deref().unwrap_or(name))?,
        post: post(file, name, loader)?,
        orientation: said.0,
        machine,
        tools,
        stock,
        drilled,
        design: design.transpose()?,
        step,
        memory: (memory * 1e6) as u64,
        setups,
    })
}

fn orientation(said: Option<OrientationName>, control: Control) -> Result<OrientationName> {
    let usual = match control {
        Control::Sinumerik840d => OrientationName::Vectors,
        Control::Fanuc | Control::Heidenhain => OrientationName::Angles,
        _ => OrientationName::Axes,
    };
    let said = said.unwrap_or(usual);
    if usual == OrientationName::Axes && said != OrientationName::Axes {
        return Err(Finding::error(
            Code::POST_CONTROL,
            format!("{} does not control the tool centre point", control.title()),
        )
        .cure("write \"axes\", or leave it out")
        .key("post.orientation")
        .into());
    }
    Ok(said)
}

fn post(file: &JobFile, name: &str, loader: &dyn Loader) -> Result<PostSettings> {
    let post = &file.post;
    let control = Control::parse(&post.control).map_err(|e| e.under("post.control"))?;
    let mut settings = PostSettings::new(control);
    if let Some(decimals) = post.decimals {
        if !(3..=6).contains(&decimals) {
            return Err(Finding::error(Code::JOB_VALUE, "the decimals of coordinates are out of range")
                .value(f64::from(decimals), "")
                .bound(if decimals < 3 { 3.0 } else { 6.0 }, "")
                .cure("write 3 to 6")
                .key("post.decimals")
                .into());
        }
        settings.decimals = decimals;
    }
    if let Some(numbers) = post.block_numbers {
        settings.block_numbers = numbers;
    }
    if let Some(tolerance) = post.arc_tolerance {
        settings.arc_tolerance = length("post.arc_tolerance", tolerance, 1e-6, 1.0)?;
    }
    settings.cubic = post.cubic.unwrap_or(false);
    if settings.cubic && !control.has_cubic() {
        return Err(Finding::error(Code::POST_CONTROL, format!("{} has no cubics (G5)", control.title()))
            .cure("leave it out")
            .key("post.cubic")
            .into());
    }
    if let Some(step) = post.resolution {
        let last = 10f64.powi(-i32::from(settings.decimals));
        let steps = length("post.resolution", step, 1e-6, 0.1)? / last;
        /// A multiple but for rounding of the decimal number.
        const EXACT: f64 = 1e-6;
        if !(steps >= 1.0 - EXACT && (steps - steps.round()).abs() < EXACT * steps) {
            return Err(Finding::error(
                Code::JOB_VALUE,
                "the resolution must be a whole multiple of the last decimal",
            )
            .value_mm(step)
            .bound_mm(last)
            .cure("use more decimals, or another resolution")
            .key("post.resolution")
            .into());
        }
        settings.resolution = Some(step);
    }
    settings.involute_native = post.involute.unwrap_or(settings.involute_native);
    settings.arcs = post.arcs.unwrap_or(settings.arcs);
    settings.rotation = post.rotation.unwrap_or(settings.rotation);
    if let Some(tolerance) = post.chord_tolerance {
        settings.chord_tolerance = length("post.chord_tolerance", tolerance, 1e-6, 1.0)?;
    }
    if let Some(number) = post.program_number {
        if !(1..=9999).contains(&number) {
            return Err(Finding::error(Code::JOB_VALUE, "the number of a program is out of range")
                .value(f64::from(number), "")
                .bound(if number == 0 { 1.0 } else { 9999.0 }, "")
                .key("post.program_number")
                .into());
        }
        settings.program_number = number;
    }
    let template = |key: &str, name: &Option<String>| {
        let text = name.as_deref().map(|n| loader.read_text(n)).transpose();
        text.map_err(|e| e.under(&format!("post.{key}")))
    };
    settings.start_template = template("start", &post.start)?;
    settings.end_template = template("end", &post.end)?;
    let program = post.program.as_deref().unwrap_or(name);
    // It becomes a file name, and on some controls a word of the program.
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    let reserved = RESERVED.iter().any(|name| name.eq_ignore_ascii_case(program));
    if program.is_empty() || program.starts_with('-') || reserved || !program.chars().all(plain) {
        return Err(Finding::error(
            Code::JOB_VALUE,
            format!("`{}` is no program name", program.escape_default()),
        )
        .cure("use letters without accents, digits, `_` and `-`, but neither a `-` at the start nor a name of Windows")
        .key("post.program")
        .into());
    }
    settings.program_name = text("post.program", program)?;
    if let (None, Some(number)) = (post.program_number, super::names::number_of(program)) {
        if number == 0 {
            return Err(Finding::error(Code::JOB_VALUE, "the number of a program is out of range")
                .value(0.0, "")
                .bound(1.0, "")
                .key("post.program")
                .into());
        }
        settings.program_number = number;
    }
    Ok(settings)
}

/// Names that are devices on Windows, whatever their ending.
const RESERVED: &[&str] = &[
    "con", "prn", "aux", "nul", "com0", "com1", "com2", "com3", "com4", "com5", "com6", "com7", "com8",
    "com9", "lpt0", "lpt1", "lpt2", "lpt3", "lpt4", "lpt5", "lpt6", "lpt7", "lpt8", "lpt9",
];

fn stock(table: &StockTable, loader: &dyn Loader) -> Result<Solid> {
    match table {
        StockTable::Box(b) => {
            for i in 0..3 {
                let key = |end: &str| format!("box.{end}[{i}]");
                length(&key("min"), b.min[i], -MAX_LENGTH, MAX_LENGTH)?;
                length(&key("max"), b.max[i], -MAX_LENGTH, MAX_LENGTH)?;
                if b.max[i] <= b.min[i] {
                    return Err(Finding::error(
                        Code::JOB_VALUE,
                        "the greatest corner of the stock must exceed the least",
                    )
                    .value_mm(b.max[i])
                    .bound_mm(b.min[i])
                    .cure("write the least corner as min, the greatest as max")
                    .key(key("max"))
                    .into());
                }
            }
            Ok(Solid::Box(Aabb { min: DVec3::from_array(b.min), max: DVec3::from_array(b.max) }))
        }
        StockTable::Cylinder(c) => {
            for i in 0..3 {
                length(&format!("cylinder.base[{i}]"), c.base[i], -MAX_LENGTH, MAX_LENGTH)?;
            }
            Ok(Solid::Cylinder {
                base: DVec3::from_array(c.base),
                radius: positive("cylinder.diameter", c.diameter, MAX_LENGTH, "mm")? / 2.0,
                height: positive("cylinder.height", c.height, MAX_LENGTH, "mm")?,
            })
        }
        StockTable::Mesh(name) => Ok(Solid::Mesh(mesh(name, loader).map_err(|e| e.under("mesh"))?)),
    }
}

fn drilled(d: &DrilledTable) -> Result<Drilled> {
    let xy = [0, 1].map(|i| length(&format!("at[{i}]"), d.at[i], -MAX_LENGTH, MAX_LENGTH));
    let [x, y] = xy;
    let bottom = length("bottom", d.bottom, -MAX_LENGTH, MAX_LENGTH)?;
    let height = positive(
        "top",
        length("top", d.top, -MAX_LENGTH, MAX_LENGTH)? - bottom,
        MAX_LENGTH,
        "mm above the bottom",
    )?;
    Ok(Drilled {
        base: DVec3::new(x?, y?, bottom),
        diameter: positive("diameter", d.diameter, MAX_LENGTH, "mm")?,
        height,
    })
}

fn mesh(name: &str, loader: &dyn Loader) -> Result<Mesh> {
    let in_file = |e: Error| {
        let mut finding = *e.0;
        finding.message = format!("`{name}`: {}", finding.message);
        Error::from(finding)
    };
    let mesh = crate::geom::read_stl(&loader.read_as(name, FileKind::Mesh)?).map_err(in_file)?;
    mesh.check_closed().map_err(in_file)?;
    let bounds = mesh.bounds();
    if bounds.is_empty() || bounds.min.abs().max(bounds.max.abs()).max_element() > MAX_LENGTH {
        return Err(Finding::error(
            Code::MESH_UNREADABLE,
            format!("`{name}` is empty or larger than can be handled"),
        )
        .bound_mm(MAX_LENGTH)
        .at(Location::whole_file(name))
        .into());
    }
    Ok(mesh)
}

fn operation_of(
    table: &OperationTable,
    tools: &[Tool],
    stock: &StockOutline<'_>,
    (machine, post): (Option<&Machine>, (OrientationName, Control)),
    loader: &dyn Loader,
) -> Result<Operation> {
    Ok(match table {
        OperationTable::Bore(t) => Operation::Bore(BoreOperation {
            milling: milling(t.tool, t.speed, t.coolant, t.tolerance, tools)?,
            table: t.clone(),
        }),
        OperationTable::PocketEllipse(t) => Operation::Ellipse(EllipseOperation {
            milling: milling(t.tool, t.speed, t.coolant, t.tolerance, tools)?,
            table: t.clone(),
        }),
        OperationTable::Drill(t) => Operation::Drill(Box::new(drill::operation(t, tools, loader)?)),
        OperationTable::Face(t) => Operation::Face(Box::new(face::operation(t, tools, stock, loader)?)),
        OperationTable::Path(t) => {
            Operation::Path(Box::new(path::operation(t, tools, (machine, post), loader)?))
        }
    })
}

fn milling(
    tool: u32,
    speed: f64,
    coolant: CoolantName,
    tolerance: Option<f64>,
    tools: &[Tool],
) -> Result<Milling> {
    let tool = tool_of(tool, tools)?;
    milling_of(tool, positive("speed", speed, 200_000.0, "rev/min")? * TAU / 60.0, coolant, tolerance)
}

fn tool_of(number: u32, tools: &[Tool]) -> Result<Tool> {
    let found = tools.iter().find(|t| t.number.0 == number).cloned();
    found.ok_or_else(|| {
        Finding::error(Code::JOB_REFERENCE, format!("T{number} is not defined"))
            .cure("define it with [[tool]]")
            .key("tool")
            .into()
    })
}

fn milling_of(tool: Tool, spindle: f64, coolant: CoolantName, tolerance: Option<f64>) -> Result<Milling> {
    Ok(Milling {
        spindle,
        coolant: match coolant {
            CoolantName::Off => Coolant::Off,
            CoolantName::Mist => Coolant::Mist,
            CoolantName::Flood => Coolant::Flood,
        },
        tolerance: length("tolerance", tolerance.unwrap_or(0.02), 1e-6, 100.0)?,
        plane: None,
        tool,
    })
}

/// A finite number within bounds [mm].
pub(crate) fn length(key: &str, value: f64, min: f64, max: f64) -> Result<f64> {
    bounded(key, value, min, max, "mm")
}

/// A finite number above zero.
pub(crate) fn positive(key: &str, value: f64, max: f64, unit: &str) -> Result<f64> {
    if value > 0.0 {
        bounded(key, value, 0.0, max, unit)
    } else {
        bounded(key, value, f64::MIN_POSITIVE, max, unit)
    }
}

fn bounded(key: &str, value: f64, min: f64, max: f64, unit: &str) -> Result<f64> {
    if value >= min && value <= max {
        return Ok(value);
    }
    let name = key.rsplit('.').next().unwrap_or(key);
    let (what, bound) = match value {
        v if v.is_nan() => (format!("{name} is not a number"), None),
        v if v > max => (format!("{name} is too large"), Some(max)),
        _ if min == f64::MIN_POSITIVE => (format!("{name} must be positive"), Some(0.0)),
        _ if min == 0.0 => (format!("{name} must not be negative"), Some(0.0)),
        _ => (format!("{name} is too small"), Some(min)),
    };
    let unit_after = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let finding = Finding::error(Code::JOB_VALUE, what).key(key).cure(match min {
        f64::MIN_POSITIVE => format!("write a number above 0, at most {max}{unit_after}"),
        _ => format!("write a number from {min} to {max}{unit_after}"),
    });
    Err(match bound {
        Some(bound) => finding.value(value, unit).bound(bound, unit).into(),
        None => finding.into(),
    })
}

/// A text that may go into a program's comment, a report and a terminal: no control characters, not too long.
fn text(key: &str, value: &str) -> Result<String> {
    const MAX: usize = 120;
    if value.chars().any(char::is_control) || value.chars().count() > MAX {
        return Err(Finding::error(Code::JOB_VALUE, "the text has control characters or is too long")
            .value(value.chars().count() as f64, "characters")
            .bound(MAX as f64, "characters")
            .key(key)
            .into());
    }
    Ok(value.to_owned())
}
