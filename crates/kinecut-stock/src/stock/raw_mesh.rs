//! Raw stock from a closed mesh.
//!
//! Across the lines the vertices are rounded to the fixed step and lines lie half a step off it, all in whole numbers,
//! so that the side of an edge on which a line passes is exact; a line through an edge belongs to the triangle on one
//! side of it by the direction of the edge. Hence every line enters a closed mesh as often as it leaves it. Material is
//! where the winding number is positive: bodies that overlap are united.

use glam::DVec3;
use rayon::prelude::*;

use super::tile::{TILE_EDGE, Tile};
use super::tri_dexel::Grid;
use super::{Axis, DexelGrid, EndPoint, Interval, Lattice, PackedNormal, TriDexel, fixed};
use crate::base::{Code, Finding, Result};
use crate::geom::{Aabb, Mesh};

impl TriDexel {
    /// The body inside a closed mesh; a mesh turned inside out is taken the right way round.
    ///
    /// # Errors
    /// `KC0602` with the middle of an edge at which the mesh is open; `KC0801` when a vertex is not finite or
    /// missing, or the mesh encloses nothing; see also [`TriDexel::empty`].
    pub fn from_mesh(mesh: &Mesh, step: f64) -> Result<TriDexel> {
        TriDexel::of_mesh(mesh, mesh.bounds(), step)
    }

    /// The lines of a mesh over a box.
    pub(super) fn of_mesh(mesh: &Mesh, bounds: Aabb, step: f64) -> Result<TriDexel> {
        check(mesh)?;
        let volume = mesh.volume();
        if volume == 0.0 {
            return Err(Finding::error(Code::GEOMETRY, "the mesh of the stock encloses nothing").into());
        }
        let mut stock = TriDexel::empty(bounds, step)?;
        let lattice = *stock.lattice();
        for grid in &mut stock.grids {
            fill(grid, &lattice, mesh, volume < 0.0);
        }
        Ok(stock)
    }
}

/// Checks indices, numbers, and that each edge is run as often one way as the other.
fn check(mesh: &Mesh) -> Result<()> {
    if let Some(p) = mesh.vertices.iter().find(|p| !p.is_finite()) {
        return Err(Finding::error(Code::GEOMETRY, "a vertex of the mesh is not finite")
            .value_mm(p.x + p.y + p.z)
            .into());
    }
    if let Some(i) = mesh.triangles.iter().flatten().find(|i| **i as usize >= mesh.vertices.len()) {
        return Err(Finding::error(Code::GEOMETRY, "a triangle names a vertex that is not there")
            .value(f64::from(*i), "")
            .bound(mesh.vertices.len() as f64, "")
            .into());
    }
    let edges = mesh.triangles.iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]);
    let mut ways: Vec<(u32, u32, i8)> = edges
        .filter(|(p, q)| p != q)
        .map(|(p, q)| (p.min(q), p.max(q), if p < q { 1 } else { -1 }))
        .collect();
    ways.sort_unstable();
    for edge in ways.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        if edge.iter().map(|e| i64::from(e.2)).sum::<i64>() != 0 {
            let middle = (mesh.vertices[edge[0].0 as usize] + mesh.vertices[edge[0].1 as usize]) * 0.5;
            return Err(Finding::error(Code::MESH_OPEN, "the mesh of the stock does not close")
                .point(middle.to_array())
                .value(edge.len() as f64, "triangles on an edge")
                .bound(2.0, "triangles on an edge")
                .help("repair the mesh in the program that wrote it")
                .into());
        }
    }
    Ok(())
}

/// A triangle seen along an axis: counter-clockwise, across in half fixed steps, along in mm.
struct Shadow {
    across: [[i64; 2]; 3],
    along: [f64; 3],
    /// +1 where a line along the axis enters the body, -1 where it leaves.
    turn: i8,
    normal: PackedNormal,
}

