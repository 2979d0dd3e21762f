//! The cut part against what is wanted: findings, the largest deviation and the colours of the part say the same.

use kinecut::base::Code;
use kinecut::job::{Judgement, Outcome, report};

use crate::common::job;

/// A plate of 40 x 30 x 16 mm, drilled 7.8 and reamed at one place, with a reamer of this diameter; `wanted` is the hole.
fn reamed(drill: f64, reamer: f64, step: f64) -> Outcome {
    let text = format!(
        r#"
        format = 1
        stock = {{ box = {{ min = [-20, -15, -16], max = [20, 15, 0] }} }}
        post = {{ control = "fanuc" }}
        simulate = {{ step = {step} }}
        [[tool]]
        number = 1
        type = "drill"
        diameter = {drill}
        flute_length = 60
        [[tool]]
        number = 2
        type = "drill"
        diameter = {reamer}
        point = {{ cone = {{ cone_angle = 90, nose_diameter = {nose} }} }}
        flute_length = 60
        [[setup]]
        offset = "G54"
        safe_height = 20
        [[setup.operation]]
        type = "drill"
        tool = 1
        points = [[-8, 0], [8, 3]]
        entry = {{ surface = "plane" }}
        exit = "same"
        length = 16
        tolerance = 0.05
        speed = 1800
        feed_per_rev = {{ entry = 0.1, steady = 0.2, exit = 0.1 }}
        [[setup.operation]]
        type = "drill"
        method = "reaming"
        tool = 2
        points = [[-8, 0], [8, 3]]
        pre_hole = {{ diameter = {drill} }}
        entry = {{ surface = "plane" }}
        exit = "same"
        length = 16
        tolerance = 0.02
        speed = 400
        feed_per_rev = {{ entry = 0.15, steady = 0.15, exit = 0.15 }}
        "#,
        nose = drill - 0.4
    );
    job::run(&text).unwrap()
}

/// What the page says of an outcome: the tile, and the shares of area outside of the tolerance.
fn shown(outcome: &Outcome) -> (String, f64) {
    let report = report::of_job(outcome);
    let tile = report.verdict.facts.iter().find(|f| f.label == "Largest deviation").unwrap();
    let part = report.part.as_ref().unwrap();
    let tolerance = f64::from(part.tolerance);
    let outside = |b: &&report::Band| b.from > 0.75 * tolerance || b.to < -0.75 * tolerance;
    let share = report::bands(part).iter().filter(outside).map(|b| b.share).sum();
    (format!("{} {}", tile.value, tile.note), share)
}

#[test]
fn a_reamed_hole_is_held_against_the_reamer_and_no_longer_against_the_drill() {
    let outcome = reamed(7.8, 8.0, 0.5);
    let d = &outcome.deviation;
    assert_eq!(outcome.verdict.outcome, Judgement::Safe, "{:?}", outcome.verdict.found);
    let replaced: Vec<bool> = d.bores.iter().map(|b| b.replaced).collect();
    assert_eq!(replaced, [true, true, false, false]);
    assert!(d.bores[2].ends > 100 && d.bores[2].worst() < 1e-3, "{:?}", d.bores[2]);
    // Two tolerances: colours count in them.
    assert!(d.relative && d.tolerance == 1.0);
    let coloured: Vec<f32> = d.at_vertices.iter().copied().filter(|d| d.is_finite()).collect();
    assert!(coloured.len() > 200 && coloured.iter().all(|d| d.abs() < 0.05), "{}", coloured.len());
    let (tile, outside) = shown(&outcome);
    assert!(tile.ends_with("allowed 20.0 \u{b5}m") && outside == 0.0, "{tile} {outside}");
}

