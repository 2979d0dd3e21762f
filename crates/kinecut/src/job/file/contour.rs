//! Tools of any form of revolution as written in files: a shape by its dimensions, by its outline or by its elements, and what
//! carries it. Lengths in mm, angles in degrees.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::tool::HolderSegmentTable;
use crate::base::unit::Deg;
use crate::geom::{LengthUnit, SectionAxis};
use crate::tool::{ContourFile, DrillPoint};

/// A tool of revolution: its shape, shank and holder. Heights are counted from the tip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContourTable {
    /// What a person calls it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Shape of the cutting part.
    pub shape: ToolShapeTable,
    /// Diameter of the shank above it; default: that of its upper end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shank_diameter: Option<f64>,
    /// Height of the holder's face, and of the shank's end, above the tip; default: the end of the shape.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stickout: Option<f64>,
    /// Segments of the holder, from its face upwards.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holder: Vec<HolderSegmentTable>,
}

/// Shapes of tools.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ToolShapeTable {
    /// Flat end mill.
    EndMill(PlainTable),
    /// Ball-nose end mill.
    BallNose(PlainTable),
    /// End mill with a corner radius.
    BullNose(CorneredTable),
    /// Cone with a flat tip.
    Tapered(TaperedTable),
    /// Cone on a ball.
    TaperedBall(TaperedBallTable),
    /// Barrel: a convex arc, widest in the middle of its height, between two flat ends.
    Barrel(BarrelTable),
    /// Oval circle-segment cutter: ball, profile past its largest diameter, neck.
    Oval(OvalTable),
    /// Tangential circle-segment cutter: ball, profile that runs into the cylinder above.
    Tangent(TangentTable),
    /// Conical circle-segment cutter: ball, profile whose upper end leans by an angle.
    Taper(TaperTable),
    /// Lens: an end of a large radius about the axis.
    Lens(LensTable),
    /// A ball on a neck.
    Lollipop(LollipopTable),
    /// Dovetail: widest at its flat end.
    Dovetail(DovetailTable),
    /// T-slot cutter, side milling cutter: a disc.
    TSlot(TSlotTable),
    /// Convex milling cutter: a disc with a half circle as its rim.
    Convex(ConvexTable),
    /// Concave milling cutter: a disc with a hollow rim.
    Concave(ConcaveTable),
    /// Drill, reamer, step drill: its shape is given by `point`.
    Drill(DrillShapeTable),
    /// Countersink.
    Countersink(CountersinkTable),
    /// Hollow mill, hole saw: a core stays.
    HollowMill(HollowMillTable),
    /// Corner rounding cutter.
    CornerRounding(CornerRoundingTable),
    /// End mill whose end is ground hollow.
    Dished(DishedTable),
    /// The seven parameters of APT and CLDATA.
    Apt(AptTable),
    /// Half a section drawn in a file: .dxf, .svg or an outline as .json.
    Outline(SectionTable),
    /// Its lines and arcs.
    Contour(ContourFile),
}

/// A diameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlainTable {
    /// Diameter.
    pub diameter: f64,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
}

/// A diameter and a corner.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CorneredTable {
    /// Diameter.
    pub diameter: f64,
    /// Corner radius.
    pub corner_radius: f64,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
}

/// A cone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TaperedTable {
    /// Diameter at which the cone would meet the plane of the tip; 0: sharp.
    pub diameter: f64,
    /// Angle between axis and edge.
    pub half_angle: f64,
    /// Radius between tip and cone; default 0: an edge.
    #[serde(default)]
    pub corner_radius: f64,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
}

/// A cone on a ball.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TaperedBallTable {
    /// Diameter of the ball.
    pub ball_diameter: f64,
    /// Angle between axis and edge.
    pub half_angle: f64,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
}

/// A barrel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BarrelTable {
    /// Largest diameter.
    pub diameter: f64,
    /// Radius of the profile.
    pub profile_radius: f64,
    /// Height of the cutting part, from end to end.
    pub flute_length: f64,
}

/// An oval circle-segment cutter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OvalTable {
    /// Largest diameter.
    pub diameter: f64,
    /// Radius of the profile.
    pub profile_radius: f64,
    /// Radius of the ball at the tip.
    pub tip_radius: f64,
    /// Diameter of the neck, at which the profile ends.
    pub neck_diameter: f64,
    /// Height above the tip at which the neck ends.
    pub neck_length: f64,
}

/// A tangential circle-segment cutter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TangentTable {
    /// Largest diameter, that of the cylinder above the profile.
    pub diameter: f64,
    /// Radius of the profile.
    pub profile_radius: f64,
    /// Radius of the ball at the tip.
    pub tip_radius: f64,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
}

/// A conical circle-segment cutter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TaperTable {
    /// Diameter at the upper end of the profile.
    pub diameter: f64,
    /// Radius of the profile.
    pub profile_radius: f64,
    /// Radius of the ball at the tip.
    pub tip_radius: f64,
    /// Angle between axis and profile at its upper end; a cone of this angle goes on above.
    pub half_angle: f64,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
}

/// A lens cutter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LensTable {
    /// Diameter.
    pub diameter: f64,
    /// Radius of the end.
    pub profile_radius: f64,
    /// Radius between end and wall; default 0: an edge.
    #[serde(default)]
    pub corner_radius: f64,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
}

/// A ball on a neck.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LollipopTable {
    /// Diameter of the ball.
    pub diameter: f64,
    /// Diameter of the neck.
    pub neck_diameter: f64,
    /// Height above the tip at which the neck ends.
    pub neck_length: f64,
}

