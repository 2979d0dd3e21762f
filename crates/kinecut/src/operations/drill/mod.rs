//! Drilling and its kin: from the table over planned holes to moves and cycles, proven on the simulated stock.

mod bodies;
mod check;
mod holes;
mod json;
mod moves;
mod plan;
mod prove;
mod section;
mod show;
mod surfaces;
mod table;
mod there;

pub use check::DrillOperation;
pub use holes::PlannedHole;
pub(crate) use holes::plan_each;
pub(crate) use json::{HoleJson, hole_json, refused_json};
pub use plan::PlannedDrilling;
pub(crate) use section::{ShownHole, title};
pub use show::{
    DrilledHole, LoadCurve, RefusedHole, drill_html, drill_list, drill_section, drill_sections, drill_table,
    drill_words, point_drawing, section_drawings, share_in_material,
};
pub use table::*;
