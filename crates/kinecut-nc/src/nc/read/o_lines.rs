//! Lines with an o word, run.

use std::rc::Rc;

use crate::base::{Code, Finding, Result};
use crate::nc::linuxcnc::o_word::{self, OLine, OLines, OWord};
use crate::nc::run::{Expression, Level};

use super::block::Block;
use super::lex::range;
use super::place::{Bytes, SourceText};
use super::run::{Run, Turns, nothing_else};

/// Arguments of a call.
const ARGUMENTS: usize = 30;

impl<'s> Run<'s> {
    /// Runs the line with its `o` at a byte.
    pub(super) fn o_line(
        &mut self,
        start: usize,
        at: usize,
        end: usize,
        block: &mut Block<'s>,
    ) -> Result<()> {
        let place = self.reader.place;
        let lexer = self.lexer();
        let mut expression = lexer.expression(at + 1, end);
        let label = label(&mut expression)?;
        let line = &place.text().as_bytes()[start..end];
        let (word, stop) = o_word::parsed(line, expression.at - start);
        let behind = start + stop;
        let bytes = range(at, behind);
        let lines = self.o_lines(place);
        let own = lines.at(start);
        if word == OWord::Call {
            return self.o_call(&label.text(), &bytes, end, block);
        }
        let Some(own) = own else {
            let why = "only a call has a label that is computed";
            return Err(place.malformed(&bytes, why).into());
        };
        let o_line = lines.line(own).clone();
        if o_line.begin.is_none() && !matches!(word, OWord::Program | OWord::Return) && o_line.end.is_none() {
            return Err(self.unpaired(&o_line, &bytes).into());
        }
        match word {
            OWord::Program => self.ends_here(behind, end, block),
            OWord::Sub => {
                self.not_nested(place, &lines, own)?;
                self.pass_over(&lines, own, &bytes)
            }
            OWord::If => self.o_if(&lines, own, bytes.end as usize, end, block),
            // Reached from above: the branch that was taken ends here.
            OWord::ElseIf | OWord::Else => self.pass_over(&lines, o_line.begin.unwrap_or(own), &bytes),
            OWord::EndIf => self.ends_here(behind, end, block),
            OWord::Do => self.ends_here(behind, end, block),
            OWord::While => self.o_while(&lines, own, &bytes, end, block),
            OWord::EndWhile => {
                self.ends_here(behind, end, block)?;
                self.o_back(lines.line(o_line.begin.unwrap_or(own)).start, &bytes)
            }
            OWord::Repeat => self.o_repeat(&lines, own, &bytes, end, block),
            OWord::EndRepeat => {
                self.ends_here(behind, end, block)?;
                self.o_end_repeat(&lines, o_line.begin.unwrap_or(own), &bytes)
            }
            OWord::Break | OWord::Continue => {
                self.ends_here(behind, end, block)?;
                self.o_leave(&lines, own, &bytes)
            }
            OWord::Return | OWord::EndSub => self.o_return(word, &bytes, end, block),
            OWord::Call => Ok(()),
        }
    }

    /// Refuses a subprogram with another one in it.
    fn not_nested(&self, place: SourceText<'s>, lines: &OLines, own: usize) -> Result<()> {
        let Some(inner) = lines.line(own).inner else { return Ok(()) };
        let line = lines.line(inner);
        let end = line.start + place.text()[line.start..line.after].trim_end().len();
        let message = "a subprogram begins within another one";
        let finding = place.error(Code::NC_STATE, &range(line.start, end), message);
        Err(finding.help("write it before or behind the other").into())
    }

    /// Says that a loop does not run as its words say.
    fn runs_otherwise(&mut self, bytes: &Bytes, message: &str) {
        if self.reader.findings.iter().all(|finding| finding.message != message) {
            let finding = self.reader.place.warning(Code::NC_STATE, bytes, message);
            let help = "end the loop before this one by its condition, without break and continue";
            self.reader.findings.push(finding.help(help));
        }
    }

    fn unpaired(&self, line: &OLine, bytes: &Bytes) -> Finding {
        let message = match line.word.end_word() {
            "" => {
                format!("`{}` has no beginning of its label before it", self.reader.place.shown(bytes).trim())
            }
            word => {
                format!("`{}` has no `{word}` of its label behind it", self.reader.place.shown(bytes).trim())
            }
        };
        self.reader.lacks(bytes, &message)
    }

    fn partner(&self, line: Option<usize>, bytes: &Bytes) -> Result<usize> {
        line.ok_or_else(|| {
            let shown = self.reader.place.shown(bytes);
            self.reader.lacks(bytes, &format!("`{}` has no end of its label", shown.trim())).into()
        })
    }

