//! Presentation of a milled face: the outline with its entries and exits, before and after, the objective over all
//! placements, the ways with their price, and the text and page of the verb `kinecut face`.
//!
//! The planner takes every spindle as M3; what is shown is the part as it lies ([`MilledFace::seen`]).

mod crossings;
mod edges;
mod figure_map;
mod figure_pareto;
mod figure_plan;
mod figure_series;
mod figure_ways;
mod frame;
mod looks;
mod motion;
mod page;
mod simulated;
mod strokes;
mod tables;
mod view;

pub(crate) use motion::Timed;
pub(crate) use page::{face_page, face_section, face_words};
pub(crate) use simulated::{Dot, Simulated};
pub(crate) use view::MilledFace;

#[cfg(test)]
mod tests;
