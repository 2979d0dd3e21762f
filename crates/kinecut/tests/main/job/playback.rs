//! The stock over time in a job: its last moment is the part of the verdict, its first one the raw stock.

use glam::{DAffine3, DQuat, DVec3};
use kinecut::base::{Code, DiskLoader, MemoryLoader, Result, Silent};
use kinecut::geom::{Mesh, MeshDistance};
use kinecut::job::report::JointView;
use kinecut::job::{Outcome, RunWants, StockWants, report, run_with};
use kinecut::stock::cut::PlayedSurface;

use super::external::{FANUC, PLAIN, job};

fn outcome(text: &str, playback: bool) -> Outcome {
    tried(text, playback).unwrap()
}

fn tried(text: &str, playback: bool) -> Result<Outcome> {
    let wants = RunWants { compare: false, stock: StockWants { playback, ..StockWants::default() } };
    let loader = MemoryLoader::default().with("P.nc", FANUC);
    run_with("job.toml", text, &wants, &loader, &Silent)
}

/// The surface at the end of a tick.
fn at(surface: &PlayedSurface, tick: u16) -> Mesh {
    let there = surface.faces.iter().filter(|face| face.from <= tick && tick < face.to);
    let halves = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    let triangles: Vec<[u32; 3]> = there.flat_map(|face| halves(face.corners)).collect();
    // Corners of other moments would count as part of the body.
    let mut number = vec![u32::MAX; surface.vertices.len()];
    let mut mesh = Mesh::default();
    for triangle in triangles {
        mesh.triangles.push(triangle.map(|corner| {
            let own = &mut number[corner as usize];
            if *own == u32::MAX {
                *own = mesh.vertices.len() as u32;
                mesh.vertices.push(DVec3::from(surface.vertices[corner as usize].map(f64::from)));
            }
            *own
        }));
    }
    mesh
}

/// Greatest distance of the corners and middles of one body's triangles from another.
fn off(one: &Mesh, other: &Mesh) -> f64 {
    let distance = MeshDistance::new(other).unwrap();
    let middles =
        one.triangles.iter().map(|t| t.map(|i| one.vertices[i as usize]).iter().sum::<DVec3>() / 3.0);
    let all = one.vertices.iter().copied().chain(middles);
    all.map(|p| distance.nearest(p).unwrap().distance).fold(0.0, f64::max)
}

#[test]
fn the_last_moment_is_the_part_of_the_verdict_and_the_first_the_raw_stock() {
    let done = outcome(&job("fanuc", PLAIN), true);
    let played = done.simulation.playback.as_ref().unwrap();
    let surface = &played.surface;
    let last = at(surface, surface.ticks);
    let volume = |mesh: &Mesh| mesh.volume();
    assert!(last.triangles.len() > 2000);
    let (there, back) = (off(&last, &done.part), off(&done.part, &last));
    assert!(there <= surface.step && back <= surface.step, "{there} {back} {}", surface.step);
    let lost = done.simulation.raw_volume - done.removed.value;
    assert!((volume(&last) / lost - 1.0).abs() < 0.01, "{} {lost}", volume(&last));
    let first = at(surface, 0);
    assert!((volume(&first) / done.simulation.raw_volume - 1.0).abs() < 0.01);
    // In between material only goes.
    let volumes: Vec<f64> = (0..=8).map(|k| volume(&at(surface, surface.ticks / 8 * k))).collect();
    assert!(volumes.windows(2).all(|pair| pair[1] <= pair[0] + 1.0), "{volumes:?}");
}

#[test]
fn the_report_has_it_with_the_time_of_each_piece_where_it_is_wanted() {
    let report = report::of_job(&outcome(&job("fanuc", PLAIN), true));
    let done: Vec<f32> = report.path.iter().map(|piece| piece.done).collect();
    assert!(done.windows(2).all(|pair| pair[0] <= pair[1]), "{done:?}");
    assert!(done[0] < 0.1 && done[done.len() - 1] == 1.0, "{done:?}");
    // The slot.
    let runs = report.path.iter().flat_map(|piece| &piece.engaged);
    let chips: Vec<f32> =
        runs.filter(|run| (run.arc - 180.0).abs() < 2.0).filter_map(|run| run.chip).collect();
    assert!(chips.iter().any(|chip| (chip - 400.0 / 3000.0 / 2.0).abs() < 1e-4), "{chips:?}");
    let page = report::html(&report);
    assert!(
        page.contains("kc-playback") && page.contains("Stock now") && page.contains("Stock at this moment")
    );
    let without = report::html(&report::of_job(&outcome(&job("fanuc", PLAIN), false)));
    assert!(without.contains("\"playback\":null") && !without.contains("Stock now"));
}

#[test]
fn its_memory_is_told_and_counts() {
    let [with, without] =
        [true, false].map(|playback| outcome(&job("fanuc", PLAIN), playback).simulation.budget);
    assert!(with.playback > 0 && without.playback == 0);
    assert_eq!(with.total(), without.total() + with.playback);
    let little = job("fanuc", PLAIN).replace("step = 0.5", "step = 0.5, memory = 1.0");
    let refused = *tried(&little, true).unwrap_err().0;
    assert_eq!(refused.code, Code::JOB_BUDGET);
    assert!(refused.message.contains("playback: "), "{refused}");
}

/// The data of the machine in the 3-D view, followed by arithmetic of this test: its spindle carries the tool tip along the path.
#[test]
fn the_machine_of_the_view_carries_the_tip_along_the_path() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/18_head_and_table");
    let text = std::fs::read_to_string(folder.join("job.toml")).unwrap();
    let done = run_with("job.toml", &text, &RunWants::default(), &DiskLoader::new(&folder), &Silent).unwrap();
    let report = report::of_job(&done);
    let view = report.machine.as_ref().unwrap();
    let machine = done.job.machine.as_ref().unwrap();
    assert_eq!((view.bed, view.bodies.len()), (machine.code.bed(), machine.bodies.len()));
    let motion = |joint: &JointView, q: f64| {
        let (direction, point) = (DVec3::from(joint.direction), DVec3::from(joint.point));
        if !joint.rotary {
            return DAffine3::from_translation(direction * q);
        }
        let there = DAffine3::from_translation(point);
        there * DAffine3::from_quat(DQuat::from_axis_angle(direction, q)) * there.inverse()
    };
    let (mut compared, mut turned) = (0, 0);
    for piece in &report.path {
        let setup = view.setups.iter().find(|s| (s.lines[0]..s.lines[1]).contains(&piece.block)).unwrap();
        let part = DAffine3::from_cols_array(&setup.part);
        let length = done.job.tools[piece.tool as usize].gauge_length.unwrap();
        let count = view.joints.len();
        for (point, q) in piece.points.iter().zip(piece.joints.chunks(count)) {
            let along = |range: std::ops::Range<usize>| {
                range.fold(DAffine3::IDENTITY, |before, j| before * motion(&view.joints[j], f64::from(q[j])))
            };
            let spindle =
                DAffine3::from_mat3_translation(machine.spindle.rotation, machine.spindle.translation);
            let tip = along(view.bed..count) * spindle * DAffine3::from_translation(DVec3::Z * -length);
            let of_part = part.inverse() * along(0..view.bed) * tip;
            let off = of_part.translation.distance(DVec3::from(point.map(f64::from)));
            assert!(off < 2e-3, "{off} {point:?} {q:?}");
            compared += 1;
            turned += usize::from(q.iter().zip(&view.joints).any(|(q, j)| j.rotary && q.abs() > 0.1));
        }
    }
    assert!(compared > 50 && turned > 20, "{compared} {turned}");
}
