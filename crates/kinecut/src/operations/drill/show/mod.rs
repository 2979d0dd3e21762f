//! Presentation of a drilled hole: the tool's point, the section with the drill at its four Z, the share of the point
//! in material, tables, and the page and text of the verb `kinecut drill`.

mod contact;
mod engagement;
mod outline;
mod page;
mod point;
mod scene;
mod section;
mod share;
mod share_grid;
mod tables;
mod view;

pub use engagement::{LoadCurve, share_in_material};
pub use page::{drill_html, drill_list, drill_section, drill_sections, drill_table, drill_words};
pub use point::point_drawing;
pub use section::section_drawings;
pub use view::{DrilledHole, RefusedHole};

#[cfg(test)]
mod tests;
