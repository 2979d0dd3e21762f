//! The reader: its state, the words of a block as codes, and the items it makes of them.

use std::cell::Cell;
use std::collections::HashMap;

use crate::base::{Code as FindingCode, Finding, Result, Span, Sum};
use crate::machine::{CodeEffect, OwnCode};
use crate::nc::Parameters;
use crate::nc::dialect::{AXES, COMMON_G, COMMON_M, Code, Dialect, FlowWords, Mismatch, TurnWord};
use crate::nc::multi_axis::ROTARY;
use crate::nc::run::Variables;
use crate::program::{
    Comp, ControlData, Frame, Origin, OriginId, OwnLength, Program, Setup, Speed, State, WorkOffset,
};

use super::Reading;
use super::block::{Block, Word, WordMode};
use super::corner::Corner;
use super::jump::Jump;
use super::modal::Modal;
use super::modal_macro::ModalMacros;
use super::nurbs::Nurbs;
use super::place::{Bytes, SourceText};
use super::points::Points;
use super::polar::Polar;
use super::saved::Saved;
use super::scaling::Scaling;
use super::stored::Stored;
use super::tool_data::Table;

/// A value of a word and its place.
#[derive(Clone, Debug)]
pub(super) struct Value {
    pub(super) value: f64,
    pub(super) bytes: Bytes,
}

pub(super) struct Reader<'s> {
    pub(super) place: SourceText<'s>,
    pub(super) dialect: &'static Dialect,
    pub(super) program: Program,
    pub(super) modal: Modal,
    pub(super) findings: Vec<Finding>,
    pub(super) header: Vec<String>,
    pub(super) radius_difference: f64,
    pub(super) involute_difference: f64,
    pub(super) ended: bool,
    /// Repetitions of cycles so far.
    pub(super) repeated: Sum,
    /// The program has said its number.
    numbered: bool,
    /// Codes of the machine that the language does not have.
    pub(super) own_codes: Vec<OwnCode>,
    /// Coordinates without a decimal point.
    pub(super) points: Points,
    /// The words of the present block.
    pub(super) origin: Origin,
    /// The present block has no words that nothing has used but ends of X, Y, Z.
    pub(super) only_axes: bool,
    pub(super) here: Bytes,
    /// The block that last changed tool or length.
    pub(super) tool_origin: Origin,
    pub(super) codes: Vec<(Code, Bytes)>,
    pub(super) variables: Variables,
    /// A variable that was read before the program has set it, and those of which that was said.
    pub(super) unset: Cell<Option<u32>>,
    pub(super) unset_said: Vec<u32>,
    /// The value that the last subprogram returned, and whether it did.
    pub(super) value_returned: (f64, bool),
    /// Calls in force, and the block of the last.
    pub(super) depth: usize,
    pub(super) parent: Option<OriginId>,
    /// Spline whose control points are being given.
    pub(super) nurbs: Option<Nurbs>,
    /// Wait of the last cycle that has said one [s].
    pub(super) last_dwell: Option<f64>,
    /// R of the last cycle [mm].
    pub(super) last_reference: Option<f64>,
    /// Polar coordinates (`G16`).
    pub(super) polar: Option<Polar>,
    /// The last shift of `G52` or `G92`, which `G92.3` takes again [mm].
    pub(super) stored_shift: glam::DVec3,
    /// Radius registers that the program sets [mm].
    pub(super) radii: Vec<(u32, f64)>,
    /// Lengths of tools that the program sets: register and length [mm].
    pub(super) lengths_set: Vec<(u32, f64)>,
    /// Whether it has said a continuous path without a tolerance.
    pub(super) rounds_freely: bool,
    /// Modal states that were saved (`M70`, `M73`).
    pub(super) saved: Vec<Saved>,
    /// Places that `G28` and `G30` go to, where the program has stored them.
    pub(super) stored_places: [Option<Stored>; 2],
    /// Whether blocks were called by their number (`M97`), which are behind the end as a rule.
    pub(super) called_blocks: bool,
    /// The tool table, as far as it is known.
    pub(super) table: Table,
    /// Whether functions of the machine that move no axis by custom are passed over.
    pub(super) tolerant: bool,
    /// Parameters that the control has kept.
    pub(super) kept: Option<Parameters>,
    /// Whether the program has switched the shift of `G92` on or off (parameter 5210).
    pub(super) shift_said: Option<bool>,
    /// Lengths that the program makes, by the numbers of its own registers.
    pub(super) own_lengths: Vec<OwnLength>,
    /// Those numbers, by what the lengths are made of.
    pub(super) own_numbers: HashMap<OwnKey, u32>,
    /// Feed moves that start at a place that the program has not set.
    pub(super) from_nowhere: Vec<Span>,
    /// The jump that the present block asks for.
    pub(super) jump: Option<Jump>,
    /// `G28` has cancelled the tool length, and none was called since (Haas).
    pub(super) length_lost: bool,
    /// Macros that are called after each block that moves.
    pub(super) modal_macros: ModalMacros,
    /// Scaled and mirrored coordinates.
    pub(super) scaling: Scaling,
    /// Corner behind the last move, which waits for the next.
    pub(super) corner: Option<Corner>,
}

