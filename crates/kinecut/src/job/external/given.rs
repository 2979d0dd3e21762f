//! A program that is given by itself: the job about it, from a job file whose operations do not count, or from the few things
//! that are said beside it.

use schemars::JsonSchema;
use serde::Deserialize;

use super::super::check::{Job, JobProgram, check};
use super::super::file::{
    BoxTable, JobFile, PostTable, ProgramTable, SetupTable, SimulateTable, StockTable, ToolTable,
};
use super::super::read::read_table;
use super::super::wants::StockWants;
use super::super::{JobText, Subject, json_text, parts, sha256};
use super::carried::{TableTools, all_in_words, is_tool_table, toml_of};
use crate::base::{Code, Error, FileId, Finding, Loader, MemoryLoader, OverlayLoader, Result, Sources};
use crate::machine::Machine;
use crate::nc::{Control, Detected, NumberInput, detect};
use crate::tool::Holder;

/// A file by its name and bytes.
#[derive(Clone, Copy, Debug)]
pub struct GivenFile<'a> {
    /// Name, as the user gave it.
    pub name: &'a str,
    /// Content.
    pub bytes: &'a [u8],
}

/// Raw stock that is given with a program, in coordinates of the work offset [mm].
#[derive(Clone, Debug)]
pub enum GivenStock {
    /// A block: its least and greatest corner.
    Block([f64; 6]),
    /// A closed STL mesh: the name of its file, and its bytes.
    Mesh(String, Vec<u8>),
}

/// Settings that are given with a program.
#[derive(Clone, Debug, Default)]
pub struct ProgramWants {
    /// The control that runs it; default: that of the job, then that of the file's ending.
    pub control: Option<String>,
    /// The machine.
    pub machine: Option<Machine>,
    /// The raw stock.
    pub stock: Option<GivenStock>,
    /// Name and text of a file with `[[tool]]` and `[[holder]]`, as a job file is one, or of a tool table of LinuxCNC (`.tbl`).
    pub tools: Option<(String, String)>,
    /// Whether M codes of the machine that move no axis by custom are passed over; default: as the job says.
    pub tolerant: bool,
    /// Name and text of the parameter file of the machine (`linuxcnc.var`); default: that of the job.
    pub parameters: Option<(String, String)>,
    /// Whether the machine counts in inches: lengths in its tool table and its parameters.
    pub machine_in_inches: bool,
    /// Machine position of the work zero [mm].
    pub position: Option<[f64; 3]>,
    /// Distance of the lines of the stock model [mm].
    pub step: Option<f64>,
    /// Meaning of coordinates without a decimal point (FANUC); default: that of the job, otherwise as the program suggests.
    pub input: Option<NumberInput>,
    /// Most blocks that it may run in loops and calls; default: that of the job, otherwise 20 million.
    pub blocks: Option<u64>,
    /// Folders with programs that it calls, as seen from its own; default: those of the job.
    pub subprograms: Vec<String>,
    /// Place of the tip before the program moves it, in coordinates of the work offset [mm].
    pub start: Option<[f64; 3]>,
    /// Files beside the program with programs that it calls: names and bytes, in its folder.
    pub beside: Vec<(String, Vec<u8>)>,
    /// Guesses about stock and tools, in words.
    pub guessed: Vec<String>,
    /// Number of the tool in the spindle before the program calls one.
    pub tool: Option<u32>,
    /// Which clamping of the job it runs in, counted from 1; default: the first.
    pub setup: Option<usize>,
}

impl ProgramWants {
    /// The unit of the machine [mm].
    pub(crate) fn machine_unit(&self) -> f64 {
        if self.machine_in_inches { 25.4 } else { 1.0 }
    }
}

/// The job about a program, and what its verdict is about.
#[derive(Debug)]
pub struct GivenJob {
    name: String,
    job: Job,
    subjects: Vec<Subject>,
    place: JobPlace,
}

/// Places of the job's keys about a program.
#[derive(Debug, Default)]
pub(crate) struct JobPlace {
    sources: Sources,
    text: Option<JobText>,
}

impl JobPlace {
    /// An error with the place of its key in the job file, if there is one.
    pub(crate) fn locate(&self, error: Error) -> Error {
        match &self.text {
            Some(text) => text.locate(&self.sources, error),
            None => error,
        }
    }
}

impl GivenJob {
    /// The job, with one setup.
    pub fn job(&self) -> &Job {
        &self.job
    }

