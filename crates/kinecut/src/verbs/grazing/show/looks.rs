//! Looks of what pictures of grazing curves show.

use crate::page::{Colour, Dash, Ink, Tint, Width};

/// Outline of a tool.
pub(crate) const OUTLINE: Ink = Ink::line(Colour::Ink, Width::Fine);
/// Axis of the tool.
pub(super) const AXIS: Ink = Ink::Line(Colour::Quiet, Width::Fine, Dash::Chain);
/// Velocity of a point, with the head of its arrow.
pub(super) const ARROW: Ink = Ink::line(Colour::Accent, Width::Middle);
pub(super) const HEAD: Ink = Ink::Area(Colour::Accent);
/// A circle or surface that grazes as a whole.
pub(super) const WHOLE: Ink = Ink::line(Colour::Kind(8), Width::Wide);
pub(super) const HIDDEN_WHOLE: Ink = Ink::Line(Colour::Kind(8), Width::Thin, Dash::Hidden);
/// A fold or a cusp.
pub(crate) const FOLD: Ink = Ink::Ring(Colour::Ink);

/// Surface that enters, by its shade.
pub(super) fn entering(shade: u8) -> Ink {
    Ink::Face(Tint::Orange, shade)
}

/// Surface that leaves, by its shade.
pub(super) fn leaving(shade: u8) -> Ink {
    Ink::Face(Tint::Steel, shade)
}

/// A segment of the curve, by the number of its kind.
pub(super) fn segment(kind: u8) -> Ink {
    Ink::Line(Colour::Kind(kind), Width::Bold, if kind == 7 { Dash::Dots } else { Dash::Full })
}

/// The same, hidden behind the tool.
pub(super) fn hidden_segment(kind: u8) -> Ink {
    Ink::Line(Colour::Kind(kind), Width::Thin, Dash::Hidden)
}
