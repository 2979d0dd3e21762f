//! Points of drills and of the other tools that work along their axis, as cutting edges.
//!
//! Source: Belyakov and Seleznev 2023, figure 3 and table 1, corrected: rows 5 and 6 take the cotangent, the inner edge
//! of a gun drill counts, the edge of a cannon drill that passes the axis leaves a step.
//!
//! Angles are full ones between edges as catalogues give them (`angle` = 2 phi), except where an edge angle is said to
//! be counted from the axis [rad]. Heights are counted from the lowest cutting point, which may lie off the axis.

use std::borrow::Cow;
use std::f64::consts::{FRAC_PI_2, PI};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::unit::{Deg, degrees, variant_key};
use crate::base::{Code, Error, Finding, Result};
use crate::geom::{EdgeProfile, EdgeSegment};
use crate::tool::dimension::{not_negative, positive, refuse, refuse_in};

/// Most stages of a stepped tool before its largest diameter.
const MOST_STAGES: usize = 4;

/// Length of the second edge of a double-ground and of a cast-iron point, as a share of the diameter (Belyakov and
/// Seleznev 2023, table 1).
const SECOND_EDGE: f64 = 0.2;
/// Length of the third edge of a cast-iron point, as a share of the diameter.
const THIRD_EDGE: f64 = 0.15;

