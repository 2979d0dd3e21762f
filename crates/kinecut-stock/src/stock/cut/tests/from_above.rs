//! Moves cut in long runs from above leave the lines that they leave when each is cut after the other.

use glam::DVec3;

use super::against_poses::SHAPES;
use super::in_two_ways;
use super::reference::Random;
use crate::geom::{Aabb, Arc, Curve, Line, Profile};
use crate::stock::TriDexel;
use crate::stock::cut::{CutAxis, CutMove, MoveEffect, ToolBody};
use crate::tool::DrillPoint;

/// Cuts a stock in both ways and compares all lines, the ends with what they carry; returns the effects of both.
fn compare(stock: &TriDexel, bodies: &[ToolBody], moves: &[CutMove], what: &str) -> [Vec<MoveEffect>; 2] {
    in_two_ways::compare(stock, bodies, moves, what, |a, b| a == b)
}

/// A block that moves of any axis cut in.
pub(super) fn block() -> Aabb {
    Aabb { min: DVec3::new(-9.0, -8.0, -7.0), max: DVec3::new(9.3, 8.1, 6.2) }
}

/// A chain of moves of a tool along `axis` that stays near the top of the block: lines, plunges, arcs and helices.
pub(super) fn chain(random: &mut Random, axis: CutAxis, count: usize, body: u32) -> Vec<CutMove> {
    let up = axis.vector();
    let side = DVec3::new(up.z, up.x, up.y);
    let other = up.cross(side);
    let bounds = block();
    let top = if up.element_sum() > 0.0 { bounds.max.dot(up) } else { bounds.min.dot(up) };
    let mut place = |low: f64, high: f64| {
        side * random.within(-11.0, 11.0)
            + other * random.within(-11.0, 11.0)
            + up * (top + random.within(low, high))
    };
    let mut at = place(-4.0, 2.0);
    let mut moves = Vec::new();
    for i in 0..count {
        let to = place(-6.0, 1.0);
        let level = to - up * (to - at).dot(up);
        let curve: Curve = match i % 6 {
            0 => Line { start: at, end: to }.into(),
            1 => Line { start: at, end: level }.into(),
            2 => Line { start: at, end: at + up * ((to - at).dot(up)) }.into(),
            3 | 4 => {
                let centre = at + (level - at) * 0.5;
                let (sweep, rise) =
                    (if i % 2 == 0 { 4.5 } else { -2.5 }, if i % 4 == 3 { 0.0 } else { -0.7 });
                match Arc::new(at, centre, up, sweep, rise) {
                    Ok(arc) => arc.into(),
                    Err(_) => continue,
                }
            }
            _ => Line { start: at, end: at + (to - at) * 0.03 }.into(),
        };
        at = curve.end();
        moves.push(CutMove::new(curve, axis, body));
    }
    moves
}

fn same_effects([fast, slow]: &[Vec<MoveEffect>; 2], step: f64, what: &str) {
    for (i, (fast, slow)) in fast.iter().zip(slow).enumerate() {
        // A rounding of each line.
        let (close, lines) = (1e-5 * step * step, 60.0 * 60.0 / (step * step));
        assert!((fast.removed - slow.removed).abs() < close * lines, "{what}, move {i}: {fast:?} {slow:?}");
        // One by one an arc that comes by twice is counted twice.
        assert!(fast.deepest > slow.deepest - 2.1e-5, "{what}, move {i}: {fast:?} {slow:?}");
        assert_eq!(fast.first_contact.is_some(), slow.first_contact.is_some(), "{what}, move {i}");
        assert_eq!((fast.shank(), fast.holder()), (slow.shank(), slow.holder()), "{what}, move {i}");
        // A tool that goes where it has cut is known to clip no edge; line by line that may be a doubt.
        let edges = (fast.edge(), slow.edge());
        assert!(edges.0.is_none() || edges.0 == edges.1, "{what}, move {i}: {fast:?} {slow:?}");
    }
}

/// Ways along lines, through lines and through the middle between lines, with plunges: what random moves never meet.
#[test]
fn rasters_along_the_lattice() {
    let block = Aabb { min: DVec3::new(-8.0, -8.0, -6.0), max: DVec3::new(8.0, 8.0, 0.0) };
    for (shape, step) in SHAPES.into_iter().flat_map(|shape| [(shape, 0.5), (shape, 0.25)]) {
        let stock = TriDexel::from_box(block, step).unwrap();
        let bodies = [ToolBody::new(shape.profile())];
        // Rows on lines, and between them.
        for off in [0.0, 0.25, 0.125] {
            let at = |x: f64, y: f64, z: f64| DVec3::new(x + off, y + off, z);
            let mut moves = Vec::new();
            for row in 0..12 {
                let x = -5.5 + f64::from(row);
                let stations: Vec<DVec3> = (0..=24)
                    .map(|k| at(x, -6.0 + 0.5 * f64::from(k), -1.5 - 0.25 * f64::from(k % 3)))
                    .collect();
                let plunge = [at(x, -6.0, 2.0), stations[0]];
                for pair in std::iter::once(&plunge[..]).chain(stations.windows(2)) {
                    moves.push(CutMove::new(Line { start: pair[0], end: pair[1] }, CutAxis::PlusZ, 0));
                }
            }
            compare(&stock, &bodies, &moves, &format!("{shape:?}, step {step}, off {off}"));
        }
    }
}

