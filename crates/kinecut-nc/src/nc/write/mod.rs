//! From a program to the text of a control.
//!
//! For post-processing and for translating between controls. The items are walked once; modal words are repeated
//! only when they change or when a tool change makes a restart point. The writer adds no motion of its own:
//! retractions, approaches and their order are the program's.

mod arc;
mod call;
mod comp;
mod cubic;
mod cycle;
mod data;
mod involute;
mod klartext;
mod moves;
mod page;
mod plane;
mod remark;
mod rotary_axes;
mod series;
mod shares;
mod spiral;
mod state;
mod tap;
mod template;
mod template_size;
mod turn;

use std::collections::BTreeSet;

use crate::base::{Code, Error, Finding, Result};
use crate::program::{Coolant, Item, OwnLength, Program, Spindle, StopKind, ToolNumber};
use crate::tool::Tool;

use super::dialect::Dialect;
use super::grid::Grid;
use super::multi_axis::TcpWord;
use super::{Control, PostNotes, PostSettings, Posted};
use page::Page;
use state::Modal;

/// The program as the text of a control.
///
/// The `tools` that the program uses are listed in the head of the text.
///
/// ```
/// # use kinecut_nc as kinecut;
/// use glam::DVec3;
/// use kinecut::geom::Line;
/// use kinecut::nc::{self, Control, PostSettings};
/// use kinecut::program::{Frame, Move, Origin, Program, SetupId, Speed, State, ToolNumber, WorkOffset};
///
/// let mut program = Program::default();
/// let frame = program.add_frame(Frame::Work(WorkOffset::G54));
/// let mut state = State::start(SetupId(0), frame);
/// program.push_tool(ToolNumber(1), Some(1), Some(1), &state, Origin::default());
/// let mut to = |x: f64, z: f64, speed| {
///     state.speed = speed;
///     let end = DVec3::new(x, 0.0, z);
///     program.push_move(Move::along(&Line { start: end, end }.into()), &state, Origin::default());
/// };
/// to(0.0, 5.0, Speed::Rapid { linear: false });
/// to(0.0, -1.0, Speed::PerMinute(5.0));
/// to(20.5, -1.0, Speed::PerMinute(10.0));
///
/// let posted = nc::write(&program, &[], &PostSettings::new(Control::Sinumerik840d)).unwrap();
/// assert!(posted.text.contains("N70 G1 Z-1 F300\nN80 X20.5 F600\n"), "{}", posted.text);
/// ```
///
/// # Errors
/// `KC0301` when the control has no words for something in the program, `KC0302` for numbers that do not fit,
/// `KC0204` when the program lacks something (a feed, a known start).
pub fn write(program: &Program, tools: &[Tool], settings: &PostSettings) -> Result<Posted> {
    let dialect = settings.control.dialect();
    if !Control::WRITTEN.contains(&settings.control) {
        let message = format!("programs for {} are read, not written", settings.control.title());
        let known: Vec<&str> = Control::WRITTEN.iter().map(|c| c.name()).collect();
        return Err(Finding::error(Code::POST_CONTROL, message)
            .help(format!("write for {}", known.join(", ")))
            .into());
    }
    if settings.cubic && !dialect.has_cubic() {
        return Err(unsupported(format!("{} has no cubics (G5)", settings.control.title()))
            .help("leave `cubic` out")
            .into());
    }
    let unit = settings.units.mm();
    let grid = Grid::in_units(settings.decimals, settings.resolution, dialect.point, unit)?;
    let supported = turn::supported(program, settings, dialect, &grid)?;
    let (program, turns, planes) = match &supported {
        Some(said) => (&said.program, said.turns.as_slice(), said.planes.as_slice()),
        None => (program, [].as_slice(), [].as_slice()),
    };
    let mut writer = Writer {
        program,
        turns,
        planes,
        tools,
        settings,
        dialect,
        grid,
        page: Page::default(),
        notes: PostNotes { tilt: supported.as_ref().map_or(0.0, |s| s.tilt), ..PostNotes::default() },
        modal: Modal::default(),
        place: ToolPosition::default(),
        tool: None,
        length: None,
        length_suspended: false,
        length_line: None,
        length_pending: None,
        ended: false,
        remarks_end: 0,
        parameters_used: false,
        turns_kept: false,
        beyond_turn: false,
        own_lengths: Vec::new(),
        own_radii: Vec::new(),
        shares: None,
    };
    if writer.klartext() {
        writer.grid = writer.grid.signed();
        writer.begin_program();
    }
    writer.head(tools)?;
    for index in 0..program.items.len() {
        writer.page.item = Some(index as u32);
        writer.item(index).map_err(|e| of_item(e, index))?;
    }
    writer.page.item = None;
    writer.uncompensated("the program ends")?;
    if !writer.ended {
        writer.end()?;
    }
    writer.remark_parameters();
    writer.remark_turns();
    writer.remark_whole_turns();
    if let Some(tape) = dialect.tape {
        writer.page.line(tape.to_owned());
    }
    if writer.klartext() {
        writer.end_program();
        klartext::speed::in_tool_calls(&mut writer.page.lines);
        let (text, lines) = writer.page.counted(settings.block_numbers);
        return Ok(Posted { text: text.into(), lines, notes: writer.notes });
    }
    let (text, lines) = writer.page.text(settings.block_numbers.then_some(dialect.most_blocks));
    Ok(Posted { text: text.into(), lines, notes: writer.notes })
}

