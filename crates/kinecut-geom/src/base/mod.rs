//! Common ground of all layers: places in source text, findings, progress, the loader.

pub mod bounded;
mod code;
mod file_kind;
mod files_read;
mod finding;
mod gate;
mod loader;
mod overlay;
mod progress;
mod span;
mod text;
pub mod unit;

pub use bounded::MAX_LENGTH;
pub use code::{Code, ManualPage, manual};
pub use file_kind::FileKind;
pub use files_read::FilesRead;
pub use finding::{Error, Finding, Quantity, Result, Severity};
pub use gate::{CountBound, Sum, bytes_asked};
pub use loader::{DiskLoader, Loader, MemoryLoader, MeshesIn, read_stream, read_text_stream};
pub use overlay::OverlayLoader;
pub use progress::{Progress, Silent};
pub use span::{FileId, Location, Sources, Span};
pub use text::at_most;
