//! Compensated paths against the interpreter of LinuxCNC 2.9 (`rs274`, run once; four decimals), and against the
//! distance from the contour.

use proptest::prelude::*;

use super::*;
use crate::geom::{CurveKind, InvoluteRecord};

/// Half of the last decimal that the interpreter prints, and rounding.
const PRINTED: f64 = 0.51e-4;

/// A contour from words: `L x y z` and `A x y z cx cy sweep`.
fn contour(start: [f64; 3], moves: &[&[f64]]) -> Vec<Programmed> {
    let mut here = DVec3::from_array(start);
    moves
        .iter()
        .enumerate()
        .map(|(item, m)| {
            let end = DVec3::new(m[0], m[1], m[2]);
            let curve: Curve = if m.len() == 3 {
                Line { start: here, end }.into()
            } else {
                let centre = DVec3::new(m[3], m[4], here.z);
                Arc { start: here, centre, axis: DVec3::Z, sweep: m[5].to_radians(), rise: end.z - here.z }
                    .into()
            };
            here = end;
            Programmed { item, curve }
        })
        .collect()
}

fn path(start: [f64; 3], moves: &[&[f64]], d: f64) -> Result<Vec<Programmed>> {
    let all = contour(start, moves);
    let (exit, run) = all.split_last().unwrap();
    compensate(run, Some(exit), d, CompStart::AtEntry)
}

/// Output of `rs274`: `[x, y, z]` of a STRAIGHT_FEED, `[x, y, cx, cy, turns, z]` of an ARC_FEED.
fn printed(path: &[Programmed]) -> Vec<Vec<f64>> {
    path.iter()
        .map(|p| {
            let end = p.curve.end();
            match p.curve.kind() {
                CurveKind::Arc(arc) => {
                    vec![end.x, end.y, arc.centre.x, arc.centre.y, arc.sweep.signum(), end.z]
                }
                _ => vec![end.x, end.y, end.z],
            }
        })
        .collect()
}

fn assert_as(path: &[Programmed], wanted: &[&[f64]]) {
    let found = printed(path);
    assert_eq!(found.len(), wanted.len(), "{found:#?}");
    for (f, w) in found.iter().zip(wanted) {
        assert!(f.len() == w.len() && f.iter().zip(*w).all(|(a, b)| (a - b).abs() < PRINTED), "{f:?} {w:?}");
    }
    for w in path.windows(2) {
        assert!(w[0].curve.end().distance(w[1].curve.start()) < 1e-9);
    }
}

