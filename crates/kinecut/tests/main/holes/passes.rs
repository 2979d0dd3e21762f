//! The passes of a hole as they are run: the numbers of the paper, the records, and samples that agree with the path and with each other.

use std::f64::consts::TAU;

use kinecut::holes::compare::PassRun;
use kinecut::verbs::hole::{HolePass, HolePlan, HoleSamples, plan_hole, plan_hole_sheet, read_holes};

fn text(strategy: &str, entry: &str, finish: &str) -> String {
    format!(
        "tool = {{ number = 1, type = \"end-mill\", diameter = 40, flute_length = 45, teeth = 4, centre_cutting = true }}\n\
         post = {{ control = \"heidenhain\" }}\n[operation]\ntype = \"bore\"\ntool = 1\nat = [300, -20]\n\
         diameter = 200\ndepth = 30\nstrategy = \"{strategy}\"\nentry = {entry}\nspeed = 2400\n\
         rough = {{ stepover = 4, allowance = 1, feed = 6000, engagement = 60 }}\n\
         finish = {{ turns = 2, feed = 3000, {finish} }}\n"
    )
}

fn planned(text: String, samples: HoleSamples) -> HolePlan {
    let table = read_holes("hole.toml", text).unwrap().item(0).unwrap();
    plan_hole_sheet(&table, samples).unwrap_or_else(|e| panic!("{e}"))
}

fn paper(samples: HoleSamples) -> HolePlan {
    planned(text("involute", "\"plunge\"", "start = [260, 20]"), samples)
}

fn pass<'a>(plan: &'a HolePlan, name: &str) -> &'a HolePass {
    plan.passes.iter().find(|p| p.pass == name).unwrap()
}

fn near(found: f64, printed: f64, half_a_digit: f64) {
    assert!((found - printed).abs() <= half_a_digit, "{found}, printed {printed}");
}

#[test]
fn the_numbers_of_the_paper() {
    let plan = paper(HoleSamples::All);
    assert_eq!((plan.at, plan.diameter, plan.cutter_diameter), ([300.0, -20.0], 200.0, 40.0));
    let finish = pass(&plan, "finish");
    let figure = finish.figure.as_ref().unwrap();
    near(finish.roll, 9.04481, 5.1e-6);
    near(figure.psi, 0.946567, 5.1e-7);
    near(figure.touch[0], 64.913, 5.1e-4);
    near(figure.touch[1], -46.758, 5.1e-4);
    near(finish.length, 242.250, 5.1e-4);
    near(finish.start_curvature_radius, 57.581, 5.1e-4);
    near(finish.circle_length, 502.655, 5.1e-4);
    near(finish.turns, 0.5605, 5.1e-5);
    near(figure.visible_turns_formula, 0.5858, 5.1e-5);
    // The start is that of the file, about the bore's centre; turned back by psi it is on the involute for psi = 0.
    near(figure.start[0], -40.0, 1e-9);
    near(figure.start[1], 40.0, 1e-9);
    let rough = pass(&plan, "rough");
    assert_eq!((rough.path_radius, rough.whole_turns, rough.step), (79.0, 20.0, 3.95));
    near(rough.base_radius, 0.628662, 5.1e-7);
    near(rough.length, 4963.716, 5.1e-4);
    near(rough.circle_length, 496.372, 5.1e-4);
}

#[test]
fn the_records_of_the_paper_with_the_columns_that_were_lost() {
    let plan = paper(HoleSamples::None);
    let [lead, circle] = &pass(&plan, "finish").curves[..] else { panic!() };
    assert_eq!((lead.kind, circle.kind), ("involute", "arc"));
    near(lead.start_angle, 9.99138208933461, 1e-12);
    near(lead.end_radius.unwrap(), 80.0, 1e-12);
    near(lead.base_centre.unwrap()[0], -3.72086336549746, 1e-9);
    near(lead.base_centre.unwrap()[1], -5.16562186694245, 1e-9);
    near(circle.start[0], 64.9131188336368, 1e-9);
    near(circle.start_angle, 0.946567321657524, 1e-12);
}

