//! Offsets of outlines: the golden ones of an independent reference, and random ones against dense points, against the
//! direct way, and against themselves turned, mirrored and begun elsewhere.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, dvec2};
use kinecut::geom::{NearestEdge, Offset, Outline, OutlineEdge, offset, offset_direct};
use serde_json::Value;

use crate::common::golden::file;
use crate::common::random::Random;

fn outline(loops: &Value) -> Outline {
    let number = |v: &Value| v.as_f64().unwrap();
    let one = |l: &Value| {
        let points = l.as_array().unwrap();
        let at = |i: usize| {
            let p = &points[i % points.len()];
            (dvec2(number(&p[0]), number(&p[1])), number(&p[2]))
        };
        (0..points.len()).map(|i| OutlineEdge::bulge(at(i).0, at(i + 1).0, at(i).1)).collect()
    };
    Outline::new(loops.as_array().unwrap().iter().map(one).collect(), vec![]).unwrap()
}

/// Loops with a width, as golden numbers count them.
fn wide(of: &Offset) -> Vec<&[OutlineEdge]> {
    of.loops.iter().filter(|l| !l.collapsed).map(|l| &l.edges[..]).collect()
}

#[test]
fn golden_offsets_have_their_area_length_and_corners() {
    let mut seen = 0;
    for case in file("contour")["cases"].as_array().unwrap() {
        if case["kind"] != "offset" {
            continue;
        }
        seen += 1;
        let (name, want) = (&case["name"], &case["expected"]);
        let outline = outline(&case["input"]["loops"]);
        let distance = case["input"]["distance"].as_f64().unwrap();
        for (way, made) in
            [("library", offset(&outline, distance)), ("direct", offset_direct(&outline, distance))]
        {
            let made = made.unwrap_or_else(|e| panic!("{name} {way}: {e}"));
            assert!(way == "direct" || !made.direct, "{name}: the library's loops were wrong");
            let near = |key: &str, value: f64| {
                let (want, tolerance) =
                    (want[key].as_f64().unwrap(), case["tolerance"][key].as_f64().unwrap());
                assert!((value - want).abs() <= tolerance, "{name} {way}: {key} {value}, not {want}");
            };
            near("area", made.area());
            near("length", made.length());
            let edges: Vec<OutlineEdge> = wide(&made).concat();
            near("loops", wide(&made).len() as f64);
            near("arcs", edges.iter().filter(|e| e.turn.is_some()).count() as f64);
            near("lines", edges.iter().filter(|e| e.turn.is_none()).count() as f64);
            let corners = want["vertices"].as_array().unwrap();
            assert_eq!(corners.len(), edges.len(), "{name} {way}");
            for corner in corners {
                let p = dvec2(corner[0].as_f64().unwrap(), corner[1].as_f64().unwrap());
                let gap = edges.iter().map(|e| e.start.distance(p)).fold(f64::INFINITY, f64::min);
                assert!(
                    gap <= case["tolerance"]["vertices"].as_f64().unwrap() + 1e-9,
                    "{name} {way}: {p} {gap}"
                );
            }
        }
    }
    assert_eq!(seen, 26);
}

/// A star of lines and arcs about a point: simple, with corners of all kinds.
fn star(random: &mut Random, centre: DVec2, radii: [f64; 2]) -> Vec<OutlineEdge> {
    let count = 3 + (random.share() * 9.0) as usize;
    let points: Vec<DVec2> = (0..count)
        .map(|i| {
            let angle = TAU * (i as f64 + 0.6 * random.share()) / count as f64;
            centre + DVec2::from_angle(angle) * (radii[0] + (radii[1] - radii[0]) * random.share())
        })
        .collect();
    let bulge = |random: &mut Random| if random.share() < 0.5 { 0.0 } else { 0.5 * (random.share() - 0.5) };
    (0..count).map(|i| OutlineEdge::bulge(points[i], points[(i + 1) % count], bulge(random))).collect()
}

/// A random face, perhaps with islands; what crosses itself is left out.
fn face(random: &mut Random) -> Option<Outline> {
    let mut loops = vec![star(random, dvec2(3.0, -2.0), [15.0, 40.0])];
    for _ in 0..(random.share() * 3.0) as usize {
        let at = dvec2(24.0 * (random.share() - 0.5), 24.0 * (random.share() - 0.5));
        if random.share() < 0.4 {
            let r = 1.0 + 3.0 * random.share();
            loops.push(vec![OutlineEdge::arc(at, r, TAU * random.share(), TAU)]);
        } else {
            loops.push(star(random, at, [1.0, 5.0]));
        }
    }
    Outline::new(loops, vec![]).ok()
}