    /// Simulates it in another way than its job says.
    ///
    /// # Errors
    /// `KC0103` for a step or tolerance out of range; those of a mesh as design.
    pub fn simulated(&mut self, wants: &StockWants) -> Result<()> {
        let design = wants.apply(&mut self.job)?;
        self.subjects.extend(design);
        Ok(())
    }

    /// The program.
    ///
    /// # Errors
    /// None: a given job always has one.
    pub(crate) fn program(&self) -> Result<&JobProgram> {
        let program = self.job.setups.first().and_then(|s| s.program.as_ref());
        program.ok_or_else(|| Finding::error(Code::JOB_SHAPE, "there is no program").into())
    }

    /// Name, job, subjects of the verdict, places.
    pub(crate) fn into_parts(self) -> (String, Job, Vec<Subject>, JobPlace) {
        (self.name, self.job, self.subjects, self.place)
    }
}

/// Tools and holders in a file of their own.
#[derive(Debug, Deserialize, JsonSchema)]
struct ToolsFile {
    #[serde(default, rename = "holder")]
    holders: Vec<Holder>,
    #[serde(default, rename = "tool")]
    tools: Vec<ToolTable>,
}

/// The control of a file's ending, where that tells it: `.mpf`, `.spf`, `.ngc`, `.gcode`, `.h`.
pub fn control_of_name(name: &str) -> Option<Control> {
    let ending = name.rsplit_once('.')?.1.to_ascii_lowercase();
    match ending.as_str() {
        "mpf" | "spf" => Some(Control::Sinumerik840d),
        "ngc" => Some(Control::LinuxCnc),
        "gcode" => Some(Control::Grbl),
        "h" => Some(Control::Heidenhain),
        _ => None,
    }
}

/// The control of a program, and why where its text told it: as said, else of the job, else of the name, else of the text.
///
/// # Errors
/// `KC0301` when it is not known or nothing tells it, and for a control that kinecut does not read.
pub fn control_of(
    said: Option<&str>,
    of_job: Option<&str>,
    name: &str,
    bytes: &[u8],
) -> Result<(Control, Option<String>)> {
    if let Some(said) = said.or(of_job) {
        return Ok((Control::parse(said)?, None));
    }
    if let Some(control) = control_of_name(name) {
        return Ok((control, None));
    }
    match detect(&String::from_utf8_lossy(bytes)) {
        Detected::Control(control, why) => Ok((control, Some(why))),
        Detected::Other(other, why) => {
            let message = format!("`{name}` is a program for {other}, which kinecut does not read");
            Err(Finding::error(Code::POST_CONTROL, message).help(format!("seen in it: {why}")).into())
        }
        Detected::Nothing => {
            let known: Vec<&str> = Control::ALL.iter().map(|c| c.name()).collect();
            let message = format!("neither the name nor the text of `{name}` tells its control");
            let help = format!("say it: --control {}", known.join(", "));
            Err(Finding::error(Code::POST_CONTROL, message).help(help).into())
        }
    }
}

