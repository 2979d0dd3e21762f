//! The verbs about programs that others wrote: `simulate`, `check`, `post`; and `run`, which simulates its own.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use kinecut::base::{Code, Error, FileKind, Finding};
use kinecut::job::{
    DesignWants, GivenFile, GivenJob, GivenStock, InspectWants, ProgramWants, RunWants, SectionPlane,
    StockWants, Uncertainty, control_of, given_alone, given_with_job, is_tool_table, program_text,
    subprograms,
};
use kinecut::nc::{Control, NumberInput, PostSettings};
use kinecut::operations::OrientationName;
use kinecut::verbs::check::program_sheet;
use kinecut::verbs::guess::Guess;
use kinecut::verbs::post::translate;
use kinecut::verbs::run::{self, MeshForm, ResultFiles};

use crate::answers::{Data, To, answer};
use crate::numbers::{corners, triple, two_points, uncertainty};
use crate::printing::Printing;
use crate::progress::Bar;
use crate::{files, machine};

/// Place of the results of a job.
#[derive(Debug, clap::Args)]
struct Results {
    /// Folder for the results, made if it is not there
    #[arg(long, default_value = "out")]
    out: PathBuf,
    /// Files of the cut part: stl, glb, ply, 3mf, several with a comma between them, or none
    #[arg(long, value_name = "FORM", value_enum, value_delimiter = ',', default_values_t = [MeshFile::Stl, MeshFile::Glb])]
    mesh: Vec<MeshFile>,
    /// Leave report.html out; with --mesh none no surface of the part is made, which takes less time
    #[arg(long)]
    no_report: bool,
    /// Leave the material that goes as the program runs out of the 3-D view of report.html, which takes less time
    #[arg(long)]
    no_playback: bool,
    /// Section of the cut part by a plane, such as z=-5, of the material just below it; can be given several times
    #[arg(long, value_name = "AXIS=MM", value_parser = plane)]
    section: Vec<SectionPlane>,
    /// Point of the cut part, mm: in material or not, the surfaces about it and the lines that cut them; can be given several times
    #[arg(long, value_name = "X,Y,Z", value_parser = triple, allow_hyphen_values = true)]
    probe: Vec<[f64; 3]>,
    /// Distance of two points, mm, and the lengths in material and in void between them; can be given several times
    #[arg(long, value_name = "X,Y,Z,X,Y,Z", value_parser = two_points, allow_hyphen_values = true)]
    measure: Vec<[f64; 6]>,
}

/// A plane square to an axis.
fn plane(text: &str) -> Result<SectionPlane, String> {
    text.parse().map_err(|e: Error| e.0.help)
}

/// Settings of the simulation.
#[derive(Debug, clap::Args)]
struct Stock {
    /// Distance of the lines of the stock model, mm; default: that of the job, then that of about 2 million lines
    #[arg(long, value_name = "MM")]
    step: Option<f64>,
    /// Largest distance of the surface of the cut part from the ends of the lines, mm; default: that of the job, then a fiftieth of the
    /// step
    #[arg(long, value_name = "MM")]
    mesh_tolerance: Option<f64>,
    /// Largest memory of the run, MB: stock model, moves, surface and comparison; default: that of the job, then 4000
    #[arg(long, value_name = "MB")]
    memory: Option<f64>,
    /// Prove the cut stock against the moves by branch and bound; takes longer
    #[arg(long)]
    certified: bool,
    /// Measure how the tools are engaged in each block; by itself for programs of less than 20 000 moves
    #[arg(long, conflicts_with = "no_engagement")]
    engagement: bool,
    /// Do not measure it
    #[arg(long)]
    no_engagement: bool,
    /// Distances by which the zero, each tool's length and the raw stock may be off, mm: contacts are looked for over the whole range; default: that of
    /// the job, then not at all
    #[arg(long, value_name = "OFFSET,LENGTH,STOCK", value_parser = uncertainty)]
    uncertainty: Option<Uncertainty>,
    /// Wanted part to compare the cut part with: a closed STL or 3MF mesh in part coordinates, of a program by itself those of the work
    /// offset; default: that of the job
    #[arg(long, value_name = "FILE.stl|FILE.3mf")]
    design: Option<PathBuf>,
    /// With --design: largest allowed distance of the cut part from it, mm; default: that of the job, then 0.1
    #[arg(long, value_name = "MM", requires = "design")]
    design_tolerance: Option<f64>,
}

