//! Parts as meshes: against the closed forms of planes, against rays through the triangles, turned and mirrored.

use glam::{DMat3, DQuat, DVec3};
use kinecut::base::Code;
use kinecut::drilling::{BoundarySurface, Cover, PartMesh, Passage, Side, transient};
use kinecut::geom::{EdgeProfile, Mesh};
use kinecut::tool::DrillPoint;
use proptest::prelude::*;

fn deg(a: f64) -> f64 {
    a.to_radians()
}

/// Points of all kinds: lines, steps, falls, arcs, with and without a core.
pub(crate) fn points() -> Vec<DrillPoint> {
    vec![
        DrillPoint::SinglePlane { angle: deg(118.0) },
        DrillPoint::DoubleGround { angle: deg(118.0), second: deg(70.0) },
        DrillPoint::CastIron { angle: deg(118.0), second: deg(70.0), third: deg(55.0), slot: 0.5 },
        DrillPoint::Rounded { radius: 7.0 },
        DrillPoint::CornerRadius { angle: deg(118.0), radius: 2.0 },
        DrillPoint::ThinnedWeb { angle: deg(118.0), flat: 0.8 },
        DrillPoint::SlottedChisel { angle: deg(118.0), slot: 0.8 },
        DrillPoint::Annular { core: 6.0 },
        DrillPoint::Flat,
        DrillPoint::Cannon { overlap: 0.3, edge_angle: deg(80.0) },
        DrillPoint::Gun { apex: Some(2.5), outer_angle: deg(60.0), inner_angle: deg(70.0) },
    ]
}

/// A box whose top and bottom carry heights on a grid of n x n cells of a width, about the origin.
fn block(n: u32, width: f64, top: impl Fn(f64, f64) -> f64, bottom: impl Fn(f64, f64) -> f64) -> Mesh {
    let mut mesh = Mesh::default();
    let place = |i: u32| width * (f64::from(i) / f64::from(n) - 0.5);
    for j in 0..=n {
        for i in 0..=n {
            let (x, y) = (place(i), place(j));
            mesh.vertices.push(DVec3::new(x, y, top(x, y)));
        }
    }
    let below = mesh.vertices.len() as u32;
    for j in 0..=n {
        for i in 0..=n {
            let (x, y) = (place(i), place(j));
            mesh.vertices.push(DVec3::new(x, y, bottom(x, y)));
        }
    }
    let at = |i: u32, j: u32| j * (n + 1) + i;
    for j in 0..n {
        for i in 0..n {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
            mesh.triangles.extend([[a, c, b], [a, d, c]].map(|t| t.map(|v| v + below)));
        }
    }
    for k in 0..n {
        let rims = [
            [at(k, 0), at(k + 1, 0)],
            [at(n, k), at(n, k + 1)],
            [at(k + 1, n), at(k, n)],
            [at(0, k + 1), at(0, k)],
        ];
        for [a, b] in rims {
            mesh.triangles.extend([[a, a + below, b + below], [a, b + below, b]]);
        }
    }
    mesh
}

fn moved(mesh: &Mesh, turn: DMat3, shift: DVec3) -> Mesh {
    let mut mesh = mesh.clone();
    mesh.vertices.iter_mut().for_each(|v| *v = turn * *v + shift);
    mesh
}

fn shares(passages: &[Passage], side: Side) -> f64 {
    passages.iter().filter(|p| p.side == side).map(|p| p.share).sum()
}

/// Heights of the faces of a mesh along the vertical line at (x, y), with what they do to a drill from above: all the
/// crossings of triangles that are not upright.
fn crossings(mesh: &Mesh, x: f64, y: f64) -> Vec<(f64, Side)> {
    let mut found = Vec::new();
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| mesh.vertices[i as usize]);
        let n = (b - a).cross(c - a);
        let area = |p: DVec3, q: DVec3| (p.x - x) * (q.y - y) - (p.y - y) * (q.x - x);
        let w = [area(b, c), area(c, a), area(a, b)];
        let sum = w[0] + w[1] + w[2];
        if sum != 0.0 && w.iter().all(|v| v * sum >= 0.0) {
            let z = (w[0] * a.z + w[1] * b.z + w[2] * c.z) / sum;
            found.push((z, if n.z > 0.0 { Side::Entry } else { Side::Exit }));
        }
    }
    found
}

