//! Clamps and fixtures of a job: contacts at their block with what clears, near passes, forms and setups, wrong tables.
//!
//! Expected values follow from the boxes by hand: a cutter of 8 mm meets a box 4 mm before its middle is over the edge.

use kinecut::base::{Code, Finding, Severity};
use kinecut::job::Outcome;

use super::external::{FANUC, HEAD, PLAIN};
use crate::common::job::run_program;

fn outcome(fixture: &str) -> Outcome {
    run_program(&text(fixture), FANUC).unwrap_or_else(|e| panic!("{e}"))
}

/// The plate with a slot at Y 20 from X 15 to X 45, and holes at Y 8; approach and return at Z 20.
fn text(fixture: &str) -> String {
    format!("post = {{ control = \"fanuc\" }}\n{HEAD}{fixture}\n[[setup]]\noffset = \"G54\"\n{PLAIN}\n")
}

pub(super) fn found(outcome: &Outcome, code: Code) -> Vec<&Finding> {
    outcome.verdict.found.iter().filter(|f| f.code == code).collect()
}

pub(super) fn line(finding: &Finding) -> &str {
    &finding.place.as_ref().unwrap().text
}

/// Value, its unit left out.
pub(super) fn value(finding: &Finding) -> f64 {
    let text = finding.value.as_ref().unwrap().to_string();
    text.split(' ').next().unwrap().parse().unwrap()
}

#[test]
fn a_clamp_in_the_way_is_found_at_its_block_with_the_height_that_clears() {
    // Over the end of the slot: from X 40 on, and 2 mm thick above Z -2.
    let done =
        outcome("[[fixture]]\nname = \"strap\"\nbox = { min = [40, 15, -2], max = [70, 25, 0] }\nnear = 0");
    let met = found(&done, Code::FIXTURE_MET);
    // The slot at Z -3 from X 36 to its end at X 45, then up by 3 out of the strap.
    let lines: Vec<&str> = met.iter().map(|f| line(f)).collect();
    assert_eq!(lines, ["X45. F400.", "G0 Z20. M9"]);
    assert!(met[0].severity == Severity::Error && met[0].message == "the tool meets `strap`", "{}", met[0]);
    assert!(
        (value(met[0]) - 9.0).abs() < 0.02 && (value(met[1]) - 3.0).abs() < 0.02,
        "{} {}",
        met[0],
        met[1]
    );
    assert!(
        met[0].help.contains("3.01 mm higher") && met[1].message.ends_with("at rapid"),
        "{} {}",
        met[0],
        met[1]
    );
    assert!(!done.verdict.is_safe());
    assert!(done.verdict.proven.iter().all(|p| !p.claim.contains("strap")));
    // Turned out of the way by its own zero.
    let away = outcome(
        "[[fixture]]\nname = \"strap\"\nat = [40, 20, 0]\nturn = 0\nbox = { min = [10, -5, -2], max = [40, 5, 0] }",
    );
    assert!(found(&away, Code::FIXTURE_MET).is_empty());
    let turned = outcome(
        "[[fixture]]\nname = \"strap\"\nat = [40, 20, 0]\nturn = 180\nbox = { min = [10, -5, -2], max = [40, 5, 0] }",
    );
    assert_eq!(line(found(&turned, Code::FIXTURE_MET)[0]), "G1 Z-3. F200.");
}

