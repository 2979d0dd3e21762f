//! Rules about simulated programs: each with a program that breaks it, the block at which that is told, and a right program
//! close to it.

mod cutting;
mod down;
mod planned;
mod removal;
mod standing;
mod switched;
mod tap;

use kinecut::base::{Code, MemoryLoader, Severity, Silent};
use kinecut::job::{Outcome, run};

/// A small plate, a mill of 8, a drill of 6, and what a test adds to the first of them.
pub(crate) fn job(control: &str, mill: &str, more: &str, setup: &str) -> String {
    format!(
        r#"format = 1
post = {{ control = "{control}" }}
stock = {{ box = {{ min = [0, 0, -12], max = [60, 40, 0] }} }}
simulate = {{ step = 1.0 }}
{more}
[[tool]]
number = 1
type = "end-mill"
diameter = 8
flute_length = 20
stickout = 30
gauge_length = 100
{mill}
[[tool]]
number = 2
type = "drill"
diameter = 6
flute_length = 40
stickout = 50
gauge_length = 130
[[setup]]
offset = "G54"
{setup}
"#
    )
}

/// A right program: a slot in two levels and two holes.
pub(crate) const GOOD: &str = "%\nO7 (PLATE)\nG17 G21 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X15. Y20. S3000 M3\n\
    G43 H1 Z20. M8\nZ2.\nG1 Z-2. F200.\nX45. F400.\nZ-4. F200.\nX15. F400.\nG0 Z20. M9\nG91 G28 Z0. M5\nG90\nT2 M6\n\
    G54 G0 X15. Y8. S2000 M3\nG43 H2 Z20. M8\nG99 G81 X15. Y8. Z-10. R2. F150.\nX45.\nG80\nG0 Z20. M9\nM5\nM30\n%\n";

/// A program with the mill alone, from its first feed move at X15 Y20 Z2 on.
pub(crate) fn mill(body: &str) -> String {
    format!(
        "%\nO8\nG17 G21 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X15. Y20. S3000 M3\nG43 H1 Z20. M8\nZ2.\n{body}\n\
         G0 Z20. M9\nM5\nM30\n%\n"
    )
}

/// The same with the drill.
pub(crate) fn drill(body: &str) -> String {
    mill(body).replace("T1", "T2").replace("H1", "H2")
}

pub(crate) fn outcome(text: &str, program: &str) -> Outcome {
    let loader = MemoryLoader::default().with("P.nc", program);
    run("plate.toml", text, &loader, &Silent).unwrap_or_else(|e| panic!("{e}\n{program}"))
}

pub(crate) const PLAIN: &str = "program = { file = \"P.nc\" }";

/// A program on the plain plate.
pub(crate) fn fanuc(program: &str) -> Outcome {
    outcome(&job("fanuc", "", "", PLAIN), program)
}

/// With further keys of the mill.
pub(crate) fn with_mill(keys: &str, program: &str) -> Outcome {
    outcome(&job("fanuc", keys, "", PLAIN), program)
}

/// The blocks at which a code is told.
pub(crate) fn blocks(outcome: &Outcome, code: Code) -> Vec<String> {
    let found = outcome.verdict.found.iter().filter(|f| f.code == code);
    found.map(|f| f.place.as_ref().map(|p| p.text.clone()).unwrap_or_default()).collect()
}

/// That a code is told once, at this block.
#[track_caller]
pub(crate) fn told(outcome: &Outcome, code: Code, severity: Severity, block: &str) {
    assert_eq!(blocks(outcome, code), [block], "{:?}", outcome.verdict.found);
    assert!(outcome.verdict.found.iter().all(|f| f.code != code || f.severity == severity));
}

/// That nothing above a note is told.
#[track_caller]
pub(crate) fn right(outcome: &Outcome) {
    let bad: Vec<_> = outcome.verdict.found.iter().filter(|f| f.severity > Severity::Note).collect();
    assert!(bad.is_empty(), "{bad:?}");
    assert!(outcome.verdict.is_safe());
}

#[test]
fn a_right_program_breaks_no_rule() {
    right(&fanuc(GOOD));
}
