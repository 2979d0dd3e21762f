//! FANUC: variables, statements, `M98`, `G65`.
//!
//! Expected values: traps A1 to A4 and A10 were worked out by hand from the rules of the control.

use crate::{read, refused, run};
use kinecut_nc::base::Sources;
use kinecut_nc::nc::Control::Fanuc;
use kinecut_nc::nc::{self, NumberInput, ReadSettings};

#[test]
fn a_word_with_an_empty_variable_counts_for_nothing() {
    let body = "#1=#0\nG0 X5. Y5.\nG0 X#1 Y10.\nG0 X[#1+0] Y11.";
    assert_eq!(run(body, Fanuc), ["R 5 5 0", "R 5 10 0", "R 0 11 0"]);
}

#[test]
fn nought_is_not_empty() {
    assert_eq!(run("#1=0\nIF[#1EQ#0]GOTO10\nG0 X1.\nN10 G0 Y1.", Fanuc), ["R 1 0 0", "R 1 1 0"]);
    assert_eq!(run("IF[#1EQ#0]GOTO10\nG0 X1.\nN10 G0 Y1.", Fanuc), ["R 0 1 0"]);
}

#[test]
fn arguments_fill_local_variables() {
    let macros = "M30\nO9\nG0 X#4 Y#7\nM99";
    assert_eq!(run(&format!("G65 P9 A1. I2. I3. D9.\n{macros}"), Fanuc), ["R 2 9 0"]);
    assert_eq!(run(&format!("G65 P9 A1. D9. I2. I3.\n{macros}"), Fanuc), ["R 2 3 0"]);
    // The caller's own stay as they were.
    let body = "#1=7.\nG65 P9 A1. L2\nG0 X#1\nM30\nO9\n#1=#1+1.\nG0 Y#1\nM99";
    assert_eq!(run(body, Fanuc), ["R 0 2 0", "R 0 2 0", "R 7 2 0"]);
}

#[test]
fn digits_before_the_program_number_count_calls() {
    let body = "M98 P31000\nM98 P1000 L2\nM30\nO1000\nG91 G0 X10.\nG90 M99";
    assert_eq!(run(body, Fanuc), ["R 10 0 0", "R 20 0 0", "R 30 0 0", "R 40 0 0", "R 50 0 0"]);
}

#[test]
fn statements_turn_and_branch() {
    let body = "#1=0\nWHILE[#1LT3]DO1\n#1=#1+1\n#2=0\nDO2\n#2=#2+1\nIF[#2GE2]GOTO5\nEND2\nN5 G0 X#1 Y#2\nEND1\nIF[#1EQ3]THEN #1=9\nG0 Z#1";
    assert_eq!(run(body, Fanuc), ["R 1 2 0", "R 2 2 0", "R 3 2 0", "R 3 2 9"]);
    assert_eq!(run("GOTO[1+1]\nN1 G0 X1.\nN2 G0 Y1.", Fanuc), ["R 0 1 0"]);
    assert_eq!(run("#1=1\nWH[#1LE2]DO1\nG0X#1\n#1=#1+1\nEN1", Fanuc), ["R 1 0 0", "R 2 0 0"]);
}

#[test]
fn values_are_rounded_to_the_least_increment() {
    assert_eq!(run("#1=10/3\nG0 X#1", Fanuc), ["R 3.333 0 0"]);
    assert_eq!(
        run("G0 X[FIX[-1.5]] Y[FUP[-1.5]]\nG0 X[ATAN[-1.]/[-1.]]", Fanuc),
        ["R -1 -2 0", "R 225 -2 0"]
    );
    // A computed number is in units, not in increments.
    assert_eq!(run("#1=10\nG0 X#1 Y10", Fanuc), ["R 10 0.01 0"]);
}

#[test]
fn the_state_is_saved_and_restored() {
    assert_eq!(
        run("G91\n#10=#4003\nG90 G0 X5.\nG#10 X5.\nX[#5001]", Fanuc),
        ["R 5 0 0", "R 10 0 0", "R 20 0 0"]
    );
}

#[test]
fn several_programs_are_in_a_file() {
    let text = "%\nO1\nG21 G54 G0 X0. Y0. Z0.\nM98 P2\nM30\nO2(SUB)\nG0 X1.\nM99\n%\n";
    let reading = read(text, Fanuc).unwrap();
    assert_eq!(crate::moves(&reading), ["R 0 0 0", "R 1 0 0"]);
    assert!(reading.findings.iter().all(|f| !f.message.contains("not run")), "{:?}", reading.findings);
}

#[test]
fn a_subprogram_ends() {
    let error = read("G21 G54 G0 X0. Y0. Z0.\nM98 P9\nM30\nO9\nG0 X1.\n", Fanuc).unwrap_err();
    assert_eq!(error, "a.nc:5:7: the file ends within a subprogram, without M99; called in line 2 of a.nc");
    let text = "O1\nG21 G54 G0 X0. Y0. Z0.\nM98 P9\nG0 X5.\nM30\nO9\nG0 X1.\nO10\nG0 X2.\nM99\n";
    let reading = read(text, Fanuc).unwrap();
    assert_eq!(crate::moves(&reading), ["R 0 0 0", "R 1 0 0", "R 5 0 0"]);
    assert!(
        reading.findings.iter().any(|f| f.message.contains("would run on into it")),
        "{:?}",
        reading.findings
    );
}

