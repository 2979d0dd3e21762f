//! A lighter mesh for the screen: vertices that share a cell of a grid become one.
//!
//! The cell that gives few enough triangles is found by growing it; a joined vertex keeps the deviation that is
//! farthest from zero, so that no gouge disappears. Numbers in the report come from the full mesh.
//!
//! Vertices are joined in runs of a fixed length, then the runs with one another: a run is joined in a small table, and the
//! result is that of one table for all, for any number of threads.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use rayon::prelude::*;

use super::PartView;

/// Vertices joined with one table.
const RUN: usize = 1 << 15;
/// The first cell, for a part of extent 1 and one triangle: a closed surface crosses of the order of n^2 of n^3 cells.
const FIRST: f64 = std::f64::consts::SQRT_2;
/// Share of the limit from which no finer cell is tried: a finer one of half the area has twice as many triangles.
const NEAR: f64 = 0.6;

/// The part with at most `limit` triangles and the cell [mm] that was used; `None` when it is light enough or too
/// strange (not finite) to be thinned.
pub(crate) fn thinned(part: &PartView, limit: usize) -> Option<(PartView, f64)> {
    if part.triangles.len() <= limit {
        return None;
    }
    let finite = part.vertices.par_iter().flatten_iter().all(|v| v.is_finite());
    let bounds = part.vertices.par_iter().map(|v| [v[0].min(v[1]).min(v[2]), v[0].max(v[1]).max(v[2])]);
    let [lo, hi] =
        bounds.reduce(|| [f32::INFINITY, f32::NEG_INFINITY], |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    let extent = f64::from(hi) - f64::from(lo);
    if !finite || extent <= 0.0 {
        return None;
    }
    let round = |cell: f64| {
        let joined = Joined::of(part, f64::from(lo), cell);
        (part.triangles.par_iter().filter(|t| joined.triangle(t).is_some()).count(), joined)
    };
    let mut cell = extent / (limit as f64).sqrt().max(1.0) * FIRST;
    let (mut count, mut joined) = round(cell);
    // Doubling the cell's area each time ends at one cell for the whole part; halving it, at a cell for each vertex. A key
    // has room for 2^21 cells along each axis.
    for _ in 0..16 {
        if count as f64 > limit as f64 * NEAR {
            break;
        }
        let finer = round(cell / std::f64::consts::SQRT_2);
        if finer.0 > limit {
            break;
        }
        cell /= std::f64::consts::SQRT_2;
        (count, joined) = finer;
    }
    for _ in 0..64 {
        if count <= limit {
            let triangles = part.triangles.par_iter().filter_map(|t| joined.triangle(t)).collect();
            return Some((joined.part(part, triangles), cell));
        }
        cell *= std::f64::consts::SQRT_2;
        (count, joined) = round(cell);
    }
    None
}

/// Vertices of a mesh with the joined one of each.
struct Joined {
    /// For each vertex of the mesh the joined one.
    of: Vec<u32>,
    /// For each joined one the first vertex of the mesh in its cell.
    first: Vec<u32>,
    /// For each joined one the deviation farthest from zero; empty where the mesh has none.
    deviation: Vec<f32>,
}

impl Joined {
    fn of(part: &PartView, lo: f64, cell: f64) -> Joined {
        let runs: Vec<Run> = part
            .vertices
            .par_chunks(RUN)
            .enumerate()
            .map(|(i, vertices)| Run::of(vertices, i * RUN, &part.deviation, [lo, cell]))
            .collect();
        let mut ids = Cells::default();
        let mut all = Joined { of: Vec::new(), first: Vec::new(), deviation: Vec::new() };
        let renamed: Vec<Vec<u32>> = runs.iter().map(|run| all.add(run, &mut ids)).collect();
        all.of = Vec::with_capacity(part.vertices.len());
        for (run, renamed) in runs.iter().zip(&renamed) {
            all.of.extend(run.of.iter().map(|&i| renamed[i as usize]));
        }
        all
    }

    /// Joins a run to those before it; the new names of its vertices.
    fn add(&mut self, run: &Run, ids: &mut Cells) -> Vec<u32> {
        let mut renamed = Vec::with_capacity(run.keys.len());
        for (i, key) in run.keys.iter().enumerate() {
            let next = self.first.len() as u32;
            let id = *ids.entry(*key).or_insert(next);
            if id == next {
                self.first.push(run.first[i]);
            }
            if let Some(&d) = run.deviation.get(i) {
                keep(&mut self.deviation, id, d);
            }
            renamed.push(id);
        }
        renamed
    }

    fn triangle(&self, corners: &[u32; 3]) -> Option<[u32; 3]> {
        let mut n = [0; 3];
        for (n, &i) in n.iter_mut().zip(corners) {
            *n = *self.of.get(i as usize)?;
        }
        (n[0] != n[1] && n[1] != n[2] && n[2] != n[0]).then_some(n)
    }

    fn part(self, full: &PartView, triangles: Vec<[u32; 3]>) -> PartView {
        PartView {
            vertices: self.first.iter().map(|&i| full.vertices[i as usize]).collect(),
            triangles,
            deviation: self.deviation,
            tolerance: full.tolerance,
            relative: full.relative,
        }
    }
}

/// Cells by their keys: their numbers along the axes, 21 bits each.
type Cells = HashMap<u64, u32, BuildHasherDefault<Mixer>>;

/// Mixes the bits of a key: cells next to each other differ in few of them.
#[derive(Default)]
struct Mixer(u64);

impl Hasher for Mixer {
    fn write_u64(&mut self, key: u64) {
        let wide = u128::from(key ^ 0x9e37_79b9_7f4a_7c15) * 0xd6e8_feb8_6659_fd93_u128;
        self.0 = wide as u64 ^ (wide >> 64) as u64;
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|b| self.write_u64(self.0 ^ u64::from(*b)));
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

/// The joined vertices of a run of neighbours in the mesh.
struct Run {
    of: Vec<u32>,
    keys: Vec<u64>,
    first: Vec<u32>,
    deviation: Vec<f32>,
}

impl Run {
    fn of(vertices: &[[f32; 3]], start: usize, deviation: &[f32], [lo, cell]: [f64; 2]) -> Run {
        let mut run =
            Run { of: Vec::with_capacity(vertices.len()), keys: vec![], first: vec![], deviation: vec![] };
        let mut ids = Cells::default();
        let (mut last, by) = (None, 1.0 / cell);
        for (i, v) in vertices.iter().enumerate() {
            let [x, y, z] = v.map(|x| ((f64::from(x) - lo) * by) as u64);
            let key = x << 42 | y << 21 | z;
            let next = run.keys.len() as u32;
            // Neighbours often share a cell.
            let id = match last {
                Some((last, id)) if last == key => id,
                _ => *ids.entry(key).or_insert(next),
            };
            last = Some((key, id));
            if id == next {
                run.keys.push(key);
                run.first.push((start + i) as u32);
            }
            if !deviation.is_empty() {
                keep(&mut run.deviation, id, deviation.get(start + i).copied().unwrap_or(f32::NAN));
            }
            run.of.push(id);
        }
        run
    }
}

/// Keeps a deviation with those known, the one farther from zero where it has one already.
fn keep(known: &mut Vec<f32>, id: u32, d: f32) {
    match known.get_mut(id as usize) {
        Some(kept) if kept.is_nan() || d.abs() > kept.abs() => *kept = d,
        Some(_) => {}
        None => known.push(d),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(n: u32) -> PartView {
        let mut part = PartView {
            vertices: Vec::new(),
            triangles: Vec::new(),
            deviation: Vec::new(),
            tolerance: 0.01,
            relative: false,
        };
        for j in 0..=n {
            for i in 0..=n {
                part.vertices.push([100.0 * i as f32 / n as f32, 100.0 * j as f32 / n as f32, 0.0]);
                part.deviation.push(if (i, j) == (n / 3, n / 2) { -0.5 } else { 0.001 });
            }
        }
        for j in 0..n {
            for i in 0..n {
                let a = j * (n + 1) + i;
                part.triangles.push([a, a + 1, a + n + 2]);
                part.triangles.push([a, a + n + 2, a + n + 1]);
            }
        }
        part
    }

    #[test]
    fn a_thin_mesh_fits_keeps_its_place_and_its_worst_gouge() {
        let full = sheet(200);
        let (thin, cell) = thinned(&full, 5000).unwrap();
        assert!(thin.triangles.len() <= 5000 && thin.triangles.len() > 500, "{}", thin.triangles.len());
        let worst = (0..thin.vertices.len())
            .min_by(|&a, &b| thin.deviation[a].total_cmp(&thin.deviation[b]))
            .unwrap();
        assert_eq!(thin.deviation[worst], -0.5);
        let [x, y, _] = thin.vertices[worst];
        assert!((f64::from(x) - 33.0).abs() <= cell && (f64::from(y) - 50.0).abs() <= cell);
        assert!(thinned(&full, 80_000).is_none());
    }

    /// Runs leave no trace: each cell has one vertex, the first of the mesh in it.
    #[test]
    fn vertices_of_several_runs_are_joined_as_those_of_one() {
        let full = sheet(250);
        assert!(full.vertices.len() > RUN);
        let (thin, cell) = thinned(&full, 20_000).unwrap();
        let key = |v: &[f32; 3]| v.map(|x| (f64::from(x) * (1.0 / cell)) as i64);
        let mut cells = std::collections::BTreeMap::new();
        let mut firsts = Vec::new();
        for v in &full.vertices {
            cells.entry(key(v)).or_insert_with(|| firsts.push(*v));
        }
        assert_eq!(thin.vertices, firsts);
        assert_eq!(thin.deviation.len(), firsts.len());
    }
}
