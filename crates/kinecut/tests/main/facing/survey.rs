//! The paper's program: its optimiser against the certified optima, the graph of the largest exit angle, the pictures.

use std::f64::consts::{PI, TAU};

use glam::DVec2;
use kinecut::base::{Code, Progress, Silent};
use kinecut::facing::optimum::{AllowedPlacements, Options, least_burr};
use kinecut::facing::{
    BadSet, DescentStatistics, FaceCase, NelderMead, Objective, OffsetRule, Placement, ToothedPass,
    bad_length, descend, descents, exit_stretches, largest_exit_angle, pictures, random_placements, survey,
};
use kinecut::geom::{Outline, OutlineEdge};

use crate::common::burr_golden::Golden;
use crate::common::stop::Stop;

fn plate_with_arcs() -> FaceCase {
    let at = |x, y| DVec2::new(x, y);
    let (a, b, c, d) = (at(-40.0, -25.0), at(35.0, -30.0), at(45.0, 20.0), at(-30.0, 30.0));
    let outer = vec![
        OutlineEdge::bulge(a, b, 0.2),
        OutlineEdge::line(b, c),
        OutlineEdge::bulge(c, d, 0.5),
        OutlineEdge::bulge(d, a, -0.3),
    ];
    let bore = vec![OutlineEdge::arc(at(8.0, 2.0), 11.0, 0.5, TAU)];
    let outline = Outline::new(vec![outer, bore], vec![]).unwrap();
    FaceCase::new(outline, 75.0, BadSet::below(80f64.to_radians()).unwrap()).unwrap()
}

fn margin(margin: f64) -> Options {
    Options { margin, ..Options::for_cutter(75.0) }
}

#[test]
fn descents_stay_within_the_constraints_of_the_placement_and_above_their_optimum() {
    let corners = [[0.0, 0.0], [80.0, 0.0], [80.0, 30.0], [30.0, 30.0], [30.0, 60.0], [0.0, 60.0]];
    let outline = Outline::polygon(&corners.map(DVec2::from)).unwrap();
    let case = FaceCase::new(outline, 50.0, BadSet::below(90f64.to_radians()).unwrap()).unwrap();
    let free = Options::for_cutter(50.0);
    let sixty = 60f64.to_radians();
    let forbidden = vec![[80f64.to_radians(), 280f64.to_radians()]];
    let narrow = Options { engagement: [-sixty, sixty], forbidden, ..free.clone() };
    let beside = Options { least_off_middle: 9.0, ..free.clone() };
    for options in [narrow, beside] {
        let optimum = least_burr(&case, &options, &Silent).unwrap();
        let allowed = AllowedPlacements::new(&case, &options).unwrap();
        let all = descents(&case, &Objective::Limit, &NelderMead::within(&options), 40, 7, &Silent).unwrap();
        for d in &all {
            assert!(d.value >= optimum.lower_bound - 1e-6, "{d:?} below {}", optimum.lower_bound);
            assert!(d.is_allowed(&case) && allowed.shortfall(d.start) < 1e-9);
            // By hand: every corner is in the cutter's front within the engagement, the angle in none forbidden.
            let Placement { angle, offset } = d.placement;
            let heights = corners.map(|[x, y]| x * angle.sin() + y * angle.cos() - offset);
            let [lo, hi] = options.engagement.map(|a| (50.0 * a.sin()).clamp(-49.0, 49.0));
            assert!(heights.iter().all(|h| lo - 1e-6 < *h && *h < hi + 1e-6), "{d:?} {heights:?}");
            let turn = angle.to_degrees().rem_euclid(360.0);
            assert!(options.forbidden.is_empty() || !(80.0 + 1e-6..280.0 - 1e-6).contains(&turn), "{turn}");
            let middle = 0.5 * heights.iter().fold(f64::NEG_INFINITY, |a, h| a.max(*h))
                + 0.5 * heights.iter().fold(f64::INFINITY, |a, h| a.min(*h));
            assert!(middle.abs() > options.least_off_middle - 1e-6, "{middle}");
        }
        // Without the constraints the same method ends beside them: the test can fail.
        let others = descents(&case, &Objective::Limit, &NelderMead::within(&free), 40, 7, &Silent).unwrap();
        assert!(others.iter().any(|d| allowed.shortfall(d.placement) > 0.1));
    }
    let nothing = Options { forbidden: vec![[0.0, TAU]], ..free };
    assert_eq!(random_placements(&case, &nothing, 1, 1).unwrap_err().code(), Code::FACE_TOO_WIDE);
}

