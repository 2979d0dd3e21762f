//! Tools that lean or turn near the stock, rapids axis by axis, axis speeds, registers: what must not be called safe, and what must stay so.

use kinecut::base::{Code, Finding, MemoryLoader, Severity, Silent};
use kinecut::job::{Judgement, Outcome, run};

use crate::common::job;

/// A block on a trunnion machine: table A C below it, 60 mm under its top.
const TRUNNION: &str = r#"format = 1
stock = { box = { min = [-30, -25, -30], max = [30, 25, 0] } }
simulate = { step = 1.0 }
[[holder]]
name = "H"
segments = [{ height = 40, lower_diameter = 40 }]
[[tool]]
number = 1
type = "drill"
diameter = 8
flute_length = 60
stickout = 80
gauge_length = 160
holder = "H"
[[tool]]
number = 2
type = "ball-nose"
diameter = 6
flute_length = 12
stickout = 50
gauge_length = 130
holder = "H"
[machine]
code = "641203"
travel = { X = [-400, 400], Y = [-350, 350], Z = [-650, 0], A = [-115, 35], C = [-3600, 3600] }
[machine.axis.A]
point = [0, 0, -480]
rapid = 25
[machine.axis.C]
rapid = 50
[[setup]]
offset = "G54"
position = [0, 0, -420]
program = { file = "P.nc" }
"#;

fn trunnion(text: &str) -> Outcome {
    let job = format!("post = {{ control = \"fanuc\" }}\n{TRUNNION}");
    job::run_program(&job, text).unwrap()
}

fn of(outcome: &Outcome, code: Code) -> Vec<&Finding> {
    outcome.verdict.found.iter().filter(|f| f.code == code).collect()
}

fn lines(found: &[&Finding]) -> Vec<u32> {
    found.iter().map(|f| f.place.as_ref().unwrap().line).collect()
}

fn judged(outcome: &Outcome) -> Judgement {
    Judgement::of(&outcome.verdict.found)
}

const START: &str = "G17 G21 G40 G49 G80 G90 G94\nG53 G0 Z0.\nG53 G0 A0. C0.\nT1 M6\nG54 G0 X-20. Y10. S3000 M3\n\
    G43 H1 G0 Z50.\n";
const END: &str = "G0 Z50.\nG69\nG53 G0 Z0. M5\nG53 G0 A0. C0.\nM30\n";

#[test]
fn a_rapid_of_straight_and_turning_axes_is_tried_axis_by_axis_too() {
    let text = format!("{START}G0 X30. Y40. A-10.\nG0 A0.\n{END}");
    let other = |text: &str| {
        let segments = trunnion(text).setups[0].trace.segments.clone();
        segments.iter().filter(|s| s.turning.is_some() && s.alternative).count()
    };
    assert!(other(&text) > 0);
    assert_eq!(other(&text.replace("G0 X30. Y40. A-10.", "G0 X30. Y40.\nG0 A-10.")), 0);
}

#[test]
fn a_table_that_turns_below_a_retracted_tool_is_no_finding() {
    let text = format!(
        "{START}G81 X-20. Y10. Z-20. R2. F300.\nG80\nG53 G0 Z0.\nG68.2 X0. Y-25. Z-15. I0. J90. K0.\nG53.1\nG0 X-10. Y0.\n\
         G43 H1 G0 Z50.\nG81 X-10. Y0. Z-10. R2. F300.\nG80\n{END}"
    );
    let outcome = trunnion(&text);
    assert!(outcome.verdict.found.is_empty(), "{:?}", outcome.verdict.found);
    assert!(outcome.setups[0].trace.segments.iter().any(|s| s.turning.is_some()));
    assert!(outcome.verdict.proven.iter().any(|p| p.claim.contains("no rapid move")));
}

#[test]
fn a_table_that_turns_with_the_tool_in_the_part_is_an_error() {
    let text =
        format!("{START}G1 Z-20. F300.\nG68.2 X0. Y-25. Z-15. I0. J90. K0.\nG53.1\nG0 X-10. Y0.\n{END}");
    let outcome = trunnion(&text);
    assert_eq!(judged(&outcome), Judgement::NotSafe);
    assert_eq!(lines(&of(&outcome, Code::TURNED_INTO_STOCK)), [9], "{:?}", outcome.verdict.found);
}

