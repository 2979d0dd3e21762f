//! Contours of tools that undercut, or hollow the wall: ball on a neck, dovetail, discs, corner rounding.

use std::f64::consts::FRAC_PI_2;

use super::pen::Pen;
use super::{Contour, DOWN, ElementRole, UP};
use crate::base::Result;
use crate::tool::dimension::{acute, at_least, at_most, not_negative, positive, refuse};

/// The neck that carries the cutting part [mm]; no neck when its diameter is 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Neck {
    pub(super) diameter: f64,
    pub(super) top: f64,
}

impl Neck {
    /// Along the upper face, which cuts, to the neck and up; without a neck the upper face is the end of the tool.
    fn after(self, pen: Pen, face: f64, height: f64) -> Result<Contour> {
        not_negative("neck_diameter", self.diameter)?;
        at_most("neck_diameter", self.diameter, 2.0 * face, "the diameter of the upper face")?;
        if self.diameter == 0.0 {
            return pen.cap(height);
        }
        if !(self.top > height && self.top.is_finite()) {
            return Err(refuse("neck_length", "the neck must end above the cutting part", self.top, height));
        }
        let radius = 0.5 * self.diameter;
        pen.to(radius, height).role(ElementRole::Shank).to(radius, self.top).cap(self.top)
    }
}

pub(super) fn lollipop(diameter: f64, neck: f64, length: f64) -> Result<Contour> {
    positive("diameter", diameter)?;
    positive("neck_diameter", neck)?;
    at_most("neck_diameter", neck, diameter, "the diameter of the ball")?;
    let (r, n) = (0.5 * diameter, 0.5 * neck);
    let end = (n / r).clamp(0.0, 1.0).acos();
    let top = r + r * end.sin();
    at_least("neck_length", length, top, "the height of the ball")?;
    Pen::at(0.0).round([0.0, r], r, DOWN, end).role(ElementRole::Shank).to(n, length).cap(length)
}

pub(super) fn dovetail(diameter: f64, angle: f64, corner: f64, height: f64, neck: Neck) -> Result<Contour> {
    positive("diameter", diameter)?;
    acute("angle", angle)?;
    not_negative("corner_radius", corner)?;
    positive("height", height)?;
    let radius = 0.5 * diameter;
    at_most("corner_radius", corner, radius, "half the diameter")?;
    let middle = radius - corner;
    let up = FRAC_PI_2 - angle;
    // Point at which the flank leaves the corner.
    let (x, z) = (middle + corner * up.cos(), corner * (1.0 + up.sin()));
    at_least("height", height, z, "the height of the corner")?;
    let face = x - (height - z) / angle.tan();
    if !(face > 0.0) {
        return Err(refuse(
            "height",
            "the flank meets the axis before it is so high",
            height,
            z + x * angle.tan(),
        ));
    }
    let pen = Pen::at(0.0).to(middle, 0.0).round([middle, corner], corner, DOWN, up).to(face, height);
    neck.after(pen, face, height)
}

pub(super) fn t_slot(diameter: f64, height: f64, corner: f64, neck: Neck) -> Result<Contour> {
    positive("diameter", diameter)?;
    positive("height", height)?;
    not_negative("corner_radius", corner)?;
    let radius = 0.5 * diameter;
    at_most("corner_radius", corner, 0.5 * height, "half the height")?;
    at_most("corner_radius", corner, radius, "half the diameter")?;
    let middle = radius - corner;
    let pen = Pen::at(0.0)
        .to(middle, 0.0)
        .round([middle, corner], corner, DOWN, 0.0)
        .to(radius, height - corner)
        .round([middle, height - corner], corner, 0.0, UP);
    neck.after(pen, middle, height)
}

pub(super) fn convex(diameter: f64, profile: f64, neck: Neck) -> Result<Contour> {
    positive("diameter", diameter)?;
    positive("profile_radius", profile)?;
    let radius = 0.5 * diameter;
    at_most("profile_radius", profile, radius, "half the diameter")?;
    let middle = radius - profile;
    let pen = Pen::at(0.0).to(middle, 0.0).round([middle, profile], profile, DOWN, UP);
    neck.after(pen, middle, 2.0 * profile)
}

pub(super) fn concave(diameter: f64, profile: f64, height: f64, neck: Neck) -> Result<Contour> {
    positive("diameter", diameter)?;
    positive("height", height)?;
    let (radius, half) = (0.5 * diameter, 0.5 * height);
    at_least("profile_radius", profile, half, "half the height")?;
    let aside = ((profile - half) * (profile + half)).max(0.0).sqrt();
    let sagitta = profile - aside;
    if !(sagitta < radius) {
        return Err(refuse("diameter", "the hollow reaches the axis", diameter, 2.0 * sagitta));
    }
    // Normals point from the material to the centre: the hollow begins below and ends above.
    let end = half.atan2(aside);
    let pen = Pen::at(0.0).to(radius, 0.0).round([radius + aside, half], profile, end, -end);
    neck.after(pen, radius, height)
}

pub(super) fn corner_rounding(
    tip: f64,
    tip_length: f64,
    r: f64,
    diameter: f64,
    length: f64,
) -> Result<Contour> {
    positive("tip_diameter", tip)?;
    not_negative("tip_length", tip_length)?;
    positive("radius", r)?;
    let (inner, outer) = (0.5 * tip, 0.5 * diameter);
    at_least("diameter", diameter, tip + 2.0 * r, "the tip's and twice the radius")?;
    at_least("length", length, tip_length + r, "the height of the rounding")?;
    Pen::at(0.0)
        .to(inner, 0.0)
        .to(inner, tip_length)
        .round([inner + r, tip_length], r, 0.0, DOWN)
        .to(outer, tip_length + r)
        .role(ElementRole::Shank)
        .to(outer, length)
        .cap(length)
}
