//! Numbers that ask for gigabytes or hours: each is refused with its bound, or takes time in proportion.

use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use kinecut::base::{Code, Error, Finding, MemoryLoader, Progress, Silent, Sources};
use kinecut::job::machine::{LoadOptions, load};
use kinecut::job::{ProgramWants, TextItems, given_alone};
use kinecut::nc::{self, Control};
use kinecut::verbs::Answer as _;
use kinecut::verbs::check::program_sheet;
use kinecut::verbs::envelope::{ENVELOPE_LIST, EnvelopeTable, envelope_sheets};
use kinecut::verbs::face::{SheetWants, plan_face_sheet};
use kinecut::verbs::hole::{plan_hole, read_holes};

use crate::common::job;

/// Far beyond what anything here takes, even on a busy machine, and far below what it took.
const LONG: Duration = Duration::from_secs(60);

fn in_time<T>(work: impl FnOnce() -> T) -> T {
    let begin = Instant::now();
    let done = work();
    assert!(begin.elapsed() < LONG, "{:?}", begin.elapsed());
    done
}

fn read(text: &str, control: Control) -> Result<nc::Reading, Error> {
    nc::read(&mut Sources::default(), "a", text, control, &[])
}

/// Refused with this code, a value and a bound.
fn bounded(error: Error, code: Code) -> Finding {
    let finding = *error.0;
    assert_eq!(finding.code, code, "{finding}");
    assert!(finding.value.is_some() && finding.bound.is_some(), "{finding}");
    assert!(finding.to_string().len() < 300, "{finding}");
    finding
}

#[test]
fn turns_of_a_klartext_helix_are_bounded() {
    let helix = |degrees: &str| {
        format!(
            "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000\n2 L X+10 Y+0 Z+0 R0 FMAX M3\n3 CC X+0 Y+0\n4 CP IPA+{degrees} IZ-10 DR+ F100\n5 END PGM A MM\n"
        )
    };
    assert!(read(&helix("359640"), Control::Heidenhain).is_ok(), "999 turns");
    for degrees in ["359999", "99999999", "900000000"] {
        let finding = bounded(read(&helix(degrees), Control::Heidenhain).unwrap_err(), Code::NC_ARC);
        assert_eq!(finding.place.unwrap().line, 5);
    }
}

#[test]
fn repetitions_are_counted_over_the_whole_program() {
    let head = "G21 G90 G94 G54 G17\nT1 M6\nG43\nS1000 M3\nG0 X0 Y0 Z5\n";
    let with = |lines: usize, repeats: u32| {
        format!("{head}{}M2\n", format!("G91 G81 X0 Y1 Z-5 R2 L{repeats} F100\n").repeat(lines))
    };
    assert!(read(&with(20, 100), Control::LinuxCnc).is_ok());
    let error = in_time(|| read(&with(200, 9999), Control::LinuxCnc).unwrap_err());
    let finding = bounded(error, Code::NC_STATE);
    assert_eq!(finding.place.unwrap().line, 16, "the line at which there are too many");
    // Deep holes of many steps, repeated.
    let pecks = format!("{head}G91 G83 X1 Y0 Z-90 R2 Q0.01 L9999 F100\nM2\n");
    bounded(in_time(|| read(&pecks, Control::LinuxCnc).unwrap_err()), Code::NC_STATE);
}

#[test]
fn shifted_coordinates_take_time_in_proportion() {
    let shifts = format!("G90 G54\nG0 X0 Y0 Z5\n{}G0 X0 Y0\nM30\n", "ATRANS X1\n".repeat(60_000));
    assert!(in_time(|| read(&shifts, Control::Sinumerik840d)).is_ok());
    let pair = "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 IX+1\n";
    let klartext = format!(
        "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z+5 R0 FMAX\n{}END PGM A MM\n",
        pair.repeat(20_000)
    );
    assert!(in_time(|| read(&klartext, Control::Heidenhain)).is_ok());
}

const JOB: &str = r#"format = 1
stock = { box = { min = [-30, -30, -10], max = [30, 30, 0] } }
post = { control = "linuxcnc", program = "small" }
simulate = { step = 2 }
[[tool]]
number = 1
type = "end-mill"
diameter = 10
flute_length = 22
teeth = 3
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
rough = { stepover = 2, feed = 1200, allowance = 0.2 }
finish = { feed = 800 }
"#;

