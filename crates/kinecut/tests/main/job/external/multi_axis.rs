//! Tilted planes and control of the tool centre point in programs of others.

use kinecut::base::{Code, Error, MemoryLoader};
use kinecut::job::{GivenFile, Outcome, ProgramWants, given_with_job};
use kinecut::nc::{Control, PostSettings};
use kinecut::operations::OrientationName;
use kinecut::verbs::post::{Translation, translate};

use crate::common::job;

fn job(control: &str) -> String {
    format!(
        "format = 1\nstock = {{ box = {{ min = [-40, -30, -40], max = [40, 30, 0] }} }}\n\
         post = {{ control = \"{control}\" }}\nsimulate = {{ step = 1.0 }}\n{REST}"
    )
}

const REST: &str = r#"
[machine]
code = "641203"
travel = { X = [-400, 400], Y = [-350, 350], Z = [-650, 0], A = [-115, 35], C = [-3600, 3600] }
[machine.axis.A]
point = [0, 0, -480]
[[tool]]
number = 2
type = "ball-nose"
diameter = 6
flute_length = 12
stickout = 60
gauge_length = 140
[[setup]]
offset = "G54"
position = [10, -5, -420]
program = { file = "P.nc" }
"#;

fn outcome(control: &str, text: &str) -> Result<Outcome, Error> {
    job::run_program(&job(control), text)
}

/// From Z up, the plane turned by 30 degrees about X about (0, 0, 0): a way of 10 mm along its X, 2 mm above it.
const FANUC: &str = "G17 G21 G90 G94 G40 G80\nT2 M6\nG54\nG0 A0. C0. S5000 M3\nG68.2 X0. Y0. Z0. I0. J30. K0.\nG53.1\n\
    G0 X-5. Y0.\nG43 H2 Z2.\nG1 X5. F300.\nG0 Z100.\nG69\nG49\nG53 Z0.\nM30\n";
const SINUMERIK: &str = "G17 G90 G94 G710 G54\nT2 M6\nD1\nS5000 M3\nCYCLE800(0,\"\",0,57,0,0,0,30,0,0,0,0,0,-1)\n\
    G0 X-5 Y0\nZ2\nG1 X5 F300\nG0 Z100\nCYCLE800()\nG0 SUPA Z0 D0\nM30\n";

#[test]
fn a_tilted_plane_is_followed_on_the_machine() {
    for (control, text) in [("fanuc", FANUC), ("sinumerik-840d", SINUMERIK)] {
        let outcome = outcome(control, text).unwrap_or_else(|e| panic!("{control}: {e}"));
        let segments = &outcome.setups[0].trace.segments;
        let cut = segments.iter().find(|s| s.motion != kinecut::trace::SegmentPace::Rapid).unwrap();
        let (sin, cos) = 30f64.to_radians().sin_cos();
        let wanted = glam::DVec3::new(-5.0, -2.0 * sin, 2.0 * cos);
        assert!((cut.curve.start() - wanted).length() < 1e-9, "{control}: {:?}", cut.curve.start());
        assert!((cut.axis - glam::DVec3::new(0.0, -sin, cos)).length() < 1e-9, "{control}: {:?}", cut.axis);
        assert!(outcome.verdict.found.iter().all(|f| f.code != Code::TRAVEL_EXCEEDED), "{control}");
    }
}

#[test]
fn rotary_limits_are_found_at_their_block() {
    let text = "G17 G21 G90 G94\nT2 M6\nG54\nS5000 M3\nG0 A0. C0.\nG43.4 H2 X0. Y0. Z20.\nG1 A-30. F500.\nA60.\nG49\nM30\n";
    let outcome = outcome("fanuc", text).unwrap();
    let found = outcome.verdict.found.iter().find(|f| f.code == Code::TRAVEL_EXCEEDED).unwrap();
    let place = found.place.as_ref().unwrap();
    assert_eq!((place.line, place.text.as_str()), (8, "A60."), "{found}");
    assert_eq!(found.value.as_ref().map(|v| v.value.round()), Some(60.0));
}

/// The tip along lines while the tool turns.
const TURNING: &str = "G17 G21 G90 G94\nT2 M6\nG54\nS5000 M3\nG0 A0. C0.\nG43.4 H2 X20. Y0. Z30.\n\
    G1 X10. Y0. Z2. A-20. C30. F600.\nX10. Y10. A-30. C90.\nX0. A-10.\nX-10. Y5.\nG0 Z50.\nG49\nG53 Z0.\nM30\n";

fn said(
    text: &str,
    from: Control,
    to: Control,
    orientation: Option<OrientationName>,
) -> Result<Translation, Error> {
    let job = job("fanuc");
    let loader = MemoryLoader::default().with("P.nc", "M30\n");
    let wants = ProgramWants { control: Some(from.name().to_owned()), ..ProgramWants::default() };
    let program = GivenFile { name: "Q.nc", bytes: text.as_bytes() };
    let given = given_with_job(program, &wants, ("tilted.toml", &job), &loader)?;
    translate(&given, &PostSettings::new(to), orientation)
}

#[test]
fn directions_are_said_otherwise_and_the_tool_goes_the_same_way() {
    use OrientationName::{Angles, Axes, Vectors};
    let cases = [
        (Control::Sinumerik840d, Some(Vectors), "TRAORI", "A3="),
        (Control::Sinumerik840d, Some(Angles), "TRAORI", "A=-20"),
        (Control::Heidenhain, Some(Angles), "M128", "A-20"),
        (Control::Heidenhain, Some(Vectors), "TCPM", "TX"),
        (Control::Fanuc, Some(Vectors), "G43.5", "K"),
        (Control::Fanuc, None, "G43.4", "A-20."),
        (Control::LinuxCnc, Some(Axes), "G93", "A-20"),
        (Control::Fanuc, Some(Axes), "G93", "A-20."),
    ];
    let mut axes = String::new();
    for (to, how, word, direction) in cases {
        let done = said(TURNING, Control::Fanuc, to, how).unwrap_or_else(|e| panic!("{to} {how:?}: {e}"));
        let back = done.read_back;
        assert!(back.largest < 2e-3 && back.largest_angle < 1e-4, "{to} {how:?}: {back:?}");
        assert!(done.text.contains(word) && done.text.contains(direction), "{to} {how:?}:\n{}", done.text);
        if to == Control::LinuxCnc {
            axes = done.text;
        }
    }
    let done = said(&axes, Control::LinuxCnc, Control::Fanuc, Some(Angles)).unwrap();
    assert!(done.read_back.largest < 2e-3 && done.text.contains("G43.4"), "{:?}", done.read_back);
}

#[test]
fn what_a_control_cannot_keep_on_the_path_is_refused() {
    let error = said(TURNING, Control::Fanuc, Control::LinuxCnc, None).unwrap_err();
    assert_eq!(error.code(), Code::POST_CONTROL, "{error}");
    assert!(error.0.place.is_some(), "{error}");
    let error = said(TURNING, Control::Fanuc, Control::LinuxCnc, Some(OrientationName::Vectors)).unwrap_err();
    assert!(error.to_string().contains("--orientation axes"), "{error}");
}