#[test]
fn an_entry_on_an_arc_is_run_as_linuxcnc_runs_it() {
    let half: &[f64] = &[20.0, 0.0, 5.0, 10.0, 0.0, 180.0];
    let back: &[f64] = &[20.0, 0.0, 5.0, 10.0, 0.0, -180.0];
    let run = |moves: &[&[f64]], d: f64| path([0.0, 0.0, 5.0], moves, d).unwrap();
    // On in its direction, round an outside corner, and cut off by an inside one.
    assert_as(
        &run(&[half, &[20.0, 20.0, 5.0], &[40.0, 60.0, 5.0]], 2.0),
        &[&[18.0, 0.0, 9.0, 0.0, 1.0, 5.0], &[18.0, 20.0, 5.0], &[40.0, 60.0, 5.0]],
    );
    assert_as(
        &run(&[half, &[25.0, 20.0, 5.0], &[40.0, 60.0, 5.0]], 2.0),
        &[
            &[18.0, 0.0, 9.0, 0.0, 1.0, 5.0],
            &[18.0597, 0.4851, 20.0, 0.0, -1.0, 5.0],
            &[23.0597, 20.4851, 5.0],
            &[40.0, 60.0, 5.0],
        ],
    );
    assert_as(
        &run(&[half, &[10.0, 20.0, 5.0], &[40.0, 60.0, 5.0]], 2.0),
        &[&[17.9888, -0.4497, 9.0, 0.0, 1.0, 5.0], &[8.2111, 19.1056, 5.0], &[40.0, 60.0, 5.0]],
    );
    // Outside of it, and with a second turn and a rise.
    assert_as(
        &run(&[back, &[20.0, -20.0, 5.0], &[40.0, -60.0, 5.0]], 2.0),
        &[&[22.0, 0.0, 11.0, 0.0, -1.0, 5.0], &[22.0, -20.0, 5.0], &[40.0, -60.0, 5.0]],
    );
    let turns = run(&[&[20.0, 0.0, 1.0, 10.0, 0.0, -540.0], &[20.0, -20.0, 1.0], &[40.0, -60.0, 1.0]], -2.0);
    assert_as(&turns, &[&[18.0, 0.0, 9.0, 0.0, -1.0, 1.0], &[18.0, -20.0, 1.0], &[40.0, -60.0, 1.0]]);
    let CurveKind::Arc(arc) = turns[0].curve.kind() else { panic!() };
    assert!((arc.sweep + 3.0 * std::f64::consts::PI).abs() < 1e-9);
    // Less than half a turn, between two radii that are not on one line: S, P and the new centre.
    assert_as(
        &run(&[&[25.0, 25.0, 5.0, 25.0, 0.0, -90.0], &[50.0, 25.0, 5.0], &[40.0, -60.0, 5.0]], 20.0),
        &[&[25.0, 45.0, 25.0, 15.5556, -1.0, 5.0], &[50.0, 45.0, 5.0], &[40.0, -60.0, 5.0]],
    );
    // By the other rule it is refused, and so is one that is too short.
    let all = contour([0.0, 0.0, 5.0], &[half, &[20.0, 20.0, 5.0], &[40.0, 60.0, 5.0]]);
    let by = |d, start| compensate(&all[..2], all.last(), d, start).unwrap_err().code();
    assert_eq!(by(2.0, CompStart::AtNext), Code::COMPENSATION);
    assert_eq!(by(-20.0, CompStart::AtEntry), Code::COMPENSATION);
}

#[test]
fn a_rectangle_is_run_as_linuxcnc_runs_it() {
    let moves: &[&[f64]] = &[
        &[0.0, 0.0, 0.0],
        &[0.0, 30.0, 0.0],
        &[40.0, 30.0, 0.0],
        &[40.0, 0.0, 0.0],
        &[-10.0, 0.0, 0.0],
        &[-20.0, -20.0, 0.0],
    ];
    let start = [-20.0, -20.0, 0.0];
    assert_as(
        &path(start, moves, 2.0).unwrap(),
        &[
            &[-2.0, 0.8284, 0.0],
            &[-2.0, 30.0, 0.0],
            &[0.0, 32.0, 0.0, 30.0, -1.0, 0.0],
            &[40.0, 32.0, 0.0],
            &[42.0, 30.0, 40.0, 30.0, -1.0, 0.0],
            &[42.0, 0.0, 0.0],
            &[40.0, -2.0, 40.0, 0.0, -1.0, 0.0],
            &[-10.0, -2.0, 0.0],
            &[-20.0, -20.0, 0.0],
        ],
    );
    assert_as(
        &path(start, moves, -2.0).unwrap(),
        &[
            &[std::f64::consts::SQRT_2, -std::f64::consts::SQRT_2, 0.0],
            &[2.0, 0.0, 0.0, 0.0, 1.0, 0.0],
            &[2.0, 28.0, 0.0],
            &[38.0, 28.0, 0.0],
            &[38.0, 2.0, 0.0],
            &[-10.0, 2.0, 0.0],
            &[-20.0, -20.0, 0.0],
        ],
    );
    // By the other rule the entry ends square to the first side.
    let all = contour(start, moves);
    let by_next = compensate(&all[..5], all.last(), 2.0, CompStart::AtNext).unwrap();
    assert!(by_next[0].curve.end().distance(DVec3::new(-2.0, 0.0, 0.0)) < 1e-12);
}

