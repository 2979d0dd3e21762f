//! Layouts as pictures: one body for each link along the chain, to scale, isometric, in light and dark.
//!
//! Blue bodies carry the work and have primed letters, orange ones carry the tool; grey stands on the ground. Arrows point
//! in the positive direction of the axis: of a primed one in that of its slide (ISO 841). Everything is SVG made here.

mod arrow;
mod bodies;
mod figure;
mod given;
mod looks;
mod scheme;
mod sheet;
mod solid;
mod usual;

pub use sheet::{
    layout_drawing, layout_figure, layout_scheme, layout_sheet, machine_drawing, machine_drawing_at,
};
pub(crate) use usual::{CUTTER, PART, side, usual, usual_sizes};
pub use usual::{layout_machine, with_usual_bodies};
