//! Programs that others wrote, checked: the text, its control, the values of the registers.

use std::borrow::Cow;
use std::sync::Arc;

use super::super::Subject;
use super::super::file::ProgramTable;
use super::kept::kept;
use crate::base::bounded::{MAX_LENGTH, length};
use crate::base::{Code, FileKind, Finding, Loader, Result};
use crate::nc::{self, Control, Kept, NumberInput, ReadSettings};
use crate::operations::{CalledTool, tool_of};
use crate::tool::{Tool, ToolNumber};

/// A program that others wrote.
#[derive(Clone, Debug, PartialEq)]
pub struct JobProgram {
    /// Name of its file, as the job spells it.
    pub file: String,
    /// The control that runs it.
    pub control: Control,
    /// Its text.
    pub text: Arc<str>,
    /// Whether the file was no UTF-8 and was read as Latin-1.
    pub is_latin: bool,
    /// The tool that is in the spindle at the beginning.
    pub in_spindle: Option<ToolNumber>,
    /// Lengths that registers hold, where they are given [mm].
    pub lengths: Vec<(u32, f64)>,
    /// Radii that registers hold, where they are given [mm].
    pub radii: Vec<(u32, f64)>,
    /// Meaning of coordinates without a decimal point (FANUC).
    pub input: NumberInput,
    /// Most blocks that it may run in loops and calls.
    pub blocks: u64,
    /// Place of the tip before the program moves it, in coordinates of the work offset [mm].
    pub start: Option<[f64; 3]>,
    /// Words of its text that told the control, where nobody said it.
    pub detected: Option<String>,
    /// Guesses about its stock and tools, in words.
    pub guessed: Vec<String>,
    /// Whether M codes of the machine that move no axis by custom are passed over.
    pub tolerant: bool,
    /// What the machine keeps from programs before.
    pub kept: Kept,
    /// The files that tell it.
    pub kept_in: Vec<Subject>,
    /// Files beside it with programs that it calls.
    pub beside: Vec<Subprogram>,
}

impl JobProgram {
    /// A program from the bytes of its file.
    pub fn new(file: impl Into<String>, bytes: &[u8], control: Control) -> JobProgram {
        let (text, is_latin) = program_text(bytes);
        JobProgram {
            file: file.into(),
            control,
            text: text.into(),
            is_latin,
            in_spindle: None,
            lengths: Vec::new(),
            radii: Vec::new(),
            input: NumberInput::Auto,
            blocks: ReadSettings::BLOCKS,
            start: None,
            detected: None,
            guessed: Vec::new(),
            tolerant: false,
            kept: Kept::default(),
            kept_in: Vec::new(),
            beside: Vec::new(),
        }
    }
}

/// A file with a program that another calls.
#[derive(Clone, Debug, PartialEq)]
pub struct Subprogram {
    /// The name by which it is called.
    pub name: String,
    /// Its file, as seen from where the job is.
    pub file: String,
    /// Its text.
    pub text: Arc<str>,
}

/// Files that hold what a program calls, and what those call: beside it, and then in `folders`, which are seen from its own. One
/// that is not there is missed where it is called.
pub fn subprograms(
    file: &str,
    text: &str,
    control: Control,
    folders: &[String],
    loader: &dyn Loader,
) -> Vec<Subprogram> {
    let (folder, own) = match file.rfind(['/', '\\']) {
        Some(at) => file.split_at(at + 1),
        None => ("", file),
    };
    let own = own.rsplit_once('.').map(|(_, ending)| ending);
    let endings = [own.unwrap_or_default(), control.extension(), ""];
    let mut found: Vec<Subprogram> = Vec::new();
    let mut asked = nc::called(text, control);
    let mut next = 0;
    while next < asked.len() && next < MOST_CALLED {
        let names = asked[next].clone();
        next += 1;
        let folders = std::iter::once(folder.to_owned()).chain(folders.iter().map(|of| within(folder, of)));
        let names: Vec<&String> = names.iter().filter(|name| !name.contains(['/', '\\'])).collect();
        let mut candidates = folders.flat_map(|folder| {
            let named = names.iter().flat_map(|name| endings.iter().map(move |ending| (*name, *ending)));
            named.map(|(name, ending)| (folder.clone(), name.clone(), ending)).collect::<Vec<_>>()
        });
        let there = candidates.find_map(|(folder, name, ending)| {
            let file = match ending {
                "" => format!("{folder}{name}"),
                _ => format!("{folder}{name}.{ending}"),
            };
            let bytes = loader.read_as(&file, FileKind::Program).ok()?;
            Some(Subprogram { name, file, text: program_text(&bytes).0.into() })
        });
        let Some(there) = there else { continue };
        for further in nc::called(&there.text, control) {
            if !asked.contains(&further) {
                asked.push(further);
            }
        }
        found.push(there);
    }
    found
}

