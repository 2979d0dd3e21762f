//! Sliding groups and faces of meshes against surfaces whose answers are known: catalogue surfaces as coarse and fine
//! meshes, in any place, with noise and with dents.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};
use kinecut::geom::{Mesh, Rigid, read_stl, write_stl};
use kinecut::machine::surface::{
    Form, GeneratedSurface, Primitive, RecogniseOptions, RecognisedFace, Sample, Slide, catalogue, recognise,
    sliding_group,
};
use proptest::prelude::*;

use crate::common::random::Random;

/// A grid of a surface as triangles with the normal outwards, `n` by `m` cells.
fn mesh(surface: &GeneratedSurface, n: usize, m: usize) -> Mesh {
    let shape = surface.compiled().unwrap();
    let mut mesh = Mesh::default();
    for i in 0..=n {
        for j in 0..=m {
            let (u, v) =
                (surface.variables[0].at(i as f64 / n as f64), surface.variables[1].at(j as f64 / m as f64));
            mesh.vertices.push(shape.point(u, v));
        }
    }
    let at = |i: usize, j: usize| (i * (m + 1) + j) as u32;
    for i in 0..n {
        for j in 0..m {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let quad = if surface.inward { [[a, c, b], [a, d, c]] } else { [[a, b, c], [a, c, d]] };
            mesh.triangles.extend(quad);
        }
    }
    mesh
}

fn moved(mesh: &Mesh, motion: &Rigid) -> Mesh {
    Mesh {
        vertices: mesh.vertices.iter().map(|p| motion.point(*p)).collect(),
        triangles: mesh.triangles.clone(),
    }
}

fn only(mesh: &Mesh) -> RecognisedFace {
    let found = recognise(mesh, &RecogniseOptions::default()).unwrap();
    assert_eq!(found.faces.len(), 1, "{found:?}");
    found.faces[0].clone()
}

/// Distance of two lines given by a point and a direction each, at the first point, and the angle between them.
fn axis_error(slide: &Slide, point: DVec3, axis: DVec3) -> [f64; 2] {
    let Slide::Turn { axis: found, point: at, .. } = *slide else { panic!("no axis: {slide}") };
    let off = at - point;
    [(off - axis * off.dot(axis)).length(), found.cross(axis).length()]
}

fn form_of(name: &str) -> Form {
    match name {
        "plane" | "plane-facing" => Form::Plane,
        "cylinder" => Form::Cylinder,
        "sphere" | "sphere-ring" => Form::Sphere,
        "cone" | "torus" | "revolution" | "hyperboloid" => Form::Revolution,
        "extrusion" | "elliptic-cylinder" | "involute-cylinder" | "scroll" => Form::Extrusion,
        "right-helicoid" | "inclined-helicoid" | "screw" => Form::Screw,
        _ => Form::General,
    }
}

fn placement(angles: [f64; 3], shift: [f64; 3]) -> Rigid {
    let rotation = DMat3::from_rotation_z(angles[0])
        * DMat3::from_rotation_x(angles[1])
        * DMat3::from_rotation_y(angles[2]);
    Rigid { rotation, translation: DVec3::from_array(shift) }
}