/// Parts of a length that the program makes: register before, bits of the numbers, register added.
pub(super) type OwnKey = (Option<u32>, [u64; 3], Option<u32>);

/// The kinds of item that decide whether a switched-off length becomes an item.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Tip,
    Other,
}

impl<'s> Reader<'s> {
    pub(super) fn new(place: SourceText<'s>, dialect: &'static Dialect, setups: &[Setup]) -> Reader<'s> {
        let mut program = Program::new(setups.to_vec());
        let mut modal = Modal::new(dialect);
        modal.frame = program.add_frame(Frame::Work(WorkOffset::G54));
        Reader {
            place,
            dialect,
            program,
            modal,
            findings: Vec::new(),
            header: Vec::new(),
            radius_difference: 0.0,
            involute_difference: 0.0,
            ended: false,
            repeated: Sum::default(),
            numbered: false,
            own_codes: Vec::new(),
            points: Points::default(),
            origin: Origin::default(),
            only_axes: false,
            here: 0..0,
            tool_origin: Origin::default(),
            codes: Vec::new(),
            variables: Variables::new(dialect.flow.level()),
            unset: Cell::new(None),
            unset_said: Vec::new(),
            value_returned: (0.0, false),
            depth: 0,
            parent: None,
            nurbs: None,
            last_dwell: None,
            last_reference: None,
            polar: None,
            stored_shift: glam::DVec3::ZERO,
            radii: Vec::new(),
            lengths_set: Vec::new(),
            rounds_freely: false,
            saved: Vec::new(),
            stored_places: [None; 2],
            called_blocks: false,
            table: Table::default(),
            tolerant: false,
            kept: None,
            shift_said: None,
            own_lengths: Vec::new(),
            own_numbers: HashMap::new(),
            from_nowhere: Vec::new(),
            jump: None,
            length_lost: false,
            modal_macros: ModalMacros::default(),
            scaling: Scaling::default(),
            corner: None,
        }
    }

    /// Ends the reading; `at` is the first byte not read.
    pub(super) fn finish(mut self, at: usize) -> Result<Reading> {
        self.corner_without_move()?;
        self.flush(Kind::Other);
        self.say_from_nowhere();
        let text = self.place.text();
        let rest = text[at..].trim_matches(|c: char| c.is_whitespace() || c == '%');
        if self.modal.comp != Comp::Off {
            let end = at as u32;
            self.warn(&(end..end), "the cutter compensation is on at the end of the program");
        }
        let kept = matches!(self.dialect.turn, TurnWord::Offset | TurnWord::None);
        if kept && !self.modal.turned.is_none() {
            let end = at as u32;
            let message =
                "the rotation or shift of a work offset (G10 L2 R, G52, G92) stays beyond the program";
            self.warn(&(end..end), message);
        }
        // What is called from here may be behind the end.
        let other_programs = self.dialect.flow.has_variables() && rest.starts_with(['O', 'o', ':']);
        if !self.ended {
            let end = text.len() as u32;
            self.warn(&(end..end), "the program has no end (M30)");
        } else if !rest.is_empty() && !other_programs && !self.called_blocks {
            let start = (rest.as_ptr() as usize - text.as_ptr() as usize) as u32;
            self.warn(&(start..start + 1), "text after the end of the program is not run");
        }
        self.program.items.shrink_to_fit();
        Ok(Reading {
            program: self.program,
            findings: self.findings,
            header: self.header,
            radius_difference: self.radius_difference,
            involute_difference: self.involute_difference,
            errors: Vec::new(),
            radii: self.radii,
            lengths: self.lengths_set,
            own_lengths: self.own_lengths,
            zeros: self.modal.turned.zeros,
            rounds_freely: self.rounds_freely,
        })
    }

    /// Whether the program has said its number.
    pub(super) fn numbered(&self) -> bool {
        self.numbered
    }

    /// Says which feed moves start at a place that the program has not set.
    fn say_from_nowhere(&mut self) {
        let Some(first) = self.from_nowhere.first() else { return };
        let sources = self.place.sources;
        let mut lines: Vec<String> = self
            .from_nowhere
            .iter()
            .map(|span| match span.file == self.place.file {
                true => sources.line(*span).to_string(),
                false => format!("{} of {}", sources.line(*span), sources.name(span.file)),
            })
            .collect();
        lines.dedup();
        let message = format!(
            "the program has not set the position where a feed move starts, which is not followed: line{} {}",
            if lines.len() == 1 { "" } else { "s" },
            listed(&lines)
        );
        let finding = Finding::warning(FindingCode::UNKNOWN_START, message).at(sources.locate(*first));
        self.findings.push(finding.help("move all axes to a position by G0 first"));
    }

    pub(super) fn warn(&mut self, bytes: &Bytes, message: &str) {
        // One finding of a kind is enough: the help is the same.
        if self.findings.iter().all(|f| f.message != message) {
            self.findings.push(self.place.warning(FindingCode::NC_STATE, bytes, message));
        }
    }

    /// Whether there is one work offset only, so that there is nothing to choose.
    pub(super) fn has_one_offset(&self) -> bool {
        self.program.setups.iter().all(|setup| setup.work_offsets.len() < 2)
    }

    /// Notes an assumption, once.
    pub(super) fn note(&mut self, message: &str) {
        if self.findings.iter().all(|f| f.message != message) {
            let place = self.place.sources.locate(self.place.span(&self.here));
            self.findings.push(Finding::note(FindingCode::NC_STATE, message).at(place));
        }
    }

    /// Says what cannot be proven, once.
    pub(super) fn doubt(&mut self, bytes: &Bytes, message: &str, help: &str) {
        if self.findings.iter().all(|f| f.message != message) {
            let place = self.place.sources.locate(self.place.span(bytes));
            self.findings.push(Finding::doubt(FindingCode::NC_ASSUMED, message).at(place).help(help));
        }
    }

    /// Says what is assumed, once.
    pub(super) fn assume(&mut self, bytes: &Bytes, message: &str) {
        if self.findings.iter().all(|f| f.message != message) {
            let place = self.place.sources.locate(self.place.span(bytes));
            let finding = Finding::warning(FindingCode::NC_ASSUMED, message).at(place);
            self.findings.push(finding.help("compare it with the setup"));
        }
    }

    pub(super) fn lacks(&self, bytes: &Bytes, message: &str) -> Finding {
        self.place.error(FindingCode::NC_STATE, bytes, message)
    }

    /// Leaves a block that is wrong: from here on no position is known.
    pub(super) fn skip_block(&mut self) {
        self.codes.clear();
        (self.jump, self.nurbs, self.polar, self.corner) = (None, None, None, None);
        self.modal.position = [None; 3];
        self.modal.comp = Comp::Off;
        self.modal.comp_turned = None;
        self.modal.sticky.end();
        self.modal.cubic_end = None;
    }

    /// Executes a block.
    pub(super) fn block(&mut self, block: &mut Block<'s>) -> Result<()> {
        self.only_axes = false;
        self.here = block.bytes();
        self.origin =
            Origin { span: Some(self.place.span(&self.here)), parent: self.parent, ..Origin::default() };
        if let Some(skip) = &block.skip {
            self.warn(skip, "a block with `/` is read as if the skip switch were off");
        }
        if let Some(torn) = &block.torn {
            self.warn(torn, "a number has blanks within: the control ignores them");
        }
        self.remarks(block);
        let here = self.here.clone();
        self.note_unset(&here);
        if let Some(assignment) = block.assignments.first()
            && self.dialect.flow == FlowWords::MacroB
            && block.words.iter().any(|w| !w.is("N"))
        {
            let why = "a macro statement is in a block of its own";
            return Err(self.place.malformed(&assignment.bytes, why).into());
        }
        for assignment in block.assignments.drain(..) {
            self.assign(assignment, &block.comments)?;
        }
        if block.words.is_empty() && block.call.is_none() {
            return Ok(());
        }
        if self.dialect.flow == FlowWords::MacroB && self.calls_macro(&mut block.words)? {
            return self.corner_without_move();
        }
        self.collect(&mut block.words)?;
        if self.dialect.point {
            self.numbers_without_point(&mut block.words)?;
        }
        self.extended_offset(&mut block.words)?;
        self.polar_words(&mut block.words)?;
        self.diameters(&mut block.words);
        let before = self.program.items.len();
        let modal = self.code(|c| c == Code::ModalCall).is_some();
        if modal || block.call.is_some() {
            self.called(block.call.as_ref(), modal)?;
        } else {
            match self.only_moves(&block.words) {
                true => self.go_on(&mut block.words)?,
                false => self.execute(&mut block.words)?,
            }
            self.call_after_motion(before)?;
        }
        match block.words.iter().find(|w| !w.used) {
            Some(word) => {
                let rotary = ROTARY.iter().any(|r| word.is(r));
                let why = match self.dialect.axes.rotary {
                    None if rotary => "the control has no rotary axes",
                    _ => "no code of this block uses it",
                };
                let number = if word.is_of_grbl() { 36 } else { 20 };
                Err(self.answers(self.place.not_understood(&word.bytes, why), number).into())
            }
            None => Ok(()),
        }
    }

    /// Turns G, M and keywords into codes; checks that nothing is said twice.
    fn collect(&mut self, words: &mut [Word<'s>]) -> Result<()> {
        self.codes.clear();
        for i in 0..words.len() {
            let (before, rest) = words.split_at_mut(i);
            let word = &mut rest[0];
            let is = |name: &str| word.is(name);
            let code = match word.value {
                Some(value) if is("G") => Some(self.g_code(value).ok_or_else(|| self.unknown(word))?),
                Some(value) if is("M") => {
                    // Whole numbers of macro B are rounded where they are computed.
                    let rounds = word.computed && self.dialect.flow == FlowWords::MacroB;
                    let value = if rounds { value.round() } else { value };
                    Some(self.m_code(value).ok_or_else(|| self.unknown(word))?)
                }
                Some(value) if is("N") && i == 0 => {
                    if value < 0.0 {
                        return Err(self
                            .place
                            .malformed(&word.bytes, "a block number is not negative")
                            .into());
                    }
                    word.used = true;
                    None
                }
                Some(_) if is("O") && i == 0 && !self.numbered => {
                    word.used = true;
                    self.numbered = true;
                    None
                }
                Some(_) => {
                    if before.iter().any(|w| w.is(word.name)) {
                        return Err(self.answers(self.twice(&word.bytes), 25).into());
                    }
                    None
                }
                None => Some(self.keyword(word.name).ok_or_else(|| self.unknown(word))?),
            };
            if let Some(Code::NotRead(why)) = code {
                return Err(self.place.not_understood(&word.bytes, why).into());
            }
            if let Some(code) = code {
                word.used = true;
                let beside = |other: Code| {
                    self.dialect.cancel_beside_motion && (code == Code::NoMotion) != (other == Code::NoMotion)
                };
                let group = |c: Code| c.group().or_else(|| self.group_of_m_code(c));
                let said = |of| self.codes.iter().any(|(c, _)| group(*c) == Some(of) && !beside(*c));
                if group(code).is_some_and(said) {
                    return Err(self.answers(self.twice(&word.bytes), 21).into());
                }
                self.codes.push((code, word.bytes.clone()));
            }
        }
        Ok(())
    }

    /// Group of an M code of which this control takes one in a block: coolant, overrides.
    fn group_of_m_code(&self, code: Code) -> Option<u8> {
        match code {
            Code::Mist | Code::Flood | Code::CoolantOff if self.dialect.one_of_group => Some(24),
            Code::Harmless(_) if self.dialect.one_of_group => Some(25),
            _ => None,
        }
    }

    /// Refuses a second code that uses axis words, of a control that takes one.
    pub(super) fn one_use_of_axes(&self) -> Result<()> {
        let covets = |c: Code| {
            matches!(
                c,
                Code::Reference
                    | Code::FurtherReference
                    | Code::SetData
                    | Code::LocalShift
                    | Code::PresetShift
            )
        };
        let (Some((_, bytes)), Some((motion, of_motion))) = (self.code(covets), self.motion_code()) else {
            return Ok(());
        };
        if !self.dialect.one_of_group || motion == Code::NoMotion {
            return Ok(());
        }
        let message = format!(
            "`{}` and `{}` in one block both use its axis words",
            self.place.shown(&bytes),
            self.place.shown(&of_motion)
        );
        let finding = self.place.error(FindingCode::NC_SYNTAX, &of_motion, message);
        Err(self.answers(finding.help("write them in two blocks"), 24).into())
    }

    /// Whether the block is an arc, where K is a length and not a count.
    pub(super) fn curved(&self) -> bool {
        let said = self.motion_code().map(|c| c.0);
        matches!(said.or(self.modal.motion), Some(Code::Arc { .. } | Code::Involute { .. }))
    }

    fn unknown(&self, word: &Word<'_>) -> Finding {
        let answer = self.dialect.answer.unwrap_or("kinecut does not know what the control does with it");
        let finding = self.place.not_understood(&word.bytes, answer);
        match word.value.filter(|_| word.is("M")).and_then(whole).and_then(|number| self.tolerated(number)) {
            Some(what) => finding.help(format!("it moves no axis by custom ({what}): pass it over with --tolerant, or say what it does in the machine file: codes")),
            None => finding,
        }
    }

    /// A finding with the number of the error that GRBL or grblHAL answers there.
    pub(super) fn answers(&self, finding: Finding, number: u8) -> Finding {
        answered(self.dialect, finding, number)
    }

    pub(super) fn twice(&self, bytes: &Bytes) -> Finding {
        let message =
            format!("`{}`: the block says this twice, or contradicts itself", self.place.shown(bytes));
        self.place.error(FindingCode::NC_SYNTAX, bytes, message)
    }

    fn g_code(&self, value: f64) -> Option<Code> {
        let tenths = whole(value * 10.0)?;
        self.g_code_of_language(tenths).or_else(|| self.own_code('G', tenths))
    }

    /// A function of the machine that is passed over where that is asked for.
    fn tolerated(&self, number: u32) -> Option<&'static str> {
        let found =
            self.dialect.tolerated.iter().find(|(first, last, _)| (*first..=*last).contains(&number))?;
        Some(found.2)
    }

    fn m_code(&self, value: f64) -> Option<Code> {
        let number = whole(value)?;
        let known = self.m_code_of_language(number).or_else(|| self.own_code('M', number.saturating_mul(10)));
        let passed = || self.tolerated(number).filter(|_| self.tolerant).map(Code::Tolerated);
        known.or_else(passed)
    }

    /// Refuses codes of the machine that the language has: their meaning there would be lost.
    pub(super) fn check_own_codes(&self) -> Result<()> {
        let known = |c: &&OwnCode| match c.letter {
            'G' => self.g_code_of_language(c.tenths).is_some(),
            _ => self.m_code_of_language(c.tenths / 10).is_some(),
        };
        match self.own_codes.iter().find(known) {
            Some(code) => {
                let message =
                    format!("the machine gives `{code}` an effect, and the language of its control has it");
                Err(Finding::error(FindingCode::MACHINE_AXIS, message)
                    .help("leave it out of `codes` of the machine")
                    .into())
            }
            None => Ok(()),
        }
    }

    fn g_code_of_language(&self, tenths: u32) -> Option<Code> {
        let find = |table: &[(u32, Code)]| {
            let found = table.iter().find(|(t, _)| *t == tenths).map(|(_, c)| *c);
            found.filter(|c| *c != Code::FeedPerRevolution || self.dialect.per_revolution)
        };
        let own = || find(self.dialect.g_codes).or_else(|| find(self.dialect.further_g_codes));
        find(COMMON_G).or_else(own).or_else(|| {
            let offset = WorkOffset::from_tenths(tenths).or_else(|| self.offset_by_code(tenths));
            offset.filter(|o| (self.dialect.has_offset)(*o)).map(Code::Work)
        })
    }

    /// The effect of a code that the machine has of its own.
    fn own_code(&self, letter: char, tenths: u32) -> Option<Code> {
        let found = self.own_codes.iter().find(|c| c.letter == letter && c.tenths == tenths)?;
        Some(match found.effect {
            CodeEffect::TipControl => Code::Transformation { on: true },
            CodeEffect::NoTipControl => Code::Transformation { on: false },
            CodeEffect::NoMotion => Code::Harmless("a code of the machine"),
        })
    }

    fn m_code_of_language(&self, number: u32) -> Option<Code> {
        let found = COMMON_M.iter().chain(self.dialect.m_codes).find(|(m, _)| *m == number).map(|(_, c)| *c);
        found.filter(|c| match c {
            Code::ToolChange => !self.dialect.hand_change(),
            Code::Mist => self.dialect.mist,
            _ => true,
        })
    }

    fn keyword(&self, name: &str) -> Option<Code> {
        self.dialect.keywords.iter().find(|(k, _)| k.eq_ignore_ascii_case(name)).map(|(_, c)| *c)
    }

    /// The place of the first code that a test accepts.
    #[inline]
    pub(super) fn code(&self, test: impl Fn(Code) -> bool) -> Option<(Code, Bytes)> {
        self.codes.iter().find(|(c, _)| test(*c)).cloned()
    }

    /// A value that must be a whole number.
    pub(super) fn count(&self, value: &Value, what: &str) -> Result<u32> {
        whole(value.value).ok_or_else(|| {
            let finding = self.place.malformed(&value.bytes, &format!("{what} is a whole number"));
            self.answers(finding, 23).into()
        })
    }

    /// Adds a tool item, if the state in force is not that of the last one.
    pub(super) fn flush(&mut self, kind: Kind) {
        let (tool, told) = (self.modal.tool, self.modal.told);
        let hidden = self.modal.length_hidden || self.modal.rotary_axes.lapsed;
        let length_told = tool.length == told.length || hidden && kind == Kind::Other;
        let Some(id) = tool.id else {
            if !length_told {
                self.modal.told.length = tool.length;
                let data = ControlData::LengthCall { register: tool.length };
                self.program.push_data(data, &self.state(Speed::Rapid { linear: false }), self.origin);
            }
            return;
        };
        if told.id == Some(id) && length_told {
            return;
        }
        let radius = tool.length.filter(|_| self.dialect.one_register);
        let state = self.state(Speed::Rapid { linear: false });
        self.program.push_tool(id, tool.length, radius, &state, self.tool_origin);
        if self.modal.called.replace(id) == Some(id) && told.id.is_none() {
            self.program.change_again();
        }
        // Only after a change of tool is the place of Z unknown, and the length not in use.
        self.modal.tool_item = told.id.is_none().then(|| self.program.items.len() - 1);
        self.modal.told = tool;
    }

    pub(super) fn state(&self, speed: Speed) -> State {
        State {
            setup: self.modal.setup,
            frame: self.modal.frame,
            speed,
            spindle: self.modal.spindle,
            blend: self.modal.blend,
            tcp: self.modal.rotary_axes.tcp,
            comp: self.scaling.map.map_or(self.modal.comp, |map| map.side(self.modal.comp)),
            coolant: self.modal.coolant,
        }
    }

    /// Whether the block has a word of an axis.
    pub(super) fn has_axis(&self, words: &[Word<'s>]) -> bool {
        self.has_rotary(words) || words.iter().any(|w| !w.used && AXES.iter().any(|a| w.is(a)))
    }
}

