//! Closed sweeps of fixed axis: golden heights, brute force along the move, stretches of lines, volumes.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};
use kinecut::base::Silent;
use kinecut::geom::{Arc, Line};
use kinecut::sweep::{
    ConvexTool, LowerProfile, ProfileChain, ToolMotion, arc_volume, line_volume, tool_volume,
};
use kinecut::tool::{Contour, ContourElement, ElementRole};
use serde_json::Value;

use crate::common::golden::{self, numbers, vector};
use crate::common::random::Random;
use crate::common::sweep_brute::Brute;
use crate::common::sweep_golden::contour;

fn tool(kind: &str, radius: f64, other: f64) -> Contour {
    let line = |a, b| ContourElement::line(a, b, ElementRole::Cutting);
    let arc = |c, r, from, to| ContourElement::arc(c, r, from, to, ElementRole::Cutting);
    let top = [line([radius, 30.0], [0.0, 30.0])];
    let below = match kind {
        "flat" => vec![line([0.0, 0.0], [radius, 0.0]), line([radius, 0.0], [radius, 30.0])],
        "ball" => vec![arc([0.0, radius], radius, -FRAC_PI_2, 0.0), line([radius, radius], [radius, 30.0])],
        "cone" => {
            let rise = other * radius;
            vec![line([0.0, 0.0], [radius, rise]), line([radius, rise], [radius, 30.0])]
        }
        "bull" => vec![
            line([0.0, 0.0], [radius - other, 0.0]),
            arc([radius - other, other], other, -FRAC_PI_2, 0.0),
            line([radius, other], [radius, 30.0]),
        ],
        _ => panic!("{kind}"),
    };
    Contour::new(below.into_iter().chain(top).collect()).unwrap()
}

#[test]
fn heights_are_the_golden_ones() {
    let golden = golden::file("sweep");
    let mut count = 0;
    for case in golden["dexels"]["zmap"].as_array().unwrap() {
        let q = DVec2::from_slice(&numbers(&case["q"]));
        let number = |v: &Value| v.as_f64().unwrap();
        let kind = case["kind"].as_str().unwrap();
        let z = if kind == "helix_ball" {
            let of = |key: &str| number(&case[key]);
            let (a0, a1, rad) = (of("a0"), of("a1"), of("rad"));
            let start = (DVec2::from_angle(a0) * rad).extend(of("z0"));
            let rise = of("kz") * (a1 - a0);
            let arc = Arc::new(start, DVec3::ZERO, DVec3::Z, a1 - a0, rise).unwrap();
            LowerProfile::new(&tool("ball", of("R"), 0.0)).over_arc(&arc, q)
        } else {
            let par = &case["par"];
            let other = par.get("c").or(par.get("r")).map_or(0.0, number);
            let line = Line { start: vector(&case["P0"]), end: vector(&case["P1"]) };
            LowerProfile::new(&tool(kind, number(&par["R"]), other)).over_line(&line, q)
        };
        assert!((z.unwrap() - case["z"].as_f64().unwrap()).abs() < 1e-9, "{case} {z:?}");
        count += 1;
    }
    assert!(count >= 12);
}

/// The least height over a point along a move, sampled.
fn sampled(profile: &LowerProfile, tip: impl Fn(f64) -> DVec3, at: DVec2) -> Option<f64> {
    let mut best: Option<(f64, f64)> = None;
    let f = |t: f64| {
        let p = tip(t);
        profile.height((at - p.truncate()).length()).map(|h| h + p.z)
    };
    const COUNT: u32 = 4000;
    for k in 0..=COUNT {
        let t = f64::from(k) / f64::from(COUNT);
        if let Some(z) = f(t)
            && best.is_none_or(|(least, _)| z < least)
        {
            best = Some((z, t));
        }
    }
    let (mut least, at) = best?;
    let h = 1.0 / f64::from(COUNT);
    for k in -400..=400 {
        let t = (at + f64::from(k) / 400.0 * h).clamp(0.0, 1.0);
        least = least.min(f(t).unwrap_or(f64::INFINITY));
    }
    Some(least)
}

#[test]
fn no_station_of_a_line_or_helix_is_lower() {
    let golden = golden::file("sweep");
    let mut random = Random(3);
    let mut tried = [0; 2];
    for name in ["flat", "ball", "bull", "apt7", "cornerround", "dished", "stack", "vcone"] {
        let profile = LowerProfile::new(&contour(&golden, name));
        for k in 0..16 {
            let mut r = || 2.0 * random.share() - 1.0;
            let line = Line {
                start: DVec3::new(9.0 * r(), 9.0 * r(), 3.0 * r()),
                end: DVec3::new(9.0 * r(), 9.0 * r(), 6.0 * r()),
            };
            let start = DVec3::new(6.0 + 3.0 * r(), 2.0 * r(), r());
            let rise = if k % 4 == 0 { 0.0 } else { 9.0 * r() };
            let helix = Arc::new(start, DVec3::ZERO, DVec3::Z, 7.0 * r(), rise).unwrap();
            let at = DVec2::new(8.0 * r(), 8.0 * r());
            // Half a tool's width over the edge a sample may miss.
            let pairs = [
                (profile.over_line(&line, at), sampled(&profile, |t| line.start.lerp(line.end, t), at)),
                (profile.over_arc(&helix, at), sampled(&profile, |t| helix.point(t), at)),
            ];
            for (i, (exact, brute)) in pairs.into_iter().enumerate() {
                let Some(brute) = brute else { continue };
                let exact = exact.unwrap();
                assert!(exact <= brute + 1e-12, "{name} {i} {exact} {brute} {line:?} {helix:?} {at}");
                // Samples come near it, but for steep ends of arcs and steps.
                assert!(exact > brute - 0.05, "{name} {i} {exact} {brute}");
                tried[i] += 1;
            }
        }
    }
    assert!(tried[0] > 60 && tried[1] > 60, "{tried:?}");
}

