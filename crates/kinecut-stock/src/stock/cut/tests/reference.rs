//! The reference: signed distance of a point from a tool at a pose, and its minimum over the poses of a path.

use glam::{DVec2, DVec3};

use crate::geom::{Curve, Profile, ProfileElement};

/// A tool by formulas of its own.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    Flat {
        r: f64,
        top: f64,
    },
    Bull {
        r: f64,
        corner: f64,
        top: f64,
    },
    /// Tip radius, radius at the height `h`, then a cylinder.
    Cone {
        r0: f64,
        r1: f64,
        h: f64,
        top: f64,
    },
    /// A thin pilot under a bull-nose that begins at the height `step`.
    Stepped {
        pilot: f64,
        step: f64,
        r: f64,
        corner: f64,
        top: f64,
    },
}

impl Shape {
    pub(super) fn profile(self) -> Profile {
        match self {
            Shape::Flat { r, top } => Profile::cylinder(2.0 * r, top),
            Shape::Bull { r, corner, top } => Profile::bull_nose(2.0 * r, corner, top),
            Shape::Cone { r0, r1, h, top } => Profile::new(vec![
                ProfileElement::Cone { z0: 0.0, r0, z1: h, r1 },
                ProfileElement::Cone { z0: h, r0: r1, z1: top, r1 },
            ]),
            Shape::Stepped { pilot, step, r, corner, top } => Profile::new(vec![
                ProfileElement::Cone { z0: 0.0, r0: pilot, z1: step, r1: pilot },
                ProfileElement::Torus {
                    centre_radius: r - corner,
                    centre_z: step + corner,
                    radius: corner,
                    z0: step,
                    z1: step + corner,
                },
                ProfileElement::Cone { z0: step + corner, r0: r, z1: top, r1: r },
            ]),
        }
        .unwrap()
    }

    /// Signed distance in the half plane (distance from the axis, height above the tip), outside positive; outside
    /// corners it is a lower bound with the right sign.
    fn distance(self, rho: f64, z: f64) -> f64 {
        let ends = |bottom: f64, top: f64| (bottom - z).max(z - top);
        match self {
            Shape::Flat { r, top } => (rho - r).max(ends(0.0, top)),
            Shape::Bull { r, corner, top } => {
                let side = if z < corner && rho > r - corner {
                    (rho - (r - corner)).hypot(z - corner) - corner
                } else {
                    rho - r
                };
                side.max(ends(0.0, top))
            }
            Shape::Cone { r0, r1, h, top } => {
                let slant = ((rho - r0) * h - (r1 - r0) * z) / h.hypot(r1 - r0);
                slant.max(rho - r1).max(ends(0.0, top))
            }
            Shape::Stepped { pilot, step, r, corner, top } => {
                let upper = Shape::Bull { r, corner, top: top - step };
                (rho - pilot).max(ends(0.0, top)).min(upper.distance(rho, z - step))
            }
        }
    }

    /// Signed distance of `p` from the tool with its tip at `tip` and its axis along `axis`.
    pub(super) fn at(self, p: DVec3, tip: DVec3, axis: DVec3) -> f64 {
        let v = p - tip;
        let z = v.dot(axis);
        self.distance((v - axis * z).length(), z)
    }
}

/// Tip and axis of a tool at a part of its way, from 0 to 1.
type Poses = Box<dyn Fn(f64) -> (DVec3, DVec3)>;

/// The body that a tool sweeps, by sampled poses.
pub(super) struct Swept {
    shape: Shape,
    poses: Poses,
    /// Most that a point of the tool moves from sample to sample.
    step: f64,
    samples: Vec<(DVec3, DVec3)>,
}

impl Swept {
    /// Of a tool that keeps its axis.
    pub(super) fn new(shape: Shape, curve: Curve, axis: DVec3) -> Swept {
        let length = curve.length();
        Swept::of(shape, Box::new(move |t| (curve.at(length * t).p, axis)), length)
    }

    /// Of any motion; `way` is a bound on the way of any point of the tool [mm].
    pub(super) fn of(shape: Shape, poses: Poses, way: f64) -> Swept {
        const SAMPLES: u32 = 128;
        let samples = (0..=SAMPLES).map(|i| poses(f64::from(i) / f64::from(SAMPLES))).collect();
        Swept { shape, poses, step: way / f64::from(SAMPLES), samples }
    }

    fn samples(&self, p: DVec3) -> Vec<f64> {
        self.samples.iter().map(|(tip, axis)| self.shape.at(p, *tip, *axis)).collect()
    }

    /// True if a point is inside; `None` when it is nearer to the boundary than the samples can tell.
    pub(super) fn holds(&self, p: DVec3, close: f64) -> Option<bool> {
        let least = self.samples(p).into_iter().fold(f64::INFINITY, f64::min);
        // The distance changes by no more than half a step from a sample.
        let told = least < -close || least > self.step + close;
        let known = if told { least } else { self.distance(p) };
        (known.abs() >= close).then_some(known < 0.0)
    }

    /// The least signed distance of a point over all poses: negative inside the swept body.
    pub(super) fn distance(&self, p: DVec3) -> f64 {
        const SECTION: f64 = 0.618_033_988_749_895;
        let value = |t: f64| {
            let (tip, axis) = (self.poses)(t);
            self.shape.at(p, tip, axis)
        };
        let samples = self.samples(p);
        let last = samples.len() - 1;
        let mut best = samples.iter().copied().fold(f64::INFINITY, f64::min);
        let least = best;
        for i in 0..=last {
            let (l, r) = (i.saturating_sub(1), (i + 1).min(last));
            if samples[i] <= samples[l] && samples[i] <= samples[r] && samples[i] < least + self.step {
                let (mut a, mut b) = (l as f64 / last as f64, r as f64 / last as f64);
                let (mut m, mut n) = (b - SECTION * (b - a), a + SECTION * (b - a));
                let (mut at_m, mut at_n) = (value(m), value(n));
                for _ in 0..36 {
                    if at_m < at_n {
                        (b, n, at_n) = (n, m, at_m);
                        m = b - SECTION * (b - a);
                        at_m = value(m);
                    } else {
                        (a, m, at_m) = (m, n, at_n);
                        n = a + SECTION * (b - a);
                        at_n = value(n);
                    }
                }
                best = best.min(at_m).min(at_n);
            }
        }
        best
    }
}

/// Numbers that repeat: a linear congruential generator.
pub(in crate::stock::cut) struct Random(pub(in crate::stock::cut) u64);

impl Random {
    pub(in crate::stock::cut) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(in crate::stock::cut) fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    pub(in crate::stock::cut) fn plane(&mut self, reach: f64) -> DVec2 {
        DVec2::new(self.within(-reach, reach), self.within(-reach, reach))
    }
}
