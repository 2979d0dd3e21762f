//! The means of all pictures: the palette, looks, one projection, one order of hidden faces, lines and arrows, files.

mod axes;
mod bodies;
mod cover;
mod facets;
mod file;
mod hidden;
mod ink;
mod labels;
mod line;
pub(crate) mod palette;
mod projection;
mod ticks;

pub(crate) use axes::{BELOW, Plot, room_left};
pub(crate) use bodies::put as put_faces;
pub(crate) use cover::Cover;
pub(crate) use facets::{Facets, SeenFace};
pub(crate) use file::sheet;
pub(crate) use hidden::FacePiece;
pub use ink::{Colour, Dash, Ink, Tint, Width};
pub(crate) use ink::{WIDTHS, rules};
pub(crate) use labels::{Labels, spread, width};
pub(crate) use line::{LinePath, arrow, head, line, triad};
pub(crate) use projection::View;
pub(crate) use ticks::Ticks;

/// A character of the 11 px letters of pictures, on average [px].
pub(crate) const CHARACTER: f64 = 6.1;