#[test]
fn numbers_without_a_point_have_two_meanings() {
    let said = |text: &str, input| {
        let mut sources = Sources::default();
        let file = sources.add("a.nc", text);
        let settings = ReadSettings { input, ..ReadSettings::default() };
        let reading = nc::read_source(&sources, file, Fanuc, &[], &settings).unwrap();
        (
            crate::moves(&reading).pop().unwrap(),
            reading.findings.iter().map(|f| f.message.clone()).collect::<Vec<_>>(),
        )
    };
    let none = "G21 G54 G0 X8 Y0 Z10\nM30\n";
    let mixed = "G21 G54 G0 X8. Y0 Z10\nM30\n";
    assert_eq!(said(none, NumberInput::Auto).0, "R 8 0 10");
    assert_eq!(said(none, NumberInput::LeastIncrement).0, "R 0.008 0 0.01");
    assert_eq!(said(mixed, NumberInput::Auto).0, "R 8 0 0.01");
    assert_eq!(said(mixed, NumberInput::Calculator).0, "R 8 0 10");
    assert_eq!(
        said(none, NumberInput::Auto).1,
        [
            "`X8` has no decimal point, nor has any other coordinate of the program: read as 8 mm, in whole units (parameter 3401)"
        ]
    );
    assert_eq!(
        said(mixed, NumberInput::Auto).1,
        [
            "`Z10` has no decimal point, other coordinates of the program have one: read as 0.01 mm, in least increments (parameter 3401)"
        ]
    );
    assert!(said("G21 G54 G0 X8. Y0 Z1.\nM30\n", NumberInput::Auto).1.is_empty());
    let error = refused("G0 X50. Y-50.\nG2 X50. Y-50 I-50. J50. F100.", Fanuc);
    assert!(
        error.contains("`Y-50` has no decimal point") && error.contains("write Y-50. if that is meant"),
        "{error}"
    );
}

#[test]
fn each_fault_is_said_where_it_is() {
    let cases = [
        ("#3000=5(TOO DEEP)", "the program stops itself with alarm 5: TOO DEEP"),
        ("GOTO 7", "the block N7 that is gone to is not in this program"),
        ("WHILE[1EQ1]DO1\nG0 X1.", "a loop without its END"),
        ("END1", "an END without its DO"),
        ("DO4\nEND4", "loops are labelled 1, 2 or 3"),
        ("#1=[1LT2]", "a condition has no value"),
        ("#1=2 G0 X1.", "a macro statement is in a block of its own"),
        ("G0 X1. #1=2", "a macro statement is in a block of its own"),
        ("G0 X[#3012]", "it is a clock of the machine"),
        ("#0=1", "#0 is always empty"),
        ("G65 A1.", "a call without the number of the program"),
        ("M98 P9\nM30\nO9\nG0 X[1/0]\nM99", "division by zero; called in line 2 of a.nc"),
        ("N1 G0 X1.\nX0.\nGOTO1", "it never ends"),
    ];
    for (body, expected) in cases {
        let error = refused(body, Fanuc);
        assert!(error.contains(expected), "{body}: {error}");
    }
}

#[test]
fn a_common_variable_that_nothing_sets_is_not_proven() {
    let reading = read("G21 G54 G0 X0. Y0. Z0.\nG0 X#101 Y1.\nM30\n", Fanuc).unwrap();
    let found = reading.findings.iter().find(|f| f.message.contains("#101 is read before")).unwrap();
    assert_eq!(found.severity, kinecut_nc::base::Severity::Doubt);
    // A local one is empty for certain.
    let reading = read("G21 G54 G0 X0. Y0. Z0.\nG0 X#1 Y1.\nM30\n", Fanuc).unwrap();
    assert!(reading.findings.is_empty(), "{:?}", reading.findings);
}

#[test]
fn the_count_of_calls_is_read_from_written_digits_only() {
    let body = |call: &str| format!("{call}\nM30\nO10\nG91 G0 X1.\nG90 M99\nO1002\nG91 G0 X2.\nG90 M99");
    assert_eq!(run(&body("M98 P[1000+2]"), Fanuc), ["R 2 0 0"]);
    assert_eq!(run(&body("M98 P00010"), Fanuc), ["R 1 0 0"]);
    assert_eq!(run(&body("M98 P20010"), Fanuc), ["R 1 0 0", "R 2 0 0"]);
}

#[test]
fn arguments_without_a_point_count_as_the_control_is_set() {
    let of = |input| {
        let mut sources = Sources::default();
        let file = sources.add("a.nc", "G21 G54 G0 X0 Y0 Z0\nG65 P9 X5\nM30\nO9\nG0 X#24\nM99\n");
        let settings = ReadSettings { input, ..ReadSettings::default() };
        crate::moves(&nc::read_source(&sources, file, Fanuc, &[], &settings).unwrap()).pop().unwrap()
    };
    assert_eq!(
        (of(NumberInput::Calculator), of(NumberInput::LeastIncrement)),
        ("R 5 0 0".into(), "R 0.005 0 0".into())
    );
}

#[test]
fn a_variable_is_said_at_the_statement_that_reads_it() {
    let line = |text: &str| {
        let reading = read(text, Fanuc).unwrap();
        reading
            .findings
            .iter()
            .find(|f| f.message.contains("#101 is read"))
            .unwrap()
            .place
            .as_ref()
            .unwrap()
            .line
    };
    assert_eq!(line("G21 G54 G0 X0. Y0. Z0.\nIF[#101EQ1]GOTO5\nG0 X1.\nN5 M30\n"), 2);
    assert_eq!(line("G21 G54 G0 X0. Y0. Z0.\nWHILE[#101EQ1]DO1\nEND1\nM30\n"), 2);
    assert_eq!(line("G21 G54 G0 X0. Y0. Z0.\nIF[#101EQ1]THEN #1=2\nM30\n"), 2);
}
