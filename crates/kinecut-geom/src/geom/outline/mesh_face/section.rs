//! The section of a mesh just below a height.
//!
//! Vertices at the height count as above it. Each triangle with corners on both sides then gives one stretch between two
//! of its sides, and as a closed mesh has each side in two triangles, the stretches join to loops without any tolerance.
//! With vertices in the plane stretches have no length, or double back over one another; these are taken out.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::geom::Mesh;

/// Loops of points, counter-clockwise about the material.
pub(super) fn section_loops(mesh: &Mesh, z: f64) -> Vec<Vec<DVec2>> {
    let above = |i: u32| mesh.vertices[i as usize].z >= z;
    // From the side where the section enters a triangle to the one where it leaves it.
    let mut next: BTreeMap<(u32, u32), (u32, u32)> = BTreeMap::new();
    for t in &mesh.triangles {
        let side = |falls: bool| {
            (0..3).map(|i| (t[i], t[(i + 1) % 3])).find(|&(a, b)| above(a) == falls && above(b) != falls)
        };
        // Seen from outside the corners run counter-clockwise: with the upper side up, material is on the left of the
        // stretch from the falling side to the rising one seen from above.
        if let (Some((a, b)), Some((c, d))) = (side(true), side(false)) {
            next.insert(key(a, b), key(c, d));
        }
    }
    let point = |(a, b): (u32, u32)| {
        let (p, q) = (mesh.vertices[a as usize], mesh.vertices[b as usize]);
        if p.z == z {
            return p.truncate();
        }
        if q.z == z {
            return q.truncate();
        }
        let f = (z - p.z) / (q.z - p.z);
        p.lerp(q, f).truncate()
    };
    let mut loops = Vec::new();
    while let Some((&first, _)) = next.iter().next() {
        let mut points = Vec::new();
        let mut here = first;
        while let Some(following) = next.remove(&here) {
            points.push(point(here));
            here = following;
        }
        let points = without_spikes(points);
        if points.len() > 2 {
            loops.push(points);
        }
    }
    loops
}

fn key(a: u32, b: u32) -> (u32, u32) {
    if a < b { (a, b) } else { (b, a) }
}

/// Without points that come twice and stretches that go out and come back the same way.
fn without_spikes(points: Vec<DVec2>) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::with_capacity(points.len());
    for p in points {
        if kept.last() == Some(&p) {
            continue;
        }
        if kept.len() > 1 && kept[kept.len() - 2] == p {
            kept.pop();
        } else {
            kept.push(p);
        }
    }
    // The same across the end of the list.
    let mut from = 0;
    while kept.len() - from > 1 {
        let n = kept.len();
        if kept[n - 1] == kept[from] || kept.len() - from > 2 && kept[n - 2] == kept[from] {
            kept.pop();
        } else if kept.len() - from > 2 && kept[n - 1] == kept[from + 1] {
            from += 1;
        } else {
            break;
        }
    }
    kept.split_off(from)
}
