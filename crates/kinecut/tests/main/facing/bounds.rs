//! The certified bounds of the least burr against random placements: outlines of lines and arcs with holes, weights,
//! several bad intervals, guards, boxes of all sizes.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, dvec2};
use kinecut::base::{Code, Silent};
use kinecut::facing::optimum::{Options, box_bound, least_burr, objective_map};
use kinecut::facing::{BadPart, BadSet, FaceCase, Placement, bad_length};
use kinecut::geom::{Outline, OutlineEdge};
use proptest::prelude::*;

use crate::common::random::Random;
use crate::common::stop::Stop;
use kinecut_cases as cases;

/// A star-shaped loop about the origin whose sides are straight or bulge in or out, away from the origin by `shift`.
fn star(radii: &[(f64, f64)], size: f64, arcs: bool, shift: DVec2) -> Vec<OutlineEdge> {
    let n = radii.len();
    let point = |k: usize| {
        let at = TAU * (k % n) as f64 / n as f64;
        shift + size * radii[k % n].0 * DVec2::from_angle(at)
    };
    (0..n).map(|k| OutlineEdge::bulge(point(k), point(k + 1), if arcs { radii[k].1 } else { 0.0 })).collect()
}

fn bad_set(kind: u8, guard: f64) -> BadSet {
    let part = |from: f64, to: f64, weight| BadPart { from: from.to_radians(), to: to.to_radians(), weight };
    let set = match kind {
        0 => BadSet::below(0.5 * PI).unwrap(),
        1 => BadSet::below(60f64.to_radians()).unwrap().supplement(),
        2 => BadSet::new(vec![part(0.0, 30.0, 2.0), part(30.0, 75.0, 0.5), part(120.0, 150.0, 1.5)]).unwrap(),
        _ => BadSet::new(vec![part(0.0, 180.0, 1.0)]).unwrap(),
    };
    set.guarded(guard)
}

#[test]
fn no_optimum_hides_where_two_bad_intervals_touch() {
    let outline = Outline::polygon(&[
        dvec2(0.0, 0.0),
        dvec2(80.0, 0.0),
        dvec2(80.0, 30.0),
        dvec2(30.0, 30.0),
        dvec2(30.0, 60.0),
        dvec2(0.0, 60.0),
    ])
    .unwrap();
    let part = |from: f64, to: f64, weight| BadPart { from: from.to_radians(), to: to.to_radians(), weight };
    let bad = BadSet::new(vec![part(0.0, 90.0, 2.0), part(90.0, 120.0, 1.0)]).unwrap();
    let case = FaceCase::new(outline, 50.0, bad).unwrap();
    // The edge of 50 mm at y = 30 leaves at 90 degrees: beside that it counts once or twice, there the lesser.
    for (offset, value) in [(-30.000_001, 170.0), (-30.0, 170.0), (-29.999_999, 220.0)] {
        let found = bad_length(&case, Placement { angle: PI, offset });
        assert!((found - value).abs() < 1e-4, "{offset}: {found}");
    }
    let optimum = least_burr(&case, &Options::for_cutter(50.0), &Silent).unwrap();
    assert!(optimum.complete && optimum.lower_bound > 130.0, "{optimum:?}");
    let Placement { angle, offset } = optimum.placement;
    let around = [-1e-6, 1e-6].into_iter().flat_map(|a| [-1e-6, 1e-6].map(|b| (a, b)));
    let beside = around.map(|(a, b)| bad_length(&case, Placement { angle: angle + a, offset: offset + b }));
    let least = beside.fold(f64::INFINITY, f64::min);
    assert!((least - optimum.value).abs() < 0.1, "{least} beside {}", optimum.value);
}

prop_compose! {
    fn drawn()(
        radii in prop::collection::vec((0.6..1.0f64, -0.3..0.3f64), 3..9),
        hole in prop::collection::vec((0.15..0.3f64, -0.3..0.3f64), 3..5),
        bore in 0.05..0.12f64,
        arcs in prop::bool::weighted(0.75),
        kind in 0u8..4,
        guarded in prop::bool::ANY,
        weights in prop::collection::vec(0.0..3.0f64, 20),
        away in (-200.0..200.0f64, -200.0..200.0f64),
    ) -> Option<FaceCase> {
        let shift = dvec2(away.0, away.1);
        let loops = vec![
            star(&radii, 30.0, arcs, shift),
            star(&hole, 30.0, arcs, shift),
            if arcs { vec![OutlineEdge::arc(shift + dvec2(13.0, 3.0), 30.0 * bore, 0.3, TAU)] } else { vec![] },
        ];
        let outline = Outline::new(loops, vec![]).ok()?;
        let weights = weights[..outline.edges().len()].to_vec();
        FaceCase::new(outline, 50.0, bad_set(kind, if guarded { 0.04 } else { 0.0 })).unwrap()
            .with_weights(weights).ok()
    }
}

