//! Contours: the half-section of a tool of revolution, of lines and arcs, from the bottom of its axis to the top.
//!
//! Unlike [`crate::geom::Profile`] a contour may fall back in radius, be hollow, and have concave arcs: lollipops, dovetails,
//! barrels, dished cutters, a tool with its shank and holder.

mod apt;
mod assembly;
mod barrel;
mod check;
mod cut;
mod drawing;
mod element;
mod end;
mod file;
mod form;
mod formed;
mod measure;
mod pen;
mod pointed;
mod stack;

pub use apt::Apt;
pub use assembly::Assembly;
pub use drawing::{ContourRead, SectionDrawing};
pub use element::turn;
pub use element::{ContourElement, ContourShape, DOWN, ElementRole, UP};
pub use file::{ContourFile, ElementEntry};
pub use form::ToolForm;

use glam::DVec2;

use crate::base::{Code, Finding, Result};

/// A checked contour.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::tool::{Contour, ContourElement, ElementRole};
/// let flat = Contour::new(vec![
///     ContourElement::line([0.0, 0.0], [5.0, 0.0], ElementRole::Cutting),
///     ContourElement::line([5.0, 0.0], [5.0, 30.0], ElementRole::Cutting),
///     ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
/// ])
/// .unwrap();
/// assert_eq!(flat.height(), 30.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    elements: Vec<ContourElement>,
}

impl Contour {
    /// A checked contour, from the bottom of the axis to its top. Arcs of more than a half turn are kept as two, normal
    /// angles so that each arc begins within (-pi, pi].
    ///
    /// # Errors
    /// `KC0704` with the number of the element and its place when there are no elements, a number is not finite, an
    /// element has no length, an arc no positive radius, a whole turn or a normal that turns against its convexity,
    /// when the way does not begin or end on the axis, has a gap, lies on the axis or passes it, crosses, touches or
    /// retraces itself, has a cusp or the material on its right.
    pub fn new(elements: Vec<ContourElement>) -> Result<Contour> {
        Ok(Contour { elements: check::checked(elements)? })
    }

    /// The elements, from the bottom up.
    pub fn elements(&self) -> &[ContourElement] {
        &self.elements
    }

    /// Height of the begin on the axis [mm]: not the lowest of a hollow end.
    pub fn bottom(&self) -> f64 {
        self.elements.first().map_or(0.0, |e| e.shape.start().y)
    }

    /// Height of the end on the axis above the origin [mm].
    pub fn height(&self) -> f64 {
        self.elements.last().map_or(0.0, |e| e.shape.end().y)
    }

    /// The contour moved along the axis [mm]: a tool whose origin is not its tip.
    ///
    /// # Errors
    /// `KC0704` when the height is not finite, and, as from [`Contour::new`], when it is so great that its rounding swallows an
    /// element.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::{Contour, ContourElement, ElementRole};
    /// let ball = ContourElement::arc([0.0, 5.0], 5.0, kinecut::tool::DOWN, kinecut::tool::UP, ElementRole::Cutting);
    /// let ball = Contour::new(vec![ball]).unwrap();
    /// assert!((ball.raised(-5.0).unwrap().bottom() + 5.0).abs() < 1e-15); // programmed at its centre
    /// ```
    pub fn raised(&self, by: f64) -> Result<Contour> {
        if !by.is_finite() {
            return Err(Finding::error(
                Code::CONTOUR,
                "the height by which a contour is raised is not finite",
            )
            .value_mm(by)
            .help("give the height of its origin above Z 0 in mm")
            .into());
        }
        let up = DVec2::new(0.0, by);
        let mut elements = self.elements.clone();
        for element in &mut elements {
            match &mut element.shape {
                ContourShape::Line { start, end } => {
                    *start += up;
                    *end += up;
                }
                ContourShape::Arc { centre, .. } => *centre += up,
            }
        }
        Contour::new(elements)
    }
}
