//! A program run line by line, as its control runs it: in the order of its branches, loops and calls.

use std::rc::Rc;

use crate::base::{Error, FileId, Finding, Result};
use crate::nc::dialect::{Code, FlowWords};
use crate::nc::fanuc::statement::{self, Places};
use crate::nc::linuxcnc::o_word::{self, OLines};
use crate::nc::run::{Budget, Level, LocalNames, Recurrence, mixed};
use crate::program::{Comp, Origin, OriginId, Spindle};

use super::block::Block;
use super::called::names_of;
use super::jump::Jump;
use super::lex::Lexer;
use super::place::{Bytes, SourceText};
use super::plain::Plain;
use super::reader::Reader;
use super::{ReadSettings, Reading};

/// A call that has not returned.
#[derive(Debug)]
pub(super) struct Frame<'s> {
    /// Place to go on at behind the call: file, and first byte of a line.
    pub(super) back: (SourceText<'s>, usize),
    /// Local variables of the caller, where the call has its own.
    pub(super) level: Option<Level>,
    /// Loops of the caller.
    pub(super) loops: Vec<Turns>,
    /// Calls of the same that are left, and its first line.
    pub(super) again: u32,
    pub(super) begin: (SourceText<'s>, usize),
    /// Local variables with which each further call begins, where they are not those that the one before has left.
    pub(super) arguments: Option<Level>,
    /// Names of the caller, where the call has its own names and the caller's numbers (`M98` of LinuxCNC).
    pub(super) names: Option<LocalNames>,
    /// The block that calls.
    pub(super) called: Bytes,
    pub(super) parent: Option<OriginId>,
    /// The modal macro that is called.
    pub(super) modal_macro: Option<usize>,
}

/// Turns of a `repeat` that are left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turns {
    pub(super) line: usize,
    pub(super) left: u64,
}

/// Flags of a loop that was left, as LinuxCNC keeps them: it clears them in loops of the other kind only, and takes each `break` of a loop
/// for run that it passes on the way to its end (`interp_o_word.cc`, 2.9 and the newest).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Leaving {
    /// A `while` loop with a `break` was left: the next `do` loop ends after one turn.
    pub(super) broke: bool,
    /// A `continue` was in a `do` loop: the next `break` of a `while` loop is a `continue`.
    pub(super) continued: bool,
}

/// The places of a file, found when they are first asked for.
#[derive(Clone, Debug, Default)]
struct Known {
    o_lines: Option<Rc<OLines>>,
    places: Option<Rc<Places>>,
}

/// A program on its way.
pub(super) struct Run<'s> {
    pub(super) reader: Reader<'s>,
    /// The first byte of the next line.
    pub(super) at: usize,
    pub(super) main: SourceText<'s>,
    started: bool,
    pub(super) frames: Vec<Frame<'s>>,
    pub(super) loops: Vec<Turns>,
    pub(super) leaving: Leaving,
    budget: Budget,
    /// Whether lines are run that were run before.
    again: bool,
    recurrence: Recurrence,
    /// By the number of the file.
    known: Vec<Known>,
    /// Files beside the program: names as they are called, without ending.
    files: Vec<(String, FileId)>,
    /// Errors so far, where reading goes on behind them.
    errors: Option<Vec<Finding>>,
    /// Whether there was one.
    lost: bool,
    /// Whether the state is one in which plain blocks are read in one go.
    quiet: bool,
    /// Whether the present line says which is next: behind an error in it that is not known.
    in_flow: bool,
}

/// Most errors that are kept.
const MOST_ERRORS: usize = 10_000;

