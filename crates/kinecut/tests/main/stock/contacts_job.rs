//! Programs whose tool, shank or holder overlaps a wall by less than the distance of the lines of the stock model, and
//! tools thinner than that: found, or said to be unproven.

use kinecut::base::{Code, MemoryLoader, Severity, Silent};
use kinecut::job::{Judgement, Outcome, run};

/// A block of a size, lines at a step (none: the default), an end mill of 12 with a stickout, and a fine drill.
fn outcome(size: [f64; 3], step: Option<f64>, stickout: f64, extra: &str, program: &str) -> Outcome {
    let step = step.map(|s| format!("simulate = {{ step = {s:?} }}")).unwrap_or_default();
    let job = format!(
        r#"format = 1
stock = {{ box = {{ min = [0, 0, {:?}], max = [{:?}, {:?}, 0] }} }}
post = {{ control = "fanuc" }}
{step}
{extra}
[[holder]]
name = "chuck"
segments = [{{ height = 40, lower_diameter = 40 }}, {{ height = 30, lower_diameter = 50 }}]
[[tool]]
number = 1
type = "end-mill"
diameter = 12
flute_length = 26
stickout = {stickout:?}
holder = "chuck"
gauge_length = 120
[[tool]]
number = 2
type = "drill"
diameter = 0.4
flute_length = 6
stickout = 20
holder = "chuck"
gauge_length = 90
[[setup]]
offset = "G54"
program = {{ file = "P.nc" }}
"#,
        -size[2], size[0], size[1]
    );
    let loader = MemoryLoader::default().with("P.nc", program);
    run("block.toml", &job, &loader, &Silent).unwrap_or_else(|e| panic!("{e}"))
}

/// A program that begins above the block with the mill.
fn program(blocks: &str) -> String {
    format!(
        "%\nO0007\nG17 G21 G40 G49 G80 G90 G94\nG53 G0 Z0.\nT1 M6\nG54 G0 X-10. Y40. S4000 M3\nG43 H1 Z70. M8\n{blocks}\nG0 Z70. M9\nG53 G0 Z0. M5\nM30\n%\n"
    )
}

/// The lines (1 is the first) at which a code was found as an error.
fn lines(outcome: &Outcome, code: Code) -> Vec<u32> {
    let found = outcome.verdict.found.iter().filter(|f| f.code == code && f.severity == Severity::Error);
    found.map(|f| f.place.as_ref().map_or(0, |p| p.line)).collect()
}

/// Blocks written after the head of [`program`] are counted from here.
const FIRST: u32 = 8;

/// Widths of the block, steps, and how far beside its path the tool comes back.
const CASES: [(f64, Option<f64>, f64); 4] =
    [(100.0, Some(0.5), 0.2), (600.0, Some(0.47), 0.4), (100.0, Some(2.0), 0.02), (300.0, Some(0.26), 0.05)];

#[test]
fn a_rapid_beside_its_slot_is_found_and_one_in_it_is_not() {
    for (width, step, beside) in CASES {
        let end = width + 10.0;
        let back = |y: f64| program(&format!("Z2.\nG1 Z-4. F800.\nX{end:.3}\nG0 Y{y:.3}\nX-10.\n"));
        let size = [width, 80.0, 20.0];
        let found = outcome(size, step, 45.0, "", &back(40.0 + beside));
        assert_eq!(lines(&found, Code::RAPID_IN_STOCK), [FIRST + 4], "{width} {:#?}", found.verdict.found);
        // As deep as it reaches into the wall, less the clearance.
        let finding = found.verdict.found.iter().find(|f| f.code == Code::RAPID_IN_STOCK).unwrap();
        let depth = finding.value.as_ref().unwrap().value;
        assert!((depth - beside).abs() < 2e-3, "{depth} {beside}");
        let right = outcome(size, step, 45.0, "", &back(40.0));
        assert!(lines(&right, Code::RAPID_IN_STOCK).is_empty(), "{width} {:#?}", right.verdict.found);
    }
}

#[test]
fn a_standing_spindle_beside_its_slot_is_found() {
    for (width, step, beside) in CASES {
        let end = width + 10.0;
        let back = |y: f64| {
            program(&format!("Z2.\nG1 Z-4. F800.\nX{end:.3}\nG0 Y{y:.3} M5\nG1 X-10. F800.\nG0 Z70. M3\n"))
        };
        let size = [width, 80.0, 20.0];
        let found = outcome(size, step, 45.0, "", &back(40.0 - beside));
        assert_eq!(lines(&found, Code::SPINDLE_OFF), [FIRST + 4], "{width} {:#?}", found.verdict.found);
        let right = outcome(size, step, 45.0, "", &back(40.0));
        assert!(lines(&right, Code::SPINDLE_OFF).is_empty(), "{width} {:#?}", right.verdict.found);
    }
}

