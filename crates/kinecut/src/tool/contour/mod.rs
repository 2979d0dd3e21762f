//! Contours: the half-section of a tool of revolution, of lines and arcs, from the bottom of its axis to the top.
//!
//! Unlike [`crate::geom::Profile`] a contour may fall back in radius, be hollow, and have concave arcs: lollipops, dovetails,
//! barrels, dished cutters, a tool with its shank and holder.

mod element;

pub(crate) use element::turn;
pub use element::{ContourElement, ContourShape, DOWN, Role, UP};

use crate::base::{Code, Finding, Result};

/// A checked contour.
///
/// ```
/// use kinecut::tool::{Contour, ContourElement, Role};
/// let flat = Contour::new(vec![
///     ContourElement::line([0.0, 0.0], [5.0, 0.0], Role::Cutting),
///     ContourElement::line([5.0, 0.0], [5.0, 30.0], Role::Cutting),
///     ContourElement::line([5.0, 30.0], [0.0, 30.0], Role::Shank),
/// ])
/// .unwrap();
/// assert_eq!(flat.height(), 30.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    elements: Vec<ContourElement>,
}

/// How far ends of elements may lie apart, by the size of the contour: rounding of what tangents and sines give.
const GAP: f64 = 1e-9;

impl Contour {
    /// A checked contour, from the bottom of the axis to its top.
    ///
    /// # Errors
    /// `KC0704` when it is empty, a number is not finite, it does not begin and end on the axis, has a gap, leaves to the other
    /// side of the axis, or an element has no length.
    pub fn new(elements: Vec<ContourElement>) -> Result<Contour> {
        let fail = |at: usize, what: &str, value: f64, bound: f64| -> Result<Contour> {
            Err(Finding::error(Code::CONTOUR, what)
                .key(format!("element[{at}]"))
                .value_mm(value)
                .bound_mm(bound)
                .into())
        };
        let size = elements.iter().map(|e| e.shape.end().length()).fold(0.0, f64::max);
        if !(size > 0.0 && size.is_finite()) {
            return fail(0, "a contour has no size", size, 0.0);
        }
        let mut at = glam::DVec2::new(0.0, elements[0].shape.start().y);
        for (i, element) in elements.iter().enumerate() {
            let (start, end) = (element.shape.start(), element.shape.end());
            if !(start.is_finite() && end.is_finite() && element.shape.length() > 0.0) {
                return fail(i, "an element has no length", element.shape.length(), 0.0);
            }
            if (start - at).length() > GAP * size {
                return fail(i, "a contour has a gap", (start - at).length(), GAP * size);
            }
            at = end;
        }
        if at.x.abs() > GAP * size {
            return fail(elements.len() - 1, "a contour does not end on the axis", at.x, GAP * size);
        }
        Ok(Contour { elements })
    }

    /// The elements, from the bottom up.
    pub fn elements(&self) -> &[ContourElement] {
        &self.elements
    }

    /// Height of the end on the axis above the origin [mm].
    pub fn height(&self) -> f64 {
        self.elements.last().map_or(0.0, |e| e.shape.end().y)
    }
}