impl<'s> Run<'s> {
    pub(super) fn new(reader: Reader<'s>, settings: &ReadSettings) -> Run<'s> {
        let (main, depth) = (reader.place, reader.dialect.flow.depth());
        Run {
            reader,
            at: 0,
            main,
            started: false,
            frames: Vec::new(),
            loops: Vec::new(),
            leaving: Leaving::default(),
            budget: Budget::new(settings.blocks, depth),
            again: false,
            recurrence: Recurrence::default(),
            known: Vec::new(),
            files: settings.files.clone(),
            errors: settings.reads_on.then(Vec::new),
            lost: false,
            quiet: false,
            in_flow: false,
        }
    }

    /// Runs it to its end.
    pub(super) fn run(mut self) -> Result<Reading> {
        let mut block = Block::default();
        loop {
            match self.step(&mut block) {
                Ok(true) => {}
                Ok(false) => break,
                Err(error) if self.errors.is_some() => {
                    if !self.goes_on_behind(error) {
                        break;
                    }
                }
                Err(error) => return Err(self.called_from(error)),
            }
            if self.reader.ended {
                break;
            }
        }
        let in_main = self.reader.place.file == self.main.file;
        let at = if in_main { self.at } else { self.frames.first().map_or(self.at, |f| f.back.1) };
        self.reader.place = self.main;
        let end = self.main.text().len();
        let errors = self.errors.unwrap_or_default();
        // What is left of a program that was not read to its end is no text behind its end.
        self.reader.ended |= self.lost;
        let reading = self.reader.finish(if self.lost { end } else { at.min(end) })?;
        Ok(Reading { errors, ..reading })
    }

    /// Keeps an error, and goes on behind its block where that can be told; `false` where not.
    fn goes_on_behind(&mut self, error: Error) -> bool {
        let follows = self.lost && error.0.message.contains("the program has not set");
        let error = self.called_from(error);
        // What only follows from a block before is no error of its own.
        if !follows && let Some(errors) = self.errors.as_mut().filter(|errors| errors.len() < MOST_ERRORS) {
            errors.push(*error.0);
        }
        self.lost = true;
        self.reader.skip_block();
        !(self.in_flow || self.reader.ended)
    }

    /// The line that a call was made from, in an error within it.
    fn called_from(&self, mut error: Error) -> Error {
        for frame in self.frames.iter().rev() {
            let place = frame.back.0;
            let line = place.sources.line(place.span(&frame.called));
            let call = format!("called in line {line} of {}", place.sources.name(place.file));
            let help = &mut error.0.help;
            *help = if help.is_empty() { call } else { format!("{help}; {call}") };
        }
        error
    }

    /// Runs the next line; `false` at the end.
    fn step(&mut self, block: &mut Block<'s>) -> Result<bool> {
        if std::mem::take(&mut self.quiet)
            && let Some(plain) = Plain::at(self.reader.place.text(), self.at, self.reader.dialect)
        {
            let start = self.at;
            self.at = plain.next;
            if self.again {
                self.in_flow = true;
                self.budget
                    .block()
                    .map_err(|finding| located(finding, self.reader.place, start, self.at - 1))?;
            }
            self.in_flow = false;
            self.reader.plain_block(plain)?;
            self.quiet = true;
            return Ok(true);
        }
        let goes_on = self.line(block)?;
        self.quiet = self.started && self.reader.is_quiet();
        Ok(goes_on)
    }

    /// Runs the next line, whatever it says; `false` at the end.
    fn line(&mut self, block: &mut Block<'s>) -> Result<bool> {
        let place = self.reader.place;
        let text = place.text();
        let start = self.at;
        if start >= text.len() {
            // There is nothing to go on with behind an error here.
            self.in_flow = true;
            return self.end_of_text(start);
        }
        // Lines are short: a search by many bytes at once would not pay.
        let end = text.as_bytes()[start..].iter().position(|b| *b == b'\n').map_or(text.len(), |n| start + n);
        self.at = end + 1;
        if self.again {
            self.in_flow = true;
            self.budget.block().map_err(|finding| located(finding, place, start, end))?;
        }
        let line = &text.as_bytes()[start..end];
        self.in_flow = false;
        match self.reader.dialect.flow {
            FlowWords::None => {}
            FlowWords::OWords => {
                if let Some(at) = o_word::label_at(line) {
                    (self.started, self.in_flow) = (true, true);
                    self.o_line(start, start + at, end, block)?;
                    return Ok(true);
                }
            }
            FlowWords::MacroB => {
                if let Some(at) = statement::begins(line) {
                    (self.started, self.in_flow) = (true, true);
                    self.statement(start, start + at, end, block)?;
                    return Ok(true);
                }
                let begun = self.started || self.reader.numbered();
                if begun && statement::program_number(line).is_some() {
                    return self.next_program(start, end);
                }
            }
        }
        self.lexer().line(start, end, block)?;
        self.block(block)
    }

    pub(super) fn lexer(&self) -> Lexer<'_, 's> {
        Lexer { place: self.reader.place, dialect: self.reader.dialect, names: &self.reader }
    }

    /// Runs a block; `false` at the end.
    pub(super) fn block(&mut self, block: &mut Block<'s>) -> Result<bool> {
        if block.tape {
            if self.reader.dialect.answer.is_some() {
                let bytes = self.at.saturating_sub(2) as u32..self.at.saturating_sub(1) as u32;
                self.reader.warn(&bytes, "GRBL answers error 1 to a line with `%`: senders leave it out");
            }
            return Ok(!(self.started && self.reader.dialect.tape.is_some()));
        }
        if !self.started {
            let number = matches!(&block.words[..], [word] if word.is("O"));
            if number {
                self.reader.header.extend(block.comments.drain(..).map(|c| c.0.to_owned()));
            } else if block.is_empty() && !self.reader.has_message(block) {
                self.reader.header.extend(block.comments.iter().map(|c| c.0.to_owned()));
                return Ok(true);
            }
            self.started = !number;
        }
        let before = self.reader.program.items.len();
        self.reader.block(block)?;
        match self.reader.jump.take() {
            None => self.call_modal_macro(before),
            Some(jump) => {
                self.no_modal_macro(before)?;
                self.in_flow = true;
                self.jump(jump)
            }
        }
    }

    fn end_of_text(&mut self, at: usize) -> Result<bool> {
        if self.frames.is_empty() {
            return self.reader.corner_without_move().map(|()| false);
        }
        let bytes = at.saturating_sub(1) as u32..at as u32;
        let word = if self.reader.dialect.flow == FlowWords::MacroB { "M99" } else { "endsub or M99" };
        let message = format!("the file ends within a subprogram, without {word}");
        Err(self.reader.lacks(&bytes, &message).into())
    }

    /// The head of the next program of a file, which a control runs into: it returns, or ends.
    fn next_program(&mut self, start: usize, end: usize) -> Result<bool> {
        let bytes = start as u32..end as u32;
        let message = "the program before this one has no end (M99, M30): the control would run on into it";
        self.reader.warn(&bytes, message);
        if self.frames.is_empty() {
            self.at = start;
            return Ok(false);
        }
        self.back(None, &bytes)
    }

    fn jump(&mut self, jump: Jump) -> Result<bool> {
        match jump {
            Jump::Return { to, bytes } => self.back(to, &bytes),
            Jump::Program { number, times, bytes } => {
                let begin = self.called_program(number, &bytes)?;
                self.call(begin, times, None, bytes)
            }
            Jump::Block { number, times, bytes } => {
                let place = self.reader.place;
                let Some(line) = self.places().block(number, self.at) else {
                    let message = format!("the block N{number} that is called is not in this program");
                    return Err(self.reader.lacks(&bytes, &message).into());
                };
                self.reader.called_blocks = true;
                self.call((place, line), times, None, bytes)
            }
            Jump::Macro { number, times, locals, bytes } => {
                let begin = self.called_program(number, &bytes)?;
                self.call(begin, times, Some(locals), bytes)
            }
        }
    }

    /// The places of a file that are known so far.
    fn known(&mut self, file: FileId) -> &mut Known {
        let index = file.0 as usize;
        if self.known.len() <= index {
            self.known.resize_with(index + 1, Known::default);
        }
        &mut self.known[index]
    }

    /// The places that `M98` and `GOTO` name in the present file.
    pub(super) fn places(&mut self) -> Rc<Places> {
        let place = self.reader.place;
        let known = self.known(place.file);
        Rc::clone(known.places.get_or_insert_with(|| Rc::new(Places::of(place.text()))))
    }

    /// The o words of a file.
    pub(super) fn o_lines(&mut self, place: SourceText<'s>) -> Rc<OLines> {
        let known = self.known(place.file);
        Rc::clone(known.o_lines.get_or_insert_with(|| Rc::new(OLines::of(place.text()))))
    }

    /// The file beside the program that holds what is called.
    pub(super) fn beside(&self, name: &str) -> Option<SourceText<'s>> {
        let file = self.files.iter().find(|(called, _)| called == name)?.1;
        Some(SourceText::new(self.main.sources, file))
    }

