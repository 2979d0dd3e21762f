//! Raw stock that is larger by a distance on all sides: it holds every place that far from the stock.
//!
//! Of a box and a cylinder the faces move, so that corners reach farther. A mesh keeps its lines, and each of its triangles adds all within
//! the distance: a prism with a rounded edge, of which a line has the stretch between the least and the greatest of the places at which it crosses
//! the prism, three cylinders and three balls, as their union is convex.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::raw::class;
use super::tile::{TILE_EDGE, Tile};
use super::tri_dexel::{Grid, LINE_OFFSET};
use super::{Axis, DexelGrid, EndPoint, FIXED_STEP, Interval, Lattice, PackedNormal, TriDexel, fixed};
use crate::base::{Code, Finding, Result};
use crate::geom::{Aabb, Mesh, Solid};

/// Most pairs of a triangle and a line near it: a minute of work.
const MOST_PAIRS: f64 = 4e9;

impl TriDexel {
    /// The stock of a solid that is larger by `by` [mm] on all sides.
    ///
    /// ```
    /// # use kinecut_stock as kinecut;
    /// use kinecut::geom::{Aabb, Solid};
    /// use kinecut::stock::TriDexel;
    /// let plate = Solid::Box(Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() });
    /// let stock = TriDexel::from_solid_grown(&plate, 0.5, 0.25).unwrap();
    /// assert!((stock.volume() - 41.0 * 21.0 * 11.0).abs() < 1e-6);
    /// ```
    ///
    /// # Errors
    /// Those of [`TriDexel::from_solid`]; `KC0801` when `by` is negative or not finite; `KC0105` for a mesh whose triangles are
    /// near to too many lines.
    pub fn from_solid_grown(solid: &Solid, by: f64, step: f64) -> Result<TriDexel> {
        if !(by.is_finite() && by >= 0.0) {
            return Err(Finding::error(Code::GEOMETRY, "the stock cannot be made larger by that")
                .value_mm(by)
                .bound_mm(0.0)
                .into());
        }
        match solid {
            Solid::Box(bounds) => TriDexel::from_box(bounds.grown(by), step),
            Solid::Cylinder { base, radius, height } => {
                TriDexel::from_cylinder(*base - DVec3::Z * by, radius + by, height + 2.0 * by, step)
            }
            Solid::Mesh(mesh) => {
                let mut stock = TriDexel::of_mesh(mesh, mesh.bounds().grown(by), step)?;
                if by > 0.0 {
                    stock.add_rounded(mesh, by)?;
                }
                Ok(stock)
            }
        }
    }

    /// Adds all within a distance of the triangles of a mesh.
    fn add_rounded(&mut self, mesh: &Mesh, by: f64) -> Result<()> {
        let lattice = *self.lattice();
        let rounded = |t: &[u32; 3]| Rounded::new(t.map(|i| mesh.vertices[i as usize]), by);
        let all: Vec<Rounded> = mesh.triangles.iter().map(rounded).collect();
        let pairs: f64 = Axis::ALL.iter().map(|axis| pairs(&all, &lattice, *axis)).sum();
        if pairs > MOST_PAIRS {
            return Err(Finding::error(
                Code::JOB_BUDGET,
                "the mesh of the stock has too many triangles to be made larger at this step",
            )
            .value(pairs, "lines near its triangles")
            .bound(MOST_PAIRS, "lines near its triangles")
            .help("use a greater step, or give the stock as a block or a cylinder")
            .into());
        }
        for grid in &mut self.grids {
            add(grid, &lattice, &all);
        }
        Ok(())
    }
}

/// The indices of the lines beside which a rounded triangle lies, along an axis across them.
fn beside(one: &Rounded, lattice: &Lattice, axis: Axis) -> Range<usize> {
    let range = lattice.between(axis, [one.bounds.min[axis.index()], one.bounds.max[axis.index()]]);
    range.start as usize..range.end as usize
}

/// Number of pairs of a triangle and a line along an axis that may be near it.
fn pairs(all: &[Rounded], lattice: &Lattice, axis: Axis) -> f64 {
    let (a, b) = axis.others();
    let of = |r: &Rounded| beside(r, lattice, a).len() as f64 * beside(r, lattice, b).len() as f64;
    all.iter().map(of).sum()
}

