//! What all pictures are drawn with: the palette, looks, files.

mod file;
mod ink;
pub(crate) mod palette;

pub(crate) use file::sheet;
pub(crate) use ink::rules;
pub use ink::{Colour, Dash, Ink, Tint, Width};
