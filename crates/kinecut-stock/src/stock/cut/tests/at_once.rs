//! Runs of leaning and turning moves cut at once leave the lines that they leave when each is cut after the other.

use std::f64::consts::PI;

use glam::DVec3;

use super::against_poses::SHAPES;
use super::in_two_ways::{compare, compare_lines};
use super::reference::Random;
use crate::base::Silent;
use crate::geom::{Aabb, Arc, Curve, Line, Profile};
use crate::stock::cut::{BodyContact, CutMove, CutOptions, MoveEffect, ToolBody};
use crate::stock::{Interval, TriDexel};
use crate::sweep::ToolMotion;

/// Most that an end may be off [fixed steps]: its rounding, and the border of a cell that it lies on.
const CLOSE: i32 = 2;

/// True if two lines are the same but for rounding.
pub(super) fn is_same(a: &[Interval], b: &[Interval]) -> bool {
    let ends = |line: &[Interval]| -> Vec<i32> {
        // What is no thicker than the rounding may be there or not, and so may a gap.
        let mut ends: Vec<i32> = Vec::new();
        for at in line.iter().flat_map(|i| [i.lo.at, i.hi.at]) {
            if ends.last().is_some_and(|last| at - last <= 2 * CLOSE) {
                ends.pop();
            } else {
                ends.push(at);
            }
        }
        ends
    };
    let (a, b) = (ends(a), ends(b));
    a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| (a - b).abs() <= CLOSE)
}

pub(super) fn block() -> Aabb {
    Aabb { min: DVec3::new(-9.0, -8.0, -7.0), max: DVec3::new(9.3, 8.1, 0.2) }
}

/// A direction that leans by up to `most` from Z [rad].
fn leaning(random: &mut Random, most: f64) -> DVec3 {
    let (lean, round) = (random.within(0.05, most), random.within(0.0, 2.0 * PI));
    DVec3::new(lean.sin() * round.cos(), lean.sin() * round.sin(), lean.cos())
}

/// A chain of moves that lean or turn, through the block and out of it.
pub(super) fn chain(random: &mut Random, count: usize, most: f64, body: u32) -> Vec<CutMove> {
    let place = |random: &mut Random| random.plane(10.0).extend(random.within(-6.0, 2.0));
    let (mut at, mut axis) = (place(random), leaning(random, most));
    let mut moves = Vec::new();
    for i in 0..count {
        let (to, toward) = (place(random), leaning(random, most));
        let to = if i % 3 == 0 { to } else { at + (to - at) * 0.1 };
        let line = Curve::from(Line { start: at, end: to });
        let (motion, curve) = match i % 4 {
            0 => (ToolMotion::fixed(line.clone(), axis), line),
            1 => {
                let arc = Arc::new(at, (at + to) * 0.5, leaning(random, 1.0), random.within(-3.0, 3.0), 0.5);
                let Ok(arc) = arc else { continue };
                (ToolMotion::fixed(arc.into(), axis), arc.into())
            }
            _ => {
                let near = (axis + (toward - axis) * random.within(0.02, 0.4)).normalize_or(axis);
                let motion = ToolMotion::between(line.clone(), axis, near);
                axis = near;
                (motion, line)
            }
        };
        at = curve.end();
        moves.push(CutMove::leaning(motion.unwrap(), curve, body));
    }
    moves
}

