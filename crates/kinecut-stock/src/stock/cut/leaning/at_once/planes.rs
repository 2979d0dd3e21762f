//! The tangent planes of swept parts about a cell, and which part may reach deepest beyond a place.
//!
//! A plane bounds what a part may reach. The part that does reach deepest comes out of guesses: of the planes without their slack, which
//! tell where about the line will end, and of the gauges near there, with their curvature and the best of the time (`Nearby`).

use glam::DVec3;
use pulp::{Arch, NullaryFnOnce};

use super::about::{NUMBERS, PLANE, about};
use super::bundle::Shape;
use super::cells::Cell;
use super::lanes::{LANES, WAY, put};
use super::near::{Nearby, SweptPart, Tangent};

/// Reach beyond an end of material that counts as none [mm]: a fifth of an end point's rounding.
const NOTHING: f64 = 2e-6;

/// Planes, coordinate by coordinate.
#[derive(Default)]
pub(super) struct Planes {
    arch: Arch,
    normals: [Vec<f64>; 3],
    /// Bounds on the reaches of the parts beyond the centre [mm].
    reaches: Vec<f64>,
    /// Differences of bounds and guesses [mm].
    slack: Vec<f64>,
    /// The bounds while a line is cut: without end below the centre for a part that had its turn.
    open: Vec<f64>,
    /// Guesses at the reaches beyond a place [mm]; without end below it where the bound says that there is none.
    likely: Vec<f64>,
    /// The gauges near the centre, number by number, and what they are at a place.
    numbers: [Vec<f64>; NUMBERS],
    gauges: Vec<f64>,
}

impl Tangent {
    fn numbers(&self) -> [f64; PLANE] {
        let n = self.normal;
        [n.x, n.y, n.z, self.reach, self.reach - self.likely]
    }
}

impl Nearby {
    fn numbers(&self) -> [f64; NUMBERS] {
        let Nearby { value, normal: n, curves: [a, b], carried: [v, w], closing, gains } = *self;
        [n.x, n.y, n.z, a.x, a.y, a.z, b.x, b.y, b.z, v, w, value, closing, v * v + w * w + gains]
    }
}

impl Planes {
    /// The planes of parts about a cell take the place of what was there.
    pub(super) fn set(&mut self, swept: &[SweptPart], list: &[u32], cell: &Cell) {
        let rows = self.normals.iter_mut().chain(&mut self.numbers);
        let rows = rows.chain([&mut self.reaches, &mut self.slack, &mut self.likely, &mut self.gauges]);
        rows.for_each(|row| row.resize(list.len(), 0.0));
        let part = list.first().map(|i| swept[*i as usize].part);
        let alike = part.filter(|part| list.iter().all(|i| std::ptr::eq(swept[*i as usize].part, *part)));
        let Some(shape) = alike.and_then(Shape::of) else {
            for (n, i) in list.iter().enumerate() {
                let one = &swept[*i as usize];
                self.put(n, one.tangent_closely(cell).numbers(), one.nearby(cell).numbers());
            }
            return;
        };
        let (centre, radius) = (cell.centre.to_array(), cell.radius);
        let mut ways = [[0.0; LANES]; WAY];
        for (n, some) in list.chunks(LANES).enumerate() {
            for (lane, i) in some.iter().enumerate() {
                put(&mut ways, lane, &swept[*i as usize]);
            }
            let about = about(self.arch, shape, &ways, centre, radius);
            let from = n * LANES;
            let rows = self.normals.iter_mut().chain([&mut self.reaches, &mut self.slack]);
            for (row, of) in rows.chain(&mut self.numbers).zip(&about) {
                row[from..from + some.len()].copy_from_slice(&of[..some.len()]);
            }
        }
    }

    fn put(&mut self, n: usize, plane: [f64; PLANE], numbers: [f64; NUMBERS]) {
        let rows = self.normals.iter_mut().chain([&mut self.reaches, &mut self.slack]);
        for (row, number) in rows.chain(&mut self.numbers).zip(plane.into_iter().chain(numbers)) {
            row[n] = number;
        }
    }

    /// Begins with another line.
    pub(super) fn begin(&mut self) {
        self.open.clone_from(&self.reaches);
    }

    /// True if a part may reach beyond both of two places.
    pub(super) fn may_hold(&self, n: usize, ends: &[DVec3; 2]) -> bool {
        let [p, q] = self.heights(n, ends);
        self.reaches[n] - p.max(q) > NOTHING
    }

    fn heights(&self, n: usize, ends: &[DVec3; 2]) -> [f64; 2] {
        let normal = DVec3::from_array(self.normals.each_ref().map(|of| of[n]));
        ends.map(|end| normal.dot(end))
    }

    /// Notes that a part had its turn.
    pub(super) fn close(&mut self, n: usize) {
        self.open[n] = f64::NEG_INFINITY;
    }

