//! Parts of the page of a report, for a page that shows them by itself.

use serde::Serialize;

use super::Report;
use crate::page::{Fact, blocks, visible};

/// A section as the page of a report has it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ShownSection {
    /// Heading.
    pub title: String,
    /// HTML without styles and scripts of its own; all text from outside is escaped.
    pub html: String,
}

/// The sections of a report as its page has them.
///
/// ```
/// use kinecut::job::Judgement;
/// use kinecut::job::report::{Report, ReportVerdict, shown_sections};
/// use kinecut::page::{Block, Section};
/// let mut report = Report::new("t", ReportVerdict::new(Judgement::Safe, ""));
/// report.sections.push(Section::new("Bores").with(Block::Text("a < b".to_owned())));
/// let shown = shown_sections(&report);
/// assert_eq!(shown[0].title, "Bores");
/// assert!(shown[0].html.contains("a &lt; b"));
/// ```
pub fn shown_sections(report: &Report) -> Vec<ShownSection> {
    let shown = report.sections.iter().enumerate().map(|(i, section)| ShownSection {
        title: visible(&section.title).into_owned(),
        html: blocks::section(section, &format!("section-{}", i + 1)).into_string(),
    });
    shown.collect()
}

/// The few numbers that a report shows first.
pub fn facts(report: &Report) -> Vec<Fact> {
    super::facts::shown(report)
}