/// The job about a program with a job file: its tools, stock, machine, design and clamping count, its operations do not.
///
/// # Errors
/// Those of the job file, with their places; `KC0104` if it does not have the setup.
pub fn given_with_job(
    program: GivenFile<'_>,
    wants: &ProgramWants,
    (name, text): (&str, &str),
    loader: &dyn Loader,
) -> Result<GivenJob> {
    let mut sources = Sources::default();
    let id: FileId = sources.add(name, text);
    let mut job_text = JobText::read(&mut sources, id, loader)?;
    let mut file = job_text.file.clone();
    let index = wants.setup.unwrap_or(1);
    let Some(mut setup) = index.checked_sub(1).and_then(|i| file.setups.get(i)).cloned() else {
        return Err(Finding::error(Code::JOB_REFERENCE, format!("the job has no setup {index}"))
            .value(index as f64, "")
            .bound(file.setups.len() as f64, "setups")
            .into());
    };
    let own = setup.program.take();
    let of_job = own.as_ref().and_then(|p| p.control.as_deref()).unwrap_or(&file.post.control);
    let (control, _) = control_of(wants.control.as_deref(), Some(of_job), program.name, program.bytes)?;
    setup.operations.clear();
    setup.program = Some(ProgramTable {
        file: program.name.to_owned(),
        control: Some(control.name().to_owned()),
        input: wants.input.or(own.as_ref().map(|p| p.input)).unwrap_or_default(),
        blocks: wants.blocks.or(own.as_ref().and_then(|p| p.blocks)),
        subprograms: match wants.subprograms.is_empty() {
            true => own.as_ref().map(|p| p.subprograms.clone()).unwrap_or_default(),
            false => wants.subprograms.clone(),
        },
        start: wants.start.or(own.as_ref().and_then(|p| p.start)),
        tool: wants.tool.or(own.as_ref().and_then(|p| p.tool)),
        tolerant: wants.tolerant || own.as_ref().is_some_and(|p| p.tolerant),
        tool_table: own.as_ref().and_then(|p| p.tool_table.clone()),
        parameters: match &wants.parameters {
            Some((name, _)) => Some(name.clone()),
            None => own.as_ref().and_then(|p| p.parameters.clone()),
        },
        machine_in_inches: wants.machine_in_inches || own.as_ref().is_some_and(|p| p.machine_in_inches),
        registers: own.map(|p| p.registers).unwrap_or_default(),
    });
    file.setups = vec![setup];
    file.title = Some(title(program.name));
    let beside = wants.beside.iter().map(|(_, bytes)| bytes.as_slice());
    for bytes in std::iter::once(program.bytes).chain(beside) {
        job_text
            .call_program(&mut file, &String::from_utf8_lossy(bytes))
            .map_err(|e| job_text.locate(&sources, e))?;
    }
    let all = over(with_beside(program, wants), loader);
    let job = check(&file, "program", &all).map_err(|e| job_text.locate(&sources, e))?;
    let mut subjects =
        vec![of_file("given program", program.name, program.bytes), of_file("job", name, text.as_bytes())];
    subjects.extend(called(&job));
    subjects.extend(kept_in(&job));
    for part in parts(&job_text.file, loader)? {
        if !subjects.contains(&part) {
            subjects.push(part);
        }
    }
    let place = JobPlace { sources, text: Some(job_text) };
    Ok(GivenJob { name: program.name.to_owned(), job, subjects, place })
}

