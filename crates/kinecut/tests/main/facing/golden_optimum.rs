//! Golden optima of the least burr (seed 003): 17 polygons, thresholds of 90 and 60 degrees, with and without guard.

use kinecut::base::Silent;
use kinecut::facing::optimum::{Options, least_burr};
use kinecut::facing::{BadSet, FaceCase, bad_length};

use crate::common::burr_golden::Golden;

#[test]
fn every_optimum_is_as_good_as_the_golden_one_and_proven() {
    let golden = Golden::read();
    let mut count = 0;
    for (name, polygon) in &golden.polygons {
        for o in &polygon.optima {
            let bad = BadSet::below(o.psi0_deg.to_radians()).unwrap().guarded(o.guard_deg.to_radians());
            let case = FaceCase::new(polygon.outline(), o.radius, bad).unwrap();
            let options = Options { margin: o.margin, irreducible: false, ..Options::for_cutter(o.radius) };
            let optimum = least_burr(&case, &options, &Silent).unwrap();
            let what = format!("{name} {} {}: {optimum:?}", o.psi0_deg, o.guard_deg);
            assert!(optimum.value <= o.value + 1e-6 * o.perimeter, "{what}");
            let gap = if name == "cross" { 1e-4 } else { 2e-6 };
            assert!(optimum.gap() <= gap * o.perimeter && optimum.complete, "{what}");
            // The two certificates do not contradict one another.
            assert!(optimum.value >= o.certified_lower - 1e-9 * o.perimeter, "{what}");
            assert!(optimum.lower_bound <= o.value + 1e-9 * o.perimeter, "{what}");
            assert!((bad_length(&case, optimum.placement) - optimum.value).abs() < 1e-9, "{what}");
            let [least, most] = case.offsets(optimum.placement.angle, o.margin - 1e-9);
            assert!((least..=most).contains(&optimum.placement.offset), "{what}");
            count += 1;
        }
    }
    assert_eq!(count, 68);
}
