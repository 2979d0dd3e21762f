//! A stock cut in runs, and move after move: the two are compared line by line.

use crate::base::Silent;
use crate::stock::cut::run::{Order, cut_as};
use crate::stock::cut::{CutList, CutMove, CutOptions, MoveEffect, ToolBody};
use crate::stock::{Axis, DexelGrid, Interval, TriDexel};

/// Cuts a stock in runs and move after move, and compares all lines; returns the effects of both.
pub(super) fn compare(
    stock: &TriDexel,
    bodies: &[ToolBody],
    moves: &[CutMove],
    what: &str,
    is_same: fn(&[Interval], &[Interval]) -> bool,
) -> [Vec<MoveEffect>; 2] {
    let step = stock.lattice().step;
    let list = CutList::new(bodies, moves.to_vec(), &CutOptions::default(), step).unwrap();
    let cut = [Order::InRuns, Order::OneByOne].map(|order| {
        let mut stock = stock.clone();
        let effects = cut_as(&mut stock, &list, 0..moves.len(), order, &Silent).unwrap();
        (stock, effects)
    });
    compare_lines([&cut[0].0, &cut[1].0], what, is_same);
    cut.map(|(_, effects)| effects)
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
