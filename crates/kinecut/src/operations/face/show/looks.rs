//! Looks of what pictures of a face show.

use crate::page::{Colour, Dash, Ink, Width};

/// Teeth enter here.
pub(super) const ENTRY: Ink = Ink::line(Colour::Series(2), Width::Bold);
/// Teeth leave here, well.
pub(super) const GOOD_EXIT: Ink = Ink::line(Colour::Ink, Width::Thin);
/// Teeth leave here, badly.
pub(super) const BAD_EXIT: Ink = Ink::line(Colour::Bad, Width::Thick);
/// Teeth leave here badly, where it does not count.
pub(super) const EXCUSED: Ink = Ink::Line(Colour::Bad, Width::Middle, Dash::Dots);
/// Not met, or lowered onto.
pub(super) const UNMET: Ink = Ink::Line(Colour::Doubt, Width::Middle, Dash::Dashes);
/// The material of the face, and its edge.
pub(super) const FACE: Ink = Ink::Area(Colour::Sunk);
pub(super) const EDGE: Ink = Ink::line(Colour::Quiet, Width::Fine);
/// The cutter.
pub(super) const CUTTER: Ink = Ink::Glass(Colour::Steel);
/// Path of a tooth through the material.
pub(super) const TOOTH: Ink = Ink::line(Colour::Steel, Width::Fine);
/// Path of the cutter's centre, its rapid links, heads of arrows on it.
pub(super) const CENTRE: Ink = Ink::Line(Colour::Accent, Width::Thin, Dash::Chain);
pub(super) const LINK: Ink = Ink::Line(Colour::Series(1), Width::Thin, Dash::Dashes);
pub(super) const ARROW: Ink = Ink::Area(Colour::Accent);
/// A place pointed at.
pub(super) const POINT: Ink = Ink::Dot(Colour::Ink);
/// The best one, another one, the one in use.
pub(super) const BEST: Ink = Ink::Ring(Colour::Series(2));
pub(super) const OTHER: Ink = Ink::Dot(Colour::Quiet);
pub(super) const CHOSEN: Ink = Ink::Dot(Colour::Accent);
/// An end of a search that may fail.
pub(super) const BASELINE: Ink = Ink::Ring(Colour::Ink);
/// Places that are not allowed.
pub(super) const FORBIDDEN: Ink = Ink::Area(Colour::Rule);
/// Simulated: teeth enter, leave well, leave badly, do otherwise than planned.
pub(super) const SIMULATED_ENTRY: Ink = Ink::line(Colour::Series(2), Width::Wide);
pub(super) const SIMULATED_GOOD: Ink = Ink::line(Colour::Ink, Width::Wide);
pub(super) const SIMULATED_BAD: Ink = Ink::Line(Colour::Bad, Width::Wide, Dash::Full);
pub(super) const DIFFERING: Ink = Ink::line(Colour::Series(1), Width::Thick);