#[test]
fn random_offsets_are_those_of_dense_points_and_of_the_direct_way() {
    let mut random = Random(21);
    let (mut seen, mut direct) = (0, 0);
    while seen < 300 {
        let Some(outline) = face(&mut random) else { continue };
        seen += 1;
        let distance = 12.0 * (random.share() - 0.4);
        let made = offset(&outline, distance).unwrap_or_else(|e| panic!("{seen}: {e}"));
        direct += usize::from(made.direct);
        let judge = offset_direct(&outline, distance).unwrap_or_else(|e| panic!("{seen}: {e}"));
        assert!((made.area() - judge.area()).abs() < 1e-4, "{seen}: {} {}", made.area(), judge.area());
        assert!(
            (made.length() - judge.length()).abs() < 1e-4,
            "{seen}: {} {}",
            made.length(),
            judge.length()
        );
        // Dense points: the offset face holds what keeps the distance from the edges, and nothing else.
        let loops: Vec<OutlineEdge> = made.loops.iter().flat_map(|l| l.edges.clone()).collect();
        let on = NearestEdge::new(&loops);
        for _ in 0..200 {
            let p = dvec2(120.0 * (random.share() - 0.5), 120.0 * (random.share() - 0.5));
            let far = outline.edges().iter().map(|e| e.nearest(p).1).fold(f64::INFINITY, f64::min);
            let signed = if outline.contains(p) { far } else { -far };
            if (signed - distance).abs() < 1e-4 {
                continue;
            }
            let inside = on.at(p, 1000.0).is_some_and(|n| n.distance < 0.0);
            assert_eq!(inside, signed > distance, "{seen}: {p} {signed} {distance}");
        }
    }
    assert!(direct * 20 <= seen, "{direct} of {seen} were made directly");
}

#[test]
fn turned_mirrored_and_begun_elsewhere_an_offset_is_the_same() {
    let mut random = Random(22);
    for _ in 0..60 {
        let Some(outline) = face(&mut random) else { continue };
        let distance = 8.0 * (random.share() - 0.4);
        let plain = offset(&outline, distance).unwrap();
        let begun = |by: usize| {
            let loops = outline.loops().iter().map(|l| {
                let mut edges = outline.edges()[l.edges.clone()].to_vec();
                let by = by % edges.len();
                edges.rotate_left(by);
                edges.iter().rev().map(OutlineEdge::reversed).collect()
            });
            Outline::new(loops.collect(), vec![]).unwrap()
        };
        for other in [outline.moved(1.1, dvec2(200.0, -77.0)), outline.mirrored(), begun(1), begun(2)] {
            let other = offset(&other, distance).unwrap();
            assert!(
                (other.area() - plain.area()).abs() < 1e-6 && (other.length() - plain.length()).abs() < 1e-6
            );
            assert_eq!(wide(&other).len(), wide(&plain).len());
        }
    }
}

#[test]
fn a_slot_as_wide_as_the_cutter_keeps_its_centre_line() {
    let slot = |half: f64| {
        let (a, b) = (dvec2(0.0, -half), dvec2(50.0, half));
        let right = OutlineEdge::bulge(dvec2(b.x, a.y), b, 1.0);
        let left = OutlineEdge::bulge(dvec2(a.x, b.y), a, 1.0);
        let edges =
            vec![OutlineEdge::line(a, dvec2(b.x, a.y)), right, OutlineEdge::line(b, dvec2(a.x, b.y)), left];
        Outline::new(vec![edges], vec![]).unwrap()
    };
    let line = offset(&slot(5.0), 5.0).unwrap();
    assert!(line.loops.len() == 1 && line.loops[0].collapsed, "{line:?}");
    assert!((line.length() - 100.0).abs() < 1e-4);
    assert!(offset(&slot(5.0), 5.01).unwrap().loops.is_empty());
    assert!(!offset(&slot(5.0), 4.99).unwrap().loops[0].collapsed);
}

