//! Faces in a job: planned, posted for each control, read back, simulated, their exits measured on the simulated walls.

use kinecut::base::{Error, Severity};
use kinecut::job::Outcome;

use crate::common::job;
use crate::common::planned::faces;

/// A plate of 60 x 40 with a bore of 14, half a millimetre to mill; `keys` are those of the operation.
fn job(control: &str, keys: &str) -> String {
    format!(
        r#"
        format = 1
        stock = {{ box = {{ min = [-30, -20, -8], max = [30, 20, 0.5] }} }}
        drilled = [{{ at = [14, 5], diameter = 14, top = 1, bottom = -9 }}]
        post = {{ control = "{control}" }}
        simulate = {{ step = 0.5 }}
        [[tool]]
        number = 1
        type = "face-mill"
        diameter = 80
        teeth = 5
        flute_length = 8
        stickout = 40
        shank_diameter = 50
        [[setup]]
        offset = "G54"
        safe_height = 30
        [[setup.operation]]
        type = "face"
        tool = 1
        depth = 0.5
        cutting_speed = 200
        feed_per_tooth = 0.1
        {keys}
        "#
    )
}

fn outcome(control: &str, keys: &str) -> Result<Outcome, Error> {
    job::run(&job(control, keys))
}

fn errors(outcome: &Outcome) -> Vec<String> {
    let found = outcome.verdict.found.iter().filter(|f| f.severity == Severity::Error);
    found.map(|f| format!("{} {f}", f.code)).collect()
}

/// The planned bad length is that of the simulated walls, but for the ends of its stretches.
fn agrees(outcome: &Outcome, what: &str) {
    assert!(errors(outcome).is_empty(), "{what}: {:?}", errors(outcome));
    let planned = faces(&outcome.setups[0].planned)[0];
    let simulated = planned.simulated.as_ref().unwrap();
    let way = planned.chosen();
    let ends = way.burr.stretches.len() as f64;
    assert!((simulated.bad - way.bad).abs() < 0.5 * ends, "{what}: {} against {}", simulated.bad, way.bad);
    let compared = simulated.exits.iter().filter(|e| e.planned.is_some()).count();
    assert!(compared > 300, "{what}: {compared}");
    assert!(simulated.largest < 0.03 && simulated.differing == 0.0, "{what}: {simulated:?}");
    let face = &outcome.deviation.faces[0];
    assert!(face.ends > 8000 && face.height[0].abs() < 1e-4 && face.height[1].abs() < 1e-4, "{face:?}");
}

#[test]
fn every_control_mills_what_was_planned_whatever_is_turned() {
    for control in ["sinumerik-840d", "fanuc", "linuxcnc", "grbl", "heidenhain"] {
        for turn in ["path", "coordinates", "part"] {
            let keys =
                format!("outline = \"top\"\nturn = \"{turn}\"\nplacement = {{ angle = 33, offset = 4 }}");
            agrees(&outcome(control, &keys).unwrap(), &format!("{control} {turn}"));
        }
    }
}

#[test]
fn a_left_hand_cutter_leaves_the_mirror_image() {
    for turn in ["path", "part"] {
        let keys = format!("outline = \"top\"\nleft_hand = true\nturn = \"{turn}\"\nguard = 0");
        let left = outcome("linuxcnc", &keys).unwrap();
        agrees(&left, turn);
        assert!(left.setups[0].posted.text.contains("M4"));
    }
    // The same placement with either hand: the plate is not symmetric, so the bad length tells the hand.
    let keys = "outline = \"top\"\nplacement = { angle = 20, offset = 6 }\nguard = 0";
    let right = outcome("linuxcnc", keys).unwrap();
    let left = outcome("linuxcnc", &format!("{keys}\nleft_hand = true")).unwrap();
    agrees(&right, "right");
    agrees(&left, "left");
    let bad = |o: &Outcome| faces(&o.setups[0].planned)[0].chosen().bad;
    assert!((bad(&right) - bad(&left)).abs() > 5.0, "{} {}", bad(&right), bad(&left));
}

#[test]
fn the_least_burr_is_less_than_as_drawn_and_is_certified() {
    let least = outcome("fanuc", "outline = \"top\"\nguard = 0").unwrap();
    let drawn = outcome("fanuc", "outline = \"top\"\nguard = 0\nplacement = \"as-drawn\"").unwrap();
    agrees(&least, "least");
    agrees(&drawn, "drawn");
    let plan = |o: &Outcome| faces(&o.setups[0].planned)[0].plan.clone();
    let (least, drawn) = (plan(&least), plan(&drawn));
    let optimum = least.optimum.as_ref().unwrap();
    let value = least.ways[least.chosen].bad;
    assert!((value - optimum.value).abs() < 1e-9 && optimum.lower_bound <= value);
    assert!(optimum.gap() < 1e-4 * least.case.weighted_perimeter(), "{}", optimum.gap());
    assert!(value < 0.9 * drawn.ways[drawn.chosen].bad);
}