/// Adds rounded triangles to the lines of a grid.
fn add(grid: &mut Grid, lattice: &Lattice, all: &[Rounded]) {
    let axis = grid.axis;
    let (_, b) = axis.others();
    let [across, bands] = grid.tiles_across();
    let rows = |r: &Rounded| beside(r, lattice, b);
    let mut in_band = vec![Vec::new(); bands as usize];
    for (i, one) in all.iter().enumerate() {
        let reach = rows(one);
        if !reach.is_empty() {
            let edge = TILE_EDGE as usize;
            in_band[reach.start / edge..=(reach.end - 1) / edge].iter_mut().for_each(|band| band.push(i));
        }
    }
    grid.tiles.par_chunks_mut(across as usize).enumerate().for_each(|(band, tiles)| {
        let near: Vec<&Rounded> = in_band[band].iter().map(|i| &all[*i]).collect();
        add_to_band(tiles, band, &near, axis, lattice);
    });
}

/// Adds rounded triangles to the tiles of one band of rows.
fn add_to_band(tiles: &mut [Tile], band: usize, near: &[&Rounded], axis: Axis, lattice: &Lattice) {
    let edge = TILE_EDGE as usize;
    let (a, b) = axis.others();
    let count = lattice.counts[b.index()] as usize;
    let columns = lattice.counts[a.index()] as usize;
    let mut stretches: Vec<Vec<[i32; 2]>> = vec![Vec::new(); columns];
    for row in band * edge..((band + 1) * edge).min(count) {
        let y = lattice.coordinate(b, row as u32) + LINE_OFFSET;
        for one in near {
            let [low, high] = [one.bounds.min, one.bounds.max];
            if y < low[b.index()] || y > high[b.index()] {
                continue;
            }
            for column in beside(one, lattice, a) {
                let mut p = DVec3::ZERO;
                p[a.index()] = lattice.coordinate(a, column as u32) + LINE_OFFSET;
                p[b.index()] = y;
                if let Some([from, to]) = one.on_line(p, axis.index()) {
                    stretches[column].push([fixed(from - FIXED_STEP), fixed(to + FIXED_STEP)]);
                }
            }
        }
        for (column, added) in stretches.iter_mut().enumerate().filter(|(_, added)| !added.is_empty()) {
            let (tile, line) = (&mut tiles[column / edge], (row % edge) * edge + column % edge);
            added.extend(tile.line(line).iter().map(|i| [i.lo.at, i.hi.at]));
            tile.set(line, &united(added, axis.index()));
            added.clear();
        }
    }
}

/// The union of stretches of a line.
fn united(stretches: &mut [[i32; 2]], axis: usize) -> Vec<Interval> {
    stretches.sort_unstable();
    let end = |at: i32, sign: f64| {
        let normal = PackedNormal::new(DVec3::AXES[axis] * sign, class::face(axis, sign > 0.0));
        EndPoint { at, normal, cut: 0 }
    };
    let mut line: Vec<Interval> = Vec::new();
    for &[from, to] in stretches.iter() {
        match line.last_mut() {
            Some(last) if from <= last.hi.at => last.hi.at = last.hi.at.max(to),
            _ => line.push(Interval { lo: end(from, -1.0), hi: end(to, 1.0) }),
        }
    }
    line
}

/// All places within a distance of a triangle.
struct Rounded {
    corners: [DVec3; 3],
    /// Of unit length; zero for a triangle without area.
    normal: DVec3,
    by: f64,
    bounds: Aabb,
}

impl Rounded {
    fn new(corners: [DVec3; 3], by: f64) -> Rounded {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
        Rounded { corners, normal, by, bounds: Aabb::of_points(corners).grown(by) }
    }

    /// The stretch of the line through a point along an axis that is within.
    fn on_line(&self, p: DVec3, axis: usize) -> Option<[f64; 2]> {
        let mut found: Option<[f64; 2]> = None;
        let mut take = |stretch: Option<[f64; 2]>| {
            if let Some([from, to]) = stretch {
                found = Some(found.map_or([from, to], |[low, high]: [f64; 2]| [low.min(from), high.max(to)]));
            }
        };
        take(self.prism(p, axis));
        for i in 0..3 {
            let (from, to) = (self.corners[i], self.corners[(i + 1) % 3]);
            take(ball(from, self.by, p, axis));
            take(tube(from, to, self.by, p, axis));
        }
        found
    }

    /// The stretch within the prism of the triangle.
    fn prism(&self, p: DVec3, axis: usize) -> Option<[f64; 2]> {
        if self.normal == DVec3::ZERO {
            return None;
        }
        let mut stretch = [f64::NEG_INFINITY, f64::INFINITY];
        let d = self.normal;
        clip(&mut stretch, d, self.by - d.dot(p - self.corners[0]), axis)?;
        clip(&mut stretch, -d, self.by + d.dot(p - self.corners[0]), axis)?;
        for i in 0..3 {
            let (from, to) = (self.corners[i], self.corners[(i + 1) % 3]);
            let out = (to - from).cross(self.normal);
            clip(&mut stretch, out, -out.dot(p - from), axis)?;
        }
        Some(stretch)
    }
}