impl Shadow {
    /// `None` when the triangle is seen edge on.
    fn new(mesh: &Mesh, triangle: [u32; 3], axis: Axis, inside_out: bool) -> Option<Shadow> {
        let mut corners = triangle.map(|i| mesh.vertices[i as usize]);
        if inside_out {
            corners.swap(1, 2);
        }
        let (a, b) = axis.others();
        let n = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let across = |p: DVec3| [a, b].map(|x| 2 * i64::from(fixed(p[x.index()])));
        let area = turn(across(corners[0]), across(corners[1]), across(corners[2]));
        if area == 0 {
            return None;
        }
        if area < 0 {
            corners.swap(1, 2);
        }
        // A triangle so thin that its normal is lost still has a side on which it is seen.
        let mut side = DVec3::ZERO;
        side[axis.index()] = if area > 0 { 1.0 } else { -1.0 };
        let normal = PackedNormal::new(n.try_normalize().unwrap_or(side), 0);
        let along = corners.map(|p| p[axis.index()]);
        Some(Shadow { across: corners.map(across), along, turn: if area > 0 { -1 } else { 1 }, normal })
    }

    /// Place at which the line at `p` passes through, along the line [mm]; `None` when it misses.
    fn crossing(&self, p: [i64; 2]) -> Option<f64> {
        let mut weight = [0.0; 3];
        for (i, weight) in weight.iter_mut().enumerate() {
            let (from, to) = (self.across[(i + 1) % 3], self.across[(i + 2) % 3]);
            let w = turn(from, to, p);
            // A line through an edge belongs to the edge that runs upwards, or level towards minus: of the two
            // triangles at an edge that lie on either side of it exactly one runs it so.
            let own = to[1] > from[1] || to[1] == from[1] && to[0] < from[0];
            if w < 0 || w == 0 && !own {
                return None;
            }
            *weight = w as f64;
        }
        let [z0, z1, z2] = self.along;
        let z = z0 + (weight[1] * (z1 - z0) + weight[2] * (z2 - z0)) / (weight[0] + weight[1] + weight[2]);
        Some(z.clamp(z0.min(z1).min(z2), z0.max(z1).max(z2)))
    }
}

/// Twice the area of a triangle: exact, positive counter-clockwise.
fn turn(p: [i64; 2], q: [i64; 2], r: [i64; 2]) -> i128 {
    let d = |s: [i64; 2], i: usize| i128::from(s[i] - p[i]);
    d(q, 0) * d(r, 1) - d(q, 1) * d(r, 0)
}

/// Positions of the lines along one direction across them, in half fixed steps.
fn positions(lattice: &Lattice, axis: Axis) -> Vec<i64> {
    (0..lattice.counts[axis.index()]).map(|i| 2 * i64::from(fixed(lattice.coordinate(axis, i))) + 1).collect()
}

/// Indices of the positions within the reach of some values.
fn within(positions: &[i64], values: [i64; 3]) -> std::ops::Range<usize> {
    let [p, q, r] = values;
    let from = positions.partition_point(|x| *x < p.min(q).min(r));
    from..positions.partition_point(|x| *x <= p.max(q).max(r)).max(from)
}

/// Fills an empty grid.
fn fill(grid: &mut Grid, lattice: &Lattice, mesh: &Mesh, inside_out: bool) {
    let axis = grid.axis;
    let (a, b) = axis.others();
    let (columns, rows) = (positions(lattice, a), positions(lattice, b));
    let shadows: Vec<Shadow> =
        mesh.triangles.par_iter().filter_map(|t| Shadow::new(mesh, *t, axis, inside_out)).collect();
    let [across, bands] = grid.tiles_across();
    let mut in_band = vec![Vec::new(); bands as usize];
    for (i, s) in shadows.iter().enumerate() {
        let reach = within(&rows, s.across.map(|p| p[1]));
        if !reach.is_empty() {
            let edge = TILE_EDGE as usize;
            in_band[reach.start / edge..=(reach.end - 1) / edge].iter_mut().for_each(|band| band.push(i));
        }
    }
    grid.tiles.par_chunks_mut(across as usize).enumerate().for_each(|(band, tiles)| {
        fill_band(tiles, band, &in_band[band], &shadows, &columns, &rows);
    });
}

