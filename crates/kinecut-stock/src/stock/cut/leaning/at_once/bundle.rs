//! Swept parts side by side, so that many of them are asked about a cell at once: [`SweptPart::reaches`] of each, without branches.

use glam::DVec3;
use pulp::{Arch, NullaryFnOnce};

use super::super::super::body::{ConvexPart, Foot};
use super::near::SweptPart;

/// Numbers of a swept part: place and axis of the tool in the middle of the time, their rates, its turn, and its bends.
pub(super) const NUMBERS: usize = 15;

/// Swept parts, number by number.
#[derive(Default)]
pub(super) struct Bundle {
    arch: Arch,
    /// Their indices.
    pub(super) list: Vec<u32>,
    /// The round foot of all of them, if it is one, with floor, top and radius.
    shape: Option<Shape>,
    numbers: [Vec<f64>; NUMBERS],
    /// Most that each reaches beyond the centre of the cell that was asked about [mm].
    pub(super) reaches: Vec<f64>,
}

/// A part whose foot is an arc; of a flat end one of no radius.
#[derive(Clone, Copy)]
pub(super) struct Shape {
    floor: f64,
    top: f64,
    pub(super) side: f64,
    /// Distance of the arc's centre from the axis, its height, and the arc's radius [mm].
    out: f64,
    up: f64,
    pub(super) radius: f64,
}

impl Shape {
    pub(super) fn of(part: &ConvexPart) -> Option<Shape> {
        let (out, up, radius) = match part.foot {
            Foot::Flat => (part.r1, part.z0, 0.0),
            Foot::Torus { centre_radius, centre_z, radius } => (centre_radius, centre_z, radius),
            Foot::Cone { .. } => return None,
        };
        Some(Shape { floor: part.z0, top: part.top, side: part.r1, out, up, radius })
    }

    /// The gauge at a distance from the axis and a height, and its radial and axial gradient; beside the sector of the arc's normals
    /// as its ends are.
    #[inline(always)]
    pub(super) fn gauge(&self, rho: f64, height: f64) -> (f64, f64, f64) {
        let (out, up) = (rho - self.out, height - self.up);
        let (a, b) = (if out > 0.0 { out } else { 0.0 }, if up < 0.0 { up } else { 0.0 });
        let h = (a * a + b * b).sqrt();
        let round = h > 0.0;
        let aside = out > -up;
        let beside = if aside { out } else { -up };
        let mut value = if round { h } else { beside } - self.radius;
        let mut radial = if round { a / h } else { f64::from(u8::from(aside)) };
        let mut axial = if round { b / h } else { f64::from(u8::from(aside)) - 1.0 };
        let faces =
            [(self.floor - height, 0.0, -1.0), (height - self.top, 0.0, 1.0), (rho - self.side, 1.0, 0.0)];
        for (of, r, u) in faces {
            let more = of > value;
            value = if more { of } else { value };
            radial = if more { r } else { radial };
            axial = if more { u } else { axial };
        }
        (value, radial, axial)
    }

    /// Most that a part of this shape, of which the numbers are, reaches beyond the centre of what is no farther from it than `radius`.
    #[inline(always)]
    pub(super) fn reach(&self, numbers: &[f64; NUMBERS], centre: [f64; 3], radius: f64) -> f64 {
        let [px, py, pz, ux, uy, uz, vx, vy, vz, wx, wy, wz, turn, bend, by_reach] = *numbers;
        let (x, y, z) = (centre[0] - px, centre[1] - py, centre[2] - pz);
        let height = x * ux + y * uy + z * uz;
        let (bx, by, bz) = (x - ux * height, y - uy * height, z - uz * height);
        let rho = (bx * bx + by * by + bz * bz).sqrt();
        let (value, radial, axial) = self.gauge(rho, height);
        // Velocity of the tool there, and how fast the gauge changes.
        let tilt = x * wx + y * wy + z * wz;
        let qx = vx + wx * height - ux * tilt;
        let qy = vy + wy * height - uy * tilt;
        let qz = vz + wz * height - uz * tilt;
        let across = if rho > 0.0 { (bx * qx + by * qy + bz * qz) / rho } else { 0.0 };
        let rate = radial * across + axial * (ux * qx + uy * qy + uz * qz);
        let far = (x * x + y * y + z * z).sqrt() + radius + 2.0 * self.side;
        0.5 * (rate.abs() + radius * turn) + 2.0 * (bend + by_reach * far) - value
    }
}

impl Bundle {
    /// Takes the place of what was there.
    pub(super) fn fill(&mut self, swept: &[SweptPart], list: &[u32]) {
        self.list.clear();
        self.list.extend_from_slice(list);
        let part = list.first().map(|i| swept[*i as usize].part);
        let alike = part.filter(|part| list.iter().all(|i| std::ptr::eq(swept[*i as usize].part, *part)));
        self.shape = alike.and_then(Shape::of);
        if self.shape.is_some() {
            for numbers in &mut self.numbers {
                numbers.resize(list.len(), 0.0);
            }
            for (n, i) in list.iter().enumerate() {
                for (of, number) in self.numbers.iter_mut().zip(swept[*i as usize].numbers()) {
                    of[n] = number;
                }
            }
        }
        self.reaches.resize(list.len(), 0.0);
    }

    /// Asks all about what is no farther than `radius` from a place.
    pub(super) fn ask(&mut self, swept: &[SweptPart], centre: DVec3, radius: f64) {
        let Some(shape) = self.shape else {
            for (reach, i) in self.reaches.iter_mut().zip(&self.list) {
                *reach = swept[*i as usize].reach(centre, radius);
            }
            return;
        };
        let numbers = self.numbers.each_ref().map(|n| &n[..]);
        self.arch.dispatch(Reaches { shape, numbers, centre, radius, reaches: &mut self.reaches });
    }
}

/// See [`Bundle::ask`].
struct Reaches<'a> {
    shape: Shape,
    numbers: [&'a [f64]; NUMBERS],
    centre: DVec3,
    radius: f64,
    reaches: &'a mut [f64],
}

impl NullaryFnOnce for Reaches<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Reaches { shape: part, numbers, centre, radius, reaches } = self;
        let [px, py, pz, ux, uy, uz, vx, vy, vz, wx, wy, wz, turn, bend, by_reach] =
            numbers.map(|n| &n[..reaches.len()]);
        for i in 0..reaches.len() {
            let numbers = [
                px[i],
                py[i],
                pz[i],
                ux[i],
                uy[i],
                uz[i],
                vx[i],
                vy[i],
                vz[i],
                wx[i],
                wy[i],
                wz[i],
                turn[i],
                bend[i],
                by_reach[i],
            ];
            reaches[i] = part.reach(&numbers, [centre.x, centre.y, centre.z], radius);
        }
    }
}
