//! Arrows of motions in a sketch.

use std::f64::consts::PI;

use super::view::View;
use super::{MotionRole, SketchMotion};

/// Length of a straight arrow, as a share of the radius of the surface.
const LENGTH: f64 = 0.5;
/// Radius of a turning arrow, as such a share.
const TURN_RADIUS: f64 = 0.2;
/// How far an axis stands out beyond the surface, as such a share.
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
/// Several rotations about one line stand behind each other.
pub(crate) fn arrows(motions: &[SketchMotion], tool: [f64; 3], view: &View) -> Vec<Arrow> {
    let mut taken: Vec<([f64; 3], [f64; 3])> = Vec::new();
    let mut shifts: Vec<[f64; 3]> = Vec::new();
    let mut found = Vec::new();
    for motion in motions {
        let Some(direction) = unit(motion.direction) else { continue };
        let (line, axis) = match motion.axis_point {
            Some(point) => {
                let along = |p: [f64; 3]| dot(sub(p, point), direction);
                let middle = add(point, direction, along(view.middle));
                let earlier = taken
                    .iter()
                    .filter(|(d, p)| {
                        let off = sub(middle, *p);
                        let side = sub(off, [0, 1, 2].map(|k| d[k] * dot(off, *d)));
                        dot(direction, *d).abs() > 0.999 && dot(side, side).sqrt() < 0.1 * view.radius
                    })
                    .count();
                taken.push((direction, middle));
                // Where the axis is seen: its end that points to the viewer or up.
                let seen = direction[0] - direction[1] + 1.5 * direction[2];
                let sign = if seen < 0.0 { -1.0 } else { 1.0 };
                let out = view.radius * (reach(direction) + BEYOND * (earlier as f64 + 0.35));
                let centre = add(middle, direction, sign * out);
                let ends = [
                    view.px(add(middle, direction, -sign * view.radius * (reach(direction) + 0.15))),
                    view.px(add(middle, direction, sign * (out + 0.2 * view.radius))),
                ];
                let line = turning(centre, direction, TURN_RADIUS * view.radius, view);
                (line, Some(ends))
            }
            None => {
                // A second one in the same direction starts where the first one ends.
                let earlier = shifts.iter().filter(|d| dot(**d, direction).abs() > 0.9).count() as f64;
                shifts.push(direction);
                let from = 0.1 + earlier * (LENGTH + 0.1);
                let ends = [from, from + LENGTH].map(|s| view.px(add(tool, direction, s * view.radius)));
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
fn reach(direction: [f64; 3]) -> f64 {
    if direction[2].abs() > 0.5 { 0.72 } else { 0.8 }
}

/// Three quarters of a turn, right-handed about a direction, open where it is farthest.
fn turning(centre: [f64; 3], axis: [f64; 3], radius: f64, view: &View) -> Vec<[f64; 2]> {
    let helper = if axis[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
    let u = unit(cross(helper, axis)).unwrap_or([1.0, 0.0, 0.0]);
    let v = cross(axis, u);
    let viewer = [1.0, -1.0, 1.0];
    let nearest = dot(v, viewer).atan2(dot(u, viewer));
    let at = |i: usize| {
        let angle = nearest + 0.75 * PI * (2.0 * i as f64 / STEPS as f64 - 1.0);
        let (sin, cos) = angle.sin_cos();
        view.px([0, 1, 2].map(|k| centre[k] + radius * (cos * u[k] + sin * v[k])))
    };
    (0..=STEPS).map(at).collect()
}

fn add(p: [f64; 3], direction: [f64; 3], by: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| p[k] + by * direction[k])
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(a, a).sqrt();
    (length.is_finite() && length > 0.0).then(|| a.map(|c| c / length))
}