#[test]
fn a_rapid_that_only_turns_an_axis_is_an_error_where_the_part_comes_up_to_the_tool() {
    let turned = |height: &str| {
        let text = format!("{START}G0 X-20. Y0. Z{height}\nG53 G0 A-20.\nG53 G0 A0.\n{END}");
        lines(&of(&trunnion(&text), Code::TURNED_INTO_STOCK))
    };
    // The axis lies 60 mm below the top, which at 20 degrees is 60 (1 / cos 20 - 1) = 3.85 mm higher below the drill's tip. A tip
    // that goes 0.15 mm deep lies between lines 1 mm apart: a closer look finds it.
    assert_eq!(turned("3.7"), [8]);
    assert_eq!(turned("3.9"), [0; 0]);
}

/// Five axes: down onto the part leaning by 20 degrees, once around.
fn around(spindle: &str, plunge: &str, last: &str) -> String {
    format!(
        "G17 G21 G40 G49 G80 G90 G94\nG53 G0 Z0.\nG53 G0 A0. C0.\nT2 M6\nG54\n{spindle}G53 G0 A-20. C0.\nG43.4 H2\n\
         G0 X0. Y-12. Z54. A-20. C0.\nG0 Z5.\nG1 Z-0.4 F300.\nX8. Y-9. A-20. C30. F600.\nX12. Y0.{plunge} A-20. C90.\n\
         X0. Y12. A-20. C{last}\nG0 Z54.\nG49\nG53 G0 Z0. M5\nG53 G0 A0. C0.\nM30\n"
    )
}

#[test]
fn five_axes_that_cut_are_cut_and_safe() {
    let outcome = trunnion(&around("S9000 M3\n", "", "180."));
    assert_eq!(judged(&outcome), Judgement::Safe, "{:?}", outcome.verdict.found);
    assert!(outcome.simulation.raw_volume - outcome.simulation.stock.volume() > 10.0);
}

#[test]
fn a_standing_spindle_or_a_shank_in_the_part_is_found_though_the_tool_leans() {
    let outcome = trunnion(&around("", "", "180."));
    assert!(!of(&outcome, Code::SPINDLE_OFF).is_empty(), "{:?}", outcome.verdict.found);
    // 20 mm down with flutes of 12: the shank has not cut what it stands in. The flutes may have.
    let outcome = trunnion(&around("S9000 M3\n", " Z-24.", "180."));
    assert!(!of(&outcome, Code::SHANK_IN_STOCK).is_empty(), "{:?}", outcome.verdict.found);
    assert!(of(&outcome, Code::SPINDLE_OFF).is_empty());
}

#[test]
fn a_drill_that_enters_a_face_that_leans_is_not_proven() {
    let tilted = |angle: &str| {
        let text = format!(
            "{START}G53 G0 Z0.\nG68.2 X0. Y-25. Z-15. I0. J{angle} K0.\nG53.1\nG0 X-10. Y0.\nG43 H1 G0 Z50.\n\
             G81 X-10. Y0. Z-10. R4. F300.\nG80\n{END}"
        );
        trunnion(&text)
    };
    // The front is square to a plane turned by 90 degrees.
    let outcome = tilted("60.");
    let found = of(&outcome, Code::INCLINED_ENTRY);
    assert_eq!((found.len(), lines(&found), judged(&outcome)), (1, vec![12], Judgement::NotProven));
    assert!((found[0].value.as_ref().unwrap().value - 30.0).abs() < 0.1, "{}", found[0]);
    for right in ["85.", "90."] {
        assert!(of(&tilted(right), Code::INCLINED_ENTRY).is_empty());
    }
}

#[test]
fn axes_that_turn_in_a_cut_without_control_of_the_tip_are_not_proven() {
    let text = around("S9000 M3\n", "", "180.");
    assert!(of(&trunnion(&text), Code::TIP_NOT_CONTROLLED).is_empty());
    let outcome = trunnion(&text.replace("G43.4 H2", "G43 H2"));
    let found = of(&outcome, Code::TIP_NOT_CONTROLLED);
    assert_eq!(found.len(), 1, "{:?}", outcome.verdict.found);
    assert_ne!(judged(&outcome), Judgement::Safe);
    // Near the middle of a turn by 90 degrees at 12 mm or more from its centre.
    assert!(found[0].value.as_ref().unwrap().value > 1.0, "{}", found[0]);
}

