//! A lighter mesh for the screen: vertices that share a cell of a grid become one.
//!
//! The cell that gives few enough triangles is found by growing it; a joined vertex keeps the deviation that is
//! farthest from zero, so that no gouge disappears. Numbers in the report come from the full mesh.

use std::collections::BTreeMap;

use super::PartView;

/// The part with at most `limit` triangles and the cell [mm] that was used; `None` when it is light enough or too
/// strange (not finite) to be thinned.
pub(crate) fn thinned(part: &PartView, limit: usize) -> Option<(PartView, f64)> {
    if part.triangles.len() <= limit {
        return None;
    }
    let finite = part.vertices.iter().flatten().all(|v| v.is_finite());
    let (lo, hi) = part
        .vertices
        .iter()
        .flatten()
        .fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)));
    let extent = f64::from(hi) - f64::from(lo);
    if !finite || extent <= 0.0 {
        return None;
    }
    // A closed surface in n^3 cells crosses of the order of n^2 of them; from there the cell grows until it fits.
    let mut cell = extent / (limit as f64).sqrt().max(1.0) / 2.0;
    // Doubling the cell's area each time ends at one cell for the whole part after at most 64 rounds.
    for _ in 0..64 {
        let thin = clustered(part, cell);
        if thin.triangles.len() <= limit {
            return Some((thin, cell));
        }
        cell *= std::f64::consts::SQRT_2;
    }
    None
}

fn clustered(part: &PartView, cell: f64) -> PartView {
    let mut ids: BTreeMap<[i64; 3], u32> = BTreeMap::new();
    let mut thin = PartView {
        vertices: Vec::new(),
        triangles: Vec::new(),
        deviation: Vec::new(),
        tolerance: part.tolerance,
        relative: part.relative,
    };
    let mut of = Vec::with_capacity(part.vertices.len());
    for (i, v) in part.vertices.iter().enumerate() {
        let key = v.map(|x| (f64::from(x) / cell).floor() as i64);
        let next = thin.vertices.len() as u32;
        let id = *ids.entry(key).or_insert(next);
        let d = part.deviation.get(i).copied().unwrap_or(f32::NAN);
        if id == next {
            thin.vertices.push(*v);
            thin.deviation.push(d);
        } else {
            let kept = &mut thin.deviation[id as usize];
            if kept.is_nan() || d.abs() > kept.abs() {
                *kept = d;
            }
        }
        of.push(id);
    }
    if part.deviation.is_empty() {
        thin.deviation.clear();
    }
    thin.triangles = part
        .triangles
        .iter()
        .filter_map(|t| {
            let mut n = [0; 3];
            for (n, &i) in n.iter_mut().zip(t) {
                *n = *of.get(i as usize)?;
            }
            (n[0] != n[1] && n[1] != n[2] && n[2] != n[0]).then_some(n)
        })
        .collect();
    thin
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
}