/// Shortens a stretch of a line to where `direction . (place - p) <= room`, `p` at the coordinate of the line's point along its axis.
fn clip(stretch: &mut [f64; 2], direction: DVec3, room: f64, axis: usize) -> Option<()> {
    let slope = direction[axis];
    // The point of the line has its coordinate along the axis as zero.
    match slope {
        0.0 if room < 0.0 => return None,
        0.0 => {}
        s if s > 0.0 => stretch[1] = stretch[1].min(room / s),
        s => stretch[0] = stretch[0].max(room / s),
    }
    (stretch[0] <= stretch[1]).then_some(())
}

/// The stretch of a line within a ball.
fn ball(centre: DVec3, radius: f64, p: DVec3, axis: usize) -> Option<[f64; 2]> {
    let mut d = p - centre;
    d[axis] = 0.0;
    let half = radius * radius - d.length_squared();
    (half >= 0.0).then(|| [centre[axis] - half.sqrt(), centre[axis] + half.sqrt()])
}

/// The stretch of a line within a cylinder between two points.
fn tube(from: DVec3, to: DVec3, radius: f64, p: DVec3, axis: usize) -> Option<[f64; 2]> {
    let along = (to - from).try_normalize()?;
    let length = (to - from).length();
    // Across the cylinder's axis: |u + t v| <= radius.
    let across = |v: DVec3| v - along * along.dot(v);
    let (u, v) = (across(p - from), across(DVec3::AXES[axis]));
    let (a, b, c) = (v.length_squared(), u.dot(v), u.length_squared() - radius * radius);
    let mut stretch = if a > 1e-18 {
        let root = b * b - a * c;
        if root < 0.0 {
            return None;
        }
        [(-b - root.sqrt()) / a, (-b + root.sqrt()) / a]
    } else if c <= 0.0 {
        [f64::NEG_INFINITY, f64::INFINITY]
    } else {
        return None;
    };
    clip(&mut stretch, along, length - along.dot(p - from), axis)?;
    clip(&mut stretch, -along, along.dot(p - from), axis)?;
    Some(stretch)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::MeshDistance;
    use crate::stock::unfixed;

    /// A tetrahedron, and a triangle on one of its edges that has no area.
    fn mesh() -> Mesh {
        let vertices =
            [[0.0, 0.0, 0.0], [9.0, 1.0, 0.5], [2.0, 8.0, -1.0], [1.5, 2.5, 6.0]].map(DVec3::from).to_vec();
        Mesh { vertices, triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 1, 0]] }
    }

    #[test]
    fn a_mesh_grows_by_a_ball() {
        let (mesh, by) = (mesh(), 0.7);
        let solid = Solid::Mesh(mesh.clone());
        let stock = TriDexel::from_solid_grown(&solid, by, 0.31).unwrap();
        let four = Mesh { triangles: mesh.triangles[..4].to_vec(), ..mesh };
        let distance = MeshDistance::new(&four).unwrap();
        let lattice = *stock.lattice();
        let mut ends = 0;
        for axis in Axis::ALL {
            let (a, b) = axis.others();
            for j in 0..lattice.counts[b.index()] {
                for i in 0..lattice.counts[a.index()] {
                    let mut p = DVec3::ZERO;
                    p[a.index()] = lattice.coordinate(a, i) + LINE_OFFSET;
                    p[b.index()] = lattice.coordinate(b, j) + LINE_OFFSET;
                    let line = stock.line(axis, i, j);
                    assert!(line.len() <= 1);
                    // Each end is the distance away, and half way between points of the line nothing is nearer than it.
                    for end in line.iter().flat_map(|i| [i.lo, i.hi]) {
                        p[axis.index()] = unfixed(end.at);
                        assert!((distance.signed(p).abs() - by).abs() < 3e-5, "{p} {}", distance.signed(p));
                        ends += 1;
                    }
                    for k in 0..40 {
                        p[axis.index()] = f64::from(k) * 0.3 - 2.5;
                        let at = fixed(p[axis.index()]);
                        let inside = line.iter().any(|i| i.lo.at <= at && at < i.hi.at);
                        let away = distance.signed(p);
                        assert!(inside || away.abs() > by - 1e-4, "{p} {away}");
                    }
                }
            }
        }
        assert!(ends > 3000, "{ends}");
    }
}
