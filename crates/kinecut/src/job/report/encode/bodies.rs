//! Clamps, fixtures and the machine: corners in steps and triangles of all bodies, one after the other; joints, and the body that each carries.

use serde::Serialize;

use super::Streams;
use super::numbers::{Numbers, steps};
use crate::job::report::{BodyView, FixtureView, JointView, MachineSetup, MachineView};

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

#[derive(Serialize)]
pub(super) struct MachineHead<'a> {
    joints: &'a [JointView],
    bed: usize,
    setups: &'a [MachineSetup],
    bodies: Vec<LinkBodyHead<'a>>,
}

#[derive(Serialize)]
struct LinkBodyHead<'a> {
    name: &'a str,
    link: Option<usize>,
    vertices: usize,
    triangles: usize,
}

pub(super) fn fixtures<'a>(fixtures: &'a [FixtureView], streams: &mut Streams) -> Vec<FixtureHead<'a>> {
    stream("kc-fixtures", fixtures.iter().map(|f| &f.body), streams);
    let head = |f: &'a FixtureView| FixtureHead {
        name: &f.body.name,
        lines: f.lines,
        vertices: f.body.vertices.len(),
        triangles: f.body.triangles.len(),
    };
    fixtures.iter().map(head).collect()
}

pub(super) fn machine<'a>(machine: &'a MachineView, streams: &mut Streams) -> MachineHead<'a> {
    stream("kc-machine", machine.bodies.iter().map(|(_, body)| body), streams);
    let head = |(link, body): &'a (Option<usize>, BodyView)| LinkBodyHead {
        name: &body.name,
        link: *link,
        vertices: body.vertices.len(),
        triangles: body.triangles.len(),
    };
    MachineHead {
        joints: &machine.joints,
        bed: machine.bed,
        setups: &machine.setups,
        bodies: machine.bodies.iter().map(head).collect(),
    }
}

fn stream<'a>(id: &'static str, bodies: impl Iterator<Item = &'a BodyView> + Clone, streams: &mut Streams) {
    if bodies.clone().next().is_some() {
        streams.push((id, numbers(bodies).0));
    }
}

/// Corners and triangles of bodies, one after the other.
pub(super) fn numbers<'a>(bodies: impl Iterator<Item = &'a BodyView> + Clone) -> Numbers {
    let mut numbers = Numbers::default();
    for k in 0..3 {
        let all = bodies.clone().flat_map(|body| &body.vertices);
        numbers.column(&all.map(|v| steps(f64::from(v[k]), UNIT)).collect::<Vec<_>>());
    }
    for k in 0..3 {
        let all = bodies.clone().flat_map(|body| &body.triangles);
        numbers.column(&all.map(|t| i64::from(t[k])).collect::<Vec<_>>());
    }
    numbers
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
            lines,
            body: BodyView {
                name: name.to_owned(),
                vertices: vec![[0.0, 0.0, z], [1.5, 0.0, z], [0.0, -2.0, z]],
                triangles: vec![[0, 2, 1]],
            },
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