/// Those whose loops do not cross.
fn cases() -> impl Strategy<Value = FaceCase> {
    drawn().prop_filter_map("loops cross", |case| case)
}

/// A placement within the allowed ones near to the middle of a box.
fn within(
    case: &FaceCase,
    middle: Placement,
    spread: [f64; 2],
    at: [f64; 2],
    margin: f64,
) -> Option<Placement> {
    let [low, high] = case.outline.bounds();
    let about = 0.5 * (low + high);
    let height = |angle: f64| angle.sin() * about.x + angle.cos() * about.y;
    let local = middle.offset - height(middle.angle) + at[1] * spread[1];
    let angle = middle.angle + at[0] * spread[0];
    let offset = local + height(angle);
    let [least, most] = case.offsets(angle, margin);
    (least <= offset && offset <= most).then_some(Placement { angle, offset })
}

proptest! {
    #![proptest_config(kinecut_cases::property(400))]

    #[test]
    fn no_placement_of_a_box_is_below_its_bound(
        case in cases(),
        angle in 0.0..TAU, share in 0.0..1.0f64, fine in prop::array::uniform2(0.0..7.0f64),
        parallel in prop::option::of(0usize..20),
        points in prop::collection::vec(prop::array::uniform2(-0.5..0.5f64), 24),
    ) {
        let options = Options { margin: 1.0, ..Options::for_cutter(50.0) };
        // Some boxes hold an angle at which an edge is parallel to the feed.
        let edge = parallel.map(|k| case.outline.edges()[k % case.outline.edges().len()]);
        let angle = edge.map_or(angle, |e| angle * 1e-3 - e.heading(0.0));
        let [least, most] = case.offsets(angle, 1.0);
        prop_assume!(least < most);
        let middle = Placement { angle, offset: least + share * (most - least) };
        let spread = [10f64.powf(-fine[0]), 10.0 * 10f64.powf(-fine[1])];
        let bound = box_bound(&case, &options, middle, spread).unwrap();
        let slack = 1e-9 * case.weighted_perimeter();
        let parallel = edge.map(|e| [(-e.heading(0.0) - angle) / spread[0], 0.1]);
        for at in points.into_iter().chain([[0.0, 0.0], [0.5, 0.5], [-0.5, 0.5], [0.5, -0.5], [-0.5, -0.5]])
            .chain(parallel.filter(|p| p[0].abs() < 0.5))
        {
            if let Some(place) = within(&case, middle, spread, at, 1.0) {
                let value = bad_length(&case, place);
                prop_assert!(bound <= value + slack, "{bound} {value} {place:?} {middle:?} {spread:?}");
            }
        }
    }

    /// Halving a box brings the bound to the value; where the value is smooth, quadratically.
    #[test]
    fn bounds_of_small_boxes_are_near_the_value(case in cases(), angle in 0.0..TAU, share in 0.1..0.9f64) {
        let options = Options { margin: 1.0, ..Options::for_cutter(50.0) };
        let [least, most] = case.offsets(angle, 1.0);
        prop_assume!(least < most);
        let middle = Placement { angle, offset: least + share * (most - least) };
        let value = bad_length(&case, middle);
        let bound = box_bound(&case, &options, middle, [1e-9, 1e-8]).unwrap();
        prop_assert!(bound <= value + 1e-9 * case.weighted_perimeter());
        prop_assert!(value - bound <= 1e-4 * (1.0 + case.weighted_perimeter()), "{bound} {value}");
    }
}

