//! Envelopes as a person sees them: the swept body with tool, grazing curves and cusps, what enters over time, tables.

mod charts;
mod figure;
mod looks;
mod page;
mod parts;
mod scene;
mod tables;

pub(crate) use page::section;
pub use page::{envelope_html, envelope_svg};