    /// Goes on behind the line that ends what another one opens.
    fn pass_over(&mut self, lines: &OLines, opening: usize, bytes: &Bytes) -> Result<()> {
        self.at = lines.line(self.partner(lines.line(opening).end, bytes)?).after;
        Ok(())
    }

    /// Nothing but a comment follows from a byte on.
    fn ends_here(&mut self, from: usize, end: usize, block: &mut Block<'s>) -> Result<()> {
        self.lexer().line(from, end, block)?;
        nothing_else(&self.reader, block)?;
        // Nothing follows most of them.
        if block.is_blank() {
            return Ok(());
        }
        self.block(block).map(|_| ())
    }

    /// The value in brackets from a byte on, and nothing behind it.
    fn condition(&mut self, from: usize, end: usize, block: &mut Block<'s>) -> Result<f64> {
        let lexer = self.lexer();
        let mut expression = lexer.expression(from, end);
        let value = expression.bracketed()?.number();
        let stop = expression.at;
        self.reader.note_unset(&range(from, stop));
        self.ends_here(stop, end, block)?;
        Ok(value)
    }

    fn o_if(
        &mut self,
        lines: &Rc<OLines>,
        own: usize,
        from: usize,
        end: usize,
        block: &mut Block<'s>,
    ) -> Result<()> {
        if self.condition(from, end, block)? != 0.0 {
            return Ok(());
        }
        let text = self.reader.place.text();
        let mut at = own;
        while let Some(next) = lines.line(at).next {
            let line = lines.line(next);
            if matches!(line.word, OWord::Else | OWord::EndIf) {
                self.at = line.after;
                return Ok(());
            }
            // `elseif`: its condition is behind its label.
            let end = line.start + text[line.start..line.after].trim_end_matches(['\r', '\n']).len();
            let from = self.behind_label(line.start, end)?;
            if self.condition(from, end, block)? != 0.0 {
                self.at = line.after;
                return Ok(());
            }
            at = next;
        }
        let bytes = range(lines.line(own).start, from);
        Err(self.unpaired(lines.line(own), &bytes).into())
    }

    /// The byte behind the word of an o word's line.
    fn behind_label(&self, start: usize, end: usize) -> Result<usize> {
        let line = &self.reader.place.text().as_bytes()[start..end];
        let at = start + o_word::label_at(line).unwrap_or_default();
        let lexer = self.lexer();
        let mut expression = lexer.expression(at + 1, end);
        label(&mut expression)?;
        Ok(start + o_word::parsed(line, expression.at - start).1)
    }

    fn o_while(
        &mut self,
        lines: &Rc<OLines>,
        own: usize,
        bytes: &Bytes,
        end: usize,
        block: &mut Block<'s>,
    ) -> Result<()> {
        let goes_on = self.condition(bytes.end as usize, end, block)? != 0.0;
        let line = lines.line(own);
        match line.begin {
            // It ends a `do`.
            Some(begin) if goes_on && !self.leaving.broke => self.o_back(lines.line(begin).after, bytes),
            Some(_) => {
                if goes_on {
                    self.runs_otherwise(bytes, "LinuxCNC ends this loop although its condition holds: it still counts a break in a while loop before, or one behind a continue");
                }
                self.leaving.broke = false;
                Ok(())
            }
            None if goes_on => Ok(()),
            None => {
                self.leaving.broke |= lines.breaks_behind(own);
                self.leaving.continued = false;
                self.pass_over(lines, own, bytes)
            }
        }
    }

    fn o_back(&mut self, at: usize, bytes: &Bytes) -> Result<()> {
        self.at = at;
        self.came_back(bytes)
    }

    fn o_repeat(
        &mut self,
        lines: &Rc<OLines>,
        own: usize,
        bytes: &Bytes,
        end: usize,
        block: &mut Block<'s>,
    ) -> Result<()> {
        let turns = self.condition(bytes.end as usize, end, block)?.round_ties_even();
        if turns >= 1.0 {
            self.loops.push(Turns { line: own, left: turns as u64 });
            return Ok(());
        }
        self.leaving.continued = false;
        self.pass_over(lines, own, bytes)
    }

    fn o_end_repeat(&mut self, lines: &Rc<OLines>, begin: usize, bytes: &Bytes) -> Result<()> {
        let Some(at) = self.loops.iter().rposition(|turns| turns.line == begin) else {
            return Err(self.reader.lacks(bytes, "the loop ends here, and was not begun").into());
        };
        self.loops.truncate(at + 1);
        let turns = &mut self.loops[at];
        turns.left -= 1;
        if turns.left > 0 {
            return self.o_back(lines.line(begin).after, bytes);
        }
        self.loops.pop();
        if std::mem::take(&mut self.leaving.continued) {
            self.runs_otherwise(
                bytes,
                "LinuxCNC runs this repeat once more: it still counts the continue of a do loop before",
            );
            return self.o_back(lines.line(begin).start, bytes);
        }
        Ok(())
    }