#[test]
fn arcs_and_lines_are_run_as_linuxcnc_runs_them() {
    let moves: &[&[f64]] = &[
        &[10.0, 0.0, 0.0],
        &[20.0, 0.0, 0.0],
        &[40.0, 0.0, 0.0, 30.0, 0.0, 180.0],
        &[40.0, 20.0, 0.0],
        &[60.0, 20.0, 0.0, 50.0, 20.0, -180.0],
        &[80.0, 20.0, 0.0],
        &[0.0, -40.0, 0.0],
    ];
    assert_as(
        &path([0.0; 3], moves, -2.0).unwrap(),
        &[
            &[10.0, -2.0, 0.0],
            &[18.1678, -2.0, 0.0],
            &[42.0, 0.0, 30.0, 0.0, 1.0, 0.0],
            &[42.0, 20.0, 0.0],
            &[58.0, 20.0, 50.0, 20.0, -1.0, 0.0],
            &[60.0, 18.0, 60.0, 20.0, 1.0, 0.0],
            &[80.0, 18.0, 0.0],
            &[0.0, -40.0, 0.0],
        ],
    );
    let left = path([0.0; 3], moves, 2.0).unwrap();
    assert_as(
        &left[..6],
        &[
            &[10.0, 2.0, 0.0],
            &[20.0, 2.0, 0.0],
            &[22.0, 0.0, 20.0, 0.0, -1.0, 0.0],
            &[38.0, 0.0, 30.0, 0.0, 1.0, 0.0],
            &[38.0, 20.0, 0.0],
            &[61.8322, 22.0, 50.0, 20.0, -1.0, 0.0],
        ],
    );
}

#[test]
fn a_move_across_the_plane_goes_where_the_tool_stands() {
    let moves: &[&[f64]] = &[
        &[10.0, 0.0, 0.0],
        &[10.0, 20.0, 5.0],
        &[10.0, 20.0, 10.0],
        &[20.0, 30.0, 10.0, 20.0, 20.0, 270.0],
        &[50.0, 30.0, 10.0],
    ];
    assert_as(
        &path([0.0; 3], moves, -2.0).unwrap(),
        &[
            &[10.0, -2.0, 0.0],
            &[12.0, 0.0, 10.0, 0.0, 1.0, 0.0],
            &[12.0, 11.0557, 5.0],
            &[12.0, 11.0557, 10.0],
            &[20.0, 32.0, 20.0, 20.0, 1.0, 10.0],
            &[50.0, 30.0, 10.0],
        ],
    );
    // The contour folds back there: outside on the left, and so do two lines.
    assert_as(
        &path([0.0; 3], moves, 2.0).unwrap(),
        &[
            &[8.0, 2.0, 0.0],
            &[8.0, 20.0, 5.0],
            &[8.0, 20.0, 10.0],
            &[12.0, 20.0, 10.0, 20.0, -1.0, 10.0],
            &[20.0, 28.0, 20.0, 20.0, 1.0, 10.0],
            &[50.0, 30.0, 10.0],
        ],
    );
    let back: &[&[f64]] = &[&[10.0, 0.0, 0.0], &[20.0, 0.0, 0.0], &[5.0, 0.0, 0.0], &[0.0, 30.0, 0.0]];
    assert_as(
        &path([0.0; 3], back, 2.0).unwrap(),
        &[
            &[10.0, 2.0, 0.0],
            &[20.0, 2.0, 0.0],
            &[20.0, -2.0, 20.0, 0.0, -1.0, 0.0],
            &[5.0, -2.0, 0.0],
            &[0.0, 30.0, 0.0],
        ],
    );
}

#[test]
fn zero_is_the_programmed_path_to_the_bit_and_a_negative_value_the_other_side() {
    let moves: &[&[f64]] =
        &[&[10.0, 0.0, 0.0], &[20.0, 10.0, 1.0, 10.0, 10.0, 90.0], &[20.0, 40.0, 1.0], &[0.0, 40.0, 1.0]];
    let all = contour([0.0; 3], moves);
    let same = path([0.0; 3], moves, 0.0).unwrap();
    assert!(all.iter().zip(&same).all(|(a, b)| a.curve == b.curve && a.item == b.item));
    let (l, r) = (path([0.0; 3], moves, 1.0).unwrap(), path([0.0; 3], moves, -1.0).unwrap());
    assert_eq!((l[0].curve.end().y, r[0].curve.end().y), (1.0, -1.0));
}

