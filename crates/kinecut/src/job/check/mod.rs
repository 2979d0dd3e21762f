//! From the job file to a checked job: every number finite and bounded, every name resolved, units turned into
//! those used inside (mm, s, rad).

pub(crate) mod axes;
mod body;
pub(crate) mod control;
mod design;
mod feed_limit;
mod fixture;
pub(crate) mod joint;
mod kept;
pub(crate) mod machine;
pub(crate) mod numbers;
mod program;
mod setup;
pub(in crate::job) mod step;
mod uncertainty;

pub use design::{Design, Region};
pub use uncertainty::Uncertainty;

pub use program::{JobProgram, Subprogram, program_text, subprograms};

use std::ops::Deref;

use glam::DVec3;

use feed_limit::feed_limit;

use super::cutting::TakenData;
use super::file::{DrilledTable, JobFile, MachineEntry, StockTable};
use crate::base::bounded::{MAX_LENGTH, length, positive, text};
use crate::base::{Code, Finding, Loader, MeshesIn, Result};
use crate::geom::{Aabb, Solid, load_mesh};
use crate::job::part_surface::PartSurface;
use crate::machine::Machine;
use crate::motion::AxisLimit;
use crate::nc::{Control, PostSettings, Units};
use crate::operations::{Clamping, Drilled, Operation, OrientationName};
use crate::stock::surface::SurfaceOptions;
use crate::tool::Tool;

/// A checked job; mm, s, rad.
#[derive(Clone, Debug)]
pub struct Job {
    /// Title.
    pub title: String,
    /// Unit of the job's own lengths, in which its messages and report are; all else here is in mm.
    pub units: Units,
    /// Files of machine, tools and cutting data whose lengths are in the other unit: so are messages about them.
    pub in_other_unit: Vec<String>,
    /// Settings for writing the program.
    pub post: PostSettings,
    /// Form in which the program gives the directions of its tool.
    pub orientation: OrientationName,
    /// Limits that a feed may ask of each linear axis; `None` where feeds are written as they are.
    pub feed_limit: Option<AxisLimit>,
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
    /// Whether the step was chosen for want of one.
    pub default_step: bool,
    /// Largest memory of a run [bytes].
    pub memory: u64,
    /// Fineness of the surface of the cut part.
    pub surface: SurfaceOptions,
    /// Whether the cut stock is proven against the moves.
    pub certified: bool,
    /// Whether the engagement of the tools is measured; if nothing says so, for programs that take little time.
    pub engagement: Option<bool>,
    /// Distances by which a person may be off, if at all.
    pub uncertainty: Option<Uncertainty>,
    /// Whether the stock over time is wanted.
    pub playback: bool,
    /// Surface of the cut part that is made.
    pub part_surface: PartSurface,
    /// Clampings, in order.
    pub setups: Vec<JobSetup>,
    /// The material of the part as the job names it.
    pub material: Option<String>,
    /// Speeds and feeds that operations were given.
    pub cutting: Vec<TakenData>,
    /// Whether other ways than the one asked for are planned too, each with its price.
    pub compare: bool,
}

/// A clamping with its operations.
#[derive(Clone, Debug)]
pub struct JobSetup {
    /// The part as it is clamped.
    pub clamping: Clamping,
    /// Operations.
    pub operations: Vec<Operation>,
    /// A program that others wrote, in place of operations.
    pub program: Option<JobProgram>,
}

impl Deref for JobSetup {
    type Target = Clamping;

    fn deref(&self) -> &Clamping {
        &self.clamping
    }
}

impl Job {
    /// Notes about speeds and feeds that operations were given, each with the key of its operation.
    pub fn data_notes(&self) -> Vec<Finding> {
        let has_limit = self.machine.as_ref().is_some_and(|m| m.control.max_speed.is_some());
        super::cutting::notes(&self.cutting, has_limit)
    }

    /// The name of the operation of a number, over all setups.
    pub(crate) fn operation_name(&self, number: u32) -> String {
        self.operation(number).map(Operation::name).unwrap_or_default()
    }

