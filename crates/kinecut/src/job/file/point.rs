//! Points of drills as written in the job file: lengths in mm, full angles in degrees unless counted from the axis.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The point of a tool that works along its axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum PointTable {
    /// Twist drill, ground in one plane.
    Twist(AngleTable),
    /// Twist drill, ground in two planes.
    DoubleGround(DoubleGroundTable),
    /// Twist drill for cast iron (Zhirov), ground in three planes.
    CastIron(CastIronTable),
    /// Twist drill with rounded lips.
    RoundedLips(RoundedLipsTable),
    /// Twist drill with a radius between lip and margin.
    CornerRadius(CornerRadiusTable),
    /// Twist drill with its web ground flat.
    ThinnedWeb(ThinnedWebTable),
    /// Twist drill with a slot across its chisel edge.
    SlottedChisel(SlottedChiselTable),
    /// Annular drill: a core stays.
    Annular(AnnularTable),
    /// Flat: indexable insert drill, flat-bottom drill, counterbore.
    Flat,
    /// Cannon drill: one lip that passes the axis.
    Cannon(CannonTable),
    /// Gun drill: its apex stands off the axis.
    Gun(GunTable),
    /// Auger drill.
    Auger(AngleTable),
    /// Ejector drill.
    Ejector(AngleTable),
    /// Countersink, core drill, reamer: a cone on a nose that does not cut.
    Cone(ConeTable),
    /// Centre drill: a pilot, then a cone.
    Centre(CentreTable),
    /// Several diameters.
    Stepped(SteppedTable),
}

fn common_angle() -> f64 {
    118.0
}
fn second_angle() -> f64 {
    70.0
}
fn third_angle() -> f64 {
    55.0
}
fn outer_angle() -> f64 {
    60.0
}
fn inner_angle() -> f64 {
    70.0
}
fn centre_angle() -> f64 {
    120.0
}
fn centre_cone() -> f64 {
    60.0
}

/// A point of one angle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AngleTable {
    /// Point angle; default 118.
    #[serde(default = "common_angle")]
    pub point_angle: f64,
}

/// A point ground in two planes; the second edges are 0.2 diameters long.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DoubleGroundTable {
    /// Point angle; default 118.
    #[serde(default = "common_angle")]
    pub point_angle: f64,
    /// Angle of the second edges; default 70.
    #[serde(default = "second_angle")]
    pub second_angle: f64,
}

/// A point ground in three planes; the outer edges are 0.2 and 0.15 diameters long.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CastIronTable {
    /// Point angle; default 118.
    #[serde(default = "common_angle")]
    pub point_angle: f64,
    /// Angle of the second edges; default 70.
    #[serde(default = "second_angle")]
    pub second_angle: f64,
    /// Angle of the third edges; default 55.
    #[serde(default = "third_angle")]
    pub third_angle: f64,
    /// Half the width of the slot across the chisel edge; default 0: none.
    #[serde(default)]
    pub slot: f64,
}

/// Rounded lips.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoundedLipsTable {
    /// Radius of the lips about a point of the axis; at least that of the drill.
    pub lip_radius: f64,
}

/// Rounded corners.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CornerRadiusTable {
    /// Point angle; default 118.
    #[serde(default = "common_angle")]
    pub point_angle: f64,
    /// Radius between lip and margin.
    pub corner_radius: f64,
}

/// A flat web.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThinnedWebTable {
    /// Point angle; default 118.
    #[serde(default = "common_angle")]
    pub point_angle: f64,
    /// Half the width of the flat.
    pub flat: f64,
}

/// A slotted chisel edge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SlottedChiselTable {
    /// Point angle; default 118.
    #[serde(default = "common_angle")]
    pub point_angle: f64,
    /// Half the width of the slot.
    pub slot: f64,
}

/// An annular drill.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AnnularTable {
    /// Diameter of the core.
    pub core_diameter: f64,
}

/// A cannon drill.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CannonTable {
    /// How far the lip passes the axis.
    pub overlap: f64,
    /// Angle of the lip, counted from the axis.
    pub edge_angle: f64,
}

/// A gun drill.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GunTable {
    /// Distance of the apex from the axis; default: a quarter of the diameter.
    #[serde(default)]
    pub apex: Option<f64>,
    /// Angle of the outer edge, counted from the axis; default 60.
    #[serde(default = "outer_angle")]
    pub outer_angle: f64,
    /// Angle of the inner edge, counted from the axis; default 70.
    #[serde(default = "inner_angle")]
    pub inner_angle: f64,
}

/// A cone on a nose.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConeTable {
    /// Full angle of the cone.
    pub cone_angle: f64,
    /// Diameter of the nose; default 0: sharp.
    #[serde(default)]
    pub nose_diameter: f64,
}

/// A centre drill.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CentreTable {
    /// Diameter of the pilot.
    pub pilot_diameter: f64,
    /// Height above the tip at which the cone begins.
    pub pilot_length: f64,
    /// Point angle of the pilot; default 120.
    #[serde(default = "centre_angle")]
    pub point_angle: f64,
    /// Full angle of the cone; default 60.
    #[serde(default = "centre_cone")]
    pub cone_angle: f64,
}

/// A tool of several diameters; the tool's own diameter is the largest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SteppedTable {
    /// Point angle; default 118.
    #[serde(default = "common_angle")]
    pub point_angle: f64,
    /// The smaller diameters, from the tip; at most four.
    pub stages: Vec<StageTable>,
}

/// A stage of a stepped tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StageTable {
    /// Diameter.
    pub diameter: f64,
    /// Height above the tip at which the shoulder to the next diameter begins.
    pub length: f64,
    /// Full angle of that shoulder; default 180: flat.
    #[serde(default = "flat_shoulder")]
    pub shoulder_angle: f64,
}

fn flat_shoulder() -> f64 {
    180.0
}
