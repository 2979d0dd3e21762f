//! The verb `kinecut face`: an operation planned for itself, as a sheet of numbers for a person or another program.

mod json;
mod map;
mod page;
mod sheet;
#[cfg(test)]
mod tests;

pub use sheet::{FaceSheet, PaperBaseline, SheetWants, SimplexWalk, plan_face_sheet};

use std::borrow::Cow;

use super::Answer;
use crate::base::{Finding, Result};
use crate::job::Outputs;
use crate::page::Section;

impl Answer for FaceSheet {
    fn sections(&self) -> Vec<Section> {
        vec![page::section(self)]
    }

    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }

    fn add_findings(&mut self, findings: Vec<Finding>) {
        self.findings.extend(findings);
    }

    fn data(&self) -> Cow<'_, str> {
        Cow::Borrowed(&self.program)
    }

    fn files(answers: &[&FaceSheet]) -> Result<Outputs> {
        Ok(super::page("face.html", page::faces_html(answers)))
    }
}