    /// `break` and `continue`.
    fn o_leave(&mut self, lines: &Rc<OLines>, own: usize, bytes: &Bytes) -> Result<()> {
        let line = lines.line(own);
        let begin = lines.line(self.partner(line.begin, bytes)?);
        if begin.word == OWord::Repeat {
            let why = "LinuxCNC has no break or continue of a repeat";
            return Err(self.reader.place.not_understood(bytes, why).into());
        }
        let last = lines.line(self.partner(begin.end, bytes)?);
        // A repeat within the loop is left with it.
        let inside = |turns: &Turns| (begin.start..last.start).contains(&lines.line(turns.line).start);
        self.loops.retain(|turns| !inside(turns));
        match (line.word, begin.word) {
            (OWord::Break, OWord::Do) => (self.at, self.leaving.broke) = (last.after, false),
            (OWord::Break, _) => {
                self.leaving.broke = true;
                if std::mem::take(&mut self.leaving.continued) {
                    self.runs_otherwise(bytes, "LinuxCNC goes on with this loop in place of leaving it: it still counts the continue of a do loop before");
                    return self.o_back(begin.start, bytes);
                }
                self.at = last.after;
            }
            (_, OWord::Do) => {
                self.leaving.broke |= lines.breaks_behind(own);
                (self.at, self.leaving.continued) = (last.start, true);
            }
            _ => {
                self.leaving.broke |= lines.breaks_behind(own);
                self.leaving.continued = false;
                return self.o_back(begin.start, bytes);
            }
        }
        Ok(())
    }

    fn o_return(&mut self, word: OWord, bytes: &Bytes, end: usize, block: &mut Block<'s>) -> Result<()> {
        let lexer = self.lexer();
        let mut expression = lexer.expression(bytes.end as usize, end);
        let value = if expression.pass("[") {
            expression.at -= 1;
            Some(expression.bracketed()?.number())
        } else {
            None
        };
        let stop = expression.at;
        self.reader.note_unset(bytes);
        self.ends_here(stop, end, block)?;
        if self.frames.is_empty() {
            let what = if word == OWord::Return { "return" } else { "endsub" };
            return Err(self.reader.lacks(bytes, &format!("`{what}` outside of a subprogram")).into());
        }
        self.reader.value_returned = (value.unwrap_or(0.0), value.is_some());
        self.back(None, bytes).map(|_| ())
    }

    fn o_call(&mut self, name: &str, bytes: &Bytes, end: usize, block: &mut Block<'s>) -> Result<()> {
        let lexer = self.lexer();
        let mut expression = lexer.expression(bytes.end as usize, end);
        let mut level = Level::new(ARGUMENTS, false);
        let mut count = 0;
        loop {
            expression.pass_comments()?;
            if !expression.pass("[") {
                break;
            }
            expression.at -= 1;
            let value = expression.bracketed()?.number();
            let Some(place) = level.locals.get_mut(count) else {
                let finding = self.reader.place.malformed(bytes, "a call has thirty arguments at most");
                return Err(finding.into());
            };
            *place = value;
            count += 1;
        }
        let stop = expression.at;
        self.reader.note_unset(bytes);
        self.ends_here(stop, end, block)?;
        let places = [Some(self.reader.place), Some(self.main), self.beside(name)];
        let found = places
            .into_iter()
            .flatten()
            .find_map(|place| self.o_lines(place).sub(name).map(|line| (place, line)));
        let Some((place, line)) = found else {
            let message =
                format!("the subprogram `{name}` that is called is not in this file, nor beside it");
            let help = format!("write `o<{name}> sub` before the call, or put {name}.ngc beside the program");
            return Err(self.reader.lacks(bytes, &message).help(help).into());
        };
        let lines = self.o_lines(place);
        self.not_nested(place, &lines, line)?;
        let after = lines.line(line).after;
        self.call((place, after), 1, Some(level), bytes.clone()).map(|_| ())
    }
}

/// A label: only a call looks for it by its text.
enum Label {
    Name(String),
    Number(u32),
}

impl Label {
    /// As it is compared.
    fn text(self) -> String {
        match self {
            Label::Name(name) => name,
            Label::Number(number) => number.to_string(),
        }
    }
}

/// The label behind an `o`.
fn label(expression: &mut Expression<'_, '_>) -> Result<Label> {
    if expression.pass("<") {
        expression.at -= 1;
        return expression.name().map(Label::Name);
    }
    expression.index().map(Label::Number)
}
