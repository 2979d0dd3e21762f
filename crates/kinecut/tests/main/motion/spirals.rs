//! The table of spirals: against times of an independent solver of the same problem, and of `toppra` without jerk limits.

use kinecut::motion::{Course, TimeLaw, WithoutJerk};

use super::courses::{Planar, USUAL};

const PITCH: f64 = 3.95;
const TURNS: u32 = 20;

/// A row of the table: the curve, its time under the jerk limit and without it [s], and by how much the law may be slower.
type Row = (Planar, f64, f64, f64);

fn table(feed: f64, times: [[f64; 2]; 4], slower: [f64; 4]) -> Vec<Row> {
    let turns = f64::from(TURNS);
    let curves = [
        Planar::involute(PITCH, turns, feed),
        Planar::archimedean(PITCH, turns, feed),
        Planar::semicircles(PITCH, TURNS, 1.0, feed),
        Planar::semicircles(PITCH, TURNS, 0.25, feed),
    ];
    let rows = curves.into_iter().zip(times).zip(slower);
    rows.map(|((curve, [limited, free]), slower)| (curve, limited, free, slower)).collect()
}

fn check(rows: &[Row], free_within: [f64; 4], most_steps: [u32; 4]) {
    for (i, (curve, limited, free, slower)) in rows.iter().enumerate() {
        let law = TimeLaw::new(curve, &[USUAL; 2]).unwrap();
        let (found, bound) = (law.duration(), law.without_jerk());
        assert!(found <= limited + slower, "row {i}: {found} against {limited}");
        assert!(found >= bound, "row {i}: {found} below {bound}");
        let within = free_within[i];
        assert!((bound - free).abs() <= within, "row {i} without jerk: {bound} against {free}");
        // The grid of the law is finer where its shape asks for it.
        let alone = WithoutJerk::new(curve, &[USUAL; 2]).unwrap().duration();
        assert!((alone / bound - 1.0).abs() < 1e-8, "row {i}: {alone} {bound}");
        // Each grid and each smaller share starts from the solution before: from the start of the whole each takes as many
        // steps as the first.
        assert!(law.steps() <= most_steps[i], "row {i}: {} steps", law.steps());
        let shares = law.shares(curve, &[USUAL; 2]);
        for share in [shares.velocity, shares.acceleration, shares.jerk] {
            assert!(share <= 1.0 + 1e-9, "row {i}: {shares:?}");
        }
        // The jerk limit costs time; that a law reaches it shows that nothing is given away.
        assert!(shares.jerk > 1.0 - 1e-4, "row {i}: {shares:?}");
    }
}

#[test]
fn curves_of_the_table_have_its_lengths() {
    let lengths = [4963.7, 4965.6, 5087.8, 5087.8];
    for ((curve, ..), length) in table(100.0, [[0.0; 2]; 4], [0.0; 4]).iter().zip(lengths) {
        assert!((curve.length() - length).abs() < 0.05, "{} {length}", curve.length());
    }
}

#[test]
fn spirals_at_6_m_per_min_take_the_time_of_the_table() {
    let times = [[49.7857, 49.6613], [49.8282, 49.6867], [51.0266, 50.8981], [51.1013, 50.8981]];
    check(&table(100.0, times, [1e-3; 4]), [1e-3; 4], [60, 60, 70, 90]);
}

#[test]
fn spirals_at_30_m_per_min_take_the_time_of_the_table() {
    // `toppra`'s grid is too coarse for the ramps of curvature (11.4257 and 11.4279): on 100 000 cells of it the last one takes
    // 11.4249 s without jerk limits; the one before takes 11.4227 s here on 250 000 cells.
    let times = [[11.8949, 11.1833], [11.9348, 11.2047], [12.4503, 11.4227], [14.5119, 11.4249]];
    check(&table(500.0, times, [1e-3; 4]), [2e-3, 2e-3, 1e-3, 1e-3], [130, 130, 160, 160]);
}
