//! Lines across the axis that leaning tools are near to, cut when somebody reads them: whoever does so does not see it.

use glam::DVec3;

use super::against_poses::SHAPES;
use super::at_once::{block, chain, is_same};
use super::in_two_ways::compare_lines;
use super::reference::Random;
use crate::base::Silent;
use crate::geom::{Aabb, Line, Profile};
use crate::stock::cut::run::{Order, cut_as};
use crate::stock::cut::{CutAxis, CutList, CutMove, CutOptions, MoveEffect, Stance, ToolBody, cut_list};
use crate::stock::sieve::Sieve;
use crate::stock::{Axis, DexelGrid, Interval, TriDexel, fixed};
use crate::sweep::ToolMotion;

/// A stock that leaning moves have cut, with the lines across owed.
fn owing(round: usize, random: &mut Random) -> (TriDexel, TriDexel) {
    let body = [ToolBody::new(SHAPES[round % SHAPES.len()].profile())];
    let step = [0.35, 0.2][round % 2];
    let list = CutList::new(&body, chain(random, 160, 0.5, 0), &CutOptions::default(), step).unwrap();
    let whole = TriDexel::from_box(block(), step).unwrap();
    let [mut late, mut singly] = [whole.clone(), whole];
    cut_list(&mut late, &list, 0..list.moves().len(), &Silent).unwrap();
    cut_as(&mut singly, &list, 0..list.moves().len(), Order::OneByOne, &Silent).unwrap();
    (late, singly)
}

/// Parts of intervals between two coordinates.
fn between(line: &[Interval], [low, high]: [i32; 2]) -> Vec<Interval> {
    let clip = |i: &Interval| {
        let [mut lo, mut hi] = [i.lo, i.hi];
        (lo.at, hi.at) = (lo.at.max(low), hi.at.min(high));
        Interval { lo, hi }
    };
    line.iter().map(clip).filter(|i| i.lo.at < i.hi.at).collect()
}

/// Some lines of a stock: those along Z are the same, and those across between points at which lines along Z are unlike; elsewhere they
/// have material as those do. Tells how many stretches were compared.
fn compare_sieved(some: &TriDexel, whole: &TriDexel, every: u32, what: &str) -> usize {
    let (lattice, sieve) = (*some.lattice(), Sieve::new(whole.lattice(), every));
    let index = |axis: Axis, i: u32| sieve.whole_index(axis, i);
    let has = |line: &[Interval], at: i32| line.iter().any(|i| i.lo.at <= at && at < i.hi.at);
    let mut compared = 0;
    for axis in Axis::ALL {
        let (a, b) = axis.others();
        let [m, n, count] = [a, b, axis].map(|of| lattice.counts[of.index()]);
        for (i, j) in (0..n).flat_map(|j| (0..m).map(move |i| (i, j))) {
            let whole_line = whole.line(axis, index(a, i), index(b, j));
            let line = some.line(axis, i, j);
            let what = format!("{what}, every {every}: {axis:?} {i} {j}: {line:?} {whole_line:?}");
            if axis == Axis::Z {
                assert!(is_same(line, whole_line), "{what}");
                continue;
            }
            let place = |k: u32| fixed(lattice.coordinate(axis, k));
            let filled: Vec<bool> = (0..count)
                .map(|k| {
                    let mut at = [0; 3];
                    (at[axis.index()], at[a.index()], at[b.index()]) = (k, i, j);
                    has(some.line(Axis::Z, at[0], at[1]), fixed(lattice.coordinate(Axis::Z, at[2])))
                })
                .collect();
            for k in 0..count as usize {
                let window = [k as u32, k as u32 + 1].map(place);
                if filled.get(k + 1).is_some_and(|next| *next != filled[k]) {
                    compared += 1;
                    let [own, all] = [line, whole_line].map(|line| between(line, window));
                    assert!(is_same(&own, &all), "{what}: {window:?}");
                }
                if (k.saturating_sub(1)..=(k + 1).min(filled.len() - 1)).all(|n| filled[n] == filled[k]) {
                    assert_eq!(has(line, place(k as u32)), filled[k], "{what}: {k}");
                }
            }
        }
    }
    compared
}

#[test]
fn lines_are_cut_when_they_are_read_and_not_before() {
    let mut random = Random(91);
    let mut compared = 0;
    for round in 0..kinecut_cases::cases(7, 140) as usize {
        let (late, singly) = owing(round, &mut random);
        let what = format!("round {round}");
        assert!(late.owed.is_some(), "{what}");
        let is_whole = |axis: Axis| late.grids[axis.index()].tiles.iter().all(|tile| tile.is_alike());
        assert!(is_whole(Axis::X) && is_whole(Axis::Y) && !is_whole(Axis::Z), "{what}");
        // The volume needs the lines along the axis alone.
        assert!((late.volume() / singly.volume() - 1.0).abs() < 1e-6);
        assert!(is_whole(Axis::X));
        let mut settled = late.clone();
        settled.settle(&Silent);
        assert!(settled.owed.is_none());
        compare_lines([&settled, &singly], &format!("{what}, settled"), is_same);
        // Some of them, without the others.
        for every in [2, 3] {
            compared += compare_sieved(&late.sieved(every, &Silent), &singly, every, &what);
        }
        assert!(late.owed.is_some() && is_whole(Axis::Y));
        // Read, which leaves them owed until more is cut.
        compare_lines([&late, &singly], &format!("{what}, read"), is_same);
        let mut read = late;
        read.take_back();
        assert!(read.owed.is_none());
        compare_lines([&read, &singly], &format!("{what}, taken back"), is_same);
    }
    assert!(compared > 2000, "{compared}");
}