/// The gear pump cover of the golden polygons with its circles as they are.
fn cover() -> Outline {
    let half = (22f64 * 22.0 - 14.0 * 14.0).sqrt().atan2(14.0);
    let (right, left) = (dvec2(14.0, 0.0), dvec2(-14.0, 0.0));
    let mut loops = vec![
        vec![
            OutlineEdge::line(dvec2(-14.0, 40.0), dvec2(14.0, 40.0)),
            OutlineEdge::arc(right, 40.0, 0.5 * PI, -PI),
            OutlineEdge::line(dvec2(14.0, -40.0), dvec2(-14.0, -40.0)),
            OutlineEdge::arc(left, 40.0, -0.5 * PI, -PI),
        ],
        vec![
            OutlineEdge::arc(left, 22.0, half, TAU - 2.0 * half),
            OutlineEdge::arc(right, 22.0, PI + half, TAU - 2.0 * half),
        ],
    ];
    for centre in [(46.0, 0.0), (-46.0, 0.0), (30.0, 28.0), (-30.0, 28.0), (30.0, -28.0), (-30.0, -28.0)] {
        loops.push(vec![OutlineEdge::arc(DVec2::from(centre), 3.5, 0.0, TAU)]);
    }
    Outline::new(loops, vec![]).unwrap()
}

/// The same with `sides` chords for a full turn.
fn with_chords(outline: &Outline, sides: f64) -> Outline {
    let chords = |edge: &OutlineEdge| {
        let n = edge.turn.map_or(1.0, |t| (t.sweep.abs() / TAU * sides).round());
        let edge = *edge;
        (0..n as usize).map(move |k| edge.at(k as f64 / n))
    };
    let loops =
        outline.loops().iter().map(|l| outline.edges()[l.edges.clone()].iter().flat_map(chords).collect());
    Outline::polygons(&loops.collect::<Vec<Vec<DVec2>>>()).unwrap()
}

/// Random placements of the cover, and descents from some of them, stay above the certified bound.
fn cover_against_random_placements(count: usize) {
    for (below, guard) in [(90f64, 0.0), (60.0, 0.0), (90.0, 2f64)] {
        let bad = BadSet::below(below.to_radians()).unwrap().guarded(guard.to_radians());
        let case = FaceCase::new(cover(), 50.0, bad).unwrap();
        let options = Options { irreducible: false, ..Options::for_cutter(50.0) };
        let best = least_burr(&case, &options, &Silent).unwrap();
        assert!(best.complete && best.gap() <= 1e-6 * case.weighted_perimeter());
        let mut random = Random(7);
        let value = |p: Placement| {
            let [least, most] = case.offsets(p.angle, options.margin);
            if least <= p.offset && p.offset <= most { bad_length(&case, p) } else { f64::INFINITY }
        };
        let mut lowest = f64::INFINITY;
        for k in 0..count {
            let angle = TAU * random.share();
            let [least, most] = case.offsets(angle, options.margin);
            let mut at = Placement { angle, offset: least + random.share() * (most - least) };
            let mut here = value(at);
            let mut step = if k % 60 == 0 { 0.1 } else { 0.0 };
            while step > 1e-6 {
                let direction = DVec2::from_angle(TAU * random.share());
                let next = Placement {
                    angle: at.angle + step * direction.x,
                    offset: at.offset + 40.0 * step * direction.y,
                };
                let there = value(next);
                if there < here {
                    (at, here) = (next, there);
                } else {
                    step *= 0.95;
                }
            }
            lowest = if here < lowest { here } else { lowest };
        }
        assert!(lowest >= best.lower_bound, "{lowest} {}", best.lower_bound);
        assert!(lowest <= best.value * 1.02, "{lowest} {}", best.value);
    }
}

#[test]
fn the_bound_of_the_cover_with_true_circles_holds_against_random_placements() {
    cover_against_random_placements(cases::cases(20_000, 1_000_000) as usize);
}

/// The optimum of the true circles is the limit of those of ever finer chords, which differ from it by some share of
/// the length over the number of sides: each chord has one normal.
#[test]
fn optima_with_finer_chords_tend_to_the_one_with_true_circles() {
    let bad = BadSet::below(0.5 * PI).unwrap();
    let options = Options { irreducible: false, tolerance: 3e-5, ..Options::for_cutter(50.0) };
    let value = |outline: Outline| {
        let case = FaceCase::new(outline, 50.0, bad.clone()).unwrap();
        least_burr(&case, &options, &Silent).unwrap().value
    };
    let exact = value(cover());
    for sides in [48.0, 96.0, 192.0] {
        let apart = (value(with_chords(&cover(), sides)) - exact).abs();
        assert!(apart < 1.3 * exact / sides, "{sides} {exact} {apart}");
    }
}

