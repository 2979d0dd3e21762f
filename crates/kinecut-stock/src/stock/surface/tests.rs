use glam::{DVec2, DVec3};
use proptest::prelude::*;

use super::bodies::{Solid, TestGrid, cuboid};
use super::*;
use crate::base::Silent;
use crate::geom::Aabb;
use crate::stock::{EndPoint, Interval, Lattice, PackedNormal, TriDexel, fixed};

fn mesh_of(grid: &TestGrid) -> Mesh {
    let s = surface_with_cuts(grid, &SurfaceOptions::default(), &Silent).unwrap();
    s.mesh.check_closed().unwrap();
    assert_eq!(s.cuts.len(), s.mesh.triangles.len());
    s.mesh
}

/// Largest distance [grid steps] of vertices, and of points all over the triangles, by a distance function.
fn worst(mesh: &Mesh, step: f64, distance: impl Fn(DVec3) -> f64) -> (f64, f64) {
    let vertices = mesh.vertices.iter().map(|&v| distance(v).abs()).fold(0.0, f64::max);
    let mut inside: f64 = 0.0;
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| mesh.vertices[i as usize]);
        for i in 0..=6 {
            for j in 0..=6 - i {
                let (u, v) = (f64::from(i) / 6.0, f64::from(j) / 6.0);
                inside = inside.max(distance(a + u * (b - a) + v * (c - a)).abs());
            }
        }
    }
    (vertices / step, inside / step)
}

/// Value of a box that resembles a signed distance: exact inside and off the faces, a bound at edges.
fn box_distance(p: DVec3, min: DVec3, max: DVec3) -> f64 {
    let q = (p - (min + max) * 0.5).abs() - (max - min) * 0.5;
    let outside = q.max(DVec3::ZERO).length();
    if outside > 0.0 { outside } else { q.max_element() }
}

#[test]
fn a_box_has_its_corners_and_few_triangles() {
    let (min, max) = (DVec3::new(-10.0, 3.0, 1.0), DVec3::new(30.0, 23.0, 9.0));
    let grid = TestGrid::of(min, max, 0.25, &cuboid(min, max), &[]);
    let mesh = mesh_of(&grid);
    assert!((mesh.volume() - 40.0 * 20.0 * 8.0).abs() < 1e-6, "{}", mesh.volume());
    let (v, t) = worst(&mesh, 0.25, |p| box_distance(p, min, max));
    assert!(v < 1e-6 && t < 1e-6, "{v} {t}");
    for i in 0..8 {
        let corner = DVec3::new([min.x, max.x][i & 1], [min.y, max.y][i >> 1 & 1], [min.z, max.z][i >> 2]);
        assert!(mesh.vertices.iter().any(|v| v.distance(corner) < 1e-9));
    }
    assert!(mesh.triangles.len() < 600, "{}", mesh.triangles.len());
    // The body of the stock itself gives the same.
    let stock = TriDexel::from_box(crate::geom::Aabb { min, max }, 0.25).unwrap();
    let other = surface(&stock, &SurfaceOptions::default(), &Silent).unwrap();
    assert_eq!(other.triangles, mesh.triangles);
}

#[test]
fn a_tilted_box_keeps_its_sharp_edges() {
    let q = glam::DQuat::from_euler(glam::EulerRot::ZYX, 0.3, -0.7, 0.45);
    let half = DVec3::new(9.0, 6.0, 4.0);
    let planes = (0..6).map(|i| {
        let mut n = DVec3::ZERO;
        n[i / 2] = if i % 2 == 0 { 1.0 } else { -1.0 };
        (q * n, half[i / 2])
    });
    let (min, max) = (DVec3::splat(-12.0), DVec3::splat(12.0));
    let grid = TestGrid::of(min, max, 0.25, &Solid::Planes(planes.collect()), &[]);
    let mesh = mesh_of(&grid);
    let exact = 8.0 * half.x * half.y * half.z;
    assert!((mesh.volume() / exact - 1.0).abs() < 1e-5, "{} {exact}", mesh.volume());
    let (v, t) = worst(&mesh, 0.25, |p| box_distance(q.inverse() * p, -half, half));
    assert!(v < 0.01 && t < 0.01, "{v} {t}");
    assert!(mesh.triangles.len() < 7000, "{}", mesh.triangles.len());
    for i in 0..8 {
        let corner =
            q * (half * DVec3::new([1.0, -1.0][i & 1], [1.0, -1.0][i >> 1 & 1], [1.0, -1.0][i >> 2]));
        let gap = mesh.vertices.iter().map(|v| v.distance(corner)).fold(f64::INFINITY, f64::min);
        assert!(gap < 0.01 * 0.25, "{gap}");
    }
}