impl Stock {
    fn wants(&self) -> Result<StockWants, Error> {
        let Stock {
            step,
            mesh_tolerance,
            memory,
            certified,
            engagement,
            no_engagement,
            uncertainty,
            design,
            design_tolerance,
        } = self;
        let design = design.as_ref().map(|path| {
            let bytes = files::bytes(path, FileKind::Mesh)?;
            Ok::<_, Error>(DesignWants {
                name: path.display().to_string(),
                bytes,
                tolerance: *design_tolerance,
            })
        });
        Ok(StockWants {
            step: *step,
            mesh_tolerance: *mesh_tolerance,
            memory: *memory,
            certified: *certified,
            engagement: (*engagement || *no_engagement).then_some(*engagement),
            uncertainty: *uncertainty,
            design: design.transpose()?,
            ..StockWants::default()
        })
    }
}

/// A file of the cut part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "lower")]
enum MeshFile {
    Stl,
    Glb,
    Ply,
    #[value(name = "3mf")]
    ThreeMf,
    None,
}

impl Results {
    fn files(&self) -> ResultFiles {
        let mut meshes: Vec<MeshForm> = Vec::new();
        for form in &self.mesh {
            let form = match form {
                MeshFile::Stl => MeshForm::Stl,
                MeshFile::Glb => MeshForm::Glb,
                MeshFile::Ply => MeshForm::Ply,
                MeshFile::ThreeMf => MeshForm::ThreeMf,
                MeshFile::None => continue,
            };
            if !meshes.contains(&form) {
                meshes.push(form);
            }
        }
        let inspect = InspectWants {
            sections: self.section.clone(),
            points: self.probe.iter().map(|p| (*p).into()).collect(),
            measures: self
                .measure
                .iter()
                .map(|[a, b, c, u, v, w]| [[*a, *b, *c].into(), [*u, *v, *w].into()])
                .collect(),
        };
        ResultFiles { meshes, report: !self.no_report, playback: !self.no_playback, inspect }
    }

    fn to(&self) -> To<'_> {
        To { out: Some(&self.out), ..To::default() }
    }
}

#[derive(Debug, clap::Args)]
pub(crate) struct Run {
    /// The job file
    job: PathBuf,
    /// Plan other ways of a face too, each with its price, for the report
    #[arg(long)]
    compare: bool,
    #[command(flatten)]
    stock: Stock,
    #[command(flatten)]
    results: Results,
}

impl Run {
    /// Runs a job.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let wants = RunWants { compare: self.compare, stock: self.stock.wants()? };
        let done = run::run(&self.job, &wants, &self.results.files(), files::read(), &Bar::new())?;
        answer(args, self.results.to(), done)
    }
}

