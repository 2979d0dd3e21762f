//! Check that a path covers the whole face.

use glam::DVec2;

use super::PassPath;
use super::path::{distance, nearest};
use crate::facing::FaceCase;
use crate::geom::OutlineEdge;

/// Distances nearer than this to the reach, per size of the face, are within it: rounding.
const ZERO: f64 = 1e-9;

/// A point of the face that is farther than the cutter's radius less `margin` [mm] from the path, if one is found.
///
/// Cells of a quadtree that lie whole within reach are done; others are divided, `depth` times at most. None is
/// certain: every point of the face is then within reach plus twice the half diagonal of the smallest cells,
/// 1.42 times the longer side of the face over two to the power of `depth`.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::passes::{PassPath, uncovered};
/// use kinecut::facing::{BadSet, FaceCase};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)])?;
/// let case = FaceCase::new(plate, 35.0, BadSet::below(1.0)?)?;
/// let at = |y: f64| PassPath::lines(&[vec![dvec2(0.0, y), dvec2(100.0, y)]]);
/// assert!(uncovered(&case, &at(30.0), 1.0, 9).is_none());
/// assert!(uncovered(&case, &at(24.0), 1.0, 9).is_some_and(|p| p.y > 58.0));
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn uncovered(case: &FaceCase, path: &PassPath, margin: f64, depth: u32) -> Option<DVec2> {
    let [low, high] = case.outline.bounds();
    let half = 0.5 * (high - low).max_element();
    let reach = case.radius - margin + ZERO * (half + case.radius);
    let pieces: Vec<&OutlineEdge> = path.chains.iter().flatten().collect();
    let edges: Vec<&OutlineEdge> = case.outline.edges().iter().collect();
    cell(case, 0.5 * (low + high), half, depth, reach, &pieces, &edges)
}

fn cell(
    case: &FaceCase,
    middle: DVec2,
    half: f64,
    depth: u32,
    reach: f64,
    pieces: &[&OutlineEdge],
    edges: &[&OutlineEdge],
) -> Option<DVec2> {
    let diagonal = half * std::f64::consts::SQRT_2;
    let away = |p: DVec2| pieces.iter().map(|piece| distance(piece, p)).fold(f64::INFINITY, f64::min);
    let gap = away(middle);
    if gap <= reach - diagonal {
        return None;
    }
    let edges: Vec<&OutlineEdge> =
        edges.iter().copied().filter(|e| distance(e, middle) <= diagonal).collect();
    let inside = case.outline.contains(middle);
    if edges.is_empty() && !inside {
        return None;
    }
    if gap > reach {
        if inside {
            return Some(middle);
        }
        // The outline belongs to the face.
        if depth == 0 {
            return edges.iter().map(|e| nearest(e, middle)).find(|&p| away(p) > reach);
        }
    }
    if depth == 0 {
        return None;
    }
    // Only pieces that some point of the cell may be nearest to.
    let pieces: Vec<&OutlineEdge> =
        pieces.iter().copied().filter(|piece| distance(piece, middle) <= gap + 2.0 * diagonal).collect();
    [(-0.5, -0.5), (0.5, -0.5), (-0.5, 0.5), (0.5, 0.5)].into_iter().find_map(|(x, y)| {
        cell(case, middle + half * DVec2::new(x, y), 0.5 * half, depth - 1, reach, &pieces, &edges)
    })
}