/// Moves of all kinds one after another: leaning ones near Z and near X, upright ones, ones that are looked at in order.
#[test]
fn what_comes_after_finds_the_lines_as_they_are() {
    let mut random = Random(93);
    let mut were_owed = 0;
    for round in 0..kinecut_cases::cases(6, 240) as usize {
        let body = [ToolBody::new(SHAPES[(round + 1) % SHAPES.len()].profile())];
        let step = [0.35, 0.25][round % 2];
        let mut moves = chain(&mut random, 130, 0.5, 0);
        for i in (0..moves.len()).filter(|i| i % 61 == 60 && round % 3 > 0) {
            moves[i].watch = true;
            moves[i].removes = round % 3 == 1;
        }
        let place = |random: &mut Random| random.plane(10.0).extend(random.within(-4.0, 2.0));
        let far = DVec3::Z * if round % 4 == 3 { 40.0 } else { 0.0 };
        let upright = |random: &mut Random| Line { start: place(random) + far, end: place(random) + far };
        moves.extend((0..3).map(|_| CutMove::new(upright(&mut random), CutAxis::PlusZ, 0)));
        moves.extend(chain(&mut random, 130, [0.4, 2.9][round / 2 % 2], 0));
        let list = CutList::new(&body, moves, &CutOptions::default(), step).unwrap();
        let whole = TriDexel::from_box(block(), step).unwrap();
        let [mut runs, mut singly] = [whole.clone(), whole];
        let mut from = 0;
        let count = list.moves().len();
        while from < count {
            // In pieces, as a simulation that is asked something in between.
            let to = count.min(from + 60 + random.within(0.0, 150.0) as usize);
            let runs_effects = cut_list(&mut runs, &list, from..to, &Silent).unwrap();
            let exact = cut_as(&mut singly, &list, from..to, Order::OneByOne, &Silent).unwrap();
            were_owed += u32::from(runs.owed.is_some());
            for (i, (one, other)) in runs_effects.iter().zip(&exact).enumerate() {
                let is_looked_at = list.moves()[from + i].watch;
                let leans = matches!(list.moves()[from + i].stance, Stance::Leaning(_));
                if is_looked_at && leans {
                    let met = |e: &MoveEffect| (e.first_contact.is_some(), e.deepest, e.widest);
                    let ((a, b, c), (d, e, f)) = (met(one), met(other));
                    assert!(
                        a == d && (b - e).abs() < 1e-4 && (c - f).abs() < 1e-4,
                        "{round} {i}: {one:?} {other:?}"
                    );
                }
            }
            if round % 5 == 4 {
                // Somebody reads a line.
                assert!(runs.line(Axis::Y, 3, 3).len() < 100);
            }
            from = to;
        }
        compare_lines([&runs, &singly], &format!("round {round}"), is_same);
    }
    assert!(were_owed > 5, "{were_owed}");
}

/// Moves that are apart, so that none begins where the one before it ended: what each removes is measured from its first pose on.
#[test]
fn amounts_of_moves_that_are_apart_are_those_of_cutting_in_order() {
    let body = [ToolBody::new(Profile::cylinder(4.0, 10.0).unwrap())];
    let axis = DVec3::new(0.3, 0.1, 1.0);
    let place = |i: u32| DVec3::new(f64::from(i % 20) * 8.0 + 4.13, f64::from(i / 20) * 7.0 + 4.57, -2.0);
    let moves: Vec<CutMove> = (0..300)
        .map(|i| {
            let line = Line { start: place(i), end: place(i) + DVec3::X * 2.0 };
            CutMove::leaning(ToolMotion::fixed(line.into(), axis).unwrap(), line, 0)
        })
        .collect();
    let bounds = Aabb { min: DVec3::new(0.0, 0.0, -6.0), max: DVec3::new(165.0, 110.0, 0.0) };
    let step = 0.25;
    let list = CutList::new(&body, moves, &CutOptions::default(), step).unwrap();
    let removed = |order: Order| -> f64 {
        let mut stock = TriDexel::from_box(bounds, step).unwrap();
        cut_as(&mut stock, &list, 0..300, order, &Silent)
            .unwrap()
            .iter()
            .map(|e: &MoveEffect| e.removed)
            .sum()
    };
    let (at_once, in_order) = (removed(Order::InRuns), removed(Order::OneByOne));
    assert!((at_once / in_order - 1.0).abs() < 0.02, "{at_once} {in_order}");
}
