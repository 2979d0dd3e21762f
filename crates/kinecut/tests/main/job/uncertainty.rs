//! Contacts where zeros, tool lengths and the raw stock may be off: what happens with any of them off is found before.

use std::collections::BTreeSet;

use kinecut::base::{Code, MemoryLoader, Severity, Silent};
use kinecut::job::{Outcome, RunWants, StockWants, Uncertainty, run_with};

use super::fixtures::{found, line, value};
use crate::common::random::Random;

/// Two end mills of 6 and 4 mm; the second one has a shank of 8 mm above its 6 mm of flutes, and a holder.
const TOOLS: &str = r#"
[[tool]]
number = 1
type = "end-mill"
diameter = 6
flute_length = 20
gauge_length = 100
[[tool]]
number = 2
type = "end-mill"
diameter = 4
flute_length = 6
stickout = 14
shank_diameter = 8
gauge_length = 100
"#;

fn job(stock: [[f64; 3]; 2], more: &str, setups: &str) -> String {
    let [min, max] = stock;
    format!(
        "format = 1\npost = {{ control = \"linuxcnc\" }}\nstock = {{ box = {{ min = {min:?}, max = {max:?} }} }}\n{TOOLS}{more}\n{setups}"
    )
}

const BLOCK: [[f64; 3]; 2] = [[0.0, 0.0, -8.0], [30.0, 20.0, 0.0]];
const SETUP: &str = "[[setup]]\noffset = \"G54\"\nprogram = { file = \"P.ngc\" }\n";

/// A job at a step of 0.1 mm, with how far zero, lengths and stock may be off.
fn run(job: &str, programs: &[(&str, &str)], off: [f64; 3]) -> Outcome {
    run_at(0.1, job, programs, off)
}

fn run_at(step: f64, job: &str, programs: &[(&str, &str)], off: [f64; 3]) -> Outcome {
    let [offset, length, stock] = off;
    let uncertainty = Some(Uncertainty { offset, length, stock });
    let stock =
        StockWants { step: Some(step), engagement: Some(false), uncertainty, ..StockWants::default() };
    let wants = RunWants { compare: false, stock };
    let loader = programs.iter().fold(MemoryLoader::default(), |all, (name, text)| all.with(name, *text));
    run_with("job.toml", job, &wants, &loader, &Silent).unwrap_or_else(|e| panic!("{e}"))
}

fn one(program: &str, off: [f64; 3]) -> Outcome {
    run(&job(BLOCK, "", SETUP), &[("P.ngc", program)], off)
}

fn doubts(outcome: &Outcome, code: Code) -> Vec<(String, f64)> {
    let all = found(outcome, code).into_iter().filter(|f| f.severity == Severity::Doubt);
    all.map(|f| (line(f).to_owned(), value(f))).collect()
}

const HEAD: &str = "G17 G21 G90 G94 G54\nT1 M6\nG43\nS3000 M3\n";

#[test]
fn a_rapid_over_the_stock_counts_all_three() {
    let program = format!("{HEAD}G0 X-20 Y10 Z1\nX50\nG0 Z30\nG1 X15 F1000\nG1 Z-1\nG0 Z30\nM2\n");
    // 1 mm above the stock.
    for (off, deep) in [
        ([0.3, 0.2, 0.4], None),
        ([0.0, 0.0, 0.9], None),
        ([0.4, 0.2, 0.6], Some(0.2)),
        ([0.0, 0.0, 1.5], Some(0.5)),
        ([1.2, 0.0, 0.0], Some(0.2)),
        ([0.0, 1.2, 0.0], Some(0.2)),
    ] {
        let done = one(&program, off);
        let met = doubts(&done, Code::RAPID_IN_STOCK);
        let claim = done.verdict.proven.iter().find(|p| p.claim.contains("also with"));
        assert!(found(&done, Code::RAPID_IN_STOCK).len() == met.len(), "{off:?}");
        match deep {
            None => assert!(met.is_empty() && claim.is_some() && done.verdict.is_safe(), "{off:?} {met:?}"),
            Some(deep) => {
                assert!(met[0].0 == "X50" && (met[0].1 - deep).abs() < 2e-3, "{off:?} {met:?}");
                assert!(met.len() == 1 && claim.is_none(), "{off:?} {met:?}");
            }
        }
    }
    // Nothing off: nothing is said of it.
    let done = one(&program, [0.0; 3]);
    assert!(done.simulation.uncertain.is_none());
    assert!(done.verdict.scope.iter().all(|s| !s.contains("looked for with")));
    let done = one(&program, [0.05, 0.02, 0.0]);
    let said = "Contacts of moving tools looked for with zeros \u{b1}0.05 mm, tool lengths \u{b1}0.02 mm";
    assert!(done.verdict.scope.iter().any(|s| s == said), "{:?}", done.verdict.scope);
}