/// A folder as seen from another, with a stroke at its end.
fn within(folder: &str, of: &str) -> String {
    let own = if of.starts_with(['/', '\\']) { of.to_owned() } else { format!("{folder}{of}") };
    if own.ends_with(['/', '\\']) { own } else { format!("{own}/") }
}

/// Most programs that one program and what it calls may call in files of their own.
const MOST_CALLED: usize = 1000;

/// The text of a program, and whether it is Latin-1, which older controls and post-processors write, and no UTF-8.
pub fn program_text(bytes: &[u8]) -> (Cow<'_, str>, bool) {
    match std::str::from_utf8(bytes) {
        Ok(text) => (Cow::Borrowed(text.trim_start_matches('\u{feff}')), false),
        Err(_) => (bytes.iter().map(|b| char::from(*b)).collect(), true),
    }
}

pub(super) fn program(
    t: &ProgramTable,
    tools: &[Tool],
    post: Control,
    loader: &dyn Loader,
) -> Result<JobProgram> {
    let control = match &t.control {
        Some(name) => Control::parse(name).map_err(|e| e.under("control"))?,
        None => post,
    };
    let bytes = loader.lend_as(&t.file, FileKind::Program).map_err(|e| e.under("file"))?;
    let mut program = JobProgram::new(t.file.clone(), &bytes, control);
    program.input = t.input;
    program.tolerant = t.tolerant;
    program.blocks = t.blocks.unwrap_or(program.blocks);
    if let Some(start) = t.start {
        for value in start {
            length("start", value, -MAX_LENGTH, MAX_LENGTH)?;
        }
        program.start = Some(start);
    }
    program.beside = subprograms(&program.file, &program.text, control, &t.subprograms, loader);
    (program.kept, program.kept_in) = kept(t, control, loader)?;
    if let Some(number) = t.tool {
        program.in_spindle = Some(tool_of(&CalledTool::Number(number), tools)?.number);
    }
    for (name, value) in &t.registers {
        let key = format!("registers.{name}");
        let value = length(&key, *value, -MAX_LENGTH, MAX_LENGTH)?;
        let (kind, number) = name.split_at(name.len().min(1));
        let digits = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
        match (kind, number.parse::<u32>()) {
            ("H", Ok(number)) if digits => program.lengths.push((number, value)),
            ("D", Ok(number)) if digits => program.radii.push((number, control.compensation_radius(value))),
            _ => {
                return Err(Finding::error(
                    Code::JOB_VALUE,
                    format!("`{}` is no register", name.escape_default()),
                )
                .help("write H and a number for a length, D and a number for a radius")
                .key(key)
                .into());
            }
        }
    }
    Ok(program)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_is_no_utf8_is_read_byte_by_byte() {
        let program = JobProgram::new("a.nc", b"(FR\xc4SER)\nG0 X1", Control::Fanuc);
        assert!(program.is_latin && &*program.text == "(FR\u{c4}SER)\nG0 X1", "{}", program.text);
        let marked = JobProgram::new("a.nc", b"\xef\xbb\xbfG0 X1", Control::Fanuc);
        assert!(!marked.is_latin && &*marked.text == "G0 X1");
    }
}
