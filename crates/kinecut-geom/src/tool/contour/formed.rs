//! From the dimensions of a tool to its contour.

use super::{Contour, ContourRead, ToolForm, barrel, cut, end, pointed};
use crate::base::{Loader, MemoryLoader, Result};
use crate::tool::DrillPoint;

impl ToolForm {
    /// Its contour; that of a drawing has no file here.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::ToolForm;
    /// let lens = ToolForm::Lens { diameter: 16.0, profile_radius: 40.0, corner_radius: 1.0, flute_length: 20.0 }.contour().unwrap();
    /// assert_eq!(lens.elements().len(), 4); // lens, corner, wall, top
    /// assert!((lens.largest_radius() - 8.0).abs() < 1e-12);
    /// let wrong = ToolForm::Lens { diameter: 16.0, profile_radius: 4.0, corner_radius: 1.0, flute_length: 20.0 };
    /// assert_eq!(wrong.contour().unwrap_err().0.key.as_deref(), Some("profile_radius"));
    /// ```
    ///
    /// # Errors
    /// `KC0701` with the name of the dimension that contradicts the others; `KC0704` when the contour would cross itself.
    pub fn contour(&self) -> Result<Contour> {
        self.read(&MemoryLoader::default()).map(|read| read.contour)
    }

    /// Its contour and what is to be said of it; a drawing is read by the loader.
    ///
    /// # Errors
    /// As [`ToolForm::contour`], and those of the drawing.
    pub fn read(&self, loader: &dyn Loader) -> Result<ContourRead> {
        use ToolForm as F;
        let contour = match *self {
            F::EndMill { diameter, flute_length } => end::bull(diameter, 0.0, flute_length),
            F::BallNose { diameter, flute_length } => end::ball(diameter, flute_length),
            F::BullNose { diameter, corner_radius, flute_length } => {
                end::bull(diameter, corner_radius, flute_length)
            }
            F::Tapered { diameter, corner_radius, half_angle, flute_length } => {
                end::tapered(diameter, corner_radius, half_angle, flute_length)
            }
            F::TaperedBall { ball_diameter, half_angle, flute_length } => {
                end::tapered_ball(ball_diameter, half_angle, flute_length)
            }
            F::Dished { diameter, dish_angle, corner_radius, flute_length } => {
                end::dished(diameter, dish_angle, corner_radius, flute_length)
            }
            F::Lens { diameter, profile_radius, corner_radius, flute_length } => {
                end::lens(diameter, profile_radius, corner_radius, flute_length)
            }
            F::Barrel { diameter, profile_radius, flute_length } => {
                barrel::drum(diameter, profile_radius, flute_length)
            }
            F::Oval { diameter, profile_radius, tip_radius, neck_diameter, neck_length } => {
                barrel::oval([diameter, profile_radius, tip_radius], neck_diameter, neck_length)
            }
            F::Tangent { diameter, profile_radius, tip_radius, flute_length } => {
                barrel::taper([diameter, profile_radius, tip_radius], 0.0, flute_length)
            }
            F::Taper { diameter, profile_radius, tip_radius, half_angle, flute_length } => {
                barrel::leaning([diameter, profile_radius, tip_radius], half_angle, flute_length)
            }
            F::Lollipop { diameter, neck_diameter, neck_length } => {
                cut::lollipop(diameter, neck_diameter, neck_length)
            }
            F::Dovetail { diameter, angle, corner_radius, height, neck_diameter, neck_length } => {
                cut::dovetail(
                    diameter,
                    angle,
                    corner_radius,
                    height,
                    cut::Neck { diameter: neck_diameter, top: neck_length },
                )
            }
            F::TSlot { diameter, height, corner_radius, neck_diameter, neck_length } => cut::t_slot(
                diameter,
                height,
                corner_radius,
                cut::Neck { diameter: neck_diameter, top: neck_length },
            ),
            F::Convex { diameter, profile_radius, neck_diameter, neck_length } => {
                cut::convex(diameter, profile_radius, cut::Neck { diameter: neck_diameter, top: neck_length })
            }
            F::Concave { diameter, profile_radius, height, neck_diameter, neck_length } => cut::concave(
                diameter,
                profile_radius,
                height,
                cut::Neck { diameter: neck_diameter, top: neck_length },
            ),
            F::Drill { diameter, point_angle, ref point, flute_length } => {
                let point = DrillPoint::of_keys(point.as_ref(), point_angle, diameter)?;
                pointed::drill(diameter, &point, flute_length)
            }
            F::Countersink { diameter, angle, nose_diameter, flute_length } => {
                pointed::countersink(diameter, angle, nose_diameter, flute_length)
            }
            F::HollowMill { diameter, core_diameter, depth, flute_length } => {
                pointed::hollow(diameter, core_diameter, depth, flute_length)
            }
            F::CornerRounding { tip_diameter, tip_length, radius, diameter, length } => {
                let diameter = diameter.unwrap_or(tip_diameter + 2.0 * radius);
                cut::corner_rounding(tip_diameter, tip_length, radius, diameter, length)
            }
            F::Apt(ref apt) => apt.contour(),
            F::Outline(ref section) => return section.read(loader),
            F::Contour(ref file) => file.contour(),
        }?;
        Ok(ContourRead { contour, notes: Vec::new() })
    }
}
