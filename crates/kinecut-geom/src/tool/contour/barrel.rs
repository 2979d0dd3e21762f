//! Contours of barrels: a profile of a radius much larger than the tool, on its side.
//!
//! Oval, tangential and conical forms begin with a ball of the radius r about (0, r), which the profile of the radius R
//! touches from outside: their centres lie R - r apart, and the profile's centre is the ball's moved by R - r against
//! the common normal phi. With the largest radius D/2 at the normal angle -a of the upper end, the profile's centre
//! being at -(R - r) cos phi,
//!
//! cos phi = (R cos a - D/2) / (R - r),  phi <= -a.

use super::pen::Pen;
use super::{Contour, DOWN, ElementRole};
use crate::base::Result;
use crate::tool::dimension::{acute, at_least, at_most, positive, refuse};

pub(super) fn drum(diameter: f64, profile: f64, length: f64) -> Result<Contour> {
    positive("diameter", diameter)?;
    positive("profile_radius", profile)?;
    positive("flute_length", length)?;
    let half = 0.5 * length;
    at_least("profile_radius", profile, half, "half the flute length")?;
    let radius = 0.5 * diameter;
    let end = (half / profile).clamp(0.0, 1.0).asin();
    let x = radius - profile + profile * end.cos();
    if !(x > 0.0) {
        let longest = 2.0 * ((2.0 * profile - radius) * radius).max(0.0).sqrt();
        return Err(refuse(
            "flute_length",
            "the profile meets the axis before it is so long",
            length,
            longest,
        ));
    }
    Pen::at(0.0).to(x, 0.0).round([radius - profile, half], profile, -end, end).cap(length)
}

/// Diameter, profile radius and tip radius of a circle-segment cutter.
pub(super) type Segment = [f64; 3];

pub(super) fn oval(segment: Segment, neck: f64, length: f64) -> Result<Contour> {
    positive("neck_diameter", neck)?;
    at_most("neck_diameter", neck, segment[0], "the diameter")?;
    let (pen, [x, z]) = profile(segment, 0.0)?;
    let radius = segment[1];
    let beyond = ((0.5 * neck - x) / radius).clamp(-1.0, 1.0).acos();
    let top = z + radius * beyond.sin();
    at_least("neck_length", length, top, "the height of the profile")?;
    pen.round([x, z], radius, 0.0, beyond).role(ElementRole::Shank).to(0.5 * neck, length).cap(length)
}

pub(super) fn leaning(segment: Segment, half_angle: f64, length: f64) -> Result<Contour> {
    acute("half_angle", half_angle)?;
    taper(segment, half_angle, length)
}

/// The conical form, whose cone goes on above the profile; with no angle the tangential form.
pub(super) fn taper(segment: Segment, half_angle: f64, length: f64) -> Result<Contour> {
    let (pen, [_, z]) = profile(segment, half_angle)?;
    let top = z - segment[1] * half_angle.sin();
    at_least("flute_length", length, top, "the height of the profile")?;
    pen.to(0.5 * segment[0] + (length - top) * half_angle.tan(), length).cap(length)
}

/// Ball and profile up to the normal angle `-half_angle`, and the profile's centre.
fn profile([diameter, profile, tip]: Segment, half_angle: f64) -> Result<(Pen, [f64; 2])> {
    positive("diameter", diameter)?;
    positive("profile_radius", profile)?;
    positive("tip_radius", tip)?;
    let (radius, cos) = (0.5 * diameter, half_angle.cos());
    at_most("tip_radius", tip * cos, radius, "half the diameter")?;
    if !(profile > tip) {
        return Err(refuse(
            "profile_radius",
            "the profile radius must be larger than the tip's",
            profile,
            tip,
        ));
    }
    // The profile may not cross the axis below the ball: its centre lies left of the axis, or on it.
    at_least("profile_radius", profile * cos, radius, "half the diameter over the cosine of the half angle")?;
    let meet = -((profile * cos - radius) / (profile - tip)).clamp(-1.0, 1.0).acos();
    let from = if meet < DOWN { DOWN } else { meet };
    let (sin, cos) = from.sin_cos();
    let centre = [-(profile - tip) * cos, tip - (profile - tip) * sin];
    let pen = Pen::at(0.0).round([0.0, tip], tip, DOWN, from).round(centre, profile, from, -half_angle);
    Ok((pen, centre))
}