proptest! {
    #![proptest_config(kinecut_cases::property(16))]

    /// Samples of formulas anywhere in space: the form, and each slide really slides.
    #[test]
    fn exact_samples_are_named_in_any_place(
        which in 0..19_usize,
        angles in prop::array::uniform3(-3.0..3.0f64),
        shift in prop::array::uniform3(-300.0..300.0f64),
    ) {
        let surface = &catalogue()[which];
        let motion = placement(angles, shift);
        let shape = surface.compiled().unwrap();
        let samples: Vec<Sample> = (0..15 * 15)
            .map(|k| {
                let (a, b) = ((k / 15) as f64 / 14.0, (k % 15) as f64 / 14.0);
                let (u, v) = (surface.variables[0].at(a), surface.variables[1].at(b));
                let (point, normal) = (motion.point(shape.point(u, v)), motion.vector(shape.normal(u, v).unwrap()));
                Sample { point, normal, weight: 1.0 }
            })
            .collect();
        let group = sliding_group(&samples, 0.0).unwrap();
        prop_assert_eq!(group.form, form_of(&surface.name), "{} {:?}", surface.name, group);
        prop_assert_eq!(group.slides.len(), group.form.dimension());
        for slide in &group.slides {
            for s in &samples {
                let velocity = slide.velocity(s.point);
                prop_assert!(velocity.dot(s.normal).abs() < 1e-9 * (1.0 + velocity.length()), "{} {slide}", surface.name);
            }
        }
        if group.form == Form::Screw {
            let pitch = surface.parameter("p").unwrap();
            prop_assert!((group.slides[0].lead().unwrap() - pitch).abs() < 1e-9 * pitch);
            let axis = motion.vector(DVec3::Z);
            let [off, tilt] = axis_error(&group.slides[0], motion.point(DVec3::ZERO), axis);
            prop_assert!(off < 1e-8 && tilt < 1e-10, "{off} {tilt}");
        }
    }

    /// Fine meshes of every surface, written as STL with its single precision, in any place.
    #[test]
    fn meshes_are_named_in_any_place(
        which in 0..19_usize,
        angles in prop::array::uniform3(-3.0..3.0f64),
        shift in prop::array::uniform3(-100.0..100.0f64),
    ) {
        let surface = &catalogue()[which];
        let placed = moved(&mesh(surface, 40, 20), &placement(angles, shift));
        let read = read_stl(&write_stl(&placed)).unwrap();
        let face = only(&read);
        prop_assert_eq!(face.group.form, form_of(&surface.name), "{} {}", surface.name, face);
        prop_assert!(face.outliers.is_empty());
    }
}

#[test]
fn coarse_cylinders_are_cylinders() {
    for facets in [10, 12, 16, 37] {
        let cylinder = GeneratedSurface::named("cylinder").unwrap().over("phi", 0.0, TAU);
        let turned = placement([0.3, 1.1, -0.4], [40.0, -12.0, 7.0]);
        let face = only(&read_stl(&write_stl(&moved(&mesh(&cylinder, facets, 1), &turned))).unwrap());
        assert_eq!(face.group.form, Form::Cylinder, "{facets}: {face}");
        let Primitive::Cylinder { radius } = face.primitive else { panic!("{face}") };
        assert!((radius - 20.0).abs() < 1e-5, "{facets}: {radius}");
        let [off, tilt] =
            axis_error(&face.group.slides[0], turned.point(DVec3::ZERO), turned.vector(DVec3::Z));
        assert!(off < 1e-5 && tilt < 1e-6, "{facets}: {off} {tilt}");
        assert_eq!(face.catalogue_name(), Some("cylinder"));
    }
}

/// A chamfer is one row of facets: a cone, and no zone of a sphere. A left-handed thread is told as such.
#[test]
fn one_row_is_ruled_and_left_is_left() {
    for facets in [12, 24, 60] {
        let chamfer = GeneratedSurface::named("cone")
            .unwrap()
            .with("alpha", 0.8)
            .over("phi", 0.0, TAU)
            .over("z", 0.0, 2.0);
        let face = only(&read_stl(&write_stl(&mesh(&chamfer, facets, 1))).unwrap());
        assert_eq!(face.group.form, Form::Revolution, "{facets}: {face}");
        let Primitive::Cone { half_angle, .. } = face.primitive else { panic!("{facets}: {face}") };
        assert!((half_angle - 0.8).abs() < 1e-4, "{facets}: {half_angle}");
    }
    let left = GeneratedSurface::named("inclined-helicoid").unwrap().with("p", -4.0);
    let face = only(&mesh(&left, 80, 10));
    assert!((face.group.slides[0].lead().unwrap() + 4.0).abs() < 0.01, "{face}");
    assert!(face.to_string().contains("left-handed"), "{face}");
}

