//! The tangent planes of swept parts about a cell, and which part may reach deepest beyond a place.

use glam::DVec3;

use super::near::Tangent;

/// Reach beyond an end of material that counts as none [mm]: a fifth of an end point's rounding.
const NOTHING: f64 = 2e-6;

/// Planes, coordinate by coordinate.
#[derive(Default)]
pub(super) struct Planes {
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

    /// The part that may reach beyond one of two places, given from the centre, and likely reaches deepest; of equals the first, and
    /// each once.
    pub(super) fn deepest(&mut self, ends: &[DVec3; 2]) -> Option<usize> {
        let count = self.open.len();
        let [x, y, z] = self.normals.each_ref().map(|n| &n[..count]);
        let (open, slack, likely) = (&self.open[..count], &self.slack[..count], &mut self.likely[..count]);
        let [a, b] = ends;
        let mut most = f64::NEG_INFINITY;
        for i in 0..count {
            let p = x[i] * a.x + y[i] * a.y + z[i] * a.z;
            let q = x[i] * b.x + y[i] * b.y + z[i] * b.z;
            let beyond = open[i] - if p < q { p } else { q };
            likely[i] = if beyond > NOTHING { beyond - slack[i] } else { f64::NEG_INFINITY };
            most = if likely[i] > most { likely[i] } else { most };
        }
        if most == f64::NEG_INFINITY {
            return None;
        }
        let deepest = likely.iter().position(|b| *b == most)?;
        self.open[deepest] = f64::NEG_INFINITY;
        Some(deepest)
    }
}
