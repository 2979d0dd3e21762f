//! The cut part: corners in steps, triangles in the order of their least corner, deviation at each corner.

use rayon::prelude::*;
use serde::Serialize;

use super::numbers::{Numbers, steps, zigzag};
use super::{POSITION_STEPS, PartView, Streams};
use crate::job::report::{BAND_EDGES, extremes};

/// Deviation is rounded to this share of the tolerance.
const DEVIATION_STEPS: f64 = 50.0;
/// Deviations are shown up to this multiple of the tolerance.
const DEVIATION_LIMIT: f64 = 20_000.0;

#[derive(Serialize)]
pub(super) struct PartHead {
    vertices: usize,
    triangles: usize,
    origin: [f64; 3],
    step: f64,
    tolerance: f64,
    deviation_step: f64,
    /// Whether deviations count in tolerances.
    relative: bool,
    edges: [f64; BAND_EDGES.len()],
    compared: bool,
}

pub(super) fn streams(part: &PartView, streams: &mut Streams) -> PartHead {
    let (mut lo, mut hi) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for v in part.vertices.iter().filter(|v| v.iter().all(|x| x.is_finite())) {
        for k in 0..3 {
            lo[k] = lo[k].min(f64::from(v[k]));
            hi[k] = hi[k].max(f64::from(v[k]));
        }
    }
    let extent = (0..3).map(|k| hi[k] - lo[k]).fold(0.0, f64::max);
    let origin = if extent.is_finite() && lo[0].is_finite() { lo } else { [0.0; 3] };
    let step = if extent > 0.0 && extent.is_finite() { extent / POSITION_STEPS } else { 1e-3 };

    let mut positions = Numbers::default();
    for k in 0..3 {
        let column: Vec<i64> =
            part.vertices.iter().map(|v| steps(f64::from(v[k]) - origin[k], step)).collect();
        positions.column(&column);
    }
    let triangles = in_order(part);
    let tolerance = f64::from(part.tolerance);
    let compared = tolerance > 0.0 && tolerance.is_finite() && extremes(part).is_some();
    let deviation_step = if compared { tolerance / DEVIATION_STEPS } else { 1.0 };
    let mut deviation = Numbers::default();
    if compared {
        for i in 0..part.vertices.len() {
            match part.deviation.get(i).map(|&d| f64::from(d)) {
                Some(d) if d.is_finite() => {
                    let limit = DEVIATION_LIMIT * tolerance;
                    deviation.unsigned(1 + zigzag(steps(d.clamp(-limit, limit), deviation_step)));
                }
                _ => deviation.unsigned(0),
            }
        }
    }
    streams.push(("kc-positions", positions.0));
    streams.push(("kc-indices", indices(&triangles)));
    streams.push(("kc-deviation", deviation.0));
    PartHead {
        vertices: part.vertices.len(),
        triangles: triangles.len(),
        origin,
        step,
        tolerance,
        deviation_step,
        relative: part.relative,
        edges: BAND_EDGES,
        compared,
    }
}

/// The triangles that can be shown, each turned so that its least corner comes first, by their corners: neighbours follow
/// one another.
fn in_order(part: &PartView) -> Vec<[u32; 3]> {
    let whole = |t: &&[u32; 3]| t.iter().all(|&i| (i as usize) < part.vertices.len());
    let turned = |&[a, b, c]: &[u32; 3]| match () {
        () if a <= b && a <= c => [a, b, c],
        () if b <= a && b <= c => [b, c, a],
        () => [c, a, b],
    };
    let mut triangles: Vec<[u32; 3]> = part.triangles.iter().filter(whole).map(turned).collect();
    triangles.par_sort_unstable();
    triangles
}

/// For each triangle its first corner as a difference from the triangle before, each other one from the corner before.
fn indices(triangles: &[[u32; 3]]) -> Vec<u8> {
    let mut indices = Numbers::default();
    let mut last = 0;
    for &[a, b, c] in triangles {
        indices.unsigned(u64::from(a - last));
        indices.signed(i64::from(b) - i64::from(a));
        indices.signed(i64::from(c) - i64::from(b));
        last = a;
    }
    indices.0
}

#[cfg(test)]
mod tests {
    use super::super::numbers::tests::Reader;
    use super::super::tests::{report, stream};
    use super::*;

    #[test]
    fn a_part_comes_back_within_its_step() {
        let mut report = report();
        let vertices = vec![[-5.0, 2.0, 7.0], [1000.0, 2.5, -3.25], [f32::NAN, 1e3, 0.1]];
        report.part = Some(PartView {
            vertices: vertices.clone(),
            triangles: vec![[1, 2, 0], [7, 0, 1], [2, 1, 1], [0, 2, 1]],
            deviation: vec![0.01, f32::NAN, -1e9],
            tolerance: 0.02,
            relative: false,
        });
        let scene = super::super::scene(&report);
        let head: serde_json::Value = serde_json::from_str(&scene.head).unwrap();
        let step = head["part"]["step"].as_f64().unwrap();
        assert!(step <= 0.001);
        let mut positions = Reader::of(stream(&scene, "kc-positions"));
        for k in 0..3 {
            for (i, n) in positions.column(vertices.len()).into_iter().enumerate() {
                let back = head["part"]["origin"][k].as_f64().unwrap() + n as f64 * step;
                let was = f64::from(vertices[i][k]);
                assert!(was.is_nan() || (back - was).abs() <= step, "{back} {was}");
            }
        }
        assert_eq!(head["part"]["triangles"], 3);
        let mut corners = Reader::of(stream(&scene, "kc-indices"));
        let half = |n: i128| if n % 2 == 0 { n / 2 } else { -(n + 1) / 2 };
        let (mut first, mut triangles) = (0, Vec::new());
        while !corners.is_done() {
            first += corners.unsigned();
            let second = first + half(corners.unsigned());
            triangles.push([first, second, second + half(corners.unsigned())]);
        }
        assert_eq!(triangles, [[0, 1, 2], [0, 2, 1], [1, 1, 2]], "each keeps its sense");
        let mut codes = Reader::of(stream(&scene, "kc-deviation"));
        let codes: Vec<i128> = (0..3).map(|_| codes.unsigned()).collect();
        assert_eq!((half(codes[0] - 1), codes[1], half(codes[2] - 1)), (25, 0, -1_000_000));
    }
}
