//! The verb `kinecut face`: an operation planned for itself, as a sheet of numbers for a person or another program.

mod json;
mod page;
mod sheet;
#[cfg(test)]
mod tests;

pub use page::{face_text, faces_html};
pub use sheet::{FaceSheet, PaperBaseline, SheetWants, plan_face_sheet};
