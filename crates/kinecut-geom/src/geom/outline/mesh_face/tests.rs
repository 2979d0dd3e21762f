use std::f64::consts::{PI, TAU};

use glam::dvec2;
use proptest::prelude::*;

use super::*;
use crate::geom::write_stl;

/// A prism over a disc-like polygon with a bore: walls of rectangles, caps as a ring of rectangles between both loops,
/// which must have the same number of points.
fn ring(outer: &[DVec2], inner: &[DVec2], low: f64, high: f64) -> Mesh {
    let n = outer.len() as u32;
    let mut mesh = Mesh::default();
    for z in [low, high] {
        for points in [outer, inner] {
            mesh.vertices.extend(points.iter().map(|p| p.extend(z)));
        }
    }
    let id = |level: u32, inside: u32, i: u32| level * 2 * n + inside * n + i % n;
    let mut quad = |a: u32, b: u32, c: u32, d: u32| mesh.triangles.extend([[a, b, c], [a, c, d]]);
    for i in 0..n {
        quad(id(0, 0, i), id(0, 0, i + 1), id(1, 0, i + 1), id(1, 0, i));
        quad(id(0, 1, i + 1), id(0, 1, i), id(1, 1, i), id(1, 1, i + 1));
        quad(id(1, 0, i), id(1, 0, i + 1), id(1, 1, i + 1), id(1, 1, i));
        quad(id(0, 0, i + 1), id(0, 0, i), id(0, 1, i), id(0, 1, i + 1));
    }
    mesh
}

fn circle(centre: DVec2, r: f64, n: usize) -> Vec<DVec2> {
    // From the direction of the first corner of the rectangle below.
    (0..n).map(|i| centre + r * DVec2::from_angle(-2.5 + TAU * i as f64 / n as f64)).collect()
}

/// 24 points of a rectangle, six a side.
fn rectangle(w: f64, h: f64) -> Vec<DVec2> {
    let corners = [dvec2(-w, -h), dvec2(w, -h), dvec2(w, h), dvec2(-w, h)];
    (0..4)
        .flat_map(|k| (0..6).map(move |i| corners[k].lerp(corners[(k + 1) % 4], f64::from(i) / 6.0)))
        .collect()
}

#[test]
fn a_bore_of_24_facets_is_one_exact_circle_and_sides_are_one_line() {
    let mesh = ring(&rectangle(40.0, 30.0), &circle(dvec2(5.0, 3.0), 12.0, 24), -10.0, 0.0);
    assert!(mesh.check_closed().is_ok() && mesh.volume() > 0.0);
    let solid = Solid::Mesh(mesh.clone());
    let faces = [
        Outline::top_of(&solid, 1e-3),
        Outline::section_of(&solid, -3.7, 1e-3),
        Outline::section_of(&solid, 0.0, 1e-3),
    ];
    for face in faces {
        let face = face.unwrap();
        assert_eq!(face.edges().len(), 5);
        let turn = face.edges().iter().find_map(|e| e.turn).unwrap();
        assert!(turn.centre.distance(dvec2(5.0, 3.0)) < 1e-9 && (turn.radius - 12.0).abs() < 1e-9);
        assert!((face.area() - (4800.0 - PI * 144.0)).abs() < 1e-7);
        assert!(face.loops().iter().filter(|l| l.outer).count() == 1);
    }
    // Without a tolerance the chords stay; an STL file has 32-bit numbers and gives the circle too.
    assert_eq!(Outline::top_of(&solid, 0.0).unwrap().edges().len(), 28);
    let read = read_stl_face("part.stl", &write_stl(&mesh), &OutlineOptions::default()).unwrap();
    assert_eq!(read.outline.edges().len(), 5);
    assert!((read.outline.area() - (4800.0 - PI * 144.0)).abs() < 1e-3);
    assert!(read.notes[0].contains("1 arcs stand for 24 chords"), "{:?}", read.notes);
}

#[test]
fn a_section_in_a_face_is_what_lies_just_under_it() {
    // A step: a wide ring with a narrower one on it, each closed by itself.
    let mut mesh = ring(&circle(DVec2::ZERO, 20.0, 48), &circle(DVec2::ZERO, 5.0, 48), 0.0, 10.0);
    let upper = ring(&circle(DVec2::ZERO, 15.0, 48), &circle(DVec2::ZERO, 5.0, 48), 11.0, 20.0);
    let shift = mesh.vertices.len() as u32;
    mesh.vertices.extend(upper.vertices);
    mesh.triangles.extend(upper.triangles.iter().map(|t| t.map(|i| i + shift)));
    let solid = Solid::Mesh(mesh);
    let area = |z: f64| Outline::section_of(&solid, z, 1e-3).unwrap().area();
    for (z, r) in [(10.0, 20.0), (9.0, 20.0), (12.0, 15.0), (20.0, 15.0)] {
        assert!((area(z) - PI * (r * r - 25.0)).abs() < 1e-7, "{z}");
    }
    for z in [0.0, 10.5, 11.0, 20.1] {
        let error = Outline::section_of(&solid, z, 1e-3).unwrap_err();
        assert_eq!(error.code(), Code::OUTLINE_FILE, "{z}");
    }
}