/// Constraints by their definition, on dense points of the outline.
#[test]
fn constraints_hold_and_nothing_allowed_is_better() {
    let case = FaceCase::new(cover(), 60.0, BadSet::below(1.2).unwrap()).unwrap();
    let options = Options {
        margin: 0.5,
        forbidden: vec![[-0.3, 0.9], [2.0, 3.5]],
        engagement: [-0.9, 1.3],
        least_off_middle: 2.0,
        tolerance: 1e-4,
        irreducible: false,
        ..Options::for_cutter(60.0)
    };
    let best = least_burr(&case, &options, &Silent).unwrap();
    let points: Vec<DVec2> =
        case.outline.edges().iter().flat_map(|e| (0..100).map(|k| e.at(f64::from(k) / 100.0))).collect();
    let allowed = |p: Placement, slack: f64| {
        let (sin, cos) = p.angle.sin_cos();
        let heights = points.iter().map(|q| sin * q.x + cos * q.y);
        let (low, high) = heights.fold((f64::MAX, f64::MIN), |(l, h), y| (l.min(y), h.max(y)));
        let turned = |[from, to]: [f64; 2]| (p.angle - from).rem_euclid(TAU) < (to - from) - slack;
        high - p.offset <= 59.5f64.min(60.0 * 1.3f64.sin()) + slack
            && p.offset - low <= 59.5f64.min(60.0 * 0.9f64.sin()) + slack
            && (p.offset - 0.5 * (low + high)).abs() >= 2.0 - slack
            && !options.forbidden.iter().any(|f| turned(*f) && (p.angle - f[0]).rem_euclid(TAU) > slack)
    };
    assert!(best.complete && allowed(best.placement, 0.02), "{best:?}");
    let (mut some, mut lowest) = (0, f64::MAX);
    for i in 0..500 {
        for j in 0..60 {
            let p = Placement { angle: TAU * f64::from(i) / 500.0, offset: -15.0 + 0.5 * f64::from(j) };
            if allowed(p, -0.02) {
                some += 1;
                lowest = lowest.min(bad_length(&case, p));
            }
        }
    }
    assert!(
        some > 1000 && lowest >= best.lower_bound && lowest < 1.03 * best.value,
        "{some} {lowest} {best:?}"
    );
    for other in &best.alternatives {
        assert!(allowed(other.placement, 0.02) && other.value >= best.lower_bound);
        assert!((bad_length(&case, other.placement) - other.value).abs() < 1e-9);
    }
}

fn plate(width: f64, height: f64) -> FaceCase {
    let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)].map(DVec2::from);
    FaceCase::new(Outline::polygon(&corners).unwrap(), 50.0, BadSet::below(1.2).unwrap()).unwrap()
}

#[test]
fn a_part_that_is_too_wide_says_how_many_passes_it_needs() {
    let options = Options::for_cutter(50.0);
    let error = least_burr(&plate(200.0, 120.0), &options, &Silent).unwrap_err();
    assert_eq!(error.code(), Code::FACE_TOO_WIDE);
    let text = error.to_string();
    assert!(text.contains("120 mm, bound 98 mm") && text.contains("2 passes"), "{text}");
    // It fits lengthwise by a hair: two orientations of a few hundredths of a degree.
    let tight = least_burr(&plate(200.0, 97.99), &options, &Silent).unwrap();
    assert!(tight.complete && tight.placement.angle.sin().abs() < 1e-3, "{tight:?}");
    let forbidden = Options { forbidden: vec![[-0.5, 0.5], [PI - 0.5, PI + 0.5]], ..options.clone() };
    assert_eq!(least_burr(&plate(200.0, 60.0), &forbidden, &Silent).unwrap_err().code(), Code::FACE_TOO_WIDE);
    let all = Options { forbidden: vec![[0.0, TAU]], ..options.clone() };
    assert_eq!(least_burr(&plate(80.0, 60.0), &all, &Silent).unwrap_err().code(), Code::FACE_CASE);
    let centred = Options { least_off_middle: 30.0, ..options };
    assert_eq!(least_burr(&plate(80.0, 60.0), &centred, &Silent).unwrap_err().code(), Code::FACE_TOO_WIDE);
}