#[test]
fn a_tool_is_as_far_off_as_its_own_cuts_and_others_are_not() {
    // The first mill cuts a pocket 5 mm deep and retracts at rapid from its floor and along its walls; then the second one comes down into it at
    // rapid.
    let program = |z: f64| {
        format!(
            "{HEAD}G0 X10 Y10 Z5\nG1 Z-5 F500\nG1 X20\nG0 Z5\nG0 Z-5\nG0 X10\nG0 Z30\nT2 M6\nG43\nG0 X15 Y10\nG0 Z{z}\nG0 Z30\nM2\n"
        )
    };
    // 0.03 mm above the floor: both lengths together may be off by 0.02 or 0.04 mm.
    assert!(one(&program(-4.97), [0.5, 0.01, 0.5]).verdict.is_safe());
    let met = doubts(&one(&program(-4.97), [0.5, 0.02, 0.5]), Code::RAPID_IN_STOCK);
    assert!(met.len() == 1 && met[0].0 == "G0 Z-4.97", "{met:?}");
    // 0.03 mm into it anyway: an error, and no doubt beside it.
    let done = one(&program(-5.03), [0.5, 0.02, 0.5]);
    let all = found(&done, Code::RAPID_IN_STOCK);
    assert!(all.len() == 1 && all[0].severity == Severity::Error, "{all:?}");
}

#[test]
fn a_hole_through_the_raw_stock_stays_one() {
    // A rapid down through a hole of 12 mm that the stock has; and to 1 mm above the bottom of another one.
    let drilled = "[[drilled]]\nat = [8, 10]\ndiameter = 12\ntop = 0\nbottom = -8\n[[drilled]]\nat = [22, 10]\ndiameter = 12\ntop = 0\nbottom = -6\n";
    let program = "G17 G21 G90 G94 G54\nT2 M6\nG43\nS3000 M3\nG0 X8 Y10 Z5\nG0 Z-7\nG0 Z5\nG0 X22\nG0 Z-5\nG0 Z5\nG1 X29 F900\nG1 Z-1\nG0 Z30\nM2\n";
    let done = |off| run(&job(BLOCK, drilled, SETUP), &[("P.ngc", program)], off);
    assert!(done([0.1, 0.0, 0.8]).verdict.is_safe(), "{:?}", done([0.1, 0.0, 0.8]).verdict.found);
    let met = doubts(&done([0.1, 0.1, 1.0]), Code::RAPID_IN_STOCK);
    assert!(met.len() == 1 && met[0].0 == "G0 Z-5" && (met[0].1 - 0.2).abs() < 5e-3, "{met:?}");
}

#[test]
fn what_an_earlier_setup_left_is_off_by_two_zeros() {
    let setups = format!("{SETUP}[[setup]]\noffset = \"G55\"\nprogram = {{ file = \"Q.ngc\" }}\n");
    // A slot 6 mm wide through the block along X; then a mill of 4 mm goes through at rapid 0.8 mm from a wall, and 0.3 mm over its floor.
    let first = format!("{HEAD}G0 X-5 Y10 Z5\nG1 Z-5 F500\nG1 X35\nG0 Z30\nM2\n");
    let second = "G17 G21 G90 G94 G55\nT2 M6\nG43\nS3000 M3\nG0 X-5 Y10.2 Z5\nG0 Z-4.7\nG0 X35\nG0 Z30\nM2\n";
    let done = |off| run(&job(BLOCK, "", &setups), &[("P.ngc", &first), ("Q.ngc", second)], off);
    assert_eq!(doubts(&done([0.14, 0.0, 1.0]), Code::RAPID_IN_STOCK), []);
    let met = doubts(&done([0.16, 0.0, 1.0]), Code::RAPID_IN_STOCK);
    assert!(met.len() == 1 && met[0].0 == "G0 X35" && (met[0].1 - 0.02).abs() < 2e-3, "{met:?}");
    // At the floor zeros and lengths count; at the walls zeros alone.
    assert_eq!(doubts(&done([0.1, 0.04, 0.0]), Code::RAPID_IN_STOCK), []);
    assert_eq!(doubts(&done([0.1, 0.06, 0.0]), Code::RAPID_IN_STOCK).len(), 1);
    let low = second.replace("Z-4.7", "Z-4");
    let done = |off| run(&job(BLOCK, "", &setups), &[("P.ngc", &first), ("Q.ngc", &low)], off);
    assert_eq!(doubts(&done([0.38, 0.0, 0.0]), Code::RAPID_IN_STOCK), []);
    assert_eq!(doubts(&done([0.42, 0.0, 0.0]), Code::RAPID_IN_STOCK).len(), 1);
}