/// A plate with a stepped bore: radius `wide` down to `floor`, then `narrow` through.
fn bored_plate(step: f64, wide: f64, narrow: f64, floor: f64) -> TestGrid {
    let (min, max) = (DVec3::new(-13.0, -13.0, -6.0), DVec3::new(13.0, 13.0, 0.0));
    let centre = DVec3::new(0.31, -0.17, 0.0);
    let above = Solid::Planes(vec![(-DVec3::Z, -floor)]);
    TestGrid::of(
        min,
        max,
        step,
        &cuboid(min, max),
        &[
            vec![Solid::Cylinder(centre, DVec3::Z, wide), above],
            vec![Solid::Cylinder(centre, DVec3::Z, narrow)],
        ],
    )
}

/// Distance to the surface of the plate with a stepped bore, by the nearest of its faces and edges.
fn bored_plate_distance(p: DVec3, wide: f64, narrow: f64, floor: f64) -> f64 {
    let centre = DVec2::new(0.31, -0.17);
    let r = p.truncate().distance(centre);
    let square = p.x.abs().max(p.y.abs());
    // Distances to each face, each bounded by its borders in (r, z) or by those of the box.
    let seg = |a: DVec2, b: DVec2| {
        let (q, e) = (DVec2::new(r, p.z), b - a);
        let t = ((q - a).dot(e) / e.length_squared()).clamp(0.0, 1.0);
        q.distance(a + t * e)
    };
    let mut d = seg(DVec2::new(wide, 0.0), DVec2::new(wide, floor))
        .min(seg(DVec2::new(wide, floor), DVec2::new(narrow, floor)))
        .min(seg(DVec2::new(narrow, floor), DVec2::new(narrow, -6.0)));
    let beyond = (square - 13.0).max(0.0);
    let short = |z: f64, radius: f64| (p.z - z).hypot(beyond).hypot((radius - r).max(0.0));
    d = d.min(short(0.0, wide)).min(short(-6.0, narrow));
    d.min((square - 13.0).abs().hypot((p.z - p.z.clamp(-6.0, 0.0)).abs()))
}

#[test]
fn a_stepped_bore_in_a_plate() {
    let (wide, narrow, floor) = (10.0, 6.0, -2.8);
    for step in [0.2, 0.1] {
        let grid = bored_plate(step, wide, narrow, floor);
        let mesh = mesh_of(&grid);
        let exact = 26.0 * 26.0 * 6.0
            - std::f64::consts::PI * (wide * wide * -floor + narrow * narrow * (6.0 + floor));
        let (v, t) = worst(&mesh, step, |p| bored_plate_distance(p, wide, narrow, floor));
        assert!((mesh.volume() / exact - 1.0).abs() < 2e-4, "{} {exact}", mesh.volume());
        assert!(v < 0.01 && t < 0.06, "{v} {t}");
        // The flat faces alone have 60 000 and 240 000 cells.
        assert!(mesh.triangles.len() < if step > 0.15 { 10_000 } else { 22_000 }, "{}", mesh.triangles.len());
        // Facets of the top face up, all of them.
        let up = |t: &&[u32; 3]| t.iter().all(|&i| mesh.vertices[i as usize].z.abs() < 1e-9);
        let down = mesh.triangles.iter().filter(up).filter(|t| {
            let [a, b, c] = t.map(|i| mesh.vertices[i as usize]);
            (b - a).cross(c - a).z < 0.0
        });
        assert_eq!(down.count(), 0);
        // The rims are sharp: vertices on the circles.
        for (r, z) in [(wide, 0.0), (wide, floor), (narrow, floor), (narrow, -6.0)] {
            let on = |v: &DVec3| {
                let off = v.truncate().distance(DVec2::new(0.31, -0.17)) - r;
                off.hypot(v.z - z) < 0.03 * step
            };
            let count = mesh.vertices.iter().filter(|v| on(v)).count();
            assert!(count as f64 > r * 6.0 / (16.0 * step), "{count}");
        }
    }
}