#[test]
fn random_moves_of_all_tools_along_all_axes_leave_the_same_lines() {
    let mut random = Random(7);
    for round in 0..kinecut_cases::cases(42, 2_000) {
        let shape = SHAPES[round as usize % SHAPES.len()];
        let step = [0.21, 0.4, 0.73][round as usize % 3];
        let axis = CutAxis::ALL[round as usize % 6];
        let stock = TriDexel::from_box(block(), step).unwrap();
        // Long enough to reach out of all that it cuts.
        let tool = ToolBody::new(shape.profile());
        let moves = chain(&mut random, axis, 60, 0);
        let what = format!("round {round}, {shape:?} along {axis:?} at {step}");
        let effects = compare(&stock, &[tool], &moves, &what);
        same_effects(&effects, step, &what);
    }
}
#[test]
fn tools_with_shank_and_holder_rapids_and_undercuts_leave_the_same_lines() {
    let neck = vec![(Profile::cylinder(3.0, 10.0).unwrap(), 1.5)];
    let t_slot = ToolBody { shank: neck, ..ToolBody::new(Profile::cylinder(8.0, 1.5).unwrap()) };
    let ring = DrillPoint::Annular { core: 2.0 }.edge(5.0).unwrap();
    let shank = vec![(Profile::cylinder(4.0, 10.0).unwrap(), 4.0)];
    let holder = vec![(Profile::cylinder(9.0, 12.0).unwrap(), 8.0)];
    let bodies = [
        ToolBody { shank, holder, ..ToolBody::new(Profile::bull_nose(5.0, 1.0, 4.0).unwrap()) },
        t_slot,
        ToolBody { edge: Some(ring), ..ToolBody::new(Profile::cylinder(5.0, 20.0).unwrap()) },
        ToolBody::new(Profile::bull_nose(6.0, 3.0, 20.0).unwrap()),
        // Thinner than the lines are apart.
        ToolBody::new(Profile::cylinder(0.2, 20.0).unwrap()),
    ];
    let mut random = Random(11);
    for round in 0..kinecut_cases::cases(36, 1_500) {
        let step = [0.3, 0.4, 0.73][round as usize % 3];
        let axis = CutAxis::ALL[round as usize % 6];
        let stock = if round % 2 == 0 {
            TriDexel::from_box(block(), step).unwrap()
        } else {
            TriDexel::from_cylinder(DVec3::new(0.0, 0.0, -7.0), 8.3, 13.1, step).unwrap()
        };
        let mut moves = Vec::new();
        for _ in 0..6 {
            let body = random.within(0.0, bodies.len() as f64) as u32;
            let mut some = chain(&mut random, axis, 12, body);
            for m in &mut some {
                m.watch = random.unit() < 0.1;
                m.removes = random.unit() < 0.9 || !m.watch;
            }
            moves.append(&mut some);
        }
        let what = format!("round {round} along {axis:?} at {step}");
        let effects = compare(&stock, &bodies, &moves, &what);
        same_effects(&effects, step, &what);
    }
}

/// Rows cut to and fro on two levels, each begun by a rapid down beside the wall of the row before: many looks at places of a stock
/// that is cut in between, in patches that meet at their borders.
#[test]
fn rapids_down_beside_walls_find_the_lines_as_they_are() {
    let block = Aabb { min: DVec3::new(-8.0, -6.0, -5.0), max: DVec3::new(8.0, 6.0, 0.0) };
    let mut random = Random(21);
    for round in 0..kinecut_cases::cases(6, 200) {
        let shape = SHAPES[round as usize % SHAPES.len()];
        let step = [0.1, 0.13][round as usize % 2];
        let stock = TriDexel::from_box(block, step).unwrap();
        let tool = ToolBody::new(shape.profile());
        let mut moves = Vec::new();
        let mut at = DVec3::new(0.0, 0.0, 4.0);
        let mut go = |to: DVec3, rapid: bool| {
            let m = CutMove::new(Line { start: at, end: to }, CutAxis::PlusZ, 0);
            moves.push(if rapid { m.watched() } else { m });
            at = to;
        };
        for level in [-1.2, -2.3] {
            for row in 0..7 {
                let y = -5.0 + 1.6 * f64::from(row) + random.within(-0.3, 0.3);
                let (a, b) = (random.within(-7.0, -4.0), random.within(-2.0, 6.0));
                let depth = |random: &mut Random| level + random.within(-0.4, 0.4);
                // Some rapids end in material.
                let down = level + random.within(-0.2, 1.3);
                go(DVec3::new(a, y, 1.0), true);
                go(DVec3::new(a, y, down), true);
                go(DVec3::new(a, y, depth(&mut random)), false);
                go(DVec3::new(0.5 * (a + b), y + 0.2, depth(&mut random)), false);
                go(DVec3::new(b, y, depth(&mut random)), false);
                // Along what was cut, and up.
                go(DVec3::new(0.6 * b + 0.4 * a, y, level + 0.5), true);
                go(DVec3::new(0.6 * b + 0.4 * a, y, 1.0), true);
            }
        }
        let what = format!("round {round}, {shape:?} at {step}");
        let effects = compare(&stock, &[tool], &moves, &what);
        same_effects(&effects, step, &what);
    }
}
