//! Tools of any form of revolution: from a file to their contour, for the verbs that look at tools alone.

mod read;
mod shape;

pub use read::{contour_of, load_contour};
