//! The verb `kinecut drill`: an operation planned for itself, as a sheet of numbers for a person or another program.

mod json;
mod page;
mod sheet;

pub use page::{sheet_text, sheets_html};
pub use sheet::{DrillSheet, plan_drill_sheet};
