//! Any verb: its questions asked one by one, each with an error of its own, the answers printed, their files written, and
//! the exit code.

use std::path::Path;

use kinecut::base::{Error, Finding, Severity};
use kinecut::job::TextItems;
use kinecut::verbs::poses::{PoseTexts, PoseWords};
use kinecut::verbs::{Answer, Answers, several_drawings};
use serde::de::DeserializeOwned;

use crate::printing::{Deny, Printing};
use crate::show::{self, complain, data, put};
use crate::{files, render};

/// The questions of a text.
pub(crate) trait Questions {
    /// One of them.
    type One;

    /// Number of questions.
    fn count(&self) -> usize;

    /// Whether they are a list, so that the answers are one too.
    fn is_list(&self) -> bool;

    /// Asks one; an error carries its place in the text.
    fn ask<A>(&self, index: usize, run: impl FnOnce(&Self::One) -> Result<A, Error>) -> Result<A, Error>;

    /// Notes about one.
    fn notes(&self, _index: usize) -> Vec<Finding> {
        Vec::new()
    }
}

impl<T: DeserializeOwned + Clone> Questions for TextItems<T> {
    type One = T;

    fn count(&self) -> usize {
        TextItems::count(self)
    }

    fn is_list(&self) -> bool {
        self.list.is_some()
    }

    fn ask<A>(&self, index: usize, run: impl FnOnce(&T) -> Result<A, Error>) -> Result<A, Error> {
        self.item(index).and_then(|table| run(&table)).map_err(|e| self.locate(index, e))
    }

    fn notes(&self, index: usize) -> Vec<Finding> {
        TextItems::notes(self, index)
    }
}

impl Questions for PoseTexts {
    type One = PoseWords;

    fn count(&self) -> usize {
        self.items.len()
    }

    fn is_list(&self) -> bool {
        self.list
    }

    fn ask<A>(&self, index: usize, run: impl FnOnce(&PoseWords) -> Result<A, Error>) -> Result<A, Error> {
        self.items[index].clone().and_then(|words| run(&words)).map_err(|e| self.locate(index, e))
    }
}

/// Files that are named in one line.
const FEW: usize = 9;

/// Places of the answers beside standard output.
#[derive(Clone, Copy, Default)]
pub(crate) struct To<'a> {
    /// Folder of the files.
    pub(crate) out: Option<&'a Path>,
    /// File of the drawing.
    pub(crate) svg: Option<&'a Path>,
    /// Place of the text for another program.
    pub(crate) data: Data<'a>,
}

/// Place of the text for another program: blocks for a control, a machine file, words of axes.
#[derive(Clone, Copy, Default)]
pub(crate) enum Data<'a> {
    /// Not wanted.
    #[default]
    Nowhere,
    /// Below what a person reads.
    Below,
    /// Alone on standard output; what a person reads goes to standard error.
    Alone,
    /// A file.
    File(&'a Path),
}

/// Asks all questions of a text; the exit code tells the worst answer.
pub(crate) fn answers<Q: Questions, A: Answer>(
    args: &Printing,
    to: To<'_>,
    questions: &Q,
    run: impl Fn(&Q::One) -> Result<A, Error>,
) -> Result<u8, Error> {
    let ask = |index: usize| {
        let mut answer = questions.ask(index, &run)?;
        answer.add_findings(questions.notes(index));
        Ok(answer)
    };
    all(args, to, questions.is_list(), (0..questions.count()).map(ask))
}

/// Shows one answer.
pub(crate) fn answer<A: Answer>(args: &Printing, to: To<'_>, answer: A) -> Result<u8, Error> {
    all(args, to, false, std::iter::once(Ok(answer)))
}

fn all<A: Answer>(
    args: &Printing,
    to: To<'_>,
    list: bool,
    asked: impl Iterator<Item = Result<A, Error>>,
) -> Result<u8, Error> {
    // An error or a doubt always counts in the exit code, a warning when it is denied.
    let least = if args.deny.contains(&Deny::Warnings) { Severity::Warning } else { Severity::Doubt };
    let mut shown = Shown { args, to, answers: Answers::new(list, least) };
    // An answer that nothing is made of is shown and forgotten: a text may have very many.
    if to.out.is_none() && to.svg.is_none() && !matches!(to.data, Data::File(_)) {
        asked.for_each(|one| shown.put(one.as_ref()));
        return Ok(shown.end());
    }
    let asked: Vec<Result<A, Error>> = asked.collect();
    // Files first: what cannot be written is an error before anything is shown.
    let written = write(to, &asked.iter().flatten().collect::<Vec<_>>())?;
    asked.iter().for_each(|one| shown.put(one.as_ref()));
    let code = shown.end();
    if !args.json {
        put(written);
    }
    Ok(code)
}

/// Writes the files of answers; says which.
fn write<A: Answer>(to: To<'_>, answers: &[&A]) -> Result<String, Error> {
    let mut written = String::new();
    match (to.svg, answers) {
        (None, _) | (_, []) => {}
        (Some(file), [one]) => files::write_one(file, &one.svg()?)?,
        (Some(_), more) => return Err(several_drawings(more.len())),
    }
    if let (Data::File(file), [one]) = (to.data, answers) {
        files::write_one(file, &one.data())?;
        written = format!("\nWritten to {}\n", file.display());
    }
    if let (Some(out), false) = (to.out, answers.is_empty()) {
        let outputs = A::files(answers)?;
        let names: Vec<&str> = outputs.files().map(|(name, _)| name).collect();
        let names = if names.len() > FEW {
            format!("\n  {}", names.join("\n  "))
        } else {
            format!(" {}", names.join(", "))
        };
        written = format!("\nWritten to {}:{names}\n", out.display());
        files::write(outputs, out)?;
    }
    Ok(written)
}

/// Answers as they are shown, and what of them counts in the exit code.
struct Shown<'a> {
    args: &'a Printing,
    to: To<'a>,
    answers: Answers,
}

impl Shown<'_> {
    fn put<A: Answer>(&mut self, one: Result<&A, &Error>) {
        if self.args.json {
            show::json(&self.answers.json(one));
            return;
        }
        match one {
            Ok(answer) => self.text(answer),
            Err(error) => complain(render::finding(&error.0, self.args.colour())),
        }
        self.answers.add(one);
    }

    /// The text for a person, and that for another program.
    fn text<A: Answer>(&self, answer: &A) {
        let text = answer.text();
        match self.to.data {
            Data::Alone => {
                data(&answer.data());
                if !text.is_empty() {
                    complain(text.trim_end());
                }
            }
            other => {
                put(format!("{}{text}", if self.answers.count() > 0 { "\n" } else { "" }));
                if matches!(other, Data::Below) {
                    put(format!("\n{}", answer.data()));
                }
            }
        }
        for finding in answer.findings() {
            complain(render::finding(finding, self.args.colour()));
            complain("");
        }
    }

    fn end(&self) -> u8 {
        if self.args.json {
            show::json(self.answers.json_end());
        }
        self.answers.exit_code()
    }
}
