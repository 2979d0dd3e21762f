//! Lines across the axis that leaning tools are near to, cut when somebody reads them: whoever does so does not see it.

use glam::DVec3;

use super::against_poses::SHAPES;
use super::at_once::{block, chain, is_same};
use super::in_two_ways::compare_lines;
use super::reference::Random;
use crate::base::Silent;
use crate::geom::Line;
use crate::stock::cut::run::{Order, cut_as};
use crate::stock::cut::{CutAxis, CutList, CutMove, CutOptions, MoveEffect, Stance, ToolBody, cut_list};
use crate::stock::sieve::Sieve;
use crate::stock::{Axis, DexelGrid, TriDexel};

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

#[test]
fn lines_are_cut_when_they_are_read_and_not_before() {
    let mut random = Random(91);
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
            let (some, sieve) = (late.sieved(every, &Silent), Sieve::new(late.lattice(), every));
            for axis in Axis::ALL {
                let (a, b) = axis.others();
                let [m, n] = [a, b].map(|of| some.lattice().counts[of.index()]);
                for (i, j) in (0..n).flat_map(|j| (0..m).map(move |i| (i, j))) {
                    let whole = singly.line(axis, sieve.whole_index(a, i), sieve.whole_index(b, j));
                    let line = some.line(axis, i, j);
                    assert!(
                        is_same(line, whole),
                        "{what}, every {every}: {axis:?} {i} {j}: {line:?} {whole:?}"
                    );
                }
            }
        }
        assert!(late.owed.is_some() && is_whole(Axis::Y));
        // Read, which leaves them owed until more is cut.
        compare_lines([&late, &singly], &format!("{what}, read"), is_same);
        let mut read = late;
        read.take_back();
        assert!(read.owed.is_none());
        compare_lines([&read, &singly], &format!("{what}, taken back"), is_same);
    }
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
