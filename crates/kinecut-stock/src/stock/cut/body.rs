//! A tool as a union of convex parts.
//!
//! Each element of a profile whose radius never falls is the foot of a part that goes on upwards with its largest
//! radius to the top of the profile. A part of this form is convex: a flat disc, then the foot (cone or torus), then a
//! cylinder; and the tool is the union of its parts. Elements inside the part below them add nothing.

use glam::DVec3;

use super::Spared;
use crate::geom::{Aabb, Profile, ProfileElement};

/// The shape of a foot between its flat disc and its cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Foot {
    /// None: a cylinder with a flat end.
    Flat,
    /// A cone that rises by `rise` mm per mm of radius.
    Cone {
        /// Slope.
        rise: f64,
    },
    /// A convex arc.
    Torus {
        /// Distance of the arc's centre from the axis [mm]; 0 for a ball.
        centre_radius: f64,
        /// Height of the centre [mm].
        centre_z: f64,
        /// Radius of the arc [mm].
        radius: f64,
    },
}

/// A convex part; heights above the tip [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ConvexPart {
    /// Shape of the foot.
    pub(super) foot: Foot,
    /// Height and radius of the flat disc.
    pub(super) z0: f64,
    pub(super) r0: f64,
    /// Height and radius where the cylinder begins.
    pub(super) z1: f64,
    pub(super) r1: f64,
    /// Height of the top.
    pub(super) top: f64,
}

impl ConvexPart {
    /// Lowest height of the part at a distance from the axis up to `r1`.
    pub(super) fn height(&self, rho: f64) -> f64 {
        if rho <= self.r0 {
            return self.z0;
        }
        match self.foot {
            Foot::Flat => self.z0,
            Foot::Cone { rise } => self.z0 + rise * (rho - self.r0),
            Foot::Torus { centre_radius, centre_z, radius } => {
                let d = rho - centre_radius;
                centre_z - ((radius - d) * (radius + d)).clamp(0.0, f64::INFINITY).sqrt()
            }
        }
    }

    /// Radius of the section at a height between `z0` and `top`.
    pub(super) fn radius(&self, z: f64) -> f64 {
        if z >= self.z1 {
            return self.r1;
        }
        match self.foot {
            Foot::Flat => self.r1,
            Foot::Cone { rise } => (self.r0 + (z - self.z0) / rise).clamp(self.r0, self.r1),
            Foot::Torus { centre_radius, centre_z, radius } => {
                let h = centre_z - z;
                let m = ((radius - h) * (radius + h)).clamp(0.0, f64::INFINITY).sqrt();
                (centre_radius + m).clamp(self.r0, self.r1)
            }
        }
    }

    /// Radial and axial component of the outward unit normal at the side, at a height between `z0` and `top`.
    pub(super) fn side_normal(&self, z: f64) -> (f64, f64) {
        if z >= self.z1 {
            return (1.0, 0.0);
        }
        match self.foot {
            Foot::Flat => (1.0, 0.0),
            Foot::Cone { rise } => (rise / rise.hypot(1.0), -1.0 / rise.hypot(1.0)),
            Foot::Torus { centre_z, radius, .. } => {
                let nz = ((z - centre_z) / radius).clamp(-1.0, 0.0);
                ((1.0 - nz * nz).sqrt(), nz)
            }
        }
    }

    /// True if the foot leaves the flat disc at an angle, so that there is an edge.
    pub(super) fn has_edge(&self) -> bool {
        match self.foot {
            Foot::Flat => true,
            Foot::Cone { .. } => self.r0 > 0.0,
            Foot::Torus { centre_radius, .. } => self.r0 > centre_radius,
        }
    }

    /// True if the foot meets the cylinder at an angle.
    pub(super) fn has_shoulder(&self) -> bool {
        match self.foot {
            Foot::Flat | Foot::Cone { .. } => true,
            Foot::Torus { centre_z, .. } => self.z1 < centre_z,
        }
    }

    /// The part made wider by `d`: at a distance `d` farther from the axis it begins as high as before.
    fn widened(&self, d: f64) -> ConvexPart {
        let foot = match self.foot {
            Foot::Torus { centre_radius, centre_z, radius } => {
                Foot::Torus { centre_radius: centre_radius + d, centre_z, radius }
            }
            foot => foot,
        };
        ConvexPart { foot, r0: self.r0 + d, r1: self.r1 + d, ..*self }
    }

