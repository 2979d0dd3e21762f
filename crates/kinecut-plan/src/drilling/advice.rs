//! Feeds at entry and exit as shares of the steady one: what makers publish, and our own default where they say nothing.
//!
//! Sources: Metaltecnia's catalogue page on indexable drills (face inclined by more than 2 degrees and concave entry: to
//! a third; a pre-drilled hole not above a quarter of the size), and Sandvik Coromant in "Why so cross?", Cutting Tool
//! Engineering 2013 (entering and leaving a cross hole: to a quarter).

use super::{BoundarySurface, Side};
use crate::tool::DrillPoint;

/// A recommended feed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advice {
    /// Share of the steady feed.
    pub share: f64,
    /// Source of the number.
    pub source: &'static str,
    /// Makers advise against the situation altogether.
    pub discouraged: bool,
}

/// Source named for a number of our own.
pub const OUR_DEFAULT: &str = "our default";
const METALTECNIA: &str = "Metaltecnia, indexable drills";
const COROMANT: &str = "Sandvik Coromant, cross holes";
/// Source named for a number that the user wrote.
pub const GIVEN: &str = "given";

/// Slope up to which a face counts as square to an indexable drill: the tangent of 2 degrees.
const INDEXABLE_SLOPE: f64 = 0.034_920_769_491_747_73;

/// The share of the steady feed for a surface; `crossed` when a bore is entered or left.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::drilling::{Side, BoundarySurface, advice};
/// use kinecut::tool::DrillPoint;
/// let shaft = BoundarySurface::Valley { radius: 40.0, offset: 0.0, height: 0.0 };
/// let twist = DrillPoint::SinglePlane { angle: 2.0 };
/// assert_eq!(advice(&twist, Side::Exit, &shaft, false).share, 0.25);
/// ```
pub fn advice(point: &DrillPoint, side: Side, surface: &BoundarySurface, crossed: bool) -> Advice {
    let ours = |share: f64| Advice { share, source: OUR_DEFAULT, discouraged: false };
    if crossed {
        return Advice { share: 0.25, source: COROMANT, discouraged: false };
    }
    let indexable = matches!(point, DrillPoint::Flat);
    match (side, surface) {
        (Side::Entry, BoundarySurface::Valley { .. }) if indexable => {
            Advice { share: 1.0 / 3.0, source: METALTECNIA, discouraged: true }
        }
        (Side::Entry, BoundarySurface::Plane { slope, .. }) if indexable && slope.abs() > INDEXABLE_SLOPE => {
            Advice { share: 1.0 / 3.0, source: METALTECNIA, discouraged: false }
        }
        (Side::Entry, BoundarySurface::Plane { slope: 0.0, .. }) => ours(0.75),
        (Side::Exit, BoundarySurface::Plane { slope: 0.0, .. }) => ours(0.5),
        (Side::Entry, _) => ours(1.0 / 3.0),
        (Side::Exit, _) => ours(0.25),
    }
}

/// Largest share of the size that a hole may have which an indexable drill opens out: above it the drill is not guided.
pub(super) const INDEXABLE_PRE_HOLE: f64 = 0.25;