/// The point of a tool that works along its axis [mm, rad]; in a file angles are degrees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum DrillPoint {
    /// Twist drill, ground in one plane.
    #[serde(rename = "twist")]
    SinglePlane {
        /// Point angle; default 118 degrees.
        #[serde(rename = "point_angle", default = "degrees::<118>", with = "Deg")]
        angle: f64,
    },
    /// Twist drill, ground in two planes; the second edges are 0.2 diameters long.
    DoubleGround {
        /// Point angle; default 118 degrees.
        #[serde(rename = "point_angle", default = "degrees::<118>", with = "Deg")]
        angle: f64,
        /// Angle of the second edges; default 70 degrees.
        #[serde(rename = "second_angle", default = "degrees::<70>", with = "Deg")]
        second: f64,
    },
    /// Twist drill for cast iron (Zhirov), ground in three planes; the outer edges are 0.2 and 0.15 diameters long.
    CastIron {
        /// Point angle; default 118 degrees.
        #[serde(rename = "point_angle", default = "degrees::<118>", with = "Deg")]
        angle: f64,
        /// Angle of the second edges; default 70 degrees.
        #[serde(rename = "second_angle", default = "degrees::<70>", with = "Deg")]
        second: f64,
        /// Angle of the third edges; default 55 degrees.
        #[serde(rename = "third_angle", default = "degrees::<55>", with = "Deg")]
        third: f64,
        /// Half the width of the slot across the chisel edge; default 0: none.
        #[serde(default)]
        slot: f64,
    },
    /// Twist drill with rounded lips: an arc about a point of the axis.
    #[serde(rename = "rounded-lips")]
    Rounded {
        /// Radius of the lips about a point of the axis; at least that of the drill.
        #[serde(rename = "lip_radius")]
        #[schemars(example = 10)]
        radius: f64,
    },
    /// Twist drill with a radius between lip and margin.
    CornerRadius {
        /// Point angle; default 118 degrees.
        #[serde(rename = "point_angle", default = "degrees::<118>", with = "Deg")]
        angle: f64,
        /// Radius between lip and margin.
        #[serde(rename = "corner_radius")]
        #[schemars(example = 1)]
        radius: f64,
    },
    /// Twist drill with its web ground flat.
    ThinnedWeb {
        /// Point angle; default 118 degrees.
        #[serde(rename = "point_angle", default = "degrees::<118>", with = "Deg")]
        angle: f64,
        /// Half the width of the flat.
        #[schemars(example = 0.5)]
        flat: f64,
    },
    /// Twist drill with a slot across its chisel edge, where nothing cuts.
    SlottedChisel {
        /// Point angle; default 118 degrees.
        #[serde(rename = "point_angle", default = "degrees::<118>", with = "Deg")]
        angle: f64,
        /// Half the width of the slot.
        #[schemars(example = 0.5)]
        slot: f64,
    },
    /// Annular drill: a core stays.
    Annular {
        /// Diameter of the core.
        #[serde(rename = "core_diameter")]
        #[schemars(example = 16)]
        core: f64,
    },
    /// Flat: indexable insert drill, flat-bottom drill, counterbore.
    Flat,
    /// Cannon drill: one lip that passes the axis.
    Cannon {
        /// Distance by which the lip passes the axis.
        #[schemars(example = 0.5)]
        overlap: f64,
        /// Angle of the lip, counted from the axis; degrees in a file.
        #[serde(with = "Deg")]
        #[schemars(example = 70)]
        edge_angle: f64,
    },
    /// Gun drill: its apex lies off the axis.
    Gun {
        /// Distance of the apex from the axis; default: a quarter of the diameter.
        #[serde(default)]
        apex: Option<f64>,
        /// Angle of the outer edge, counted from the axis; default 60 degrees.
        #[serde(default = "degrees::<60>", with = "Deg")]
        outer_angle: f64,
        /// Angle of the inner edge, counted from the axis; default 70 degrees.
        #[serde(default = "degrees::<70>", with = "Deg")]
        inner_angle: f64,
    },
    /// Auger drill.
    Auger {
        /// Point angle; default 118 degrees.
        #[serde(rename = "point_angle", default = "degrees::<118>", with = "Deg")]
        angle: f64,
    },
    /// Ejector drill.
    Ejector {
        /// Point angle; default 118 degrees.
        #[serde(rename = "point_angle", default = "degrees::<118>", with = "Deg")]
        angle: f64,
    },
    /// Countersink, core drill, reamer: a cone on a nose that does not cut.
    Cone {
        /// Full angle of the cone; degrees in a file.
        #[serde(rename = "cone_angle", with = "Deg")]
        #[schemars(example = 90)]
        angle: f64,
        /// Diameter of the nose; default 0: sharp.
        #[serde(rename = "nose_diameter", default)]
        nose: f64,
    },
    /// Centre drill: a pilot, then a cone.
    Centre {
        /// Diameter of the pilot.
        #[schemars(example = 3.15)]
        pilot_diameter: f64,
        /// Height above the tip at which the cone begins.
        #[schemars(example = 4)]
        pilot_length: f64,
        /// Point angle of the pilot; default 120 degrees.
        #[serde(rename = "point_angle", default = "degrees::<120>", with = "Deg")]
        angle: f64,
        /// Full angle of the cone; default 60 degrees.
        #[serde(default = "degrees::<60>", with = "Deg")]
        cone_angle: f64,
    },
    /// Several diameters; the tool's own diameter is the largest.
    Stepped {
        /// Point angle of the tip; default 118 degrees.
        #[serde(rename = "point_angle", default = "degrees::<118>", with = "Deg")]
        angle: f64,
        /// The smaller diameters, from the tip; at most four.
        stages: Vec<StepStage>,
    },
}

/// A stage of a stepped tool [mm, rad].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StepStage {
    /// Diameter.
    #[schemars(example = 6.6)]
    pub diameter: f64,
    /// Height above the tip at which the shoulder to the next diameter begins.
    #[schemars(example = 15)]
    pub length: f64,
    /// Full angle of that shoulder; default 180 degrees: flat.
    #[serde(rename = "shoulder_angle", default = "degrees::<180>", with = "Deg")]
    pub shoulder: f64,
}

impl DrillPoint {
    /// The point of a tool of a diameter by its keys: that of `point`, or a twist drill of `point_angle` [rad], which is
    /// flat at 180 degrees; without both a twist drill of 118 degrees.
    ///
    /// # Errors
    /// `KC0102` when both are given, else as [`DrillPoint::edge`]; keys are counted from the table of the tool.
    pub fn of_keys(
        point: Option<&DrillPoint>,
        point_angle: Option<f64>,
        diameter: f64,
    ) -> Result<DrillPoint> {
        let Some(point) = point else {
            let angle = point_angle.unwrap_or_else(degrees::<118>);
            let point = if angle == PI { DrillPoint::Flat } else { DrillPoint::SinglePlane { angle } };
            return point.edge(diameter).map(|_| point);
        };
        if point_angle.is_some() {
            return Err(Finding::error(Code::JOB_SHAPE, "`point` and `point_angle` exclude each other")
                .help("write the angle into `point`")
                .key("point_angle")
                .into());
        }
        let of_tool = |e: Error| match e.0.key.as_deref() {
            Some("diameter") => e,
            _ => e.under(&format!("point.{}", variant_key(point))),
        };
        point.edge(diameter).map(|_| point.clone()).map_err(of_tool)
    }

