//! Golden numbers of the least burr (seed 003): limit objectives of 46 placements. The optima are in
//! `golden_optimum.rs`, the crossings in `golden_events.rs`.

use kinecut::facing::{BadSet, FaceCase, Placement, Sweep, bad_length, bad_stretches, either_bad_length};

use crate::common::burr_golden::Golden;

fn length_of(case: &FaceCase, placement: Placement, sweep: Sweep, rho: f64) -> f64 {
    let mut sum = 0.0;
    for edge in case.outline.edges() {
        bad_stretches(edge, case, placement, sweep, rho, |b| {
            sum += (b.to - b.from) * b.weight * edge.length()
        });
    }
    sum
}

#[test]
fn limit_objectives_are_the_golden_ones() {
    let golden = Golden::read();
    assert!(golden.cases.len() > 30);
    for c in &golden.cases {
        let bad = BadSet::below(c.psi0_deg.to_radians()).unwrap();
        let case = FaceCase::new(golden.outline(&c.polygon), c.radius, bad).unwrap();
        let placement = Placement { angle: c.gamma_deg.to_radians(), offset: c.r - c.ty };
        for (name, have, want) in [
            ("limit", bad_length(&case, placement), c.f_limit),
            ("rho", length_of(&case, placement, Sweep::Front, c.r / c.radius), c.f_limit_rho),
            ("back", length_of(&case, placement, Sweep::Back, 0.0), c.f_limit_back),
            ("either", either_bad_length(&case, placement), c.f_limit_either),
        ] {
            assert!((have - want).abs() < 1e-8, "{} {name}: {have} against {want}", c.id);
        }
    }
}

#[test]
fn golden_optima_have_their_value_at_their_placement() {
    let golden = Golden::read();
    for (name, polygon) in &golden.polygons {
        for o in &polygon.optima {
            let bad = BadSet::below(o.psi0_deg.to_radians()).unwrap().guarded(o.guard_deg.to_radians());
            let case = FaceCase::new(polygon.outline(), o.radius, bad).unwrap();
            let placement = Placement { angle: o.gamma_deg.to_radians(), offset: o.c };
            let have = bad_length(&case, placement);
            assert!((have - o.value).abs() < 1e-6 * o.perimeter, "{name}: {have} against {}", o.value);
        }
    }
}
