//! The trimmed envelope: against brute force over all moments, closed forms, and what the same move cuts out of a stock.

#![allow(clippy::print_stdout, reason = "the long check tells what it measured")]

use glam::DVec3;
use kinecut::base::{Code, Silent};
use kinecut::geom::{Curve, Line, MeshDistance, Profile};
use kinecut::stock::cut::{CutMove, CutOptions, ToolBody, cut};
use kinecut::stock::surface::{SurfaceOptions, surface};
use kinecut::stock::{TriDexel, TrimmedEnvelope, trimmed_envelope};
use kinecut::sweep::{SweptDepth, ToolMotion};
use kinecut::tool::Contour;
use kinecut_cases::weekly;

use super::envelope::{TOOLS, moves};
use crate::common::golden;
use crate::common::random::Random;
use crate::common::sweep_brute::{Brute, MANY};
use crate::common::sweep_golden::contour;

fn trimmed(contour: &Contour, motion: &ToolMotion, tolerance: f64, step: Option<f64>) -> TrimmedEnvelope {
    trimmed_envelope((contour, motion), tolerance, step, &Silent).unwrap()
}

/// All tools and moves: the mesh closes, no vertex lies deeper in what is swept than the tolerance nor farther outside, and points of the
/// boundary of what is swept lie on it. In the weekly form more of them, on finer lines.
#[test]
fn no_vertex_lies_inside_of_what_is_swept() {
    const TOLERANCE: f64 = 0.05;
    let golden = golden::file("sweep");
    let (step, vertices, lines) = if weekly() { (None, 2000, 200) } else { (Some(0.25), 25, 4) };
    let (mut looked, mut worst, mut beside) = (0, [0.0f64; 2], 0.0f64);
    for (k, tool) in TOOLS.iter().enumerate() {
        let contour = contour(&golden, tool);
        let brute = Brute::new(&contour);
        for (i, (name, motion)) in moves().into_iter().enumerate() {
            let TrimmedEnvelope { mesh, step, deeper, .. } = trimmed(&contour, &motion, TOLERANCE, step);
            mesh.check_closed().unwrap();
            assert_eq!(deeper, 0, "{tool} {name}");
            let mut random = Random((100 * k + i) as u64);
            for _ in 0..vertices {
                let p = mesh.vertices[random.below(mesh.vertices.len())];
                let away = brute.swept(&motion, p, 256);
                worst = [worst[0].max(-away), worst[1].max(away)];
                assert!(away.abs() <= TOLERANCE, "{tool} {name}: {p} {away}");
                looked += 1;
            }
            let distance = MeshDistance::new(&mesh).unwrap();
            let bounds = mesh.bounds();
            let (middle, size) = (0.5 * (bounds.min + bounds.max), bounds.size().length());
            for _ in 0..lines {
                let way = random.direction();
                let target = middle + random.direction() * (0.5 * size * random.share());
                if let Some(p) = brute.first_surely(&motion, target - way * size, way, 2.0 * size) {
                    // In a groove narrower than the lines the mesh may be as far away.
                    let away = distance.signed(p).abs();
                    assert!(away <= TOLERANCE.max(step), "{tool} {name}: {p} {away}");
                    beside = beside.max(away);
                }
            }
        }
    }
    println!("{looked} vertices, {worst:?} inside and outside, {beside} beside");
    assert!(looked >= 80 * vertices);
}

