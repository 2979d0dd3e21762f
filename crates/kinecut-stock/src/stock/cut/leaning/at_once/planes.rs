//! The tangent planes of swept parts about a cell, and which part may reach deepest beyond a place.

use glam::DVec3;
use pulp::{Arch, NullaryFnOnce};

use super::near::Tangent;

/// Reach beyond an end of material that counts as none [mm]: a fifth of an end point's rounding.
const NOTHING: f64 = 2e-6;

/// Numbers that are compared at once.
const LANES: usize = 8;

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
}

impl Planes {
    pub(super) fn set(&mut self, list: &[(u32, Tangent)]) {
        for (k, normals) in self.normals.iter_mut().enumerate() {
            normals.clear();
            normals.extend(list.iter().map(|(_, tangent)| tangent.normal[k]));
        }
        self.reaches.clear();
        self.reaches.extend(list.iter().map(|(_, tangent)| tangent.reach));
        self.slack.clear();
        self.slack.extend(list.iter().map(|(_, tangent)| tangent.reach - tangent.likely));
        self.likely.resize(list.len(), 0.0);
    }

    /// Begins with another line.
    pub(super) fn begin(&mut self) {
        self.open.clone_from(&self.reaches);
    }

    /// True if a part may reach beyond one of two places, given from the centre.
    pub(super) fn reaches(&self, n: usize, ends: &[DVec3; 2]) -> bool {
        let [p, q] = self.heights(n, ends);
        self.open[n] - p.min(q) > NOTHING
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
