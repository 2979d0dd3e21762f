//! The envelope of a move: golden points, closed meshes, and brute force over all moments.

#![allow(clippy::print_stdout, reason = "the long check tells what it measured")]

use std::f64::consts::PI;

use glam::DVec3;
use kinecut::base::{Code, Silent};
use kinecut::geom::{Arc, Curve, Line, MeshDistance};
use kinecut::machine::kinematics::Twist;
use kinecut::sweep::{Envelope, ProfileChain, ToolMotion};
use kinecut::tool::Contour;

use crate::common::golden::{self, vector};
use crate::common::random::Random;
use crate::common::sweep_brute::{Brute, MANY};
use crate::common::sweep_golden::{contour, motion, trunnion};
use kinecut_cases::weekly;

#[test]
fn points_and_their_second_derivatives_are_the_golden_ones() {
    let golden = golden::file("sweep");
    let mut worst = 0.0f64;
    for case in golden["envelope"].as_array().unwrap() {
        let motion = motion(&case["motion"]);
        let chain = ProfileChain::new(&contour(&golden, case["tool"].as_str().unwrap()));
        for p in case["points"].as_array().unwrap() {
            let number = |key: &str| p[key].as_f64().unwrap();
            let piece = p["chain"].as_u64().unwrap() as usize;
            let both = chain.envelope_at(&motion, number("t"), piece, number("u")).unwrap();
            let at = both
                .iter()
                .min_by(|a, b| {
                    let off = |e: &f64| (e - number("theta")).sin().abs() + 1.0 - (e - number("theta")).cos();
                    off(&a.theta).total_cmp(&off(&b.theta))
                })
                .unwrap();
            worst = worst.max((at.point - vector(&p["world"])).length());
            match p["F_tt"].as_f64() {
                Some(second) => {
                    assert!((at.second / second - 1.0).abs() < 1e-9, "{} {p} {}", case["name"], at.second)
                }
                None => assert!(at.second.is_infinite()),
            }
        }
    }
    assert!(worst < 1e-9, "{worst}");
}

fn line(end: [f64; 3]) -> Curve {
    Line { start: DVec3::ZERO, end: DVec3::from(end) }.into()
}

/// A move of each class.
pub(super) fn moves() -> Vec<(&'static str, ToolMotion)> {
    let arc = |rise| -> Curve {
        Arc::new(DVec3::new(12.0, 0.0, 0.0), DVec3::ZERO, DVec3::Z, 2.0, rise).unwrap().into()
    };
    let upright = Arc::new(DVec3::ZERO, DVec3::new(0.0, 0.0, 15.0), DVec3::Y, -1.6, 0.0).unwrap();
    let from = [0.2, 0.1, 0.0, 0.0, 0.0];
    let to = [0.9, 0.5, 12.0, 8.0, 2.0];
    let twist = Twist { turn: DVec3::new(0.2, 0.5, 0.3), shift: DVec3::new(18.0, 3.0, -4.0) };
    let pivot = || trunnion(DVec3::new(0.0, 0.0, -50.0));
    let pose = kinecut::geom::Rigid::IDENTITY;
    vec![
        ("level line", ToolMotion::fixed(line([20.0, 6.0, 0.0]), DVec3::Z).unwrap()),
        ("ramp", ToolMotion::fixed(line([20.0, 6.0, -5.0]), DVec3::new(0.1, -0.2, 1.0)).unwrap()),
        ("plunge", ToolMotion::fixed(line([0.0, 0.0, -8.0]), DVec3::Z).unwrap()),
        ("level arc", ToolMotion::fixed(arc(0.0), DVec3::Z).unwrap()),
        ("helix", ToolMotion::fixed(arc(-6.0), DVec3::Z).unwrap()),
        ("upright arc", ToolMotion::fixed(upright.into(), DVec3::Z).unwrap()),
        (
            "great circle",
            ToolMotion::between(line([20.0, 0.0, -2.0]), DVec3::Z, DVec3::new(0.5, 0.1, 0.9)).unwrap(),
        ),
        ("joints", ToolMotion::joints(pivot(), &from, &to).unwrap()),
        ("tip and joints", ToolMotion::tip_and_joints(line([15.0, 5.0, 1.0]), pivot(), &from, &to).unwrap()),
        ("screw", ToolMotion::screw(pose, twist).unwrap()),
    ]
}

pub(super) const TOOLS: [&str; 8] =
    ["flat", "ball", "bull", "apt7", "barrel", "lollipop", "cornerround", "dished"];

#[test]
fn meshes_close_whatever_tool_and_move() {
    let golden = golden::file("sweep");
    let mut bad = Vec::new();
    for tool in golden["tools"].as_object().unwrap().keys() {
        let chain = ProfileChain::new(&contour(&golden, tool));
        for (name, motion) in moves() {
            let swept = chain.envelope(&motion, 0.05, &Silent).unwrap();
            if let Err(e) = swept.mesh.check_closed() {
                bad.push(format!("{tool} {name}: {e} {:?}", e.0.point));
            }
            // More than the tool itself, as every move here leaves its place.
            assert!(swept.mesh.volume() > 10.0, "{tool} {name} {}", swept.mesh.volume());
        }
    }
    assert!(bad.is_empty(), "{bad:#?}");
}

