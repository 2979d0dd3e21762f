//! The verb `kinecut drill`: an operation planned for itself, as a sheet of numbers for a person or another program.

mod json;
mod page;
mod sheet;

pub use sheet::{DrillSheet, plan_drill_sheet};

use std::borrow::Cow;

use super::Answer;
use crate::base::{Finding, Result};
use crate::job::Outputs;
use crate::page::Section;

impl Answer for DrillSheet {
    fn sections(&self) -> Vec<Section> {
        page::sections(self)
    }

    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }

    fn add_findings(&mut self, findings: Vec<Finding>) {
        self.findings.extend(findings);
    }

    fn parts(&self) -> [usize; 2] {
        [self.holes.len(), self.errors().count()]
    }

    fn data(&self) -> Cow<'_, str> {
        Cow::Borrowed(&self.program)
    }

    fn files(answers: &[&DrillSheet]) -> Result<Outputs> {
        Ok(super::page("drill.html", page::sheets_html(answers)))
    }
}
