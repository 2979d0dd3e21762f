//! Part, path and program times as the 3-D view reads them: a small JSON head and streams of variable-length integers
//! in base64, so that a million triangles fit into a few megabytes of page.
//!
//! Numbers are counted in steps, coordinates as differences from the point before. An integer is zigzag coded when
//! it may be negative (0, -1, 1, -2 become 0, 1, 2, 3) and written seven bits a byte, low bits first, high bit set when
//! more follow (LEB128). The reader is `viewer/src/decode.ts`.

use base64::Engine as _;
use serde::Serialize;

use super::{BAND_EDGES, PartView, Report, extremes, thin};
use super::{PathPiece, PathRole};
use crate::page::simplify;

/// Most triangles shown; more would make a browser without a graphics card slow.
const TRIANGLES: usize = 300_000;
/// Coordinates are rounded to this share of the part's size (1 µm on a metre), below what a screen shows.
const POSITION_STEPS: f64 = (1u32 << 20) as f64;
/// Deviation is rounded to this share of the tolerance.
const DEVIATION_STEPS: f64 = 50.0;
/// Deviations are shown up to this multiple of the tolerance.
const DEVIATION_LIMIT: f64 = 20_000.0;
/// The path is shown with this error as a share of its size.
const PATH_ERROR: f64 = 1.0 / 40_000.0;