/// An error with the item it belongs to.
fn of_item(mut error: Error, index: usize) -> Error {
    if error.0.key.is_none() {
        error.0.item.get_or_insert(index as u32);
    }
    error
}

fn unsupported(what: impl Into<String>) -> Finding {
    Finding::error(Code::POST_CONTROL, what)
}

/// Position of the tool in the frame of the program.
#[derive(Clone, Copy, Debug)]
struct ToolPosition {
    /// As the control knows it, in steps of its resolution.
    written: [Option<i64>; 3],
    /// As the program means it [mm]; not a number where unknown.
    exact: [f64; 3],
}

impl Default for ToolPosition {
    fn default() -> ToolPosition {
        ToolPosition { written: [None; 3], exact: [f64::NAN; 3] }
    }
}

/// Largest program number that every FANUC takes.
const MOST_PROGRAMS: u32 = 9999;

struct Writer<'a> {
    program: &'a Program,
    /// The words of each frame.
    turns: &'a [turn::Turn],
    /// The words of each tilted frame.
    planes: &'a [Option<plane::Plane>],
    tools: &'a [Tool],
    settings: &'a PostSettings,
    dialect: &'static Dialect,
    grid: Grid,
    page: Page,
    notes: PostNotes,
    modal: Modal,
    place: ToolPosition,
    tool: Option<ToolNumber>,
    length: Option<u32>,
    /// A move in machine coordinates has switched the length off.
    length_suspended: bool,
    /// Number of lines after the block of a length.
    length_line: Option<usize>,
    /// The call of a length that waits for the next move of Z.
    length_pending: Option<String>,
    ended: bool,
    /// Line after the remarks in the head of the text.
    remarks_end: usize,
    /// A cycle was written that counts on parameters of the machine.
    parameters_used: bool,
    /// A rotation was written that the control keeps beyond the program.
    turns_kept: bool,
    /// A rotary axis was written beyond a whole turn.
    beyond_turn: bool,
    /// Lengths that the program makes, by the numbers of its own registers.
    own_lengths: Vec<OwnLength>,
    /// Radii that the program gives as numbers [mm].
    own_radii: Vec<(u32, f64)>,
    /// Parts of a move in inverse time.
    shares: Option<shares::Shares>,
}

