//! Shapes of cutters.

use std::f64::consts::FRAC_PI_2;

use crate::base::{Code, Finding, Result};
use crate::geom::{Profile, ProfileElement};

use super::{DrillPoint, Tap, ThreadMill, filled};

/// Shape of the cutting part [mm, rad].
#[derive(Clone, Debug, PartialEq)]
pub enum Cutter {
    /// Flat end mill.
    EndMill {
        /// Diameter.
        diameter: f64,
    },
    /// Ball-nose end mill.
    BallNose {
        /// Diameter.
        diameter: f64,
    },
    /// End mill with a corner radius.
    BullNose {
        /// Diameter.
        diameter: f64,
        /// Corner radius, below half the diameter.
        corner_radius: f64,
    },
    /// Conical cutter with a flat tip; the diameter grows up to the top of the flutes.
    Tapered {
        /// Diameter of the flat tip; may be 0.
        tip_diameter: f64,
        /// Angle between axis and edge.
        half_angle: f64,
    },
    /// Drill, countersink, reamer: a tool that works along its axis.
    Drill {
        /// Largest diameter.
        diameter: f64,
        /// Its point.
        point: DrillPoint,
    },
    /// Tap. The thread is no part of its shape: that is a cylinder of the minor diameter, which fills the core hole.
    Tap(Tap),
    /// Thread mill. As a body it is the cylinder of its crests.
    ThreadMill(ThreadMill),
}

impl Cutter {
    /// Whether it works along its axis only: a drill or a tap.
    pub fn is_axial(&self) -> bool {
        matches!(self, Cutter::Drill { .. } | Cutter::Tap(_))
    }

    /// Whether it may mill walls of any form: neither a tool that works along its axis nor a thread mill.
    pub fn mills_walls(&self) -> bool {
        !self.is_axial() && !matches!(self, Cutter::ThreadMill(_))
    }

    /// Largest diameter [mm] of flutes of a given length.
    pub fn diameter(&self, flute_length: f64) -> f64 {
        match *self {
            Cutter::EndMill { diameter }
            | Cutter::BallNose { diameter }
            | Cutter::BullNose { diameter, .. }
            | Cutter::Drill { diameter, .. }
            | Cutter::Tap(Tap { diameter, .. })
            | Cutter::ThreadMill(ThreadMill { diameter, .. }) => diameter,
            Cutter::Tapered { tip_diameter, half_angle } => {
                tip_diameter + 2.0 * flute_length * half_angle.tan()
            }
        }
    }

    /// The point with which it works along its axis; of a mill a flat one.
    pub fn point(&self) -> &DrillPoint {
        match self {
            Cutter::Drill { point, .. } => point,
            _ => &DrillPoint::Flat,
        }
    }

    /// Height up to which the end shape reaches [mm]: 0 for a flat one.
    pub fn tip_height(&self) -> f64 {
        match *self {
            Cutter::EndMill { .. } | Cutter::Tapered { .. } | Cutter::Tap(_) | Cutter::ThreadMill(_) => 0.0,
            Cutter::BallNose { diameter } => diameter / 2.0,
            Cutter::BullNose { corner_radius, .. } => corner_radius,
            // An invalid point is reported by `check`.
            Cutter::Drill { diameter, ref point } => point.edge(diameter).map_or(0.0, |e| e.extent()[1]),
        }
    }

    /// Radius of the flat ring that the lowest points of the edges mill [mm], that is of the wall of a milled face at
    /// the finished plane; `None` for a tool that mills no flat.
    pub fn flat_radius(&self) -> Option<f64> {
        let radius = match *self {
            Cutter::EndMill { diameter } => diameter / 2.0,
            Cutter::BullNose { diameter, corner_radius } => diameter / 2.0 - corner_radius,
            Cutter::Tapered { tip_diameter, .. } => tip_diameter / 2.0,
            Cutter::BallNose { .. } | Cutter::Drill { .. } | Cutter::Tap(_) | Cutter::ThreadMill(_) => 0.0,
        };
        (radius > 0.0).then_some(radius)
    }

    /// Checks that the numbers make a cutter.
    ///
    /// # Errors
    /// `KC0701` with the key of the wrong one.
    pub fn check(&self) -> Result<()> {
        let fail = |key: &str, what: &str, value: f64, bound: f64, unit: &str| {
            Err(Finding::error(Code::TOOL_VALUE, what).value(value, unit).bound(bound, unit).key(key).into())
        };
        match *self {
            Cutter::EndMill { diameter }
            | Cutter::BallNose { diameter }
            | Cutter::BullNose { diameter, .. }
            | Cutter::Drill { diameter, .. }
                if !(diameter.is_finite() && diameter > 0.0) =>
            {
                fail("diameter", "the diameter must be positive", diameter, 0.0, "mm")
            }
            Cutter::BullNose { diameter, corner_radius }
                if !(corner_radius >= 0.0 && corner_radius <= diameter / 2.0) =>
            {
                fail(
                    "corner_radius",
                    "the corner radius must be at most half the diameter",
                    corner_radius,
                    diameter / 2.0,
                    "mm",
                )
            }
            Cutter::Tapered { tip_diameter, .. } if !(tip_diameter.is_finite() && tip_diameter >= 0.0) => {
                fail("tip_diameter", "the tip diameter must not be negative", tip_diameter, 0.0, "mm")
            }
            Cutter::Tapered { half_angle, .. } if !(half_angle > 0.0 && half_angle < FRAC_PI_2) => fail(
                "half_angle",
                "the half angle must lie between 0 and 90 degrees",
                half_angle.to_degrees(),
                90.0,
                "deg",
            ),
            Cutter::Drill { diameter, ref point } => point.edge(diameter).map(drop),
            Cutter::Tap(tap) => tap.check(),
            Cutter::ThreadMill(mill) => mill.check(),
            _ => Ok(()),
        }
    }

    /// The profile up to the height `flute_length` [mm]; of a drill with its hollows filled, see [`filled`].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::{Cutter, DrillPoint};
    /// let point = DrillPoint::SinglePlane { angle: 118f64.to_radians() };
    /// let drill = Cutter::Drill { diameter: 10.0, point };
    /// assert!((drill.tip_height() - 3.004303095).abs() < 1e-8);
    /// assert!((drill.profile(60.0).unwrap().radius(1.5021515475) - 2.5).abs() < 1e-9);
    /// ```
    ///
    /// # Errors
    /// `KC0701`, `KC0801` when the numbers make no body.
    pub fn profile(&self, flute_length: f64) -> Result<Profile> {
        self.check()?;
        match *self {
            Cutter::EndMill { diameter } => Profile::cylinder(diameter, flute_length),
            Cutter::BallNose { diameter } => Profile::bull_nose(diameter, diameter / 2.0, flute_length),
            Cutter::BullNose { diameter, corner_radius } => {
                Profile::bull_nose(diameter, corner_radius, flute_length)
            }
            Cutter::Tapered { tip_diameter, .. } => Profile::new(vec![ProfileElement::Cone {
                z0: 0.0,
                r0: tip_diameter / 2.0,
                z1: flute_length,
                r1: self.diameter(flute_length) / 2.0,
            }]),
            Cutter::Drill { diameter, ref point } => filled(&point.edge(diameter)?, flute_length),
            Cutter::Tap(tap) => Profile::cylinder(tap.minor_diameter(), flute_length),
            Cutter::ThreadMill(mill) => Profile::cylinder(mill.diameter, flute_length),
        }
    }
}