#[test]
fn levels_end_on_the_plane_and_the_last_one_sets_the_threshold() {
    let keys = "outline = \"top\"\ntop = -2.0\nstepdown = 1.0\nplacement = \"as-drawn\"";
    let text = job("linuxcnc", keys).replace("depth = 0.5", "depth = 2.5");
    let outcome = job::run(&text).unwrap();
    agrees(&outcome, "levels");
    let operation = outcome.job.setups[0].operations[0].milling();
    assert_eq!(operation.tool.teeth, 5);
    let kinecut::operations::Operation::Face(face) = &outcome.job.setups[0].operations[0] else { panic!() };
    let levels: Vec<f64> = face.levels.iter().map(|z| (z * 1e6).round() / 1e6).collect();
    assert_eq!(levels, [-0.333333, -1.166667, -2.0]);
    // 0.833 mm: between 90 degrees at 0.5 mm and 60 degrees at 1 mm.
    let threshold = face.case.bad.parts()[0].to.to_degrees();
    assert!((threshold - 70.0).abs() < 1e-9, "{threshold}");
}

#[test]
fn stock_that_stands_higher_than_the_depth_is_told() {
    let keys = "outline = \"top\"\nplacement = \"as-drawn\"";
    let text = job("linuxcnc", keys).replace("depth = 0.5", "depth = 0.25");
    let outcome = job::run(&text).unwrap();
    let told: Vec<String> = outcome.verdict.found.iter().map(|f| format!("{} {f}", f.code)).collect();
    assert!(told.len() == 1 && told[0].contains("KC1005") && told[0].contains("depth"), "{told:?}");
}

#[test]
fn a_part_that_is_turned_is_said_to_be_in_the_program() {
    let keys = "outline = \"top\"\nturn = \"part\"\nplacement = { angle = -33.25 }";
    let text = &outcome("linuxcnc", keys).unwrap().setups[0].posted.text;
    assert!(text.contains("PART TURNED BY 33.250 DEG CLOCKWISE ABOUT THE WORK ZERO"), "{text}");
}

#[test]
fn walls_too_coarse_to_compare_are_said_to_be_unchecked() {
    let text = job("linuxcnc", "outline = \"top\"\nplacement = { angle = 33, offset = 4 }");
    let coarse = job::run(&text.replace("step = 0.5", "step = 7")).unwrap();
    let about = |list: &[String]| list.iter().filter(|l| l.contains("exit angles")).count();
    let open = |o: &Outcome| -> Vec<String> { o.verdict.unchecked().map(|u| u.what.clone()).collect() };
    let claims: Vec<String> = coarse.verdict.proven.iter().map(|p| p.claim.clone()).collect();
    let simulated = faces(&coarse.setups[0].planned)[0].simulated.clone().unwrap();
    assert!(!simulated.is_compared(), "{simulated:?}");
    assert_eq!((about(&claims), about(&open(&coarse))), (0, 1));
    let fine = job::run(&text).unwrap();
    let claims: Vec<String> = fine.verdict.proven.iter().map(|p| p.claim.clone()).collect();
    assert_eq!((about(&claims), about(&open(&fine))), (1, 0));
}

#[test]
fn the_verdict_is_about_the_operation_as_written() {
    let setups = |keys: &str| {
        let verdict = outcome("linuxcnc", keys).unwrap().verdict;
        verdict.subjects.into_iter().find(|s| s.role == "setups").unwrap().sha256
    };
    let keys = "outline = \"top\"\nplacement = \"as-drawn\"";
    assert_eq!(setups(keys), setups(keys));
    assert_ne!(setups(keys), setups(&format!("{keys}\nclearance = 6")));
    assert_ne!(setups(keys), setups(&format!("{keys}\npasses = \"fastest\"")));
}

#[test]
fn all_ways_keep_to_the_constraints() {
    // A narrow window of turns: all ways lie in it, and what is asked for must.
    let keys = "outline = \"top\"\nforbidden = [[10, 350]]\noff_centre = 3\nguard = 0";
    for passes in ["least-burr", "fastest"] {
        let keys = format!("{keys}\npasses = \"{passes}\"");
        let outcome = outcome("linuxcnc", &keys).unwrap();
        let plan = &faces(&outcome.setups[0].planned)[0].plan;
        for way in &plan.ways {
            let Some(angle) = way.angle else { continue };
            let off = kinecut::num::angle::wrap(angle).abs().to_degrees();
            assert!(off < 10.0 + 1e-6, "{passes} {} {off}", way.name);
            let Some(offset) = way.offset else { continue };
            let [low, high] = plan.case.outline.extent(glam::DVec2::new(angle.sin(), angle.cos()));
            assert!((offset - 0.5 * (low + high)).abs() > 3.0 - 1e-6, "{passes} {}", way.name);
        }
        assert!(plan.ways.len() > 3);
    }
    let keys = format!("{keys}\nplacement = {{ angle = 45 }}");
    assert_eq!(outcome("linuxcnc", &keys).unwrap_err().code().as_str(), "KC1001");
}

