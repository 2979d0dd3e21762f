//! A stock cut in runs, at once, and move after move: they are compared line by line.

use crate::base::Silent;
use crate::stock::cut::run::{Order, cut_as};
use crate::stock::cut::{CutList, CutMove, CutOptions, MoveEffect, ToolBody};
use crate::stock::{Axis, DexelGrid, Interval, TriDexel};

/// Cuts a stock in runs, long or however short, and move after move, and compares all lines; returns the effects of the runs as they
/// are used, and of the moves.
pub(super) fn compare(
    stock: &TriDexel,
    bodies: &[ToolBody],
    moves: &[CutMove],
    what: &str,
    is_same: fn(&[Interval], &[Interval]) -> bool,
) -> [Vec<MoveEffect>; 2] {
    let step = stock.lattice().step;
    let list = CutList::new(bodies, moves.to_vec(), &CutOptions::default(), step).unwrap();
    let [runs, at_once, singly] = [Order::InRuns, Order::AtOnce, Order::OneByOne].map(|order| {
        let mut stock = stock.clone();
        let effects = cut_as(&mut stock, &list, 0..moves.len(), order, &Silent).unwrap();
        (stock, effects)
    });
    compare_lines([&runs.0, &singly.0], what, is_same);
    compare_lines([&at_once.0, &singly.0], &format!("{what}, at once"), is_same);
    for (i, (some, exact)) in at_once.1.iter().zip(&singly.1).enumerate() {
        // A move that leaves an end, or takes something from a line that is looked at, has met something.
        assert!(
            some.first_contact.is_none() || exact.first_contact.is_some() || exact.removed > 0.0,
            "{what}, move {i}: {some:?} {exact:?} {:?}",
            moves[i].curve
        );
        assert_eq!(
            (some.shank(), some.holder()),
            (exact.shank(), exact.holder()),
            "{what}, at once, move {i}"
        );
    }
    [runs.1, singly.1]
}

/// Compares all lines of two stocks over one lattice.
pub(super) fn compare_lines(
    stocks: [&TriDexel; 2],
    what: &str,
    is_same: fn(&[Interval], &[Interval]) -> bool,
) {
    let lattice = *stocks[0].lattice();
    for along in Axis::ALL {
        let (a, b) = along.others();
        for j in 0..lattice.counts[b.index()] {
            for i in 0..lattice.counts[a.index()] {
                let [one, other] = stocks.map(|stock| stock.line(along, i, j));
                assert!(is_same(one, other), "{what}: line {i} {j} along {along:?}:\n{one:?}\n{other:?}");
            }
        }
    }
}
