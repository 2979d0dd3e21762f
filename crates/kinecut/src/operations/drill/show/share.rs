//! The share of a point's disc that lies below a surface: what is in material while the drill passes it.
//!
//! With the reference point at Z the point of the edge at radius r is in where S(x, y) >= Z + z(r). For planes and
//! cylinders that is an arc of the circle of radius r, known in closed form; over r it is summed in rings, which are cut
//! where it changes: a level face is passed by a whole ring at once.
//! For a cone on a plane the share has a closed form of its own, by which this is tested.

use std::f64::consts::PI;

use crate::drilling::{BoundarySurface, Ceiling, Mouth};
use crate::geom::EdgeProfile;

/// Rings in which a segment of the edge is summed.
const RINGS: u32 = 160;
/// A ring is halved where the share of its circles changes by more, so many times at most: the place of a step is then
/// known to a millionth of the ring.
const CHANGE: f64 = 0.02;
const HALVINGS: u32 = 20;

/// Sum over the circles of a segment's radii of a share, each by the area of its ring over pi [mm2].
fn over_rings([a, b]: [f64; 2], share: impl Fn(f64) -> f64) -> f64 {
    let step = (b - a) / f64::from(RINGS);
    let mut sum = 0.0;
    for i in 0..RINGS {
        let ends = [a + step * f64::from(i), a + step * f64::from(i + 1)];
        sum += over_ring(ends, ends.map(&share), HALVINGS, &share);
    }
    sum
}

fn over_ring([a, b]: [f64; 2], ends: [f64; 2], halvings: u32, share: &impl Fn(f64) -> f64) -> f64 {
    let middle = 0.5 * (a + b);
    let here = share(middle);
    if halvings == 0 || (ends[0] - here).abs() <= CHANGE && (here - ends[1]).abs() <= CHANGE {
        return here * (b - a) * (b + a);
    }
    over_ring([a, middle], [ends[0], here], halvings - 1, share)
        + over_ring([middle, b], [here, ends[1]], halvings - 1, share)
}

/// Share of the circle's half turn on which the cosine lies between two values.
fn between(low: f64, high: f64) -> f64 {
    let (low, high) = (low.clamp(-1.0, 1.0), high.clamp(-1.0, 1.0));
    if high > low { (low.acos() - high.acos()) / PI } else { 0.0 }
}

/// Share of the circle of radius r over which the surface is at least as high as h.
fn of_circle(surface: &BoundarySurface, r: f64, h: f64) -> f64 {
    // Share of the circle with |offset + u| <= w, u = r cos.
    let within = |offset: f64, w: f64| {
        if r > 0.0 {
            between((-w - offset) / r, (w - offset) / r)
        } else {
            f64::from(u8::from(offset.abs() <= w))
        }
    };
    let half = |radius: f64, d: f64| ((radius - d) * (radius + d)).clamp(0.0, f64::INFINITY).sqrt();
    match *surface {
        BoundarySurface::Plane { height, slope } => {
            let reach = slope.abs() * r;
            if reach > 0.0 { between((h - height) / reach, 1.0) } else { f64::from(u8::from(height >= h)) }
        }
        BoundarySurface::Ridge { radius, offset, height } => match h - height {
            d if d > radius => 0.0,
            d if d > 0.0 => within(offset, half(radius, d)),
            _ => within(offset, radius),
        },
        BoundarySurface::Valley { radius, offset, height } => match h - height {
            d if d > 0.0 => 0.0,
            d if d > -radius => within(offset, radius) - within(offset, half(radius, d)),
            _ => within(offset, radius),
        },
    }
}

/// Share of the edge's annulus that has passed a surface with the reference point at a Z: 0 before, 1 after it.
pub(super) fn passed(edge: &EdgeProfile, surface: &BoundarySurface, z: f64) -> f64 {
    let (mut sum, mut area) = (0.0, 0.0);
    for segment in edge.segments() {
        let [a, b] = segment.range();
        sum += over_rings([a, b], |r| of_circle(surface, r, z + segment.height(r)));
        area += b * b - a * a;
    }
    sum / area
}

/// The same of a level face with a recess about the axis.
pub(super) fn passed_recess(edge: &EdgeProfile, recess: &Mouth, face: &BoundarySurface, z: f64) -> f64 {
    let (mut sum, mut area) = (0.0, 0.0);
    for segment in edge.segments() {
        let [a, b] = segment.range();
        sum += over_rings([a, b], |r| {
            let top = recess.edge.height(r).map_or(face.height(0.0), |h| recess.height + h);
            f64::from(u8::from(top >= z + segment.height(r)))
        });
        area += b * b - a * a;
    }
    sum / area
}