    /// Name in the trade.
    pub fn name(&self) -> &'static str {
        match self {
            DrillPoint::SinglePlane { .. } => "twist drill",
            DrillPoint::DoubleGround { .. } => "double-ground twist drill",
            DrillPoint::CastIron { .. } => "twist drill for cast iron",
            DrillPoint::Rounded { .. } => "twist drill with rounded lips",
            DrillPoint::CornerRadius { .. } => "twist drill with rounded corners",
            DrillPoint::ThinnedWeb { .. } => "twist drill with flat web",
            DrillPoint::SlottedChisel { .. } => "twist drill with slotted chisel edge",
            DrillPoint::Annular { .. } => "annular drill",
            DrillPoint::Flat => "flat-bottom drill",
            DrillPoint::Cannon { .. } => "cannon drill",
            DrillPoint::Gun { .. } => "gun drill",
            DrillPoint::Auger { .. } => "auger drill",
            DrillPoint::Ejector { .. } => "ejector drill",
            DrillPoint::Cone { .. } => "cone",
            DrillPoint::Centre { .. } | DrillPoint::Stepped { .. } => "stepped drill",
        }
    }

    /// The edge of a tool of a diameter [mm].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::DrillPoint;
    /// let point = DrillPoint::DoubleGround { angle: 118f64.to_radians(), second: 70f64.to_radians() };
    /// // Figure 7 of Belyakov and Seleznev 2023: 7.907.
    /// assert!((point.edge(20.0).unwrap().extent()[1] - 7.906656).abs() < 1e-6);
    /// ```
    ///
    /// # Errors
    /// `KC0701` with the key of the number that makes no point.
    pub fn edge(&self, diameter: f64) -> Result<EdgeProfile> {
        positive("diameter", diameter)?;
        let radius = diameter / 2.0;
        match *self {
            DrillPoint::SinglePlane { angle }
            | DrillPoint::Auger { angle }
            | DrillPoint::Ejector { angle } => {
                let k = rise("point_angle", angle)?;
                EdgeProfile::polyline(&[[0.0, 0.0], [radius, radius * k]])
            }
            DrillPoint::DoubleGround { angle, second } => {
                let (k, k1) = (rise("point_angle", angle)?, half("second_angle", second)?);
                let b = SECOND_EDGE * diameter;
                let r1 = radius - b * k1.sin();
                at_least("second_angle", "the second edges leave no room for the first", r1, 0.0)?;
                EdgeProfile::polyline(&[[0.0, 0.0], [r1, r1 * k], [radius, r1 * k + b * k1.cos()]])
            }
            DrillPoint::CastIron { angle, second, third, slot } => {
                let k = rise("point_angle", angle)?;
                let (h1, h2) = (half("second_angle", second)?, half("third_angle", third)?);
                not_negative("slot", slot)?;
                let (b1, b2) = (SECOND_EDGE * diameter, THIRD_EDGE * diameter);
                let r2 = radius - b2 * h2.sin();
                let r1 = r2 - b1 * h1.sin();
                at_least("second_angle", "the outer edges leave no room for the first", r1, slot)?;
                let z1 = (r1 - slot) * k;
                let z2 = z1 + b1 * h1.cos();
                EdgeProfile::polyline(&[[slot, 0.0], [r1, z1], [r2, z2], [radius, z2 + b2 * h2.cos()]])
            }
            DrillPoint::Rounded { radius: lips } => {
                not_below("lip_radius", "rounded lips need at least the radius of the drill", lips, radius)?;
                let arc = EdgeSegment::Arc { r: [0.0, radius], centre: [0.0, lips], radius: lips };
                EdgeProfile::new(&[arc])
            }
            DrillPoint::CornerRadius { angle, radius: corner } => {
                let h = half("point_angle", angle)?;
                positive("corner_radius", corner)?;
                not_above("corner_radius", "the corner is wider than the drill", corner, radius)?;
                let k = h.tan().recip();
                let r = radius - corner + corner * h.cos();
                let centre = [radius - corner, r * k + corner * h.sin()];
                EdgeProfile::new(&[
                    EdgeSegment::Line { r: [0.0, r], z: [0.0, r * k] },
                    EdgeSegment::Arc { r: [r, radius], centre, radius: corner },
                ])
            }
            DrillPoint::ThinnedWeb { angle, flat } => {
                let k = rise("point_angle", angle)?;
                positive("flat", flat)?;
                at_least("flat", "the flat is wider than the drill", radius, flat)?;
                EdgeProfile::polyline(&[[0.0, 0.0], [flat, 0.0], [radius, (radius - flat) * k]])
            }
            DrillPoint::SlottedChisel { angle, slot } => {
                let k = rise("point_angle", angle)?;
                not_negative("slot", slot)?;
                at_least("slot", "the slot is wider than the drill", radius, slot)?;
                EdgeProfile::polyline(&[[slot, 0.0], [radius, (radius - slot) * k]])
            }
            DrillPoint::Annular { core } => {
                positive("core_diameter", core)?;
                at_least("core_diameter", "the core is wider than the drill", radius, core / 2.0)?;
                EdgeProfile::polyline(&[[core / 2.0, 0.0], [radius, 0.0]])
            }
            DrillPoint::Flat => EdgeProfile::polyline(&[[0.0, 0.0], [radius, 0.0]]),
            DrillPoint::Cannon { overlap: e, edge_angle } => {
                let k = edge_rise("edge_angle", edge_angle)?;
                not_negative("overlap", e)?;
                at_least("overlap", "the lip passes the axis by more than the radius", radius, e)?;
                EdgeProfile::polyline(&[[0.0, e * k], [e, 0.0], [e, 2.0 * e * k], [radius, (radius + e) * k]])
            }
            DrillPoint::Gun { apex, outer_angle, inner_angle } => {
                let (outer, inner) =
                    (edge_rise("outer_angle", outer_angle)?, edge_rise("inner_angle", inner_angle)?);
                let apex = apex.unwrap_or(diameter / 4.0);
                not_negative("apex", apex)?;
                not_above("apex", "the apex stands outside the drill", apex, radius)?;
                EdgeProfile::polyline(&[[0.0, apex * inner], [apex, 0.0], [radius, (radius - apex) * outer]])
            }
            DrillPoint::Cone { angle, nose } => {
                let k = rise("cone_angle", angle)?;
                not_negative("nose_diameter", nose)?;
                at_least("nose_diameter", "the nose is wider than the tool", radius, nose / 2.0)?;
                EdgeProfile::polyline(&[[nose / 2.0, 0.0], [radius, (radius - nose / 2.0) * k]])
            }
            DrillPoint::Centre { angle, .. } | DrillPoint::Stepped { angle, .. } => {
                stepped(radius, angle, &self.stages())
            }
        }
    }

    /// The edge of each diameter of a stepped tool, from the tip; of others the one edge.
    ///
    /// # Errors
    /// As [`DrillPoint::edge`].
    pub fn bands(&self, diameter: f64) -> Result<Vec<EdgeProfile>> {
        let edge = self.edge(diameter)?;
        let borders: Vec<f64> = self.stages().iter().map(|s| s.diameter / 2.0).collect();
        if borders.is_empty() {
            return Ok(vec![edge]);
        }
        let from = std::iter::once(0.0).chain(borders.iter().copied());
        let to = borders.iter().copied().chain([diameter / 2.0]);
        Ok(from.zip(to).filter_map(|(a, b)| edge.clipped(a, b)).collect())
    }

    /// The smaller diameters of a tool of several, from the tip; of others none.
    pub fn stages(&self) -> Cow<'_, [StepStage]> {
        match *self {
            DrillPoint::Stepped { ref stages, .. } => Cow::Borrowed(stages),
            DrillPoint::Centre {
                pilot_diameter: diameter,
                pilot_length: length,
                cone_angle: shoulder,
                ..
            } => Cow::Owned(vec![StepStage { diameter, length, shoulder }]),
            _ => Cow::Borrowed(&[]),
        }
    }

    /// Whether it is one of several diameters.
    pub fn is_stepped(&self) -> bool {
        matches!(self, DrillPoint::Stepped { .. } | DrillPoint::Centre { .. })
    }
}