/// A program that others wrote, and what is known about it.
#[derive(Debug, clap::Args)]
pub(crate) struct ProgramOf {
    /// The program
    pub(crate) program: PathBuf,
    /// Job file with tools, stock, machine, clamping and design; its own operations do not count
    #[arg(long, value_name = "JOB", conflicts_with_all = ["machine", "tools", "position"])]
    job: Option<PathBuf>,
    /// With --job: the clamping of the job that it runs in
    #[arg(long, value_name = "N", requires = "job")]
    setup: Option<usize>,
    /// The machine, for axis limits and rotary axes: a machine file, or a machine that kinecut knows
    #[arg(long, value_name = "MACHINE")]
    machine: Option<String>,
    /// Machine position of the work zero, mm
    #[arg(long, value_name = "X,Y,Z", value_parser = triple, allow_hyphen_values = true, requires = "machine")]
    position: Option<[f64; 3]>,
    /// TOML file with the tools ([[tool]], [[holder]]), as a job file is one; or a tool table of LinuxCNC (.tbl)
    #[arg(long, value_name = "FILE")]
    tools: Option<PathBuf>,
    /// Pass over M codes of the machine that move no axis by custom (clamps, gears, relays), each with a warning
    #[arg(long)]
    tolerant: bool,
    /// Parameter file of a LinuxCNC machine (linuxcnc.var): its work offsets, and the places of G28 and G30
    #[arg(long, value_name = "FILE")]
    parameters: Option<PathBuf>,
    /// The machine counts in inches: lengths in its tool table and its parameters; default: mm
    #[arg(long)]
    machine_in_inches: bool,
    /// Number of the tool in the spindle before the program calls one
    #[arg(long, value_name = "N")]
    tool: Option<u32>,
    /// Most blocks that the program may run in loops and calls; default: 20 million
    #[arg(long, value_name = "N")]
    blocks: Option<u64>,
    /// Folder with subprograms that it calls, as seen from the folder of the program; can be given several times
    #[arg(long, value_name = "FOLDER")]
    subprograms: Vec<String>,
    /// Place of the tip before the program moves it, in coordinates of the work offset, mm
    #[arg(long, value_name = "X,Y,Z", value_parser = triple, allow_hyphen_values = true)]
    start: Option<[f64; 3]>,
    /// On FANUC, coordinates without a decimal point: whole units, or least increments; default: what the program suggests
    #[arg(long, value_name = "INPUT")]
    input: Option<Input>,
}

impl ProgramOf {
    /// The job about the program.
    pub(crate) fn given(
        &self,
        control: Option<&String>,
        stock: Option<&RawStock>,
        cut: bool,
        save: Option<&Path>,
    ) -> Result<GivenJob, Error> {
        let name = self.program.display().to_string();
        let bytes = files::bytes(&self.program, FileKind::Program)?;
        let program = GivenFile { name: &name, bytes: &bytes };
        let named = |path: &Path| {
            let name = path.display().to_string();
            files::text(&name).map(|text| (name, text))
        };
        let mut wants = ProgramWants {
            control: control.cloned(),
            input: self.input.map(Input::of),
            blocks: self.blocks,
            subprograms: self.subprograms.clone(),
            start: self.start,
            beside: self.beside(control, &bytes),
            stock: stock.map(RawStock::given).transpose()?,
            position: self.position,
            tool: self.tool,
            tolerant: self.tolerant,
            parameters: self.parameters.as_deref().map(kept_named).transpose()?,
            machine_in_inches: self.machine_in_inches,
            setup: self.setup,
            ..ProgramWants::default()
        };
        if let Some(path) = &self.job {
            let (name, text) = named(path)?;
            return given_with_job(program, &wants, (&name, &text), &files::beside(path).0);
        }
        wants.machine = self.machine.as_deref().map(machine::of_name).transpose()?;
        wants.tools = self.tools.as_deref().map(tools_named).transpose()?;
        let lacks = cut && (wants.stock.is_none() || wants.tools.is_none());
        if lacks || save.is_some() {
            let guess = Guess::of(program, &wants)?;
            if let Some(file) = save {
                let mut kept = Vec::new();
                let table = self.tools.as_ref().filter(|name| is_tool_table(&name.display().to_string()));
                for (key, name) in [("tool_table", table), ("parameters", self.parameters.as_ref())] {
                    if let Some(name) = name.filter(|_| guess.control() == Control::LinuxCnc) {
                        kept.push((key, seen_from(file, name, &format!("`{}`", name.display()))?));
                    }
                }
                files::write_one(file, &guess.job(&seen_from(file, &self.program, "its program")?, &kept))?;
            }
            if cut {
                guess.complete(&mut wants)?;
            }
        }
        given_alone(program, &wants, cut)
    }
}