/// Every point of a polar grid over the edge is passed within a passage of its side; the extremes of the grid come
/// within `near` of those of the passages.
fn brute_force(
    mesh: &Mesh,
    edge: &EdgeProfile,
    passages: &[Passage],
    near: f64,
) -> Result<(), TestCaseError> {
    let mut reached = vec![(f64::INFINITY, f64::NEG_INFINITY); passages.len()];
    for s in edge.segments() {
        let [a, b] = s.range();
        for i in 0..=24 {
            let r = a + (b - a) * f64::from(i) / 24.0;
            for k in 0..40 {
                let (sin, cos) = (deg(9.0) * f64::from(k) + 0.01).sin_cos();
                for (height, side) in crossings(mesh, r * cos, r * sin) {
                    let z = height - s.height(r);
                    let mut within = false;
                    for (p, ends) in passages.iter().zip(&mut reached) {
                        let t = &p.transient;
                        if p.side == side && z <= t.first + 1e-9 && z >= t.last - 1e-9 {
                            within = true;
                            *ends = (ends.0.min(z), ends.1.max(z));
                        }
                    }
                    prop_assert!(within, "{z} at {r} {k} is passed in no passage {passages:?}");
                }
            }
        }
    }
    for (p, (low, high)) in passages.iter().zip(reached) {
        if p.share > 0.02 {
            let t = &p.transient;
            prop_assert!(low - t.last < near && t.first - high < near, "{t:?} reached only {low} to {high}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(kinecut_cases::property(24))]

    #[test]
    fn a_mesh_of_planes_equals_the_planes(
        kind in 0usize..11, slope in -1.5..1.5f64, other in -1.0..1.0f64, angle in 0.0..6.3f64, n in 1u32..9,
    ) {
        let edge = points()[kind].edge(10.0).unwrap();
        let (s, c) = angle.sin_cos();
        let mesh = block(n, 31.0, |x, y| 3.0 + slope * (c * x + s * y), |x, _| -60.0 + other * x);
        let found = PartMesh::new(&mesh).unwrap().passages(&edge, DVec3::ZERO, DVec3::NEG_Z).unwrap();
        prop_assert_eq!(found.passages.len(), 2);
        let (top, bottom) = (BoundarySurface::Plane { height: 3.0, slope }, BoundarySurface::Plane { height: -60.0, slope: other });
        for (p, surface) in found.passages.iter().zip([top, bottom]) {
            let t = transient(&edge, &surface, Cover::Whole).unwrap();
            prop_assert!((t.first - p.transient.first).abs() < 1e-9 && (t.last - p.transient.last).abs() < 1e-9);
            prop_assert!((p.share - 1.0).abs() < 1e-12);
        }
        let at = found.contact;
        let r = at.x.hypot(at.y);
        prop_assert!((at.z - 3.0 - slope * (c * at.x + s * at.y)).abs() < 1e-9);
        // At a step, of both heights one.
        let there = |e: &f64| (at.z - e - found.passages[0].transient.first).abs() < 1e-6;
        let [from, to] = [edge.inner_radius(), edge.outer_radius()];
        let heights = [r - 1e-8, r, r + 1e-8].map(|r| edge.height(r.clamp(from, to)).unwrap());
        prop_assert!(heights.iter().any(there), "{at} {heights:?}");
    }

    #[test]
    fn no_ray_through_a_rough_part_is_passed_outside_its_passages(
        kind in 0usize..11, heights in prop::collection::vec(-2.0..2.0f64, 16), x in -3.0..3.0f64,
    ) {
        let edge = points()[kind].edge(10.0).unwrap();
        let rough = |p: f64, q: f64| heights[((p * 7.3 + q * 3.1).abs() as usize) % 16];
        let mesh = block(7, 23.0, |p, q| 5.0 + rough(p, q), |p, q| -30.0 + 0.3 * p + 0.5 * rough(q, p));
        let mesh = moved(&mesh, DMat3::IDENTITY, DVec3::new(-x, 0.3, 0.0));
        let found = PartMesh::new(&mesh).unwrap().passages(&edge, DVec3::ZERO, DVec3::NEG_Z).unwrap();
        brute_force(&mesh, &edge, &found.passages, 1.0)?;
        prop_assert!((shares(&found.passages, Side::Entry) - 1.0).abs() < 1e-9);
        prop_assert!((shares(&found.passages, Side::Exit) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_part_turned_or_mirrored_with_its_hole_gives_the_same(
        kind in 0usize..11,
        axis in prop::array::uniform3(-1.0..1.0f64),
        angle in 0.0..6.3f64,
        shift in prop::array::uniform3(-300.0..300.0f64),
        mirror in any::<bool>(),
    ) {
        let edge = points()[kind].edge(10.0).unwrap();
        let mesh = block(9, 40.0, |x, y| (x / 3.0).sin() + 0.3 * y, |x, y| -25.0 + 0.02 * x * y);
        let (at, way) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.1, -0.2, -1.0));
        let part = PartMesh::new(&mesh).unwrap().passages(&edge, at, way).unwrap();
        let axis = DVec3::from(axis).try_normalize().unwrap_or(DVec3::Y);
        let mut turn = DMat3::from_quat(DQuat::from_axis_angle(axis, angle));
        if mirror {
            // The mirrored mesh is inside out, and turned round.
            turn *= DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
        }
        let shift = DVec3::from(shift);
        let other = PartMesh::new(&moved(&mesh, turn, shift)).unwrap();
        let other = other.passages(&edge, turn * at + shift, turn * way * 7.0).unwrap();
        prop_assert_eq!(part.passages.len(), other.passages.len());
        for (p, q) in part.passages.iter().zip(&other.passages) {
            prop_assert!((p.transient.first - q.transient.first).abs() < 1e-9);
            prop_assert!((p.transient.last - q.transient.last).abs() < 1e-9);
            prop_assert!(p.side == q.side && (p.share - q.share).abs() < 1e-9);
        }
    }
}

/// A tube of many facets lying along y.
fn tube(facets: u32, outer: f64, inner: f64, half: f64) -> Mesh {
    let mut mesh = Mesh::default();
    for (radius, y) in [(outer, -half), (outer, half), (inner, half), (inner, -half)] {
        for i in 0..facets {
            let (s, c) = (std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(facets)).sin_cos();
            mesh.vertices.push(DVec3::new(radius * c, y, radius * s));
        }
    }
    for ring in 0..4 {
        for i in 0..facets {
            let j = (i + 1) % facets;
            let [a, b] = [ring * facets, (ring + 1) % 4 * facets];
            mesh.triangles.extend([[a + i, b + i, b + j], [a + i, b + j, a + j]]);
        }
    }
    mesh
}

#[test]
fn a_tube_of_facets_comes_near_to_its_cylinders() {
    let part = PartMesh::new(&tube(720, 40.0, 30.0, 50.0)).unwrap();
    for point in points() {
        let edge = point.edge(10.0).unwrap();
        let found = part.passages(&edge, DVec3::new(7.0, 0.0, 0.0), DVec3::NEG_Z).unwrap();
        let sides: Vec<Side> = found.passages.iter().map(|p| p.side).collect();
        assert_eq!(sides, [Side::Entry, Side::Exit, Side::Entry, Side::Exit]);
        let cylinder = |radius: f64, ridge: bool| {
            let (offset, height) = (7.0, 0.0);
            let surface = if ridge {
                BoundarySurface::Ridge { radius, offset, height }
            } else {
                BoundarySurface::Valley { radius, offset, height }
            };
            transient(&edge, &surface, Cover::Whole).unwrap()
        };
        let exact =
            [cylinder(40.0, true), cylinder(30.0, true), cylinder(30.0, false), cylinder(40.0, false)];
        for (p, t) in found.passages.iter().zip(exact) {
            // Sagitta of a facet: 40 (1 - cos 0.25 deg) = 0.00038 mm, times the secant of 35 degrees where it leans.
            assert!((p.transient.first - t.first).abs() < 1e-3, "{point:?} {:?} {t:?}", p.transient);
            assert!((p.transient.last - t.last).abs() < 1e-3, "{point:?} {:?} {t:?}", p.transient);
            assert!((p.share - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn a_step_in_the_entry_is_two_sheets() {
    // Beyond x = 0 the block stands 4 mm higher; the wall between is upright.
    let outline = [[-20.0, -30.0], [20.0, -30.0], [20.0, 4.0], [0.0, 4.0], [0.0, 0.0], [-20.0, 0.0]];
    let mut mesh = Mesh::default();
    for y in [-20.0, 20.0] {
        mesh.vertices.extend(outline.map(|[x, z]| DVec3::new(x, y, z)));
    }
    for i in 0..6 {
        let j = (i + 1) % 6;
        mesh.triangles.extend([[i, j, j + 6], [i, j + 6, i + 6]]);
    }
    for [a, b, c] in [[0, 1, 4], [0, 4, 5], [1, 2, 4], [2, 3, 4]] {
        mesh.triangles.extend([[a, c, b], [a + 6, b + 6, c + 6]]);
    }
    let edge = DrillPoint::SinglePlane { angle: deg(118.0) }.edge(10.0).unwrap();
    let found =
        PartMesh::new(&mesh).unwrap().passages(&edge, DVec3::new(1.0, 0.0, 0.0), DVec3::NEG_Z).unwrap();
    assert_eq!(found.passages.len(), 3);
    let [upper, lower, exit] = found.passages[..] else { panic!() };
    assert!((upper.transient.first - 4.0).abs() < 1e-12, "the tip, 1 mm inside");
    assert!((lower.transient.first + (1.0 / deg(59.0).tan())).abs() < 1e-12, "the edge at the wall");
    assert!((upper.share + lower.share - 1.0).abs() < 1e-12 && upper.share > lower.share);
    assert_eq!(exit.side, Side::Exit);
}

#[test]
fn bad_meshes_and_holes_are_clear_errors_and_leave_the_others() {
    let good = block(3, 40.0, |_, _| 0.0, |_, _| -30.0);
    let code = |mesh: &Mesh| PartMesh::new(mesh).unwrap_err().code();
    let mut open = good.clone();
    open.triangles.pop();
    assert_eq!(code(&open), Code::MESH_OPEN);
    let mut bad = good.clone();
    bad.vertices[3].y = f64::NAN;
    assert_eq!(code(&bad), Code::MESH_OPEN);
    assert_eq!(code(&Mesh::default()), Code::GEOMETRY);
    assert_eq!(code(&block(2, 10.0, |_, _| 0.0, |_, _| 0.0)), Code::GEOMETRY);

    let edge = DrillPoint::SinglePlane { angle: deg(118.0) }.edge(10.0).unwrap();
    let part = PartMesh::new(&good).unwrap();
    let (down, here) = (DVec3::NEG_Z, DVec3::ZERO);
    let holes = [
        (here, down),
        (DVec3::new(26.0, 0.0, 0.0), down),
        (DVec3::new(f64::NAN, 0.0, 0.0), down),
        (here, DVec3::ZERO),
        (DVec3::new(22.0, 0.0, 0.0), down),
    ];
    let found = part.passages_of_many(&edge, &holes);
    let codes: Vec<Option<Code>> = found.iter().map(|f| f.as_ref().err().map(|e| e.code())).collect();
    assert_eq!(codes, [None, Some(Code::DRILL_MISSES), Some(Code::DRILL_CASE), Some(Code::DRILL_CASE), None]);
    // The last one stands over the side: 2 mm beyond it; the segment of the disc 3 mm high.
    let half = (2f64 / 5.0).acos();
    let share = (half - 0.4 * half.sin()) / std::f64::consts::PI;
    let over = found[4].as_ref().unwrap();
    assert!((over.passages[0].share - share).abs() < 1e-12);
}
