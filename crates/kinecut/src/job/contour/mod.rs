//! Tools of any form of revolution: from a file to their contour, for the verbs that look at tools alone.

mod given;
mod read;

pub(crate) use given::{chosen_contour, given_contour};
pub use read::{contour_of, load_contour};
