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
    near(samples.s[last], run.length, 2e-4 * run.length);
    near(samples.time[last], run.time, 1e-5 * run.time);
    near(run.way.s[run.way.s.len() - 1], run.length, 1e-5 * run.length);
    for i in 0..=last {
        // Nothing is kept that is larger than the largest of all, nor along the path more than in all.
        assert!(samples.acceleration[i] <= run.peaks.acceleration * 1.00001, "{what}");
        assert!(samples.jerk[i] <= run.peaks.jerk * 1.00001, "{what}");
        assert!(samples.along[i].abs() <= samples.acceleration[i] * 1.00001 + 1e-6, "{what}");
        assert!(samples.jerk_along[i].abs() <= samples.jerk[i] * 1.00001 + 1e-3, "{what}");
    }
    assert!(run.peaks.axis_acceleration <= 5000.0 * 1.001 && run.peaks.axis_jerk <= 1e5 * 1.001, "{what}");
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
        near(run.samples.jerk[i], feed.powi(3) / (radius * radius), 1e-3);
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