#[test]
fn a_clamp_is_met_within_zero_and_length() {
    let strap = "[[fixture]]\nname = \"strap\"\nbox = { min = [12, 0, 0], max = [18, 20, 9.94] }\nnear = 0\n";
    let program = format!("{HEAD}G0 X-20 Y10 Z30\nG0 Z10\nG0 X50\nG0 Z30\nG1 X5 F900\nG1 Z-1\nG0 Z30\nM2\n");
    let done = |off| run(&job(BLOCK, strap, SETUP), &[("P.ngc", &program)], off);
    let clear = done([0.03, 0.02, 0.0]);
    let claims: Vec<&str> = clear.verdict.proven.iter().map(|p| p.claim.as_str()).collect();
    assert!(
        claims.contains(
            &"no tool or shank meets `strap` in `P.ngc`, also with zeros \u{b1}0.03 mm, tool lengths \u{b1}0.02 mm"
        ),
        "{claims:?}"
    );
    let near = done([0.05, 0.02, 0.0]);
    let met = found(&near, Code::FIXTURE_MET);
    assert!(met.len() == 1 && met[0].severity == Severity::Doubt && line(met[0]) == "G0 X50", "{met:?}");
    assert!((value(met[0]) - 0.05).abs() < 0.011, "{}", met[0]);
    assert!(met[0].message.starts_with("the tool may meet `strap` at rapid, with zeros"), "{}", met[0]);
    // It has to clear by both: 0.07 less the 0.06 that there are.
    assert!(met[0].help.contains("0.02 mm higher"), "{}", met[0]);
    assert!(near.verdict.proven.iter().all(|p| !p.claim.contains("strap")));
}

/// Places of a random program that may be off: of the zero, and of each tool's length.
#[derive(Clone, Copy, Default)]
struct Off {
    zero: [f64; 3],
    length: [f64; 2],
}

/// A slot by the first tool, and ways of the second one at rapid and at feed in it and near to the block.
fn random_program(seed: u64, off: Off) -> String {
    let mut random = Random(seed);
    let mut text = HEAD.to_owned();
    let mut tool = 0;
    let go = |text: &mut String, tool: usize, word: &str, at: [f64; 3]| {
        let [x, y, z] = [0, 1, 2].map(|k| at[k] + off.zero[k]);
        let z = z + off.length[tool];
        text.push_str(&format!("{word} X{x:.4} Y{y:.4} Z{z:.4}\n"));
    };
    let (y, floor) = (8.0 + 4.0 * random.share(), -2.0 - 4.0 * random.share());
    go(&mut text, tool, "G0", [-10.0, y, 5.0]);
    go(&mut text, tool, "G0", [-3.3 - random.share(), y, floor]);
    go(&mut text, tool, "G1 F900", [20.0, y, floor]);
    go(&mut text, tool, "G0", [20.0, y, 5.0]);
    // Over the top and beside the block.
    go(&mut text, tool, "G0", [-10.0, y, 0.8 * random.share()]);
    go(&mut text, tool, "G0", [-10.0, -3.0 - 0.8 * random.share(), -3.0]);
    let beside = -3.0 - 0.8 * random.share();
    go(&mut text, tool, "G0", [-10.0, beside, -3.0]);
    go(&mut text, tool, "G0", [40.0, beside, -3.0]);
    go(&mut text, tool, "G0", [40.0, beside, 30.0]);
    text.push_str("T2 M6\nG43\n");
    tool = 1;
    // Each along a wall of its own: what it cut itself before leaves no slivers.
    for side in [1.0, -1.0] {
        let (beside, above) = (y + side * (0.9 + 0.1 * random.share()), floor - 0.05 + 0.15 * random.share());
        go(&mut text, tool, "G0", [-10.0, beside, 12.0]);
        go(&mut text, tool, "G0", [-10.0, beside, above]);
        go(&mut text, tool, "G0", [16.0 + 3.0 * random.share(), beside, above]);
        // Deeper at feed: the shank comes near the top of the block.
        let deep = -5.6 - 0.8 * random.share();
        go(&mut text, tool, "G1 F900", [12.0, y, deep]);
        go(&mut text, tool, "G0", [12.0, y, 12.0]);
    }
    text.push_str("G0 Z30\nM2\n");
    text
}

