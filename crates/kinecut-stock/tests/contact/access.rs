//! Tools brought to places of rough ground, against many places of tools a little smaller and a little larger.

use std::f64::consts::TAU;

use glam::{DMat3, DQuat, DVec3};
use kinecut_stock::contact::{Access, Body, MovingTool, ToolPart};
use kinecut_stock::geom::{Mesh, Profile, Rigid, Solid};
use parry3d_f64::math::Vector;
use parry3d_f64::shape::TriMesh;

use crate::judge::{Random, Shown, apart};

/// Points along each side of the ground, and their distance [mm].
const SIDE: u32 = 7;
const WIDE: f64 = 8.0;
/// Distance of the place from the ground [mm].
const AWAY: f64 = 0.06;
/// Room of the judge's tools [mm].
const ROOM: f64 = 0.12;
/// Height of all tools [mm].
const LONG: f64 = 80.0;

/// Closed ground: random heights on a square grid, a flat bottom.
fn ground(random: &mut Random) -> Mesh {
    let mut mesh = Mesh::default();
    for low in [false, true] {
        for j in 0..SIDE {
            for i in 0..SIDE {
                let z = if low { -10.0 } else { random.between(0.0, 14.0) };
                mesh.vertices.push(DVec3::new(f64::from(i) * WIDE, f64::from(j) * WIDE, z));
            }
        }
    }
    let (at, below) = (|i: u32, j: u32| j * SIDE + i, SIDE * SIDE);
    let last = SIDE - 1;
    for j in 0..last {
        for i in 0..last {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
            mesh.triangles.extend([[a, c, b], [a, d, c]].map(|t| t.map(|v| v + below)));
        }
    }
    let mut side = |a: u32, b: u32| {
        mesh.triangles.extend([[a, a + below, b + below], [a, b + below, b]]);
    };
    for k in 0..last {
        side(at(k, 0), at(k + 1, 0));
        side(at(last, k), at(last, k + 1));
        side(at(k + 1, last), at(k, last));
        side(at(0, k + 1), at(0, k));
    }
    mesh.check_closed().expect("closed");
    mesh
}

/// A flat end or a ball nose as the judge knows it.
fn shown(radius: f64, ball: bool, low: f64) -> Vec<Shown> {
    let mut all = vec![Shown::cylinder(radius, if ball { low + radius } else { low }, LONG)];
    if ball {
        let ball = Shown::ball(radius);
        all.push(Shown { place: Rigid::from_translation(DVec3::Z * (low + radius)), ..ball });
    }
    all
}

/// Points all over the end and the sides of a tool, in coordinates of its own.
fn surface(random: &mut Random, radius: f64, ball: bool) -> DVec3 {
    let (sin, cos) = (TAU * random.next()).sin_cos();
    let [r, z] = match (ball, random.next()) {
        (true, part) if part < 0.8 => {
            let (sin, cos) = (random.next() * TAU / 4.0).sin_cos();
            [radius * sin, radius - radius * cos]
        }
        (true, _) => [radius, radius],
        (false, part) if part < 0.4 => [radius * random.next().sqrt(), 0.0],
        (false, _) => [radius, 0.0],
    };
    DVec3::new(r * cos, r * sin, z)
}

#[test]
fn tools_come_where_smaller_ones_do_and_larger_ones_do_not() {
    let mut random = Random(11);
    let (mut free, mut closed) = (0, 0);
    for _ in 0..20 {
        let mesh = ground(&mut random);
        let corners = mesh.vertices.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
        let shape = TriMesh::new(corners, mesh.triangles.clone()).expect("a case of these numbers");
        let judged = Shown { shape: Box::new(shape), place: Rigid::IDENTITY };
        let body = Body::new("ground", &Solid::Mesh(mesh.clone()), Rigid::IDENTITY, 0.0)
            .expect("a case of these numbers");
        let (held, told) = (body.memory_held(), Body::memory(&Solid::Mesh(mesh.clone())));
        assert!(held <= told && 2 * held > told, "{held} {told}");
        for _ in 0..12 {
            let triangle = loop {
                let corners = mesh.triangles[(random.next() * mesh.triangles.len() as f64) as usize]
                    .map(|v| mesh.vertices[v as usize]);
                if corners.iter().all(|p| p.z >= 0.0) {
                    break corners;
                }
            };
            let [a, b, c] = triangle;
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let share = (random.between(0.1, 0.45), random.between(0.1, 0.45));
            let place = a + share.0 * (b - a) + share.1 * (c - a) + AWAY * normal;
            let axis = (DVec3::Z + random.point(0.4)).normalize_or_zero();
            let (radius, ball) = (random.between(0.6, 7.0), random.next() < 0.5);
            let profile = Profile::bull_nose(2.0 * radius, if ball { radius } else { 0.0 }, LONG)
                .expect("a case of these numbers");
            let tool = MovingTool::new([(ToolPart::Cutter, &profile, 0.0)]);
            let off = if random.next() < 0.5 { 0.0 } else { 0.05 };
            let found = tool.access(place, normal, axis, off, &body);
            let rotation = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, axis));
            // At a place of its surface; of a smaller tool and of a larger one about the same axis and centre.
            let mut passes = |by: f64| {
                let parts = shown(radius + by, ball, -by);
                (0..1500).any(|_| {
                    let touching = surface(&mut random, radius, ball);
                    let pose = Rigid { rotation, translation: place - rotation * touching };
                    parts.iter().all(|part| apart((part, &pose), (&judged, &Rigid::IDENTITY)) > 0.0)
                })
            };
            match found {
                Access::Free => {
                    free += 1;
                    assert!(passes(-ROOM), "nothing is free of {radius} {ball} at {place} {normal}");
                }
                Access::Closed => {
                    closed += 1;
                    assert!(!passes(ROOM), "a larger one than {radius} {ball} is free at {place} {normal}");
                }
                Access::Hindered(part) => panic!("there is no {part:?}"),
            }
        }
    }
    assert!(free > 60 && closed > 60, "{free} {closed}");
}

