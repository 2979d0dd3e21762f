//! Lines across the tool axis that are cut late: whoever reads them does not see it.

use glam::DVec3;
use rayon::prelude::*;

use super::against_poses::SHAPES;
use super::in_two_ways::compare_lines;
use super::reference::Random;
use crate::base::{Progress, Silent};
use crate::geom::{Aabb, Line};
use crate::stock::cut::{CutAxis, CutList, CutMove, CutOptions, ToolBody, cut_list};
use crate::stock::{Axis, DexelGrid, Interval, TriDexel, Volume, unfixed};

const BLOCK: Aabb = Aabb { min: DVec3::new(-9.0, -8.0, -7.0), max: DVec3::new(9.3, 8.1, 6.2) };

/// A chain of lines near the top of the block.
fn chain(random: &mut Random, axis: CutAxis, count: usize) -> Vec<CutMove> {
    let up = axis.vector();
    let top = if up.element_sum() > 0.0 { BLOCK.max.dot(up) } else { BLOCK.min.dot(up) };
    let mut place = || {
        let across = DVec3::new(random.within(-9.0, 9.0), random.within(-9.0, 9.0), random.within(-9.0, 9.0));
        across - up * across.dot(up) + up * (top + random.within(-4.0, 1.0))
    };
    let mut at = place();
    let line = |end: DVec3| Line { start: std::mem::replace(&mut at, end), end };
    (0..count)
        .map(|_| place())
        .collect::<Vec<_>>()
        .into_iter()
        .map(line)
        .map(|l| CutMove::new(l, axis, 0))
        .collect()
}

#[test]
fn lines_are_cut_when_they_are_read_and_not_before() {
    let mut random = Random(5);
    let body = [ToolBody::new(SHAPES[1].profile())];
    for axis in CutAxis::ALL {
        let list = CutList::new(&body, chain(&mut random, axis, 40), &CutOptions::default(), 0.4).unwrap();
        let mut late = TriDexel::from_box(BLOCK, 0.4).unwrap();
        cut_list(&mut late, &list, 0..40, &Silent).unwrap();
        for across in Axis::ALL.into_iter().filter(|across| *across != axis.along()) {
            let grid = &late.grids[across.index()];
            assert!(
                grid.tiles.iter().all(|tile| tile.is_alike()),
                "{axis:?}: lines along {across:?} were cut"
            );
        }
        let mut settled = late.clone();
        settled.settle(&Silent);
        // Known without reading, and without cutting.
        assert_eq!(Volume::of_lines(&late), Volume::of_lines(&settled));
        let [along, a, b] = [axis.along(), axis.along().others().0, axis.along().others().1];
        let counts = late.lattice().counts;
        let mut found = [0; 2];
        for j in 0..counts[b.index()] {
            for i in 0..counts[a.index()] {
                let low = random.within(-9.0, 9.0);
                let between = [low, low + random.within(0.0, 3.0)];
                let line = settled.line(along, i, j).iter();
                let has = |i: &Interval| unfixed(i.lo.at) < between[1] && unfixed(i.hi.at) > between[0];
                let has_some = line.clone().any(has);
                assert_eq!(late.has_material(along, [i, j], between), has_some, "{axis:?} {i} {j}");
                found[usize::from(has_some)] += 1;
            }
        }
        assert!(found.iter().all(|n| *n > 50), "{found:?}");
        assert!(late.above.as_ref().is_some_and(|above| above.owes(along)));
        // Read before and after the others.
        compare_lines([&late, &settled], "read", |a, b| a == b);
        let (volume, others) = (late.volumes()[axis.along().index()], late.volumes());
        assert!(others.iter().all(|v| (v / volume - 1.0).abs() < 0.03), "{axis:?}: {others:?}");
        late.settle(&Silent);
        compare_lines([&late, &settled], "taken back", |a, b| a == b);
    }
}