/// A closed shaft: the wall and two caps, each with its name; and what is less than a crease apart is one face.
#[test]
fn a_closed_part_falls_into_its_faces() {
    let n = 24_u32;
    let mut part = Mesh::default();
    for z in [0.0, 30.0] {
        for i in 0..n {
            let phi = TAU * f64::from(i) / f64::from(n);
            part.vertices.push(DVec3::new(8.0 * phi.cos(), 8.0 * phi.sin(), z));
        }
    }
    let bottom = part.vertices.len() as u32;
    part.vertices.extend([DVec3::ZERO, DVec3::new(0.0, 0.0, 30.0)]);
    for i in 0..n {
        let j = (i + 1) % n;
        part.triangles.extend([[i, j, n + j], [i, n + j, n + i], [bottom, j, i], [bottom + 1, n + i, n + j]]);
    }
    let found = recognise(&part, &RecogniseOptions::default()).unwrap();
    let forms: Vec<Form> = found.faces.iter().map(|f| f.group.form).collect();
    assert_eq!(forms, [Form::Cylinder, Form::Plane, Form::Plane]);
    let normals: Vec<DVec3> = found.faces[1..]
        .iter()
        .map(|f| match f.primitive {
            Primitive::Plane { normal, .. } => normal,
            other => panic!("{other}"),
        })
        .collect();
    assert!(normals[0].distance(-DVec3::Z) < 1e-12 && normals[1].distance(DVec3::Z) < 1e-12);
    assert_eq!(found.unnamed_area, 0.0);
}

#[test]
fn a_box_has_six_planes() {
    let mut part = Mesh::default();
    for i in 0..8_u32 {
        let bit = |k: u32| f64::from(i >> k & 1);
        part.vertices.push(DVec3::new(40.0 * bit(0), 30.0 * bit(1), 20.0 * bit(2)));
    }
    for [a, b, c, d] in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
        part.triangles.extend([[a, b, c], [a, c, d]]);
    }
    let found = recognise(&part, &RecogniseOptions::default()).unwrap();
    assert_eq!(found.faces.len(), 6);
    assert!(found.faces.iter().all(|f| f.group.form == Form::Plane), "{found:?}");
}

#[test]
fn dimensions_are_told() {
    let face = |name: &str| only(&mesh(&GeneratedSurface::named(name).unwrap(), 64, 32));
    let Primitive::Cone { half_angle, apex } = face("cone").primitive else { panic!("{}", face("cone")) };
    assert!(
        (half_angle - 0.35).abs() < 1e-6 && apex.distance(DVec3::Z * 30.0 / 0.35_f64.tan()) < 1e-3,
        "{apex}"
    );
    let Primitive::Sphere { radius, centre } = face("sphere").primitive else { panic!("{}", face("sphere")) };
    assert!((radius - 25.0).abs() < 0.01 && centre.length() < 0.01, "{radius} {centre}");
    let Primitive::Torus { major, minor } = face("torus").primitive else { panic!("{}", face("torus")) };
    assert!((major - 40.0).abs() < 0.02 && (minor - 12.0).abs() < 0.02, "{major} {minor}");
    let Primitive::Screw { lead, radii } = face("screw").primitive else { panic!("{}", face("screw")) };
    // Facets of five degrees give the pitch to two parts in a thousand.
    assert!(
        (lead - 10.0).abs() < 0.03 && (radii[0] - 18.0).abs() < 0.1 && (radii[1] - 22.0).abs() < 0.1,
        "{lead} {radii:?}"
    );
    assert!(
        face("screw").to_string().starts_with("right-handed screw surface of pitch 9.98"),
        "{}",
        face("screw")
    );
}

/// A thread of one millimetre on a radius of twenty: the screw is told from the rotation.
#[test]
fn a_fine_thread_is_a_screw_and_no_revolution() {
    let thread = GeneratedSurface::named("screw").unwrap().with("p", 1.0).with("a", 0.3).over("t", 0.0, 1.0);
    let face = only(&mesh(&thread, 96, 24));
    assert_eq!(face.group.form, Form::Screw, "{face}");
    assert!((face.group.slides[0].lead().unwrap() - 1.0).abs() < 0.01, "{face}");
}