#[test]
fn descents_end_above_the_certified_optimum_and_about_where_the_papers_did() {
    let golden = Golden::read();
    let (mut share, mut want_share, mut compared) = (0.0, 0.0, 0.0);
    for (name, polygon) in &golden.polygons {
        let want = polygon.nelder_mead_psi0_90_guard_0.as_ref().unwrap();
        let o = polygon.optima.iter().find(|o| o.psi0_deg == 90.0 && o.guard_deg == 0.0).unwrap();
        let case = FaceCase::new(polygon.outline(), o.radius, BadSet::below(PI / 2.0).unwrap()).unwrap();
        let starts = if case.outline.edges().len() > 60 { 8 } else { 30 };
        let options = NelderMead::with_margin(o.margin);
        let all = descents(&case, &Objective::Limit, &options, starts, 7, &Silent).unwrap();
        for d in &all {
            assert!(
                d.value <= bad_length(&case, d.start) && d.value >= o.certified_lower - 1e-9 * o.perimeter
            );
            assert!((bad_length(&case, d.placement) - d.value).abs() < 1e-9 * o.perimeter, "{name}");
            let [low, high] = case.offsets(d.placement.angle, o.margin);
            assert!(low <= d.placement.offset + 2e-9 && d.placement.offset <= high + 2e-9);
        }
        let have = DescentStatistics::of(&all, o.value).unwrap();
        assert!(have.best <= want.median + 1e-6 && have.worst <= 1.6 * want.worst, "{name}: {have:?}");
        assert!(have.median < want.worst && have.median > want.best - 1e-6, "{name}: {have:?}");
        share += have.within_one_percent;
        want_share += want.within_1pct;
        compared += 1.0;
    }
    assert!(((share - want_share) / compared).abs() < 0.1, "{share} {want_share} of {compared}");
}

#[test]
fn descents_are_the_same_for_the_same_seed_and_stop_when_asked() {
    let case = plate_with_arcs();
    let options = NelderMead::with_margin(1.0);
    let run = |seed, progress: &dyn Progress| descents(&case, &Objective::Limit, &options, 9, seed, progress);
    assert_eq!(run(3, &Silent).unwrap(), run(3, &Silent).unwrap());
    assert_ne!(run(3, &Silent).unwrap(), run(4, &Silent).unwrap());
    assert_eq!(run(3, &Stop).unwrap_err().code(), Code::CANCELLED);
    let small = FaceCase { radius: 30.0, ..case.clone() };
    assert_eq!(random_placements(&small, &margin(1.0), 3, 1).unwrap_err().code(), Code::FACE_TOO_WIDE);
}

#[test]
fn random_starts_cover_the_part_and_all_orientations() {
    let case = plate_with_arcs();
    let starts = random_placements(&case, &margin(1.0), 2000, 11).unwrap();
    let mut eighths = [0; 8];
    let mut shares = 0.0;
    for s in &starts {
        let [low, high] = case.offsets(s.angle, 1.0);
        assert!(low <= s.offset && s.offset <= high);
        eighths[(s.angle / TAU * 8.0) as usize] += 1;
        shares += (s.offset - low) / (high - low);
    }
    assert!(eighths.iter().all(|&n| n > 190 && n < 310), "{eighths:?}");
    assert!((shares / 2000.0 - 0.5).abs() < 0.03);
}

#[test]
fn descents_with_real_teeth_lower_their_own_objective() {
    let case = plate_with_arcs();
    let placement = Placement { angle: 0.0, offset: 0.0 };
    let teeth = ToothedPass::even(4, 75.0, 0.2, placement).unwrap();
    let (feed_per_radian, along) = (teeth.feed_per_radian, 0.0);
    let objective = Objective::Teeth { teeth: teeth.teeth, feed_per_radian, along };
    for start in random_placements(&case, &margin(1.0), 6, 5).unwrap() {
        let end = descend(&case, &objective, &NelderMead::with_margin(1.0), start).unwrap();
        let first = objective.value(&case, start).unwrap();
        assert!(end.value < first - 0.1, "{first} {end:?}");
        assert_eq!(end.value, objective.value(&case, end.placement).unwrap());
        // It seeks out the ripple: a cell at a tangency is as long as the root of 2 R feed, 5.5 mm.
        let limit = bad_length(&case, end.placement);
        assert!((end.value - limit).abs() < 12.0, "{limit} {end:?}");
    }
}

