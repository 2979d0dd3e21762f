//! The loop of a sharp edge of a mesh, found by a point near it.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use crate::base::{Code, Error, Finding, Result};
use crate::geom::Mesh;

/// Least angle between the facets at a sharp edge [rad]: round edges turn by less from facet to facet.
const SHARP: f64 = 20.0 * std::f64::consts::PI / 180.0;
/// Farthest that the point may lie from its edge [mm].
const NEAR: f64 = 1.0;
/// Difference of heights along a level edge [mm]: numbers of 32 bits, rounded by the program that wrote the mesh.
const LEVEL: f64 = 1e-3;

/// The loop of a sharp level edge of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshEdge {
    /// Its height, in the coordinates of the mesh [mm].
    pub height: f64,
    /// Whether the material lies inside of it, as at the rim of a boss; outside, as at the rim of a hole.
    pub material_inside: bool,
    /// Whether all of it can be broken from above: the material lies below it, and stands out at it.
    pub is_upper: bool,
}

/// A sharp level edge.
#[derive(Clone, Copy)]
struct Sharp {
    ends: [u32; 2],
    /// Sum of the normals of its two facets.
    out: DVec3,
    /// Whether the material stands out at it.
    is_convex: bool,
}

/// The loop whose edge runs by a point, its points in their order, and what is known of it.
pub(super) fn edge_loop(mesh: &Mesh, at: DVec3) -> Result<(Vec<DVec2>, MeshEdge)> {
    let all = sharp_edges(mesh);
    let place = |i: u32| mesh.vertices[i as usize];
    let far = |e: &Sharp| distance(at, e.ends.map(place));
    let nearest = all.iter().min_by(|a, b| far(a).1.total_cmp(&far(b).1));
    let Some(first) = nearest.filter(|e| far(e).1 <= NEAR) else {
        return Err(nothing_near(at, nearest.map(far)));
    };
    let height = 0.5 * (place(first.ends[0]).z + place(first.ends[1]).z);
    let mut beside: HashMap<u32, Vec<&Sharp>> = HashMap::new();
    for edge in &all {
        if edge.ends.iter().all(|i| (place(*i).z - height).abs() <= LEVEL) {
            edge.ends.iter().for_each(|i| beside.entry(*i).or_default().push(edge));
        }
    }
    let [start, mut here] = first.ends;
    let mut last = first;
    let (mut points, mut aside, mut is_upper) = (vec![place(start).truncate()], 0.0, true);
    loop {
        let (from, to) = (points[points.len() - 1], place(here).truncate());
        let along = to - from;
        // The material lies against the sum of the normals.
        aside -= along.perp().dot(last.out.truncate());
        is_upper &= last.out.z > 0.0 && last.is_convex;
        if here == start && beside.get(&here).is_some_and(|edges| edges.len() == 2) {
            break;
        }
        points.push(to);
        let mut next = beside.get(&here).into_iter().flatten().filter(|e| e.ends != last.ends);
        match (next.next(), next.next()) {
            (Some(edge), None) => {
                last = edge;
                here = if edge.ends[0] == here { edge.ends[1] } else { edge.ends[0] };
            }
            (None, _) => {
                let what = "the edge of the mesh ends here: it is no level loop";
                return Err(at_place(
                    what,
                    place(here),
                    "name another edge, or cut the mesh at a height: section",
                ));
            }
            (Some(_), Some(_)) => {
                let what = "several level edges of the mesh meet here: it is not known which one goes on";
                return Err(at_place(what, place(here), "name another edge, or draw the outline"));
            }
        }
    }
    let turns: f64 = (0..points.len()).map(|i| points[i].perp_dot(points[(i + 1) % points.len()])).sum();
    let edge = MeshEdge { height, material_inside: (turns > 0.0) == (aside > 0.0), is_upper };
    Ok((points, edge))
}

/// The sharp edges whose ends have one height.
fn sharp_edges(mesh: &Mesh) -> Vec<Sharp> {
    let place = |i: u32| mesh.vertices[i as usize];
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * mesh.triangles.len());
    for (t, corners) in (0..).zip(&mesh.triangles) {
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            if (place(a).z - place(b).z).abs() <= LEVEL {
                sides.push(([a.min(b), a.max(b)], t));
            }
        }
    }
    sides.sort_unstable();
    let normal = |t: u32| {
        let [a, b, c] = mesh.triangles[t as usize].map(place);
        (b - a).cross(c - a).normalize_or_zero()
    };
    let mut found = Vec::new();
    for pair in sides.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        let (ends, [one, other]) = (pair[0].0, [pair[0].1, pair[1].1]);
        let normals = [one, other].map(normal);
        let angle = normals[0].cross(normals[1]).length().atan2(normals[0].dot(normals[1]));
        if normals.contains(&DVec3::ZERO) || angle < SHARP {
            continue;
        }
        // The third corner of the other facet lies under the plane of this one where the material stands out.
        let third = mesh.triangles[other as usize].into_iter().find(|i| !ends.contains(i));
        let is_convex = third.is_some_and(|i| (place(i) - place(ends[0])).dot(normals[0]) < 0.0);
        found.push(Sharp { ends, out: normals[0] + normals[1], is_convex });
    }
    found
}

/// The place on a line next to a point, and how far it is [mm].
fn distance(at: DVec3, [a, b]: [DVec3; 2]) -> (DVec3, f64) {
    let along = b - a;
    let share = ((at - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    let foot = if share.is_finite() { a + share * along } else { a };
    (foot, foot.distance(at))
}

fn nothing_near(at: DVec3, nearest: Option<(DVec3, f64)>) -> Error {
    let what = "no sharp level edge of the mesh is near this point";
    let finding = Finding::error(Code::OUTLINE_FILE, what).point(at.to_array());
    match nearest {
        Some((foot, far)) => {
            let [x, y, z] = foot.to_array().map(|v| (v * 1e3).round() / 1e3 + 0.0);
            finding.value_mm(far).bound_mm(NEAR).help(format!("the nearest one passes [{x}, {y}, {z}]"))
        }
        None => finding.help("the mesh has none: cut it at a height: section"),
    }
    .into()
}

fn at_place(what: &str, place: DVec3, help: &str) -> Error {
    Finding::error(Code::OUTLINE_FILE, what).point(place.to_array()).help(help).into()
}
