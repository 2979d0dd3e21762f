//! Ways to clear the disc inside a bore in one plane, each a chain of exact curves from a small circle to the wall:
//! one strategy a file, all asked for in the same words and answered in the same form.
//!
//! Everything is counter-clockwise about the origin, in the plane of a level; the cutter's centre starts on the circle
//! of radius `inner` (zero: in the centre), where the whole disc that it can sweep from there is already cleared, and
//! ends on the wall circle of radius `outer`, which it then runs round once.

mod archimedes;
pub(super) mod disc;
mod ellipse;
mod even;
mod poles;
mod rings;
#[cfg(test)]
mod tests;
mod trochoid;
mod turns;

pub use disc::{Cleared, Disc, turns};
pub use ellipse::{ClearedEllipse, EllipsePocket, ellipse};
pub use even::rings_of_equal_engagement;

use super::spiral;
use crate::base::Result;
use crate::geom::LensOrder;

/// Strategy by which the disc is cleared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Clearing {
    /// Circle involute (Sorokin, But, Kombarov 2013): constant normal step, contact G2 with the wall.
    Involute,
    /// Lens involute: the same step and length, contact G4 or G6.
    Lens(LensOrder),
    /// Lens spiral of constant engagement, with the step as a cap.
    ConstantEngagement(LensOrder),
    /// Arcs about the vertices of a regular polygon: 2 (semicircles) or more poles, contact G1.
    Poles(u32),
    /// Archimedean spiral: meets the wall with a kink.
    Archimedes,
    /// Concentric rings joined by radial lines.
    RingsRadial,
    /// Concentric rings joined by tangent S links.
    RingsTangent,
    /// Trochoidal loops along the ring.
    Trochoid,
}

impl Clearing {
    /// Name in job files.
    pub fn name(self) -> &'static str {
        match self {
            Clearing::Involute => "involute",
            Clearing::Lens(LensOrder::Zero) => "lens-0",
            Clearing::Lens(LensOrder::One) => "lens-1",
            Clearing::Lens(LensOrder::Two) => "lens-2",
            Clearing::ConstantEngagement(LensOrder::Zero) => "constant-engagement-g2",
            Clearing::ConstantEngagement(LensOrder::One) => "constant-engagement",
            Clearing::ConstantEngagement(LensOrder::Two) => "constant-engagement-g6",
            Clearing::Poles(2) => "arcs-2",
            Clearing::Poles(4) => "arcs-4",
            Clearing::Poles(_) => "arcs",
            Clearing::Archimedes => "archimedean",
            Clearing::RingsRadial => "rings",
            Clearing::RingsTangent => "rings-tangent",
            Clearing::Trochoid => "trochoidal",
        }
    }

    /// The path that clears a disc.
    ///
    /// # Errors
    /// `KC0404` for numbers that give no path (what, value, bound, help).
    pub fn path(self, disc: &Disc) -> Result<Cleared> {
        disc.check()?;
        match self {
            Clearing::Involute => spiral::involute(disc),
            Clearing::Lens(order) => spiral::lens(disc, order),
            Clearing::ConstantEngagement(order) => even::constant_engagement(disc, order),
            Clearing::Poles(poles) => poles::arcs(disc, poles),
            Clearing::Archimedes => archimedes::archimedes(disc),
            Clearing::RingsRadial => rings::radial(disc),
            Clearing::RingsTangent => rings::tangent(disc),
            Clearing::Trochoid => trochoid::loops(disc),
        }
    }
}