    /// First line of the program of a number.
    pub(super) fn called_program(&mut self, number: u32, bytes: &Bytes) -> Result<(SourceText<'s>, usize)> {
        let place = self.reader.place;
        let macro_b = self.reader.dialect.flow == FlowWords::MacroB;
        let find = |run: &mut Run<'s>, place: SourceText<'s>| {
            if macro_b {
                let known = run.known(place.file);
                known.places.get_or_insert_with(|| Rc::new(Places::of(place.text()))).program(number)
            } else {
                let lines = run.o_lines(place);
                lines.program(number).map(|line| lines.line(line).after)
            }
        };
        let beside: Vec<SourceText<'s>> =
            names_of(number).iter().filter_map(|name| self.beside(name)).collect();
        for place in [place, self.main].into_iter().chain(beside) {
            if let Some(at) = find(self, place) {
                return Ok((place, at));
            }
        }
        let message = format!("the program O{number} that is called is not in this file, nor beside it");
        Err(self.reader.lacks(bytes, &message).help("put it behind the main program").into())
    }

    /// Calls what begins at a line.
    pub(super) fn call(
        &mut self,
        begin: (SourceText<'s>, usize),
        times: u32,
        arguments: Option<Level>,
        called: Bytes,
    ) -> Result<bool> {
        if times == 0 {
            return Ok(true);
        }
        let place = self.reader.place;
        let deep = self.budget.call(self.frames.len());
        deep.map_err(|finding| located(finding, place, called.start as usize, called.end as usize))?;
        let level = arguments.clone().map(|own| self.reader.variables.enter(own));
        let own_names = level.is_none() && self.reader.dialect.flow == FlowWords::OWords;
        let names = own_names.then(|| self.reader.variables.enter_names(LocalNames::new()));
        let span = Some(place.span(&called));
        let origin = Origin { span, parent: self.reader.parent, ..Origin::default() };
        let parent = self.reader.parent.replace(self.reader.program.add_origin(origin));
        let loops = std::mem::take(&mut self.loops);
        let back = (place, self.at);
        // A Haas begins each further call with what the one before has left.
        let arguments = arguments.filter(|_| !self.reader.dialect.haas);
        let (again, modal_macro) = (times - 1, None);
        self.frames.push(Frame {
            back,
            level,
            loops,
            again,
            begin,
            arguments,
            names,
            called,
            parent,
            modal_macro,
        });
        self.go(begin);
        Ok(true)
    }

    fn go(&mut self, (place, at): (SourceText<'s>, usize)) {
        self.again = true;
        self.reader.place = place;
        self.reader.depth = self.frames.len();
        self.reader.modal_macros.in_macro = self.frames.iter().any(|f| f.level.is_some());
        self.at = at;
    }

    /// Returns from a call, to a block number of the caller where one is given.
    pub(super) fn back(&mut self, to: Option<u32>, bytes: &Bytes) -> Result<bool> {
        let depth = self.frames.len();
        self.leave_modal_macro();
        let Some(frame) = self.frames.last_mut() else { return self.main_returns(to, bytes) };
        self.reader.returned(depth, bytes)?;
        if frame.again > 0 {
            frame.again -= 1;
            let begin = frame.begin;
            if let Some(own) = frame.arguments.clone() {
                self.reader.variables.enter(own);
            }
            if frame.names.is_some() {
                self.reader.variables.enter_names(LocalNames::new());
            }
            self.loops.clear();
            self.go(begin);
            return self.came_back(bytes).map(|()| true);
        }
        let Some(frame) = self.frames.pop() else { return Ok(false) };
        if let Some(level) = frame.level {
            self.reader.variables.enter(level);
        }
        if let Some(names) = frame.names {
            self.reader.variables.enter_names(names);
        }
        if let Some(reach) = frame.modal_macro {
            self.reader.modal_macros.reach = reach;
        }
        self.loops = frame.loops;
        self.reader.parent = frame.parent;
        self.go(frame.back);
        match to {
            Some(number) => self.go_to(number, bytes).map(|()| true),
            None => Ok(true),
        }
    }

    /// `M99` in the main program: it begins anew, which is read once.
    fn main_returns(&mut self, to: Option<u32>, bytes: &Bytes) -> Result<bool> {
        if let Some(number) = to {
            return self.go_to(number, bytes).map(|()| true);
        }
        self.reader.note("M99 begins the main program anew: it is read once");
        self.reader.ended = true;
        Ok(false)
    }

    /// Goes to the line of a block number.
    pub(super) fn go_to(&mut self, number: u32, bytes: &Bytes) -> Result<()> {
        let Some(line) = self.places().block(number, self.at) else {
            let message = format!("the block N{number} that is gone to is not in this program");
            return Err(self.reader.lacks(bytes, &message).into());
        };
        let backwards = line < self.at;
        self.at = line;
        if backwards { self.came_back(bytes) } else { Ok(()) }
    }

    /// After a jump backwards: refuses a program that is where it was before.
    pub(super) fn came_back(&mut self, bytes: &Bytes) -> Result<()> {
        self.again = true;
        let part = self.reader.variables.state() ^ mixed(0, self.at as u64);
        let (frames, loops, reader, leaving) = (&self.frames, &self.loops, &self.reader, self.leaving);
        let whole = || {
            let calls = frames.iter().enumerate().map(|(i, f)| {
                let place = u64::from(f.back.0.file.0) << 40 | f.back.1 as u64;
                mixed(i as u64 + 1, place) ^ mixed(!(i as u64), u64::from(f.again))
            });
            let turns = loops.iter().chain(frames.iter().flat_map(|f| &f.loops)).enumerate();
            let turns = turns.map(|(i, t)| mixed(t.line as u64 + (i as u64 + 1) * (1 << 32), t.left));
            let leaving = u64::from(leaving.broke) | u64::from(leaving.continued) << 1;
            calls.chain(turns).fold(reader.state_number() ^ mixed(u64::MAX, leaving), |a, b| a ^ b)
        };
        if !self.recurrence.is_back(part, whole) {
            return Ok(());
        }
        let message =
            "the program comes back to this block with the same variables, position and calls: it never ends";
        Err(self.reader.lacks(bytes, message).help("change a variable in the loop that ends it").into())
    }
}

pub(super) fn located(finding: Finding, place: SourceText<'_>, start: usize, end: usize) -> Error {
    let bytes = start as u32..end.max(start + 1) as u32;
    finding.at(place.sources.locate(place.span(&bytes))).into()
}

impl Reader<'_> {
    /// A number mixed from variables, position and what else is in force.
    fn state_number(&self) -> u128 {
        let modal = &self.modal;
        let bits = |value: Option<f64>| value.map_or(u64::MAX, f64::to_bits);
        let rotary = modal.rotary_axes.rotaries.at;
        let places = modal.position.iter().chain(&rotary).copied().map(bits);
        let shift = modal.turned.shift.to_array().map(f64::to_bits);
        let (returned, by_value) = self.value_returned;
        let numbers = [modal.feed, modal.speed, Some(returned), modal.tool.length.map(f64::from)].map(bits);
        let motion = |code: Option<Code>| match code {
            None => 0,
            Some(Code::Rapid) => 1,
            Some(Code::Feed) => 2,
            Some(Code::Arc { ccw }) => 3 + u64::from(ccw),
            Some(_) => 5,
        };
        let motion = motion(modal.motion) | motion(modal.path_code) << 4;
        let spindle = match modal.spindle {
            Spindle::Off => 0,
            Spindle::Clockwise(_) => 1,
            Spindle::CounterClockwise(_) => 2,
        };
        let comp = match modal.comp {
            Comp::Off => 0,
            Comp::Left(register) => 1 + 2 * u64::from(register),
            Comp::Right(register) => 2 + 2 * u64::from(register),
        };
        let flags = u64::from(modal.absolute)
            | u64::from(modal.length_unit == 1.0) << 1
            | u64::from(modal.return_to_start) << 2
            | u64::from(by_value) << 3
            | (modal.plane as u64) << 4
            | (modal.feed_mode as u64) << 8
            | (modal.coolant as u64) << 12;
        let words = [flags, motion, spindle, comp]
            .into_iter()
            .chain(
                [modal.offset.map_or(0, |o| u32::from(o.tenths())), modal.tool.id.map_or(0, |t| t.0)]
                    .map(u64::from),
            )
            .chain([
                u64::from(modal.chosen.unwrap_or(u32::MAX)),
                u64::from(modal.radius.unwrap_or(u32::MAX)),
                self.modal_macros.state(),
                self.scaling.state(),
            ]);
        // What parameters of the control show.
        let data = modal.turned.numbers().chain(self.table.numbers()).chain(self.stored_shift.to_array());
        let stored = self.stored_places.iter().flatten().flat_map(|place| place.in_machine());
        let known = stored.chain(modal.tool_offsets).map(|value| value.unwrap_or(f64::NAN));
        let shifted = self.shift_said.map_or(2, u8::from);
        let flags = [f64::from(shifted), f64::from(u8::from(modal.length_stale))];
        let data = data.chain(known).chain(flags).map(f64::to_bits);
        let all = places.chain(shift).chain(numbers).chain(words).chain(data).enumerate();
        all.fold(self.variables.state(), |state, (i, value)| state ^ mixed(i as u64 | 1 << 63, value))
    }
}

/// Refuses words behind a statement.
pub(super) fn nothing_else(reader: &Reader<'_>, block: &Block<'_>) -> Result<()> {
    if block.is_empty() {
        return Ok(());
    }
    Err(reader.place.malformed(&block.bytes(), "nothing but a comment follows here").into())
}
