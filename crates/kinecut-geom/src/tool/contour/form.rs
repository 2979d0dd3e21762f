//! The forms of tools of the trade, by their dimensions, and the contours they have.
//!
//! Every contour begins at the tip, at height 0; its cutting part ends at the height `length`, where the shank takes over
//! ([`Assembly`](super::Assembly)). Angles lie between axis and edge unless said otherwise.

use super::{Apt, Contour, barrel, cut, end, pointed};
use crate::base::Result;
use crate::tool::DrillPoint;

/// The form of a tool of revolution [mm, rad].
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::tool::ToolForm;
/// let lens = ToolForm::Lens { diameter: 16.0, profile_radius: 40.0, corner_radius: 1.0, length: 20.0 }.contour().unwrap();
/// assert_eq!(lens.elements().len(), 4); // lens, corner, wall, top
/// assert!((lens.largest_radius() - 8.0).abs() < 1e-12);
/// let wrong = ToolForm::Lens { diameter: 16.0, profile_radius: 4.0, corner_radius: 1.0, length: 20.0 };
/// assert_eq!(wrong.contour().unwrap_err().0.key.as_deref(), Some("profile_radius"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum ToolForm {
    /// Flat end mill.
    EndMill {
        /// Diameter.
        diameter: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// Ball-nose end mill.
    BallNose {
        /// Diameter.
        diameter: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// End mill with a corner radius.
    BullNose {
        /// Diameter.
        diameter: f64,
        /// Corner radius.
        corner_radius: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// Cone with a flat tip, which may have a corner radius.
    Tapered {
        /// Diameter at which the cone would meet the plane of the tip; may be 0.
        tip_diameter: f64,
        /// Radius between tip and cone; 0: sharp.
        corner_radius: f64,
        /// Angle between axis and cone.
        half_angle: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// Cone on a ball.
    TaperedBall {
        /// Diameter of the ball.
        ball_diameter: f64,
        /// Angle between axis and cone.
        half_angle: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// Barrel (drum): a convex arc, widest in the middle of its height, between two flat ends.
    Barrel {
        /// Largest diameter.
        diameter: f64,
        /// Radius of the profile.
        profile_radius: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// Oval circle-segment cutter: a ball, and tangent to it the profile, which passes its largest diameter and ends at
    /// the neck.
    Oval {
        /// Largest diameter.
        diameter: f64,
        /// Radius of the profile.
        profile_radius: f64,
        /// Radius of the ball at the tip.
        tip_radius: f64,
        /// Diameter of the neck; that of the tool: the profile ends where it is widest.
        neck_diameter: f64,
        /// Height at which the neck ends.
        length: f64,
    },
    /// Tangential circle-segment cutter: a ball, and tangent to it the profile, which runs into the cylinder above.
    Tangent {
        /// Largest diameter, that of the cylinder.
        diameter: f64,
        /// Radius of the profile.
        profile_radius: f64,
        /// Radius of the ball at the tip.
        tip_radius: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// Conical circle-segment cutter: a ball, and tangent to it the profile, whose upper end leans by an angle.
    Taper {
        /// Diameter at the upper end of the profile.
        diameter: f64,
        /// Radius of the profile.
        profile_radius: f64,
        /// Radius of the ball at the tip.
        tip_radius: f64,
        /// Angle between axis and profile at its upper end.
        half_angle: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// Lens: a flat ball end of a large radius about the axis, with a corner radius to the wall.
    Lens {
        /// Diameter.
        diameter: f64,
        /// Radius of the end.
        profile_radius: f64,
        /// Radius between end and wall; 0: an edge.
        corner_radius: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// A ball on a neck.
    Lollipop {
        /// Diameter of the ball.
        diameter: f64,
        /// Diameter of the neck.
        neck_diameter: f64,
        /// Height at which the neck ends.
        length: f64,
    },
    /// Dovetail: widest at its flat end.
    Dovetail {
        /// Largest diameter.
        diameter: f64,
        /// Angle between the end face and the flank.
        angle: f64,
        /// Radius between end and flank; 0: an edge.
        corner_radius: f64,
        /// Height of the cutting part.
        height: f64,
        /// Diameter of the neck; 0: none, nothing above the cutting part.
        neck_diameter: f64,
        /// Height at which the neck ends.
        length: f64,
    },
    /// T-slot cutter, side milling cutter: a disc on a neck.
    TSlot {
        /// Diameter.
        diameter: f64,
        /// Height of the disc.
        height: f64,
        /// Radius of both corners; 0: edges.
        corner_radius: f64,
        /// Diameter of the neck; 0: none.
        neck_diameter: f64,
        /// Height at which the neck ends.
        length: f64,
    },
    /// Convex milling cutter: a disc with a half circle as its rim.
    Convex {
        /// Largest diameter.
        diameter: f64,
        /// Radius of the rim; the disc is twice as high.
        profile_radius: f64,
        /// Diameter of the neck; 0: none.
        neck_diameter: f64,
        /// Height at which the neck ends.
        length: f64,
    },
    /// Concave milling cutter: a disc with a hollow rim.
    Concave {
        /// Diameter of the ends.
        diameter: f64,
        /// Radius of the hollow; half the height at least.
        profile_radius: f64,
        /// Height of the disc.
        height: f64,
        /// Diameter of the neck; 0: none.
        neck_diameter: f64,
        /// Height at which the neck ends.
        length: f64,
    },
    /// Drill, reamer, step drill, centre drill: the edge of its point, and its diameter up to the top. What its edge leaves
    /// about the axis is closed by a flat: a core comes out in pieces, see [`ToolForm::HollowMill`] for one that stays.
    Drill {
        /// Largest diameter.
        diameter: f64,
        /// Its point.
        point: DrillPoint,
        /// Height of the flutes.
        length: f64,
    },
    /// Countersink.
    Countersink {
        /// Largest diameter.
        diameter: f64,
        /// Full angle of the cone.
        angle: f64,
        /// Diameter of the nose; 0: sharp.
        nose_diameter: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// Hollow mill, core drill, hole saw: a core of its inner diameter stays.
    HollowMill {
        /// Outer diameter.
        diameter: f64,
        /// Diameter of the core.
        core_diameter: f64,
        /// Depth of the hollow.
        depth: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// Corner rounding cutter: a pilot and a hollow quarter circle.
    CornerRounding {
        /// Diameter of the pilot.
        tip_diameter: f64,
        /// Height of the pilot below the rounding.
        tip_length: f64,
        /// Radius of the rounding.
        radius: f64,
        /// Diameter above the rounding.
        diameter: f64,
        /// Height of the body.
        length: f64,
    },
    /// End mill whose end is ground hollow.
    Dished {
        /// Diameter.
        diameter: f64,
        /// Angle between the end and a plane across the axis.
        dish_angle: f64,
        /// Radius of the corner; 0: an edge.
        corner_radius: f64,
        /// Height of the cutting part.
        length: f64,
    },
    /// The seven parameters of APT and CLDATA.
    Apt(Apt),
}

impl ToolForm {
    /// Its contour.
    ///
    /// # Errors
    /// `KC0701` with the name of the dimension that contradicts the others; `KC0704` when the contour would cross itself.
    pub fn contour(&self) -> Result<Contour> {
        use ToolForm as F;
        match *self {
            F::EndMill { diameter, length } => end::bull(diameter, 0.0, length),
            F::BallNose { diameter, length } => end::ball(diameter, length),
            F::BullNose { diameter, corner_radius, length } => end::bull(diameter, corner_radius, length),
            F::Tapered { tip_diameter, corner_radius, half_angle, length } => {
                end::tapered(tip_diameter, corner_radius, half_angle, length)
            }
            F::TaperedBall { ball_diameter, half_angle, length } => {
                end::tapered_ball(ball_diameter, half_angle, length)
            }
            F::Dished { diameter, dish_angle, corner_radius, length } => {
                end::dished(diameter, dish_angle, corner_radius, length)
            }
            F::Lens { diameter, profile_radius, corner_radius, length } => {
                end::lens(diameter, profile_radius, corner_radius, length)
            }
            F::Barrel { diameter, profile_radius, length } => barrel::drum(diameter, profile_radius, length),
            F::Oval { diameter, profile_radius, tip_radius, neck_diameter, length } => {
                barrel::oval([diameter, profile_radius, tip_radius], neck_diameter, length)
            }
            F::Tangent { diameter, profile_radius, tip_radius, length } => {
                barrel::taper([diameter, profile_radius, tip_radius], 0.0, length)
            }
            F::Taper { diameter, profile_radius, tip_radius, half_angle, length } => {
                barrel::leaning([diameter, profile_radius, tip_radius], half_angle, length)
            }
            F::Lollipop { diameter, neck_diameter, length } => cut::lollipop(diameter, neck_diameter, length),
            F::Dovetail { diameter, angle, corner_radius, height, neck_diameter, length } => cut::dovetail(
                diameter,
                angle,
                corner_radius,
                height,
                cut::Neck { diameter: neck_diameter, top: length },
            ),
            F::TSlot { diameter, height, corner_radius, neck_diameter, length } => cut::t_slot(
                diameter,
                height,
                corner_radius,
                cut::Neck { diameter: neck_diameter, top: length },
            ),
            F::Convex { diameter, profile_radius, neck_diameter, length } => {
                cut::convex(diameter, profile_radius, cut::Neck { diameter: neck_diameter, top: length })
            }
            F::Concave { diameter, profile_radius, height, neck_diameter, length } => cut::concave(
                diameter,
                profile_radius,
                height,
                cut::Neck { diameter: neck_diameter, top: length },
            ),
            F::Drill { diameter, ref point, length } => pointed::drill(diameter, point, length),
            F::Countersink { diameter, angle, nose_diameter, length } => {
                pointed::countersink(diameter, angle, nose_diameter, length)
            }
            F::HollowMill { diameter, core_diameter, depth, length } => {
                pointed::hollow(diameter, core_diameter, depth, length)
            }
            F::CornerRounding { tip_diameter, tip_length, radius, diameter, length } => {
                cut::corner_rounding(tip_diameter, tip_length, radius, diameter, length)
            }
            F::Apt(apt) => apt.contour(),
        }
    }

    /// What a person calls it.
    pub fn name(&self) -> &'static str {
        use ToolForm as F;
        match self {
            F::EndMill { .. } => "end mill",
            F::BallNose { .. } => "ball-nose end mill",
            F::BullNose { .. } => "bull-nose end mill",
            F::Tapered { .. } => "tapered mill",
            F::TaperedBall { .. } => "tapered ball-nose end mill",
            F::Barrel { .. } => "barrel cutter",
            F::Oval { .. } => "oval circle-segment cutter",
            F::Tangent { .. } => "tangential circle-segment cutter",
            F::Taper { .. } => "conical circle-segment cutter",
            F::Lens { .. } => "lens cutter",
            F::Lollipop { .. } => "lollipop cutter",
            F::Dovetail { .. } => "dovetail cutter",
            F::TSlot { .. } => "T-slot cutter",
            F::Convex { .. } => "convex cutter",
            F::Concave { .. } => "concave cutter",
            F::Drill { point, .. } => point.name(),
            F::Countersink { .. } => "countersink",
            F::HollowMill { .. } => "hollow mill",
            F::CornerRounding { .. } => "corner rounding cutter",
            F::Dished { .. } => "dished end mill",
            F::Apt(_) => "APT cutter",
        }
    }
}
