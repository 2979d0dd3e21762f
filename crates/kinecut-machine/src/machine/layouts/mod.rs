//! Layouts: every order of the axes and every place of the bed that give the same motions, their abilities, and their
//! comparison.
//!
//! The place of the bed changes no position of the tool relative to the work, but who moves: masses, overhangs, errors.
//! Counts: 24 layouts of XYZ (Vragov); 2 160 of three translations and two rotations, 1 440 of them of full mobility, 648
//! of those with translations that stay at right angles, in 12 classes.

mod as_machine;
mod criterion;
mod kind;
mod layout;
mod list;
mod mobility;
mod query;
mod reach;
mod scores;
mod search;
mod sizes;
mod strokes;
mod words;
mod workspace;

pub use criterion::Criterion;
pub use kind::{Attitude, LayoutKind};
pub use layout::Layout;
pub use list::{Layouts, layouts, layouts_watched};
pub use mobility::{is_regular, rank_without_spin};
pub use query::{Conditions, Query, Stacking};
pub use reach::{Reach, reach};
pub use scores::{Scores, moved_masses};
pub use search::{REGULAR_CLASSES, Search};
pub use sizes::{LinkErrors, Masses, Sizes};
pub use strokes::needed_strokes;
pub use words::{class_words, orders};
pub use workspace::{Workspace, workspace};