#[test]
fn a_program_that_leaves_its_reamer_out_leaves_stock_though_the_drill_was_right() {
    // The same part, held against a job whose reamer is larger: as if it had not been run.
    let mut outcome = reamed(7.8, 7.9, 0.5);
    let other = reamed(7.8, 8.0, 0.5);
    outcome.deviation =
        kinecut::job::deviation(&other.job, &other.setups, &outcome.simulation, &outcome.part).unwrap();
    let d = &outcome.deviation;
    let codes: Vec<Code> = d.findings.iter().map(|(f, ..)| f.code).collect();
    assert!(codes.contains(&Code::STOCK_LEFT), "{codes:?}");
    let largest = d.largest.unwrap();
    assert!((largest.deviation - 0.05).abs() < 1e-3 && largest.tolerance == 0.02, "{largest:?}");
    let (tile, outside) = shown(&outcome);
    assert!(tile.starts_with("50.0 \u{b5}m stock left") && outside > 0.5, "{tile} {outside}");
}

#[test]
fn a_hole_between_the_lines_is_not_measured_and_has_no_number() {
    let text = r#"
        format = 1
        stock = { box = { min = [-20, -15, -16], max = [20, 15, 0] } }
        post = { control = "linuxcnc" }
        simulate = { step = 4 }
        [[tool]]
        number = 1
        type = "end-mill"
        diameter = 0.4
        flute_length = 2
        [[setup]]
        offset = "G54"
        [[setup.operation]]
        type = "bore"
        tool = 1
        at = [0.1, 0.2]
        diameter = 0.8
        depth = 1
        strategy = "involute"
        entry = "plunge"
        speed = 20000
        rough = { stepover = 0.1, feed = 100 }
        "#;
    let outcome = job::run(text).unwrap();
    let found = &outcome.verdict.found;
    let doubt = found.iter().find(|f| f.code == Code::NOT_MEASURED).unwrap();
    assert!(doubt.message.contains("could not be measured") && !doubt.help.is_empty(), "{doubt}");
    assert_eq!(outcome.verdict.outcome, Judgement::NotProven, "{found:?}");
    assert!(outcome.deviation.largest.is_none() && outcome.deviation.bores[0].ends == 0);
    assert!(!outcome.verdict.proven.iter().any(|p| p.claim.contains("of the wanted surface")));
    let page = report::of_job(&outcome);
    assert!(page.verdict.facts.iter().any(|f| f.label == "Largest deviation" && f.value == "not measured"));
}

#[test]
fn a_face_and_a_bore_in_it_are_coloured_alike() {
    let text = r#"
        format = 1
        stock = { box = { min = [-30, -20, -20], max = [30, 20, 1] } }
        post = { control = "fanuc" }
        simulate = { step = 1 }
        [[tool]]
        number = 1
        type = "face-mill"
        diameter = 50
        flute_length = 8
        teeth = 5
        [[tool]]
        number = 2
        type = "end-mill"
        diameter = 12
        flute_length = 26
        [[setup]]
        offset = "G54"
        [[setup.operation]]
        type = "face"
        tool = 1
        outline = "top"
        top = 0
        depth = 1
        speed = 1000
        feed_per_tooth = 0.1
        [[setup.operation]]
        type = "bore"
        tool = 2
        at = [0, 0]
        diameter = 24
        depth = 8
        strategy = "involute"
        speed = 6000
        rough = { stepover = 2, feed = 900, allowance = 0.2 }
        finish = { feed = 600 }
        "#;
    let outcome = job::run(text).unwrap();
    assert_eq!(outcome.verdict.outcome, Judgement::Safe, "{:?}", outcome.verdict.found);
    let d = &outcome.deviation;
    assert!(d.faces[0].ends > 100 && d.bores[0].ends > 100, "{:?} {:?}", d.faces, d.bores);
    let finite = |test: &dyn Fn(f64) -> bool| {
        let all = outcome.part.vertices.iter().zip(&d.at_vertices);
        all.filter(|(v, d)| test(v.z) && d.is_finite()).count()
    };
    assert!(finite(&|z| z.abs() < 1e-6) > 4 && finite(&|z| z < -1.0 && z > -7.0) > 20);
}