impl ProgramOf {
    /// Files beside the program with what it calls.
    fn beside(&self, control: Option<&String>, bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
        let (loader, name) = files::beside(&self.program);
        // A control that is not known is said where the program is read.
        let said = control.map(String::as_str);
        let Ok((control, _)) = control_of(said, None, &name, bytes) else { return Vec::new() };
        let folder = self.program.parent().map(|p| p.display().to_string()).filter(|p| !p.is_empty());
        let text = program_text(bytes).0;
        let named = |file: String| match &folder {
            Some(folder) => format!("{folder}{}{file}", if folder.ends_with(['/', '\\']) { "" } else { "/" }),
            None => file,
        };
        let called = subprograms(&name, &text, control, &self.subprograms, &loader);
        called.into_iter().map(|called| (named(called.file), called.text.as_bytes().to_vec())).collect()
    }
}

/// Name and text of a file of tools; a tool table need not be UTF-8.
fn tools_named(path: &Path) -> Result<(String, String), Error> {
    let name = path.display().to_string();
    match is_tool_table(&name) {
        true => kept_named(path),
        false => files::text(&name).map(|text| (name, text)),
    }
}

/// Name and text of a file that a control keeps, which need not be UTF-8.
fn kept_named(path: &Path) -> Result<(String, String), Error> {
    let text = program_text(&files::bytes(path, FileKind::Program)?).0.into_owned();
    Ok((path.display().to_string(), text))
}

/// A program, or `what` else, as a job file names it: from the folder of the job, beside which or below which it lies.
fn seen_from(job: &Path, program: &Path, what: &str) -> Result<String, Error> {
    let whole = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let (own, program) = (whole(job), whole(program));
    let folder = own.parent().unwrap_or(Path::new(""));
    match program.strip_prefix(folder) {
        Ok(file) => Ok(file.display().to_string()),
        Err(_) => {
            let message = format!("the job `{}` would lie neither beside {what} nor above it", job.display());
            let beside = program.with_file_name("job.toml");
            Err(Finding::error(Code::OUTPUT_NOT_WRITTEN, message)
                .help(format!("write it to {}", beside.display()))
                .into())
        }
    }
}

/// Raw stock as an option names it.
#[derive(Clone, Debug)]
pub(crate) enum RawStock {
    /// A block between two corners.
    Block([f64; 6]),
    /// A file.
    Mesh(PathBuf),
}

impl RawStock {
    fn parse(text: &str) -> Result<RawStock, String> {
        let lower = text.to_ascii_lowercase();
        if lower.ends_with(".stl") || lower.ends_with(".3mf") {
            return Ok(RawStock::Mesh(PathBuf::from(text)));
        }
        corners(text)
            .map(RawStock::Block)
            .map_err(|help| format!("{help}, or the name of an STL or 3MF file"))
    }

    fn given(&self) -> Result<GivenStock, Error> {
        Ok(match self {
            RawStock::Block(corners) => GivenStock::Block(*corners),
            RawStock::Mesh(path) => {
                GivenStock::Mesh(path.display().to_string(), files::bytes(path, FileKind::Mesh)?)
            }
        })
    }
}

/// A control that is not told by the file.
#[derive(Debug, clap::Args)]
pub(crate) struct RunBy {
    /// The control that runs it; default: that of the job, then that of the file's ending (.mpf .ngc .gcode .h)
    #[arg(long, value_name = "CONTROL")]
    pub(crate) control: Option<String>,
}

/// File of a job that is made of a program alone.
#[derive(Debug, clap::Args)]
pub(crate) struct WriteJob {
    /// Save stock and tools, guessed from the comments and the moves of the program, as a job file to correct
    #[arg(long, value_name = "FILE", conflicts_with = "job")]
    write_job: Option<PathBuf>,
}

/// Coordinates without a decimal point.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(crate) enum Input {
    Auto,
    Calculator,
    LeastIncrement,
}

impl Input {
    fn of(self) -> NumberInput {
        match self {
            Input::Auto => NumberInput::Auto,
            Input::Calculator => NumberInput::Calculator,
            Input::LeastIncrement => NumberInput::LeastIncrement,
        }
    }
}

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  kinecut simulate O1234.nc --job job.toml --out out
  kinecut simulate part.ngc --stock \"-5,-5,-20,105,65,0\" --tools tools.toml --out out
  kinecut simulate part.ngc --stock casting.stl --tools tools.toml --out out
  kinecut simulate job.toml --out out    a job whose setup says program = { file = \"O1234.nc\" }")]