impl Writer<'_> {
    fn head(&mut self, tools: &[Tool]) -> Result<()> {
        let settings = self.settings;
        if let (Some([before, after]), true) = (self.dialect.file_header, settings.file_header) {
            let name: String =
                settings.program_name.chars().filter(char::is_ascii_alphanumeric).take(24).collect();
            self.page.line(format!("{before}{}{after}", name.to_ascii_uppercase()));
        }
        if let Some(tape) = self.dialect.tape {
            self.page.line(tape.to_owned());
        }
        if self.dialect.program_number {
            let number = settings.program_number;
            if !(1..=MOST_PROGRAMS).contains(&number) {
                return Err(Finding::error(Code::POST_NUMBER, "the number of a program is out of range")
                    .value(f64::from(number), "")
                    .bound(f64::from(MOST_PROGRAMS), "")
                    .into());
            }
            self.page.line(format!("O{number:04}"));
        }
        self.comment(&settings.program_name);
        self.comment(&format!("kinecut {} for {}", crate::VERSION, settings.control.title()));
        for line in &settings.header {
            self.comment(line);
        }
        let items = &self.program.items;
        let used: BTreeSet<ToolNumber> = (0..items.len())
            .filter_map(|i| if let Item::Tool { id, .. } = items.get(i) { Some(id) } else { None })
            .collect();
        for number in used {
            let about = tools.iter().find(|t| t.number == number).map_or_else(String::new, |t| {
                // Without the rounding of a cone's tangent, and of inches.
                let shown = |length: f64| (length / settings.units.mm() * 1e6).round() / 1e6;
                let length = t.gauge_length.map_or_else(String::new, |l| format!(", length {}", shown(l)));
                let diameter = shown(t.cutter.diameter(t.flute_length));
                format!(" {}, diameter {diameter}{length}", t.name)
            });
            self.comment(&format!("{number}{about}"));
        }
        for remark in self.dialect.remarks {
            self.comment(remark);
        }
        self.remarks_end = self.page.len();
        self.comment("A proof on a model does not replace the dry run");
        match &settings.start_template {
            None => {
                for block in self.dialect.start {
                    self.page.block(settings.units.said_in(block));
                }
                self.modal.start();
                Ok(())
            }
            // The state after a template is not known: every word is written again.
            Some(template) => self.template(template, template::TemplatePart::Start),
        }
    }

    fn template(&mut self, text: &str, part: template::TemplatePart) -> Result<()> {
        let lines = template::render(text, part, self.program, self.tools, self.settings)
            .map_err(|e| e.under(part.setting()))?;
        for line in lines {
            if line.starts_with(self.dialect.comment[0].trim_end()) {
                self.page.line(line);
            } else {
                self.page.block(line);
            }
        }
        Ok(())
    }

    fn item(&mut self, index: usize) -> Result<()> {
        let state = *self.program.state(index);
        let item = self.program.items.get(index);
        if self.ended && !matches!(item, Item::Text(_) | Item::Message(_)) {
            return Err(unsupported("an item follows the end of the program").into());
        }
        if let Item::Cycle(..) | Item::Tool { .. } | Item::Stop(StopKind::End) = item {
            self.uncompensated("a cycle, tool or the end of the program comes")?;
        }
        match item {
            Item::Move(_) if self.joins_series(index)? => return Ok(()),
            Item::Cycle(..) | Item::Text(_) | Item::Message(_) => {}
            _ => self.end_series(),
        }
        match item {
            Item::Move(motion) => self.motion(&motion, &state),
            Item::Cycle(cycle, steps) => self.cycle(index, cycle, steps, &state),
            Item::Tool { id, length, radius, again } => {
                if again {
                    self.tool = None;
                }
                self.tool_call(id, length, radius)
            }
            Item::Dwell(seconds) => {
                if !(seconds.is_finite() && seconds >= 0.0) {
                    let finding =
                        Finding::error(Code::POST_NUMBER, "a dwell needs a time that is not negative");
                    return Err(finding.value(seconds, "s").into());
                }
                self.state(&state, false)?;
                if self.klartext() {
                    return self.klartext_dwell(seconds);
                }
                self.dwell(seconds);
                Ok(())
            }
            Item::Stop(kind) => {
                match kind {
                    StopKind::End => self.end()?,
                    StopKind::Program | StopKind::Optional | StopKind::Pallet => {
                        if self.modal.comp.is_none() {
                            self.klartext_tcp_off();
                            self.turn_off()?;
                        }
                        self.state(&state, false)?;
                        let word = match kind {
                            StopKind::Program => "M0",
                            StopKind::Pallet if self.settings.control == Control::LinuxCnc => "M60",
                            StopKind::Pallet => {
                                let finding = unsupported(
                                    "an exchange of pallets (M60) is not written for this control",
                                );
                                return Err(finding.help("leave it out of the program").into());
                            }
                            _ => "M1",
                        };
                        self.page.block(word.to_owned());
                    }
                }
                Ok(())
            }
            Item::Text(text) => {
                self.comment(text);
                Ok(())
            }
            Item::Message(text) => {
                self.message(text);
                Ok(())
            }
            Item::Data(data) => self.control_data(&data, &state),
        }
    }

    fn dwell(&mut self, seconds: f64) {
        let (word, number) = (self.dialect.dwell.0, self.dwell_number(seconds));
        self.page.block(format!("{word}{number}"));
    }

    fn tool_call(&mut self, id: ToolNumber, length: Option<u32>, radius: Option<u32>) -> Result<()> {
        if self.klartext() {
            return self.klartext_tool(id, length, radius);
        }
        if let (true, Some(l), Some(r)) = (self.dialect.one_register, length, radius)
            && l != r
        {
            return Err(unsupported("this control has one register for the length and the radius of a tool")
                .value(f64::from(r), "radius register")
                .bound(f64::from(l), "length register")
                .into());
        }
        if !self.dialect.has_lengths && length != Some(self.settings.control.length_register(id)) {
            let title = self.settings.control.title();
            let finding = unsupported(format!("{title} has no registers of tool lengths to choose from"));
            return Err(finding.help("set the zero of Z with the tool").into());
        }
        if self.tool != Some(id) {
            self.rotary_axes_off()?;
            self.turn_off()?;
            self.all_off();
            self.page.block(format!("T{}{}", id.0, self.dialect.tool_change));
            self.tool = Some(id);
            self.place = ToolPosition::default();
            self.modal.forget();
            self.length_word(length)?;
        } else if self.length != length || self.length_suspended {
            if self.dialect.axes.tcp == TcpWord::Length {
                self.tcp_off()?;
            }
            self.length_word(length)?;
        }
        Ok(())
    }

    /// Calls a length register; heights are then another, so the next move names its Z.
    fn length_word(&mut self, length: Option<u32>) -> Result<()> {
        let (blocks, counts) = self.length_blocks(length, self.length)?;
        if self.dialect.length_with_z {
            self.length_pending = blocks.into_iter().next_back();
        } else if self.dialect.has_lengths {
            // A length that the next block replaces does nothing.
            if self.length_line == Some(self.page.len()) && !counts {
                self.page.truncate(self.page.len() - 1);
            }
            let replaceable = !counts && blocks.len() == 1;
            for block in blocks {
                self.page.block(block);
            }
            self.length_line = replaceable.then(|| self.page.len());
        }
        // On LinuxCNC a length may be across the tool, too.
        if self.settings.control == Control::LinuxCnc {
            (self.place.written, self.place.exact) = ([None; 3], [f64::NAN; 3]);
        }
        self.length = length;
        self.length_suspended = false;
        self.forget_axis(2);
        Ok(())
    }

    fn forget_axis(&mut self, axis: usize) {
        self.place.written[axis] = None;
        self.place.exact[axis] = f64::NAN;
    }

    /// Switches spindle and coolant off if they are on.
    fn all_off(&mut self) {
        let coolant = !matches!(self.modal.coolant, None | Some(Coolant::Off));
        let spindle = !matches!(self.modal.spindle, None | Some(Spindle::Off));
        let words: Vec<&str> =
            [(coolant, "M9"), (spindle, "M5")].iter().filter(|w| w.0).map(|w| w.1).collect();
        if !words.is_empty() {
            self.page.block(words.join(" "));
        }
        self.modal.coolant = Some(Coolant::Off);
        self.modal.spindle = Some(Spindle::Off);
    }

    fn end(&mut self) -> Result<()> {
        self.end_series();
        self.klartext_tcp_off();
        self.rotary_axes_off()?;
        self.turn_off()?;
        self.all_off();
        match &self.settings.end_template {
            None => self.page.block(self.dialect.end.to_owned()),
            Some(template) => self.template(template, template::TemplatePart::End)?,
        }
        self.ended = true;
        Ok(())
    }
}
