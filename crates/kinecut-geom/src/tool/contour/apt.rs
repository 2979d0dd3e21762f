//! The seven parameters of APT and CLDATA: `CUTTER / d, r, e, f, alpha, beta, h`.
//!
//! A cone from the axis, a corner of the radius r about (e, f), a cone up to the height h, each tangent to the next. With
//! the corner's centre c the lower cone ends at c + r (sin alpha, -cos alpha), the upper one begins at
//! c + r (cos beta, -sin beta). The diameter d follows from the others: it is taken where the two cones would meet.
//!
//! Legal are: r = 0 (an edge at (e, f)), no lower cone (the corner begins on the axis, or passes it), no upper cone (h
//! lies on the corner, which ends there), negative alpha (a hollow end) and negative beta (the body falls in upwards).

use std::f64::consts::FRAC_PI_2;

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::pen::Pen;
use super::{Contour, DOWN};
use crate::base::unit::Deg;
use crate::base::{Code, Finding, Result};
use crate::tool::dimension::{not_negative, refuse};

/// Radius below which the end of the lower cone lies on the axis, by the size of the corner: rounding.
const ON_AXIS: f64 = 1e-12;
/// Largest difference between the diameter and the one that the other parameters make [mm]: the third decimal, as CLDATA is printed.
const PRINTED: f64 = 1e-3;

/// CUTTER / d, r, e, f, alpha, beta, h of APT [mm, rad]; in a file angles are degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Apt {
    /// d: diameter where lower and upper cone would meet. Needed without `centre_radius`; with it, it is compared.
    #[serde(default)]
    pub diameter: Option<f64>,
    /// r: radius of the corner; default 0: an edge.
    #[serde(default)]
    pub corner_radius: f64,
    /// e: distance of the corner's centre from the axis, negative beyond it; default: half of d, less r.
    #[serde(default)]
    pub centre_radius: Option<f64>,
    /// f: height of the corner's centre; default: r.
    #[serde(default)]
    pub centre_height: Option<f64>,
    /// alpha: angle between a plane across the axis and the lower cone, negative for a hollow end; degrees in a file; default 0.
    #[serde(default, with = "Deg")]
    pub lower_angle: f64,
    /// beta: angle between the axis and the upper cone, negative when it narrows upwards; degrees in a file; default 0.
    #[serde(default, with = "Deg")]
    pub upper_angle: f64,
    /// h: height of the tool above the origin.
    #[schemars(example = 30)]
    pub height: f64,
}

impl Apt {
    /// The short forms `CUTTER / d` and `CUTTER / d, r`: a corner in a cylinder.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::{Apt, ToolForm};
    /// let bull = ToolForm::BullNose { diameter: 10.0, corner_radius: 2.0, flute_length: 30.0 };
    /// assert_eq!(Apt::cylinder(10.0, 2.0, 30.0).contour().unwrap(), bull.contour().unwrap());
    /// ```
    pub fn cylinder(diameter: f64, corner_radius: f64, height: f64) -> Apt {
        Apt { diameter: Some(diameter), corner_radius, height, ..Apt::default() }
    }

    /// d as the other parameters make it: twice the radius at which lower and upper cone would meet [mm]; not finite when
    /// they are one.
    pub fn cone_diameter(&self) -> f64 {
        let (lower, upper) = self.tangent_points();
        let (a, b) = (self.lower_angle.tan(), self.upper_angle.tan());
        2.0 * (upper.x + (lower.y - upper.y - lower.x * a) * b) / (1.0 - a * b)
    }

