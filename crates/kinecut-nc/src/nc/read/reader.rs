//! The reader: its state, the words of a block as codes, and the items it makes of them.

use crate::base::{Code as FindingCode, Finding, Result, Sum};
use crate::nc::dialect::{AXES, COMMON_G, COMMON_M, Code, Dialect, TurnWord};
use crate::nc::multi_axis::ROTARY;
use crate::program::{Comp, Frame, Origin, Program, Setup, Speed, State, WorkOffset};

use super::Reading;
use super::lex::{Block, Word, WordMode};
use super::modal::{FeedMode, Modal};
use super::place::{Bytes, SourceText};

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
    /// Whether a coordinate had a decimal point, the first that had none, and whether that was said.
    points: (bool, Option<Finding>, bool),
    /// The words of the present block.
    pub(super) origin: Origin,
    pub(super) here: Bytes,
    /// The block that last changed tool or length.
    pub(super) tool_origin: Origin,
    pub(super) codes: Vec<(Code, Bytes)>,
}

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
            points: (false, None, false),
            origin: Origin::default(),
            here: 0..0,
            tool_origin: Origin::default(),
            codes: Vec::new(),
        }
    }

    /// Ends the reading; `at` is the first byte not read.
    pub(super) fn finish(mut self, at: usize) -> Result<Reading> {
        self.flush(Kind::Other);
        let text = self.place.text();
        let rest = text[at..].trim_matches(|c: char| c.is_whitespace() || c == '%');
        if self.modal.comp != Comp::Off {
            let end = at as u32;
            self.warn(&(end..end), "the cutter compensation is on at the end of the program");
        }
        if self.dialect.turn == TurnWord::Offset && !self.modal.turned.is_none() {
            let end = at as u32;
            let message = "the rotation or shift of a work offset (G10 L2 R, G52) stays beyond the program";
            self.warn(&(end..end), message);
        }
        if !self.ended {
            let end = text.len() as u32;
            self.warn(&(end..end), "the program has no end (M30)");
        } else if !rest.is_empty() {
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
        })
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

    pub(super) fn lacks(&self, bytes: &Bytes, message: &str) -> Finding {
        self.place.error(FindingCode::NC_STATE, bytes, message)
    }

    /// Executes a block.
    pub(super) fn block(&mut self, block: &mut Block<'s>) -> Result<()> {
        self.here = block.bytes();
        self.origin = Origin { span: Some(self.place.span(&self.here)), ..Origin::default() };
        if let Some(skip) = &block.skip {
            self.warn(skip, "a block with `/` is read as if the skip switch were off");
        }
        if let Some(torn) = &block.torn {
            self.warn(torn, "a number has blanks within: the control ignores them");
        }
        self.remarks(block);
        if block.words.is_empty() && block.call.is_none() {
            return Ok(());
        }
        self.collect(&mut block.words)?;
        if self.dialect.point {
            let without = self.least_increments(&mut block.words)?;
            self.mixed_points(&block.words, without);
        }
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
                Err(self.place.not_understood(&word.bytes, why).into())
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
                Some(value) if is("M") => Some(self.m_code(value).ok_or_else(|| self.unknown(word))?),
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
                        return Err(self.twice(&word.bytes).into());
                    }
                    None
                }
                None => Some(self.keyword(word.name).ok_or_else(|| self.unknown(word))?),
            };
            if let Some(code) = code {
                word.used = true;
                let beside = |other: Code| {
                    self.dialect.cancel_beside_motion && (code == Code::NoMotion) != (other == Code::NoMotion)
                };
                let group = |c: Code| c.group().or_else(|| self.group_of_m_code(c));
                let said = |of| self.codes.iter().any(|(c, _)| group(*c) == Some(of) && !beside(*c));
                if group(code).is_some_and(said) {
                    return Err(self.twice(&word.bytes).into());
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
        let covets = |c: Code| matches!(c, Code::Reference | Code::SetData | Code::LocalShift);
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
        Err(self
            .place
            .error(FindingCode::NC_SYNTAX, &of_motion, message)
            .help("write them in two blocks")
            .into())
    }

    /// Numbers without a decimal point count least increments.
    fn least_increments(&self, words: &mut [Word<'_>]) -> Result<Option<Finding>> {
        let mut without = None;
        let inch = match self.code(|c| matches!(c, Code::Units { .. })) {
            Some((Code::Units { inch, .. }, _)) => inch,
            _ => self.modal.length_unit != 1.0,
        };
        let step = if inch { 0.0001 } else { 0.001 };
        let has = |code: Code| self.codes.iter().any(|(c, _)| *c == code);
        let per_revolution = match self.modal.feed_mode {
            FeedMode::PerRevolution => !has(Code::FeedPerMinute) && !has(Code::InverseTime),
            _ => has(Code::FeedPerRevolution),
        };
        let is = |word: &Word<'_>, names: &[&str]| names.iter().any(|n| word.is(n));
        for word in words.iter_mut() {
            let feature = has(Code::Tilt);
            let axis = self.centre_is_axis() || has(Code::TipControl { vector: true });
            let length_k = is(word, &["K"]) && (self.curved() || feature || axis);
            let count = is(word, &["P", "T", "H", "D", "O", "N"])
                || is(word, &["K"]) && !length_k
                || is(word, &["Q"]) && feature;
            if word.point && count {
                let finding =
                    self.place.malformed(&word.bytes, "it is a count here, write it without a decimal point");
                return Err(finding.into());
            }
            let unit = if word.point || count {
                1.0
            } else if is(word, &["X"]) && has(Code::Dwell)
                || is(word, &["R"]) && has(Code::Rotation { on: true })
                || is(word, &["A", "B", "C"])
                || is(word, &["I", "J", "K"]) && feature
            {
                0.001
            } else if is(word, &["X", "Y", "Z", "I", "J", "R", "Q"]) || length_k {
                step
            } else if is(word, &["F"]) && per_revolution {
                if inch { 0.0001 } else { 0.01 }
            } else {
                1.0
            };
            // A nought is one either way.
            let counts = unit == step && !word.point && without.is_none();
            if let Some(value) = word.value.filter(|v| counts && *v != 0.0) {
                without = Some(self.without_point(word, value, unit));
            }
            if let Some(value) = &mut word.value {
                *value *= unit;
            }
        }
        Ok(without)
    }

    /// Finding for a coordinate without a decimal point, if others of the program have one.
    fn without_point(&self, word: &Word<'_>, value: f64, unit: f64) -> Finding {
        let said = format!(
            "`{}{value}` has no decimal point, other coordinates of the program have one: read as {} {}, in least increments (parameter 3401)",
            word.name,
            (value * unit * 1e4).round() / 1e4,
            if unit < 0.001 { "inch" } else { "mm" }
        );
        let finding = self.place.warning(FindingCode::NC_ASSUMED, &word.bytes, &said);
        finding.help(format!("write {}{value}. if that is meant", word.name))
    }

    /// Says of the first coordinate without a decimal point that it has none, in a program in which others have one.
    fn mixed_points(&mut self, words: &[Word<'_>], without: Option<Finding>) {
        let lengths = ["X", "Y", "Z", "I", "J", "R"];
        let dwells = self.code(|c| c == Code::Dwell).is_some();
        let is_length = |word: &&Word<'_>| lengths.iter().any(|n| word.is(n));
        self.points.0 |= !dwells && words.iter().filter(is_length).any(|w| w.point);
        if self.points.1.is_none() {
            self.points.1 = without;
        }
        if self.points.0
            && let Some(finding) = self.points.1.take_if(|_| !self.points.2)
        {
            self.points.2 = true;
            self.findings.push(finding);
        }
    }

    /// Whether the block is an arc, where K is a length and not a count.
    fn curved(&self) -> bool {
        let said = self.motion_code().map(|c| c.0);
        matches!(said.or(self.modal.motion), Some(Code::Arc { .. } | Code::Involute { .. }))
    }

    fn unknown(&self, word: &Word<'_>) -> Finding {
        self.place.not_understood(&word.bytes, "kinecut does not know what the control does with it")
    }

    pub(super) fn twice(&self, bytes: &Bytes) -> Finding {
        let message =
            format!("`{}`: the block says this twice, or contradicts itself", self.place.shown(bytes));
        self.place.error(FindingCode::NC_SYNTAX, bytes, message)
    }

    fn g_code(&self, value: f64) -> Option<Code> {
        let tenths = whole(value * 10.0)?;
        let find = |table: &[(u32, Code)]| {
            let found = table.iter().find(|(t, _)| *t == tenths).map(|(_, c)| *c);
            found.filter(|c| *c != Code::FeedPerRevolution || self.dialect.per_revolution)
        };
        find(COMMON_G).or_else(|| find(self.dialect.g_codes)).or_else(|| {
            WorkOffset::from_tenths(tenths).filter(|o| (self.dialect.has_offset)(*o)).map(Code::Work)
        })
    }

    fn m_code(&self, value: f64) -> Option<Code> {
        let number = whole(value)?;
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
    pub(super) fn code(&self, test: impl Fn(Code) -> bool) -> Option<(Code, Bytes)> {
        self.codes.iter().find(|(c, _)| test(*c)).cloned()
    }

    /// A value that must be a whole number.
    pub(super) fn count(&self, value: &Value, what: &str) -> Result<u32> {
        whole(value.value)
            .ok_or_else(|| self.place.malformed(&value.bytes, &format!("{what} is a whole number")).into())
    }

    /// Adds a tool item, if the state in force is not that of the last one.
    pub(super) fn flush(&mut self, kind: Kind) {
        let (tool, told) = (self.modal.tool, self.modal.told);
        let Some(id) = tool.id else { return };
        let hidden = self.modal.length_hidden || self.modal.rotary_axes.lapsed;
        let length_told = tool.length == told.length || hidden && kind == Kind::Other;
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
            comp: self.modal.comp,
            coolant: self.modal.coolant,
        }
    }

    /// Whether the block has a word of an axis.
    pub(super) fn has_axis(&self, words: &[Word<'s>]) -> bool {
        self.has_rotary(words) || words.iter().any(|w| !w.used && AXES.iter().any(|a| w.is(a)))
    }
}

/// The value of a word that nothing has used yet.
pub(super) fn take(words: &mut [Word<'_>], name: &str) -> Option<Value> {
    let plain = |w: &&mut Word<'_>| !w.used && w.way == WordMode::Plain && w.is(name);
    let word = words.iter_mut().find(plain)?;
    word.used = true;
    Some(Value { value: word.value?, bytes: word.bytes.clone() })
}

/// The value of a word that nothing has used yet, and how it counts.
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
