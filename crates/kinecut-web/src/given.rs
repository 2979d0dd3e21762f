//! Programs that others wrote: what a request says of them, and what is guessed.

use kinecut::base::{FileKind, Result};
use kinecut::job::machine::{LoadOptions, load};
use kinecut::job::{
    DesignWants, GivenFile, GivenJob, GivenStock, ProgramWants, StockWants, control_of, given_alone,
    given_with_job, is_tool_table, program_text, subprograms,
};
use kinecut::verbs::guess::Guess;
use serde::Deserialize;

use crate::app::App;
use crate::folder::split;
use crate::refusal::Refusal;
use crate::texts::Texts;

/// What a request says of a program.
#[derive(Clone, Debug, Default, Deserialize)]
pub(crate) struct GivenWants {
    /// A job with tools, stock, machine and clamping.
    job: Option<String>,
    /// Which clamping of the job, from 1.
    setup: Option<usize>,
    control: Option<String>,
    /// A file, or a machine that kinecut knows.
    machine: Option<String>,
    tools: Option<String>,
    stock: Option<[f64; 6]>,
    position: Option<[f64; 3]>,
    start: Option<[f64; 3]>,
    tool: Option<u32>,
    #[serde(default)]
    tolerant: bool,
    design: Option<String>,
    design_tolerance: Option<f64>,
}

/// The same with the names of its files.
pub(crate) struct GivenFiles {
    wants: GivenWants,
    job: Option<String>,
    machine: Option<String>,
    tools: Option<String>,
    design: Option<String>,
}

impl GivenWants {
    /// Finds the files.
    ///
    /// # Errors
    /// One of them is not there.
    pub(crate) fn files(self, app: &App) -> std::result::Result<GivenFiles, Refusal> {
        let named = |id: &Option<String>| id.as_ref().map(|id| app.file(id).map(|f| f.name)).transpose();
        let (job, tools, design) = (named(&self.job)?, named(&self.tools)?, named(&self.design)?);
        let machine = self.machine.as_ref().map(|id| machine_named(app, id)).transpose()?;
        Ok(GivenFiles { wants: self, job, machine, tools, design })
    }
}

impl GivenFiles {
    /// The job about the program; `cut`: it needs a stock. What was guessed, in words, comes with it.
    ///
    /// # Errors
    /// Those of the files, of the program, and of what cannot be guessed.
    pub(crate) fn job(&self, app: &App, texts: &Texts, cut: bool) -> Result<(GivenJob, Vec<String>)> {
        let bytes = texts.program(app)?;
        let program = GivenFile { name: &texts.name, bytes: &bytes };
        let mut wants = self.of_program(app, texts, &bytes);
        if let Some(job) = &self.job {
            let text = texts.text_of(app, job, FileKind::Text)?;
            let disk = app.folder.beside(job);
            let given = given_with_job(program, &wants, (job, &text), &texts.over(&disk, job))?;
            return Ok((given, Vec::new()));
        }
        self.add_files(app, texts, &mut wants)?;
        if cut && (wants.stock.is_none() || wants.tools.is_none()) {
            Guess::of(program, &wants)?.complete(&mut wants)?;
        }
        let given = given_alone(program, &wants, cut)?;
        Ok((given, wants.guessed))
    }

    /// A job about the program with what is guessed, as a text for a file beside it.
    ///
    /// # Errors
    /// Those of the files, and of a program whose control nothing tells.
    pub(crate) fn guessed_job(&self, app: &App, texts: &Texts) -> Result<String> {
        let bytes = texts.program(app)?;
        let mut wants = self.of_program(app, texts, &bytes);
        self.add_files(app, texts, &mut wants)?;
        let program = GivenFile { name: &texts.name, bytes: &bytes };
        Ok(Guess::of(program, &wants)?.job(split(&texts.name).1, &[]))
    }

    /// The part that is about the program itself.
    fn of_program(&self, app: &App, texts: &Texts, bytes: &[u8]) -> ProgramWants {
        let said = &self.wants;
        let disk = app.folder.beside(&texts.name);
        let loader = texts.over(&disk, &texts.name);
        ProgramWants {
            control: said.control.clone(),
            stock: said.stock.map(GivenStock::Block),
            position: said.position,
            start: said.start,
            tool: said.tool,
            tolerant: said.tolerant,
            setup: said.setup,
            beside: beside(texts, said.control.as_deref(), bytes, &loader),
            ..ProgramWants::default()
        }
    }

    /// Adds the files of the machine and of the tools.
    fn add_files(&self, app: &App, texts: &Texts, wants: &mut ProgramWants) -> Result<()> {
        wants.machine = self.machine.as_ref().map(|name| machine(app, texts, name)).transpose()?;
        let tools = self.tools.as_ref().map(|name| {
            let kind = if is_tool_table(name) { FileKind::Program } else { FileKind::Text };
            texts.text_of(app, name, kind).map(|text| (name.clone(), text))
        });
        wants.tools = tools.transpose()?;
        Ok(())
    }

    /// The design that the cut part is compared with, put into settings of the simulation.
    ///
    /// # Errors
    /// Those of reading it.
    pub(crate) fn design(&self, app: &App, wants: &mut StockWants) -> Result<()> {
        let Some(name) = &self.design else { return Ok(()) };
        let bytes = app.folder.read(name, FileKind::Mesh)?;
        wants.design =
            Some(DesignWants { name: name.clone(), bytes, tolerance: self.wants.design_tolerance });
        Ok(())
    }
}

/// The path below the folder of a machine file, or the name of a machine that kinecut may know: no path.
fn machine_named(app: &App, id: &str) -> std::result::Result<String, Refusal> {
    match app.file(id) {
        Ok(file) => Ok(file.name),
        Err(_) if !id.contains(['/', '\\', ':', '.']) => Ok(id.to_owned()),
        Err(refusal) => Err(refusal),
    }
}

/// A machine of a file, or one that kinecut knows.
fn machine(app: &App, texts: &Texts, name: &str) -> Result<kinecut::machine::Machine> {
    let disk = app.folder.beside(name);
    let loader = texts.over(&disk, name);
    load(split(name).1, name, &LoadOptions::default(), &loader).map(|loaded| loaded.machine)
}

/// Programs beside one that it calls, named as it is.
fn beside(
    texts: &Texts,
    control: Option<&str>,
    bytes: &[u8],
    loader: &kinecut::base::OverlayLoader<'_>,
) -> Vec<(String, Vec<u8>)> {
    let (folder, name) = split(&texts.name);
    // A control that is not known is said where the program is read.
    let Ok((control, _)) = control_of(control, None, name, bytes) else { return Vec::new() };
    let called = subprograms(name, &program_text(bytes).0, control, &[], loader);
    let named = |file: String| if folder.is_empty() { file } else { format!("{folder}/{file}") };
    called.into_iter().map(|called| (named(called.file), called.text.as_bytes().to_vec())).collect()
}
