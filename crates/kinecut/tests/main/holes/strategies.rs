//! Every strategy of a bore on every control: planned, posted, the text read back and cut. The wall that stands is
//! measured on the lines of the stock, which know nothing of the plan.

use kinecut::base::{Code, MemoryLoader, Severity, Silent};
use kinecut::job::Outcome;
use kinecut::nc::Control;

use crate::common::job;

const STRATEGIES: &[&str] = &[
    "involute",
    "annular",
    "lens-1",
    "lens-2",
    "constant-engagement",
    "arcs-2",
    "arcs-4",
    "archimedean",
    "rings",
    "rings-tangent",
    "trochoidal",
    "ramping",
    "helix",
    "outline-helix",
];

/// A through bore of 40 mm (20 mm for the helix, which may leave no core) in a plate of 10 mm.
fn job(control: Control, strategy: &str, direction: &str, more: &str, finish: &str) -> String {
    let diameter = if strategy == "helix" { 20 } else { 40 };
    format!(
        r#"
format = 1
stock = {{ box = {{ min = [-26, -26, -10], max = [26, 26, 0] }} }}
post = {{ control = "{control}" }}
simulate = {{ step = 0.7 }}
[[tool]]
number = 1
type = "end-mill"
diameter = 12
flute_length = 26
max_ramp_angle = 5
[[setup]]
offset = "G54"
[[setup.operation]]
type = "bore"
tool = 1
at = [1, -2]
diameter = {diameter}
depth = 10
breakthrough = 1
strategy = "{strategy}"
direction = "{direction}"
speed = 5000
rough = {{ stepover = 3, engagement = 75, allowance = 0.3, feed = 1200, stepdown = 6 }}
{finish}
{more}
"#
    )
}

const FINISH: &str = "finish = { feed = 600 }";

fn run(text: &str) -> kinecut::base::Result<Outcome> {
    job::run(text)
}

fn assert_right(text: &str, control: Control, what: &str) -> Outcome {
    let outcome = run(text).unwrap_or_else(|e| panic!("{what}: {e}"));
    let errors: Vec<_> = outcome.verdict.found.iter().filter(|f| f.severity == Severity::Error).collect();
    assert!(errors.is_empty(), "{what}: {errors:?}");
    let bore = &outcome.deviation.bores[0];
    assert!(bore.ends > 300, "{what}: {bore:?}");
    // A micrometre, and what the number format of the control takes.
    let resolution = control.resolution(outcome.job.post.decimals);
    let bound = 1e-3 + resolution;
    assert!(outcome.setups[0].read_back.largest < bound, "{what}: {:?}", outcome.setups[0].read_back);
    assert!(bore.wall[0] > -bound && bore.wall[1] < bound, "{what}: {bore:?}");
    assert!(bore.gouge.depth < bound && bore.left.depth < bound, "{what}: {bore:?}");
    outcome
}

#[test]
fn every_strategy_cuts_its_bore_on_every_control() {
    let all: Vec<_> = Control::WRITTEN.iter().flat_map(|c| STRATEGIES.iter().map(move |s| (c, s))).collect();
    // One after the other would wait for the longest alone.
    std::thread::scope(|scope| {
        let (mine, others) = all.split_at(all.len() / 2);
        scope.spawn(|| each(mine));
        each(others);
    });
}

fn each(list: &[(&Control, &&str)]) {
    for &(&control, strategy) in list {
        let what = format!("{strategy} on {control}");
        let outcome = assert_right(&job(control, strategy, "climb", "", FINISH), control, &what);
        let slug = outcome.verdict.found.iter().any(|f| f.code == Code::SLUG);
        assert_eq!(slug, *strategy == "outline-helix", "{what}");
    }
}

#[test]
fn conventional_milling_is_the_mirror_image() {
    for strategy in ["lens-1", "constant-engagement", "trochoidal", "ramping"] {
        let control = Control::LinuxCnc;
        let cut = |direction| assert_right(&job(control, strategy, direction, "", FINISH), control, strategy);
        let (climb, conventional) = (cut("climb"), cut("conventional"));
        let removed = |o: &Outcome| o.simulation.raw_volume - o.simulation.stock.volume();
        let (a, b) = (removed(&climb), removed(&conventional));
        assert!((a / b - 1.0).abs() < 1e-6, "{strategy} {a} {b}");
        let length =
            |o: &Outcome| o.setups[0].plan_trace.segments.iter().map(|s| s.curve.length()).sum::<f64>();
        assert!((length(&climb) - length(&conventional)).abs() < 1e-6);
    }
}