#[test]
fn an_axis_that_goes_the_long_way_round_in_a_cut_is_too_fast() {
    assert!(of(&trunnion(&around("S9000 M3\n", "", "180.")), Code::AXIS_TOO_FAST).is_empty());
    // 17 mm at 600 mm/min take 1.7 s; C goes from 90 to -720 degrees: 79 rev/min, and 50 are allowed.
    let outcome = trunnion(&around("S9000 M3\n", "", "-720."));
    let found = of(&outcome, Code::AXIS_TOO_FAST);
    assert_eq!(lines(&found), [14], "{:?}", outcome.verdict.found);
    let value = |v: &Option<kinecut::base::Quantity>| v.as_ref().unwrap().value;
    assert!((value(&found[0].bound) - 50.0).abs() < 1e-9 && value(&found[0].value) > 70.0, "{}", found[0]);
}

/// A plate with a wall: a channel along X and one along Y that meet, so that a straight rapid between their ends crosses the
/// corner block and one axis by axis may not, or the other way round.
const PLATE: &str = r#"format = 1
stock = { box = { min = [0, 0, -10], max = [60, 60, 0] } }
simulate = { step = 1.0 }
[[tool]]
number = 1
type = "end-mill"
diameter = 8
flute_length = 20
gauge_length = 100
[[tool]]
number = 2
type = "end-mill"
diameter = 6
flute_length = 20
gauge_length = 130
"#;

fn plate(control: &str, more: &str, text: &str) -> Outcome {
    let job = format!(
        "post = {{ control = \"{control}\" }}\n{PLATE}{more}[[setup]]\noffset = \"G54\"\n\
        position = [0, 0, -300]\nprogram = {{ file = \"P.nc\" }}\n"
    );
    job::run_program(&job, text).unwrap()
}

/// A diagonal slot, then a rapid back through it: free on the straight line, through the wall on any other.
const SLOT: &str = "G17 G21 G90 G94\nT1 M6\nG54 G0 X10. Y10. S3000 M3\nG43 H1 Z5.\nG1 Z-4. F200.\nX50. Y30. F400.\n\
    G0 X10. Y10.\nG0 Z50.\nM5\nM30\n";

fn machine(more: &str) -> String {
    format!("[machine]\ncode = \"2103\"\n{more}\n")
}

#[test]
fn rapids_are_tried_both_ways_unless_the_machine_or_the_language_says_which() {
    let met =
        |control: &str, more: &str, text: &str| lines(&of(&plate(control, more, text), Code::RAPID_IN_STOCK));
    let siemens = SLOT.replace("G43 H1 Z5.", "D1 Z5.").replace("G17 G21", "G17 G710");
    assert_eq!(met("fanuc", "", SLOT), [7]);
    assert_eq!(met("fanuc", &machine("rapids = \"axis-by-axis\""), SLOT), [7]);
    assert!(met("fanuc", &machine("rapids = \"straight\""), SLOT).is_empty());
    assert_eq!(met("sinumerik-840d", "", &siemens), [7]);
    assert!(met("sinumerik-840d", &machine("rapids = \"straight\""), &siemens).is_empty());
    assert!(met("linuxcnc", "", SLOT).is_empty());
    assert_eq!(met("linuxcnc", &machine("rapids = \"axis-by-axis\""), SLOT), [7]);
    // A rapid in machine coordinates is none other.
    let back = SLOT.replace("G0 X10. Y10.\nG0 Z50.", "G53 G0 X10. Y10.\nG0 Z50.");
    assert_eq!(met("fanuc", "", &back), [7]);
}

#[test]
fn axes_with_rapid_speeds_of_their_own_run_another_way() {
    // A slot along the diagonal: with equal speeds the rapid keeps to it, with a slow Y it does not.
    let text = SLOT.replace("X50. Y30.", "X50. Y50.");
    let slow = machine("dynamics = { rapid = 20000 }\naxis = { Y = { rapid = 5000 } }");
    assert!(of(&plate("fanuc", "", &text), Code::RAPID_IN_STOCK).is_empty());
    assert_eq!(lines(&of(&plate("fanuc", &slow, &text), Code::RAPID_IN_STOCK)), [7]);
}

