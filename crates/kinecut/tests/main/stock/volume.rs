//! Printed volumes: the true one lies within the bound beside them, and the bound is worth printing.

use std::f64::consts::PI;

use glam::DVec3;
use kinecut::base::Silent;
use kinecut::geom::{Aabb, Curve, Line, Profile, Solid};
use kinecut::stock::cut::{CutAxis, CutMove, CutOptions, ToolBody, cut};
use kinecut::stock::surface::{SurfaceOptions, surface_with_cuts};
use kinecut::stock::{TriDexel, Volume};

const BLOCK: Aabb = Aabb { min: DVec3::new(-20.0, -15.0, -12.0), max: DVec3::new(21.0, 14.0, 0.0) };

fn way(a: [f64; 3], b: [f64; 3]) -> Curve {
    Line { start: a.into(), end: b.into() }.into()
}

/// What moves of a cutter with their tool axes remove, by the surface of what is left and by its lines; `solid` is the raw stock.
fn removed(solid: &Solid, step: f64, tool: &Profile, moves: &[(Curve, CutAxis)]) -> [Volume; 2] {
    let mut stock = TriDexel::from_solid(solid, step).unwrap();
    let moves: Vec<CutMove> = moves.iter().map(|(c, axis)| CutMove::new(*c, *axis, 0)).collect();
    let body = [ToolBody::new(tool.clone())];
    cut(&mut stock, &body, &moves, &CutOptions::default(), &Silent).unwrap();
    let is_box = matches!(solid, Solid::Box(_));
    let mut triangles = usize::MAX;
    // Finer than by default, and coarser: the bound tells it, and holds.
    let mut left = [Some(0.005 * step), None, Some(0.2 * step)].map(|tolerance| {
        let options = SurfaceOptions { tolerance };
        let surface = surface_with_cuts(&stock, &options, &Silent).unwrap();
        surface.mesh.check_closed().unwrap();
        assert!(surface.mesh.triangles.len() <= triangles);
        triangles = surface.mesh.triangles.len();
        Volume::of_surface(&surface, &options, step, is_box)
    });
    left.sort_by(|a, b| a.bound.total_cmp(&b.bound));
    for other in [left[0], left[2]] {
        assert!((left[1].value - other.value).abs() <= left[1].bound + other.bound, "{left:?}");
    }
    [left[1], Volume::of_lines(&stock)].map(|left| Volume::of_solid(solid).less(left))
}

/// The true volume lies within the bounds. That of the surface is no wider than `share` of it; that of lines knows walls to half a
/// step only.
fn holds(name: &str, step: f64, [surface, lines]: [Volume; 2], exact: f64, share: f64) {
    for (volume, share) in [(surface, share), (lines, 8.0 * share)] {
        let off = (volume.value - exact).abs();
        assert!(off <= volume.bound, "{name} at {step}: {volume:?} but {exact}");
        assert!(volume.bound < share * exact, "{name} at {step}: {volume:?} of {exact}");
    }
}

const STEPS: [f64; 7] = [0.2, 0.31, 0.4, 0.5, 0.66, 0.8, 1.0];

#[test]
fn drilled_holes_from_both_sides() {
    let tip = Profile::cylinder(6.0, 30.0).unwrap();
    for step in STEPS.into_iter().chain([1.2, 1.5, 2.0, 2.4]) {
        let blind = [(way([3.1, 2.3, 5.0], [3.1, 2.3, -7.0]), CutAxis::PlusZ)];
        let exact = PI * 9.0 * 7.0;
        holds("blind hole", step, removed(&Solid::Box(BLOCK), step, &tip, &blind), exact, 0.1 * step);
        let both = [
            (way([3.1, 2.3, 5.0], [3.1, 2.3, -4.0]), CutAxis::PlusZ),
            (way([-9.4, -3.3, -20.0], [-9.4, -3.3, -5.0]), CutAxis::MinusZ),
            (way([12.0, -30.0, -6.2], [12.0, -5.0, -6.2]), CutAxis::MinusY),
        ];
        let exact = PI * 9.0 * (4.0 + 7.0 + 10.0);
        holds("three sides", step, removed(&Solid::Box(BLOCK), step, &tip, &both), exact, 0.1 * step);
    }
}

#[test]
fn a_slot_and_a_slanting_slot() {
    let tool = Profile::cylinder(7.0, 30.0).unwrap();
    for step in STEPS {
        let slot = [(way([-40.0, 1.37, -3.3], [40.0, 1.37, -3.3]), CutAxis::PlusZ)];
        holds("slot", step, removed(&Solid::Box(BLOCK), step, &tool, &slot), 41.0 * 7.0 * 3.3, 0.1 * step);
        // Through the two long sides at 3 in 4: the parallelogram is 29 wide and 7 * 5/4 long.
        let slant = [(way([-30.0, -40.0, -3.3], [30.0, 40.0, -3.3]), CutAxis::PlusZ)];
        let exact = 29.0 * 7.0 * 1.25 * 3.3;
        holds("slanting slot", step, removed(&Solid::Box(BLOCK), step, &tool, &slant), exact, 0.1 * step);
    }
}

#[test]
fn a_raster_of_a_ball() {
    let ball = Profile::bull_nose(6.0, 3.0, 20.0).unwrap();
    let rows: Vec<f64> = (0..12).map(|i| -20.0 + 3.5 * f64::from(i)).collect();
    // The section along Y, summed finely: how deep the nearest row of the ball reaches.
    let n = 200_000;
    let depth = |y: f64| {
        let d = rows.iter().map(|r| (r - y).abs()).fold(f64::INFINITY, f64::min);
        if d < 3.0 { (-1.0 + (9.0 - d * d).sqrt()).max(0.0) } else { 0.0 }
    };
    let section: f64 =
        (0..n).map(|i| depth(-15.0 + 29.0 * (f64::from(i) + 0.5) / f64::from(n)) * 29.0 / f64::from(n)).sum();
    for step in STEPS {
        let moves: Vec<_> =
            rows.iter().map(|y| (way([-40.0, *y, -2.0], [40.0, *y, -2.0]), CutAxis::PlusZ)).collect();
        holds(
            "ball raster",
            step,
            removed(&Solid::Box(BLOCK), step, &ball, &moves),
            41.0 * section,
            0.1 * step,
        );
    }
}

#[test]
fn a_bar_that_is_faced() {
    let bar = Solid::Cylinder { base: DVec3::new(0.0, 0.0, -12.0), radius: 15.0, height: 12.0 };
    let tool = Profile::cylinder(50.0, 30.0).unwrap();
    for step in STEPS {
        let moves = [(way([-60.0, 0.0, -5.0], [60.0, 0.0, -5.0]), CutAxis::PlusZ)];
        holds("faced bar", step, removed(&bar, step, &tool, &moves), PI * 225.0 * 5.0, 0.1 * step);
    }
}

#[test]
fn as_many_digits_as_the_bound_is_worth() {
    let volume = |bound| Volume { value: 1.0, bound };
    assert_eq!(volume(400.0).digits(1000.0, 1), 1);
    assert_eq!(volume(30.0).digits(1000.0, 1), 2);
    assert_eq!(volume(0.0).digits(1000.0, 1), 1);
    assert_eq!(volume(1e9).digits(1000.0, 1), 1);
}