/// A finding with the number of the error that GRBL or grblHAL answers there.
pub(super) fn answered(dialect: &Dialect, finding: Finding, number: u8) -> Finding {
    if !matches!(dialect.mismatch, Mismatch::Grbl) {
        return finding;
    }
    let name = if dialect.answer.is_some() { "GRBL" } else { "grblHAL" };
    let answer = format!("{name} answers error {number} here");
    let help = match finding.help.as_str() {
        "" => answer,
        help => format!("{help}; {answer}"),
    };
    finding.help(help)
}

/// The first lines of a list.
fn listed(lines: &[String]) -> String {
    const MOST: usize = 10;
    let mut shown: Vec<String> = lines.iter().take(MOST).cloned().collect();
    if lines.len() > MOST {
        shown.push(format!("and {} more", lines.len() - MOST));
    }
    shown.join(", ")
}

/// The value of a word that nothing has used yet.
#[inline]
pub(super) fn take(words: &mut [Word<'_>], name: &str) -> Option<Value> {
    let plain = |w: &&mut Word<'_>| !w.used && w.way == WordMode::Plain && w.is(name);
    let word = words.iter_mut().find(plain)?;
    word.used = true;
    Some(Value { value: word.value?, bytes: word.bytes.clone() })
}

/// The value of a word that nothing has used yet, and how it counts.
#[inline]
pub(super) fn take_way(words: &mut [Word<'_>], name: &str) -> Option<(Value, WordMode)> {
    let word = words.iter_mut().find(|w| !w.used && w.is(name))?;
    word.used = true;
    Some((Value { value: word.value?, bytes: word.bytes.clone() }, word.way))
}

/// The whole number a value is, to rounding.
fn whole(value: f64) -> Option<u32> {
    /// Decimal fractions times ten are off by an ulp.
    const ULPS: f64 = 1e-6;
    let rounded = value.round();
    ((value - rounded).abs() < ULPS && (0.0..=f64::from(u32::MAX)).contains(&rounded))
        .then_some(rounded as u32)
}
