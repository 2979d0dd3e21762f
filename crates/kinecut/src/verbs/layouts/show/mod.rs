//! Layouts as pictures: one body for each link along the chain, to scale, isometric, in light and dark.
//!
//! Blue bodies carry the work and have primed letters, orange ones carry the tool; grey stands on the ground. Arrows point
//! in the positive direction of the axis: of a primed one in that of its slide (ISO 841). Everything is SVG made here.

mod arrow;
mod bodies;
mod facets;
mod figure;
mod given;
mod hidden;
mod scheme;
mod sheet;
mod solid;
mod style;

pub use sheet::{
    layout_drawing, layout_figure, layout_scheme, layout_sheet, machine_drawing, machine_drawing_at,
};
pub use style::layout_style;

pub(crate) use facets::Facets;
pub(crate) use figure::{arrow, polyline};
pub(crate) use hidden::{Piece as PaintedPiece, painted};
pub(crate) use sheet::file;