#[test]
fn balls_and_cones() {
    let (min, max) = (DVec3::splat(-6.0), DVec3::splat(6.0));
    let centre = DVec3::new(0.11, 0.07, -0.13);
    for (r, step) in [(5.0, 0.2), (0.8, 0.2)] {
        let grid = TestGrid::of(min, max, step, &Solid::Ball(centre, r), &[]);
        let mesh = mesh_of(&grid);
        let (v, t) = worst(&mesh, step, |p| p.distance(centre) - r);
        assert!(v < 0.1 && t < 0.1, "{v} {t}");
        let exact = 4.0 / 3.0 * std::f64::consts::PI * r.powi(3);
        assert!((mesh.volume() / exact - 1.0).abs() < 0.12 * (step / r), "{}", mesh.volume() / exact);
    }
    // A cone standing on a plane: apex, rim, smooth wall.
    let apex = DVec3::new(0.1, -0.2, 4.0);
    let (k, base) = (0.7f64, -3.0);
    let down = cuboid(DVec3::new(-6.0, -6.0, base), max);
    let Solid::Planes(planes) = down else { unreachable!() };
    let grid = TestGrid::of(min, max, 0.2, &Solid::Planes(planes), &[]);
    let mut cone = TestGrid::of(
        min,
        max,
        0.2,
        &Solid::Cone(apex, -DVec3::Z, k),
        &[vec![Solid::Planes(vec![(DVec3::Z, base)])]],
    );
    cone.lattice = grid.lattice;
    let mesh = mesh_of(&cone);
    let distance = |p: DVec3| {
        let q = DVec2::new(p.truncate().distance(apex.truncate()), p.z);
        let rim = DVec2::new(k * (apex.z - base), base);
        let seg = |a: DVec2, b: DVec2| {
            let e = b - a;
            q.distance(a + ((q - a).dot(e) / e.length_squared()).clamp(0.0, 1.0) * e)
        };
        seg(DVec2::new(0.0, apex.z), rim).min(seg(rim, DVec2::new(0.0, base)))
    };
    let (v, t) = worst(&mesh, 0.2, distance);
    assert!(v < 0.15 && t < 0.15, "{v} {t}");
    // Within three steps of the tip the wall is too round for the lattice; beyond it is not.
    let (v, t) = worst(&mesh, 0.2, |p| if p.distance(apex) < 0.6 { 0.0 } else { distance(p) });
    assert!(v < 0.02 && t < 0.1, "{v} {t}");
    let tip = mesh.vertices.iter().map(|v| v.distance(apex)).fold(f64::INFINITY, f64::min);
    assert!(tip < 0.01 * 0.2, "{tip}");
    let h = apex.z - base;
    let exact = std::f64::consts::PI * (k * h).powi(2) * h / 3.0;
    assert!((mesh.volume() / exact - 1.0).abs() < 1e-3);
}