#[test]
fn a_list_cut_in_parts_with_looks_between_leaves_the_same_lines() {
    let mut random = Random(6);
    for round in 0..kinecut_cases::cases(12, 300) {
        let body = [ToolBody::new(SHAPES[round as usize % SHAPES.len()].profile())];
        let axes = [CutAxis::PlusZ, CutAxis::PlusZ, CutAxis::MinusX];
        let moves: Vec<CutMove> = axes.into_iter().flat_map(|axis| chain(&mut random, axis, 20)).collect();
        let list = CutList::new(&body, moves, &CutOptions::default(), 0.4).unwrap();
        let cut = |stops: &[usize], read: bool| {
            let mut stock = TriDexel::from_box(BLOCK, 0.4).unwrap();
            let mut effects = Vec::new();
            for pair in stops.windows(2) {
                effects.extend(cut_list(&mut stock, &list, pair[0]..pair[1], &Silent).unwrap());
                if read {
                    assert!(stock.volumes().iter().all(|v| v.is_finite()));
                }
            }
            (stock, effects)
        };
        let (whole, effects) = cut(&[0, 60], false);
        for (stops, read) in
            [(&[0, 7, 31, 33, 60][..], false), (&[0, 20, 40, 60], true), (&[0, 11, 60], true)]
        {
            let (parts, same) = cut(stops, read);
            compare_lines([&whole, &parts], &format!("round {round}, {stops:?}"), |a, b| a == b);
            assert_eq!(effects.len(), same.len());
        }
    }
}

/// Cancels after some questions.
struct After(std::sync::atomic::AtomicI32);

impl Progress for After {
    fn stage(&self, _: &str, _: u64) {}

    fn advance(&self, _: u64) {}

    fn cancelled(&self) -> bool {
        self.0.fetch_sub(1, std::sync::atomic::Ordering::Relaxed) <= 0
    }
}

#[test]
fn lines_left_by_a_cancelled_run_are_cut_later() {
    let mut random = Random(8);
    let body = [ToolBody::new(SHAPES[2].profile())];
    let list =
        CutList::new(&body, chain(&mut random, CutAxis::PlusZ, 60), &CutOptions::default(), 0.4).unwrap();
    let mut stock = TriDexel::from_box(BLOCK, 0.4).unwrap();
    cut_list(&mut stock, &list, 0..60, &Silent).unwrap();
    let mut settled = stock.clone();
    settled.settle(&Silent);
    for questions in [0, 3, 10, 40] {
        let mut stopped = stock.clone();
        stopped.settle(&After(questions.into()));
        compare_lines([&stopped, &settled], &format!("after {questions}"), |a, b| a == b);
    }
}

#[test]
fn lists_for_other_steps_and_ranges_beyond_them_are_refused() {
    let body = [ToolBody::new(SHAPES[0].profile())];
    let moves = chain(&mut Random(9), CutAxis::PlusZ, 3);
    let list = CutList::new(&body, moves, &CutOptions::default(), 0.4).unwrap();
    let mut stock = TriDexel::from_box(BLOCK, 0.4).unwrap();
    let error = cut_list(&mut stock, &list, 1..4, &Silent).unwrap_err();
    assert_eq!((error.0.value.unwrap().value, error.0.bound.unwrap().value), (4.0, 3.0));
    let mut other = TriDexel::from_box(BLOCK, 0.5).unwrap();
    let error = cut_list(&mut other, &list, 0..3, &Silent).unwrap_err();
    assert_eq!((error.0.value.unwrap().value, error.0.bound.unwrap().value), (0.4, 0.5));
}

/// Readers inside of a pool of threads, who all ask at once: none waits for one that waits for it.
#[test]
fn lines_are_read_first_by_many_threads() {
    let mut random = Random(12);
    let body = [ToolBody::new(SHAPES[3].profile())];
    let list =
        CutList::new(&body, chain(&mut random, CutAxis::PlusZ, 60), &CutOptions::default(), 0.4).unwrap();
    let mut late = TriDexel::from_box(BLOCK, 0.4).unwrap();
    cut_list(&mut late, &list, 0..60, &Silent).unwrap();
    let mut settled = late.clone();
    settled.settle(&Silent);
    for threads in [1, 2, 5] {
        let (stock, pool) =
            (late.clone(), rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap());
        let count = stock.lattice().counts[2];
        let row = |stock: &TriDexel, z: u32| -> Vec<Vec<_>> {
            (0..stock.lattice().counts[1]).map(|y| stock.line(Axis::X, y, z).to_vec()).collect()
        };
        let rows: Vec<_> = pool.install(|| (0..count).into_par_iter().map(|z| row(&stock, z)).collect());
        assert!(rows.into_iter().eq((0..count).map(|z| row(&settled, z))), "{threads} threads");
    }
}
