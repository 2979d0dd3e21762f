//! Dimensions of a recognised face: radii, half angles, pitch.

use glam::DVec3;

use super::super::{Form, Slide, SlidingGroup};
use crate::num::singular::Triangle;

/// A face with its dimensions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Primitive {
    /// A plane.
    Plane {
        /// Unit normal out of the material.
        normal: DVec3,
        /// A point of it [mm].
        point: DVec3,
    },
    /// A circular cylinder.
    Cylinder {
        /// Radius [mm].
        radius: f64,
    },
    /// A circular cone.
    Cone {
        /// Angle between axis and generatrix [rad].
        half_angle: f64,
        /// The apex [mm].
        apex: DVec3,
    },
    /// A sphere.
    Sphere {
        /// Radius [mm].
        radius: f64,
        /// Centre [mm].
        centre: DVec3,
    },
    /// A torus.
    Torus {
        /// Radius of the circle of centres [mm].
        major: f64,
        /// Radius of the tube [mm].
        minor: f64,
    },
    /// Another surface of revolution, with the least and the greatest radius [mm].
    Revolution {
        /// Least and greatest distance from the axis [mm].
        radii: [f64; 2],
    },
    /// A screw surface.
    Screw {
        /// Advance per turn [mm], positive for a right-handed one.
        lead: f64,
        /// Least and greatest distance from the axis [mm].
        radii: [f64; 2],
    },
    /// A general cylinder.
    Extrusion {
        /// Direction of its straight lines: a unit vector.
        direction: DVec3,
    },
    /// A surface without a sliding motion.
    General,
}

/// Breadth of a profile by its length at which it counts as straight or as a circle, in addition to the error of its
/// facets.
const SHAPE: f64 = 1e-4;

/// The dimensions of a face from its vertices; `coarse` is the sagitta of its facets by their length.
pub(super) fn primitive(group: &SlidingGroup, points: &[DVec3], normal: DVec3, coarse: f64) -> Primitive {
    let Some(first) = group.slides.first() else { return Primitive::General };
    let middle = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    match (group.form, *first) {
        (Form::Plane, _) => Primitive::Plane { normal, point: middle },
        (Form::Sphere, Slide::Turn { point: centre, .. }) => {
            Primitive::Sphere { radius: mean(points.iter().map(|p| p.distance(centre))), centre }
        }
        (Form::Extrusion, Slide::Shift { direction }) => Primitive::Extrusion { direction },
        (form, Slide::Turn { axis, point, .. }) => {
            let profile: Vec<[f64; 2]> = points
                .iter()
                .map(|p| {
                    let height = axis.dot(*p - point);
                    [height, (*p - point - axis * height).length()]
                })
                .collect();
            let of =
                |choose: fn(f64, f64) -> f64, start: f64| profile.iter().map(|p| p[1]).fold(start, choose);
            let radii = [of(f64::min, f64::INFINITY), of(f64::max, 0.0)];
            match form {
                Form::Cylinder => Primitive::Cylinder { radius: mean(profile.iter().map(|p| p[1])) },
                Form::Screw => Primitive::Screw { lead: first.lead().unwrap_or(0.0), radii },
                _ => cone(&profile, axis, point, coarse)
                    .or_else(|| torus(&profile, coarse))
                    .unwrap_or(Primitive::Revolution { radii }),
            }
        }
        _ => Primitive::General,
    }
}

/// Puts the centre of a sphere where its vertices want it, if they lie closer to that sphere than to the one of the
/// normals: the least algebraic distance, `|p|^2 = 2 c p + d`.
pub(super) fn centred(group: &mut SlidingGroup, points: &[DVec3]) {
    let (Form::Sphere, Some(Slide::Turn { point: old, .. })) = (group.form, group.slides.first().copied())
    else {
        return;
    };
    let spread = |centre: DVec3| {
        let radius = mean(points.iter().map(|p| p.distance(centre)));
        points.iter().map(|p| (p.distance(centre) - radius).powi(2)).sum::<f64>()
    };
    // Coordinates about the old centre, so that little is lost in squares.
    let mut rows = Triangle::<5>::default();
    points.iter().map(|p| *p - old).for_each(|q| rows.push([q.x, q.y, q.z, 1.0, q.length_squared()]));
    let centre = rows.least_squares().map_or(old, |x| old + 0.5 * DVec3::new(x[0], x[1], x[2]));
    if centre.is_finite() && spread(centre) < spread(old) {
        for slide in &mut group.slides {
            if let Slide::Turn { point, .. } = slide {
                *point = centre;
            }
        }
    }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let n = values.len().max(1) as f64;
    values.sum::<f64>() / n
}

/// A cone if the profile (height, radius) is straight.
fn cone(profile: &[[f64; 2]], axis: DVec3, point: DVec3, coarse: f64) -> Option<Primitive> {
    let [h, r] = [0, 1].map(|k| mean(profile.iter().map(|p| p[k])));
    let moment = |i: usize, j: usize| mean(profile.iter().map(|p| (p[i] - [h, r][i]) * (p[j] - [h, r][j])));
    let (hh, hr, rr) = (moment(0, 0), moment(0, 1), moment(1, 1));
    let angle = 0.5 * (2.0 * hr).atan2(hh - rr);
    let (sin, cos) = angle.sin_cos();
    let along = hh * cos * cos + 2.0 * hr * sin * cos + rr * sin * sin;
    let across = profile.iter().map(|p| ((p[1] - r) * cos - (p[0] - h) * sin).abs()).fold(0.0, f64::max);
    let straight = across <= (SHAPE + coarse) * along.sqrt() && sin.abs() > SHAPE && cos.abs() > SHAPE;
    // The radius vanishes at the apex.
    let apex = point + axis * (h - r * cos / sin);
    straight.then(|| Primitive::Cone { half_angle: (sin / cos).atan().abs(), apex })
}

/// A torus if the profile (height, radius) is an arc about a centre away from the axis.
fn torus(profile: &[[f64; 2]], coarse: f64) -> Option<Primitive> {
    // Circle through points in the sense of least algebraic distance: x^2 + y^2 = a x + b y + c.
    let [h, r] = [0, 1].map(|k| mean(profile.iter().map(|p| p[k])));
    let mut matrix = glam::DMat3::ZERO;
    let mut right = DVec3::ZERO;
    for [x, y] in profile {
        let row = DVec3::new(x - h, y - r, 1.0);
        matrix += glam::DMat3::from_cols(row * row.x, row * row.y, row);
        right += row * (row.x * row.x + row.y * row.y);
    }
    let found = matrix.inverse() * right;
    let [x, y] = [0.5 * found.x, 0.5 * found.y];
    let minor = (found.z + x * x + y * y).sqrt();
    let off = profile.iter().map(|p| ((p[0] - h - x).hypot(p[1] - r - y) - minor).abs()).fold(0.0, f64::max);
    let major = r + y;
    let circle = minor.is_finite() && off <= (SHAPE + coarse) * minor && major > SHAPE * minor;
    circle.then_some(Primitive::Torus { major, minor })
}