fn noise(counts: [u32; 3], seed: u64, density: f64, normals: bool) -> TestGrid {
    // A small generator of its own so that a body is one number.
    let mut random = crate::num::random::Random(seed);
    let mut next = move || random.bits();
    let lattice = Lattice { origin: DVec3::new(-0.3, 1.0, 2.0), step: 0.37, counts };
    let lines = crate::stock::Axis::ALL.map(|axis| {
        let (u, v) = axis.others();
        let length = f64::from(counts[axis.index()]) * 0.37;
        let from = lattice.origin[axis.index()];
        (0..counts[u.index()] * counts[v.index()])
            .map(|_| {
                let n = (next() % 1000) as f64 / 1000.0 * density;
                let mut cuts: Vec<i32> = (0..2 * n.round() as usize)
                    .map(|_| fixed(from - 0.3 + (length + 0.4) * (next() % 4096) as f64 / 4096.0))
                    .collect();
                cuts.sort_unstable();
                cuts.dedup();
                let mut end = |at: i32| {
                    let bits = if normals { next() as u32 } else { PackedNormal::new(DVec3::Z, 0).0 };
                    EndPoint { at, normal: PackedNormal(bits), cut: 3 }
                };
                cuts.chunks_exact(2).map(|c| Interval { lo: end(c[0]), hi: end(c[1]) }).collect()
            })
            .collect()
    });
    TestGrid { lattice, lines }
}

proptest! {
    #![proptest_config(kinecut_cases::property(48))]
    #[test]
    fn any_lines_whatever_give_a_closed_manifold(
        counts in prop::array::uniform3(0u32..40), seed: u64, density in 0.0..9.0f64, normals: bool,
    ) {
        let grid = noise(counts, seed, density, normals);
        let s = surface_with_cuts(&grid, &SurfaceOptions::default(), &Silent).unwrap();
        s.mesh.check_closed().unwrap();
        prop_assert!(s.mesh.volume() >= 0.0 || s.mesh.triangles.is_empty() || density > 0.0);
    }

    #[test]
    fn unions_of_boxes_are_closed_and_have_their_volume(
        boxes in prop::collection::vec((prop::array::uniform3(0u32..70), prop::array::uniform3(1u32..40)), 1..7),
    ) {
        // Boxes between lattice planes, taken out of a block: the volume follows by counting points.
        let (min, max) = (DVec3::ZERO, DVec3::splat(64.0));
        let cuts: Vec<Vec<Solid>> = boxes
            .iter()
            .map(|(low, size)| {
                let low = DVec3::from_array(low.map(f64::from));
                vec![cuboid(low, low + DVec3::from_array(size.map(f64::from)))]
            })
            .collect();
        let grid = TestGrid::of(min, max, 1.0, &cuboid(min, max), &cuts);
        let mesh = surface(&grid, &SurfaceOptions::default(), &Silent).unwrap();
        mesh.check_closed().unwrap();
        let inside = |p: [u32; 3]| !boxes.iter().any(|(l, s)| (0..3).all(|i| l[i] <= p[i] && p[i] < l[i] + s[i]));
        let count = (0..64 * 64 * 64u32).filter(|n| inside([n % 64, n / 64 % 64, n / 4096])).count();
        prop_assert!((mesh.volume() - count as f64).abs() < 1e-6 + 1e-2 * f64::from(boxes.len() as u32), "{} {count}", mesh.volume());
    }
}

#[test]
fn the_same_bytes_on_one_thread_and_on_three() {
    let grid = bored_plate(0.2, 10.0, 6.0, -2.8);
    let on = |n: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
        pool.install(|| surface_with_cuts(&grid, &SurfaceOptions::default(), &Silent).unwrap())
    };
    assert!(on(1) == on(3));
}

#[test]
fn nothing_gives_nothing_and_a_point_gives_a_little_body() {
    let mut grid = noise([3, 3, 3], 1, 0.0, false);
    assert_eq!(mesh_of(&grid), Mesh::default());
    let (lo, hi) = (fixed(-0.3 + 0.37 - 0.1), fixed(-0.3 + 0.37 + 0.2));
    let end = |at, n| EndPoint { at, normal: PackedNormal::new(n, 0), cut: 1 };
    // Two of three lines through the middle point suffice.
    grid.lines[0][4] = vec![Interval { lo: end(lo, -DVec3::X), hi: end(hi, DVec3::X) }];
    assert_eq!(mesh_of(&grid), Mesh::default());
    let (lo, hi) = (fixed(1.37 - 0.1), fixed(1.37 + 0.2));
    grid.lines[1][4] = vec![Interval { lo: end(lo, -DVec3::Y), hi: end(hi, DVec3::Y) }];
    let mesh = mesh_of(&grid);
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (8, 12));
    assert!(mesh.volume() > 0.0);
}

