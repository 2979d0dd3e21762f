//! Programs that others wrote: read and told in numbers (`check`), written for another control (`post`).

mod reorient;
mod rework;
mod sheet;
mod translate;

pub use sheet::{ProgramSheet, program_sheet};
pub use translate::{TranslateWants, Translation, translate};
