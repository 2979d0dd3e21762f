//! "top": the edges of the stock at the finished plane, as the outline of a face.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::base::{Code, Finding, Result};
use crate::geom::{Aabb, Mesh, Outline, OutlineEdge, Solid};
use crate::operations::StockOutline;

/// Vertices of a mesh this near to a circle are those of an arc [mm].
const CHORDS: f64 = 1e-3;

/// Directions nearer to one another than this are the same: rounding of a setup's axes.
const ALONG: f64 = 1e-9;

/// The outline of the raw stock at a height of the work offset [mm], in its coordinates.
///
/// # Errors
/// `KC1001` where the stock does not reach above the height; those of the outline.
pub(crate) fn top_outline(of: &StockOutline<'_>, height: f64) -> Result<Outline> {
    let up = of.to_work.inverse().vector(DVec3::Z);
    let mut loops = match of.stock {
        Solid::Box(bounds) => vec![box_section(bounds, of, height)?],
        Solid::Cylinder { base, radius, height: tall } => {
            vec![bar_section(*base, *radius, *tall, of, height)?]
        }
        Solid::Mesh(mesh) => {
            let moved = Mesh {
                vertices: mesh.vertices.iter().map(|&v| of.to_work.point(v)).collect(),
                ..mesh.clone()
            };
            let outline = Outline::section_of(&Solid::Mesh(moved), height, CHORDS)?;
            if of.drilled.is_empty() {
                return Ok(outline);
            }
            let edges = outline.edges();
            outline.loops().iter().map(|l| edges[l.edges.clone()].to_vec()).collect()
        }
    };
    for hole in of.drilled {
        let ends = [hole.base, hole.base + DVec3::Z * hole.height].map(|p| of.to_work.point(p));
        let [low, high] = if ends[0].z < ends[1].z { ends } else { [ends[1], ends[0]] };
        // Holes across the face's normal would cut its outline open: no face to be milled has them at its height.
        if (up.z.abs() - 1.0).abs() < ALONG && low.z < height && height <= high.z {
            loops.push(vec![OutlineEdge::arc(low.truncate(), hole.diameter / 2.0, 0.0, TAU)]);
        }
    }
    Outline::new(loops, Vec::new())
}

fn misses(height: f64, [low, high]: [f64; 2]) -> Result<()> {
    if low <= height && height < high {
        return Ok(());
    }
    let bound = if height < low { low } else { high };
    Err(Finding::error(Code::FACE_CASE, "the stock does not reach through the finished plane")
        .value_mm(height)
        .bound_mm(bound)
        .help("correct `top`, or give the outline")
        .into())
}

fn box_section(bounds: &Aabb, of: &StockOutline<'_>, height: f64) -> Result<Vec<OutlineEdge>> {
    let pick = |i: usize| {
        let side = |bit: usize, axis: usize| if i & bit == 0 { bounds.min[axis] } else { bounds.max[axis] };
        of.to_work.point(DVec3::new(side(1, 0), side(2, 1), side(4, 2)))
    };
    let corners: Vec<DVec3> = (0..8).map(pick).collect();
    let low = corners.iter().fold(f64::INFINITY, |a, c| a.min(c.z));
    let high = corners.iter().fold(f64::NEG_INFINITY, |a, c| a.max(c.z));
    misses(height, [low, high])?;
    // Four corners of a box along an axis are low.
    let mut floor: Vec<DVec2> =
        corners.iter().filter(|c| c.z - low < 0.5 * (high - low)).map(|c| c.truncate()).collect();
    let middle = floor.iter().sum::<DVec2>() / floor.len() as f64;
    floor.sort_by(|a, b| (*a - middle).to_angle().total_cmp(&(*b - middle).to_angle()));
    Ok((0..floor.len()).map(|i| OutlineEdge::line(floor[i], floor[(i + 1) % floor.len()])).collect())
}

fn bar_section(
    base: DVec3,
    radius: f64,
    tall: f64,
    of: &StockOutline<'_>,
    height: f64,
) -> Result<Vec<OutlineEdge>> {
    let (a, b) = (of.to_work.point(base), of.to_work.point(base + DVec3::Z * tall));
    let along = (b - a) / tall;
    if (along.z.abs() - 1.0).abs() < ALONG {
        misses(height, [a.z.min(b.z), a.z.max(b.z)])?;
        return Ok(vec![OutlineEdge::arc(a.truncate(), radius, 0.0, TAU)]);
    }
    // A bar that lies: a rectangle as wide as its chord at this height.
    misses(height, [a.z - radius, a.z + radius])?;
    let up = height - a.z;
    let half = (radius * radius - up * up).max(0.0).sqrt();
    let aside = half * along.truncate().perp();
    let (a, b) = (a.truncate(), b.truncate());
    let corners = [a - aside, b - aside, b + aside, a + aside];
    Ok((0..4).map(|i| OutlineEdge::line(corners[i], corners[(i + 1) % 4])).collect())
}
