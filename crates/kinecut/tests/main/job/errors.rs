//! Wrong jobs: each gets one message with file, line, value, bound and help, and nothing is written.

use kinecut::base::{Code, Error, MemoryLoader, Silent};

use crate::common::kept::assert_kept;

/// A small right job: every test breaks one thing of it.
const JOB: &str = r#"format = 1
title = "test"
stock = { box = { min = [-30, -30, -10], max = [30, 30, 0] } }
post = { control = "sinumerik-840d", decimals = 4 }
simulate = { step = 1.0 }

[machine]
code = "2103"
travel = { X = [-400, 400], Y = [-300, 300], Z = [-500, 0] }
dynamics = { rapid = 30000 }

[[tool]]
number = 1
type = "end-mill"
diameter = 10
flute_length = 22
centre_cutting = true

[[setup]]
offset = "G54"

[[setup.operation]]
type = "bore"
tool = 1
at = [0, 0]
diameter = 40
depth = 8
strategy = "involute"
entry = "plunge"
speed = 8000
rough = { stepover = 2, allowance = 0.2, feed = 1200 }
finish = { turns = 2, feed = 800, start = [-5, 5] }
"#;

pub(super) fn run(text: &str) -> Result<kinecut::job::Outcome, Error> {
    kinecut::job::run("jobs/test.toml", text, &loader(), &Silent)
}

fn loader() -> MemoryLoader {
    // A tetrahedron without its fourth face.
    let open = "solid t\n\
        facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 9 0\nvertex 9 0 0\nendloop\nendfacet\n\
        facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 0 9\nendloop\nendfacet\n\
        facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 9\nvertex 0 9 0\nendloop\nendfacet\nendsolid t\n";
    MemoryLoader::default().with("open.stl", open).with("garbage.stl", "this is no mesh")
}

/// The job with one text replaced, which must stand in it.
pub(super) fn with(from: &str, to: &str) -> String {
    assert!(JOB.contains(from), "`{from}` is not in the job");
    JOB.replacen(from, to, 1)
}

#[test]
fn the_right_job_runs() {
    let outcome = run(JOB).unwrap();
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
}

#[test]
fn the_right_job_runs_as_cubics() {
    let outcome = run(&with("\"sinumerik-840d\"", "\"linuxcnc\", cubic = true")).unwrap();
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
    let setup = &outcome.setups[0];
    let cubics = setup.posted.text.lines().filter(|line| line.contains("G5 X")).count();
    assert!(cubics > 50 && cubics == setup.posted.notes.cubics as usize, "{cubics}");
    assert!(setup.read_back.largest < 0.001, "{:?}", setup.read_back);
    let arcs = run(&with("\"sinumerik-840d\"", "\"linuxcnc\"")).unwrap();
    let removed = |o: &kinecut::job::Outcome| o.simulation.stock.volume();
    assert!((removed(&outcome) - removed(&arcs)).abs() < 1e-5 * removed(&arcs));
    let wall = |o: &kinecut::job::Outcome| o.deviation.bores[0].radius().unwrap();
    for (a, b) in wall(&outcome).into_iter().zip(wall(&arcs)) {
        assert!((a - b).abs() < 0.001, "{a} {b}");
    }
}

#[test]
fn every_wrong_value_is_one_error_with_its_line() {
    // What is replaced, and by what.
    let cases: &[(&str, &str)] = &[
        ("diameter = 10", "diameter = 50"),
        ("start = [-5, 5]", "start = [-25, 5]"),
        ("allowance = 0.2", "allowance = -0.2"),
        ("stepover = 2,", "stepoverr = 2,"),
        ("depth = 8", "depth = nan"),
        ("speed = 8000", "speed = inf"),
        ("feed = 1200", "feed = 0"),
        ("format = 1", "format = 2"),
        ("sinumerik-840d", "sinumeric"),
        ("decimals = 4", "decimals = 4, program = \"../x\""),
        ("decimals = 4", "decimals = 9"),
        ("decimals = 4", "decimals = 4, cubic = true"),
        ("step = 1.0", "step = 0.0005"),
        ("code = \"2103\"", "code = \"213\""),
        ("X = [-400, 400]", "X = [400, -400]"),
        ("flute_length = 22", "flute_length = -1"),
        ("offset = \"G54\"", "offset = \"G53\""),
        ("tool = 1", "tool = 2"),
        ("type = \"bore\"", "type = \"bored\""),
        ("strategy = \"involute\"", "strategy = \"spiral\""),
        ("centre_cutting = true", "centre_cutting = false"),
        ("[machine]", "[machine"),
        ("box = { min = [-30, -30, -10], max = [30, 30, 0] }", "mesh = \"open.stl\""),
        ("box = { min = [-30, -30, -10], max = [30, 30, 0] }", "mesh = \"garbage.stl\""),
        ("box = { min = [-30, -30, -10], max = [30, 30, 0] }", "mesh = \"missing.stl\""),
        ("max = [30, 30, 0]", "max = [-30, 30, 0]"),
        ("depth = 8", "depth = -8"),
        ("depth = 8", "depth = 8\nstock_to_leave_floor = 9"),
        ("stepover = 2,", "stepover = 12,"),
        ("turns = 2", "turns = 0"),
        ("turns = 2", "turns = 2, spring_passes = 90"),
        ("flute_length = 22", "flute_length = 1e8"),
        ("rapid = 30000", "tolerance = 2"),
        ("rapid = 30000", "spindle_ramp = 3"),
        ("rapid = 30000", "junction_deviation = 0.01"),
        ("rapid = 30000", "interpolator = \"mach3\""),
    ];
    let mut text = String::new();
    for (from, to) in cases {
        let finding = *run(&with(from, to)).expect_err(to).0;
        assert_eq!(
            finding.place.as_ref().map(|p| p.file.as_str()),
            Some("jobs/test.toml"),
            "{to}: {finding}"
        );
        // What is no TOML has only the words of its reader; a list of what is taken is a help.
        let said = finding.code == Code::JOB_SYNTAX || finding.message.contains("expected one of");
        assert!(said || !finding.help.is_empty(), "{to}: {finding}");
        text += &format!("{from} -> {to}\n{} {finding}\n\n", finding.code.as_str());
    }
    assert_kept("wrong_jobs", &text);
}