/// Data of the page for the viewer.
#[derive(Debug, Default)]
pub(super) struct Scene {
    /// JSON head, not yet escaped for a page.
    pub(super) head: String,
    /// Streams by element id.
    pub(super) streams: Vec<(&'static str, String)>,
    /// Cell [mm] to which the mesh was thinned for the screen.
    pub(super) thinned: Option<f64>,
}

#[derive(Serialize)]
struct Head {
    part: Option<PartHead>,
    path: PathHead,
    tools: Vec<ToolHead>,
    axes: Vec<[f32; 3]>,
    roles: [&'static str; PathRole::ALL.len()],
    lines: usize,
}

#[derive(Serialize)]
struct PartHead {
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

#[derive(Serialize)]
struct PathHead {
    pieces: usize,
    step: f64,
}

#[derive(Serialize)]
struct ToolHead {
    number: u32,
    outline: Vec<[f32; 2]>,
    flutes: f64,
}

/// Encodes what the viewer needs of a report.
pub(super) fn scene(report: &Report) -> Scene {
    let mut scene = Scene::default();
    let part = report.part.as_ref().map(|part| {
        let thin = thin::thinned(part, TRIANGLES);
        scene.thinned = thin.as_ref().map(|t| t.1);
        part_streams(thin.as_ref().map_or(part, |t| &t.0), &mut scene.streams)
    });
    let mut axes = Vec::new();
    let path = path_stream(&report.path, &mut axes, &mut scene.streams);
    let mut lines = 0;
    if let Some(program) = &report.program {
        lines = program.lines.len();
        scene.streams.push(("kc-times", counted(&program.time, 1e3)));
        scene.streams.push(("kc-lengths", counted(&program.length, 1e3)));
    }
    let tools = report
        .tools
        .iter()
        .map(|t| ToolHead { number: t.number, outline: finite(t.drawn_outline()), flutes: t.flute_length })
        .collect();
    let head = Head { part, path, tools, axes, roles: PathRole::ALL.map(PathRole::word), lines };
    // Plain numbers and strings always serialise; an empty head makes the viewer say that there is nothing to show.
    scene.head = serde_json::to_string(&head).unwrap_or_default();
    scene
}

fn finite(outline: Vec<[f32; 2]>) -> Vec<[f32; 2]> {
    outline.into_iter().filter(|p| p.iter().all(|v| v.is_finite())).collect()
}

fn part_streams(part: &PartView, streams: &mut Vec<(&'static str, String)>) -> PartHead {
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

    let mut positions = Varints::default();
    let mut last = [0i64; 3];
    for v in &part.vertices {
        for k in 0..3 {
            let q = steps(f64::from(v[k]) - origin[k], step);
            positions.signed(q - last[k]);
            last[k] = q;
        }
    }
    let mut indices = Varints::default();
    let mut shown = 0;
    let mut last = 0i64;
    for t in part.triangles.iter().filter(|t| t.iter().all(|&i| (i as usize) < part.vertices.len())) {
        for &i in t {
            indices.signed(i64::from(i) - last);
            last = i64::from(i);
        }
        shown += 1;
    }
    let tolerance = f64::from(part.tolerance);
    let compared = tolerance > 0.0 && tolerance.is_finite() && extremes(part).is_some();
    let deviation_step = if compared { tolerance / DEVIATION_STEPS } else { 1.0 };
    let mut deviation = Varints::default();
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
    streams.push(("kc-positions", positions.base64()));
    streams.push(("kc-indices", indices.base64()));
    streams.push(("kc-deviation", deviation.base64()));
    PartHead {
        vertices: part.vertices.len(),
        triangles: shown,
        origin,
        step,
        tolerance,
        deviation_step,
        relative: part.relative,
        edges: BAND_EDGES,
        compared,
    }
}

/// For each piece: line as a difference, role, tool, axis, number of points, points as differences.
fn path_stream(
    path: &[PathPiece],
    axes: &mut Vec<[f32; 3]>,
    streams: &mut Vec<(&'static str, String)>,
) -> PathHead {
    let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
    let good = |p: &&[f32; 3]| p.iter().all(|v| v.is_finite());
    for &v in path.iter().flat_map(|p| &p.points).filter(good).flatten() {
        (lo, hi) = (lo.min(f64::from(v)), hi.max(f64::from(v)));
    }
    let extent = hi - lo;
    let extent = if extent.is_finite() && extent > 0.0 { extent } else { 1.0 };
    let step = extent / POSITION_STEPS;
    let mut stream = Varints::default();
    let (mut line, mut last, mut pieces) = (0i64, [0i64; 3], 0);
    for piece in path {
        let points: Vec<[f64; 3]> = piece.points.iter().filter(good).map(|p| p.map(f64::from)).collect();
        if points.is_empty() {
            continue;
        }
        let kept = simplify::kept(&points, extent * PATH_ERROR);
        stream.signed(i64::from(piece.block) - line);
        line = i64::from(piece.block);
        let role = PathRole::ALL.iter().position(|r| *r == piece.role).unwrap_or(0);
        stream.unsigned(role as u64);
        stream.unsigned(u64::from(piece.tool));
        let axis = if piece.axis.iter().all(|v| v.is_finite()) { piece.axis } else { [0.0, 0.0, 1.0] };
        // A path has few distinct axes or one for each piece in order: looking from the end finds both at once.
        let known = axes.iter().rev().take(16).position(|a| *a == axis).map(|back| axes.len() - 1 - back);
        let index = known.unwrap_or_else(|| {
            axes.push(axis);
            axes.len() - 1
        });
        stream.unsigned(index as u64);
        stream.unsigned(kept.len() as u64);
        for i in kept {
            for k in 0..3 {
                let q = steps(points[i][k], step);
                stream.signed(q - last[k]);
                last[k] = q;
            }
        }
        pieces += 1;
    }
    streams.push(("kc-path", stream.base64()));
    PathHead { pieces, step }
}

/// Numbers that are not negative, in steps of 1 / `per_unit`; what is not finite counts as 0.
fn counted(values: &[f32], per_unit: f64) -> String {
    let mut stream = Varints::default();
    for &v in values {
        stream.unsigned(steps(f64::from(v).max(0.0), 1.0 / per_unit) as u64);
    }
    stream.base64()
}

/// A length in whole steps; 0 for what is not finite. Bounded so that differences stay exact in JavaScript (2^53).
fn steps(value: f64, step: f64) -> i64 {
    const LIMIT: f64 = (1u64 << 50) as f64;
    let n = (value / step).round();
    if n.is_finite() { n.clamp(-LIMIT, LIMIT) as i64 } else { 0 }
}

fn zigzag(n: i64) -> u64 {
    ((n << 1) ^ (n >> 63)) as u64
}

#[derive(Default)]
struct Varints(Vec<u8>);

impl Varints {
    fn unsigned(&mut self, mut n: u64) {
        while n >= 0x80 {
            self.0.push(n as u8 | 0x80);
            n >>= 7;
        }
        self.0.push(n as u8);
    }

    fn signed(&mut self, n: i64) {
        self.unsigned(zigzag(n));
    }

    fn base64(&self) -> String {
        base64::engine::general_purpose::STANDARD.encode(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::report::ReportVerdict;

    /// Reads a stream back with arithmetic of its own: powers of 128, halves for the sign.
    fn read(base64: &str) -> Vec<i128> {
        let bytes = base64::engine::general_purpose::STANDARD.decode(base64).unwrap();
        let (mut out, mut n, mut weight) = (Vec::new(), 0i128, 1i128);
        for b in bytes {
            n += i128::from(b % 128) * weight;
            weight *= 128;
            if b < 128 {
                out.push(n);
                (n, weight) = (0, 1);
            }
        }
        out
    }

    fn sign(n: i128) -> i128 {
        if n % 2 == 0 { n / 2 } else { -(n + 1) / 2 }
    }

    fn stream<'a>(scene: &'a Scene, id: &str) -> &'a str {
        &scene.streams.iter().find(|s| s.0 == id).unwrap().1
    }

    #[test]
    fn a_part_comes_back_within_its_step() {
        let mut report = Report::new("t", ReportVerdict::new(crate::job::Judgement::Safe, ""));
        let vertices = vec![[-5.0, 2.0, 7.0], [1000.0, 2.5, -3.25], [f32::NAN, 1e3, 0.1]];
        report.part = Some(PartView {
            vertices: vertices.clone(),
            triangles: vec![[0, 1, 2], [7, 0, 1], [2, 0, 1]],
            deviation: vec![0.01, f32::NAN, -1e9],
            tolerance: 0.02,
            relative: false,
        });
        let scene = scene(&report);
        let head: serde_json::Value = serde_json::from_str(&scene.head).unwrap();
        let step = head["part"]["step"].as_f64().unwrap();
        assert!(step <= 0.001);
        let mut at = [0i128; 3];
        for (i, q) in read(stream(&scene, "kc-positions")).chunks(3).enumerate() {
            for k in 0..3 {
                at[k] += sign(q[k]);
                let back = head["part"]["origin"][k].as_f64().unwrap() + at[k] as f64 * step;
                let was = f64::from(vertices[i][k]);
                assert!(was.is_nan() || (back - was).abs() <= step, "{back} {was}");
            }
        }
        let (mut last, mut indices) = (0, Vec::new());
        for n in read(stream(&scene, "kc-indices")) {
            last += sign(n);
            indices.push(last);
        }
        assert_eq!(indices, [0, 1, 2, 2, 0, 1]);
        assert_eq!(head["part"]["triangles"], 2);
        let codes = read(stream(&scene, "kc-deviation"));
        assert_eq!((sign(codes[0] - 1), codes[1], sign(codes[2] - 1)), (25, 0, -1_000_000));
    }

    #[test]
    fn a_path_comes_back_with_lines_roles_and_axes() {
        let mut report = Report::new("t", ReportVerdict::new(crate::job::Judgement::Safe, ""));
        let mut tilted = PathPiece::new(3, PathRole::Finish, vec![[1.0, 2.0, 3.0], [1.0, 2.0, 103.0]]);
        tilted.axis = [0.6, 0.0, 0.8];
        let straight = (0..100).map(|i| [i as f32, 0.0, 0.0]).collect();
        report.path = vec![
            PathPiece::new(9, PathRole::Rapid, straight),
            PathPiece::new(1, PathRole::Link, Vec::new()),
            tilted,
        ];
        let scene = scene(&report);
        let n = read(stream(&scene, "kc-path"));
        let role = |r| PathRole::ALL.iter().position(|x| *x == r).unwrap() as i128;
        assert_eq!(
            (sign(n[0]), n[1], n[2], n[3], n[4]),
            (9, role(PathRole::Rapid), 0, 0, 2),
            "a straight line needs two points"
        );
        let second = &n[5 + 6..];
        assert_eq!((sign(second[0]), second[1], second[3], second[4]), (3 - 9, role(PathRole::Finish), 1, 2));
        let head: serde_json::Value = serde_json::from_str(&scene.head).unwrap();
        assert_eq!(head["axes"][1][2].as_f64().unwrap() as f32, 0.8);
        assert_eq!(head["path"]["pieces"], 2);
    }

    #[test]
    fn zigzag_orders_small_numbers_first() {
        assert_eq!([0, -1, 1, -2, 2].map(zigzag), [0, 1, 2, 3, 4]);
        assert_eq!(zigzag(i64::MIN), u64::MAX);
    }
}