#[test]
fn samples_are_given_of_the_passes_that_are_asked_for() {
    let runs = |samples| {
        let plan = paper(samples);
        assert_eq!(plan.limits.is_some(), samples != HoleSamples::None);
        ["rough", "finish"].map(|name| pass(&plan, name).run.is_some())
    };
    assert_eq!(runs(HoleSamples::None), [false, false]);
    assert_eq!(runs(HoleSamples::Rough), [true, false]);
    assert_eq!(runs(HoleSamples::Finish), [false, true]);
    assert_eq!(runs(HoleSamples::All), [true, true]);
    let table = read_holes("hole.toml", text("involute", "\"plunge\"", "")).unwrap().item(0).unwrap();
    assert!(plan_hole(&table).unwrap().passes.iter().all(|p| p.run.is_none() && p.figure.is_none()));
}

/// Place of a way at an arc length, between two of its points.
fn place(run: &PassRun, s: f64) -> [f64; 2] {
    let way = &run.way;
    let i = way.s.partition_point(|v| *v <= s).clamp(1, way.s.len() - 1);
    let share = if way.s[i] > way.s[i - 1] { (s - way.s[i - 1]) / (way.s[i] - way.s[i - 1]) } else { 0.0 };
    [&way.x, &way.y].map(|v| v[i - 1] + (v[i] - v[i - 1]) * share)
}

/// Rules of every run.
fn holds(run: &PassRun, what: &str) {
    let samples = &run.samples;
    let last = samples.s.len() - 1;
    assert!(last > 200, "{what}: {last}");
    for columns in [&samples.s, &samples.time, &run.way.s] {
        assert!(columns.windows(2).all(|w| w[1] >= w[0]), "{what}");
    }
    // From rest to rest, the whole way, in the time of the run; six digits are kept.
    assert_eq!((samples.s[0], samples.speed[0], samples.speed[last]), (0.0, 0.0, 0.0), "{what}");
    near(samples.s[last], run.length, 1e-5 * run.length);
    near(samples.time[last], run.time, 1e-5 * run.time);
    near(run.way.s[run.way.s.len() - 1], run.length, 1e-5 * run.length);
    // No peak is lost.
    let most = |of: &dyn Fn(usize) -> f64| (0..=last).map(of).fold(0.0, f64::max);
    let kept = [
        (most(&|i| samples.speed[i]), run.peaks.speed),
        (most(&|i| samples.along[i].abs()), run.peaks.along),
        (most(&|i| samples.acceleration[i]), run.peaks.acceleration),
    ];
    let jerks = [
        (most(&|i| samples.jerk_along[i].unwrap_or(0.0).abs()), run.peaks.jerk_along),
        (most(&|i| samples.jerk[i].unwrap_or(0.0)), run.peaks.jerk),
    ];
    let known = jerks.into_iter().filter_map(|(kept, peak)| Some((kept, peak?)));
    for (kept, peak) in kept.into_iter().chain(known) {
        near(kept, peak, 1e-5 * peak);
    }
    for i in 0..=last {
        // By the path: v^2 k across it, where the control does not leave it.
        let (v, k) = (samples.speed[i], samples.curvature[i].unwrap_or(0.0));
        let across = (samples.acceleration[i].powi(2) - samples.along[i].powi(2)).max(0.0).sqrt();
        let by_path = v * v * k.abs();
        if run.smoothed == Some(0) && run.stops == Some(0) {
            assert!(
                (across - by_path).abs() < 0.02 * run.peaks.acceleration,
                "{what} {i}: {across} {by_path}"
            );
        }
    }
    assert!(run.peaks.axis_acceleration <= 5000.0 * 1.001, "{what}: {}", run.peaks.axis_acceleration);
    assert!(run.peaks.axis_jerk.is_none_or(|jerk| jerk <= 1e5 * 1.001), "{what}");
}

