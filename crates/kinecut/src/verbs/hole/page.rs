//! The page of planned holes.

use super::HolePlan;
use crate::page::verb_page::VerbPage;
use crate::page::{Block, Section};
use crate::verbs::Answer as _;

/// The plans of one or more holes as one HTML file without any reference to a network.
pub(super) fn hole_html(holes: &[&HolePlan]) -> String {
    let title = match holes {
        [one] => one.title.clone(),
        _ => format!("{} holes", holes.len()),
    };
    VerbPage {
        maker: "kinecut hole",
        title: &title,
        caution: "A plan on a model does not replace the trial cut.",
        sections: &holes.iter().flat_map(|hole| sections(hole)).collect::<Vec<_>>(),
        ..VerbPage::default()
    }
    .html()
}

/// What the terminal shows, the remarks, and the figures.
fn sections(hole: &HolePlan) -> Vec<Section> {
    let mut sections = hole.sections();
    if let (Some(section), false) = (sections.first_mut(), hole.findings.is_empty()) {
        section.blocks.push(Block::List(hole.findings.iter().map(|f| f.message.clone()).collect()));
    }
    if !hole.drawings.is_empty() {
        let mut figures =
            Section::new("The lead-in of finishing, as in figures 3, 4 and 5 of Sorokin, But, Kombarov 2013");
        figures.blocks.extend(hole.drawings.iter().cloned().map(Block::from));
        sections.push(figures);
    }
    sections
}
