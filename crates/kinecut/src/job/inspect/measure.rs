//! A distance in the part: two points, and the material and voids between them.

use glam::DVec3;
use serde::Serialize;

use super::super::Outcome;
use super::point::{CutBy, cut_by};

/// The line between two points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measure {
    /// The first point [mm].
    pub from: [f64; 3],
    /// The second point [mm].
    pub to: [f64; 3],
    /// Distance of the points [mm].
    pub distance: f64,
    /// Stretches of material and of void from the first point to the second, in their order.
    pub stretches: Vec<Stretch>,
}

/// A stretch of the line in material, or in void.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stretch {
    /// Whether it is material.
    pub material: bool,
    /// Length [mm].
    pub length: f64,
    /// Bound on the error of the length [mm]: of its ends on the surface, the more the flatter the line meets it; none where it runs
    /// along the surface.
    pub within: Option<f64>,
    /// Its end [mm].
    pub end: [f64; 3],
    /// Maker of the surface at its end; none at the second point.
    pub cut_by: Option<CutBy>,
}

/// Lengths of less than this share of what they are known to [`Stretch::within`] are told with it alone.
const FLAT: f64 = 1e-3;

/// Measures the part between two points; `within`: distances square to its surface are known so far [mm].
pub(super) fn measured(outcome: &Outcome, within: f64, [from, to]: [DVec3; 2]) -> Measure {
    let distance = from.distance(to);
    let along = (to - from).normalize_or_zero();
    let crossings = outcome.part.crossings_between(from, to);
    let before = crossings.partition_point(|c| c.at <= 0.0);
    let inside = &crossings[before..crossings.partition_point(|c| c.at < distance).max(before)];
    let off = |triangle: u32| {
        let [a, b, c] = outcome.part.triangles[triangle as usize].map(|i| outcome.part.vertices[i as usize]);
        let square = (b - a).cross(c - a).try_normalize().map_or(0.0, |n| n.dot(along).abs());
        (square > FLAT).then_some(within / square)
    };
    let mut stretches = Vec::with_capacity(inside.len() + 1);
    let (mut material, mut start, mut start_off) = (before % 2 == 1, 0.0, Some(0.0));
    for crossing in inside {
        let end_off = off(crossing.triangle);
        stretches.push(Stretch {
            material,
            length: crossing.at - start,
            within: start_off.zip(end_off).map(|(a, b)| a + b),
            end: (from + along * crossing.at).to_array(),
            cut_by: Some(cut_by(outcome, crossing.triangle)),
        });
        (material, start, start_off) = (!material, crossing.at, end_off);
    }
    let last =
        Stretch { material, length: distance - start, within: start_off, end: to.to_array(), cut_by: None };
    stretches.push(last);
    Measure { from: from.to_array(), to: to.to_array(), distance, stretches }
}
