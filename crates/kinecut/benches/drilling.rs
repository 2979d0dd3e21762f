//! Drilling: analytic cases, and holes on the mesh of a part.

use divan::Bencher;
use glam::DVec3;
use kinecut::drilling::{BoundarySurface, Cover, DrillSpec, PartMesh, plan_drill, transient};
use kinecut::geom::{EdgeProfile, Mesh};
use kinecut::tool::DrillPoint;

fn main() {
    divan::main();
}

/// A closed plate of 500 x 500 mm with wavy faces: 4 n^2 + 8 n triangles.
fn wavy_plate(n: u32) -> Mesh {
    let step = 500.0 / f64::from(n);
    let wave = |x: f64, y: f64| 3.0 * (x / 17.0).sin() * (y / 23.0).cos();
    let mut mesh = Mesh::default();
    for (bottom, sign) in [(0.0, 1.0), (-40.0, -0.5)] {
        for j in 0..=n {
            for i in 0..=n {
                let (x, y) = (f64::from(i) * step, f64::from(j) * step);
                mesh.vertices.push(DVec3::new(x, y, bottom + sign * wave(x, y)));
            }
        }
    }
    let below = (n + 1) * (n + 1);
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

fn edge() -> EdgeProfile {
    DrillPoint::SinglePlane { angle: 118f64.to_radians() }.edge(10.0).expect("a drill")
}

/// 1000 holes over the plate, straight down.
fn holes() -> Vec<(DVec3, DVec3)> {
    let at = |i: u32| DVec3::new(10.0 + 15.0 * f64::from(i % 32), 10.0 + 15.0 * f64::from(i / 32), 0.0);
    (0..1000).map(|i| (at(i), DVec3::NEG_Z)).collect()
}

/// With the tree of the mesh.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn mesh_of_1e6_triangles_1000_holes_of_10_mm(bencher: Bencher) {
    let (mesh, edge, holes) = (wavy_plate(498), edge(), holes());
    assert!(mesh.triangles.len() > 990_000);
    bencher.bench_local(|| {
        let part = PartMesh::new(&mesh).expect("it is closed");
        let found = part.passages_of_many(&edge, &holes);
        assert!(found.iter().all(|hole| hole.as_ref().is_ok_and(|h| h.passages.len() == 2)));
    });
}

/// The holes alone.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn prepared_mesh_of_1e6_triangles_1000_holes_of_10_mm(bencher: Bencher) {
    let part = PartMesh::new(&wavy_plate(498)).expect("it is closed");
    let (edge, holes) = (edge(), holes());
    bencher.bench_local(|| part.passages_of_many(&edge, &holes));
}

/// Through a shaft beside its axis, with everything that a plan has: transients, zones, coordinates, times, warnings.
fn case(offset: f64) -> DrillSpec {
    let point = DrillPoint::DoubleGround { angle: 118f64.to_radians(), second: 70f64.to_radians() };
    let entry = BoundarySurface::Ridge { radius: 40.0, offset, height: 0.0 };
    let exit = BoundarySurface::Valley { radius: 40.0, offset, height: 0.0 };
    DrillSpec::new(20.0, point, entry, exit)
}

#[divan::bench(sample_size = 1000)]
fn one_analytic_case(bencher: Bencher) {
    let spec = case(7.0);
    bencher.bench(|| plan_drill(divan::black_box(&spec)).expect("a plan"));
}

#[divan::bench]
fn one_edge(bencher: Bencher) {
    let spec = case(7.0);
    bencher.bench(|| divan::black_box(&spec).point.edge(20.0).expect("an edge"));
}

#[divan::bench]
fn one_transient(bencher: Bencher) {
    let spec = case(7.0);
    let edge = spec.point.edge(20.0).expect("an edge");
    bencher.bench(|| transient(divan::black_box(&edge), &spec.entry, Cover::Whole).expect("it covers"));
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn table_of_100_000_rows(bencher: Bencher) {
    let rows: Vec<DrillSpec> = (0..100_000).map(|i| case(f64::from(i % 200) * 0.1)).collect();
    bencher.bench(|| rows.iter().filter_map(|spec| plan_drill(spec).ok()).map(|plan| plan.time).sum::<f64>());
}
