//! Looks of what pictures of envelopes show.

use super::parts::Part;
use crate::page::{Colour, Dash, Ink, Tint, Width};

/// A grazing curve.
pub(super) const CURVE: Ink = Ink::line(Colour::Ink, Width::Thin);
/// The same, hidden.
pub(super) const HIDDEN_CURVE: Ink = Ink::Line(Colour::Ink, Width::Fine, Dash::Hidden);
/// The outline of the tool where it was or will be.
pub(super) const PHANTOM: Ink = Ink::Line(Colour::Accent, Width::Fine, Dash::Chain);

/// Colour of a part.
pub(super) fn tint(part: Part) -> Tint {
    match part {
        Part::Wall => Tint::Teal,
        Part::Start => Tint::Steel,
        Part::End => Tint::Orange,
        Part::Inside => Tint::Rose,
    }
}