#[test]
fn lines_are_removed_between_the_ends_that_brute_force_finds() {
    let golden = golden::file("sweep");
    let mut random = Random(11);
    let mut met = 0;
    for name in ["flat", "ball", "bull", "apt7", "barrel", "vcone"] {
        let contour = contour(&golden, name);
        let (convex, brute) = (ConvexTool::new(&contour).unwrap(), Brute::new(&contour));
        for k in 0..8 {
            let to =
                DVec3::new(20.0, 7.0 * random.share(), if k % 3 == 0 { 0.0 } else { -9.0 * random.share() });
            let motion = ToolMotion::fixed(Line { start: DVec3::ZERO, end: to }.into(), DVec3::Z).unwrap();
            let way = random.direction();
            let aim = DVec3::new(20.0 * random.share(), 8.0 * random.share() - 4.0, 20.0 * random.share());
            let origin = aim - way * 60.0;
            let Some([a, b]) = convex.removed(to, origin, way) else {
                assert!(brute.first(&motion, origin, way, 150.0, 40).is_none());
                continue;
            };
            let first = brute.first(&motion, origin, way, 150.0, 40).unwrap();
            let last = brute.first(&motion, origin + way * 150.0, -way, 150.0, 40).unwrap();
            assert!(((first - origin).dot(way) - a).abs() < 1e-6, "{name} {a} {first}");
            assert!(((last - origin).dot(way) - b).abs() < 1e-6, "{name} {b} {last}");
            met += 1;
        }
    }
    assert!(met > 20, "{met}");
    assert!(ConvexTool::new(&contour(&golden, "lollipop")).is_none());
    assert!(ConvexTool::new(&contour(&golden, "dished")).is_none());
}

#[test]
fn volumes_are_those_of_the_mesh_and_of_known_bodies() {
    let golden = golden::file("sweep");
    let ball = tool("ball", 5.0, 0.0);
    let itself = 2.0 / 3.0 * PI * 125.0 + PI * 25.0 * 25.0;
    assert!((tool_volume(&ball) / itself - 1.0).abs() < 1e-14);
    let level = line_volume(&ball, DVec3::new(12.0, -16.0, 0.0));
    assert!((level / (itself + 20.0 * (PI * 12.5 + 250.0)) - 1.0).abs() < 1e-13);
    // A sphere casts a disc, whatever the way.
    let sphere =
        Contour::new(vec![ContourElement::arc([0.0, 5.0], 5.0, -FRAC_PI_2, FRAC_PI_2, ElementRole::Cutting)]);
    let swept = line_volume(&sphere.unwrap(), DVec3::new(3.0, 4.0, -12.0));
    assert!((swept / (500.0 / 3.0 * PI + 13.0 * 25.0 * PI) - 1.0).abs() < 1e-12, "{swept}");
    for name in ["flat", "ball", "bull", "apt7", "barrel", "vcone"] {
        let contour = contour(&golden, name);
        let chain = ProfileChain::new(&contour);
        let mesh = |motion: &ToolMotion| chain.envelope(motion, 0.002, &Silent).unwrap().mesh.volume();
        for way in [DVec3::new(15.0, 4.0, 0.0), DVec3::new(9.0, 3.0, -6.0), DVec3::new(0.0, 0.0, 8.0)] {
            let motion = ToolMotion::fixed(Line { start: DVec3::ZERO, end: way }.into(), DVec3::Z).unwrap();
            let (exact, found) = (line_volume(&contour, way), mesh(&motion));
            assert!((found / exact - 1.0).abs() < 1e-3, "{name} {way} {exact} {found}");
        }
        for sweep in [2.0, -1.2] {
            let arc = Arc::new(DVec3::new(14.0, 0.0, 0.0), DVec3::ZERO, DVec3::Z, sweep, 0.0).unwrap();
            let motion = ToolMotion::fixed(arc.into(), DVec3::Z).unwrap();
            let (exact, found) = (arc_volume(&contour, 14.0, sweep).unwrap(), mesh(&motion));
            assert!((found / exact - 1.0).abs() < 1e-3, "{name} {sweep} {exact} {found}");
        }
        assert_eq!(arc_volume(&contour, 1.0, 2.0), None);
        assert_eq!(arc_volume(&contour, 14.0, 6.2), None);
        assert!(arc_volume(&contour, 14.0, TAU).is_some());
        assert_eq!(arc_volume(&contour, f64::NAN, 2.0), None);
    }
}
