//! Envelopes as a person sees them: the swept body with tool, grazing curves and cusps, what enters over time, tables.

mod tables;
mod text;

pub use text::envelope_text;