fn run(from: &str, to: &str) -> Result<kinecut::job::Outcome, Error> {
    assert!(JOB.contains(from), "{from}");
    let files = MemoryLoader::default();
    kinecut::job::run("job.toml", &JOB.replace(from, to), &files, &Silent)
}

#[test]
fn numbers_of_a_job_are_bounded_at_their_key_and_place() {
    assert!(run("teeth = 3", "teeth = 5").is_ok());
    for (from, to, key) in [
        ("teeth = 3", "teeth = 2147483647", "tool[0].teeth"),
        ("feed = 1200", "feed = 1e300", "setup[0].operation[0].rough.feed"),
        ("feed = 800", "feed = 1e-300", "setup[0].operation[0].finish.feed"),
        ("feed = 800", "feed = 800, turns = 4000000", "setup[0].operation[0].finish.turns"),
        ("number = 1", "number = 4294967295", "tool[0].number"),
        ("speed = 8000", "speed = 1e300", "setup[0].operation[0].speed"),
    ] {
        let finding = bounded(in_time(|| run(from, to).unwrap_err()), Code::JOB_VALUE);
        assert_eq!(finding.key.as_deref(), Some(key), "{to}");
        assert!(finding.place.is_some_and(|p| p.line > 0), "{to}");
    }
    for strategy in ["involute", "ramping", "lens-1", "archimedean", "rings"] {
        let job = JOB
            .replace("\"involute\"", &format!("\"{strategy}\""))
            .replace("stepover = 2, feed", "stepover = 0.0001, feed");
        let error = in_time(|| job::run(&job.replace("entry = \"plunge\"\n", "")).unwrap_err());
        assert_eq!(error.code(), Code::PLAN_VALUE, "{strategy}: {error}");
        assert!(error.to_string().contains("10000"), "{strategy}: {error}");
    }
}

#[test]
fn names_that_a_file_system_or_a_shell_takes_for_something_else_are_refused() {
    for name in ["CON", "nul", "Lpt1", "-rf", ""] {
        let error = run("program = \"small\"", &format!("program = \"{name}\"")).unwrap_err();
        assert_eq!((error.code(), error.0.key.as_deref()), (Code::JOB_VALUE, Some("post.program")), "{name}");
    }
    assert!(run("program = \"small\"", "program = \"CONE-2\"").is_ok());
}

#[test]
fn a_comment_for_fanuc_has_no_end_of_tape() {
    let outcome = run("format = 1\n", "format = 1\ntitle = \"50 % of\"\n");
    assert!(outcome.is_ok());
    let job = JOB.replace("format = 1\n", "format = 1\ntitle = \"50 % of\"\n").replace("linuxcnc", "fanuc");
    let outcome = job::run(&job).unwrap();
    let text = &outcome.setups[0].posted.text;
    assert!(text.contains("50 - OF"), "{text}");
    assert!(text.lines().all(|l| l == "%" || !l.contains('%')), "{text}");
}

#[test]
fn a_template_cannot_double_a_text_without_end() {
    let run = |template: &str| {
        let job = JOB.replace("program = \"small\"", "program = \"small\", start = \"s.txt\"");
        let files = MemoryLoader::default().with("s.txt", template);
        in_time(|| kinecut::job::run("job.toml", &job, &files, &Silent))
    };
    let doubling = format!(
        "G21 G90\n{{% set a = \"aaaaaaaaaaaaaaaa\" %}}{}{{{{ a }}}}",
        "{% set a = a ~ a ~ a ~ a ~ a ~ a ~ a ~ a %}".repeat(9)
    );
    let refused = [
        doubling.as_str(),
        "G21\n{{ \"x\" * 100000000 }}",
        "G21\n{% for i in range(9999) %}{% set a = \"x\" * 90000000 %}{% endfor %}",
        "G21\n{{ \"x\"|indent(4000000000) }}",
        "G21\n{{ \"%999999999d\"|format(1) }}",
        "G21\n{% macro m(a) %}{{ m(a ~ a) }}{% endmacro %}{{ m(\"x\") }}",
        "G21\n{% for i in range(9000) %}{% for j in range(9) %}(0123456789)\n{% endfor %}{% endfor %}",
    ];
    for template in refused {
        assert_eq!(run(template).unwrap_err().code(), Code::POST_TEMPLATE, "{template}");
    }
    run("G21 G90\n{% set n = program_name ~ \" \" ~ control %}({{ n }})\n{% for t in tools %}(T{{ t.number }})\n{% endfor %}").unwrap();
}