#[test]
fn a_tolerance_must_be_positive_and_work_can_be_cancelled() {
    struct Stop;
    impl Progress for Stop {
        fn stage(&self, _: &str, _: u64) {}
        fn advance(&self, _: u64) {}
        fn cancelled(&self) -> bool {
            true
        }
    }
    let grid = noise([3, 3, 3], 1, 2.0, false);
    for tolerance in [0.0, -1.0, f64::NAN] {
        let error = surface(
            &grid,
            &SurfaceOptions { tolerance: Some(tolerance), ..SurfaceOptions::default() },
            &Silent,
        )
        .unwrap_err();
        assert_eq!(error.code(), Code::GEOMETRY);
    }
    let error = surface(&grid, &SurfaceOptions::default(), &Stop).unwrap_err();
    assert_eq!(error.code(), Code::CANCELLED);
}

#[test]
fn a_surface_stops_within_a_stage() {
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
    /// Cancels after some questions, and counts all.
    struct After(usize, AtomicUsize);
    impl Progress for After {
        fn stage(&self, _: &str, _: u64) {}
        fn advance(&self, _: u64) {}
        fn cancelled(&self) -> bool {
            self.1.fetch_add(1, Relaxed) >= self.0
        }
    }
    let size = DVec3::splat(10.0);
    let stock = TriDexel::from_box(Aabb { min: -size, max: size }, 0.1).unwrap();
    let options = SurfaceOptions::default();
    let whole = After(usize::MAX, AtomicUsize::new(0));
    surface_with_cuts(&stock, &options, &whole).unwrap();
    let whole = whole.1.into_inner();
    // One for each row of signs, and each block of 16 cells with surface.
    assert!(whole > 400 + 6 * 12 * 12, "{whole}");
    for most in [0, 100, 500, whole - 1] {
        let stopped = After(most, AtomicUsize::new(0));
        assert_eq!(surface_with_cuts(&stock, &options, &stopped).unwrap_err().code(), Code::CANCELLED);
        // Rows that are left are passed over, blocks are not begun.
        let asked = stopped.1.into_inner();
        assert!(asked < most + 400 + 4 * rayon::current_num_threads(), "{most}: {asked}");
    }
}

#[test]
fn a_surface_within_its_memory_is_the_same_and_beyond_it_the_error_tells_what_fits() {
    let ball = Solid::Ball(DVec3::splat(0.3), 9.0);
    let corner = DVec3::splat(10.0);
    let grid = TestGrid::of(-corner, corner, 0.25, &ball, &[]);
    let with = |tolerance: f64, memory: Option<u64>| {
        surface(&grid, &SurfaceOptions { tolerance: Some(tolerance), memory }, &Silent)
    };
    let whole = with(0.001, None).unwrap();
    let finding = |memory: u64| *with(0.001, Some(memory)).unwrap_err().0;
    let needed = {
        let least = finding(0);
        assert_eq!(least.code, Code::JOB_BUDGET);
        let mut range = [0u64, 1 << 30];
        while range[1] - range[0] > 1 {
            let middle = range[0].midpoint(range[1]);
            range[usize::from(with(0.001, Some(middle)).is_ok())] = middle;
        }
        assert_eq!(least.value.unwrap().value, (range[1] as f64 / 1e6).ceil());
        range[1]
    };
    assert_eq!(with(0.001, Some(needed)).unwrap(), whole);
    // What lists of vertices and triangles take is counted.
    let lists = whole.vertices.len() * 24 + whole.triangles.len() * 12;
    assert!(needed > 2 * lists as u64, "{needed} {lists}");
    let half = finding(needed / 2);
    let told: f64 = half.help.split_whitespace().find_map(|word| word.parse().ok()).unwrap();
    assert!(told > 0.001 && told <= 0.25, "{half}");
    assert!(with(told, Some(needed / 2)).is_ok());
    // With no tolerance it fits: the step is told.
    assert!(finding(needed / 1000).help.contains("step"), "{}", finding(needed / 1000));
}
