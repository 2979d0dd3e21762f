//! Contours as files: where the way begins on the axis, and where each element leads.

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::check::GAP;
use super::{Contour, ContourElement, ContourShape, ElementRole};
use crate::base::{Code, Error, Finding, Result};
use crate::num::angle::{sweep, wrap};

/// A contour as a file gives it: from the bottom of the axis outwards and upwards to its top; radius and height in mm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContourFile {
    /// Height at which it begins on the axis; default 0.
    #[serde(default)]
    pub bottom: f64,
    /// The elements in order; the last ends on the axis.
    pub elements: Vec<ElementEntry>,
}

/// An element of a contour: a line, or with `centre` or `radius` an arc.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ElementEntry {
    /// Radius and height at which it ends.
    #[schemars(example = vec![5, 20])]
    pub to: [f64; 2],
    /// Radius and height of an arc's centre.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centre: Option<[f64; 2]>,
    /// Radius of an arc of at most a half turn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// True if the material lies on the side of the arc's centre; default true.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub convex: Option<bool>,
    /// Role of the element; default cutting.
    #[serde(default)]
    pub role: ElementRole,
    /// Number of its body in a stacked tool, counted from the tip; default 0.
    #[serde(default)]
    pub body: u16,
}

impl From<&Contour> for ContourFile {
    fn from(contour: &Contour) -> ContourFile {
        let entry = |e: &ContourElement| {
            let entry = ElementEntry {
                to: e.shape.end().to_array(),
                role: e.role,
                body: e.body,
                ..ElementEntry::default()
            };
            match e.shape {
                ContourShape::Line { .. } => entry,
                ContourShape::Arc { centre, convex, .. } => {
                    ElementEntry { centre: Some(centre.to_array()), convex: Some(convex), ..entry }
                }
            }
        };
        ContourFile { bottom: contour.bottom(), elements: contour.elements().iter().map(entry).collect() }
    }
}

impl ContourFile {
    /// The contour.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::ContourFile;
    /// let text = r#"{ "elements": [
    ///     { "to": [5, 5], "centre": [0, 5] },
    ///     { "to": [5, 30] },
    ///     { "to": [0, 30], "role": "shank" }
    /// ] }"#;
    /// let file: ContourFile = serde_json::from_str(text).unwrap();
    /// let ball = file.contour().unwrap();
    /// assert_eq!(ball.radii_at(1.0), [[0.0, 3.0]]);
    /// assert_eq!(ContourFile::from(&ball).contour().unwrap(), ball);
    /// ```
    ///
    /// # Errors
    /// `KC0704` with the number of the element whose centre is not as far from both its ends, whose radius is too short for
    /// them or that has both; else as [`Contour::new`].
    pub fn contour(&self) -> Result<Contour> {
        let mut at = DVec2::new(0.0, self.bottom);
        let mut elements = Vec::with_capacity(self.elements.len());
        for (i, entry) in self.elements.iter().enumerate() {
            let end = DVec2::from(entry.to);
            let shape = entry.shape(at, end).map_err(|f| Error::from(f.key(format!("elements[{i}]"))))?;
            elements.push(ContourElement { shape, role: entry.role, body: entry.body });
            at = end;
        }
        Contour::new(elements)
    }
}

impl ElementEntry {
    fn shape(&self, start: DVec2, end: DVec2) -> std::result::Result<ContourShape, Finding> {
        let convex = self.convex.unwrap_or(true);
        let refuse = |what: &str| Finding::error(Code::CONTOUR, what);
        let (centre, radius) = match (self.centre, self.radius) {
            (None, None) if self.convex.is_some() => {
                return Err(
                    refuse("an arc needs its centre or its radius").help("leave out `convex` for a line")
                );
            }
            (None, None) => return Ok(ContourShape::Line { start, end }),
            (Some(_), Some(_)) => {
                return Err(
                    refuse("an arc is given by its centre or its radius").help("leave one of them out")
                );
            }
            (Some(centre), None) => {
                let centre = DVec2::from(centre);
                let [a, b] = [start.distance(centre), end.distance(centre)];
                if !((a - b).abs() <= GAP * (a + centre.length())) {
                    return Err(refuse("the ends of an arc are not as far from its centre")
                        .value_mm(b)
                        .bound_mm(a)
                        .help("give more digits, or the radius instead of the centre"));
                }
                (centre, a)
            }
            (None, Some(radius)) => {
                let half = 0.5 * start.distance(end);
                // A half circle is as wide as its ends lie apart, but for rounding.
                if !(radius >= half * (1.0 - GAP)) {
                    return Err(refuse("the radius of an arc is too short for its ends")
                        .value_mm(radius)
                        .bound_mm(half));
                }
                let aside = ((radius - half) * (radius + half)).max(0.0).sqrt();
                let left = (end - start).perp() / (2.0 * half);
                let centre = 0.5 * (start + end) + left * if convex { aside } else { -aside };
                (centre, if radius > half { radius } else { half })
            }
        };
        let out = |p: DVec2| if convex { p - centre } else { centre - p };
        let angle = |p: DVec2| wrap(out(p).to_angle());
        let (from, to) = (angle(start), angle(end));
        let end = from + sweep(from, to, convex);
        Ok(ContourShape::Arc { centre, radius, convex, from, to: end })
    }
}
