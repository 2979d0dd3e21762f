//! Golden numbers of the least burr (seed 003): every crossing of the teeth with the outline, and the bad length that
//! real teeth leave.

use std::f64::consts::{PI, TAU};

use kinecut::facing::{BadSet, FaceCase, Placement, Sweep, Tooth, ToothedPass, toothed_lengths};

use crate::common::burr_golden::{Case, Golden};

fn pass_of(c: &Case) -> ToothedPass {
    let z = u32::try_from(c.z).unwrap();
    let tooth = |k| Tooth { phase: TAU * f64::from(k) / f64::from(z), radius: c.radius };
    let placement = Placement { angle: c.gamma_deg.to_radians(), offset: c.r - c.ty };
    ToothedPass { teeth: (0..z).map(tooth).collect(), feed_per_radian: c.r, placement, along: c.tx }
        .checked()
        .unwrap()
}

fn near(have: f64, want: f64, relative: f64) -> bool {
    (have - want).abs() <= relative * want.abs().max(1.0)
}

#[test]
fn crossings_are_the_golden_ones() {
    let golden = Golden::read();
    let mut listed = 0;
    for c in &golden.cases {
        let outline = golden.outline(&c.polygon);
        let pass = pass_of(c);
        let all = pass.crossings(&outline).unwrap();
        assert_eq!(all.len(), c.n_events, "{}", c.id);
        assert_eq!(pass.count(&outline), c.n_events as u64, "{}", c.id);
        let front: Vec<f64> =
            all.iter().filter(|e| e.front && e.exit).map(|e| e.exit_angle().to_degrees()).collect();
        assert_eq!(front.len(), c.n_front_exits, "{}", c.id);
        assert_eq!(front.iter().filter(|&&p| p < c.psi0_deg).count(), c.n_bad_front_exits, "{}", c.id);
        assert!(near(front.iter().sum(), c.sum_psi_front_exits, 1e-9), "{}", c.id);
        assert!(near(all.iter().map(|e| e.time).sum(), c.sum_t, 1e-9), "{}", c.id);
        for w in all.windows(2).filter(|w| w[0].tooth == w[1].tooth) {
            assert!(w[0].time <= w[1].time && w[0].exit != w[1].exit, "{}", c.id);
        }
        for (have, want) in all.iter().zip(&c.events) {
            let kinds = [have.tooth, have.edge, u32::from(have.exit), u32::from(have.front)].map(f64::from);
            assert_eq!(kinds, [want[0], want[1], want[7], want[8]], "{}: {have:?}", c.id);
            // The golden frame has the centre line at y = r.
            let y = have.point.y + c.ty;
            let psi = have.exit_angle() * 180.0 / PI;
            for (have, want) in [have.time, have.share, have.point.x, y, psi].into_iter().zip(&want[2..]) {
                assert!(near(have, *want, 1e-9), "{}: {have} against {want}", c.id);
            }
            listed += 1;
        }
    }
    assert!(listed > 1000, "{listed}");
}

#[test]
fn bad_lengths_of_real_teeth_are_the_golden_ones() {
    let golden = Golden::read();
    for c in &golden.cases {
        let bad = BadSet::below(c.psi0_deg.to_radians()).unwrap();
        let case = FaceCase::new(golden.outline(&c.polygon), c.radius, bad).unwrap();
        let pass = pass_of(c);
        for (sweep, want) in [(Sweep::Front, c.f_discrete_front), (Sweep::Back, c.f_discrete_back)] {
            let have = toothed_lengths(&case, &pass, sweep).unwrap();
            assert!((have.bad - want).abs() < 1e-8, "{} {sweep:?}: {} against {want}", c.id, have.bad);
            let all = have.exits + have.entries + have.uncrossed;
            assert!((all - case.weighted_perimeter()).abs() < 1e-9, "{}", c.id);
        }
    }
}