#[test]
fn leads_of_every_kind_finish_the_wall() {
    for finish in [
        "finish = { feed = 600, contact = \"g4\" }",
        "finish = { feed = 600, contact = \"g6\", start = [3, 0], end = [1, 3] }",
        "finish = { feed = 600, start_radius = 5, end_length = 40 }",
        "finish = { feed = 600, start_length = 30, contact = \"g4\", end_radius = 6, spring_passes = 2 }",
        "finish = { feed = 600, feed_at = \"wall\" }",
    ] {
        let control = Control::Fanuc;
        let outcome = assert_right(&job(control, "lens-1", "climb", "", finish), control, finish);
        let circles = |o: &Outcome| {
            let done = &o.setups[0];
            let role = |item: u32| done.planned.program.origin(item as usize).role;
            let finishing = |s: &&kinecut::trace::Segment| role(s.item) == kinecut::program::Role::Finish;
            done.plan_trace.segments.iter().filter(finishing).cloned().collect::<Vec<_>>()
        };
        let laps = circles(&outcome);
        assert!(laps.len() >= if finish.contains("spring") { 3 } else { 1 });
        if finish.contains("wall") {
            // Centre on 14 mm, wall on 20 mm.
            let kinecut::trace::SegmentPace::Feed(feed) = laps[0].motion else { panic!("a feed") };
            assert!((feed - 10.0 * 14.0 / 20.0).abs() < 1e-9, "{feed}");
        }
    }
}

#[test]
fn a_wear_register_moves_the_wall_by_its_value() {
    for control in [Control::Sinumerik840d, Control::Fanuc, Control::LinuxCnc, Control::Heidenhain] {
        let register = control.wear_register(kinecut::tool::ToolNumber(1));
        for value in [0.0, 0.03, -0.03] {
            let finish = format!(
                "finish = {{ feed = 600, wear_offset = \"D{register}\", wear_value = {value}, wear_largest = 0.05 }}"
            );
            let what = format!("{value} on {control}");
            let outcome = assert_right(&job(control, "involute", "climb", "", &finish), control, &what);
            assert!(outcome.setups[0].posted.text.contains("POSITIVE MAKES THE BORE SMALLER"), "{what}");
            // The wanted wall is moved with the register; what was measured is its real radius.
            let radius = outcome.deviation.bores[0].radius().unwrap();
            for r in radius {
                assert!((r - (20.0 - value)).abs() < 3e-3, "{what}: {radius:?}");
            }
        }
    }
    let refused = |control, finish: &str| run(&job(control, "involute", "climb", "", finish)).unwrap_err();
    let wear = "finish = { feed = 600, wear_offset = \"D2\" }";
    assert_eq!(refused(Control::Grbl, wear).code(), Code::POST_CONTROL);
    let own = "finish = { feed = 600, wear_offset = \"D1\" }";
    assert_eq!(refused(Control::LinuxCnc, own).code(), Code::JOB_VALUE);
    let large = "finish = { feed = 600, wear_offset = \"D101\", wear_largest = 9 }";
    let e = refused(Control::LinuxCnc, large);
    assert!(e.0.bound.is_some() && !e.0.help.is_empty(), "{e:?}");
    let beyond = "finish = { feed = 600, wear_offset = \"D101\", wear_value = 0.2 }";
    assert_eq!(refused(Control::LinuxCnc, beyond).code(), Code::JOB_VALUE);
}

#[test]
fn a_conical_bore_is_milled_in_steps_that_never_cut_into_the_cone() {
    let finish = "finish = { feed = 600, stepdown = 1 }\nbottom_diameter = 36\ntolerance = 0.25";
    let control = Control::LinuxCnc;
    let outcome = run(&job(control, "lens-1", "climb", "", finish)).unwrap();
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    let bore = &outcome.deviation.bores[0];
    // 2 mm in radius over 10 mm of depth: eleven steps of 1 mm leave 0.2 mm each, and nothing is gouged.
    assert!(bore.gouge.depth < 1.1e-3, "{bore:?}");
    assert!(bore.left.depth > 0.15 && bore.left.depth < 0.21, "{bore:?}");
}

