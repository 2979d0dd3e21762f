//! Looks of what pictures of envelopes show.

use super::parts::EnvelopePart;
use crate::page::{Colour, Dash, Ink, Tint, Width};

/// A grazing curve.
pub(super) const CURVE: Ink = Ink::line(Colour::Ink, Width::Thin);
/// The same, hidden.
pub(super) const HIDDEN_CURVE: Ink = Ink::Line(Colour::Ink, Width::Fine, Dash::Hidden);
/// The outline of the tool where it was or will be.
pub(super) const PHANTOM: Ink = Ink::Line(Colour::Accent, Width::Fine, Dash::Chain);

/// Colour of a part.
pub(super) fn tint(part: EnvelopePart) -> Tint {
    match part {
        EnvelopePart::Wall => Tint::Teal,
        EnvelopePart::Start => Tint::Steel,
        EnvelopePart::End => Tint::Orange,
        EnvelopePart::Inside => Tint::Rose,
    }
}