#[test]
fn polygons_that_are_polygons_stay_and_slots_have_two_arcs() {
    let edges = |points: &[DVec2]| recover(points, 1e-3, 50.0).0;
    for n in [4, 5, 6, 8, 10] {
        assert!(edges(&circle(DVec2::ZERO, 20.0, n)).iter().all(|e| e.turn.is_none()), "{n}");
    }
    for n in [12, 24, 1000] {
        assert_eq!(edges(&circle(DVec2::ZERO, 20.0, n)).len(), 1, "{n}");
    }
    // A slot from every start vertex: two half circles of eight chords and two lines.
    let half = |x: f64, from: f64| {
        (0..=8).map(move |i| dvec2(x, 0.0) + 6.0 * DVec2::from_angle(from + PI * f64::from(i) / 8.0))
    };
    let mut slot: Vec<DVec2> = half(15.0, -0.5 * PI).chain(half(-15.0, 0.5 * PI)).collect();
    for k in 0..slot.len() {
        slot.rotate_left(1);
        let found = edges(&slot);
        assert_eq!(found.len(), 4, "{k}");
        let length: f64 = found.iter().map(OutlineEdge::length).sum();
        assert!((length - (60.0 + TAU * 6.0)).abs() < 1e-9);
        let outline = Outline::new(vec![found], vec![]).unwrap();
        assert!((outline.area() - (360.0 + PI * 36.0)).abs() < 1e-9);
    }
    // A circle with a flat: the flat stays, though its ends lie on the circle.
    let flat: Vec<DVec2> = circle(DVec2::ZERO, 20.0, 48).into_iter().skip(6).collect();
    let found = edges(&flat);
    assert_eq!(found.len(), 2);
    assert!(
        found.iter().any(|e| e.turn.is_none() && (e.length() - 40.0 * (7.0 * PI / 48.0).sin()).abs() < 1e-9)
    );
}

#[test]
fn domes_and_open_meshes_are_refused() {
    let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
    let mut mesh = Mesh {
        vertices: corners.map(Into::into).to_vec(),
        triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
    };
    let error = Outline::top_of(&Solid::Mesh(mesh.clone()), 1e-3).unwrap_err();
    assert!(error.to_string().contains("no horizontal face") && error.code() == Code::OUTLINE_FILE);
    let middle = Outline::section_of(&Solid::Mesh(mesh.clone()), 1.0, 1e-3).unwrap();
    assert!((middle.area() - 0.5).abs() < 1e-12);
    mesh.triangles.pop();
    assert_eq!(Outline::top_of(&Solid::Mesh(mesh), 1e-3).unwrap_err().code(), Code::MESH_OPEN);
}

#[test]
fn a_box_gives_its_rectangle_at_its_heights_only() {
    let solid = Solid::Box(Aabb { min: DVec3::new(1.0, 2.0, 0.0), max: DVec3::new(5.0, 5.0, 9.0) });
    for face in [Outline::top_of(&solid, 0.0), Outline::section_of(&solid, 9.0, 0.0)] {
        assert_eq!(face.unwrap().area(), 12.0);
    }
    assert!(Outline::section_of(&solid, 0.0, 0.0).is_err());
}

proptest! {
    #![proptest_config(kinecut_cases::property(40))]

    /// The material just below any height has the area that the volume loses there: a mesh moved by little.
    #[test]
    fn sections_of_turned_boxes_have_the_area_of_slices(a in -1.5..1.5f64, b in -1.5..1.5f64, h in -0.9..0.9f64) {
        let turn = glam::DMat3::from_rotation_x(a) * glam::DMat3::from_rotation_y(b);
        let corner = |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) * 2.0 - 1.0;
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let mesh = Mesh {
            vertices: (0..8).map(|i| turn * corner(i)).collect(),
            triangles: faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]).collect(),
        };
        prop_assume!(mesh.check_closed().is_ok() && mesh.volume() > 0.0);
        let face = Outline::section_of(&Solid::Mesh(mesh), h, 1e-3).unwrap();
        // Inside exactly where the point turned back lies in the cube.
        for i in 0..400 {
            let p = DVec2::new(f64::from(i % 20), f64::from(i / 20)) * 0.2 - 1.9;
            let back = turn.transpose() * p.extend(h);
            let inside = back.abs().max_element() - 1.0;
            if inside.abs() > 1e-9 {
                prop_assert_eq!(face.contains(p), inside < 0.0);
            }
        }
        let outer = face.loops().iter().filter(|l| l.outer).count();
        prop_assert_eq!(outer, face.loops().len());
    }
}

