//! Clamps and fixtures: corners in steps and triangles of all, one after the other.

use serde::Serialize;

use super::Streams;
use super::numbers::{Numbers, steps};
use crate::job::report::FixtureView;

/// Coordinates are rounded to this [mm].
const UNIT: f64 = 1e-3;

#[derive(Serialize)]
pub(super) struct FixtureHead<'a> {
    name: &'a str,
    /// Lines of the programs in which it is there: from the first to before the last.
    lines: [u32; 2],
    vertices: usize,
    triangles: usize,
}

pub(super) fn stream<'a>(fixtures: &'a [FixtureView], streams: &mut Streams) -> Vec<FixtureHead<'a>> {
    if fixtures.is_empty() {
        return Vec::new();
    }
    let mut numbers = Numbers::default();
    for k in 0..3 {
        let all = fixtures.iter().flat_map(|f| &f.vertices);
        numbers.column(&all.map(|v| steps(f64::from(v[k]), UNIT)).collect::<Vec<_>>());
    }
    for k in 0..3 {
        let all = fixtures.iter().flat_map(|f| &f.triangles);
        numbers.column(&all.map(|t| i64::from(t[k])).collect::<Vec<_>>());
    }
    streams.push(("kc-fixtures", numbers.0));
    let head = |f: &'a FixtureView| FixtureHead {
        name: &f.name,
        lines: f.lines,
        vertices: f.vertices.len(),
        triangles: f.triangles.len(),
    };
    fixtures.iter().map(head).collect()
}

#[cfg(test)]
mod tests {
    use super::super::numbers::tests::Reader;
    use super::super::tests::{report, stream};
    use super::*;

    #[test]
    fn bodies_come_back_one_after_the_other() {
        let mut report = report();
        let fixture = |name: &str, lines, z| FixtureView {
            name: name.to_owned(),
            lines,
            vertices: vec![[0.0, 0.0, z], [1.5, 0.0, z], [0.0, -2.0, z]],
            triangles: vec![[0, 2, 1]],
        };
        report.fixtures = vec![fixture("left clamp", [0, 40], -7.25), fixture("vise (bed)", [40, 90], 1e4)];
        let scene = super::super::scene(&report);
        let head: serde_json::Value = serde_json::from_str(&scene.head).unwrap();
        assert_eq!(
            head["fixtures"][1],
            serde_json::json!({"name": "vise (bed)", "lines": [40, 90], "vertices": 3, "triangles": 1})
        );
        let mut read = Reader::of(stream(&scene, "kc-fixtures"));
        assert_eq!(read.column(6), [0, 1500, 0, 0, 1500, 0]);
        assert_eq!(read.column(6), [0, 0, -2000, 0, 0, -2000]);
        assert_eq!(read.column(6), [-7250, -7250, -7250, 10_000_000, 10_000_000, 10_000_000]);
        assert_eq!((read.column(2), read.column(2), read.column(2)), (vec![0, 0], vec![2, 2], vec![1, 1]));
        assert!(read.is_done());
    }
}
