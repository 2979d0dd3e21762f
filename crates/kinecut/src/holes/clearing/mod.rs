//! Ways to clear the disc inside a bore in one plane, each a chain of exact curves from a small circle to the wall:
//! one strategy a file, all asked for in the same words and answered in the same form.
//!
//! Everything is counter-clockwise about the origin, in the plane of a level; the cutter's centre starts on the circle
//! of radius `inner` (zero: in the centre), where the whole disc that it can sweep from there is already cleared, and
//! ends on the wall circle of radius `outer`, which it then runs round once.

mod spiral;

use crate::base::{Code, Finding, Result};
use crate::geom::{InvoluteRecord, LensOrder, PlaneCurve};

/// How the disc is cleared.
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

/// What is to be cleared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Radius of the circle from which the cutter's centre starts [mm]; zero: it starts in the centre.
    pub inner: f64,
    /// Up to where that circle may grow when a base radius is rounded [mm].
    pub inner_most: f64,
    /// Radius of the wall circle of the cutter's centre [mm].
    pub outer: f64,
    /// Radius of the cutter [mm].
    pub cutter: f64,
    /// Largest radial step [mm].
    pub step: f64,
    /// Largest engagement angle [rad], for the strategies that keep one.
    pub engagement: Option<f64>,
    /// Tangent angle at which the wall is met: the path ends in `(outer sin psi, -outer cos psi)`.
    pub psi: f64,
    /// Least step of the control [mm], for which the base radii of involutes are rounded.
    pub resolution: Option<f64>,
}

/// A cleared disc.
#[derive(Clone, Debug, PartialEq)]
pub struct Cleared {
    /// From the inner circle to the wall circle, each curve starting where the last one ended.
    pub curves: Vec<PlaneCurve>,
    /// Radius of the circle on which it really starts [mm]: a rounded base radius may move it a little.
    pub inner: f64,
    /// The full circle at the wall.
    pub closing: InvoluteRecord,
    /// Turns about the centre, the closing circle not counted.
    pub turns: f64,
    /// Largest normal step [mm].
    pub step: f64,
    /// Engagement kept [rad], for the strategies that keep one.
    pub engagement: Option<f64>,
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
    /// `KC0404` for numbers that give no path (what, value, bound, cure).
    pub fn path(self, disc: &Disc) -> Result<Cleared> {
        match self {
            Clearing::Involute => spiral::involute(disc),
            _ => {
                Err(Finding::error(Code::PLAN_VALUE, format!("the strategy `{}` is not there", self.name()))
                    .into())
            }
        }
    }
}
