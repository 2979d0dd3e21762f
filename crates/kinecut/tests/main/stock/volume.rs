//! Printed volumes: the true one lies within the bound beside them, and the bound is worth printing.

use std::f64::consts::PI;

use glam::DVec3;
use kinecut::base::Silent;
use kinecut::geom::{Aabb, Curve, Line, Profile, Solid};
use kinecut::stock::cut::{CutAxis, CutMove, CutOptions, ToolBody, cut};
use kinecut::stock::surface::{SurfaceOptions, surface_with_cuts};
use kinecut::stock::{TriDexel, Volume};
use kinecut::sweep::ToolMotion;

const BLOCK: Aabb = Aabb { min: DVec3::new(-20.0, -15.0, -12.0), max: DVec3::new(21.0, 14.0, 0.0) };

fn way(a: [f64; 3], b: [f64; 3]) -> Curve {
    Line { start: a.into(), end: b.into() }.into()
}

/// Volumes removed by moves of a cutter with their tool axes: by the surface of what is left, and by its lines; `solid` is the raw stock.
fn removed(solid: &Solid, step: f64, tool: &Profile, moves: &[(Curve, CutAxis)]) -> [Volume; 2] {
    let mut stock = TriDexel::from_solid(solid, step).unwrap();
    let moves: Vec<CutMove> = moves.iter().map(|(c, axis)| CutMove::new(c.clone(), *axis, 0)).collect();
    let body = [ToolBody::new(tool.clone())];
    cut(&mut stock, &body, &moves, &CutOptions::default(), &Silent).unwrap();
    let is_box = matches!(solid, Solid::Box(_));
    let mut triangles = usize::MAX;
    // Finer than by default, and coarser: the bound tells it, and holds.
    let mut left = [Some(0.005 * step), None, Some(0.2 * step)].map(|tolerance| {
        let options = SurfaceOptions { tolerance, ..SurfaceOptions::default() };
        let surface = surface_with_cuts(&stock, &options, &Silent).unwrap();
        surface.mesh.check_closed().unwrap();
        assert!(surface.mesh.triangles.len() <= triangles);
        triangles = surface.mesh.triangles.len();
        Volume::of_surface(&surface, &options, &stock, is_box)
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

/// Side faces of a block skimmed by less than reaches the next line: no line along Z is cut, and all of what is gone lies between.
#[test]
fn faces_skimmed_beside_the_last_lines() {
    let (tool, ball) = (Profile::cylinder(8.0, 30.0).unwrap(), Profile::bull_nose(8.0, 4.0, 30.0).unwrap());
    for step in STEPS {
        let skim = 0.3 * step;
        let down = |x: f64, y: f64| way([x, -40.0, y], [x, 40.0, y]);
        let right = [(down(21.0 + 4.0 - skim, -5.0), CutAxis::PlusZ)];
        holds("right", step, removed(&Solid::Box(BLOCK), step, &tool, &right), skim * 29.0 * 5.0, 0.8);
        let left = [(down(-20.0 - 4.0 + skim, -5.0), CutAxis::PlusZ)];
        holds("left", step, removed(&Solid::Box(BLOCK), step, &tool, &left), skim * 29.0 * 5.0, 0.8);
        let front =
            [(way([-40.0, -15.0 - 4.0 + skim, -7.0], [40.0, -15.0 - 4.0 + skim, -7.0]), CutAxis::PlusZ)];
        holds("front", step, removed(&Solid::Box(BLOCK), step, &tool, &front), skim * 41.0 * 7.0, 0.8);
        // From below, and by a tool that leans: a ball whose centre runs along the middle of the face.
        let below =
            [(way([-40.0, 14.0 + 4.0 - skim, -9.0], [40.0, 14.0 + 4.0 - skim, -9.0]), CutAxis::MinusZ)];
        holds("below", step, removed(&Solid::Box(BLOCK), step, &tool, &below), skim * 41.0 * 3.0, 0.8);
        let axis = DVec3::new(0.6, 0.0, 0.8);
        let line = Line {
            start: DVec3::new(21.0 + 4.0 - skim, -40.0, -6.0) - axis * 4.0,
            end: DVec3::new(21.0 + 4.0 - skim, 40.0, -6.0) - axis * 4.0,
        };
        let motion = ToolMotion::fixed(line.into(), axis).unwrap();
        let mut stock = TriDexel::from_box(BLOCK, step).unwrap();
        let moves = [CutMove::leaning(motion, line, 0)];
        cut(&mut stock, &[ToolBody::new(ball.clone())], &moves, &CutOptions::default(), &Silent).unwrap();
        let section = 16.0 * ((4.0 - skim) / 4.0).acos() - (4.0 - skim) * (8.0 * skim - skim * skim).sqrt();
        let lines = Volume::of_solid(&Solid::Box(BLOCK)).less(Volume::of_lines(&stock));
        assert!(
            (lines.value - section * 29.0).abs() <= lines.bound,
            "{step}: {lines:?} but {}",
            section * 29.0
        );
    }
}

/// Far from the faces nothing is owed for them.
#[test]
fn lines_at_faces_that_no_move_comes_to_count_as_they_are() {
    let tool = Profile::cylinder(6.0, 30.0).unwrap();
    let hole = [(way([3.1, 2.3, 5.0], [3.1, 2.3, -7.0]), CutAxis::PlusZ)];
    let [_, lines] = removed(&Solid::Box(BLOCK), 0.2, &tool, &hole);
    // The wall is known to half a step in both directions, and the round counts for up to 4 / pi of itself.
    assert!(lines.bound < 0.2 * 6.0 * 4.0 * 7.0, "{lines:?}");
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
