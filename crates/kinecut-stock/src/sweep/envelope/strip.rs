//! Strips of triangles between two polylines, and the mesh they go into.

use glam::DVec3;

use crate::geom::Mesh;

/// A vertex of a polyline with its place along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Station {
    pub along: f64,
    pub vertex: u32,
}

/// A mesh while it is built.
#[derive(Debug, Default)]
pub(super) struct Builder {
    pub mesh: Mesh,
}

impl Builder {
    pub(super) fn vertex(&mut self, p: DVec3) -> u32 {
        self.mesh.vertices.push(p);
        // More vertices than indices are refused before.
        (self.mesh.vertices.len() - 1) as u32
    }

    /// A triangle; one with two equal corners is nothing, and leaves the others closed.
    pub(super) fn triangle(&mut self, [a, b, c]: [u32; 3], flip: bool) {
        if a != b && b != c && c != a {
            self.mesh.triangles.push(if flip { [a, c, b] } else { [a, b, c] });
        }
    }

    /// The strip between two polylines, by their places: counter-clockwise where the lower runs to the right and the upper lies
    /// above it. Its boundary is the lower line, the upper one backwards, and the lines between their ends.
    pub(super) fn strip(&mut self, lower: &[Station], upper: &[Station], flip: bool) {
        let along = |line: &[Station], k: usize| line.get(k).map(|s| s.along);
        for step in steps(|i| along(lower, i), |j| along(upper, j)) {
            match step {
                Step::Lower { from, upper: j } => {
                    self.triangle([lower[from].vertex, lower[from + 1].vertex, upper[j].vertex], flip);
                }
                Step::Upper { from, lower: i } => {
                    self.triangle([lower[i].vertex, upper[from + 1].vertex, upper[from].vertex], flip);
                }
            }
        }
    }
}

/// A step along one of two lines, while the other waits.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    Lower { from: usize, upper: usize },
    Upper { from: usize, lower: usize },
}

/// The steps of a strip between two lines with given places, `None` beyond their ends: always on the line that is
/// behind.
pub(super) fn steps(
    lower: impl Fn(usize) -> Option<f64>,
    upper: impl Fn(usize) -> Option<f64>,
) -> impl Iterator<Item = Step> {
    let (mut i, mut j) = (0, 0);
    let there = lower(0).is_some() && upper(0).is_some();
    std::iter::from_fn(move || {
        let below = match (lower(i + 1), upper(j + 1)) {
            (Some(a), Some(b)) => a <= b,
            (a, b) => {
                if !there || (a.is_none() && b.is_none()) {
                    return None;
                }
                a.is_some()
            }
        };
        let from = if below { &mut i } else { &mut j };
        *from += 1;
        let from = *from - 1;
        Some(if below { Step::Lower { from, upper: j } } else { Step::Upper { from, lower: i } })
    })
}