    /// The part with both ends moved inwards by `d`: what is left of it wherever it is within `d` along its axis. `None` when nothing is left.
    fn shortened(&self, d: f64) -> Option<ConvexPart> {
        let foot = match self.foot {
            Foot::Torus { centre_radius, centre_z, radius } => {
                Foot::Torus { centre_radius, centre_z: centre_z + d, radius }
            }
            foot => foot,
        };
        let (z0, z1, top) = (self.z0 + d, self.z1 + d, self.top - d);
        ConvexPart { foot, z0, z1, top, ..*self }.up_to_top()
    }

    /// The part, of which what lies above its top is left out: its foot may have reached so far. `None` when nothing is left.
    fn up_to_top(self) -> Option<ConvexPart> {
        if self.top <= self.z0 || self.r1 <= 0.0 || self.r1 < self.r0 {
            return None;
        }
        match self.top < self.z1 {
            true => Some(ConvexPart { z1: self.top, r1: self.radius(self.top), ..self }),
            false => Some(self),
        }
    }

    /// The part with every face moved inwards by `d`; `None` when nothing is left.
    fn shrunk(&self, d: f64) -> Option<ConvexPart> {
        let (z0, r1, top) = (self.z0 + d, self.r1 - d, self.top - d);
        let part = match self.foot {
            Foot::Flat => ConvexPart { z0, r0: r1, z1: z0, r1, top, ..*self },
            Foot::Cone { rise } => {
                // Point on the cone moved along its normal, then met with the new floor and side.
                let (nx, nz) = self.side_normal(0.5 * (self.z0 + self.z1));
                let (r, z) = (self.r0 - nx * d, self.z0 - nz * d);
                let r0 = r + (z0 - z) / rise;
                let (z0, r0) = if r0 < 0.0 { (z0 - r0 * rise, 0.0) } else { (z0, r0) };
                ConvexPart { z0, r0, z1: z0 + (r1 - r0) * rise, r1, top, ..*self }
            }
            Foot::Torus { centre_radius, centre_z, radius } => {
                let radius = radius - d;
                let foot = Foot::Torus { centre_radius, centre_z, radius };
                let h = centre_z - z0;
                let r0 = centre_radius + ((radius - h) * (radius + h)).clamp(0.0, f64::INFINITY).sqrt();
                let part = ConvexPart { foot, z0, r0, z1: self.z1, r1, top };
                ConvexPart { z1: part.height(r1), ..part }
            }
        };
        let foot_left = !matches!(part.foot, Foot::Torus { radius, .. } if radius <= 0.0);
        if foot_left { part.up_to_top() } else { None }
    }
}

/// The parts of a rigid body of revolution.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RevolvedParts {
    /// From below.
    pub(super) parts: Vec<ConvexPart>,
    /// Largest radius.
    pub(super) radius: f64,
    /// Lowest height above the tip.
    pub(super) bottom: f64,
    /// Greatest height above the tip.
    pub(super) top: f64,
}

/// A box that holds all bodies of a tool with its tip at a point and an axis of unit length.
pub(super) fn bounds(tip: DVec3, axis: DVec3, bodies: &[&RevolvedParts]) -> Aabb {
    // A disc across the axis reaches so far along each coordinate, in radii.
    let wide = (DVec3::ONE - axis * axis).max(DVec3::ZERO).map(f64::sqrt);
    let mut all = Aabb::EMPTY;
    for body in bodies.iter().filter(|b| !b.parts.is_empty()) {
        let [low, high] = [body.bottom, body.top].map(|z| tip + axis * z);
        let by = wide * body.radius;
        all = all.union(Aabb { min: low.min(high) - by, max: low.max(high) + by });
    }
    all
}

