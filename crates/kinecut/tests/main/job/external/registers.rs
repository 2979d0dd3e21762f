//! Registers that are not those of the tool in the spindle, and those of the cutter compensation.

use kinecut::base::{Code, Severity};

use super::{FANUC, PLAIN, outcome, removed};

#[test]
fn a_tool_called_with_the_length_of_another_is_an_error_and_cuts_where_the_machine_would() {
    // T2 is 30 mm longer than T1: with the length of T1 its tip comes 30 mm too deep.
    let wrong = FANUC.replace("H2", "H1");
    let outcome = outcome("fanuc", PLAIN, &wrong).unwrap();
    let found = outcome.verdict.found.iter().find(|f| f.code == Code::REGISTER).unwrap();
    assert_eq!((found.severity, found.value.as_ref().map(|v| v.value)), (Severity::Error, Some(100.0)));
    assert!(found.place.as_ref().unwrap().text.contains("H1"), "{found}");
    assert!(outcome.verdict.found.iter().any(|f| f.code == Code::RAPID_IN_STOCK));
    let ends = outcome.setups[0].trace.segments.iter().map(|s| s.curve.end().z);
    assert_eq!(ends.fold(f64::INFINITY, f64::min), -40.0);
}

#[test]
fn a_register_of_another_number_counts_what_the_job_says_of_it() {
    let other = FANUC.replace("H2", "H22");
    let unknown = outcome("fanuc", PLAIN, &other).unwrap();
    let finding = unknown.verdict.found.iter().find(|f| f.code == Code::REGISTER).unwrap();
    assert_eq!(finding.severity, Severity::Doubt);
    let said = "program = { file = \"P.nc\", registers = { H22 = 130.0 } }";
    assert!(outcome("fanuc", said, &other).unwrap().verdict.found.is_empty());
    let short = outcome("fanuc", &said.replace("130.0", "129.5"), &other).unwrap();
    let lowest = short.setups[0].trace.segments.iter().map(|s| s.curve.end().z).fold(f64::INFINITY, f64::min);
    assert!((lowest + 10.5).abs() < 1e-9 && !short.verdict.is_safe(), "{lowest}");
}

#[test]
fn z_without_a_length_is_told() {
    let text = FANUC.replace("G43 H1 Z20.", "Z20.");
    let outcome = outcome("fanuc", PLAIN, &text).unwrap();
    let found = outcome.verdict.found.iter().find(|f| f.code == Code::REGISTER).unwrap();
    assert!(found.message.contains("without its length"), "{found}");
}

#[test]
fn a_compensated_contour_is_cut_with_the_register_of_the_job_or_else_with_the_tool_itself() {
    // Along a straight edge at Y10, the tool left of it: its far flank lies a diameter above Y10.
    let text = "G17 G21 G90 G94 G40\nT1 M6\nG54 G0 X-10. Y0. S3000 M3\nG43 H1 Z2.\nG1 Z-3. F200.\n\
        G41 D1 Y10. F300.\nX70.\nG40 Y30.\nG0 Z20.\nM30\n";
    let width = |setup: &str, text: &str| removed(&outcome("fanuc", setup, text).unwrap()) / (3.0 * 60.0);
    let own = width(PLAIN, text);
    assert!((own - 8.0).abs() < 0.05, "{own}");
    let centre = |setup: &str, text: &str| {
        let outcome = outcome("fanuc", setup, text).unwrap();
        let cut = &outcome.setups[0].trace.segments;
        let along = cut.iter().find(|s| s.curve.length() > 60.0 && s.spindle_on).unwrap();
        along.curve.end().y
    };
    assert!((centre(PLAIN, text) - 14.0).abs() < 1e-9);
    let given = "program = { file = \"P.nc\", registers = { D11 = 4.25 } }";
    let with_eleven = text.replace("D1 ", "D11 ");
    assert!((centre(given, &with_eleven) - 14.25).abs() < 1e-9);
    // The register of the other tool, which is 6 mm in diameter.
    let wrong = outcome("fanuc", PLAIN, &text.replace("D1 ", "D2 ")).unwrap();
    let found = wrong.verdict.found.iter().find(|f| f.code == Code::REGISTER).unwrap();
    assert!(found.message.contains("by the radius of T2"), "{found}");
    assert_eq!(found.severity, Severity::Error);
}