#[test]
fn a_shank_and_a_holder_in_the_wall_are_found() {
    for (width, step, beside) in CASES {
        let end = width + 10.0;
        let size = [width, 80.0, 40.0];
        // Flutes of 26, the last level 30 deep: the shank stands 4 deep in the slot.
        let slot = |y: f64| {
            program(&format!(
                "Z2.\nG1 Z-12. F800.\nX{end:.3}\nZ-24.\nX-10.\nZ-30.\nY{y:.3} F200.\nX{end:.3}\n"
            ))
        };
        let found = outcome(size, step, 60.0, "", &slot(40.0 + beside));
        assert_eq!(lines(&found, Code::SHANK_IN_STOCK), [FIRST + 7], "{width} {:#?}", found.verdict.found);
        let right = outcome(size, step, 60.0, "", &slot(40.0));
        assert!(lines(&right, Code::SHANK_IN_STOCK).is_empty(), "{width} {:#?}", right.verdict.found);
        // A slot as wide as the holder, 40; 30 of stickout, 34 deep.
        let wide = |y: f64| {
            program(&format!(
                "Z2.\nG1 Z-12. F800.\nX{end:.3}\nY54.\nX-10.\nY44.\nX{end:.3}\nY36.\nX-10.\nY26.\nX{end:.3}\nX{:.3}\nY40.\nZ-24.\nX-40.\nZ-34.\nY{y:.3}\nX{end:.3}\n",
                end + 30.0
            ))
        };
        let found = outcome(size, step, 30.0, "", &wide(40.0 + beside));
        assert_eq!(lines(&found, Code::HOLDER_IN_STOCK), [FIRST + 17], "{width} {:#?}", found.verdict.found);
        let right = outcome(size, step, 30.0, "", &wide(40.0));
        assert!(lines(&right, Code::HOLDER_IN_STOCK).is_empty(), "{width} {:#?}", right.verdict.found);
    }
}

/// Uses the fine drill.
const FINE: &str =
    "G0 Z70.\nG53 G0 Z0.\nT2 M6\nG54 G0 X10.3 Y10.3 S9000 M3\nG43 H2 Z50.\nZ2.\nG1 Z-2. F100.\nG0 Z50.";

#[test]
fn a_tool_thinner_than_the_lines_is_not_proven() {
    let size = [100.0, 80.0, 20.0];
    let given = outcome(size, Some(0.5), 45.0, "", &program(FINE));
    let doubts: Vec<_> = given.verdict.found.iter().filter(|f| f.code == Code::OVERLAP_MISSED).collect();
    assert_eq!(doubts.len(), 1, "{:#?}", given.verdict.found);
    assert_eq!(doubts[0].severity, Severity::Doubt);
    assert_eq!(doubts[0].place.as_ref().unwrap().line, FIRST + 6);
    assert!(doubts[0].message.contains("thinner than the 0.5 mm between the lines"), "{}", doubts[0].message);
    assert_ne!(Judgement::of(&given.verdict.found), Judgement::Safe);
    // Without the drill there is no doubt, whatever the list of tools holds.
    let mill = outcome(size, Some(0.5), 45.0, "", &program("Z2.\nG1 Z-4. F800.\nX110.\n"));
    assert!(mill.verdict.found.iter().all(|f| f.code != Code::OVERLAP_MISSED), "{:#?}", mill.verdict.found);
    let missed = given.simulation.missed;
    assert_eq!((missed.step, missed.width), (0.5, 0.05));
    // With lines near enough the hole is seen.
    let fine = outcome([30.0, 20.0, 5.0], Some(0.2), 45.0, "", &program(FINE));
    assert!(fine.verdict.found.iter().all(|f| f.code != Code::OVERLAP_MISSED));
    assert!(fine.removed.value > 0.1, "{:?}", fine.removed);
}

#[test]
fn a_hole_of_the_stock_thinner_than_the_lines_is_a_doubt() {
    let hole = |d: f64| format!("[[drilled]]\nat = [50.2, 60.2]\ndiameter = {d:?}\nbottom = -20\ntop = 0");
    let slot = program("Z2.\nG1 Z-4. F800.\nX110.\n");
    let thin = outcome([100.0, 80.0, 20.0], Some(0.5), 45.0, &hole(0.4), &slot);
    let doubt = thin.verdict.found.iter().find(|f| f.code == Code::OVERLAP_MISSED).unwrap();
    assert_eq!(doubt.key.as_deref(), Some("drilled[0].diameter"));
    let wide = outcome([100.0, 80.0, 20.0], Some(0.5), 45.0, &hole(5.0), &slot);
    assert!(wide.verdict.found.iter().all(|f| f.code != Code::OVERLAP_MISSED));
    // The hole was there before: only the slot is counted as removed, 12 wide and 4 deep, less the hole's share.
    let exact = 100.0 * 12.0 * 4.0;
    assert!((wide.removed.value - exact).abs() <= wide.removed.bound, "{:?}", wide.removed);
    assert!(wide.removed.bound < 0.05 * exact);
}
