//! Some lines of a stock, cut without the others, are those of the stock.

use super::against_poses::SHAPES;
use super::from_above::{block, chain};
use super::reference::Random;
use crate::base::Silent;
use crate::stock::cut::{CutAxis, CutList, CutOptions, ToolBody, cut_list};
use crate::stock::sieve::Sieve;
use crate::stock::{Axis, DexelGrid, Interval, TriDexel};

/// True if lines are the same but for the rounding of where they run.
fn is_same(some: &[Interval], all: &[Interval]) -> bool {
    let ends = |line: &[Interval]| line.iter().flat_map(|i| [i.lo, i.hi]).collect::<Vec<_>>();
    let (some, all) = (ends(some), ends(all));
    some.len() == all.len()
        && some.iter().zip(&all).all(|(a, b)| a.at.abs_diff(b.at) <= 1 && (a.cut == b.cut || a.at != b.at))
}

fn compare(stock: &TriDexel, settled: &TriDexel, every: u32, what: &str) {
    let sieve = Sieve::new(stock.lattice(), every);
    let some = stock.sieved(every, &Silent);
    let counts = some.lattice().counts;
    for axis in Axis::ALL {
        let (a, b) = axis.others();
        for j in 0..counts[b.index()] {
            for i in 0..counts[a.index()] {
                let whole = settled.line(axis, sieve.whole_index(a, i), sieve.whole_index(b, j));
                let line = some.line(axis, i, j);
                assert!(is_same(line, whole), "{what}, every {every}: {axis:?} {i} {j}: {line:?} {whole:?}");
            }
        }
    }
}

#[test]
fn random_moves_of_all_tools_along_all_axes() {
    let mut random = Random(31);
    for round in 0..kinecut_cases::cases(12, 300) {
        let axis = CutAxis::ALL[round as usize % 6];
        let body = [ToolBody::new(SHAPES[round as usize % SHAPES.len()].profile())];
        let (first, then) = (chain(&mut random, axis, 60, 0), chain(&mut random, axis, 60, 0));
        let step = [0.4, 0.23][round as usize / 6 % 2];
        let list = |moves| CutList::new(&body, moves, &CutOptions::default(), step).unwrap();
        let (first, then) = (list(first), list(then));
        let mut stock = TriDexel::from_box(block(), step).unwrap();
        cut_list(&mut stock, &first, 0..first.moves().len(), &Silent).unwrap();
        // Some have been cut before, or have been read.
        if round % 3 == 1 {
            stock.settle(&Silent);
        }
        cut_list(&mut stock, &then, 0..then.moves().len(), &Silent).unwrap();
        if round % 3 == 2 {
            assert!(stock.line(axis.along(), 3, 3).len() < 100);
        }
        let mut settled = stock.clone();
        settled.settle(&Silent);
        for every in [1, 2, 3, 7, 1000] {
            compare(&stock, &settled, every, &format!("round {round}"));
        }
    }
}

#[test]
fn the_lines_that_are_left_out_are_not_cut() {
    let body = [ToolBody::new(SHAPES[1].profile())];
    let moves = chain(&mut Random(32), CutAxis::PlusZ, 60, 0);
    let list = CutList::new(&body, moves, &CutOptions::default(), 0.4).unwrap();
    let mut stock = TriDexel::from_box(block(), 0.4).unwrap();
    cut_list(&mut stock, &list, 0..list.moves().len(), &Silent).unwrap();
    let before = stock.memory_held();
    assert!(stock.sieved(4, &Silent).memory_held() < before + 1_000_000);
    assert_eq!(stock.memory_held(), before);
}
