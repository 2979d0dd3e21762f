//! First and last contact of an edge with a surface, seen in the section along u through the tool axis.

use crate::drilling::{BoundarySurface, Side, Transient};

/// A point of contact [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ContactPoint {
    /// u and height in the section.
    pub(super) at: [f64; 2],
    /// Radius of the edge there.
    pub(super) radius: f64,
    /// Distance before and behind the section.
    pub(super) beside: f64,
}

/// Below this a point lies in the section [mm].
const IN_SECTION: f64 = 1e-6;

/// First and last contact of a transient at its surface.
pub(super) fn contacts(surface: &BoundarySurface, t: &Transient) -> [ContactPoint; 2] {
    [contact(surface, t.first_radius, true), contact(surface, t.last_radius, false)]
}

/// The point of a circle about the tool axis where the surface is highest or lowest.
fn contact(surface: &BoundarySurface, radius: f64, highest: bool) -> ContactPoint {
    let side = |up: bool| if up { radius } else { -radius };
    let u = match *surface {
        BoundarySurface::Plane { slope: 0.0, .. } => radius,
        BoundarySurface::Plane { slope, .. } => side((slope > 0.0) == highest),
        // A ridge is highest nearest to its axis, a valley farthest from it.
        BoundarySurface::Ridge { offset, .. } if highest => (-offset).clamp(-radius, radius),
        BoundarySurface::Valley { offset, .. } if !highest => (-offset).clamp(-radius, radius),
        BoundarySurface::Ridge { offset, .. } | BoundarySurface::Valley { offset, .. } => side(offset >= 0.0),
    };
    let beside = ((radius - u) * (radius + u)).clamp(0.0, f64::INFINITY).sqrt();
    let beside = if beside < IN_SECTION { 0.0 } else { beside };
    ContactPoint { at: [u, surface.height(u)], radius, beside }
}

impl ContactPoint {
    /// Name of the place for a person.
    pub(super) fn place(&self, outer: f64) -> &'static str {
        if self.radius < IN_SECTION {
            "tip"
        } else if self.radius > outer - IN_SECTION {
            "corner"
        } else {
            "edge"
        }
    }

    /// A sentence when the point does not lie in the section.
    pub(super) fn remark(&self, which: &str, side: Side) -> Option<String> {
        (self.beside > 0.0).then(|| {
            format!(
                "The {which} of the {} lies {:.3} mm before and behind the section; it is drawn as projected.",
                side.word(),
                self.beside
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drilling::{Cover, transient};
    use crate::tool::DrillPoint;
    use proptest::prelude::*;

    fn surfaces() -> impl Strategy<Value = BoundarySurface> {
        let plane = (-2.0..2.0f64).prop_map(|slope| BoundarySurface::Plane { height: 3.0, slope });
        let round = (12.0..60.0f64, -1.0..1.0f64, any::<bool>()).prop_map(|(radius, share, ridge)| {
            let (offset, height) = (share * (radius - 10.0), -7.0);
            if ridge {
                BoundarySurface::Ridge { radius, offset, height }
            } else {
                BoundarySurface::Valley { radius, offset, height }
            }
        });
        prop_oneof![plane, round]
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn the_edge_stands_on_the_surface_at_both_contacts(surface in surfaces(), angle in 60.0..175.0f64) {
            let edge = DrillPoint::SinglePlane { angle: angle.to_radians() }.edge(20.0).unwrap();
            let t = transient(&edge, &surface, Cover::Whole).unwrap();
            let [first, last] = contacts(&surface, &t);
            let height = |r: f64| edge.height(r).unwrap();
            prop_assert!((first.at[1] - t.first - height(t.first_radius)).abs() < 1e-9);
            prop_assert!((last.at[1] - t.last - height(t.last_radius)).abs() < 1e-9);
            prop_assert!((first.at[0].hypot(first.beside) - first.radius).abs() < 1e-5);
        }
    }

    #[test]
    fn the_rim_leaves_a_shaft_beside_the_section() {
        let edge = DrillPoint::SinglePlane { angle: 118f64.to_radians() }.edge(20.0).unwrap();
        let shaft = BoundarySurface::Valley { radius: 40.0, offset: 6.0, height: 0.0 };
        let t = transient(&edge, &shaft, Cover::Whole).unwrap();
        let [_, last] = contacts(&shaft, &t);
        assert_eq!((last.at, last.beside), ([-6.0, -40.0], 8.0));
        assert!(last.remark("last point", Side::Exit).unwrap().contains("8.000 mm before and behind"));
    }
}