/// Largest distances: of points of the mesh outside of what is swept, and of points of its boundary from the mesh.
fn off(tool: &Contour, motion: &ToolMotion, swept: &Envelope, count: usize, seed: u64) -> [f64; 2] {
    let (brute, mut random) = (Brute::new(tool), Random(seed));
    let mesh = &swept.mesh;
    let mut outside = 0.0f64;
    for _ in 0..count {
        let t = mesh.triangles[(random.share() * mesh.triangles.len() as f64) as usize];
        let [a, b, c] = t.map(|i| mesh.vertices[i as usize]);
        let (mut u, mut v) = (random.share(), random.share());
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        let p = a + (b - a) * u + (c - a) * v;
        if brute.swept(motion, p, 64) > outside {
            outside = outside.max(brute.swept(motion, p, MANY));
        }
    }
    let distance = MeshDistance::new(mesh).unwrap();
    let bounds = mesh.bounds();
    let (middle, size) = (0.5 * (bounds.min + bounds.max), (bounds.max - bounds.min).length());
    let (mut beside, mut found) = (0.0f64, 0);
    for _ in 0..20 * count {
        let way = random.direction();
        let target = middle + random.direction() * (0.5 * size * random.share());
        if let Some(p) = brute.first_surely(motion, target - way * size, way, 2.0 * size) {
            beside = beside.max(distance.signed(p).abs());
            found += 1;
        }
        if found == count {
            break;
        }
    }
    assert!(found >= count, "{found} of {count} lines met");
    [outside, beside]
}

fn check(count: usize, tolerance: f64, tools: &[&str], say: bool) {
    let golden = golden::file("sweep");
    let mut bad = Vec::new();
    for (i, (name, motion)) in moves().into_iter().enumerate() {
        let mut worst = [0.0f64; 2];
        for (k, tool) in tools.iter().enumerate() {
            let contour = contour(&golden, tool);
            let swept = ProfileChain::new(&contour).envelope(&motion, tolerance, &Silent).unwrap();
            let [outside, beside] = off(&contour, &motion, &swept, count, (i * 100 + k) as u64);
            if say {
                println!(
                    "{name} {tool}: {} triangles, {outside:e} outside, {beside:e} beside",
                    swept.mesh.triangles.len()
                );
            }
            worst = [worst[0].max(outside), worst[1].max(beside)];
            if outside > tolerance || beside > tolerance {
                bad.push(format!("{name} {tool}: {outside} outside, {beside} beside"));
            }
        }
        if say {
            println!("{name}: {:e} outside, {:e} beside", worst[0], worst[1]);
        }
    }
    assert!(bad.is_empty(), "{bad:#?}");
}

/// In the weekly form 10 000 points a class of motion, on finer meshes; `--nocapture` shows what is measured.
#[test]
fn boundary_points_of_all_poses_lie_on_the_mesh_and_none_of_it_outside() {
    if weekly() {
        check(1250, 0.001, &TOOLS, true);
    } else {
        check(8, 0.02, &["flat", "bull", "barrel"], false);
    }
}

#[test]
fn fixed_axis_sweeps_have_their_closed_volumes() {
    let golden = golden::file("sweep");
    // Projected across the way, a tool of revolution swept straight and level adds twice the area of its half-section.
    let ways = [("flat", 2.0 * 5.0 * 30.0), ("ball", 2.0 * (25.0 * PI / 4.0 + 5.0 * 25.0))];
    for (tool, area) in ways {
        let chain = ProfileChain::new(&contour(&golden, tool));
        let still = ToolMotion::fixed(line([0.0, 0.0, 0.0]), DVec3::Z).unwrap();
        let itself = chain.envelope(&still, 0.0005, &Silent).unwrap().mesh.volume();
        let motion = ToolMotion::fixed(line([30.0, 40.0, 0.0]), DVec3::Z).unwrap();
        let swept = chain.envelope(&motion, 0.0005, &Silent).unwrap().mesh.volume();
        assert!(((swept - itself) / (50.0 * area) - 1.0).abs() < 2e-4, "{tool} {itself} {swept} {area}");
    }
}

#[test]
fn inside_points_are_told_by_the_second_derivative_and_cusps_lie_between() {
    let golden = golden::file("sweep");
    let (mut inside, mut cusps) = (0, 0);
    for tool in ["flat", "bull", "cornerround", "barrel", "hourglass"] {
        let tool = contour(&golden, tool);
        let (chain, brute) = (ProfileChain::new(&tool), Brute::new(&tool));
        // The tip hardly moves, the tool swings: the envelope cuts itself under the tip.
        let to = DVec3::new(0.9f64.sin(), 0.0, 0.9f64.cos());
        let swing = ToolMotion::between(line([1.5, 0.0, 0.0]), DVec3::Z, to).unwrap();
        for t in [0.2, 0.5, 0.8] {
            for p in chain.envelope_points(&swing, t, 4) {
                if p.second.is_finite() && p.second < 0.0 {
                    assert!(brute.swept(&swing, p.point, 200) < -1e-12);
                    inside += 1;
                }
            }
            for p in chain.cusps(&swing, t) {
                assert!(p.second.abs() < 1e-6, "{}", p.second);
                cusps += 1;
            }
        }
    }
    assert!(inside > 0 && cusps > 0, "{inside} {cusps}");
}

#[test]
fn tolerances_that_are_none_are_refused() {
    let golden = golden::file("sweep");
    let chain = ProfileChain::new(&contour(&golden, "bull"));
    let (_, motion) = moves().swap_remove(6);
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(chain.envelope(&motion, tolerance, &Silent).unwrap_err().code(), Code::SWEEP_TOLERANCE);
    }
    assert_eq!(chain.envelope(&motion, 1e-15, &Silent).unwrap_err().code(), Code::SWEEP_TOO_FINE);
}
