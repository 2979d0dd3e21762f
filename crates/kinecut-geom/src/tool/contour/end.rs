//! Contours of tools that differ by their end: flat, ball, corner, cone, lens, dished.

use std::f64::consts::FRAC_PI_4;

use super::pen::Pen;
use super::{Contour, DOWN};
use crate::base::Result;
use crate::tool::dimension::{acute, at_least, at_most, not_negative, positive};

pub(super) fn ball(diameter: f64, length: f64) -> Result<Contour> {
    positive("diameter", diameter)?;
    bull(diameter, 0.5 * diameter, length)
}

pub(super) fn bull(diameter: f64, corner: f64, length: f64) -> Result<Contour> {
    positive("diameter", diameter)?;
    not_negative("corner_radius", corner)?;
    let radius = 0.5 * diameter;
    at_most("corner_radius", corner, radius, "half the diameter")?;
    positive("flute_length", length)?;
    at_least("flute_length", length, corner, "the height of the end")?;
    let middle = radius - corner;
    Pen::at(0.0).to(middle, 0.0).round([middle, corner], corner, DOWN, 0.0).to(radius, length).cap(length)
}

pub(super) fn tapered(tip: f64, corner: f64, half_angle: f64, length: f64) -> Result<Contour> {
    not_negative("diameter", tip)?;
    not_negative("corner_radius", corner)?;
    acute("half_angle", half_angle)?;
    positive("flute_length", length)?;
    // The corner touches tip and cone, which meet at (tip / 2, 0) at a right angle more the half angle.
    let reach = (FRAC_PI_4 - 0.5 * half_angle).tan();
    let middle = 0.5 * tip - corner * reach;
    at_most("corner_radius", corner, 0.5 * tip / reach, "what the tip has room for")?;
    let middle = if middle > 0.0 { middle } else { 0.0 };
    let (sin, cos) = half_angle.sin_cos();
    let height = corner * (1.0 - sin);
    at_least("flute_length", length, height, "the height of the end")?;
    Pen::at(0.0)
        .to(middle, 0.0)
        .round([middle, corner], corner, DOWN, -half_angle)
        .to(middle + corner * cos + (length - height) * half_angle.tan(), length)
        .cap(length)
}

pub(super) fn tapered_ball(ball: f64, half_angle: f64, length: f64) -> Result<Contour> {
    positive("ball_diameter", ball)?;
    acute("half_angle", half_angle)?;
    positive("flute_length", length)?;
    let r = 0.5 * ball;
    let (sin, cos) = half_angle.sin_cos();
    let height = r * (1.0 - sin);
    at_least("flute_length", length, height, "the height of the ball below the cone")?;
    Pen::at(0.0)
        .round([0.0, r], r, DOWN, -half_angle)
        .to(r * cos + (length - height) * half_angle.tan(), length)
        .cap(length)
}

pub(super) fn dished(diameter: f64, dish_angle: f64, corner: f64, length: f64) -> Result<Contour> {
    positive("diameter", diameter)?;
    acute("dish_angle", dish_angle)?;
    not_negative("corner_radius", corner)?;
    let radius = 0.5 * diameter;
    at_most("corner_radius", corner, radius, "half the diameter")?;
    let middle = radius - corner;
    let (sin, cos) = dish_angle.sin_cos();
    // Point at which the dish touches the corner, and height of the dish at the axis.
    let (x, z) = (middle - corner * sin, corner * (1.0 - cos));
    at_least("corner_radius", x, 0.0, "so small that the dish has room")?;
    let depth = z + x * dish_angle.tan();
    positive("flute_length", length)?;
    at_least("flute_length", length, depth.max(corner), "the depth of the dish")?;
    Pen::at(depth)
        .to(x, z)
        .round([middle, corner], corner, DOWN - dish_angle, 0.0)
        .to(radius, length)
        .cap(length)
}

pub(super) fn lens(diameter: f64, profile: f64, corner: f64, length: f64) -> Result<Contour> {
    positive("diameter", diameter)?;
    not_negative("corner_radius", corner)?;
    let radius = 0.5 * diameter;
    at_most("corner_radius", corner, radius, "half the diameter")?;
    at_least("profile_radius", profile, radius, "half the diameter")?;
    positive("flute_length", length)?;
    // The corner's centre lies as far from that of the end as their radii differ.
    let middle = radius - corner;
    let between = profile - corner;
    let drop = ((between - middle) * (between + middle)).max(0.0).sqrt();
    let centre = profile - drop;
    at_least("flute_length", length, centre, "the height of the end")?;
    let meet = if corner > 0.0 && between > 0.0 { (-drop).atan2(middle) } else { -drop.atan2(radius) };
    Pen::at(0.0)
        .round([0.0, profile], profile, DOWN, meet)
        .round([middle, centre], corner, meet, 0.0)
        .to(radius, length)
        .cap(length)
}