fn envelope(tool: &str, tolerance: &str, progress: &dyn Progress) -> Result<(), Error> {
    let text = format!(
        "tolerance = {tolerance}\npoints = 10\n[tool]\n{tool}\n[move]\nfrom = [0, 0, 0]\nto = [60, 10, -8]\naxis = [0, 0, 1]\naxis_to = [0.5, 0.35, 0.8]\n"
    );
    let table = TextItems::<EnvelopeTable>::read("e.toml", &text, ENVELOPE_LIST)?.item(0)?;
    envelope_sheets(&table, &MemoryLoader::default(), progress).map(|_| ())
}

/// Wants to stop after it was asked some times.
struct Stopping(AtomicU32);

impl Progress for Stopping {
    fn stage(&self, _: &str, _: u64) {}
    fn advance(&self, _: u64) {}
    fn cancelled(&self) -> bool {
        self.0.fetch_add(1, Ordering::Relaxed) > 20
    }
}

#[test]
fn an_envelope_is_counted_before_it_is_built() {
    let usual = "shape.bull-nose = { diameter = 20, corner_radius = 5, flute_length = 24 }\nshank_diameter = 16\nstickout = 42";
    envelope(usual, "0.2", &Silent).unwrap();
    for tolerance in ["1e-7", "1e-9", "1e-100"] {
        let error = in_time(|| envelope(usual, tolerance, &Silent).unwrap_err());
        bounded(error, Code::SWEEP_TOO_FINE);
    }
    let huge = "shape.bull-nose = { diameter = 1000000, corner_radius = 5, flute_length = 24 }";
    in_time(|| envelope(huge, "0.2", &Silent).unwrap_err());
    let holder = format!("{usual}\nholder = [{{ height = 99999999, lower_diameter = 34 }}]");
    bounded(in_time(|| envelope(&holder, "0.2", &Silent).unwrap_err()), Code::CONTOUR);
    let error = envelope(usual, "0.002", &Stopping(AtomicU32::new(0)));
    assert!(error.is_err_and(|e| e.code() == Code::CANCELLED));
}

#[test]
fn teeth_turns_and_holes_of_one_operation_are_bounded() {
    let face = r#"{"tool": {"number": 1, "type": "face-mill", "diameter": 100, "teeth": 2147483647, "flute_length": 8},
        "operation": {"type": "face", "tool": 1, "outline": {"loops": [[[0, 0], [60, 0], [60, 40], [0, 40]]]}, "depth": 0.5,
        "cutting_speed": 250, "feed_per_tooth": 0.12}}"#;
    let table = read_holes("f.json", face).unwrap().item(0).unwrap();
    let wants = SheetWants { compare: true, ..SheetWants::default() };
    let error = in_time(|| plan_face_sheet(&table, wants, &MemoryLoader::default(), &Silent).unwrap_err());
    assert_eq!(bounded(error, Code::JOB_VALUE).key.as_deref(), Some("tool.teeth"));
    let even = kinecut::facing::ToothedPass::even(
        u32::MAX,
        50.0,
        0.1,
        kinecut::facing::Placement { angle: 0.0, offset: 0.0 },
    );
    bounded(even.map(|_| ()).unwrap_err(), Code::TOOL_VALUE);
    let hole = r#"{"tool": {"number": 1, "type": "end-mill", "diameter": 10, "flute_length": 22}, "operation": {"type": "bore",
        "tool": 1, "at": [0, 0], "diameter": 40, "depth": 8, "strategy": "involute", "speed": 8000, "rough": {"stepover": 2,
        "feed": 1200}, "finish": {"feed": 800, "turns": 2147483647}}}"#;
    let table = read_holes("h.json", hole).unwrap().item(0).unwrap();
    let error = in_time(|| plan_hole(&table).unwrap_err());
    assert_eq!(bounded(error, Code::JOB_VALUE).key.as_deref(), Some("operation.finish.turns"));
    let drill = JOB.replace(&JOB[JOB.find("type = \"bore\"").unwrap()..], "type = \"drill\"\ntool = 1\nlength = 5\nspeed = 1000\n\
        feed_per_rev = { steady = 0.1 }\npattern = { grid = { at = [-20, -20], step = [0.2, 0.2], count = [250, 201] } }\n");
    let drill = drill.replace("end-mill", "drill").replace("teeth = 3", "point_angle = 118");
    let error = in_time(|| job::run(&drill).unwrap_err());
    assert!(bounded(error, Code::JOB_VALUE).key.unwrap().contains("pattern"));
}