/// Scans: corners off by 20 micrometres, on facets of a millimetre and more.
#[test]
fn noise_keeps_the_name() {
    for (name, u, v) in
        [("plane", 20, 15), ("cylinder", 60, 20), ("cone", 60, 20), ("sphere", 60, 14), ("screw", 60, 8)]
    {
        let mut noisy = mesh(&GeneratedSurface::named(name).unwrap(), u, v);
        let mut noise = Random(7);
        noisy.vertices.iter_mut().for_each(|p| *p += noise.vector(0.02));
        let options = RecogniseOptions { noise: 0.03, ..RecogniseOptions::default() };
        let found = recognise(&noisy, &options).unwrap();
        let face = &found.faces[0];
        assert_eq!(face.group.form, form_of(name), "{name}: {face} {:?}", face.group);
        match face.primitive {
            Primitive::Cylinder { radius } => assert!((radius - 20.0).abs() < 0.01, "{radius}"),
            Primitive::Sphere { radius, .. } => assert!((radius - 25.0).abs() < 0.05, "{radius}"),
            Primitive::Screw { lead, .. } => assert!((lead - 10.0).abs() < 0.1, "{lead}"),
            _ => {}
        }
    }
}

/// A dent in a shaft: the shaft is named, the dent is said to be none of it.
#[test]
fn a_dent_is_reported_as_outliers() {
    let shaft = GeneratedSurface::named("cylinder").unwrap();
    let mut dented = mesh(&shaft, 60, 40);
    let (middle, reach) = (DVec3::new(20.0, 0.0, 20.0), 7.0);
    let turn = DMat3::from_rotation_z(2.0);
    let mut touched = 0;
    for p in &mut dented.vertices {
        let distance = p.distance(turn * middle);
        if distance < reach {
            *p -= turn * DVec3::X * 0.8 * (1.0 - distance / reach);
            touched += 1;
        }
    }
    assert!(touched > 20);
    let face = only(&dented);
    assert_eq!(face.group.form, Form::Cylinder, "{face} {:?}", face.group);
    assert!(face.outliers.len() > 10 && face.outliers.len() < 6 * touched, "{}", face.outliers.len());
    let near = |t: &u32| {
        dented.triangles[*t as usize]
            .iter()
            .any(|v| dented.vertices[*v as usize].distance(turn * middle) < reach + 3.0)
    };
    assert!(face.outliers.iter().all(near));
    let [off, tilt] = axis_error(&face.group.slides[0], DVec3::ZERO, DVec3::Z);
    assert!(off < 0.05 && tilt < 2e-3, "{off} {tilt}");
}

#[test]
fn what_says_nothing_is_refused() {
    let sample = |point: DVec3| Sample { point, normal: DVec3::Z, weight: 1.0 };
    let message = |samples: &[Sample]| sliding_group(samples, 0.0).unwrap_err().to_string();
    let line: Vec<Sample> = (0..20).map(|i| sample(DVec3::X * f64::from(i))).collect();
    assert!(message(&line).contains("on one line"));
    assert!(message(&line[..4]).contains("too few samples"));
    assert!(message(&[sample(DVec3::ONE); 9]).contains("one place"));
    assert!(message(&[sample(DVec3::NAN); 9]).contains("not finite"));
    let options = RecogniseOptions::default();
    assert!(recognise(&Mesh::default(), &options).is_err());
    let missing = Mesh { vertices: vec![DVec3::ZERO], triangles: vec![[0, 0, 9]] };
    assert!(recognise(&missing, &options).is_err());
    // One triangle is a plane, a sliver without area is nothing.
    let corner = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X * 2.0];
    let one = Mesh { vertices: corner.to_vec(), triangles: vec![[0, 1, 3]] };
    assert_eq!(recognise(&one, &options).unwrap().faces.len(), 0);
}