#[test]
fn a_machine_in_a_file_of_its_own_is_read_and_its_errors_point_into_it() {
    let text = with(
        "[machine]\ncode = \"2103\"\ntravel = { X = [-400, 400], Y = [-300, 300], Z = [-500, 0] }\ndynamics = { rapid = 30000 }\n",
        "",
    );
    let text = text.replacen("format = 1\n", "format = 1\nmachine = \"vmc.toml\"\n", 1);
    let run_with =
        |machine: &str| kinecut::job::run("j.toml", &text, &loader().with("vmc.toml", machine), &Silent);
    assert!(run_with("code = \"2103\"\n").is_ok());
    let error = run_with("name = \"a\"\ncode = \"2104\"\n").unwrap_err();
    let place = error.0.place.as_ref().unwrap();
    assert_eq!((place.file.as_str(), place.line), ("vmc.toml", 2), "{error}");
    let error = run_with("code = \"2103\"\ncolour = 1\n").unwrap_err();
    assert_eq!(error.0.place.as_ref().unwrap().file, "vmc.toml");
}

#[test]
fn the_schema_beside_the_examples_is_the_present_one() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/job.schema.json");
    let present = kinecut::job::json_text(&kinecut::job::file::schema());
    let beside = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(beside == present, "write it again: kinecut schema job > examples/job.schema.json");
    assert!(present.contains("\"bore\"") && present.contains("Largest distance of neighbouring turns"));
}

#[test]
fn all_keys_that_are_missing_are_named_at_once() {
    let text = with("flute_length = 22\n", "").replace("depth = 8\n", "").replace("speed = 8000\n", "")
        + "[[setup.operation]]\ntype = \"slot\"\nwidth = 12\n";
    let error = run(&text).unwrap_err().0;
    assert_eq!((error.code, error.message.as_str()), (Code::JOB_SHAPE, "`flute_length` is missing"));
    let place = error.place.as_ref().expect("a place");
    assert_eq!((place.file.as_str(), place.line), ("jobs/test.toml", 12));
    let help = &error.help;
    assert!(
        help.starts_with("for example flute_length = 22 (mm, height of the cutting part above the tip); "),
        "{help}"
    );
    for words in [
        "line 21 lacks depth = 8 (mm, depth below the rim) and speed = 3800 (rev/min, spindle speed)",
        "line 30 lacks tool = 1 (the tool, one with a cylindrical edge: its number, or its name) and depth = 8 (mm, depth below it)",
    ] {
        assert!(help.contains(words), "{help}");
    }
    // In one table: all of them, each with what it is; a key under its old name is there.
    let text = with("stepover = 2, allowance = 0.2, feed = 1200", "step = 2");
    let error = run(&text).unwrap_err().0;
    assert_eq!(error.message, "`feed` is missing");
    let text = with("tool = 1\nat = [0, 0]\n", "");
    let error = run(&text).unwrap_err().0;
    assert!(error.message.starts_with("`tool`"), "{error:?}");
    // Another fault of a table comes first.
    let error = run(&with("depth = 8", "dept = 8")).unwrap_err().0;
    assert!(error.message.contains("unknown field `dept`"), "{error:?}");
}

#[test]
fn keys_under_their_old_names_are_read_and_a_note_tells_the_new_ones() {
    let renamed = |old: &str| -> String {
        with("stepover = 2,", "step = 2, axial_step = 3,").replace("depth = 8", &format!("depth = 8\n{old}"))
    };
    let new = with("stepover = 2,", "stepover = 2, stepdown = 3,")
        .replace("depth = 8", "depth = 8\nstock_to_leave = 0.1");
    let (old, new) = (run(&renamed("leave = 0.1")).unwrap(), run(&new).unwrap());
    assert_eq!(old.setups[0].posted.text, new.setups[0].posted.text);
    let notes = |o: &kinecut::job::Outcome| -> Vec<(String, u32)> {
        let of = o.verdict.found.iter().filter(|f| f.code == Code::KEY_RENAMED);
        of.map(|f| (f.message.clone(), f.place.as_ref().unwrap().line)).collect()
    };
    assert!(notes(&new).is_empty() && old.verdict.is_safe() == new.verdict.is_safe());
    let mut told = notes(&old);
    told.sort();
    assert_eq!(
        told,
        [
            ("`axial_step` is now called `stepdown`".to_owned(), 32),
            ("`leave` is now called `stock_to_leave`".to_owned(), 28),
            ("`step` is now called `stepover`".to_owned(), 32)
        ]
    );
    // An error about a key stands where it was written, whatever its name there.
    let error = run(&with("stepover = 2,", "step = 12,")).unwrap_err();
    assert_eq!(error.0.place.unwrap().line, 31);
    let error = run(&with("stepover = 2,", "step = 2, stepover = 3,")).unwrap_err();
    assert_eq!(error.code(), Code::JOB_SHAPE);
    // Lists of keys have the new names only.
    let message = run(&with("stepover = 2,", "stepover = 2, steps = 3,")).unwrap_err().to_string();
    assert!(message.contains("`stepover`") && message.contains("`stepdown`"), "{message}");
    assert!(!message.contains("`step`") && !message.contains("`axial_step`"), "{message}");
}