impl RevolvedParts {
    /// The union of profiles, each at a height above the tip [mm].
    pub(super) fn new<'a>(profiles: impl IntoIterator<Item = (&'a Profile, f64)>) -> RevolvedParts {
        RevolvedParts::of(profiles.into_iter().flat_map(|(profile, z)| parts(profile, z)).collect())
    }

    fn of(parts: Vec<ConvexPart>) -> RevolvedParts {
        RevolvedParts {
            radius: parts.iter().map(|p| p.r1).fold(0.0, f64::max),
            bottom: parts.iter().map(|p| p.z0).fold(f64::INFINITY, f64::min),
            top: parts.iter().map(|p| p.top).fold(f64::NEG_INFINITY, f64::max),
            parts,
        }
    }

    /// The body with every face moved inwards.
    pub(super) fn shrunk(&self, d: f64) -> RevolvedParts {
        RevolvedParts::of(self.parts.iter().filter_map(|p| p.shrunk(d)).collect())
    }

    /// The body without what is spared.
    pub(super) fn sparing(&self, spared: Spared) -> RevolvedParts {
        if spared == Spared::NOTHING {
            return self.clone();
        }
        let part = |p: &ConvexPart| p.shrunk(spared.around)?.shortened(spared.along);
        RevolvedParts::of(self.parts.iter().filter_map(part).collect())
    }

    /// The body made wider by `d` on all sides, its heights as they are.
    pub(super) fn widened(&self, d: f64) -> RevolvedParts {
        RevolvedParts::of(self.parts.iter().map(|p| p.widened(d)).collect())
    }

    /// The widest part at a height, with its index; `None` above and below.
    pub(super) fn widest(&self, z: f64) -> Option<(usize, &ConvexPart)> {
        let mut best: Option<(usize, &ConvexPart)> = None;
        for (i, part) in self.parts.iter().enumerate().filter(|(_, p)| p.z0 <= z && z < p.top) {
            if best.is_none_or(|(_, b)| part.radius(z) > b.radius(z)) {
                best = Some((i, part));
            }
        }
        best
    }
}

/// The parts of one profile, lifted by `lift`.
fn parts(profile: &Profile, lift: f64) -> Vec<ConvexPart> {
    let top = profile.top() + lift;
    let mut widest = 0.0;
    let mut parts = Vec::new();
    for element in profile.elements() {
        let (z0, z1) = (element.bottom() + lift, element.top() + lift);
        let r1 = element.radius(element.top());
        if r1 <= widest {
            continue;
        }
        widest = r1;
        let flat = ConvexPart { foot: Foot::Flat, z0, r0: r1, z1: z0, r1, top };
        parts.push(match *element {
            ProfileElement::Cone { r0, .. } if z1 > z0 && r1 > r0 => {
                ConvexPart { foot: Foot::Cone { rise: (z1 - z0) / (r1 - r0) }, z0, r0, z1, r1, top }
            }
            ProfileElement::Torus { centre_radius, centre_z, radius, .. } if z1 > z0 && radius > 0.0 => {
                let foot = Foot::Torus { centre_radius, centre_z: centre_z + lift, radius };
                ConvexPart { foot, z0, r0: element.radius(element.bottom()), z1, r1, top }
            }
            ProfileElement::Cone { .. } | ProfileElement::Torus { .. } => flat,
        });
    }
    parts.retain(|p| p.top > p.z0);
    parts
}

