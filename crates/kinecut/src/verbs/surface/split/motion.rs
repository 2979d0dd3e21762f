//! Arrows of motions in a sketch.

use std::f64::consts::PI;

use glam::DVec3;

use super::view::Placed;
use super::{MotionRole, SketchMotion};

/// Length of a straight arrow, as a share of the radius of the surface.
const LENGTH: f64 = 0.5;
/// Radius of a turning arrow, as a share of the same radius.
const TURN_RADIUS: f64 = 0.2;
/// Length of an axis beyond the surface, as a share of the same radius.
const BEYOND: f64 = 0.22;
/// Points of a turning arrow.
const STEPS: usize = 36;

/// A motion on paper [px].
pub(crate) struct Arrow {
    pub(crate) role: MotionRole,
    pub(crate) name: String,
    /// The line, its head last.
    pub(crate) line: Vec<[f64; 2]>,
    /// The axis of a rotation.
    pub(crate) axis: Option<[[f64; 2]; 2]>,
}

/// Arrows of the motions: translations from where the tool is, rotations round their axes where they leave the surface.
/// Several rotations about one line are drawn one behind the other.
pub(crate) fn arrows(motions: &[SketchMotion], tool: DVec3, on: &Placed) -> Vec<Arrow> {
    let mut taken: Vec<(DVec3, DVec3)> = Vec::new();
    let mut shifts: Vec<DVec3> = Vec::new();
    let mut found = Vec::new();
    for motion in motions {
        let Some(direction) = DVec3::from(motion.direction).try_normalize() else { continue };
        let (line, axis) = match motion.axis_point.map(DVec3::from) {
            Some(point) => {
                let middle = point + direction * (on.middle - point).dot(direction);
                let earlier = taken
                    .iter()
                    .filter(|(d, p)| {
                        let beside = (middle - *p).reject_from_normalized(*d).length();
                        direction.dot(*d).abs() > 0.999 && beside < 0.1 * on.radius
                    })
                    .count();
                taken.push((direction, middle));
                // The visible end of the axis: the one that points to the viewer or up.
                let seen = direction.dot(DVec3::new(1.0, -1.0, 1.5));
                let sign = if seen < 0.0 { -1.0 } else { 1.0 };
                let out = on.radius * (reach(direction) + BEYOND * (earlier as f64 + 0.35));
                let from = -on.radius * (reach(direction) + 0.15);
                let ends = [from, out + 0.2 * on.radius].map(|s| on.px(middle + sign * s * direction));
                (turning(middle + sign * out * direction, direction, on), Some(ends))
            }
            None => {
                // A second one in the same direction starts where the first one ends.
                let earlier = shifts.iter().filter(|d| d.dot(direction).abs() > 0.9).count() as f64;
                shifts.push(direction);
                let from = 0.1 + earlier * (LENGTH + 0.1);
                let ends = [from, from + LENGTH].map(|s| on.px(tool + s * on.radius * direction));
                (ends.to_vec(), None)
            }
        };
        if line.iter().flatten().all(|v| v.is_finite()) {
            found.push(Arrow { role: motion.role, name: motion.name.clone(), line, axis });
        }
    }
    found
}

/// Share of the radius that a surface takes along a direction: all of it, less along level ones, which are seen longer.
fn reach(direction: DVec3) -> f64 {
    if direction.z.abs() > 0.5 { 0.72 } else { 0.8 }
}

/// Three quarters of a turn, right-handed about a direction, open where it is farthest.
fn turning(centre: DVec3, axis: DVec3, on: &Placed) -> Vec<[f64; 2]> {
    let (u, v) = axis.any_orthonormal_pair();
    let nearest = on.view.depth(v).atan2(on.view.depth(u));
    let at = |i: usize| {
        let (sin, cos) = (nearest + 0.75 * PI * (2.0 * i as f64 / STEPS as f64 - 1.0)).sin_cos();
        on.px(centre + TURN_RADIUS * on.radius * (cos * u + sin * v))
    };
    (0..=STEPS).map(at).collect()
}
