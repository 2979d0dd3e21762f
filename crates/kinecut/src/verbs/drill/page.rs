//! The sheet of `kinecut drill` as a page, and in words.

use super::DrillSheet;
use crate::operations::drill::{
    DrilledHole, RefusedHole, ShownHole, drill_html, drill_list, drill_words, title,
};
use crate::page::Section;

/// The holes of sheets, and those that were refused.
fn of_sheets<'a>(sheets: &[&'a DrillSheet]) -> (Vec<ShownHole<'a>>, Vec<RefusedHole>) {
    let (mut shown, mut refused) = (Vec::new(), Vec::new());
    for sheet in sheets {
        for (number, hole) in sheet.holes.iter().enumerate() {
            match hole {
                Ok(hole) => {
                    let title = title(&sheet.name, hole, sheet.holes.len());
                    let paper = if sheet.paper { hole.paper() } else { None };
                    shown.push(ShownHole { paper, ..ShownHole::new(title, hole) });
                }
                Err(e) => refused.push(RefusedHole {
                    title: format!("{}: hole {}", sheet.name, number + 1),
                    at: None,
                    finding: (*e.0).clone(),
                }),
            }
        }
    }
    (shown, refused)
}

/// The page of `kinecut drill`.
pub(super) fn sheets_html(sheets: &[&DrillSheet]) -> String {
    let (shown, refused) = of_sheets(sheets);
    let views: Vec<DrilledHole<'_>> = shown.iter().map(ShownHole::view).collect();
    drill_html(&views, &refused)
}

/// A sheet in words and numbers: a hole in full, of a pattern a line each.
pub(super) fn sections(sheet: &DrillSheet) -> Vec<Section> {
    let (shown, refused) = of_sheets(&[sheet]);
    let views: Vec<DrilledHole<'_>> = shown.iter().map(ShownHole::view).collect();
    match (&views[..], &refused[..]) {
        ([one], []) => vec![drill_words(one)],
        (views, refused) => vec![drill_list(views, refused)],
    }
}
