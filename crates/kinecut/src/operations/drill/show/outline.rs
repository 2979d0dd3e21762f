//! Outlines of drill points as polylines [mm].

use crate::geom::{EdgeProfile, EdgeSegment};
use crate::tool::DrillPoint;

/// Chords of an arc: a hundredth of a pixel at the sizes drawn.
const ARC_STEPS: u32 = 48;

/// The edge from its inner to its outer radius: (r, z), steps included.
pub(super) fn half(edge: &EdgeProfile) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    for segment in edge.segments() {
        let [a, b] = segment.range();
        let steps = if matches!(segment, EdgeSegment::Arc { .. }) { ARC_STEPS } else { 1 };
        for i in 0..=steps {
            let r = if i == steps { b } else { a + (b - a) * f64::from(i) / f64::from(steps) };
            let p = [r, segment.height(r)];
            if points.last() != Some(&p) {
                points.push(p);
            }
        }
    }
    points
}

/// Part of the drill within the inner end of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Core {
    /// Nothing: the core of the part stays there.
    Open,
    /// A slot, about as deep as half its width.
    Notch,
    /// A nose that does not cut.
    Nose,
}

impl Core {
    /// That of a point.
    pub(super) fn of(point: &DrillPoint) -> Core {
        match point {
            DrillPoint::SlottedChisel { .. } | DrillPoint::CastIron { .. } => Core::Notch,
            DrillPoint::Cone { .. } => Core::Nose,
            _ => Core::Open,
        }
    }
}

/// The tool with its reference point at a height, its margins up to another.
pub(super) fn silhouette(edge: &EdgeProfile, core: Core, z: f64, up: f64) -> Vec<[f64; 2]> {
    let half = half(edge);
    let (inner, outer) = (edge.inner_radius(), edge.outer_radius());
    let at = |sign: f64, p: &[f64; 2]| [sign * p[0], z + p[1]];
    let mut points = vec![[-outer, up]];
    points.extend(half.iter().rev().map(|p| at(-1.0, p)));
    if inner > 0.0 {
        match core {
            Core::Open => points.extend([[-inner, up], [f64::NAN; 2], [inner, up]]),
            Core::Notch => {
                let roof = z + half.first().map_or(0.0, |p| p[1]) + inner;
                points.extend([[-inner, roof], [inner, roof]]);
            }
            Core::Nose => {}
        }
    }
    points.extend(half.iter().map(|p| at(1.0, p)));
    points.push([outer, up]);
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_runs_along_the_edge_and_leaves_a_core_open() {
        let cannon = DrillPoint::Cannon { overlap: 0.4, edge_angle: 80f64.to_radians() }.edge(20.0).unwrap();
        let k = 80f64.to_radians().tan().recip();
        let expected = [[0.0, 0.4 * k], [0.4, 0.0], [0.4, 0.8 * k], [10.0, 10.4 * k]];
        let found = half(&cannon);
        assert_eq!(found.len(), 4);
        assert!(
            found.iter().zip(expected).all(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12),
            "{found:?}"
        );
        let ring = DrillPoint::Annular { core: 12.0 }.edge(20.0).unwrap();
        let line = silhouette(&ring, Core::Open, -5.0, 3.0);
        assert_eq!(line.iter().filter(|p| p[0].is_nan()).count(), 1);
        assert_eq!((line[0], line[line.len() - 1]), ([-10.0, 3.0], [10.0, 3.0]));
        assert!(line.contains(&[6.0, -5.0]) && line.contains(&[-6.0, -5.0]));
        let slotted = DrillPoint::SlottedChisel { angle: 2.0, slot: 1.5 };
        let line = silhouette(&slotted.edge(20.0).unwrap(), Core::of(&slotted), -5.0, 3.0);
        assert!(line.contains(&[-1.5, -3.5]) && line.contains(&[1.5, -3.5]));
    }
}
