//! The sheet of `kinecut face` as a page, and in words.

use super::FaceSheet;
use crate::operations::face::{MilledFace, face_page, face_words, view};
use crate::page::Section;

fn of_sheet(sheet: &FaceSheet, number: usize) -> MilledFace<'_> {
    let face = MilledFace {
        findings: &sheet.findings,
        events: &sheet.events,
        ..view(&sheet.title, number, &sheet.face)
    };
    match &sheet.paper {
        Some(p) => MilledFace {
            survey: &p.survey,
            from_drawn: p.from_drawn.as_ref(),
            descents: &p.descents,
            map: Some(&p.map),
            ..face
        },
        None => face,
    }
}

/// The sheet of a face in words and numbers.
pub(super) fn section(sheet: &FaceSheet) -> Section {
    face_words(&of_sheet(sheet, 0))
}

/// The sheets of faces as one HTML file without any reference to a network.
pub(super) fn faces_html(sheets: &[&FaceSheet]) -> String {
    let faces: Vec<MilledFace<'_>> = sheets.iter().enumerate().map(|(i, s)| of_sheet(s, i)).collect();
    face_page(&faces)
}