#[test]
fn on_the_circle_the_motion_is_that_of_a_circle() {
    let plan = paper(HoleSamples::All);
    for (name, radius, feed) in [("rough", 79.0, 100.0), ("finish", 80.0, 50.0)] {
        let one = pass(&plan, name);
        let run = one.run.as_ref().unwrap();
        holds(run, name);
        let middle = one.length + 0.4 * one.circle_length;
        let i = run.samples.s.partition_point(|s| *s < middle);
        near(run.samples.speed[i], feed, 1e-3);
        near(run.samples.acceleration[i], feed * feed / radius, 1e-3);
        near(run.samples.jerk[i].unwrap(), feed.powi(3) / (radius * radius), 1e-3);
        near(run.samples.curvature[i].unwrap(), 1.0 / radius, 1e-7);
        near(run.samples.along[i], 0.0, 1e-6);
        // The contact is G2, and the jerk steps by F^3 r / R^3.
        let closing = run.closing.unwrap();
        assert_eq!(closing.contact, "G2");
        near(closing.steps.jerk.unwrap(), feed.powi(3) / (TAU * one.whole_turns * radius * radius), 1e-9);
        let [x, y] = place(run, one.length);
        near(x.hypot(y), radius, 2e-3);
    }
    // Before the wall is met nothing is cut; on it the allowance of 1 mm, by the formula for parallel walls.
    let finish = pass(&plan, "finish").run.as_ref().unwrap();
    let at = |s: f64| finish.samples.engagement[finish.samples.s.partition_point(|v| *v < s)];
    assert_eq!(at(50.0), Some(0.0));
    near(at(300.0).unwrap(), kinecut::holes::engagement_formula(80.0, 20.0, 1.0), 2e-3);
    // The way out is not measured.
    assert_eq!(at(900.0), None);
    near(finish.measured.unwrap()[1], 242.2497 + 502.6548, 1e-3);
}

#[test]
fn every_strategy_is_sampled() {
    for strategy in ["involute", "lens-1", "lens-2", "constant-engagement", "archimedean", "arcs-2", "arcs-4"]
    {
        let plan = planned(text(strategy, "{ helix = { radius = 10, pitch = 2 } }", ""), HoleSamples::Rough);
        let run = pass(&plan, "rough").run.as_ref().unwrap();
        holds(run, strategy);
        assert!(run.closing.is_some() && run.peaks.engagement.unwrap() < 1.8, "{strategy}");
        // The foot of the helix comes before, and there nothing is measured.
        let [from, to] = run.measured.unwrap();
        near(from, TAU * pass(&plan, "rough").entry_radius, 1e-6);
        assert_eq!(run.samples.engagement[run.samples.s.partition_point(|s| *s < 0.5 * from)], None);
        // Where the circle at the wall begins, the step of the last turn is cut; at its end nothing is left.
        let at = |s: f64| run.samples.engagement[run.samples.s.partition_point(|v| *v < s) - 1].unwrap();
        if strategy == "involute" {
            let wall = kinecut::holes::engagement_formula(79.0, 20.0, pass(&plan, "rough").step);
            near(at(run.closing.unwrap().s), wall, 0.02);
        }
        near(at(to), 0.0, 0.1);
    }
    for strategy in ["rings", "rings-tangent", "trochoidal", "ramping"] {
        let plan = planned(text(strategy, "\"plunge\"", ""), HoleSamples::Rough);
        let run = pass(&plan, "rough").run.as_ref().unwrap();
        holds(run, strategy);
        // A ramp also goes down: its load in the plane is not that of its cut.
        assert_eq!(run.measured.is_none(), strategy == "ramping", "{strategy}");
    }
}

#[test]
fn the_figure_of_a_clockwise_path_is_the_mirror_image() {
    let base = text("involute", "\"plunge\"", "start = [340, 20]");
    let plan =
        planned(base.replace("depth = 30", "depth = 30\ndirection = \"conventional\""), HoleSamples::Finish);
    assert!(plan.clockwise);
    let figure = pass(&plan, "finish").figure.as_ref().unwrap();
    near(figure.psi, 0.946567, 5.1e-7);
    near(figure.touch[0], -64.913, 5.1e-4);
    near(figure.touch[1], -46.758, 5.1e-4);
}

fn on_control(strategy: &str, interpolator: &str) -> HolePlan {
    let limits = "dynamics = { rapid = 60000, acceleration = 5, jerk = 100, interpolator = \"";
    let keys = text(strategy, "{ helix = { radius = 10, pitch = 2 } }", "");
    planned(format!("{limits}{interpolator}\" }}\n{keys}"), HoleSamples::Rough)
}