/// A dovetail cutter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DovetailTable {
    /// Largest diameter.
    pub diameter: f64,
    /// Angle between end face and flank.
    pub angle: f64,
    /// Radius between end face and flank; default 0: an edge.
    #[serde(default)]
    pub corner_radius: f64,
    /// Height of the cutting part above the tip.
    pub height: f64,
    /// Diameter of the neck; default: none.
    #[serde(default)]
    pub neck_diameter: Option<f64>,
    /// Height above the tip at which the neck ends.
    #[serde(default)]
    pub neck_length: Option<f64>,
}

/// A disc.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TSlotTable {
    /// Diameter.
    pub diameter: f64,
    /// Height of the disc.
    pub height: f64,
    /// Radius of both corners; default 0: edges.
    #[serde(default)]
    pub corner_radius: f64,
    /// Diameter of the neck; default: none.
    #[serde(default)]
    pub neck_diameter: Option<f64>,
    /// Height above the tip at which the neck ends.
    #[serde(default)]
    pub neck_length: Option<f64>,
}

/// A disc with a round rim.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConvexTable {
    /// Largest diameter.
    pub diameter: f64,
    /// Radius of the rim, half the height.
    pub profile_radius: f64,
    /// Diameter of the neck; default: none.
    #[serde(default)]
    pub neck_diameter: Option<f64>,
    /// Height above the tip at which the neck ends.
    #[serde(default)]
    pub neck_length: Option<f64>,
}

/// A disc with a hollow rim.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConcaveTable {
    /// Diameter of the ends.
    pub diameter: f64,
    /// Radius of the hollow.
    pub profile_radius: f64,
    /// Height of the disc.
    pub height: f64,
    /// Diameter of the neck; default: none.
    #[serde(default)]
    pub neck_diameter: Option<f64>,
    /// Height above the tip at which the neck ends.
    #[serde(default)]
    pub neck_length: Option<f64>,
}

/// A drill.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DrillShapeTable {
    /// Largest diameter.
    pub diameter: f64,
    /// Full point angle of a twist drill; default 118. Other points: see `point`.
    #[serde(default, with = "Deg::<Option<f64>>")]
    pub point_angle: Option<f64>,
    /// Point of a drill that is no plain twist drill: "flat", { double-ground = { .. } }, { gun = { .. } }, ..
    #[serde(default)]
    pub point: Option<DrillPoint>,
    /// Height of the flutes above the tip.
    pub flute_length: f64,
}

/// A countersink.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CountersinkTable {
    /// Largest diameter.
    pub diameter: f64,
    /// Full angle of the cone; default 90.
    #[serde(default = "right_angle")]
    pub angle: f64,
    /// Diameter of the nose; default 0: sharp.
    #[serde(default)]
    pub nose_diameter: f64,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
}

fn right_angle() -> f64 {
    90.0
}

/// A hollow mill.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HollowMillTable {
    /// Outer diameter.
    pub diameter: f64,
    /// Diameter of the core.
    pub core_diameter: f64,
    /// Depth of the hollow.
    pub depth: f64,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
}

/// A corner rounding cutter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CornerRoundingTable {
    /// Diameter of the pilot.
    pub tip_diameter: f64,
    /// Height of the pilot below the rounding; default 0.
    #[serde(default)]
    pub tip_length: f64,
    /// Radius of the rounding.
    pub radius: f64,
    /// Diameter above the rounding; default: where the rounding ends.
    #[serde(default)]
    pub diameter: Option<f64>,
    /// Height of the body above the tip.
    pub length: f64,
}

/// A hollow end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DishedTable {
    /// Diameter.
    pub diameter: f64,
    /// Angle between the end and a plane across the axis.
    pub dish_angle: f64,
    /// Corner radius; default 0: an edge.
    #[serde(default)]
    pub corner_radius: f64,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
}

/// CUTTER / d, r, e, f, alpha, beta, h.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AptTable {
    /// d: diameter where lower and upper cone would meet. Needed without `centre_radius`; with it, it is compared.
    #[serde(default)]
    pub diameter: Option<f64>,
    /// r: radius of the corner; default 0: an edge.
    #[serde(default)]
    pub corner_radius: f64,
    /// e: distance of the corner's centre from the axis; default: half of d, less r.
    #[serde(default)]
    pub centre_radius: Option<f64>,
    /// f: height of the corner's centre; default: r.
    #[serde(default)]
    pub centre_height: Option<f64>,
    /// alpha: angle between a plane across the axis and the lower cone; default 0.
    #[serde(default)]
    pub lower_angle: f64,
    /// beta: angle between the axis and the upper cone; default 0.
    #[serde(default)]
    pub upper_angle: f64,
    /// h: height of the tool.
    pub height: f64,
}

/// Half a section in a drawing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SectionTable {
    /// File, in the folder of this one. Layers called `cutting`, `shank` and `holder` say what a part is there for.
    pub file: String,
    /// Axis of the drawing that is the tool's, the tip towards its lower end; default "y".
    #[serde(default)]
    pub axis: Option<SectionAxis>,
    /// Unit of the drawing's numbers, whatever it says.
    #[serde(default)]
    pub unit: Option<LengthUnit>,
    /// Distance at which ends of lines and arcs are joined; default 0.01.
    #[serde(default)]
    pub snap: Option<f64>,
    /// Layers that are read; default: all.
    #[serde(default)]
    pub layers: Option<Vec<String>>,
}