    /// The operation of a number, over all setups.
    pub fn operation(&self, number: u32) -> Option<&Operation> {
        self.setups.iter().flat_map(|s| &s.operations).nth(number as usize)
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
            .help("write format = 1")
            .key("format")
            .into());
    }
    numbers::within(file)?;
    let loader = &MeshesIn { loader, unit: file.units.unwrap_or_default().units().mm() };
    let stock = stock(&file.stock, loader).map_err(|e| e.under("stock"))?;
    text("material", file.material.as_deref().unwrap_or_default())?;
    let holders = super::file::holders(&file.holders)?;
    let tools = super::file::tools(&file.tools, &holders)?;
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
    let memory = positive("simulate.memory", file.simulate.memory.unwrap_or(4000.0), 1e6, "MB")?;
    let design = file.design.as_ref().map(|table| Design::of(table, loader));
    if file.setups.is_empty() {
        return Err(Finding::error(Code::JOB_SHAPE, "a job needs a setup").help("add [[setup]]").into());
    }
    let uncertainty = file.simulate.uncertainty.as_ref().map(Uncertainty::of).transpose()?;
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
    let fixtures = fixture::fixtures(&file.fixtures, file.setups.len(), loader)?;
    let mut setups = Vec::with_capacity(file.setups.len());
    let mut cutting = file.taken.clone();
    for (i, table) in file.setups.iter().enumerate() {
        let around = (machine.as_ref(), said);
        let mut setup = setup::setup(i, table, &mut cutting, &tools, (&stock, &drilled), around, loader)
            .map_err(|e| e.under(&format!("setup[{i}]")))?;
        let work = setup.clamping.work();
        let there = fixtures.iter().flat_map(|fixture| fixture.in_setup(i, &work));
        setup.clamping.setup.fixtures = there.collect();
        setups.push(setup);
    }
    Ok(Job {
        title: text("title", file.title.as_deref().unwrap_or(name))?,
        units: file.units.unwrap_or_default().units(),
        in_other_unit: Vec::new(),
        post: post(file, name, loader)?,
        orientation: said.0,
        feed_limit: feed_limit(file.post.feeds, machine.as_ref())?,
        machine,
        tools,
        stock,
        drilled,
        design: design.transpose()?,
        step,
        default_step: file.simulate.step.is_none(),
        memory: (memory * 1e6) as u64,
        surface: step::surface("simulate.mesh_tolerance", file.simulate.mesh_tolerance, step)?,
        certified: file.simulate.certified,
        engagement: file.simulate.engagement,
        uncertainty: uncertainty.unwrap_or_default(),
        playback: false,
        part_surface: PartSurface::Full,
        setups,
        material: file.material.clone(),
        cutting,
        compare: false,
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
        .help("write \"axes\", or leave it out")
        .key("post.orientation")
        .into());
    }
    Ok(said)
}

fn post(file: &JobFile, name: &str, loader: &dyn Loader) -> Result<PostSettings> {
    let post = &file.post;
    let control = Control::parse(&post.control).map_err(|e| e.under("post.control"))?;
    let units = post.units.or(file.units).unwrap_or_default().units();
    let mut settings = PostSettings::in_units(control, units);
    if let Some(decimals) = post.decimals {
        if !(3..=6).contains(&decimals) {
            return Err(Finding::error(Code::JOB_VALUE, "the decimals of coordinates are out of range")
                .value(f64::from(decimals), "")
                .bound(if decimals < 3 { 3.0 } else { 6.0 }, "")
                .help("write 3 to 6")
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
            .help("leave it out")
            .key("post.cubic")
            .into());
    }
    if let Some(step) = post.resolution {
        let last = units.mm() * 10f64.powi(-i32::from(settings.decimals));
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
            .help("use more decimals, or another resolution")
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
        .help("use letters without accents, digits, `_` and `-`, but neither a `-` at the start nor a name of Windows")
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
                        "the greatest corner of a box must exceed the least",
                    )
                    .value_mm(b.max[i])
                    .bound_mm(b.min[i])
                    .help("write the least corner as min, the greatest as max")
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
        StockTable::Mesh(name) => Ok(Solid::Mesh(load_mesh(name, loader).map_err(|e| e.under("mesh"))?)),
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
