//! What every layer needs and none owns: places in source text, findings, progress, the loader, formulas.

mod code;
pub mod expression;
mod finding;
mod loader;
mod progress;
mod span;

pub use code::{Code, ManualPage, manual};
pub use expression::Expression;
pub use finding::{Error, Finding, Quantity, Result, Severity};
pub use loader::{DiskLoader, Loader, MemoryLoader};
pub use progress::{Progress, Silent};
pub use span::{FileId, Location, Sources, Span};
