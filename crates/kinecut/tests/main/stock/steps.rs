//! Lines in faces: whatever the distance of the lines, also where lines, lattice points or the layer beyond the last one
//! lie in a face of the stock or of a cut, the surface closes and its volume is right.

use std::f64::consts::PI;

use glam::DVec3;
use kinecut::base::Silent;
use kinecut::geom::{Aabb, Arc, Curve, Line, Profile, Solid};
use kinecut::stock::cut::{CutAxis, CutMove, CutOptions, ToolBody, cut};
use kinecut::stock::surface::{SurfaceOptions, surface_with_cuts};
use kinecut::stock::{TriDexel, Volume};

/// Steps at which a length is a whole number of steps, a half more, and a hair beside both.
fn steps(length: f64) -> Vec<f64> {
    let whole = (0..9).map(|i| length / f64::from(8 + 3 * i));
    let half = (0..9).map(|i| length / (f64::from(8 + 3 * i) + 0.5));
    let beside = |s: f64| [s * (1.0 - 1e-15), s, s * (1.0 + 1e-15), s + 1e-6, s - 1e-6];
    whole.chain(half).flat_map(beside).collect()
}

/// Cuts, closes, and compares the volume of what is left.
fn check(solid: &Solid, tool: &Profile, moves: &[Curve], step: f64, exact: f64) {
    let mut stock = TriDexel::from_solid(solid, step).unwrap();
    let moves: Vec<CutMove> = moves.iter().map(|c| CutMove::new(c.clone(), CutAxis::PlusZ, 0)).collect();
    cut(&mut stock, &[ToolBody::new(tool.clone())], &moves, &CutOptions::default(), &Silent).unwrap();
    let surface = surface_with_cuts(&stock, &SurfaceOptions::default(), &Silent).unwrap();
    surface.mesh.check_closed().unwrap_or_else(|e| panic!("step {step}: {e}"));
    let left = Volume::of_surface(&surface, &SurfaceOptions::default(), &stock, false);
    assert!((left.value - exact).abs() <= left.bound, "step {step}: {left:?} but {exact}");
}

fn ring(radius: f64, z: f64) -> [Curve; 2] {
    let plunge = Line { start: DVec3::new(radius, 0.0, z + 50.0), end: DVec3::new(radius, 0.0, z) };
    let turn = Arc::new(plunge.end, DVec3::new(0.0, 0.0, z), DVec3::Z, 2.0 * PI, 0.0).unwrap();
    [plunge.into(), turn.into()]
}

#[test]
fn a_plate_with_a_bore() {
    // The plate of the first example, a quarter as wide.
    let plate = Aabb { min: DVec3::new(-65.0, -65.0, -30.0), max: DVec3::new(65.0, 65.0, 0.0) };
    let tool = Profile::cylinder(40.0, 45.0).unwrap();
    let moves: Vec<Curve> = [-15.0, -30.0].into_iter().flat_map(|z| ring(20.0, z)).collect();
    let exact = 130.0 * 130.0 * 30.0 - PI * 1600.0 * 30.0;
    for step in steps(30.0).into_iter().chain([0.8]) {
        check(&Solid::Box(plate), &tool, &moves, step, exact);
    }
}

#[test]
fn a_block_with_a_step_and_a_slot_at_whole_millimetres() {
    let block = Aabb { min: DVec3::new(0.0, 0.0, 0.0), max: DVec3::new(40.0, 30.0, 12.0) };
    let tool = Profile::cylinder(8.0, 20.0).unwrap();
    let way = |y: f64, z: f64| -> Curve {
        Line { start: DVec3::new(-10.0, y, z), end: DVec3::new(50.0, y, z) }.into()
    };
    let moves = [way(4.0, 8.0), way(20.0, 6.0)];
    let exact = 40.0 * (30.0 * 12.0 - 8.0 * 4.0 - 8.0 * 6.0);
    for step in steps(12.0).into_iter().filter(|s| *s > 0.25) {
        check(&Solid::Box(block), &tool, &moves, step, exact);
    }
}

#[test]
fn a_bar_with_a_flat_floor() {
    let bar = Solid::Cylinder { base: DVec3::new(1.0, 2.0, -12.0), radius: 16.0, height: 12.0 };
    let tool = Profile::cylinder(60.0, 20.0).unwrap();
    let moves: [Curve; 1] =
        [Line { start: DVec3::new(-80.0, 2.0, -4.0), end: DVec3::new(80.0, 2.0, -4.0) }.into()];
    for step in steps(12.0).into_iter().chain(steps(32.0)).filter(|s| *s > 0.3 && *s < 3.0) {
        check(&bar, &tool, &moves, step, PI * 256.0 * 8.0);
    }
}