#[test]
fn the_volume_is_what_the_move_cuts_out_of_a_stock() {
    let golden = golden::file("sweep");
    let profiles = [
        ("flat", Profile::cylinder(10.0, 30.0).unwrap(), ["level line", "plunge", "great circle"]),
        ("ball", Profile::bull_nose(10.0, 5.0, 30.0).unwrap(), ["ramp", "upright arc", "tip and joints"]),
    ];
    let mut compared = 0;
    for (tool, profile, names) in profiles {
        let contour = contour(&golden, tool);
        assert!((contour.largest_radius() - 5.0).abs() < 1e-12 && (contour.height() - 30.0).abs() < 1e-12);
        for (name, motion) in moves().into_iter().filter(|(name, _)| names.contains(name)) {
            let trimmed = trimmed(&contour, &motion, 0.01, None);
            let bounds = trimmed.mesh.bounds().grown(1.0);
            let mut stock = TriDexel::from_box(bounds, trimmed.step).unwrap();
            // Its path is that of the motion.
            let curve = Curve::from(Line { start: DVec3::ZERO, end: DVec3::X });
            let one = CutMove::leaning(motion, curve, 0);
            let body = ToolBody::new(profile.clone());
            cut(&mut stock, &[body], &[one], &CutOptions::default(), &Silent).unwrap();
            // Around the ends of its lines: to count them is off by a thousandth.
            let options = SurfaceOptions { tolerance: Some(5e-4), memory: None };
            let left = surface(&stock, &options, &Silent).unwrap().volume();
            let gone = bounds.size().element_product() - left;
            let volume = trimmed.mesh.volume();
            assert!((volume / gone - 1.0).abs() < 1e-3, "{tool} {name}: {volume} {gone}");
            println!("{tool} {name}: {:.5}", volume / gone);
            compared += 1;
        }
    }
    assert_eq!(compared, 6);
}

#[test]
fn a_swing_over_its_own_way_has_its_volume_once() {
    // A flat mill goes 20 mm there, and comes back on an arc over a part of its way: more than half of its walls lie inside.
    let golden = golden::file("sweep");
    let contour = contour(&golden, "flat");
    let arc = |turn: f64| {
        let arc =
            kinecut::geom::Arc::new(DVec3::new(3.0, 0.0, 0.0), DVec3::ZERO, DVec3::Z, turn, 0.0).unwrap();
        ToolMotion::fixed(Curve::from(arc), DVec3::Z).unwrap()
    };
    // Once around and on: a disc of 16 mm, as after one turn.
    for turn in [6.3, 12.0] {
        let trimmed = trimmed(&contour, &arc(turn), 0.01, None);
        let exact = std::f64::consts::PI * 64.0 * 30.0;
        assert!((trimmed.mesh.volume() / exact - 1.0).abs() < 1e-3, "{turn} {}", trimmed.mesh.volume());
        trimmed.mesh.check_closed().unwrap();
    }
}

#[test]
fn depths_are_those_of_brute_force() {
    let golden = golden::file("sweep");
    let mut inside = 0;
    for (k, tool) in TOOLS.iter().enumerate() {
        let contour = contour(&golden, tool);
        let brute = Brute::new(&contour);
        for (i, (name, motion)) in moves().into_iter().enumerate() {
            let depth = SweptDepth::new(&contour, &motion);
            let mut random = Random((7000 + 100 * k + i) as u64);
            for _ in 0..20 {
                let p = DVec3::new(8.0, 2.0, 12.0) + random.vector(20.0);
                let (found, least) = (depth.of(p), brute.swept(&motion, p, MANY));
                // Outside it is no more than a bound.
                assert!(
                    least > 0.0 || (found.depth + least).abs() < 1e-3,
                    "{tool} {name} {p}: {found:?} {least}"
                );
                assert!(least < 0.0 || found.depth <= 1e-9, "{tool} {name} {p}: {found:?} {least}");
                inside += usize::from(least < 0.0);
            }
        }
    }
    assert!(inside > 150, "{inside}");
}

#[test]
fn a_step_that_makes_too_many_lines_is_refused() {
    let golden = golden::file("sweep");
    let contour = contour(&golden, "flat");
    let line = Line { start: DVec3::ZERO, end: DVec3::new(20.0, 6.0, 0.0) };
    let motion = ToolMotion::fixed(line.into(), DVec3::Z).unwrap();
    for step in [0.005, 0.0, -1.0, f64::NAN] {
        let error = trimmed_envelope((&contour, &motion), 0.01, Some(step), &Silent).unwrap_err();
        assert!(
            error.code() == Code::SWEEP_TOO_FINE && error.0.key.as_deref() == Some("step"),
            "{step} {error}"
        );
    }
    let error = trimmed_envelope((&contour, &motion), 0.0, None, &Silent).unwrap_err();
    assert!(error.code() == Code::SWEEP_TOLERANCE, "{error}");
}