/// The same of a face into which a hole from the other side opens: that hole's floor, and the face beside it.
pub(super) fn passed_ceiling(edge: &EdgeProfile, ceiling: &Ceiling, face: &BoundarySurface, z: f64) -> f64 {
    let (mut sum, mut area) = (0.0, 0.0);
    // On a hair that the edge is wider, the floor has the height that it has at its rim.
    let wide = ceiling.covers(edge);
    for segment in edge.segments() {
        let [a, b] = segment.range();
        sum += over_rings([a, b], |r| {
            let above = z + segment.height(r);
            let rim = ceiling.edge.outer_radius();
            let over = ceiling.edge.height(if wide { r.min(rim) } else { r });
            over.map_or_else(
                || of_circle(face, r, above),
                |h| f64::from(u8::from(ceiling.height - h >= above)),
            )
        });
        area += b * b - a * a;
    }
    sum / area
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drilling::{Cover, transient};
    use crate::tool::DrillPoint;

    #[test]
    fn in_a_spot_the_corner_is_in_material_first() {
        let spot = DrillPoint::SinglePlane { angle: 90f64.to_radians() }.edge(22.0).unwrap();
        let (mouth, face) =
            (Mouth { height: -11.0, edge: spot }, BoundarySurface::Plane { height: 0.0, slope: 0.0 });
        let k = 59f64.to_radians().tan().recip();
        // The ring from r to 10 is in where the cone of the spot, r - 11, stands over the drill, z + k r.
        for r in [2.0, 5.0, 9.0] {
            let z = (r - 11.0) - k * r;
            let share = passed_recess(&twist(), &mouth, &face, z);
            assert!((share - (100.0 - r * r) / 100.0).abs() < 1e-6, "{r} {share}");
        }
    }

    #[test]
    fn a_level_face_is_passed_ring_by_ring() {
        let k = 59f64.to_radians().tan().recip();
        let level = BoundarySurface::Plane { height: 1.0, slope: 0.0 };
        // Nearly level: the circle that just passes is wide by a hundredth of a millimetre.
        let tilted = BoundarySurface::Plane { height: 1.0, slope: 1e-3 };
        for i in 1..400 {
            let r = 0.025 * f64::from(i);
            let [share, about] = [&level, &tilted].map(|face| passed(&twist(), face, 1.0 - k * r));
            assert!((share - r * r / 100.0).abs() < 1e-6, "{r}: {share}");
            assert!((about - r * r / 100.0).abs() < 1e-4, "{r}: {about}");
        }
    }

    fn twist() -> EdgeProfile {
        DrillPoint::SinglePlane { angle: 118f64.to_radians() }.edge(20.0).unwrap()
    }

    #[test]
    fn a_cone_goes_into_an_inclined_plane_along_a_conic() {
        let (k, t): (f64, f64) = (59f64.to_radians().tan().recip(), 12f64.to_radians().tan());
        let face = BoundarySurface::Plane { height: 0.0, slope: t };
        for d in [0.5, 1.5, 3.0] {
            assert!(d <= 10.0 * (k - t), "the conic is inside the rim");
            let area = PI * d * d * k / (k * k - t * t).powf(1.5);
            let share = passed(&twist(), &face, -d);
            assert!((share - area / (100.0 * PI)).abs() < 2e-4, "{d}: {share}");
        }
    }

    #[test]
    fn it_agrees_with_a_grid_over_the_disc_and_changes_only_within_the_transient() {
        let surfaces = [
            BoundarySurface::Ridge { radius: 40.0, offset: 7.0, height: -3.0 },
            BoundarySurface::Valley { radius: 14.0, offset: -2.0, height: 5.0 },
            BoundarySurface::Plane { height: 1.0, slope: -1.0 },
        ];
        let points = [
            DrillPoint::Rounded { radius: 14.0 },
            DrillPoint::SlottedChisel { angle: 2.0, slot: 2.0 },
            DrillPoint::Flat,
        ];
        for (surface, point) in surfaces.iter().zip(points) {
            let edge = point.edge(20.0).unwrap();
            let t = transient(&edge, surface, Cover::Whole).unwrap();
            assert!(passed(&edge, surface, t.first + 1e-6) < 1e-12);
            assert!(passed(&edge, surface, t.last - 1e-6) > 1.0 - 1e-12);
            let z = 0.5 * (t.first + t.last);
            let (mut all, mut inside) = (0, 0);
            for i in -200..200 {
                for j in -200..200 {
                    let (x, y) = (0.05 * (f64::from(i) + 0.5), 0.05 * (f64::from(j) + 0.5));
                    let Some(height) = edge.height(x.hypot(y)) else { continue };
                    all += 1;
                    inside += u32::from(surface.height(x) >= z + height);
                }
            }
            let grid = f64::from(inside) / f64::from(all);
            let share = passed(&edge, surface, z);
            assert!((share - grid).abs() < 2e-3, "{point:?}: {share}, grid {grid}");
        }
    }

    #[test]
    fn a_bore_beside_the_axis_is_passed_in_part() {
        let roof = BoundarySurface::Ridge { radius: 6.0, offset: 9.0, height: -40.0 };
        let share = passed(&twist(), &roof, -100.0);
        assert!(share > 0.1 && share < 0.9, "{share}");
    }
}
