//! The boundary of the horizontal facets at the highest place of a mesh.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::base::{Code, Finding, Result};
use crate::geom::Mesh;

/// Vertices this far below the highest one still belong to the face [mm]: numbers of 32 bits, rounded by the program
/// that wrote the mesh.
const LEVEL: f64 = 1e-3;

/// Loops of points, counter-clockwise about the material.
pub(super) fn top_loops(mesh: &Mesh) -> Result<Vec<Vec<DVec2>>> {
    let highest = mesh.bounds().max.z;
    let up = |t: &&[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.vertices[i as usize]);
        [a, b, c].iter().all(|v| v.z >= highest - LEVEL) && (b - a).cross(c - a).z > 0.0
    };
    let mut sides: BTreeMap<(u32, u32), ()> = BTreeMap::new();
    for t in mesh.triangles.iter().filter(up) {
        for i in 0..3 {
            let (a, b) = (t[i], t[(i + 1) % 3]);
            // A side that is travelled both ways lies inside the face.
            if sides.remove(&(b, a)).is_none() {
                sides.insert((a, b), ());
            }
        }
    }
    if sides.is_empty() {
        return Err(Finding::error(
            Code::OUTLINE_FILE,
            "the highest place of the mesh is no horizontal face",
        )
        .value_mm(highest)
        .help("give the height of the face, so that the section there is taken")
        .into());
    }
    let mut loops = Vec::new();
    while let Some((&(first, second), ())) = sides.iter().next() {
        sides.remove(&(first, second));
        let (mut points, mut here) = (vec![first], second);
        while here != first {
            points.push(here);
            // As many sides leave a vertex as enter it, so the walk ends where it began.
            let Some((&(_, next), ())) = sides.range((here, 0)..=(here, u32::MAX)).next() else { break };
            sides.remove(&(here, next));
            here = next;
        }
        loops.push(points.into_iter().map(|i| mesh.vertices[i as usize].truncate()).collect());
    }
    Ok(loops)
}