/// What the moves do, as each way of cutting tells it.
fn compare_effects([fast, slow]: &[Vec<MoveEffect>; 2], what: &str) {
    let removed = |effects: &[MoveEffect]| effects.iter().map(|e| e.removed).sum::<f64>();
    let (a, b) = (removed(fast), removed(slow));
    // A line stands for a square of up to a quarter of the radius.
    assert!((a / b - 1.0).abs() < 0.04, "{what}: {a} {b}");
    for (i, (a, b)) in fast.iter().zip(slow).enumerate() {
        assert_eq!((a.path_error, a.as_filled), (b.path_error, b.as_filled));
        // Measured on some of the lines only: three of them, each up to 9 mm of a square of 0.75 mm, may be too many or too few.
        let most = a.removed.max(b.removed);
        assert!((a.removed - b.removed).abs() < 0.15 * most + 15.0, "{what}: move {i}: {a:?} {b:?}");
        assert!(most < 15.0 || a.first_contact.is_some() && a.deepest > 0.0, "{what}: move {i}: {a:?}");
        for (a, b) in [(a.shank(), b.shank()), (a.holder(), b.holder())] {
            let depth = |c: Option<BodyContact>| c.map_or([-1.0; 2], |c| [c.depth, c.width]);
            let off = depth(a).into_iter().zip(depth(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-4, "{what}: move {i}: {a:?} {b:?}");
        }
    }
}

#[test]
fn chains_of_all_tools() {
    let mut random = Random(71);
    let mut sampled = 0;
    let rounds = kinecut_cases::cases(7, 700) as usize;
    for round in 0..rounds {
        let shape = SHAPES[round % SHAPES.len()];
        let body = ToolBody::new(shape.profile());
        let step = [0.35, 0.2, 0.11][round % 3];
        let stock = TriDexel::from_box(block(), step).unwrap();
        let moves = chain(&mut random, 160, [0.5, 1.2, 2.9][round / 3 % 3], 0);
        let what = format!("round {round}: {shape:?}, step {step}");
        let effects = compare(&stock, &[body], &moves, &what, is_same);
        compare_effects(&effects, &what);
        sampled += usize::from(effects[0] != effects[1]);
    }
    // They were cut at once.
    assert!(10 * sampled > 9 * rounds, "{sampled}");
}

/// Ways through the very middle of cells, and tools as deep all around there: what random moves never meet.
#[test]
fn rasters_along_the_lattice() {
    let block = Aabb { min: DVec3::new(-8.0, -8.0, -6.0), max: DVec3::new(8.0, 8.0, 0.0) };
    for (shape, step) in SHAPES.into_iter().flat_map(|shape| [(shape, 0.5), (shape, 0.25)]) {
        let stock = TriDexel::from_box(block, step).unwrap();
        // No flat face lies in a line.
        for axis in [DVec3::new(0.47, 0.0, 1.0), DVec3::new(0.0, -0.83, 1.0)] {
            let mut moves = Vec::new();
            for row in 0..12 {
                for k in 0..24 {
                    let x = -5.5 + f64::from(row);
                    let [from, to] = [k, k + 1].map(|k| DVec3::new(x, -6.0 + 0.5 * f64::from(k), -2.0));
                    let line = Line { start: from, end: to };
                    moves.push(CutMove::leaning(ToolMotion::fixed(line.into(), axis).unwrap(), line, 0));
                }
            }
            let what = format!("{shape:?}, step {step}, axis {axis}");
            compare(&stock, &[ToolBody::new(shape.profile())], &moves, &what, is_same);
        }
    }
}

#[test]
fn the_lines_are_the_same_with_any_number_of_threads() {
    let mut random = Random(79);
    let body = ToolBody::new(SHAPES[2].profile());
    let moves = chain(&mut random, 160, 1.0, 0);
    let cut_by = |threads: usize| {
        let mut stock = TriDexel::from_box(block(), 0.2).unwrap();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let bodies = [body.clone()];
        let cut = || crate::stock::cut::cut(&mut stock, &bodies, &moves, &CutOptions::default(), &Silent);
        let effects = pool.install(cut).unwrap();
        (stock, effects)
    };
    let (one, effects) = cut_by(1);
    for threads in [2, 5] {
        let (many, same) = cut_by(threads);
        assert_eq!(effects, same);
        compare_lines([&one, &many], &format!("{threads} threads"), |a, b| a == b);
    }
}

#[test]
fn what_depends_on_the_moment_is_looked_at_in_order() {
    let mut random = Random(73);
    let mut touched = 0;
    for round in 0..kinecut_cases::cases(6, 400) as usize {
        let shapes = [SHAPES[round % SHAPES.len()], SHAPES[(round + 3) % SHAPES.len()]];
        let bodies = shapes.map(|shape| ToolBody {
            shank: vec![(Profile::cylinder(7.0, 8.0).unwrap(), shape.profile().top())],
            holder: vec![(Profile::cylinder(16.0, 10.0).unwrap(), shape.profile().top() + 8.0)],
            ..ToolBody::new(shape.profile())
        });
        let tall = Aabb { max: DVec3::new(9.3, 8.1, 2.8), ..block() };
        let stock = TriDexel::from_box(tall, [0.35, 0.25][round % 2]).unwrap();
        let most = [0.4, 1.0][round / 2 % 2];
        let mut moves = chain(&mut random, 130, most, 0);
        moves.extend(chain(&mut random, 130, most, 1));
        for i in (0..moves.len()).filter(|i| i % 97 == 60) {
            moves[i].watch = true;
            moves[i].removes = i % 2 == 0;
        }
        let what = format!("round {round}");
        let effects = compare(&stock, &bodies, &moves, &what, is_same);
        compare_effects(&effects, &what);
        touched += effects[1].iter().filter(|e| e.shank().is_some() || e.holder().is_some()).count();
    }
    assert!(touched > 0);
}