/// The sample nearest to a way.
fn sample(run: &PassRun, s: f64) -> usize {
    let all = &run.samples.s;
    (0..all.len()).min_by(|a, b| (all[*a] - s).abs().total_cmp(&(all[*b] - s).abs())).unwrap()
}

#[test]
fn controls_without_a_limit_of_jerk_tell_none_and_have_the_acceleration_of_the_path() {
    for interpolator in ["trapezoid", "junction-deviation", "linuxcnc"] {
        for strategy in ["involute", "rings"] {
            let plan = on_control(strategy, interpolator);
            let one = pass(&plan, "rough");
            let (run, what) = (one.run.as_ref().unwrap(), format!("{strategy}, {interpolator}"));
            assert!(run.samples.jerk.iter().chain(&run.samples.jerk_along).all(Option::is_none), "{what}");
            let peaks = [run.peaks.jerk, run.peaks.jerk_along, run.peaks.axis_jerk];
            assert_eq!(peaks, [None; 3], "{what}");
            // In the middle of the circle at the wall, R 79 at 100 mm/s.
            let i = sample(run, run.closing.unwrap().s + 0.5 * TAU * 79.0);
            near(run.samples.speed[i], 100.0, 0.1);
            near(run.samples.acceleration[i], 100.0 * 100.0 / 79.0, 1.5);
            near(run.samples.curvature[i].unwrap(), 1.0 / 79.0, 1e-6);
            // No faster than the feed, and within the limits of the axes.
            assert!(run.peaks.speed <= 100.0 * 1.001, "{what}: {}", run.peaks.speed);
            if interpolator == "trapezoid" {
                holds(run, &what);
            }
            let last = run.samples.s.len() - 1;
            near(run.samples.s[last], run.length, 1e-5 * run.length);
        }
    }
}

#[test]
fn a_control_that_cuts_corners_is_at_the_nearest_place_of_the_path_and_tells_no_zeros() {
    let plan = on_control("rings", "linuxcnc");
    let run = pass(&plan, "rough").run.as_ref().unwrap();
    assert_eq!((run.stops, run.smoothed), (None, None));
    assert!(run.farthest > 0.01 && run.farthest < 5.0, "{}", run.farthest);
    // In the middle of each ring the curvature is that of the ring, to the last one.
    let rings: Vec<_> = run.joints.iter().filter(|j| j.kink > 1.0).collect();
    assert!(rings.len() > 10);
    let mut checked = 0;
    let wall = run.closing.unwrap().s;
    for at in [0.25, 0.5, 0.75] {
        let i = sample(run, wall + at * TAU * 79.0);
        near(run.samples.curvature[i].unwrap(), 1.0 / 79.0, 1e-6);
        checked += 1;
    }
    assert_eq!(checked, 3);
    let jerk_limited = on_control("rings", "jerk-limited");
    let own = pass(&jerk_limited, "rough").run.as_ref().unwrap();
    assert!(own.stops.unwrap() + own.smoothed.unwrap() > 10);
    // The load along the way is the same, whatever the control does at corners: where the way is the same.
    for s in [1100.0, 2550.0, 4200.0, 5100.0] {
        let [a, b] = [run, own].map(|run| run.samples.engagement[sample(run, s)].unwrap());
        assert!((a - b).abs() < 0.05, "{s}: {a} {b}");
    }
}

#[test]
fn a_slow_pass_has_the_ramps_of_its_start_and_end() {
    let slow = text("involute", "\"plunge\"", "").replace("feed = 6000", "feed = 300");
    let plan = planned(slow, HoleSamples::Rough);
    let run = pass(&plan, "rough").run.as_ref().unwrap();
    assert!(run.time > 900.0 && run.cycle > 0.05 && run.finest < 2e-3, "{} {}", run.cycle, run.finest);
    holds(run, "slow");
    // Along the circle at the wall, to rest: the ramp of speed at a limit of jerk takes the root of v J.
    let ramp = (5.0f64 * 1e5).sqrt();
    assert!(run.peaks.along > 0.6 * ramp && run.peaks.along < 1.5 * ramp, "{} {ramp}", run.peaks.along);
    let rests = (0..run.samples.s.len()).filter(|i| run.samples.speed[*i] == 0.0).map(|i| run.samples.s[i]);
    assert!({ rests }.all(|s| s < 1e-3 || s > run.length - 0.1));
}