/// The feature of a part that touches the end of the removed interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Touch {
    /// The flat disc.
    Disc,
    /// The foot.
    Foot,
    /// The lower edge, drawn along a slope.
    Edge,
    /// The flat top.
    Top,
    /// The upper edge, drawn along a slope.
    Rim,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apt() -> Profile {
        // A flat tip, a cone, a step, a quarter round, a cylinder.
        Profile::new(vec![
            ProfileElement::Cone { z0: 0.0, r0: 1.0, z1: 2.0, r1: 3.0 },
            ProfileElement::Cone { z0: 2.0, r0: 4.0, z1: 3.0, r1: 4.0 },
            ProfileElement::Torus { centre_radius: 4.0, centre_z: 5.0, radius: 2.0, z0: 3.0, z1: 5.0 },
            ProfileElement::Cone { z0: 5.0, r0: 6.0, z1: 20.0, r1: 6.0 },
        ])
        .unwrap()
    }

    #[test]
    fn parts_united_are_the_profile() {
        let body = RevolvedParts::new([(&apt(), 10.0)]);
        assert_eq!(body.parts.len(), 3);
        assert_eq!((body.radius, body.bottom, body.top), (6.0, 10.0, 30.0));
        for i in 0..2000 {
            let z = 10.0 + 20.0 * f64::from(i) / 2000.0;
            let (_, part) = body.widest(z).unwrap();
            assert!((part.radius(z) - apt().radius(z - 10.0)).abs() < 1e-12, "{z}");
        }
        assert!(body.widest(30.0).is_none() && body.widest(9.999).is_none());
    }

    #[test]
    fn height_and_radius_are_inverse_and_the_normal_is_square_to_them() {
        for part in &RevolvedParts::new([(&apt(), 0.0)]).parts {
            for i in 1..50 {
                let z = part.z0 + (part.z1 - part.z0) * f64::from(i) / 50.0;
                if part.z1 > part.z0 {
                    assert!((part.height(part.radius(z)) - z).abs() < 1e-12);
                    let d = 1e-6;
                    let slope = (part.radius(z + d) - part.radius(z - d)) / (2.0 * d);
                    let (nx, nz) = part.side_normal(z);
                    assert!((nx * slope + nz).abs() < 1e-6 && (nx.hypot(nz) - 1.0).abs() < 1e-12);
                }
            }
        }
    }

    /// Greatest error of the heights over radii of the body without what is spared along it.
    fn part_heights(body: &RevolvedParts, d: f64) -> f64 {
        let less = body.sparing(Spared { around: 0.0, along: d });
        let mut worst = (less.top - (body.top - d)).abs();
        for (part, own) in body.parts.iter().zip(&less.parts) {
            for i in 0..=100 {
                let rho = part.r1 * f64::from(i) / 100.0;
                worst = worst.max((own.height(rho) - part.height(rho) - d).abs());
            }
        }
        worst
    }

    #[test]
    fn a_part_that_ends_in_its_foot_is_shrunk_on_all_faces() {
        let d = 1e-3;
        let cone = Profile::new(vec![ProfileElement::Cone { z0: 0.0, r0: 0.25, z1: 5.0, r1: 5.25 }]).unwrap();
        let ball = ProfileElement::Torus { centre_radius: 0.0, centre_z: 3.0, radius: 3.0, z0: 0.0, z1: 3.0 };
        let ball = Profile::new(vec![ball]).unwrap();
        for profile in [cone, ball] {
            let body = RevolvedParts::new([(&profile, 0.0)]);
            let inner = body.shrunk(d);
            let ([part], [own]) = (&body.parts[..], &inner.parts[..]) else { panic!("{inner:?}") };
            assert!((own.top - (part.top - d)).abs() < 1e-12 && own.z1 <= own.top);
            // Its side runs on, `d` inside.
            for i in 0..100 {
                let z = own.z0 + (own.top - own.z0) * f64::from(i) / 100.0;
                let (nx, nz) = own.side_normal(z);
                let (r, z) = (own.radius(z) + nx * d, z + nz * d);
                assert!((part.radius(z) - r).abs() < 2e-6, "{z} {r}");
            }
            assert!(body.sparing(Spared { around: d, along: 1.0 }).top == part.top - d - 1.0);
        }
    }

    #[test]
    fn a_shrunk_part_lies_inside_by_the_distance() {
        let d = 0.01;
        for part in &RevolvedParts::new([(&apt(), 0.0)]).parts {
            let inner = part.shrunk(d).unwrap();
            for i in 0..=100 {
                let z = inner.z0 + (inner.z1 - inner.z0) * f64::from(i) / 100.0;
                let (nx, nz) = inner.side_normal(z);
                let (r, z) = (inner.radius(z) + nx * d, z + nz * d);
                assert!((part.radius(z) - r).abs() < 1e-9, "{part:?} {z} {r}");
            }
        }
        let shorter = part_heights(&RevolvedParts::new([(&apt(), 0.0)]), d);
        assert!(shorter < 1e-12, "{shorter}");
        let needle = RevolvedParts::new([(&Profile::cylinder(0.01, 5.0).unwrap(), 0.0)]);
        assert!(needle.shrunk(0.006).parts.is_empty());
    }
}