#[test]
fn what_keeps_away_is_proven_and_what_comes_near_is_a_warning() {
    let beside = |near: &str, x: f64| {
        outcome(&format!(
            "[[fixture]]\nname = \"stop\"\nbox = {{ min = [{x}, 15, -9], max = [80, 25, 9] }}\n{near}"
        ))
    };
    // The cutter ends at X 49.
    let far = beside("", 49.6);
    assert!(found(&far, Code::FIXTURE_MET).is_empty() && found(&far, Code::FIXTURE_NEAR).is_empty());
    let claims: Vec<&str> = far.verdict.proven.iter().map(|p| p.claim.as_str()).collect();
    assert!(claims.contains(&"no tool or shank meets `stop` in `P.nc`"), "{claims:?}");
    assert!(
        far.verdict.scope.iter().any(|s| s.starts_with("Fixtures as given compared")),
        "{:?}",
        far.verdict.scope
    );
    let near = beside("", 49.2);
    let passed = found(&near, Code::FIXTURE_NEAR);
    assert_eq!(passed.len(), 1);
    assert!(
        (value(passed[0]) - 0.2).abs() < 0.003 && passed[0].severity == Severity::Warning,
        "{}",
        passed[0]
    );
    assert!(
        passed[0].message == "the tool passes `stop`" && line(passed[0]) == "X45. F400.",
        "{}",
        passed[0]
    );
    assert!(near.verdict.is_safe());
    assert!(found(&beside("near = 0", 49.2), Code::FIXTURE_NEAR).is_empty());
    assert_eq!(found(&beside("near = 2", 50.5), Code::FIXTURE_NEAR).len(), 1);
    // Bodies that touch are in contact; with a hundredth of a millimetre between them they are not.
    assert_eq!(found(&beside("near = 0", 49.0), Code::FIXTURE_MET).len(), 2);
    assert!(found(&beside("near = 0", 49.011), Code::FIXTURE_MET).is_empty());
}

#[test]
fn a_start_that_is_not_known_beside_a_clamp_is_a_doubt() {
    // The first moves go to X 15, Y 20 at a height that nobody knows, and to Z 20 from there: above the plate.
    let at = |x: f64| {
        format!(
            "[[fixture]]\nname = \"post\"\ncylinder = {{ base = [{x}, 30, -9], diameter = 10, height = 40 }}\nnear = 0"
        )
    };
    let beside = outcome(&at(15.0));
    let doubts = found(&beside, Code::UNKNOWN_START);
    let doubt = doubts.iter().find(|f| f.severity == Severity::Doubt).expect("a doubt");
    assert!(
        doubt.message.contains("ends below the top of `post`") && line(doubt).contains("Z20."),
        "{doubt}"
    );
    let away = outcome(&at(120.0));
    assert!(found(&away, Code::UNKNOWN_START).iter().all(|f| f.severity != Severity::Doubt));
    assert!(away.verdict.is_safe());
}

#[test]
fn every_form_is_met_where_it_is() {
    // A round body of 10 mm beside the slot's end; the drill at X 45, Y 8 meets it in none of its moves.
    let round = outcome(
        "[[fixture]]\nname = \"pin\"\ncylinder = { base = [50, 20, -9], diameter = 10, height = 20 }\nnear = 0",
    );
    let met = found(&round, Code::FIXTURE_MET);
    // At Z -3 the pin is met from X 41 on, and left upwards at Z 11.
    assert!(
        (value(met[0]) - 4.0).abs() < 0.02 && (value(met[1]) - 14.0).abs() < 0.02,
        "{} {}",
        met[0],
        met[1]
    );
    // A vise about the plate: jaws at Y 0 and Y 40, 3 mm over its top; the drill of 6 mm at Y 8 keeps 5 mm away.
    let vise = |jaw: f64| {
        let table =
            format!("vise = {{ jaw_width = 60, opening = 40, jaw_height = {jaw}, jaw_thickness = 15 }}");
        outcome(&format!("[[fixture]]\nname = \"vise\"\nat = [30, 20, -12]\n{table}"))
    };
    let held = vise(15.0);
    assert!(found(&held, Code::FIXTURE_MET).is_empty() && held.verdict.is_safe());
    assert!(held.verdict.proven.iter().any(|p| p.claim.contains("the 3 bodies of the fixtures")));
    let strap = outcome(
        "[[fixture]]\nname = \"left\"\nat = [20, 20, 0]\nturn = 180\nclamp = { length = 50, width = 20, thickness = 8 }",
    );
    let names: Vec<&str> = found(&strap, Code::FIXTURE_MET).iter().map(|f| f.message.as_str()).collect();
    assert!(names.iter().any(|n| n.contains("`left (strap)`")), "{names:?}");
}