#[test]
fn what_a_control_refuses_is_refused_with_the_move_the_number_and_the_bound() {
    let refusal = |moves: &[&[f64]], d: f64| {
        let error = path([0.0; 3], moves, d).unwrap_err();
        assert_eq!(error.code(), Code::COMPENSATION);
        let value = error.0.value.as_ref().map_or(f64::NAN, |q| q.value);
        (error.0.item.unwrap(), value, error.to_string())
    };
    // A hollow arc of radius 1 for 2 mm; LinuxCNC still runs one of exactly 2, as a point.
    let hollow: &[&[f64]] =
        &[&[10.0, 0.0, 0.0], &[11.0, 1.0, 0.0, 10.0, 1.0, 90.0], &[11.0, 20.0, 0.0], &[0.0, 20.0, 0.0]];
    let (item, value, text) = refusal(hollow, 2.0);
    assert_eq!((item, value), (1, 1.0));
    assert!(text.contains("gouging") && text.contains("bound 2 mm"), "{text}");
    assert!(path([0.0; 3], hollow, -2.0).is_ok());
    // An entry of 2 mm for 2 mm.
    let short: &[&[f64]] = &[&[2.0, 0.0, 0.0], &[20.0, 0.0, 0.0], &[30.0, 0.0, 0.0]];
    assert_eq!(refusal(short, 2.0).0, 0);
    assert!(path([0.0; 3], short, 1.999).is_ok());
    // An inside corner with a side of 1.4 mm for 2 mm: LinuxCNC stops there too.
    let narrow: &[&[f64]] =
        &[&[10.0, 0.0, 0.0], &[20.0, 0.0, 0.0], &[21.0, 1.0, 0.0], &[21.0, 30.0, 0.0], &[0.0, 40.0, 0.0]];
    assert_eq!(refusal(narrow, 2.0).0, 2);
    // Entry on an arc that is hollow and no larger than the tool, exit straight down, arc in another plane.
    let arc: &[&[f64]] = &[&[2.0, 2.0, 0.0, 0.0, 2.0, 90.0], &[2.0, 20.0, 0.0], &[30.0, 0.0, 0.0]];
    assert_eq!(refusal(arc, 2.0).0, 0);
    assert!(path([0.0; 3], arc, 0.1).is_ok());
    let down: &[&[f64]] = &[&[10.0, 0.0, 0.0], &[20.0, 0.0, 0.0], &[20.0, 0.0, -5.0]];
    assert_eq!(refusal(down, 0.1).0, 2);
    let mut tilted = contour([0.0; 3], &[&[10.0, 0.0, 0.0], &[20.0, 0.0, 0.0], &[30.0, 0.0, 0.0]]);
    tilted[1].curve =
        Arc::new(DVec3::X * 10.0, DVec3::X * 15.0, DVec3::Y, std::f64::consts::PI, 0.0).unwrap().into();
    let error = compensate(&tilted[..2], tilted.last(), 0.1, CompStart::AtNext).unwrap_err();
    assert_eq!(error.0.item, Some(1));
}

#[test]
fn an_involute_lead_in_stays_an_involute_and_meets_its_circle() {
    let spiral = InvoluteRecord::new(0.5 * 10.0 * 9.0, [3.0, 0.0], 0.4, 5.0, 14.0).unwrap();
    let spiral = Curve::involute(spiral, -5.0, 0.0);
    let end = spiral.at(spiral.length());
    let normal = DVec3::new(-end.d1.y, end.d1.x, 0.0);
    let circle = Arc {
        start: end.p,
        centre: end.p + normal * 14.0,
        axis: DVec3::Z,
        sweep: std::f64::consts::TAU,
        rise: 0.0,
    };
    let tangent = spiral.at(0.0).d1;
    let entry = Line { start: spiral.start() - tangent, end: spiral.start() };
    let exit = Line { start: end.p, end: end.p + end.d1 };
    let all: Vec<_> = [entry.into(), spiral, circle.into(), exit.into()]
        .into_iter()
        .enumerate()
        .map(|(item, curve)| Programmed { item, curve })
        .collect();
    for start in [CompStart::AtEntry, CompStart::AtNext] {
        for d in [0.01, -0.01, 0.2] {
            let path = compensate(&all[..3], all.last(), d, start).unwrap();
            assert_eq!(path.len(), 4);
            let CurveKind::Involute { record, .. } = path[1].curve.kind() else { panic!() };
            assert!((record.end_radius() - 14.0 + d).abs() < 1e-12);
            let CurveKind::Arc(arc) = path[2].curve.kind() else { panic!() };
            assert!((arc.radius() - 14.0 + d).abs() < 1e-12 && arc.sweep == std::f64::consts::TAU);
            for w in path[..3].windows(2) {
                let joint = crate::geom::joint(&w[0].curve, &w[1].curve);
                assert!(joint.gap < 1e-9);
            }
            let joint = crate::geom::joint(&path[1].curve, &path[2].curve);
            assert!(joint.contact >= crate::geom::ContactOrder::G2, "{joint:?}");
        }
    }
}

