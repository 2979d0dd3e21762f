//! An element of a contour in the plane of compensation, and its parallel curve.
//!
//! For the compensation only. A curve of the program is split into what happens in the plane (line, arc, involute)
//! and the movement across it, which stays in proportion to the planar arc length. Parallels are exact and of the
//! same kind: a line, an arc about the same centre, an involute of the same base circle.

use glam::{DVec2, DVec3};

use crate::geom::{Arc, Curve, CurveKind, InvoluteRecord, Line};

/// Cosine between an arc's axis and the plane's normal from which they are parallel: rounding of unit vectors.
const PARALLEL: f64 = 1.0 - 1e-9;

/// A planar element. Arc lengths `s` below are its own [mm]; values outside `[0, length]` lie on its continuation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Flat {
    /// A line that is not a point.
    Line { start: DVec2, end: DVec2 },
    /// An arc, counter-clockwise for a positive sweep.
    Arc { start: DVec2, centre: DVec2, sweep: f64 },
    /// A circle involute.
    Involute(InvoluteRecord),
}

/// Kind of a curve of the program for the compensation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// It moves in the plane.
    Flat(Flat),
    /// It moves across the plane only, or not at all.
    Across,
    /// It moves in the plane on a spiral or cubic, whose parallel has no exact form here.
    Spiral,
    /// It lies in another plane.
    OtherPlane,
}

impl Flat {
    /// The planar part of a curve.
    pub(super) fn of(curve: &Curve) -> Shape {
        match curve.kind() {
            CurveKind::Line(line) => {
                let (start, end) = (line.start.truncate(), line.end.truncate());
                if start == end { Shape::Across } else { Shape::Flat(Flat::Line { start, end }) }
            }
            CurveKind::Arc(arc) if arc.axis.z.abs() >= PARALLEL => Shape::Flat(Flat::Arc {
                start: arc.start.truncate(),
                centre: arc.centre.truncate(),
                sweep: arc.sweep * arc.axis.z.signum(),
            }),
            CurveKind::Involute { record, frame, .. }
                if frame.vector(DVec3::X) == DVec3::X && frame.vector(DVec3::Z) == DVec3::Z =>
            {
                Shape::Flat(Flat::Involute(record.shifted(frame.point(DVec3::ZERO).truncate())))
            }
            CurveKind::Spiral { frame, .. } | CurveKind::Bezier { frame, .. }
                if frame.vector(DVec3::Z) == DVec3::Z =>
            {
                Shape::Spiral
            }
            _ => Shape::OtherPlane,
        }
    }

    /// The curve in space from height `z`, rising by `rise` [mm].
    pub(super) fn lifted(&self, z: f64, rise: f64) -> Curve {
        match *self {
            Flat::Line { start, end } => Line { start: start.extend(z), end: end.extend(z + rise) }.into(),
            Flat::Arc { start, centre, sweep } => {
                Arc { start: start.extend(z), centre: centre.extend(z), axis: DVec3::Z, sweep, rise }.into()
            }
            Flat::Involute(record) => Curve::involute(record, z, rise),
        }
    }

    /// Arc length [mm].
    pub(super) fn length(&self) -> f64 {
        match *self {
            Flat::Line { start, end } => start.distance(end),
            Flat::Arc { start, centre, sweep } => start.distance(centre) * sweep.abs(),
            Flat::Involute(record) => record.length(),
        }
    }

    /// Point and unit tangent at arc length `s` [mm].
    pub(super) fn at(&self, s: f64) -> (DVec2, DVec2) {
        match *self {
            Flat::Line { start, end } => {
                let t = (end - start).normalize_or_zero();
                (start + t * s, t)
            }
            Flat::Arc { start, centre, sweep } => {
                let radial = start - centre;
                let turned = DVec2::from_angle(sweep.signum() * s / radial.length()).rotate(radial);
                (centre + turned, turned.perp().normalize_or_zero() * sweep.signum())
            }
            Flat::Involute(record) => {
                let jet = record.at(s);
                (jet.p, jet.d1)
            }
        }
    }

    /// Last point and unit tangent there; the point of a line is exact.
    pub(super) fn end(&self) -> (DVec2, DVec2) {
        let (p, t) = self.at(self.length());
        match *self {
            Flat::Line { end, .. } => (end, t),
            _ => (p, t),
        }
    }

    /// Signed curvature at arc length `s` [1/mm], positive to the left.
    pub(super) fn curvature(&self, s: f64) -> f64 {
        match *self {
            Flat::Line { .. } => 0.0,
            Flat::Arc { start, centre, sweep } => sweep.signum() / start.distance(centre),
            Flat::Involute(record) => record.at(s).curvature,
        }
    }

    /// Least radius of curvature on the side `d` lies on (left for positive) [mm]; infinite when it bends away.
    pub(super) fn inner_radius(&self, d: f64) -> f64 {
        let radius = match *self {
            Flat::Line { .. } => return f64::INFINITY,
            Flat::Arc { start, centre, sweep } => sweep.signum() * start.distance(centre),
            Flat::Involute(record) if record.is_line() => return f64::INFINITY,
            Flat::Involute(record) => {
                let (a, b) = (record.start_radius().abs(), record.end_radius().abs());
                record.sense() * if a < b { a } else { b }
            }
        };
        let bends = match *self {
            Flat::Involute(record) => record.sense(),
            _ => radius.signum(),
        };
        if bends * d > 0.0 { radius.abs() } else { f64::INFINITY }
    }