/// An arc that touches the edge after it: the face is the tip between them, or all around it.
#[test]
fn a_tip_without_angle_has_its_offset() {
    let plate = |bulge: f64| {
        let points = [
            (dvec2(-60.0, 0.0), 0.0),
            (dvec2(-20.0, 0.0), bulge),
            (dvec2(-20.0, 40.0), 0.0),
            (dvec2(20.0, 0.0), 0.0),
            (dvec2(60.0, 0.0), 0.0),
            (dvec2(60.0, 60.0), 0.0),
            (dvec2(-60.0, 60.0), 0.0),
        ];
        let edge = |i: usize| OutlineEdge::bulge(points[i].0, points[(i + 1) % points.len()].0, points[i].1);
        Outline::new(vec![(0..points.len()).map(edge).collect()], vec![]).unwrap()
    };
    // A half circle ends along the line that follows where that goes back: bent to the left or to the right.
    let horn = |side: f64| {
        let tip = dvec2(0.0, 20.0);
        let edges = vec![
            OutlineEdge::line(dvec2(30.0, 20.0 * side), dvec2(30.0, 40.0 * side)),
            OutlineEdge::line(dvec2(30.0, 40.0 * side), dvec2(0.0, 40.0 * side)),
            OutlineEdge::bulge(dvec2(0.0, 40.0 * side), tip * side, side),
            OutlineEdge::line(tip * side, dvec2(30.0, 20.0 * side)),
        ];
        Outline::new(vec![edges], vec![]).unwrap()
    };
    for (name, of, near) in [
        ("plate", plate(-1.0), Some(plate(-0.999_999))),
        ("horn", horn(1.0), None),
        ("horn below", horn(-1.0), None),
    ] {
        for distance in [-6.0, -1.0, 1.0, 4.0] {
            for (way, made) in [("library", offset(&of, distance)), ("direct", offset_direct(&of, distance))]
            {
                let made = made.unwrap_or_else(|e| panic!("{name} {way} {distance}: {e}"));
                let other = near.as_ref().map(|near| offset(near, distance).unwrap().area());
                let off = other.map_or(0.0, |area| (area - made.area()).abs());
                assert!(off < 0.05, "{name} {way} {distance}: {off}");
                // Co-area: the area changes by the length.
                let at = |d: f64| offset(&of, d).unwrap().area();
                let length = (at(distance - 1e-4) - at(distance + 1e-4)) / 2e-4;
                assert!(
                    (length - made.length()).abs() < 1e-2,
                    "{name} {way} {distance}: {length} {}",
                    made.length()
                );
            }
        }
    }
}

/// A hole whose radius is the distance but for the last digits.
#[test]
fn a_hole_as_wide_as_the_cutter_vanishes() {
    let plate = |radius: f64| {
        let corners = [dvec2(-20.0, -20.0), dvec2(20.0, -20.0), dvec2(20.0, 20.0), dvec2(-20.0, 20.0)];
        let hole = vec![OutlineEdge::arc(dvec2(5.0, 3.0), radius, 0.0, TAU)];
        Outline::new(vec![Outline::polygon(&corners).unwrap().edges().to_vec(), hole], vec![]).unwrap()
    };
    for more in [0.0, 4e-16, 2.8e-14, 1e-9, 1e-7, -1e-9] {
        let made = offset(&plate(2.0 + more), -2.0).unwrap_or_else(|e| panic!("{more}: {e}"));
        let kept: Vec<_> = made.loops.iter().filter(|l| !l.collapsed && l.length() > 1e-5).collect();
        assert_eq!(kept.len(), 1, "{more}: {kept:?}");
    }
    assert_eq!(wide(&offset(&plate(2.01), -2.0).unwrap()).len(), 2);
}

#[test]
fn long_outlines_with_many_islands_are_offset() {
    // 10,000 edges: a wavy ring, and 50 round islands.
    let ring = |count: usize, radius: f64, waves: f64| -> Vec<OutlineEdge> {
        let at = |i: usize| {
            let angle = TAU * (i % count) as f64 / count as f64;
            DVec2::from_angle(angle) * (radius + 3.0 * (waves * angle).sin())
        };
        (0..count).map(|i| OutlineEdge::line(at(i), at(i + 1))).collect()
    };
    let mut loops = vec![ring(9000, 100.0, 24.0)];
    for i in 0..50 {
        let at = DVec2::from_angle(TAU * f64::from(i % 25) / 25.0) * if i < 25 { 75.0 } else { 45.0 };
        let island = ring(20, 2.5, 0.0).iter().map(|e| e.moved(0.0, at)).collect();
        loops.push(island);
    }
    let outline = Outline::new(loops, vec![]).unwrap();
    assert_eq!(outline.edges().len(), 10_000);
    let made = offset(&outline, 3.0).unwrap();
    assert!(!made.direct);
    assert_eq!(made.loops.len(), 51);
    let judge = offset_direct(&outline, 3.0).unwrap();
    assert!((made.area() - judge.area()).abs() < 1e-3, "{} {}", made.area(), judge.area());
    assert!(made.area() < outline.area() - 3.0 * PI * 190.0);
}