#[test]
fn the_loop_of_an_edge_is_found_by_a_point_near_it() {
    let mesh = ring(&rectangle(40.0, 30.0), &circle(dvec2(5.0, 3.0), 12.0, 24), -10.0, 0.0);
    // Vertices as a file of 32 bits rounds them.
    let mut rounded = mesh.clone();
    rounded.vertices.iter_mut().for_each(|v| *v = v.as_vec3().as_dvec3());
    for mesh in [&mesh, &rounded] {
        let of = |x: f64, y: f64, z: f64| Outline::edge_of(mesh, DVec3::new(x, y, z), 1e-3).unwrap();
        let (rim, edge) = of(17.2, 3.1, 0.3);
        let turn = rim.edges()[0].turn.unwrap();
        assert!(rim.edges().len() == 1 && turn.centre.distance(dvec2(5.0, 3.0)) < 1e-5);
        assert!((turn.radius - 12.0).abs() < 1e-5, "{}", turn.radius);
        assert!(!edge.material_inside && edge.is_upper && edge.height == 0.0, "{edge:?}");
        let (rim, edge) = of(40.4, 10.0, -0.4);
        assert!((rim.area() - 4800.0).abs() < 1e-4 && edge.material_inside && edge.is_upper, "{edge:?}");
        // The same edges from below cannot be broken from above.
        for (x, material_inside) in [(17.0, false), (40.0, true)] {
            let (_, edge) = of(x, 3.0, -10.0);
            assert!(!edge.is_upper && edge.material_inside == material_inside && edge.height == -10.0);
        }
        let far = Outline::edge_of(mesh, DVec3::new(28.0, 3.0, 0.0), 1e-3).unwrap_err();
        let found = &far.0;
        assert!(found.message.contains("no sharp level edge"), "{found:?}");
        assert!((found.value.as_ref().unwrap().value - 11.0).abs() < 0.2, "{found:?}");
    }
}

#[test]
fn an_edge_that_is_no_loop_or_branches_is_refused_at_its_place() {
    // A wedge: its upper edge is level, and ends at both sides.
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let vertices = vec![
        at(0.0, 0.0, 0.0),
        at(30.0, 0.0, 0.0),
        at(30.0, 20.0, 0.0),
        at(0.0, 20.0, 0.0),
        at(0.0, 10.0, 8.0),
        at(30.0, 10.0, 8.0),
    ];
    let triangles =
        vec![[0, 2, 1], [0, 3, 2], [0, 1, 5], [0, 5, 4], [3, 5, 2], [3, 4, 5], [0, 4, 3], [1, 2, 5]];
    let wedge = Mesh { vertices, triangles };
    let e = Outline::edge_of(&wedge, at(15.0, 10.0, 8.0), 1e-3).unwrap_err();
    assert!(e.0.message.contains("ends here") && e.0.point.is_some(), "{e}");
    // A roof of six degrees is no edge: facets of a round edge turn as much.
    let mut flat = wedge.clone();
    flat.vertices[4].z = 0.5;
    flat.vertices[5].z = 0.5;
    let e = Outline::edge_of(&flat, at(15.0, 10.0, 0.5), 1e-3).unwrap_err();
    assert!(e.0.message.contains("no sharp level edge"), "{e}");
    // Two blocks that touch along an upright edge: at its top four level edges meet.
    let block = |x: f64, y: f64| {
        let corner = |i: u8| {
            at(x + f64::from(i & 1) * 10.0, y + f64::from(i >> 1 & 1) * 10.0, f64::from(i >> 2) * 5.0)
        };
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Mesh { vertices: (0..8).map(corner).collect(), triangles }
    };
    let (mut both, other) = (block(0.0, 0.0), block(10.0, 10.0));
    let corner =
        |mesh: &Mesh, z: f64| mesh.vertices.iter().position(|v| *v == at(10.0, 10.0, z)).unwrap() as u32;
    let (shift, same) = (both.vertices.len() as u32, [corner(&both, 5.0), corner(&both, 0.0)]);
    let [top, low] = [corner(&other, 5.0), corner(&other, 0.0)];
    let id = |i: u32| {
        if i == top {
            same[0]
        } else if i == low {
            same[1]
        } else {
            i + shift
        }
    };
    both.triangles.extend(other.triangles.iter().map(|t| t.map(id)));
    both.vertices.extend(other.vertices.iter().copied());
    // Wherever it begins, at that corner too.
    for (x, y) in [(5.0, 0.0), (10.0, 9.0), (9.0, 10.0), (10.0, 11.0), (11.0, 10.0)] {
        let found = edge::edge_loop(&both, at(x, y, 5.0)).unwrap_err();
        assert!(found.0.message.contains("several level edges"), "{found}");
        assert_eq!(found.0.point, Some([10.0, 10.0, 5.0]));
    }
}
