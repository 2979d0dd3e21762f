//! A plane square to an axis.

use glam::DVec3;
use serde::Serialize;

use crate::base::{Code, Finding, Result};
use crate::stock::Axis;

/// A plane square to an axis of the part.
///
/// ```
/// use kinecut::job::SectionPlane;
/// use kinecut::stock::Axis;
/// let plane: SectionPlane = "x=12.5".parse().unwrap();
/// assert_eq!((plane.axis, plane.at, plane.to_string().as_str()), (Axis::X, 12.5, "X 12.5"));
/// assert!("a=1".parse::<SectionPlane>().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SectionPlane {
    /// The axis.
    pub axis: Axis,
    /// Coordinate along it [mm].
    pub at: f64,
}

impl SectionPlane {
    /// The direction of the axis.
    pub(super) fn normal(self) -> DVec3 {
        DVec3::AXES[self.axis.index()]
    }

    /// Numbers of the axes to the right and upwards in its picture: Z upwards, or Y in a plane square to Z.
    pub(super) fn seen(self) -> [usize; 2] {
        match self.axis {
            Axis::X => [1, 2],
            Axis::Y => [0, 2],
            Axis::Z => [0, 1],
        }
    }
}

impl std::str::FromStr for SectionPlane {
    type Err = crate::base::Error;

    /// Reads `x=12.5`.
    fn from_str(text: &str) -> Result<SectionPlane> {
        let wrong = || {
            Finding::error(Code::JOB_VALUE, format!("`{text}` is no plane of a section"))
                .help("write an axis and its coordinate in mm, such as z=-5")
        };
        let (axis, at) = text.split_once('=').ok_or_else(wrong)?;
        let at = at.trim().parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(wrong)?;
        let axis = match axis.trim() {
            "x" | "X" => Axis::X,
            "y" | "Y" => Axis::Y,
            "z" | "Z" => Axis::Z,
            _ => return Err(wrong().into()),
        };
        // Without the sign of a zero, which would be another name.
        Ok(SectionPlane { axis, at: at + 0.0 })
    }
}

impl std::fmt::Display for SectionPlane {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?} {}", self.axis, self.at)
    }
}