    /// The part that may reach beyond one of two places, given from the centre, and likely reaches deepest; of equals the first, and
    /// none that had its turn.
    pub(super) fn deepest(&mut self, ends: &[DVec3; 2]) -> Option<usize> {
        let most = self.arch.dispatch(Likely {
            normals: self.normals.each_ref().map(|n| &n[..]),
            open: &self.open,
            slack: &self.slack,
            likely: &mut self.likely,
            ends,
        });
        if most == f64::NEG_INFINITY {
            return None;
        }
        self.likely.iter().position(|b| *b == most)
    }

    /// The parts that may reach beyond one of the two places that were asked about last.
    pub(super) fn open(&self) -> impl Iterator<Item = usize> + '_ {
        self.likely.iter().enumerate().filter(|(_, likely)| **likely > f64::NEG_INFINITY).map(|(n, _)| n)
    }

    /// The two places, the one first that a part reaches farther beyond.
    pub(super) fn nearer_first(&self, n: usize, ends: &[DVec3; 2]) -> [DVec3; 2] {
        let [p, q] = self.heights(n, ends);
        if p < q { *ends } else { [ends[1], ends[0]] }
    }

    /// Of the parts that may reach beyond one of two ends of material, one of which reaches deepest by its plane, the one that does so
    /// when curvature and time are known better.
    pub(super) fn deepest_closely(&mut self, n: usize, ends: &[DVec3; 2]) -> usize {
        let [p, q] = self.heights(n, ends);
        let [end, other] = self.nearer_first(n, ends);
        // The plane leaves the material there.
        let share = (self.reaches[n] - self.slack[n] - p.min(q)) / (p - q).abs();
        let share = if share > 0.0 { share.min(1.0) } else { 0.0 };
        self.arch.dispatch(Gauges {
            numbers: self.numbers.each_ref().map(|n| &n[..]),
            likely: &self.likely,
            gauges: &mut self.gauges,
            place: end + (other - end) * share,
        });
        let mut least = n;
        for (i, gauge) in self.gauges.iter().enumerate() {
            if *gauge < self.gauges[least] {
                least = i;
            }
        }
        least
    }
}

/// Gauges of parts at a place, at the best of their time.
struct Gauges<'a> {
    numbers: [&'a [f64]; NUMBERS],
    likely: &'a [f64],
    gauges: &'a mut [f64],
    place: DVec3,
}

impl NullaryFnOnce for Gauges<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let count = self.gauges.len();
        let [nx, ny, nz, ax, ay, az, bx, by, bz, v, w, value, closing, gains] =
            self.numbers.map(|n| &n[..count]);
        let (likely, gauges, p) = (&self.likely[..count], self.gauges, self.place);
        for i in 0..count {
            let a = ax[i] * p.x + ay[i] * p.y + az[i] * p.z;
            let b = bx[i] * p.x + by[i] * p.y + bz[i] * p.z;
            let falls = closing[i] + v[i] * a + w[i] * b;
            // Where the gauge goes on falling, to the end of the time.
            let way = if gains[i] > 0.0 { falls / gains[i] } else { falls * f64::MAX };
            let way = if way > 0.5 { 0.5 } else { way };
            let t = if way < -0.5 { -0.5 } else { way };
            let there = value[i] + nx[i] * p.x + ny[i] * p.y + nz[i] * p.z + 0.5 * (a * a + b * b);
            let gauge = there - (falls - 0.5 * gains[i] * t) * t;
            gauges[i] = if likely[i] == f64::NEG_INFINITY { f64::INFINITY } else { gauge };
        }
    }
}

/// Guesses at the reaches of all parts beyond one of two places; the most of them is told.
struct Likely<'a> {
    normals: [&'a [f64]; 3],
    open: &'a [f64],
    slack: &'a [f64],
    likely: &'a mut [f64],
    ends: &'a [DVec3; 2],
}

impl NullaryFnOnce for Likely<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let count = self.likely.len();
        let [x, y, z] = self.normals.map(|n| &n[..count]);
        let (open, slack, likely) = (&self.open[..count], &self.slack[..count], self.likely);
        let [a, b] = *self.ends;
        for i in 0..count {
            let p = x[i] * a.x + y[i] * a.y + z[i] * a.z;
            let q = x[i] * b.x + y[i] * b.y + z[i] * b.z;
            let beyond = open[i] - if p < q { p } else { q };
            likely[i] = if beyond > NOTHING { beyond - slack[i] } else { f64::NEG_INFINITY };
        }
        // By themselves, each lane its own: a maximum taken in the loop above would be taken one after the other.
        let mut most = [f64::NEG_INFINITY; LANES];
        let (some, rest) = likely.as_chunks::<LANES>();
        for chunk in some {
            for (most, of) in most.iter_mut().zip(chunk) {
                *most = if *of > *most { *of } else { *most };
            }
        }
        let greatest = |a: f64, b: &f64| if *b > a { *b } else { a };
        rest.iter().fold(most.iter().fold(f64::NEG_INFINITY, greatest), greatest)
    }
}
