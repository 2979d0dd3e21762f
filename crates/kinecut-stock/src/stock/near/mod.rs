//! Material near a tool at rest, found in the stock as it is: nothing is cut.
//!
//! The axis of a tool is a unit vector from its tip to its holder; heights are counted along it. Along an axis of the stock the
//! answers are exact along the lines (`upright.rs`); of a tool that leans they are those of the lines that pass it
//! (`leaning.rs`).

mod leaning;
mod upright;

use glam::DVec3;

use super::DexelGrid;
use super::cut::CutAxis;
use crate::geom::Profile;

/// Height of the highest material of all [mm], if there is any; for an axis that leans, of the ends of the lines along the axis
/// of the stock that is nearest to it.
pub fn highest<G: DexelGrid + ?Sized>(stock: &G, axis: DVec3) -> Option<f64> {
    match CutAxis::of(axis) {
        Some(along) => upright::highest(stock, along),
        None => leaning::highest(stock, axis),
    }
}

/// Longest stretch of material above the height of `tip` on a line along the axis that is at most `radius` from it [mm].
/// The circle is made wide enough for a line. For an axis that leans it is the stretch on the axis itself, within a step.
pub fn above<G: DexelGrid + ?Sized>(stock: &G, tip: DVec3, axis: DVec3, radius: f64) -> f64 {
    match CutAxis::of(axis) {
        Some(along) => upright::above(stock, tip, along, radius),
        None => leaning::above(stock, tip, axis),
    }
}

/// Heights at which material ends upwards on the lines along the axis whose distance from `at` is between two radii [mm]; for an
/// axis that leans, on the lines along the axis of the stock that is nearest to it, where they end at that distance.
pub fn tops<G: DexelGrid + ?Sized>(stock: &G, at: DVec3, axis: DVec3, radii: [f64; 2]) -> Vec<f64> {
    match CutAxis::of(axis) {
        Some(along) => upright::tops(stock, at, along, radii),
        None => leaning::tops(stock, at, axis, radii),
    }
}

/// Mean normal of the material that a tool at `tip` meets first when it goes down along its axis by up to `reach` [mm]: of the upper
/// ends, on lines along the axis of the stock nearest to it, that are at most `radius` from the tool's axis and no more than
/// that below the highest of them. `None` on fewer than eight lines, or where the normals
/// cancel one another.
pub fn face_below<G: DexelGrid + ?Sized>(
    stock: &G,
    tip: DVec3,
    axis: DVec3,
    radius: f64,
    reach: f64,
) -> Option<DVec3> {
    leaning::face_below(stock, tip, axis, radius, reach)
}

/// False only if no line along the axis, in a tool at rest at `tip` or next to it, has material at the heights of the tool: then
/// nothing but a wall thinner than the lines are apart can touch it. That is known sooner than [`touches`], and no line has to be cut for
/// it. For a tool that leans the lines are those along the axis of the stock that is nearest to its own.
pub fn may_touch<G: DexelGrid + ?Sized>(
    stock: &G,
    parts: &[(&Profile, f64)],
    tip: DVec3,
    axis: DVec3,
    margin: f64,
) -> bool {
    match CutAxis::of(axis) {
        Some(along) => upright::may_touch(stock, parts, tip, along, margin),
        None => super::cut::may_meet_at_rest(stock, parts, tip, axis, margin),
    }
}

/// True if a tool at rest at `tip` touches material: if one of its parts, with a `margin` [mm] on all sides, overlaps
/// some. Parts are given with their heights above the tip [mm]; their radius is taken not to fall upwards.
pub fn touches<G: DexelGrid + ?Sized>(
    stock: &G,
    parts: &[(&Profile, f64)],
    tip: DVec3,
    axis: DVec3,
    margin: f64,
) -> bool {
    match CutAxis::of(axis) {
        Some(along) => upright::touches(stock, parts, tip, along, margin),
        None => super::cut::meets_at_rest(stock, parts, tip, axis, margin),
    }
}