#[test]
fn h0_is_length_zero_and_drives_the_tool_into_the_part() {
    let text = SLOT.replace("G0 X10. Y10.\nG0 Z50.", "G0 Z50.");
    assert!(plate("fanuc", "", &text).verdict.found.is_empty());
    let outcome = plate("fanuc", "", &text.replace("H1", "H0"));
    let found = of(&outcome, Code::REGISTER);
    assert_eq!((found[0].severity, lines(&found)[0]), (Severity::Error, 4), "{:?}", outcome.verdict.found);
    let lowest = outcome.setups[0].trace.segments.iter().map(|s| s.curve.end().z);
    assert_eq!(lowest.fold(f64::INFINITY, f64::min), -104.0);
    // Where nothing says where the work lies it cannot be simulated: not proven.
    let job = format!(
        "post = {{ control = \"fanuc\" }}\n{PLATE}[[setup]]\noffset = \"G54\"\nprogram = {{ file = \"P.nc\" }}\n"
    );
    let loader = MemoryLoader::default().with("P.nc", text.replace("H1", "H0"));
    let outcome = run("plate.toml", &job, &loader, &Silent).unwrap();
    assert_eq!(of(&outcome, Code::REGISTER)[0].severity, Severity::Doubt);
}

#[test]
fn an_approach_from_above_or_beside_is_right_and_one_down_in_the_stock_is_not_proven() {
    let beside =
        "G17 G21 G90 G94\nT1 M6\nG54 G0 X-20. Y20. S3000 M3\nG43 H1 Z-4.\nG1 X20. F300.\nG0 Z50.\nM5\nM30\n";
    assert!(of(&plate("fanuc", "", beside), Code::UNKNOWN_START).is_empty());
    let above =
        "G17 G21 G90 G94\nT1 M6\nG54\nG43 H1 G0 X20. Y20. Z5. S3000 M3\nG1 Z-2. F300.\nG0 Z50.\nM5\nM30\n";
    assert!(plate("fanuc", "", above).verdict.found.is_empty());
    let down = above.replace("Z5.", "Z-5.");
    let outcome = plate("fanuc", "", &down);
    let found = of(&outcome, Code::UNKNOWN_START);
    assert_eq!((found[0].severity, lines(&found)[0]), (Severity::Doubt, 4), "{:?}", outcome.verdict.found);
}

#[test]
fn a_coordinate_without_a_point_among_others_with_one_is_told_with_what_was_read() {
    let text = SLOT.replace("G0 X10. Y10.\nG0 Z50.", "G0 Z50.");
    let found = |text: &str| {
        let outcome = plate("fanuc", "", text);
        let of: Vec<Finding> = of(&outcome, Code::NC_ASSUMED).into_iter().cloned().collect();
        of
    };
    let lost = found(&text.replace("X50. Y30.", "X50 Y30."));
    assert_eq!((lost.len(), lost[0].severity), (1, Severity::Warning));
    assert_eq!(lost[0].place.as_ref().unwrap().line, 6);
    assert!(lost[0].message.contains("X50") && lost[0].message.contains("0.05 mm"), "{}", lost[0]);
    assert!(found(&text).is_empty());
    // A nought is one either way; a program without any point counts whole units, and that is said.
    assert!(found(&text.replace("G0 Z50.", "G0 X0 Y0 Z50.")).is_empty());
    let units = "G17 G21 G90 G94\nT1 M6\nG54 G0 X10 Y10 S3000 M3\nG43 H1 Z5\nG1 Z-4 F200\nG0 Z50\nM5\nM30\n";
    let said = found(units);
    assert!(said.len() == 1 && said[0].message.contains("`X10` has no decimal point"), "{said:?}");
    assert!(said[0].message.contains("read as 10 mm"), "{said:?}");
}