#[test]
fn a_lens_spiral_is_followed_within_ten_nanometres() {
    use crate::geom::{LensOrder, Rise, Spiral, Support};
    let law = Support::Lens { inner: 30.0, base_radius: 50.0 / 7.0, order: LensOrder::Two };
    let lead = Curve::spiral(Spiral::new(law.into(), 1.0, 7.0).unwrap(), -4.0, Rise::NONE);
    let (a, b) = (lead.at(0.0), lead.at(lead.length()));
    let entry = Line { start: a.p - a.d1, end: a.p };
    let exit = Line { start: b.p, end: b.p + b.d1 };
    let curves = [entry.into(), lead.clone(), exit.into()];
    let all: Vec<_> =
        curves.into_iter().enumerate().map(|(item, curve)| Programmed { item, curve }).collect();
    assert_eq!(compensate(&all[..2], all.last(), 0.0, CompStart::AtNext).unwrap()[1].curve, lead);
    for d in [0.2, -0.5] {
        let path = compensate(&all[..2], all.last(), d, CompStart::AtNext).unwrap();
        let inner = &path[1..path.len() - 1];
        assert!(inner.len() > 20 && inner.iter().all(|p| p.item == 1));
        for w in inner.windows(2) {
            let joint = crate::geom::joint(&w[0].curve, &w[1].curve);
            assert!(joint.contact >= crate::geom::ContactOrder::G1, "{joint:?}");
        }
        for i in 0..=40 {
            let jet = lead.at(lead.length() * f64::from(i) / 40.0);
            let p = jet.p + DVec3::new(-jet.d1.y, jet.d1.x, 0.0) * d;
            let off = distance(p, inner);
            assert!(off < 1.3e-5, "{off}");
        }
    }
}

/// Distance of a point from a contour: the nearest of many steps, then thirds of the steps next to it.
fn distance(p: DVec3, curves: &[Programmed]) -> f64 {
    const STEPS: f64 = 200.0;
    let mut least = f64::INFINITY;
    for c in curves {
        let at = |u: f64| c.curve.at(c.curve.length() * u.clamp(0.0, 1.0)).p.distance(p);
        let nearest =
            (0..=200).map(f64::from).min_by(|a, b| at(a / STEPS).total_cmp(&at(b / STEPS))).unwrap();
        let (mut lo, mut hi) = ((nearest - 1.0) / STEPS, (nearest + 1.0) / STEPS);
        for _ in 0..60 {
            let third = (hi - lo) / 3.0;
            if at(lo + third) < at(hi - third) { hi -= third } else { lo += third }
        }
        let d = at(0.5 * (lo + hi));
        if d < least {
            least = d;
        }
    }
    least
}