fn stepped(radius: f64, angle: f64, stages: &[StepStage]) -> Result<EdgeProfile> {
    if stages.is_empty() || stages.len() > MOST_STAGES {
        let (count, most) = (stages.len() as f64, MOST_STAGES as f64);
        return Err(refuse_in("stages", "a stepped tool has one to four stages", count, most, ""));
    }
    let tip = rise("point_angle", angle)?;
    let mut points = [[0.0; 2]; 2 + 2 * MOST_STAGES];
    let (mut count, mut top) = (1, 0.0);
    let mut inner = 0.0;
    let mut slope = tip;
    for (i, s) in stages.iter().enumerate() {
        let at = |e: Error| e.under(&format!("stages[{i}]"));
        let r = s.diameter / 2.0;
        at_least("diameter", "each stage must be wider than the one before", r, inner).map_err(at)?;
        at_least("diameter", "a stage must be narrower than the tool", radius, r).map_err(at)?;
        let shoulder_top = top + (r - inner) * slope;
        not_below("length", "a stage must be longer than what lies below it", s.length, shoulder_top)
            .map_err(at)?;
        points[count] = [r, shoulder_top];
        points[count + 1] = [r, s.length];
        count += 2;
        slope = shoulder_rise(s.shoulder).map_err(at)?;
        (inner, top) = (r, s.length);
    }
    points[count] = [radius, top + (radius - inner) * slope];
    EdgeProfile::polyline(&points[..=count])
}

