//! The forms of tools of the trade, by their dimensions, and the contours they have.
//!
//! Every contour begins at the tip, at height 0; its cutting part ends at the height `flute_length`, where the shank takes
//! over ([`Assembly`](super::Assembly)). Angles lie between axis and edge unless said otherwise.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Apt, ContourFile, SectionDrawing};
use crate::base::unit::{Deg, degrees};
use crate::tool::DrillPoint;

/// The form of a tool of revolution [mm, rad]; in a file angles are degrees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum ToolForm {
    /// Flat end mill.
    EndMill {
        /// Diameter.
        #[schemars(example = 10)]
        diameter: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// Ball-nose end mill.
    BallNose {
        /// Diameter.
        #[schemars(example = 10)]
        diameter: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// End mill with a corner radius.
    BullNose {
        /// Diameter.
        #[schemars(example = 10)]
        diameter: f64,
        /// Corner radius.
        #[schemars(example = 1)]
        corner_radius: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// Cone with a flat tip, which may have a corner radius.
    Tapered {
        /// Diameter at which the cone would meet the plane of the tip; 0: sharp.
        #[schemars(example = 4)]
        diameter: f64,
        /// Radius between tip and cone; default 0: an edge.
        #[serde(default)]
        corner_radius: f64,
        /// Angle between axis and cone; degrees in a file.
        #[serde(with = "Deg")]
        #[schemars(example = 10)]
        half_angle: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// Cone on a ball.
    TaperedBall {
        /// Diameter of the ball.
        #[schemars(example = 4)]
        ball_diameter: f64,
        /// Angle between axis and cone; degrees in a file.
        #[serde(with = "Deg")]
        #[schemars(example = 10)]
        half_angle: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// Barrel (drum): a convex arc, widest in the middle of its height, between two flat ends.
    Barrel {
        /// Largest diameter.
        #[schemars(example = 10)]
        diameter: f64,
        /// Radius of the profile.
        #[schemars(example = 80)]
        profile_radius: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// Oval circle-segment cutter: a ball, and tangent to it the profile, which passes its largest diameter and ends at
    /// the neck.
    Oval {
        /// Largest diameter.
        #[schemars(example = 10)]
        diameter: f64,
        /// Radius of the profile.
        #[schemars(example = 80)]
        profile_radius: f64,
        /// Radius of the ball at the tip.
        #[schemars(example = 3)]
        tip_radius: f64,
        /// Diameter of the neck; that of the tool: the profile ends where it is widest.
        #[schemars(example = 6)]
        neck_diameter: f64,
        /// Height above the tip at which the neck ends.
        #[schemars(example = 20)]
        neck_length: f64,
    },
    /// Tangential circle-segment cutter: a ball, and tangent to it the profile, which runs into the cylinder above.
    Tangent {
        /// Largest diameter, that of the cylinder.
        #[schemars(example = 10)]
        diameter: f64,
        /// Radius of the profile.
        #[schemars(example = 80)]
        profile_radius: f64,
        /// Radius of the ball at the tip.
        #[schemars(example = 3)]
        tip_radius: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// Conical circle-segment cutter: a ball, and tangent to it the profile, whose upper end leans by an angle.
    Taper {
        /// Diameter at the upper end of the profile.
        #[schemars(example = 10)]
        diameter: f64,
        /// Radius of the profile.
        #[schemars(example = 80)]
        profile_radius: f64,
        /// Radius of the ball at the tip.
        #[schemars(example = 3)]
        tip_radius: f64,
        /// Angle between axis and profile at its upper end; degrees in a file; a cone of this angle goes on above.
        #[serde(with = "Deg")]
        #[schemars(example = 10)]
        half_angle: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// Lens: a flat ball end of a large radius about the axis, with a corner radius to the wall.
    Lens {
        /// Diameter.
        #[schemars(example = 10)]
        diameter: f64,
        /// Radius of the end.
        #[schemars(example = 80)]
        profile_radius: f64,
        /// Radius between end and wall; default 0: an edge.
        #[serde(default)]
        corner_radius: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// A ball on a neck.
    Lollipop {
        /// Diameter of the ball.
        #[schemars(example = 10)]
        diameter: f64,
        /// Diameter of the neck.
        #[schemars(example = 6)]
        neck_diameter: f64,
        /// Height above the tip at which the neck ends.
        #[schemars(example = 30)]
        neck_length: f64,
    },
    /// Dovetail: widest at its flat end.
    Dovetail {
        /// Largest diameter.
        #[schemars(example = 20)]
        diameter: f64,
        /// Angle between the end face and the flank; degrees in a file.
        #[serde(with = "Deg")]
        #[schemars(example = 60)]
        angle: f64,
        /// Radius between end and flank; default 0: an edge.
        #[serde(default)]
        corner_radius: f64,
        /// Height of the cutting part.
        #[schemars(example = 6)]
        height: f64,
        /// Diameter of the neck; default 0: none, nothing above the cutting part.
        #[serde(default)]
        neck_diameter: f64,
        /// Height above the tip at which the neck ends.
        #[serde(default)]
        neck_length: f64,
    },
    /// T-slot cutter, side milling cutter: a disc on a neck.
    TSlot {
        /// Diameter.
        #[schemars(example = 25)]
        diameter: f64,
        /// Height of the disc.
        #[schemars(example = 8)]
        height: f64,
        /// Radius of both corners; default 0: edges.
        #[serde(default)]
        corner_radius: f64,
        /// Diameter of the neck; default 0: none.
        #[serde(default)]
        neck_diameter: f64,
        /// Height above the tip at which the neck ends.
        #[serde(default)]
        neck_length: f64,
    },
    /// Convex milling cutter: a disc with a half circle as its rim.
    Convex {
        /// Largest diameter.
        #[schemars(example = 10)]
        diameter: f64,
        /// Radius of the rim; the disc is twice as high.
        #[schemars(example = 3)]
        profile_radius: f64,
        /// Diameter of the neck; default 0: none.
        #[serde(default)]
        neck_diameter: f64,
        /// Height above the tip at which the neck ends.
        #[serde(default)]
        neck_length: f64,
    },
    /// Concave milling cutter: a disc with a hollow rim.
    Concave {
        /// Diameter of the ends.
        #[schemars(example = 10)]
        diameter: f64,
        /// Radius of the hollow; half the height at least.
        #[schemars(example = 4)]
        profile_radius: f64,
        /// Height of the disc.
        #[schemars(example = 6)]
        height: f64,
        /// Diameter of the neck; default 0: none.
        #[serde(default)]
        neck_diameter: f64,
        /// Height above the tip at which the neck ends.
        #[serde(default)]
        neck_length: f64,
    },
    /// Drill, reamer, step drill, centre drill: its shape is given by `point`, and its diameter goes up to the top. The core
    /// that its edge leaves about the axis comes out in pieces: it is closed by a flat.
    Drill {
        /// Largest diameter.
        #[schemars(example = 10)]
        diameter: f64,
        /// Full point angle of a twist drill; default 118 degrees. Other points: see `point`.
        #[serde(default, with = "Deg::<Option<f64>>")]
        point_angle: Option<f64>,
        /// Point of a drill that is no plain twist drill: "flat", { double-ground = { .. } }, { gun = { .. } }, ..
        #[serde(default)]
        point: Option<DrillPoint>,
        /// Height of the flutes above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// Countersink.
    Countersink {
        /// Largest diameter.
        #[schemars(example = 10)]
        diameter: f64,
        /// Full angle of the cone; default 90 degrees.
        #[serde(default = "degrees::<90>", with = "Deg")]
        angle: f64,
        /// Diameter of the nose; default 0: sharp.
        #[serde(default)]
        nose_diameter: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// Hollow mill, core drill, hole saw: a core of its inner diameter stays.
    HollowMill {
        /// Outer diameter.
        #[schemars(example = 20)]
        diameter: f64,
        /// Diameter of the core.
        #[schemars(example = 16)]
        core_diameter: f64,
        /// Depth of the hollow.
        #[schemars(example = 20)]
        depth: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// Corner rounding cutter: a pilot and a hollow quarter circle.
    CornerRounding {
        /// Diameter of the pilot.
        #[schemars(example = 6)]
        tip_diameter: f64,
        /// Height of the pilot below the rounding; default 0.
        #[serde(default)]
        tip_length: f64,
        /// Radius of the rounding.
        #[schemars(example = 3)]
        radius: f64,
        /// Diameter above the rounding; default: where the rounding ends.
        #[serde(default)]
        diameter: Option<f64>,
        /// Height of the body above the tip.
        #[schemars(example = 20)]
        length: f64,
    },
    /// End mill whose end is ground hollow.
    Dished {
        /// Diameter.
        #[schemars(example = 10)]
        diameter: f64,
        /// Angle between the end and a plane across the axis; degrees in a file.
        #[serde(with = "Deg")]
        #[schemars(example = 2)]
        dish_angle: f64,
        /// Radius of the corner; default 0: an edge.
        #[serde(default)]
        corner_radius: f64,
        /// Height of the cutting part above the tip.
        #[schemars(example = 22)]
        flute_length: f64,
    },
    /// The seven parameters of APT and CLDATA.
    Apt(Apt),
    /// Half a section drawn in a file: .dxf, .svg or an outline as .json.
    Outline(SectionDrawing),
    /// Its lines and arcs.
    Contour(ContourFile),
}
