//! Milled faces as a person looks at them: text, page, sections of a job's report.

use super::Section;
use crate::job::{FaceSheet, Outcome};

/// The sheet of a face as text; `paper`: with what the paper's program does.
pub fn face_text(sheet: &FaceSheet, _paper: bool) -> String {
    let way = sheet.face.chosen();
    format!("{}\nbad length {:.3} mm, with guard {:.3} mm\n", sheet.title, way.bad, way.guarded)
}

/// The sheets of faces as one HTML file.
pub fn faces_html(_sheets: &[&FaceSheet]) -> String {
    String::new()
}

/// One section for each milled face of a job.
pub(super) fn sections(_outcome: &Outcome) -> Vec<Section> {
    Vec::new()
}