#[test]
fn exit_stretches_are_the_bad_length_and_bound_the_exit_angles_of_fine_teeth() {
    let case = plate_with_arcs();
    for i in 0..24 {
        let angle = 0.05 + TAU * f64::from(i) / 24.0;
        let [low, high] = case.offsets(angle, 1.0);
        let placement = Placement { angle, offset: low + f64::from(i * 5 % 24) / 24.0 * (high - low) };
        let stretches = exit_stretches(&case, placement);
        let length =
            |s: &kinecut::facing::ExitStretch| (s.to - s.from) * case.outline.edges()[s.edge].length();
        let bad: f64 = stretches.iter().map(|s| length(s) * s.weight).sum();
        assert!((bad - bad_length(&case, placement)).abs() < 1e-9);
        for w in stretches.windows(2).filter(|w| w[0].edge == w[1].edge) {
            assert!(w[0].to <= w[1].from + 1e-12);
        }
        let feed = 1e-3;
        let pass = ToothedPass::even(1, case.radius, feed * TAU, placement).unwrap();
        let near = 2.0 * feed / case.radius;
        let (mut least, mut most) = (vec![9.0; stretches.len()], vec![-9.0; stretches.len()]);
        let mut largest: f64 = 0.0;
        pass.visit(&case.outline, |c| {
            if !(c.front && c.exit) {
                return;
            }
            let psi = c.exit_angle();
            largest = largest.max(psi);
            let on = |s: &kinecut::facing::ExitStretch| {
                s.edge == c.edge as usize && s.from + 1e-3 < c.share && c.share < s.to - 1e-3
            };
            let Some(i) = stretches.iter().position(on) else { return };
            let [from, to] = stretches[i].exit_angles;
            assert!(from - near < psi && psi < to + near, "{psi} beyond {:?}", stretches[i]);
            least[i] = psi.min(least[i]);
            most[i] = psi.max(most[i]);
        });
        for (s, (least, most)) in stretches.iter().zip(least.into_iter().zip(most)) {
            // Away from tangencies teeth come to every angle of a stretch.
            let [from, to] = s.exit_angles;
            if most > 0.0 && from > 0.1 && to < PI - 0.1 {
                assert!(least - from < 0.05 && to - most < 0.05, "{least} {most} {s:?}");
            }
        }
        assert!((largest - largest_exit_angle(&case, placement)).abs() < 0.05);
    }
}

#[test]
fn a_survey_of_real_teeth_is_near_that_of_the_limit() {
    let case = plate_with_arcs();
    let limit = survey(&case, &Objective::Limit, OffsetRule::Share(0.3), 1.0, 90, &Silent).unwrap();
    let placement = Placement { angle: 0.0, offset: 0.0 };
    let teeth = ToothedPass::even(2, 75.0, 0.02, placement).unwrap();
    let (feed_per_radian, along) = (teeth.feed_per_radian, 0.4);
    let objective = Objective::Teeth { teeth: teeth.teeth, feed_per_radian, along };
    let real = survey(&case, &objective, OffsetRule::Share(0.3), 1.0, 90, &Silent).unwrap();
    for (i, (a, b)) in limit.iter().zip(&real).enumerate() {
        assert!((a.placement.angle - TAU * i as f64 / 90.0).abs() < 1e-12 && a.placement == b.placement);
        assert!(a.covered && (a.bad - b.bad).abs() < 2.0, "{a:?} {b:?}");
        assert!((a.largest_exit_angle - b.largest_exit_angle).abs() < 0.1, "{a:?} {b:?}");
    }
    let beside = survey(&case, &Objective::Limit, OffsetRule::Beside(200.0), 1.0, 4, &Silent).unwrap();
    assert!(beside.iter().all(|p| !p.covered && p.bad == 0.0 && p.largest_exit_angle == 0.0));
}

#[test]
fn pictures_show_the_front_on_the_outline_with_angles_of_the_velocity() {
    let case = plate_with_arcs().with_weights(vec![1.0, 2.0, 1.0, 1.0, 5.0]).unwrap();
    let placement = Placement { angle: 0.9, offset: 4.0 };
    let picture = &pictures(&case, &[placement], 40)[0];
    assert_eq!(picture.positions.len(), 40);
    assert_eq!(picture.bad, bad_length(&case, placement));
    let moved = case.outline.moved(placement.angle, DVec2::ZERO);
    let mut exits = 0;
    for position in &picture.positions {
        let centre = DVec2::from(position.centre);
        // Inside and outside alternate along the front from its lower to its upper end.
        let front = |k: i32| {
            let angle = (f64::from(k) / 2000.0 - 0.5) * PI;
            moved.contains(centre + case.radius * DVec2::from_angle(angle))
        };
        let changes = (0..2000).filter(|&k| front(k) != front(k + 1)).count();
        assert_eq!(position.crossings.len(), changes, "{position:?}");
        for c in &position.crossings {
            let out = DVec2::from(c.point) - centre;
            assert!((out.length() - case.radius).abs() < 1e-9 && out.x > 0.0);
            // M3: a little later the tooth is clockwise of here.
            let later = centre + DVec2::from_angle(-1e-6).rotate(out);
            assert_eq!(moved.contains(later), !(0.0..PI).contains(&c.exit_angle), "{c:?}");
            let bad = (0.0..80f64.to_radians()).contains(&c.exit_angle);
            assert_eq!(c.weight, if bad { case.weights[c.edge] } else { 0.0 });
            exits += usize::from(bad);
        }
    }
    assert!(exits > 5, "{exits}");
}