#[test]
fn wrong_tables_are_named_with_their_key() {
    let block = "box = { min = [0, 0, 0], max = [1, 1, 1] }";
    for (table, key, says) in [
        ("name = \"a\"".to_owned(), "fixture[0]", "no form"),
        (format!("name = \"a\"\n{block}\nmesh = \"x.stl\""), "fixture[0]", "more than one form"),
        (format!("name = \" \"\n{block}"), "fixture[0].name", "empty name"),
        (format!("name = \"a\"\n{block}\nsetups = [2]"), "fixture[0].setups[0]", "no setup of this number"),
        (format!("name = \"a\"\n{block}\nat = [0, nan, 0]"), "fixture[0].at[1]", "not a number"),
        (format!("name = \"a\"\n{block}\nturn = 400"), "fixture[0].turn", "too large"),
        (format!("name = \"a\"\n{block}\nnear = -1"), "fixture[0].near", "must not be negative"),
        (
            "name = \"a\"\nbox = { min = [0, 0, 0], max = [1, 0, 1] }".to_owned(),
            "fixture[0].box.max[1]",
            "greatest corner",
        ),
        ("name = \"a\"\nmesh = \"x.stl\"".to_owned(), "fixture[0].mesh", "x.stl"),
        (
            "name = \"a\"\nvise = { jaw_width = 9, opening = 0, jaw_height = 9, jaw_thickness = 9 }"
                .to_owned(),
            "fixture[0].vise.opening",
            "positive",
        ),
        (
            "name = \"a\"\nclamp = { length = 9, width = 9, thickness = 9, bolt_at = 10 }".to_owned(),
            "fixture[0].clamp.bolt_at",
            "too large",
        ),
        (format!("name = \"a\"\n{block}\n[[fixture]]\nname = \"a\"\n{block}"), "fixture[1].name", "twice"),
        (format!("nam = \"a\"\n{block}"), "fixture", "nam"),
    ] {
        let error = run_program(&text(&format!("[[fixture]]\n{table}")), FANUC).expect_err(&table);
        let shown = error.to_string();
        assert!(shown.contains(says), "{table}: {shown}");
        if let Some(found) = &error.0.key {
            assert_eq!(found, key, "{shown}");
        }
    }
}

/// Sentences of the README of the example.
#[test]
fn the_example_finds_what_its_readme_says() {
    let met = |replace: &[(&str, &str)]| -> Vec<String> {
        let done = super::examples::run("17_vise_and_clamp", replace);
        let found = found(&done, Code::FIXTURE_MET);
        found.iter().map(|f| format!("{} {}", f.place.as_ref().unwrap().line, f.message)).collect()
    };
    assert_eq!(met(&[]), ["20 the tool meets `left clamp (strap)` at rapid"]);
    let bed = met(&[("parallels = 8", "parallels = 0")]);
    for line in [18, 19, 20] {
        assert!(bed.contains(&format!("{line} the tool meets `vise (bed)`")), "{bed:?}");
    }
    let groove = met(&[("at = [67, 36, 0]", "at = [67, 12, 0]")]);
    assert_eq!(groove[0], "11 the tool meets `left clamp (strap)`");
}

#[test]
fn a_fixture_that_reaches_into_the_raw_stock_is_a_warning() {
    let said = |replace: &[(&str, &str)]| -> Vec<String> {
        let done = super::examples::run("17_vise_and_clamp", replace);
        let found = found(&done, Code::FIXTURE_IN_STOCK);
        assert!(found.iter().all(|f| f.severity == Severity::Warning));
        found.iter().map(|f| f.message.clone()).collect()
    };
    // The plate, 60 wide and 20 high, rests on parallels between the jaws.
    assert_eq!(said(&[]), Vec::<String>::new());
    let jaws =
        ["`vise (jaw at Y+)` reaches into the raw stock", "`vise (jaw at Y-)` reaches into the raw stock"];
    assert_eq!(said(&[("opening = 60", "opening = 59")]), jaws);
    // A tenth of a millimetre is how one draws.
    assert_eq!(said(&[("opening = 60", "opening = 59.85")]), Vec::<String>::new());
    let strap = ["`left clamp (strap)` reaches into the raw stock"];
    assert_eq!(said(&[("at = [67, 36, 0]", "at = [67, 36, -5]")]), strap);
}

#[test]
fn a_tool_whose_height_is_not_known_comes_into_the_spindle_unseen() {
    let done = outcome("[[fixture]]\nname = \"post\"\nbox = { min = [80, 80, -20], max = [90, 90, 90] }");
    let said = done.verdict.unchecked().any(|item| {
        item.what.starts_with("the tool as it comes into the spindle: not compared with clamps and fixtures")
    });
    assert!(said, "{:?}", done.verdict.not_checked);
}
