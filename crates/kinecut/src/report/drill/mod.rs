//! What a person sees of a drilled hole: the tool's point, the section with the drill at its four Z, the share of the
//! point in material, tables, and the page and text of the verb `kinecut drill`.

mod outline;
mod point;

pub use point::point_drawing;