pub(crate) struct Simulate {
    #[command(flatten)]
    of: ProgramOf,
    #[command(flatten)]
    by: RunBy,
    /// Raw stock in coordinates of the work offset, mm: least and greatest corner of a block, or the name of a closed STL or 3MF mesh
    #[arg(long, value_name = "X0,Y0,Z0,X1,Y1,Z1|FILE.stl|FILE.3mf", value_parser = RawStock::parse, allow_hyphen_values = true, conflicts_with = "job")]
    stock: Option<RawStock>,
    #[command(flatten)]
    save: WriteJob,
    #[command(flatten)]
    cut: Stock,
    #[command(flatten)]
    results: Results,
}

impl Simulate {
    /// Cuts a program of others.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let path = &self.of.program;
        let done = if is_job(path) {
            run::simulate_job(path, &self.cut.wants()?, &self.results.files(), files::read(), &Bar::new())?
        } else {
            let mut given = self.of.given(
                self.by.control.as_ref(),
                self.stock.as_ref(),
                true,
                self.save.write_job.as_deref(),
            )?;
            given.simulated(&self.cut.wants()?)?;
            run::simulate_given(given, &self.results.files(), &Bar::new())?
        };
        answer(args, self.results.to(), done)
    }
}

/// Whether a file is a job, not a program.
pub(crate) fn is_job(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}

#[derive(Debug, clap::Args)]
pub(crate) struct Check {
    #[command(flatten)]
    of: ProgramOf,
    #[command(flatten)]
    by: RunBy,
    #[command(flatten)]
    save: WriteJob,
}

impl Check {
    /// Reads a program of others and says what is wrong with it.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let given = self.of.given(self.by.control.as_ref(), None, false, self.save.write_job.as_deref())?;
        let sheet = program_sheet(&given)?;
        let wrong = sheet.errors > 0;
        let code = answer(args, To::default(), sheet)?;
        Ok(if wrong { code.max(crate::WRONG_INPUT) } else { code })
    }
}

#[derive(Debug, clap::Args)]
#[command(
    after_help = "A word that the other control does not have is an error at its block; one that moves nothing there is a
finding. The new text is read back and compared with the old one."
)]
pub(crate) struct Post {
    #[command(flatten)]
    of: ProgramOf,
    /// The control that it was written for; default: that of the job, then that of the file's ending
    #[arg(long, value_name = "CONTROL")]
    from: Option<String>,
    /// The control that it is to be written for: sinumerik-840d, fanuc, linuxcnc, grbl, heidenhain
    #[arg(long, value_name = "CONTROL")]
    to: String,
    /// Form of the directions of the tool; default: as they are in the program
    #[arg(long, value_enum)]
    orientation: Option<Orientation>,
    /// Decimals of coordinates, 3 to 6; default: as usual on the control
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(3..=6))]
    decimals: Option<u8>,
    /// File for the new text; without it: standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Form of the directions of the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Orientation {
    /// As vectors, with control of the tool centre point
    Vectors,
    /// As angles of the rotary axes, with control of the tool centre point
    Angles,
    /// As positions of all axes
    Axes,
}

impl Post {
    /// Writes a program of others for another control.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let given = self.of.given(self.from.as_ref(), None, false, None)?;
        let mut post = PostSettings::new(Control::parse(&self.to)?);
        post.program_name = program_name(&self.of.program);
        post.decimals = self.decimals.unwrap_or(post.decimals);
        let orientation = self.orientation.map(|o| match o {
            Orientation::Vectors => OrientationName::Vectors,
            Orientation::Angles => OrientationName::Angles,
            Orientation::Axes => OrientationName::Axes,
        });
        let data = self.output.as_deref().map_or(Data::Alone, Data::File);
        let to = To { data, ..To::default() };
        answer(args, to, translate(&given, &post, orientation)?)
    }
}

/// A name for the program that every control takes, from that of its file.
fn program_name(path: &Path) -> String {
    let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '_' };
    let name: String = stem.chars().map(plain).take(24).collect();
    if name.is_empty() { "PROGRAM".to_owned() } else { name }
}