#[test]
fn the_engagement_is_that_of_its_own_place_where_the_load_changes_fast() {
    let plan = planned(text("trochoidal", "\"plunge\"", ""), HoleSamples::Rough);
    let run = pass(&plan, "rough").run.as_ref().unwrap();
    let known = |i: &usize| run.samples.engagement[*i].is_some();
    let indices: Vec<usize> = (0..run.samples.s.len()).filter(known).collect();
    assert_eq!(run.engagement_places, indices.len());
    assert!(indices.len() > 1000, "{}", indices.len());
    let angles: Vec<f64> = indices.iter().map(|i| run.samples.engagement[*i].unwrap()).collect();
    near(run.peaks.engagement.unwrap(), angles.iter().copied().fold(0.0, f64::max), 1e-5);
    // Loops go through air: a good part of the places has nothing to cut, where lines between places had something.
    let idle = angles.iter().filter(|a| **a < 1e-6).count();
    assert!(idle > angles.len() / 10, "{idle} of {}", angles.len());
}

#[test]
fn the_load_of_a_path_is_known_from_its_first_place_on() {
    let plan = planned(text("trochoidal", "\"plunge\"", ""), HoleSamples::Rough);
    let run = pass(&plan, "rough").run.as_ref().unwrap();
    let from = run.measured.unwrap()[0];
    let i = run.samples.s.iter().position(|s| *s >= from).unwrap();
    assert!(run.samples.engagement[i].is_some(), "{} from {from}", run.samples.s[i]);
    // A spiral's angle, too, is one of a single turn.
    let angles = pass(&plan, "rough").curves.iter().filter(|c| c.kind == "spiral").map(|c| c.start_angle);
    let all: Vec<f64> = angles.collect();
    assert!(!all.is_empty() && all.iter().all(|a| (0.0..TAU).contains(a)), "{all:?}");
}

#[test]
fn the_curvature_of_a_path_that_goes_down_is_that_of_a_helix() {
    let plan = planned(text("ramping", "\"plunge\"", ""), HoleSamples::Rough);
    let one = pass(&plan, "rough");
    let run = one.run.as_ref().unwrap();
    let samples = &run.samples;
    // Where the speed is even: all of the acceleration is across the path, v^2 k.
    let mut seen = 0;
    for i in (0..samples.s.len()).filter(|i| samples.speed[*i] > 50.0) {
        let Some(k) = samples.curvature[i] else { continue };
        if samples.along[i].abs() < 1e-6 * samples.acceleration[i] {
            near(samples.acceleration[i], samples.speed[i].powi(2) * k.abs(), 1e-4 * samples.acceleration[i]);
            seen += 1;
        }
    }
    assert!(seen > 20, "{seen}");
}

#[test]
fn a_load_that_cannot_be_measured_is_not_known_and_the_pass_is_run_all_the_same() {
    let small = "tool = { number = 1, type = \"end-mill\", diameter = 0.5, flute_length = 45, teeth = 4, centre_cutting = true }\n\
         post = { control = \"heidenhain\" }\n[operation]\ntype = \"bore\"\ntool = 1\nat = [0, 0]\n\
         diameter = 60\ndepth = 1\nstrategy = \"archimedean\"\nentry = \"plunge\"\nspeed = 2400\n\
         rough = { stepover = 0.1, feed = 6000 }\n";
    let plan = planned(small.to_owned(), HoleSamples::Rough);
    let run = pass(&plan, "rough").run.as_ref().unwrap();
    assert!(run.measured.is_none() && run.peaks.engagement.is_none() && run.engagement_places == 0);
    assert!(run.samples.engagement.iter().all(Option::is_none) && run.samples.s.len() > 200);
    let why = run.unmeasured.as_ref().unwrap();
    assert!(why.message.contains("too long"), "{}", why.message);
}