#[test]
fn an_elliptic_pocket_is_cut_on_every_control() {
    for control in Control::WRITTEN {
        for (direction, contact) in [("climb", "g4"), ("conventional", "g6")] {
            let text = format!(
                r#"
format = 1
stock = {{ box = {{ min = [-40, -40, -12], max = [40, 40, 0] }} }}
post = {{ control = "{control}" }}
simulate = {{ step = 0.7 }}
[[tool]]
number = 1
type = "end-mill"
diameter = 12
flute_length = 26
[[setup]]
offset = "G54"
[[setup.operation]]
type = "pocket-ellipse"
tool = 1
at = [1, -2]
half_axes = [22, 32]
angle = 20
depth = 8
speed = 5000
direction = "{direction}"
contact = "{contact}"
rough = {{ stepover = 3, allowance = 0.3, feed = 1200, stepdown = 4 }}
finish = {{ feed = 600 }}
"#
            );
            let what = format!("{direction} on {control}");
            let outcome = assert_right(&text, *control, &what);
            let floor = outcome.deviation.bores[0].floor.unwrap();
            assert!(floor[0] > -2e-3 && floor[1] < 2e-3, "{what} {floor:?}");
        }
    }
}

#[test]
fn stock_to_leave_stands_and_what_cannot_be_is_refused() {
    let control = Control::Sinumerik840d;
    let leave = format!("{FINISH}\nstock_to_leave = 0.4");
    let outcome = assert_right(&job(control, "arcs-4", "climb", "", &leave), control, "leave");
    let radius = outcome.deviation.bores[0].radius().unwrap();
    assert!(radius.iter().all(|r| (r - 19.6).abs() < 1e-3), "{radius:?}");
    // More than there is: a warning, and no operation.
    let all = format!("{FINISH}\nstock_to_leave = 15");
    let outcome = run(&job(control, "arcs-4", "climb", "", &all)).unwrap();
    assert!(
        outcome.verdict.is_safe() && outcome.verdict.found.iter().any(|f| f.code == Code::NOTHING_TO_MILL)
    );
    assert!(outcome.simulation.effects[0].iter().all(|e| e.first_contact.is_none()));
    let refused = |strategy: &str, from: &str, to: &str| {
        let text = job(control, strategy, "climb", "", FINISH);
        assert!(text.contains(from));
        run(&text.replace(from, to)).unwrap_err()
    };
    // The core that a helix would leave in 40 mm with a cutter of 12: 2 (14 - 0.3 - 6).
    let e = refused("helix", "diameter = 20", "diameter = 40");
    assert!(e.to_string().contains("15.4"), "{e}");
    let e = refused("outline-helix", "breakthrough = 1", "");
    assert!(!e.0.help.is_empty(), "{e}");
    let e = refused("constant-engagement", "engagement = 75", "engagement = 0.001");
    assert!(e.0.value.is_some() && e.0.bound.is_some(), "{e}");
    let e = refused("constant-engagement", "engagement = 75", "engagement = 190");
    assert!(e.0.value.is_some() && e.0.bound.is_some(), "{e}");
    let e = refused("ramping", "max_ramp_angle = 5", "max_ramp_angle = 0.01");
    assert!(!e.0.help.is_empty() && e.code() == Code::ENTRY_IMPOSSIBLE, "{e}");
    let e = refused("annular", "speed = 5000", "speed = 5000\nentry = \"plunge\"");
    assert!(e.to_string().contains("annular"), "{e}");
}

#[test]
fn templates_of_the_job_are_used_and_their_errors_point_at_their_key() {
    let control = Control::Grbl;
    let text = job(control, "lens-2", "climb", "", FINISH)
        .replace("control = \"grbl\"", "control = \"grbl\", start = \"s.tmpl\", end = \"e.tmpl\"");
    let loader = |start: &str, end: &str| MemoryLoader::default().with("s.tmpl", start).with("e.tmpl", end);
    let run = |loader: MemoryLoader| kinecut::job::run("bore.toml", &text, &loader, &Silent);
    let good =
        run(loader("(TOOL {{ tools[0].diameter }})\nG21 G17 G90 G94 G91.1 G40\n", "M5\nM30\n")).unwrap();
    assert!(good.verdict.is_safe() && good.setups[0].posted.text.contains("(TOOL 12.0)\nG21 G17"));
    for (start, end, key) in [("G21 {{ nothing }}\n", "M30\n", "start ="), ("G21 G90\n", "M5\n", "end =")] {
        let e = run(loader(start, end)).unwrap_err();
        assert_eq!(e.code(), Code::POST_TEMPLATE);
        let place = e.0.place.expect("a place");
        assert!(place.text[..place.column as usize - 1].trim_end().ends_with(key), "{place:?}");
    }
}
