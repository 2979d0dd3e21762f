//! Start and end blocks from a template of the user.
//!
//! The template language is Jinja, strict: a name that does not exist is an error, nothing can be loaded, the work and
//! the size of the result are bounded, and there is no clock, so that the same input gives the same bytes. What comes
//! out is read by the reader of the control before it is used: a word that kinecut does not understand cannot get into
//! a program that is to be proven.

use minijinja::{AutoEscape, Environment, ErrorKind, UndefinedBehavior};
use serde::Serialize;

use super::template_size::{self, WITHOUT_FILTERS, WITHOUT_FUNCTIONS};
use crate::base::{Code, Error, Finding, Result, Sources};
use crate::nc::read::{Left, left_by, read};
use crate::nc::{Control, PostSettings, heidenhain};
use crate::program::{Frame, Item, Program, StopKind, ToolNumber};
use crate::tool::Tool;

/// Which of the two templates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TemplatePart {
    Start,
    End,
}

impl TemplatePart {
    /// The setting that holds it.
    pub(super) fn setting(self) -> &'static str {
        match self {
            TemplatePart::Start => "start_template",
            TemplatePart::End => "end_template",
        }
    }

    fn name(self) -> &'static str {
        match self {
            TemplatePart::Start => "start template",
            TemplatePart::End => "end template",
        }
    }
}

/// Steps that a template may take: a thousand times what a long one needs.
const FUEL: u64 = 100_000;
/// Longest template and longest result [bytes].
const LONGEST: usize = 65_536;
/// Longest text that a template may put together [bytes].
const LONGEST_TEXT: f64 = 1e6;
/// Longest line, where the control has no shorter limit [bytes]: LinuxCNC's.
const LONGEST_LINE: usize = 255;

/// Variables of a template.
#[derive(Debug, Serialize)]
struct Context<'a> {
    program_name: &'a str,
    program_number: u32,
    control: &'static str,
    version: &'static str,
    units: &'static str,
    decimals: u8,
    offset: String,
    offsets: Vec<String>,
    tools: Vec<About<'a>>,
}

#[derive(Debug, Serialize)]
struct About<'a> {
    number: u32,
    name: &'a str,
    diameter: Option<f64>,
    length: Option<f64>,
}

fn context<'a>(program: &Program, tools: &'a [Tool], settings: &'a PostSettings) -> Context<'a> {
    let mut numbers: Vec<ToolNumber> = Vec::new();
    let mut offsets: Vec<String> = Vec::new();
    for index in 0..program.items.len() {
        match program.items.get(index) {
            Item::Tool { id, .. } if !numbers.contains(&id) => numbers.push(id),
            Item::Move(_) => {
                if let Some((offset, _)) = program.in_work(program.state(index).frame) {
                    let name = offset.to_string();
                    if offsets.last() != Some(&name) && !offsets.contains(&name) {
                        offsets.push(name);
                    }
                }
            }
            _ => {}
        }
    }
    let about = |number: &ToolNumber| {
        let tool = tools.iter().find(|t| t.number == *number);
        About {
            number: number.0,
            name: tool.map_or("", |t| t.name.as_str()),
            diameter: tool.map(|t| t.cutter.diameter(t.flute_length) / settings.units.mm()),
            length: tool.and_then(|t| t.gauge_length).map(|length| length / settings.units.mm()),
        }
    };
    Context {
        program_name: &settings.program_name,
        program_number: settings.program_number,
        control: settings.control.name(),
        version: crate::VERSION,
        units: settings.units.sign(),
        decimals: settings.decimals,
        offset: offsets.first().cloned().unwrap_or_default(),
        offsets,
        tools: numbers.iter().map(about).collect(),
    }
}

/// The result of a template, up to a bound: the engine stops when it is longer.
struct Room {
    bytes: Vec<u8>,
    most: usize,
}

impl Room {
    fn is_full(&self) -> bool {
        self.bytes.len() > self.most
    }
}

