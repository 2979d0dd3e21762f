//! The page of the verb `kinecut time`.

use super::TimeSheet;
use crate::page::Block;
use crate::page::verb_page::VerbPage;
use crate::verbs::Answer;

/// The times, the slowest blocks, and the graphs of the motion: one HTML file without any reference to a network.
pub(super) fn time_html(sheet: &TimeSheet) -> String {
    let mut sections = sheet.sections();
    if !sheet.findings.is_empty() {
        let found = sheet.findings.iter().map(|f| format!("{}: {f}", f.code));
        sections[0].blocks.push(Block::List(found.collect()));
    }
    sections.extend(sheet.graphs.clone());
    VerbPage {
        maker: "kinecut time",
        title: &format!("Time of {}", sheet.file),
        caution: "The time of a control that keeps its axes to their limits; it does not replace a clock.",
        sections: &sections,
        ..VerbPage::default()
    }
    .html()
}