/// The job about a program without a job file. `needs_stock`: whether it is to be cut.
///
/// # Errors
/// `KC0104` when there is no stock although it is to be cut; those of the tools, and of a mesh as stock.
pub fn given_alone(program: GivenFile<'_>, wants: &ProgramWants, needs_stock: bool) -> Result<GivenJob> {
    let (control, why) = control_of(wants.control.as_deref(), None, program.name, program.bytes)?;
    let block = |[a, b, c, d, e, f]: [f64; 6]| StockTable::Box(BoxTable { min: [a, b, c], max: [d, e, f] });
    let mut files = with_beside(program, wants);
    let stock = match &wants.stock {
        Some(GivenStock::Block(corners)) => block(*corners),
        Some(GivenStock::Mesh(name, bytes)) => {
            files.push(GivenFile { name, bytes });
            StockTable::Mesh(name.clone())
        }
        None if needs_stock => {
            return Err(Finding::error(Code::JOB_REFERENCE, "there is no stock to cut")
                .help(
                    "give it: --stock \"x0,y0,z0,x1,y1,z1\" or the name of an STL file, or a job file: --job",
                )
                .into());
        }
        None => block([0.0, 0.0, 0.0, 1.0, 1.0, 1.0]),
    };
    let mut subjects = vec![of_file("given program", program.name, program.bytes)];
    let table = wants.tools.as_ref().is_some_and(|(name, _)| is_tool_table(name));
    if wants.machine_in_inches && !table && wants.parameters.is_none() {
        let message = "only a tool table (.tbl) or a parameter file may be in inches";
        let help =
            "a TOML file of tools is in mm; give the tool table by --tools, the parameters by --parameters";
        return Err(Finding::error(Code::JOB_VALUE, message).help(help).into());
    }
    let mut guessed = wants.guessed.clone();
    // Another control has no such table: only its tools are taken.
    let of_machine = wants.tools.as_ref().filter(|_| table && control == Control::LinuxCnc);
    if let Some((name, text)) = of_machine {
        files.push(GivenFile { name, bytes: text.as_bytes() });
    }
    let tools = match &wants.tools {
        None => ToolsFile { holders: Vec::new(), tools: Vec::new() },
        Some((name, text)) => {
            subjects.push(of_file("tools", name, text.as_bytes()));
            let mut sources = Sources::default();
            let text = match table {
                true => {
                    let read = TableTools::read(name, text, wants.machine_unit())?;
                    let unit = if wants.machine_in_inches { "inches" } else { "mm" };
                    guessed.push(format!(
                        "the shapes of the tools and their flutes are guessed, their lengths taken in {unit}, from {name}: {}{}",
                        all_in_words(&read.tools),
                        read.left_out()
                    ));
                    toml_of(&read.tools)
                }
                false => text.clone(),
            };
            let id = sources.add(name.clone(), text);
            read_table(&sources, id, |t: &ToolsFile| {
                Ok(ToolsFile { holders: t.holders.clone(), tools: t.tools.clone() })
            })?
        }
    };
    subjects.push(match &wants.stock {
        Some(GivenStock::Mesh(name, bytes)) => of_file("stock", name, bytes),
        _ => Subject { role: "stock".to_owned(), file: None, sha256: sha256(json_text(&stock).as_bytes()) },
    });
    let file = JobFile {
        format: 1,
        units: None,
        title: Some(title(program.name)),
        material: None,
        libraries: None,
        tool_files: Vec::new(),

        cutting: None,
        taken: Vec::new(),
        design: None,
        stock,
        drilled: Vec::new(),
        post: PostTable { control: control.name().to_owned(), ..PostTable::default() },
        simulate: SimulateTable { step: wants.step, ..SimulateTable::default() },
        machine: None,
        fixtures: Vec::new(),
        holders: tools.holders,
        tools: tools.tools,
        setups: vec![SetupTable {
            position: wants.position,
            ..SetupTable::of_program(ProgramTable {
                file: program.name.to_owned(),
                tool: wants.tool,
                input: wants.input.unwrap_or_default(),
                blocks: wants.blocks,
                subprograms: wants.subprograms.clone(),
                start: wants.start,
                tolerant: wants.tolerant,
                tool_table: of_machine.map(|(name, _)| name.clone()),
                parameters: wants.parameters.as_ref().map(|(name, _)| name.clone()),
                machine_in_inches: wants.machine_in_inches
                    && (of_machine.is_some() || wants.parameters.is_some()),
                ..ProgramTable::default()
            })
        }],
    };
    let none = MemoryLoader::default();
    let all = over(files, &none);
    let mut job = check(&file, "program", &all)?;
    if let Some(program) = job.setups.first_mut().and_then(|setup| setup.program.as_mut()) {
        program.detected = why;
        program.guessed = guessed;
    }
    subjects.extend(called(&job));
    subjects.extend(kept_in(&job).filter(|kept| kept.role != "tool table"));
    if let Some(machine) = &wants.machine {
        super::super::check::machine::three_translations(machine)?;
        let text = super::super::machine::machine_toml(machine);
        subjects.push(Subject { role: "machine".to_owned(), file: None, sha256: sha256(text.as_bytes()) });
        job.machine = Some(machine.clone());
    }
    Ok(GivenJob { name: program.name.to_owned(), job, subjects, place: JobPlace::default() })
}

/// Files that were given over those of a loader; the first of a name counts.
fn over<'a>(files: Vec<GivenFile<'a>>, others: &'a dyn Loader) -> OverlayLoader<'a> {
    files.into_iter().rev().fold(OverlayLoader::new(others), |all, file| all.with(file.name, file.bytes))
}

/// A program with the files that it calls and the parameters of its machine.
fn with_beside<'a>(program: GivenFile<'a>, wants: &'a ProgramWants) -> Vec<GivenFile<'a>> {
    let beside = wants.beside.iter().map(|(name, bytes)| GivenFile { name, bytes });
    let kept = wants.parameters.iter().map(|(name, text)| GivenFile { name, bytes: text.as_bytes() });
    std::iter::once(program).chain(beside).chain(kept).collect()
}

/// Files in which the machine of a program keeps its offsets.
fn kept_in(job: &Job) -> impl Iterator<Item = Subject> {
    let programs = job.setups.iter().filter_map(|setup| setup.program.as_ref());
    programs.flat_map(|program| program.kept_in.clone())
}

/// Files that the program of a job calls.
fn called(job: &Job) -> impl Iterator<Item = Subject> {
    let programs = job.setups.iter().filter_map(|setup| setup.program.as_ref());
    programs
        .flat_map(|p| &p.beside)
        .map(|called| of_file("called program", &called.file, called.text.as_bytes()))
}

fn of_file(role: &str, name: &str, bytes: &[u8]) -> Subject {
    Subject { role: role.to_owned(), file: Some(name.to_owned()), sha256: sha256(bytes) }
}

/// A title that is fit for a comment: the name of the file without its folder.
fn title(name: &str) -> String {
    let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    name.chars().filter(|c| !c.is_control()).take(120).collect()
}