/// The certified least of each loop holds at random placements of the whole part.
#[test]
fn no_placement_avoids_the_irreducible_part() {
    let case = FaceCase::new(cover(), 50.0, BadSet::below(0.5 * PI).unwrap()).unwrap();
    let best = least_burr(&case, &Options { tolerance: 1e-3, ..Options::for_cutter(50.0) }, &Silent).unwrap();
    assert_eq!(best.irreducible.len(), 8);
    assert!(best.irreducible_length() <= best.value);
    let mut random = Random(3);
    let mut lowest = [f64::MAX; 8];
    for _ in 0..cases::cases(4000, 40_000) {
        let angle = TAU * random.share();
        let [least, most] = case.offsets(angle, 1.0);
        if least > most {
            continue;
        }
        let place = Placement { angle, offset: least + random.share() * (most - least) };
        for (k, one) in case.outline.loops().iter().enumerate() {
            let mut weights = vec![0.0; case.weights.len()];
            weights[one.edges.clone()].fill(1.0);
            let own = FaceCase { weights, ..case.clone() };
            lowest[k] = lowest[k].min(bad_length(&own, place));
        }
    }
    for (one, lowest) in best.irreducible.iter().zip(lowest) {
        assert!(one.length <= lowest && one.length > 0.97 * lowest - 0.1, "{one:?} {lowest}");
    }
    // A small hole: nearly a quarter of its rim for a threshold of 90 degrees.
    assert!((0.2..0.25).contains(&best.irreducible[2].share), "{:?}", best.irreducible);
}

#[test]
fn errors_of_set_up_are_told_apart_from_the_optimum() {
    let square = FaceCase { bad: BadSet::below(0.5 * PI).unwrap(), ..plate(60.0, 60.0) };
    let best = least_burr(&square, &Options::for_cutter(50.0), &Silent).unwrap();
    let parallel = Placement { angle: 0.0, offset: 30.0 };
    let turned = best.placement.angle.rem_euclid(0.5 * PI);
    assert_eq!(best.sensitivity.feed_parallel.is_empty(), turned.min(0.5 * PI - turned) > 1e-9);
    assert!(best.sensitivity.worst >= best.value && best.sensitivity.worst <= square.weighted_perimeter());
    let at = best.sensitivity.worst_at;
    assert!((bad_length(&square, at) - best.sensitivity.worst).abs() < 1e-9);
    assert!(best.value <= bad_length(&square, parallel));
}

/// The same bytes on one thread and on several; stopped early, the best so far with its gap.
#[test]
fn results_do_not_depend_on_threads_and_cancelling_gives_the_best_so_far() {
    let case = FaceCase::new(cover(), 50.0, BadSet::below(1.0).unwrap()).unwrap();
    let options = Options { irreducible: false, tolerance: 1e-4, ..Options::for_cutter(50.0) };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| least_burr(&case, &options, &Silent).unwrap())
    };
    let one = run(1);
    assert_eq!(one, run(4));
    let stopped = least_burr(&case, &options, &Stop).unwrap();
    assert!(!stopped.complete && stopped.gap() > 0.0 && stopped.lower_bound <= one.value);
    assert!(stopped.value >= one.lower_bound);
    let few = least_burr(&case, &Options { max_nodes: 200, ..options }, &Silent).unwrap();
    assert!(!few.complete && few.nodes < 400 && few.lower_bound <= one.value);
}

#[test]
fn the_map_has_the_values_of_the_closed_form() {
    let case = plate(80.0, 97.0);
    let options = Options { forbidden: vec![[1.0, 2.0]], least_off_middle: 0.2, ..Options::for_cutter(50.0) };
    let map = objective_map(&case, &options, 36, 9).unwrap();
    assert_eq!((map.values.len(), map.offsets.len()), (36 * 9, 36));
    let mut some = 0;
    for i in 0..36usize {
        let angle = TAU * i as f64 / 36.0;
        let [least, most] = map.offsets[i];
        let [want_least, want_most] = case.offsets(angle, options.margin);
        let open = least <= most;
        assert_eq!(open, want_most - want_least >= 0.4 && !(angle > 1.0 && angle < 2.0), "{i}");
        for j in 0..9usize {
            let value = map.values[9 * i + j];
            let offset = least + (most - least) * j as f64 / 8.0;
            if let Some(value) = value {
                some += 1;
                assert!((value - bad_length(&case, Placement { angle, offset })).abs() < 1e-9);
                assert!((least - want_least).abs() < 1e-9 && (most - want_most).abs() < 1e-9);
            }
            // Positions near the middle of the range are shut.
            let off_middle = (most - least) * (j as f64 / 8.0 - 0.5).abs();
            assert_eq!(value.is_some(), open && off_middle >= 0.2, "{i} {j}");
        }
    }
    assert!(some > 20);
}