#[test]
fn a_placement_that_set_up_can_undo_is_told() {
    // A channel whose inner walls lie along the feed: they are bad as a whole or not at all.
    let outline = "outline = { loops = [[[-30, -20], [-30, 20], [-20, 20], [-20, -10], [20, -10], [20, 20], [30, 20], [30, -20]]] }";
    let text = job("linuxcnc", &format!("{outline}\nguard = 0"));
    let outcome = job::run(&text).unwrap();
    let optimum = faces(&outcome.setups[0].planned)[0].plan.optimum.clone().unwrap();
    assert!(optimum.sensitivity.worst > 1.2 * optimum.value, "{optimum:?}");
    assert!(outcome.verdict.found.iter().any(|f| f.code.as_str() == "KC1005"), "{:?}", outcome.verdict.found);
}

#[test]
fn an_outline_that_is_not_that_of_the_stock_is_found() {
    let rectangle = "outline = { unit = \"mm\", loops = [[[-30, -20], [30, -20], [30, 20], [-30, 20]]] }";
    let no_bore = outcome("linuxcnc", rectangle).unwrap();
    assert!(
        errors(&no_bore)
            .iter()
            .any(|e| e.contains("KC1003") && e.contains("edges that the outline does not"))
    );
    let moved = rectangle.replace("[30, -20], [30, 20]", "[26, -20], [26, 20]");
    let moved = outcome("linuxcnc", &moved).unwrap();
    assert!(
        errors(&moved).iter().any(|e| e.contains("KC1003") && e.contains("does not have all edges")),
        "{:?}",
        errors(&moved)
    );
}

#[test]
fn what_makes_no_sense_is_refused_with_its_key() {
    let top = "outline = \"top\"\n";
    for (keys, code, part) in [
        (
            format!(
                "{top}turn = \"part\"\n[[setup.operation]]\ntype = \"face\"\ntool = 1\noutline = \"top\"\ndepth = 0.1\nspeed = 100\nfeed = 100"
            ),
            "KC0102",
            "turn",
        ),
        (format!("{top}exit_angle_min = 190"), "KC1001", "exit_angle_min"),
        (format!("{top}exit_angle_min = 90\nbad = [{{ from = 0, to = 10 }}]"), "KC0102", "exclude"),
        (format!("{top}bad = [{{ from = 20, to = 10 }}]"), "KC1001", "bad"),
        (format!("{top}thresholds = [[1, 60], [0.5, 90]]"), "KC1001", "thresholds"),
        (format!("{top}weights = {{ SEAL = 3 }}"), "KC0104", "SEAL"),
        (format!("{top}margin = 50"), "KC0103", "margin"),
        (format!("{top}forbidden = [[10, 5]]"), "KC0103", "forbidden"),
        (format!("{top}forbidden = [[-360, 360]]"), "KC0103", "forbidden"),
        (format!("{top}forbidden = [[0, 360]]"), "KC1001", "every orientation"),
        (format!("{top}engagement = [10, 200]"), "KC0103", "engagement"),
        (format!("{top}speed = 100"), "KC0102", "cutting_speed"),
        (format!("{top}feed = 100"), "KC0102", "feed"),
        (format!("{top}top = 3"), "KC1001", "finished plane"),
        (format!("{top}placement = {{ angle = 0, offset = 30 }}"), "KC1002", "beyond the cutter"),
        ("outline = \"cover.dxf\"".to_owned(), "KC0001", "cover.dxf"),
        ("outline = \"cover.txt\"".to_owned(), "KC0001", "cover.txt"),
        (
            "outline = { loops = [[[0, 0], [10, 0], [0, 10], [10, 10]]] }".to_owned(),
            "KC0804",
            "(5.0000, 5.0000)",
        ),
        (
            "outline = { loops = [[[0, 0], [90, 0], [90, 90], [0, 90]]] }\npasses = \"one\"".to_owned(),
            "KC1002",
            "wide",
        ),
    ] {
        let error = outcome("linuxcnc", &keys).expect_err(&keys);
        assert_eq!(error.code().as_str(), code, "{keys}: {error}");
        let shown = error.to_string();
        assert!(
            shown.contains(part) || error.0.key.as_deref().is_some_and(|k| k.contains(part)),
            "{keys}: {shown}"
        );
        assert!(shown.starts_with("job.toml:"), "{keys}: {shown}");
    }
}

#[test]
fn a_part_too_wide_for_one_pass_is_milled_in_as_few_rows_as_cover_it() {
    let ways = |keys: &str| {
        let done = outcome("linuxcnc", keys).unwrap_or_else(|e| panic!("{keys}: {e}"));
        faces(&done.setups[0].planned)[0].chosen().name.clone()
    };
    let square =
        |side: u32| format!("outline = {{ loops = [[[0, 0], [{side}, 0], [{side}, {side}], [0, {side}]]] }}");
    assert!(ways(&square(90)).starts_with("2 best rows"), "{}", ways(&square(90)));
    assert!(ways(&square(160)).starts_with("3 best rows"), "{}", ways(&square(160)));
    assert!(ways(&square(40)).starts_with("one pass"), "{}", ways(&square(40)));
}