/// Fills the tiles of one band of rows.
fn fill_band(
    tiles: &mut [Tile],
    band: usize,
    own: &[usize],
    shadows: &[Shadow],
    columns: &[i64],
    rows: &[i64],
) {
    let edge = TILE_EDGE as usize;
    let band_rows = band * edge..((band + 1) * edge).min(rows.len());
    // Row, column, fixed coordinate, entering first, normal.
    let mut crossings: Vec<(usize, usize, i32, i8, PackedNormal)> = Vec::new();
    for shadow in own.iter().map(|i| &shadows[*i]) {
        let reach = within(rows, shadow.across.map(|p| p[1]));
        let reach = reach.start.max(band_rows.start)..reach.end.min(band_rows.end);
        for (row, y) in rows.iter().enumerate().take(reach.end).skip(reach.start) {
            for column in within(columns, shadow.across.map(|p| p[0])) {
                if let Some(z) = shadow.crossing([columns[column], *y]) {
                    crossings.push((row, column, fixed(z), -shadow.turn, shadow.normal));
                }
            }
        }
    }
    crossings.sort_unstable_by_key(|c| (c.0, c.1, c.2, c.3, c.4.0));
    let mut line: Vec<Interval> = Vec::new();
    for one in crossings.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        line.clear();
        let (mut winding, mut lo) = (0i32, EndPoint::default());
        for &(_, _, at, leaving, normal) in one {
            let before = winding;
            winding -= i32::from(leaving);
            let end = EndPoint { at, normal, cut: 0 };
            if before <= 0 && winding > 0 {
                lo = end;
            } else if before > 0 && winding <= 0 && lo.at < at {
                match line.last_mut() {
                    // Bodies that touch are one.
                    Some(last) if last.hi.at == lo.at => last.hi = end,
                    _ => line.push(Interval { lo, hi: end }),
                }
            }
        }
        let (row, column) = (one[0].0, one[0].1);
        tiles[column / edge].set((row % edge) * edge + column % edge, &line);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of twelve triangles.
    fn block(min: DVec3, max: DVec3) -> Mesh {
        let vertices = (0..8)
            .map(|i| {
                DVec3::new(
                    if i & 1 > 0 { max.x } else { min.x },
                    if i & 2 > 0 { max.y } else { min.y },
                    if i & 4 > 0 { max.z } else { min.z },
                )
            })
            .collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
        Mesh { vertices, triangles }
    }

    fn ends(stock: &TriDexel, axis: Axis) -> Vec<Vec<(i32, i32)>> {
        let (a, b) = axis.others();
        let n = stock.lattice().counts;
        (0..n[b.index()])
            .flat_map(|j| (0..n[a.index()]).map(move |i| (i, j)))
            .map(|(i, j)| stock.line(axis, i, j).iter().map(|s| (s.lo.at, s.hi.at)).collect())
            .collect()
    }

    #[test]
    fn a_box_as_mesh_is_the_box() {
        // Diagonals of the square faces run through the lines of the lattice.
        let bounds = Aabb { min: DVec3::ZERO, max: DVec3::new(4.0, 4.0, 3.0) };
        let exact = TriDexel::from_box(bounds, 0.25).unwrap();
        for inside_out in [false, true] {
            let mut mesh = block(bounds.min, bounds.max);
            if inside_out {
                mesh.triangles.iter_mut().for_each(|t| t.swap(0, 1));
            }
            let stock = TriDexel::from_mesh(&mesh, 0.25).unwrap();
            for axis in Axis::ALL {
                assert_eq!(ends(&stock, axis), ends(&exact, axis));
                for i in stock.line(axis, 3, 5) {
                    assert_eq!(i.lo.normal.normal()[axis.index()], -1.0);
                    assert_eq!(i.hi.normal.normal()[axis.index()], 1.0);
                }
            }
        }
    }

    #[test]
    fn overlapping_and_touching_bodies_are_united() {
        let mut mesh = block(DVec3::ZERO, DVec3::new(2.0, 2.0, 2.0));
        for other in [
            block(DVec3::new(1.0, 0.0, 0.0), DVec3::new(3.0, 2.0, 2.0)),
            block(DVec3::new(3.0, 0.0, 0.0), DVec3::new(4.0, 2.0, 2.0)),
        ] {
            let n = mesh.vertices.len() as u32;
            mesh.vertices.extend(other.vertices);
            mesh.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + n)));
        }
        let stock = TriDexel::from_mesh(&mesh, 0.2).unwrap();
        assert_eq!(stock.line(Axis::X, 4, 4).len(), 1);
        for v in stock.volumes() {
            assert!((v - 16.0).abs() < 1e-9, "{v}");
        }
    }

    #[test]
    fn an_open_mesh_is_refused_with_the_place() {
        let mut mesh = block(DVec3::ZERO, DVec3::ONE);
        mesh.triangles.pop();
        let error = TriDexel::from_mesh(&mesh, 0.1).unwrap_err();
        assert_eq!(error.code(), Code::MESH_OPEN);
        // The missing triangle is in the face x = 1.
        assert_eq!(error.0.point.unwrap()[0], 1.0);
        let mut mesh = block(DVec3::ZERO, DVec3::ONE);
        mesh.vertices[3].y = f64::NAN;
        assert_eq!(TriDexel::from_mesh(&mesh, 0.1).unwrap_err().code(), Code::GEOMETRY);
        let mut mesh = block(DVec3::ZERO, DVec3::ONE);
        mesh.triangles[3][1] = 8;
        assert_eq!(TriDexel::from_mesh(&mesh, 0.1).unwrap_err().code(), Code::GEOMETRY);
    }

    #[test]
    fn a_fine_ball_has_even_lines_and_the_volume_of_its_mesh() {
        let (rings, sectors, radius) = (24, 36, 5.0);
        let mut mesh = Mesh::default();
        mesh.vertices.push(DVec3::new(0.0, 0.0, -radius));
        for i in 1..rings {
            let (s, c) = (std::f64::consts::PI * f64::from(i) / f64::from(rings)).sin_cos();
            for j in 0..sectors {
                let (sa, ca) = (std::f64::consts::TAU * f64::from(j) / f64::from(sectors)).sin_cos();
                mesh.vertices.push(DVec3::new(s * ca, s * sa, -c) * radius);
            }
        }
        mesh.vertices.push(DVec3::new(0.0, 0.0, radius));
        let at = |i: u32, j: u32| 1 + (i - 1) * sectors + j % sectors;
        let last = mesh.vertices.len() as u32 - 1;
        for j in 0..sectors {
            mesh.triangles.push([0, at(1, j + 1), at(1, j)]);
            mesh.triangles.push([at(rings - 1, j), at(rings - 1, j + 1), last]);
            for i in 1..rings - 1 {
                mesh.triangles.push([at(i, j), at(i, j + 1), at(i + 1, j + 1)]);
                mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i + 1, j)]);
            }
        }
        // Lines through poles and meridians: a lattice symmetric about the axis.
        let stock = TriDexel::from_mesh(&mesh, 0.1).unwrap();
        for v in stock.volumes() {
            assert!((v / mesh.volume() - 1.0).abs() < 2e-4, "{v} {}", mesh.volume());
        }
        for axis in Axis::ALL {
            assert!(ends(&stock, axis).iter().all(|line| line.len() <= 1));
        }
    }
}