impl std::io::Write for Room {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let room = (self.most + 1).saturating_sub(self.bytes.len()).min(bytes.len());
        self.bytes.extend_from_slice(&bytes[..room]);
        if room == 0 && !bytes.is_empty() {
            return Err(std::io::ErrorKind::StorageFull.into());
        }
        Ok(room)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// The lines of a template, read and found to be a start or an end.
pub(super) fn render(
    text: &str,
    part: TemplatePart,
    program: &Program,
    tools: &[Tool],
    settings: &PostSettings,
) -> Result<Vec<String>> {
    let bad = |what: String| Finding::error(Code::POST_TEMPLATE, format!("the {}: {what}", part.name()));
    if text.len() > LONGEST {
        return Err(too_long(part, text.len(), LONGEST).into());
    }
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    environment.set_auto_escape_callback(|_| AutoEscape::None);
    environment.set_fuel(Some(FUEL));
    WITHOUT_FILTERS.iter().for_each(|name| environment.remove_filter(name));
    WITHOUT_FUNCTIONS.iter().for_each(|name| environment.remove_global(name));
    let context = context(program, tools, settings);
    // A step of the engine may double a text: what that can come to is counted before.
    let names = serde_json::to_string(&context).map_or(LONGEST, |json| json.len());
    let longest = template_size::longest(text, names).map_err(bad)?;
    if longest > LONGEST_TEXT {
        return Err(Finding::error(
            Code::POST_TEMPLATE,
            format!("the texts of the {} could become too long", part.name()),
        )
        .value(longest, "characters")
        .bound(LONGEST_TEXT, "characters")
        .help("put fewer copies of a name together, or write them out where they are printed")
        .into());
    }
    let mut room = Room { bytes: Vec::new(), most: LONGEST };
    let written = environment
        .template_from_named_str(part.name(), text)
        .and_then(|t| t.render_captured_to(minijinja::value::Serde(context), &mut room).map(|_| ()));
    if room.is_full() {
        return Err(too_long(part, room.bytes.len(), LONGEST).into());
    }
    written.map_err(|e| refused(part, &e))?;
    let rendered = String::from_utf8_lossy(&room.bytes);
    let limit = settings.control.dialect().line_limit.unwrap_or(LONGEST_LINE);
    let mut lines = Vec::new();
    for (index, line) in rendered.lines().enumerate() {
        let line = line.trim();
        if let Some(c) = line.chars().find(|c| !(' '..='~').contains(c)) {
            let c = c.escape_default();
            return Err(bad(format!(
                "line {} of its result has the character `{c}`, which is not for a control",
                index + 1
            ))
            .into());
        }
        if line.len() > limit {
            return Err(too_long(part, line.len(), limit).into());
        }
        if !line.is_empty() {
            lines.push(line.to_owned());
        }
    }
    check(&lines, part, settings).map(|()| lines)
}

/// As [`check`], in klartext: after the first line of a program of its own.
fn check_klartext(lines: &[String], part: TemplatePart) -> Result<()> {
    let bad = |what: &str| Finding::error(Code::POST_TEMPLATE, format!("the {}: {what}", part.name()));
    if lines.iter().any(|l| l.ends_with('~')) {
        return Err(bad("a block over several lines (~) is not taken").into());
    }
    let frame = |l: &String| l.starts_with("BEGIN PGM") || l.starts_with("END PGM");
    if lines.iter().any(frame) {
        return Err(bad("BEGIN PGM and END PGM are written by the program itself").into());
    }
    let body = lines.join("\n");
    // Without END PGM, which would itself end the program.
    let text = format!("BEGIN PGM T MM\n{body}\n");
    let mut sources = Sources::default();
    let reading = read(&mut sources, part.name(), &text, Control::Heidenhain, &[]).map_err(|e| {
        // The first line is ours.
        let place = e.0.place.as_ref().map_or(0, |p| p.line.saturating_sub(1));
        Error(Box::new(bad(&format!("line {place} of its result: {}", e.0.message))))
    })?;
    let frames = &reading.program.frames;
    let turned = frames.iter().any(|f| matches!(f, Frame::Shift { .. } | Frame::Tilted { .. }));
    let controlled = reading.findings.iter().any(|f| f.message == heidenhain::TIP_CONTROLLED);
    let items = &reading.program.items;
    let any = |wanted: &dyn Fn(Item<'_>) -> bool| (0..items.len()).any(|i| wanted(items.get(i)));
    let moves = any(&|item| matches!(item, Item::Move(_) | Item::Cycle(..)));
    let ended = any(&|item| matches!(item, Item::Stop(StopKind::End)));
    match (part, ended, moves) {
        (TemplatePart::End, false, _) => Err(bad("it does not end the program (M30)").into()),
        (TemplatePart::Start, true, _) => Err(bad("it ends the program").into()),
        (TemplatePart::Start, _, true) => Err(bad("it moves axes; only an end may").into()),
        // A shift that is taken back in the same template is of no use.
        (TemplatePart::Start, ..) if turned => {
            Err(bad("it shifts, turns or tilts the coordinates, which may be left so").into())
        }
        (TemplatePart::Start, ..) if controlled => {
            Err(bad("it leaves the control of the tool centre point on (M128)").into())
        }
        _ => Ok(()),
    }
}

/// The blocks must be understood, and leave the control as the writer needs it.
fn check(lines: &[String], part: TemplatePart, settings: &PostSettings) -> Result<()> {
    if settings.control == Control::Heidenhain {
        return check_klartext(lines, part);
    }
    let bad = |what: &str| Finding::error(Code::POST_TEMPLATE, format!("the {}: {what}", part.name()));
    let mut sources = Sources::default();
    let left = left_by(&mut sources, part.name(), &lines.join("\n"), settings.control).map_err(|e| {
        let place = e.0.place.as_ref().map_or(0, |p| p.line);
        Error(Box::new(bad(&format!("line {place} of its result: {}", e.0.message))))
    })?;
    let inches = settings.units.is_inch();
    let wrong = match (part, left) {
        (_, Left { tape: true, .. }) => "a line with % ends the program",
        (TemplatePart::End, Left { ended: false, .. }) => "it does not end the program (M30)",
        (TemplatePart::Start, Left { ended: true, .. }) => "it ends the program",
        (TemplatePart::Start, Left { absolute: false, .. }) => "it leaves the control in increments (G91)",
        (TemplatePart::Start, Left { units_said: false, .. }) if inches => {
            "it does not say the units (G20, G700)"
        }
        (TemplatePart::Start, Left { units_said: false, .. }) => "it does not say the units (G21, G710)",
        (TemplatePart::Start, Left { inch: true, .. }) if !inches => "it leaves the control in inches",
        (TemplatePart::Start, Left { inch: false, .. }) if inches => {
            "it leaves the control in millimetres, and the program is in inches"
        }
        (TemplatePart::Start, Left { centre_absolute: true, .. }) => {
            "it leaves the centres of arcs absolute (G90.1)"
        }
        (TemplatePart::Start, Left { turned: true, .. }) => "it leaves the coordinates shifted or turned",
        (TemplatePart::Start, Left { moves: true, .. }) => "it moves axes; only an end may",
        _ => return Ok(()),
    };
    Err(bad(wrong).into())
}

fn too_long(part: TemplatePart, found: usize, bound: usize) -> Finding {
    Finding::error(Code::POST_TEMPLATE, format!("the {} or a line of its result is too long", part.name()))
        .value(found as f64, "characters")
        .bound(bound as f64, "characters")
}

/// The engine's message, with the line of the template.
fn refused(part: TemplatePart, error: &minijinja::Error) -> Finding {
    let place = error.line().map_or_else(String::new, |line| format!(" line {line}"));
    let detail = error.detail().map_or_else(String::new, |d| format!(": {d}"));
    let finding =
        Finding::error(Code::POST_TEMPLATE, format!("the {}{place}: {}{detail}", part.name(), error.kind()));
    match error.kind() {
        ErrorKind::UndefinedError => finding.help(
            "names: program_name, program_number, control, version, units, decimals, offset, offsets, tools (number, name, diameter, length)",
        ),
        ErrorKind::OutOfFuel => finding.help("the template loops for too long"),
        _ => finding,
    }
}
