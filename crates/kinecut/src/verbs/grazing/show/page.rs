//! The page of the verb, and the picture as a file of its own.

use super::tables::{degenerate, entering, facts, loops, motion_lines, spans};
use super::{plane, tool};
use crate::page::verb_page::VerbPage;
use crate::page::{Block, Picture, Section, draw};
use crate::verbs::grazing::GrazingSheet;

/// Caution on a page of this verb.
pub(crate) const CAUTION: &str =
    "The grazing curve is that of one moment; what a move sweeps is the envelope of them all.";

/// The page of one sheet, or of several.
pub fn grazing_html(sheets: &[&GrazingSheet]) -> String {
    let title = match sheets {
        [one] if !one.title.is_empty() => one.title.clone(),
        [_] => "Grazing curve".to_owned(),
        _ => format!("{} grazing curves", sheets.len()),
    };
    let sections: Vec<Section> = sheets.iter().enumerate().map(|(i, s)| section(s, Some(i))).collect();
    VerbPage {
        maker: "kinecut grazing",
        title: &title,
        caution: CAUTION,
        sections: &sections,
        ..VerbPage::default()
    }
    .html()
}

/// The sheet in words and numbers; with its pictures and findings on a page, where it has a number.
pub(crate) fn section(sheet: &GrazingSheet, on_page: Option<usize>) -> Section {
    let title = if sheet.title.is_empty() { "Grazing curve" } else { &sheet.title };
    let mut section = Section::new(title).with(Block::Facts(facts(sheet)));
    let mut lines: Vec<String> = motion_lines(sheet);
    lines.extend(sheet.notes.iter().cloned());
    lines.extend(degenerate(sheet));
    if on_page.is_some() {
        lines.extend(sheet.findings.iter().map(|f| format!("{}: {f}", f.code)));
    }
    section.blocks.push(Block::List(lines.iter().map(|l| sentence(l)).collect()));
    if let Some(number) = on_page {
        section.blocks.extend(pictures(sheet, &format!("grazing-{}", number + 1)).map(Block::from));
    }
    if !sheet.loops.is_empty() {
        section.blocks.push(loops(sheet).into());
        section.blocks.push(spans(sheet).into());
    }
    section.with(entering(sheet))
}

/// The tool and the parameter plane.
pub(crate) fn pictures(sheet: &GrazingSheet, id: &str) -> [Picture; 2] {
    [
        tool::figure(sheet, &format!("{id}-tool"), "The tool with its curve"),
        plane::figure(sheet, &format!("{id}-plane"), "The parameter plane"),
    ]
}

/// With a capital and a full stop.
pub(crate) fn sentence(text: &str) -> String {
    let mut chars = text.chars();
    let first: String = chars.next().into_iter().flat_map(char::to_uppercase).collect();
    let rest = chars.as_str();
    format!("{first}{rest}{}", if rest.ends_with('.') { "" } else { "." })
}

/// Both pictures beside each other as an SVG file.
pub fn grazing_svg(sheet: &GrazingSheet) -> String {
    let title = if sheet.title.is_empty() { "Grazing curve" } else { &sheet.title };
    draw::sheet(title, &pictures(sheet, "grazing"), 2)
}