#[test]
fn a_holder_that_meets_the_part_hinders() {
    // A pit of 20 x 20 mm, 30 mm deep, as four walls over a floor of another body.
    let wall = |min: [f64; 3], max: [f64; 3]| {
        let bounds = kinecut_stock::geom::Aabb { min: min.into(), max: max.into() };
        Body::new("wall", &Solid::Box(bounds), Rigid::IDENTITY, 0.0).expect("a case of these numbers")
    };
    let wall = wall([10.0, -50.0, -30.0], [60.0, 50.0, 0.0]);
    let profile =
        |diameter: f64, height: f64| Profile::cylinder(diameter, height).expect("a case of these numbers");
    let (cutter, shank, holder) = (profile(6.0, 12.0), profile(6.0, 10.0), profile(30.0, 50.0));
    let tool = |stickout: f64| {
        MovingTool::new([
            (ToolPart::Cutter, &cutter, 0.0),
            (ToolPart::Shank, &shank, 12.0),
            (ToolPart::Holder, &holder, stickout),
        ])
    };
    // On the floor beside the wall, the tip 30 mm below its top.
    let at = |stickout: f64| {
        tool(stickout).access(DVec3::new(9.9, 0.0, -30.0), DVec3::NEG_X, DVec3::Z, 0.0, &wall)
    };
    assert_eq!(at(29.9), Access::Hindered(ToolPart::Holder));
    assert_eq!(at(30.1), Access::Free);
    // A shank that is wider than the cutter.
    let wide = profile(7.0, 20.0);
    let wide = MovingTool::new([(ToolPart::Cutter, &cutter, 0.0), (ToolPart::Shank, &wide, 12.0)]);
    let upright = wide.access(DVec3::new(9.9, 0.0, -30.0), DVec3::NEG_X, DVec3::Z, 0.0, &wall);
    assert_eq!(upright, Access::Hindered(ToolPart::Shank));
    // Noise of facets does not lift it.
    let noisy = DVec3::new(-1.0, 0.0, -5e-5).normalize_or_zero();
    assert_eq!(tool(30.1).access(DVec3::new(9.9, 0.0, -30.0), noisy, DVec3::Z, 0.0, &wall), Access::Free);
    let shank = MovingTool::new([(ToolPart::Shank, &shank, 0.0)]);
    assert_eq!(shank.access(DVec3::ZERO, DVec3::NEG_X, DVec3::Z, 0.0, &wall), Access::Closed, "nothing cuts");
}

#[test]
fn a_cutter_goes_into_a_corner_of_its_own_radius() {
    // A ring of upright facets of 5 mm radius, 20 mm high.
    let mut mesh = Mesh::default();
    let (inner, outer, count) = (5.0, 9.0, 720u32);
    for (radius, z) in [(inner, 0.0), (inner, 20.0), (outer, 0.0), (outer, 20.0)] {
        for i in 0..count {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(count)).sin_cos();
            // Vertices outside of the circle, the middle of each facet on it.
            let r = radius / (TAU / f64::from(2 * count)).cos();
            mesh.vertices.push(DVec3::new(r * cos, r * sin, z));
        }
    }
    for i in 0..count {
        let j = (i + 1) % count;
        for [a, b] in [[0, 1], [1, 3], [3, 2], [2, 0]].map(|pair| pair.map(|k| k * count)) {
            mesh.triangles.extend([[a + i, b + i, b + j], [a + i, b + j, a + j]]);
        }
    }
    mesh.check_closed().expect("closed");
    let body = Body::new("ring", &Solid::Mesh(mesh), Rigid::IDENTITY, 0.0).expect("a case of these numbers");
    let access = |diameter: f64, off: f64| {
        let profile = Profile::cylinder(diameter, 40.0).expect("a case of these numbers");
        let tool = MovingTool::new([(ToolPart::Cutter, &profile, 0.0)]);
        tool.access(DVec3::new(4.98, 0.0, 5.0), DVec3::NEG_X, DVec3::Z, off, &body)
    };
    // 0.02 mm from the wall at one side a cutter of 9.98 mm has no room at the other; moved by 0.01 mm it has.
    assert_eq!((access(9.98, 0.0), access(9.98, 0.01)), (Access::Closed, Access::Free));
    assert_eq!((access(9.9, 0.0), access(10.02, 0.01)), (Access::Free, Access::Closed));
}