/// Contacts with the stock deeper than a length [mm], by number of the line and code.
fn met(outcome: &Outcome, deeper: f64) -> BTreeSet<(u32, Code)> {
    let codes = [Code::RAPID_IN_STOCK, Code::SHANK_IN_STOCK, Code::HOLDER_IN_STOCK];
    let all = codes.iter().flat_map(|code| found(outcome, *code));
    all.filter(|f| value(f) > deeper).map(|f| (f.place.as_ref().unwrap().line, f.code)).collect()
}

#[test]
fn whatever_is_off_is_found_before() {
    let off = [0.06, 0.03, 0.4];
    let (mut happened, mut only_then) = (0, 0);
    for seed in 0..6 {
        let before = one(&random_program(seed, Off::default()), off);
        let (known, plain) =
            (met(&before, 0.0), met(&one(&random_program(seed, Off::default()), [0.0; 3]), 0.0));
        let mut random = Random(1000 + seed);
        let mut within = |most: f64| random.between(-most, most);
        for round in 0..4 {
            // In some rounds all is off as far as it may be.
            let far = |value: f64, most: f64| if round % 2 == 0 { most.copysign(value) } else { value };
            let zero = [within(1.0), within(1.0), within(1.0)];
            let size =
                zero.iter().map(|v| v * v).sum::<f64>().sqrt().max(if round % 2 == 0 { 0.0 } else { 1.0 });
            let zero = zero.map(|v| v / size * off[0]);
            let length = [within(off[1]), within(off[1])].map(|v| far(v, off[1]));
            let larger = [0; 6].map(|_| far(within(off[2]).abs(), off[2]));
            let [low, high] = BLOCK;
            let stock = [[0, 1, 2].map(|k| low[k] - larger[k]), [0, 1, 2].map(|k| high[k] + larger[k + 3])];
            let program = random_program(seed, Off { zero, length });
            let at = |step: f64| {
                let text = job(stock, "", SETUP);
                met(&run_at(step, &text, &[("P.ngc", &program)], [0.0; 3]), 0.01)
            };
            // Slivers between the lines may be missed: only what lines of other distances meet, too.
            let then: BTreeSet<_> = [0.1, 0.23, 0.37].map(at).into_iter().reduce(|a, b| &a & &b).unwrap();
            for one in &then {
                assert!(known.contains(one), "seed {seed}, round {round}: {one:?} is not among {known:?}");
            }
            happened += then.len();
            only_then += then.difference(&plain).count();
        }
    }
    assert!(happened > 40 && only_then > 10, "{happened} {only_then}");
}

#[test]
fn a_tool_change_close_to_the_stock_counts_all_that_may_be_off() {
    // 1 mm above the stock, and 1 mm beside its side at X30 (the cutter has a radius of 3).
    let change = |x: f64, z: f64| {
        one(
            &format!(
                "{HEAD}G0 X{x} Y10 Z{z}\nM5\nT2 M6\nG43\nS3000 M3\nG0 Z30\nX15\nG1 Z-1 F300\nG0 Z30\nM2\n"
            ),
            [0.2, 0.1, 0.5],
        )
    };
    let deep = |o: &Outcome| doubts(o, Code::CHANGE_IN_STOCK);
    let above = deep(&change(15.0, 1.0));
    // Both zeros and both lengths: 2 (0.2 + 0.1) + 0.5 - 1 of it.
    assert_eq!(above.len(), 1, "{above:?}");
    assert!(above[0].0.starts_with("T2 M6") && (above[0].1 - 0.1).abs() < 1e-9, "{above:?}");
    assert!(deep(&change(15.0, 1.2)).is_empty());
    assert_eq!(deep(&change(34.0, -2.0)).len(), 1);
    assert!(deep(&change(34.2, -2.0)).is_empty());
    let inside = change(32.0, -2.0);
    assert!(found(&inside, Code::CHANGE_IN_STOCK).iter().all(|f| f.severity == Severity::Error));
    assert!(deep(&inside).is_empty() && found(&inside, Code::CHANGE_IN_STOCK).len() == 1);
}
