//! Layouts: every order of the axes and every place of the bed that give the same motions, what they can do, and how
//! they compare.
//!
//! Where the bed stands changes no position of the tool relative to the work, but who moves: masses, overhangs, errors.
//! Counts: 24 layouts of XYZ (Vragov); 2 160 of three translations and two rotations, 1 440 of them of full mobility, 648
//! of those with translations that stay at right angles, in 12 classes.

mod mobility;
mod search;
mod words;

pub use mobility::{is_regular, rank_without_spin};
pub use search::{REGULAR_CLASSES, Search};
pub use words::{class_words, orders};
