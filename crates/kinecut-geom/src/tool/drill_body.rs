//! The body of a drill for those who need a solid: its edge with the hollows filled.

use crate::base::Result;
use crate::geom::{EdgeProfile, EdgeSegment, Profile, ProfileElement};

/// Heights nearer than this are one step [mm].
const SAME: f64 = 1e-12;

/// The body swept by an edge and its flutes up to the height `top` [mm]: at each radius it begins at the lowest edge
/// from there outwards. What an edge leaves standing about the axis (a core, the nub under a gun drill) is inside it.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::tool::{DrillPoint, filled};
/// let gun = DrillPoint::Gun { apex: Some(5.0), outer_angle: 1.0, inner_angle: 1.2 }.edge(20.0).unwrap();
/// assert_eq!(filled(&gun, 50.0).unwrap().radius(0.0), 5.0); // flat within the apex
/// ```
///
/// # Errors
/// `KC0801` when `top` lies below the edge's highest point.
pub fn filled(edge: &EdgeProfile, top: f64) -> Result<Profile> {
    let mut elements: Vec<ProfileElement> = Vec::new();
    // From the outside inwards: only what lies lower than everything outside of it is seen from below.
    let mut low = f64::INFINITY;
    for segment in edge.segments().iter().rev() {
        let Some((from, to)) = rising_below(segment, low) else { continue };
        let (z0, z1) = (segment.height(from), segment.height(to));
        let element = match *segment {
            EdgeSegment::Line { .. } => ProfileElement::Cone { z0, r0: from, z1, r1: to },
            EdgeSegment::Arc { centre, radius, .. } => {
                ProfileElement::Torus { centre_radius: centre[0], centre_z: centre[1], radius, z0, z1 }
            }
        };
        if z1 > z0 {
            elements.push(element);
        }
        low = z0;
    }
    elements.reverse();
    let outer = edge.outer_radius();
    let mut joined: Vec<ProfileElement> = Vec::with_capacity(2 * elements.len() + 1);
    let (mut z, mut r) = (edge.extent()[0], 0.0);
    for element in elements {
        if element.bottom() > z + SAME {
            // A step, or a fall of the edge: straight up at the radius reached.
            let r0 = element.radius(element.bottom());
            let (lower, upper) = (if r > 0.0 { r } else { r0 }, element.bottom());
            joined.push(ProfileElement::Cone { z0: z, r0: lower, z1: upper, r1: lower });
        }
        (z, r) = (element.top(), element.radius(element.top()));
        joined.push(element);
    }
    joined.push(ProfileElement::Cone { z0: z, r0: outer, z1: top, r1: outer });
    Profile::new(joined)
}

/// The outer stretch of a segment that rises outwards and lies below a height, if there is one.
fn rising_below(segment: &EdgeSegment, low: f64) -> Option<(f64, f64)> {
    let [mut from, mut to] = segment.range();
    match *segment {
        EdgeSegment::Line { r, z } => {
            if z[1] <= z[0] {
                // It falls outwards, or is level: its outer end is its lowest point and covers the rest.
                return None;
            }
            if z[0] >= low {
                return None;
            }
            if z[1] > low {
                to = r[0] + (r[1] - r[0]) * (low - z[0]) / (z[1] - z[0]);
            }
        }
        EdgeSegment::Arc { centre, radius, .. } => {
            if centre[0] >= to {
                return None;
            }
            if centre[0] > from {
                from = centre[0];
            }
            let h = centre[1] - low;
            if segment.height(from) >= low {
                return None;
            }
            if segment.height(to) > low {
                to = centre[0] + ((radius - h) * (radius + h)).clamp(0.0, f64::INFINITY).sqrt();
            }
        }
    }
    (to > from).then_some((from, to))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::{DrillPoint, StepStage};

    /// The lowest edge from a radius outwards, by sampling.
    fn sampled(edge: &EdgeProfile, from: f64) -> f64 {
        let to = edge.outer_radius();
        (0..=4000)
            .map(|i| from + (to - from) * f64::from(i) / 4000.0)
            .filter_map(|r| edge.height(r))
            .fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn the_body_begins_at_the_lowest_edge_from_each_radius_outwards() {
        let deg = f64::to_radians;
        let pilot = StepStage { diameter: 4.0, length: 5.0, shoulder: deg(60.0) };
        let points = [
            DrillPoint::SinglePlane { angle: deg(118.0) },
            DrillPoint::CastIron { angle: deg(118.0), second: deg(70.0), third: deg(55.0), slot: 1.0 },
            DrillPoint::Rounded { radius: 14.0 },
            DrillPoint::CornerRadius { angle: deg(118.0), radius: 3.0 },
            DrillPoint::ThinnedWeb { angle: deg(118.0), flat: 1.5 },
            DrillPoint::Annular { core: 12.0 },
            DrillPoint::Flat,
            DrillPoint::Cannon { overlap: 0.4, edge_angle: deg(80.0) },
            DrillPoint::Gun { apex: Some(5.0), outer_angle: deg(60.0), inner_angle: deg(70.0) },
            DrillPoint::Gun { apex: Some(8.0), outer_angle: deg(60.0), inner_angle: deg(45.0) },
            DrillPoint::Gun { apex: Some(10.0), outer_angle: deg(60.0), inner_angle: deg(45.0) },
            DrillPoint::Stepped { angle: deg(120.0), stages: vec![pilot] },
        ];
        for point in points {
            let edge = point.edge(20.0).unwrap();
            let body = filled(&edge, 60.0).unwrap();
            assert_eq!((body.bottom(), body.top(), body.max_radius()), (0.0, 60.0, 10.0), "{point:?}");
            for i in 1..100 {
                // Just above the lowest edge the body is wider than the radius, just below it is not.
                let r = 0.1 * f64::from(i);
                let z = sampled(&edge, r);
                assert!(body.radius(z + 1e-3) > r - 1e-9, "{point:?} at {r}: {}", body.radius(z + 1e-3));
                assert!(z < 2e-3 || body.radius(z - 2e-3) < r + 1e-9, "{point:?} at {r}");
            }
        }
    }
}
