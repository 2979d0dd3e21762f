//! The verb `kinecut post`: a program that others wrote, in the words of another control.

mod reorient;
mod rework;
mod translate;

pub use translate::{Translation, translate};