    /// Its contour; the tip lies where the lower cone meets the axis, which need not be height 0.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::Apt;
    /// let (alpha, beta) = (10f64.to_radians(), 5f64.to_radians());
    /// let apt = Apt {
    ///     corner_radius: 2.0,
    ///     centre_radius: Some(4.0),
    ///     centre_height: Some(3.0),
    ///     lower_angle: alpha,
    ///     upper_angle: beta,
    ///     height: 28.0,
    ///     ..Apt::default()
    /// };
    /// assert!((apt.contour().unwrap().bottom() - 0.2638388533946502).abs() < 1e-12); // its tip is not its origin
    /// assert!((apt.cone_diameter() - 11.71727).abs() < 1e-5);
    /// ```
    ///
    /// # Errors
    /// `KC0701` with the name of the parameter that contradicts the others.
    pub fn contour(&self) -> Result<Contour> {
        self.check()?;
        let (r, [e, f]) = (self.corner_radius, self.centre());
        let (lower, upper) = self.tangent_points();
        let small = ON_AXIS * (r + e.abs());
        let (mut from, mut to) = (DOWN + self.lower_angle, -self.upper_angle);
        let mut pen = if lower.x > small {
            let tip = lower.y - lower.x * self.lower_angle.tan();
            Pen::at(tip).to(lower.x, lower.y)
        } else if lower.x >= -small {
            Pen::at(lower.y)
        } else {
            // The corner itself meets the axis.
            if e < -r || upper.x < 0.0 {
                return Err(refuse("centre_radius", "the corner lies beyond the axis", e, -r));
            }
            from = -(-e / r).clamp(-1.0, 1.0).acos();
            Pen::at(f + r * from.sin())
        };
        if self.height <= lower.y || self.height <= f + r * from.sin() {
            let corner = if lower.y > f + r * from.sin() { lower.y } else { f + r * from.sin() };
            return Err(refuse("height", "the tool must reach above the lower cone", self.height, corner));
        }
        if self.height < upper.y {
            to = ((self.height - f) / r).clamp(-1.0, 1.0).asin();
            return pen.round([e, f], r, from, to).cap(self.height);
        }
        pen = pen.round([e, f], r, from, to);
        let top = upper.x + (self.height - upper.y) * self.upper_angle.tan();
        if !(top > 0.0) {
            let highest = upper.y - upper.x / self.upper_angle.tan();
            return Err(refuse("height", "the upper cone meets the axis below", self.height, highest));
        }
        pen.to(top, self.height).cap(self.height)
    }

    /// Radius and height of the corner's centre: e and f.
    fn centre(&self) -> [f64; 2] {
        let of_diameter = || self.diameter.map_or(f64::NAN, |d| 0.5 * d - self.corner_radius);
        [self.centre_radius.unwrap_or_else(of_diameter), self.centre_height.unwrap_or(self.corner_radius)]
    }

    /// Points of contact of the corner with the lower and the upper cone: radius, height [mm].
    fn tangent_points(&self) -> (DVec2, DVec2) {
        let centre = DVec2::from(self.centre());
        let ((sin_a, cos_a), (sin_b, cos_b)) = (self.lower_angle.sin_cos(), self.upper_angle.sin_cos());
        let r = self.corner_radius;
        (centre + r * DVec2::new(sin_a, -cos_a), centre + r * DVec2::new(cos_b, -sin_b))
    }

    /// The diameter is there where it is needed, and what the other parameters make it.
    fn check_diameter(&self) -> Result<()> {
        let refuse = |code, what: &str| Finding::error(code, what).key("diameter");
        match (self.centre_radius, self.diameter) {
            (None, None) => {
                Err(refuse(Code::JOB_SHAPE, "a tool by APT needs its diameter, or the place of its corner")
                    .into())
            }
            (Some(_), Some(given))
                if self.lower_angle + self.upper_angle < FRAC_PI_2 - PRINTED
                    && !((given - self.cone_diameter()).abs() <= PRINTED) =>
            {
                Err(refuse(Code::TOOL_VALUE, "the diameter is not what the other parameters make it")
                    .value_mm(given)
                    .bound_mm(self.cone_diameter())
                    .help("leave it out: it follows from r, e, f, alpha and beta")
                    .into())
            }
            _ => Ok(()),
        }
    }

    fn check(&self) -> Result<()> {
        self.check_diameter()?;
        not_negative("corner_radius", self.corner_radius)?;
        let [e, f] = self.centre();
        for (key, value) in [("centre_radius", e), ("centre_height", f), ("height", self.height)] {
            if !value.is_finite() {
                return Err(refuse(key, "a parameter of the tool is not finite", value, 0.0));
            }
        }
        let angle = |key: &str, what: &str, value: f64, bound: f64| {
            Err(Finding::error(Code::TOOL_VALUE, what)
                .value(value.to_degrees(), "deg")
                .bound(bound.to_degrees(), "deg")
                .key(key)
                .into())
        };
        for (key, value) in [("lower_angle", self.lower_angle), ("upper_angle", self.upper_angle)] {
            if !(value > -FRAC_PI_2 && value < FRAC_PI_2) {
                return angle(
                    key,
                    "an angle must lie between -90 and 90 degrees",
                    value,
                    FRAC_PI_2.copysign(value),
                );
            }
        }
        if self.lower_angle + self.upper_angle > FRAC_PI_2 + ON_AXIS {
            let what = "the cones make a hollow corner: their angles must be at most 90 degrees in sum";
            return angle("upper_angle", what, self.upper_angle, FRAC_PI_2 - self.lower_angle);
        }
        Ok(())
    }
}