    /// The parallel at `d` to the left of travel [mm]; `None` when [`Flat::inner_radius`] is not larger.
    pub(super) fn offset(&self, d: f64) -> Option<Flat> {
        if self.inner_radius(d) <= d.abs() {
            return None;
        }
        Some(match *self {
            Flat::Line { start, end } => {
                let by = (end - start).normalize_or_zero().perp() * d;
                Flat::Line { start: start + by, end: end + by }
            }
            Flat::Arc { start, centre, sweep } => {
                let radial = start - centre;
                let radius = radial.length();
                Flat::Arc { start: centre + radial * ((radius - sweep.signum() * d) / radius), centre, sweep }
            }
            Flat::Involute(record) => Flat::Involute(record.offset(d).ok()?),
        })
    }

    /// The part from arc length `a` to `b` [mm], which may lie on the continuation. `None` when nothing is left of
    /// it, or the continuation passes a cusp.
    pub(super) fn part(&self, a: f64, b: f64) -> Option<Flat> {
        if a == 0.0 && b == self.length() {
            return Some(*self);
        }
        if b - a <= 0.0 {
            return None;
        }
        Some(match *self {
            Flat::Line { start, end } => {
                let t = (end - start).normalize_or_zero();
                let whole = b == self.length();
                Flat::Line { start: start + t * a, end: if whole { end } else { start + t * b } }
            }
            Flat::Arc { centre, sweep, .. } => {
                let share = (b - a) / self.length();
                Flat::Arc { start: self.at(a).0, centre, sweep: sweep * share }
            }
            Flat::Involute(record) => {
                let start = record.at(a);
                let radius = |s: f64| record.radius(s);
                let part = InvoluteRecord::new(b - a, start.p.to_array(), start.angle, radius(a), radius(b));
                Flat::Involute(part.ok()?)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn any_flat() -> impl Strategy<Value = Flat> {
        let place = (-20.0..20.0f64, -20.0..20.0f64);
        let line = (place.clone(), 0.0..6.3f64, 0.1..30.0f64).prop_map(|((x, y), angle, length)| {
            let start = DVec2::new(x, y);
            Flat::Line { start, end: start + DVec2::from_angle(angle) * length }
        });
        let arc = (place, 0.0..6.3f64, 0.5..30.0f64, 0.1..6.2f64, any::<bool>()).prop_map(
            |((x, y), angle, radius, sweep, ccw)| {
                let centre = DVec2::new(x, y);
                let start = centre + DVec2::from_angle(angle) * radius;
                Flat::Arc { start, centre, sweep: if ccw { sweep } else { -sweep } }
            },
        );
        let involute = ((1.0..9.0f64, 0.05..6.0f64, 0.2..3.0f64), 0.0..6.3f64, any::<bool>(), any::<bool>())
            .prop_map(|((a, turned, r), angle, cw, inward)| {
                let b = a + turned;
                let plain =
                    InvoluteRecord::new(0.5 * r * (b - a) * (b + a), [3.0, -1.0], angle, r * a, r * b)
                        .unwrap();
                let plain = if cw { plain.mirrored() } else { plain };
                Flat::Involute(if inward { plain.reversed() } else { plain })
            });
        prop_oneof![line, arc, involute]
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn a_parallel_lies_square_to_the_element_at_its_ends(flat in any_flat(), share in -0.9..0.9f64) {
            let room = flat.inner_radius(share);
            let d = share * if room < 5.0 { room } else { 5.0 };
            let moved = flat.offset(d).unwrap();
            let ends = [(flat.at(0.0), moved.at(0.0)), (flat.end(), moved.end())];
            for ((p, t), (q, u)) in ends {
                prop_assert!((q - p - t.perp() * d).length() < 1e-10, "{flat:?} {d}");
                prop_assert!((t - u).length() < 1e-10);
            }
        }

        #[test]
        fn a_part_is_on_the_element_also_beyond_its_ends(flat in any_flat(), a in -0.02..0.4f64, b in 0.6..1.02f64) {
            let length = flat.length();
            let part = flat.part(a * length, b * length).unwrap();
            prop_assert!((part.length() - (b - a) * length).abs() < 1e-10 * length);
            for u in [0.0, 0.3, 1.0] {
                let s = u * part.length();
                prop_assert!((part.at(s).0 - flat.at(a * length + s).0).length() < 1e-9, "{flat:?}");
            }
        }
    }

    #[test]
    fn an_arc_is_refused_from_its_own_radius_on_and_only_inside() {
        let arc = Flat::Arc { start: DVec2::X * 2.0, centre: DVec2::ZERO, sweep: 1.0 };
        assert!(arc.offset(1.999).is_some() && arc.offset(-50.0).is_some());
        assert!(arc.offset(2.0).is_none() && arc.offset(2.1).is_none());
        assert_eq!(arc.inner_radius(0.1), 2.0);
        let spiral = Flat::Involute(InvoluteRecord::new(10.0, [0.0; 2], 0.0, 0.0, 4.0).unwrap());
        assert!(spiral.offset(1e-6).is_none() && spiral.offset(-1.0).is_some());
    }
}