#[test]
fn what_is_compared_is_bounded_in_its_row() {
    let hole = |engagement: f64| {
        let text = format!(
            r#"{{"tool": {{"number": 1, "type": "end-mill", "diameter": 40, "flute_length": 45}}, "operation": {{"type": "bore", "tool": 1,
            "at": [0, 0], "diameter": 200, "depth": 8, "strategy": "involute", "speed": 8000, "rough": {{"stepover": 4, "feed": 1200,
            "engagement": {engagement}}}, "finish": {{"feed": 800}}}}}}"#
        );
        let table = read_holes("h.json", &text).unwrap().item(0).unwrap();
        in_time(|| kinecut::verbs::hole::compare_hole(&table)).unwrap().comparison
    };
    let refused = |engagement: f64| {
        hole(engagement)
            .rows
            .into_iter()
            .filter(|r| r.error.as_ref().is_some_and(|e| e.message.contains("to compare")))
            .count()
    };
    assert_eq!(refused(60.0), 0);
    assert!(refused(5.0) > 0);
}

#[test]
fn values_of_a_control_beside_a_comparison_are_bounded_as_in_a_machine() {
    let compared = |dynamics: &str| {
        let text = format!(
            r#"{{"tool": {{"number": 1, "type": "end-mill", "diameter": 10, "flute_length": 22}}, "operation": {{"type": "bore", "tool": 1,
            "at": [0, 0], "diameter": 40, "depth": 8, "strategy": "involute", "speed": 8000, "rough": {{"stepover": 2, "feed": 1200}},
            "finish": {{"feed": 800}}}}, "dynamics": {{{dynamics}}}}}"#
        );
        kinecut::verbs::hole::compare_hole(&read_holes("h.json", &text).unwrap().item(0).unwrap())
    };
    assert!(compared(r#""acceleration": 4, "tolerance": 0.02, "interpolator": "trapezoid""#).is_ok());
    let error = compared(r#""acceleration": 4, "tool_change": 1e6"#).unwrap_err();
    assert_eq!(bounded(error, Code::JOB_VALUE).key.as_deref(), Some("dynamics.tool_change"));
    let error = compared(r#""acceleration": 4, "spindle_ramp": 2"#).unwrap_err();
    assert_eq!((error.code(), error.0.key.as_deref()), (Code::MACHINE_AXIS, Some("dynamics.spindle_ramp")));
}

#[test]
fn a_program_without_moves_has_zero_millimetres() {
    let file = kinecut::job::GivenFile { name: "a.ngc", bytes: b"G21 G90\nM2\n" };
    let given = given_alone(file, &ProgramWants::default(), false).unwrap();
    let text = program_sheet(&given).unwrap().text();
    assert!(text.contains("; 0 mm at feed") && !text.contains("-0"), "{text}");
}

#[test]
fn what_is_imported_keeps_to_the_bounds_of_a_machine_file() {
    let ini = |velocity: &str, limit: &str| {
        format!(
            "[EMC]\nMACHINE = mill\n[KINS]\nKINEMATICS = trivkins\n[TRAJ]\nCOORDINATES = X Y Z\nLINEAR_UNITS = mm\nMAX_LINEAR_VELOCITY = {velocity}\n\
             [JOINT_0]\nMIN_LIMIT = -200\nMAX_LIMIT = {limit}\nMAX_VELOCITY = {velocity}\n[AXIS_X]\nMIN_LIMIT = -200\nMAX_LIMIT = {limit}\nMAX_VELOCITY = {velocity}\n"
        )
    };
    let read = |text: String| {
        let files = MemoryLoader::default().with("m.ini", text);
        load("m.ini", "m.ini", &LoadOptions { code: Some("2103".into()), ..LoadOptions::default() }, &files)
    };
    let loaded = read(ini("80", "200")).unwrap();
    kinecut::job::machine::read("m.toml", &kinecut::job::machine::machine_toml(&loaded.machine)).unwrap();
    let error = read(ini("30000", "200")).unwrap_err();
    assert!(error.0.bound.is_some() && error.0.place.as_ref().unwrap().file == "m.ini", "{error}");
    // What LinuxCNC takes for no limit is none; any other is one that a machine file takes.
    for limit in ["1e9", "150000", "99999"] {
        if let Ok(loaded) = read(ini("80", limit)) {
            let text = kinecut::job::machine::machine_toml(&loaded.machine);
            kinecut::job::machine::read("m.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        }
    }
}
