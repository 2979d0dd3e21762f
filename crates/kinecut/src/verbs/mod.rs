//! The verbs of the command line, one folder each: its question, its answer, and the answer as a person sees it.

mod answers;
pub mod check;
pub mod drill;
pub mod envelope;
pub mod explain;
pub mod face;
pub mod fk;
pub mod grazing;
pub mod guess;
pub mod hole;
pub mod ik;
pub mod layouts;
pub mod machine;
pub mod poses;
pub mod post;
mod program_line;
pub mod reach;
pub mod run;
mod safe_height;
pub mod schema;
pub mod surface;
pub mod time;
pub mod tools;
mod unknown_stock;
mod verify;

use std::borrow::Cow;

use serde::Serialize;

use crate::base::{Finding, Result};
use crate::job::Outputs;
use crate::page::{Section, WIDTH, text};

pub use answers::{Answers, json_document};

/// The answer of a verb to one question: as JSON what serde makes of it, as text for a terminal, and as files.
pub trait Answer: Serialize {
    /// Its sections on its page and on a terminal, without pictures, and without the findings, which have a form of
    /// their own on a terminal.
    fn sections(&self) -> Vec<Section>;

    /// As a person reads it on a terminal.
    fn text(&self) -> String {
        text(&self.sections(), WIDTH)
    }

    /// Findings about it.
    fn findings(&self) -> Vec<&Finding> {
        Vec::new()
    }

    /// Adds what a person should know of the question.
    fn add_findings(&mut self, _findings: Vec<Finding>) {}

    /// Whether the answer is no: nothing was found, or what was asked for cannot be.
    fn is_no(&self) -> bool {
        false
    }

    /// Parts of the question, and how many of them could not be answered.
    fn parts(&self) -> [usize; 2] {
        [1, 0]
    }

    /// A text for another program: blocks for a control, a machine file, words of axes; may be empty.
    fn data(&self) -> Cow<'_, str> {
        Cow::Borrowed("")
    }

    /// A drawing of it as an SVG file.
    ///
    /// # Errors
    /// Those of what is drawn; an answer that has no drawing, or several.
    fn svg(&self) -> Result<String> {
        Err(Finding::error(crate::base::Code::JOB_SHAPE, "there is no drawing of this").into())
    }

    /// The files of some answers: a page and what belongs to it, the results of a job.
    ///
    /// # Errors
    /// Those of what is drawn.
    fn files(_answers: &[&Self]) -> Result<Outputs>
    where
        Self: Sized,
    {
        Ok(Outputs::default())
    }
}

/// Files that are one page.
fn page(name: &str, html: String) -> Outputs {
    let mut outputs = Outputs::default();
    outputs.add(name, html);
    outputs
}

/// An SVG file is asked for and there are several drawings.
pub fn several_drawings(count: usize) -> crate::base::Error {
    Finding::error(crate::base::Code::JOB_SHAPE, "an SVG file has one drawing")
        .value(count as f64, "")
        .bound(1.0, "")
        .help("use --out: the page has them all")
        .into()
}