#[test]
fn a_control_that_rounds_corners_is_told_of_programs_that_ask_for_it_only() {
    let listed = |text: &str| {
        let outcome = plate("linuxcnc", "", text);
        outcome.setups[0].trace.assumed.iter().any(|a| a.contains("rounds corners"))
    };
    assert!(listed(&SLOT.replace("G90 G94", "G90 G94 G64")));
    assert!(!listed(&SLOT.replace("G90 G94", "G90 G94 G64 P0.01")));
    assert!(!listed(SLOT));
}

#[test]
fn one_work_offset_that_is_not_said_is_an_assumption_and_no_warning() {
    let text = SLOT.replace("G54 G0 X10. Y10. S3000 M3", "G0 X10. Y10. S3000 M3");
    let outcome = plate("linuxcnc", "", &text);
    assert!(outcome.verdict.found.is_empty(), "{:?}", outcome.verdict.found);
    let external = outcome.setups[0].external.as_ref().unwrap();
    assert!(
        external.unfollowed.iter().any(|n| n.what.contains("G54 is assumed")),
        "{:?}",
        external.unfollowed
    );
}

/// Two setups of one block, turned over between them.
const TWO: &str = r#"format = 1
stock = { box = { min = [-30, -30, -20], max = [30, 30, 0] } }
simulate = { step = 1.0 }
[[tool]]
number = 1
type = "end-mill"
diameter = 10
flute_length = 25
[[setup]]
offset = "G54"
[[setup.operation]]
type = "bore"
tool = 1
at = [-10, 0]
diameter = 20
depth = 5
strategy = "involute"
entry = { helix = { radius = 3, pitch = 1 } }
speed = 6000
rough = { stepover = 2, allowance = 0.3, feed = 1500, plunge_feed = 500 }
finish = { turns = 1, feed = 900 }
[[setup]]
offset = "G55"
[[setup.operation]]
type = "bore"
tool = 1
at = [12, 0]
diameter = 20
depth = 5
strategy = "involute"
entry = { helix = { radius = 3, pitch = 1 } }
speed = 6000
rough = { stepover = 2, allowance = 0.3, feed = 1500, plunge_feed = 500 }
finish = { turns = 1, feed = 900 }
"#;

#[test]
fn the_programs_of_two_setups_have_names_and_numbers_of_their_own() {
    let posted = |control: &str, more: &str| -> Vec<(String, String)> {
        let job = format!("post = {{ control = \"{control}\"{more} }}\n{TWO}");
        let outcome = job::run(&job).unwrap();
        outcome.setups.iter().map(|s| (s.file.clone(), s.posted.text.to_string())).collect()
    };
    let two = posted("fanuc", ", program = \"PLATE\"");
    assert_eq!([&two[0].0, &two[1].0], ["PLATE_1.nc", "PLATE_2.nc"]);
    assert!(two[0].1.contains("O0001") && two[1].1.contains("O0002") && !two[1].1.contains("O0001"));
    let two = posted("fanuc", ", program = \"O1234\"");
    assert!(two[0].1.contains("O1234") && two[1].1.contains("O1235"));
    let two = posted("heidenhain", ", program = \"PLATE\"");
    assert!(two[0].1.contains("BEGIN PGM PLATE_1 MM") && two[1].1.contains("BEGIN PGM PLATE_2 MM"));
    let job = format!("post = {{ control = \"fanuc\", program_number = 9999 }}\n{TWO}");
    let error = job::run(&job).unwrap_err();
    assert_eq!(error.code(), Code::JOB_VALUE, "{error}");
}

#[test]
fn each_program_of_a_report_has_its_own_lines() {
    let job = format!("post = {{ control = \"fanuc\" }}\n{TWO}");
    let outcome = job::run(&job).unwrap();
    let report = kinecut::job::report::of_job(&outcome);
    let program = report.program.as_ref().unwrap();
    assert!(program.lines.iter().all(|l| !l.starts_with("---")));
    let second = program.parts[1].first as usize;
    assert_eq!(program.lines[second], outcome.setups[1].posted.text.lines().next().unwrap());
    assert!(report.path.iter().any(|p| p.block as usize >= second));
    let page = kinecut::job::report::html(&report);
    assert_eq!(page.matches("<pre class=\"kc-program\"").count(), 2);
    assert!(page.contains("kc-tabs"));
}