proptest! {
    #![proptest_config(kinecut_cases::property(48))]

    /// Between entry and exit each point of the path is as far from the contour as the compensation says.
    #[test]
    fn the_path_keeps_its_distance_from_the_contour(
        // Arcs long enough for the inside corner at their end: (5 - 1.5) 0.6 > 1.5 tan 0.7; shorter ones are refused.
        turns in proptest::collection::vec((-1.4..1.4f64, 6.0..20.0f64, 0u8..3, 5.0..9.0f64), 2..5),
        tiny in proptest::collection::vec(-3e-4..3e-4f64, 5),
        d in -1.5..1.5f64,
    ) {
        // A contour that does not close on itself: the total of the turns is bounded by the way they are drawn.
        let (mut here, mut angle) = (DVec3::new(8.0, 0.0, 0.0), 0.0f64);
        let mut all = vec![Programmed { item: 0, curve: Line { start: DVec3::ZERO, end: here }.into() }];
        for (i, (turn, size, kind, radius)) in turns.iter().enumerate() {
            // Corners sharp, straight on to rounding, and exactly straight on, lest opposite turns pile up.
            angle += match kind { 0 => if angle * turn > 0.0 { -turn } else { *turn }, 1 => tiny[i], _ => 0.0 };
            let t = DVec3::new(angle.cos(), angle.sin(), 0.0);
            let curve: Curve = if *kind == 0 {
                Line { start: here, end: here + t * *size }.into()
            } else {
                let side = if *turn > 0.0 { 1.0 } else { -1.0 };
                let centre = here + DVec3::new(-t.y, t.x, 0.0) * (side * radius);
                Arc { start: here, centre, axis: DVec3::Z, sweep: side * 0.6, rise: 0.0 }.into()
            };
            here = curve.end();
            let end = curve.at(curve.length()).d1;
            angle = end.y.atan2(end.x);
            all.push(Programmed { item: i + 1, curve });
        }
        let t = DVec3::new(angle.cos(), angle.sin(), 0.0);
        let exit = Programmed { item: all.len(), curve: Line { start: here, end: here + t * 5.0 }.into() };
        let path = compensate(&all, Some(&exit), d, CompStart::AtEntry).unwrap();
        let inner = &path[1..path.len() - 1];
        for w in path.windows(2) {
            prop_assert!(w[0].curve.end().distance(w[1].curve.start()) < 1e-8, "{:?}", w);
        }
        for c in inner {
            for u in [0.0, 0.25, 0.5, 0.8, 1.0] {
                let p = c.curve.at(c.curve.length() * u).p;
                let found = distance(p, &all[1..]);
                // Never nearer; farther only outside a corner of up to 0.05 rad, by d phi^2/8, by
                // up to twice as much where curves are as tight as here.
                let most = d.abs() * (1.0 + 0.25 * corner::SMALL.powi(2));
                prop_assert!(found > d.abs() - 1e-7 && found < most + 1e-7, "{found} {d} {p}");
            }
        }
    }
}

#[test]
fn a_cubic_is_followed_within_twenty_nanometres() {
    use crate::geom::CubicSpan;
    use glam::DVec2;
    let points = [[0.0, 0.0], [12.0, 3.0], [15.0, 14.0], [10.0, 20.0]].map(DVec2::from_array);
    let lead = Curve::cubic(CubicSpan::new(points).unwrap(), -4.0);
    let (t, end) = (lead.at(0.0).d1, lead.at(lead.length()));
    let entry = Line { start: lead.start() - t * 9.0, end: lead.start() };
    let exit = Line { start: end.p, end: end.p + end.d1 * 9.0 };
    let all: Vec<_> = [entry.into(), lead.clone(), exit.into()]
        .into_iter()
        .enumerate()
        .map(|(item, curve)| Programmed { item, curve })
        .collect();
    for d in [3.0, -3.0] {
        let path = compensate(&all[..2], all.last(), d, CompStart::AtEntry).unwrap();
        let mut points = 0;
        for piece in path.iter().filter(|p| p.item == 1) {
            for k in 0..=8 {
                let p = piece.curve.at(piece.curve.length() * f64::from(k) / 8.0).p;
                // The foot of the perpendicular by Newton from the nearest of many points.
                let off = |s: f64| lead.at(s).p.distance(p);
                let at = |i: u32| lead.length() * f64::from(i) / 400.0;
                let mut s = (0..=400).map(at).min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap();
                for _ in 0..6 {
                    let jet = lead.at(s);
                    let slope = 1.0 - (p - jet.p).dot(jet.d2);
                    s = (s + (p - jet.p).dot(jet.d1) / slope).clamp(0.0, lead.length());
                }
                assert!((off(s) - 3.0).abs() < 2e-5, "{s} {}", off(s));
                points += 1;
            }
        }
        assert!(points > 100, "{points}");
    }
}