/// `value` above `bound`.
fn at_least(key: &str, what: &str, value: f64, bound: f64) -> Result<()> {
    if value.is_finite() && value > bound { Ok(()) } else { Err(refuse(key, what, value, bound)) }
}

/// `value` at or above `bound`.
fn not_below(key: &str, what: &str, value: f64, bound: f64) -> Result<()> {
    if value.is_finite() && value >= bound { Ok(()) } else { Err(refuse(key, what, value, bound)) }
}

fn not_above(key: &str, what: &str, value: f64, bound: f64) -> Result<()> {
    if value.is_finite() && value <= bound { Ok(()) } else { Err(refuse(key, what, value, bound)) }
}

/// Half of a full angle between 0 and 180 degrees.
fn half(key: &str, angle: f64) -> Result<f64> {
    if angle > 0.0 && angle < PI {
        return Ok(angle / 2.0);
    }
    let what = format!("the {} must lie between 0 and 180 degrees", key.replace('_', " "));
    Err(refuse_in(key, &what, angle.to_degrees(), if angle > 0.0 { 180.0 } else { 0.0 }, "deg"))
}

/// Rise per radius of a cone of a full angle.
fn rise(key: &str, angle: f64) -> Result<f64> {
    Ok(half(key, angle)?.tan().recip())
}

/// Rise per radius of a shoulder, which may be flat.
fn shoulder_rise(angle: f64) -> Result<f64> {
    /// Degrees written as a decimal number may pass 180 by rounding.
    const ROUNDING: f64 = 1e-12;
    if (angle - PI).abs() <= ROUNDING { Ok(0.0) } else { rise("shoulder_angle", angle) }
}

/// Rise per radius of an edge whose angle is counted from the axis.
fn edge_rise(key: &str, angle: f64) -> Result<f64> {
    if angle > 0.0 && angle < FRAC_PI_2 {
        return Ok(angle.tan().recip());
    }
    let what = format!("the {} must lie between 0 and 90 degrees from the axis", key.replace('_', " "));
    Err(refuse_in(key, &what, angle.to_degrees(), if angle > 0.0 { 90.0 } else { 0.0 }, "deg"))
}

#[cfg(test)]
mod tests;
