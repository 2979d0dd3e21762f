//! Boring cycles that step aside, steps that shorten, and cycles without a hole, on FANUC and Haas.
//!
//! Expected values are worked out by hand from the moves of each cycle.

use crate::{moves, read, refused, run};
use kinecut_nc::base::Severity;
use kinecut_nc::nc::Control::{Fanuc, Haas, LinuxCnc};
use kinecut_nc::program::{Cycle, CycleStep, Item, Speed, Spindle, StopKind};

const START: &str = "G21 G54 G0 X0. Y0. Z25.\nS500 M3\n";

#[test]
fn fine_boring_steps_aside_at_the_bottom() {
    let text = format!("{START}G98 G76 X10. Y5. Z-10. R2. Q0.5 P100 F100.\nG99 X20.\nG80\nM30\n");
    let reading = read(&text, Fanuc).unwrap();
    assert_eq!(
        moves(&reading),
        [
            "R 0 0 25",
            "R 10 5 25",
            "R 10 5 2",
            "F 10 5 -10",
            "R 10.5 5 -10",
            "R 10.5 5 25",
            "R 10 5 25",
            "R 20 5 25",
            "R 20 5 2",
            "F 20 5 -10",
            "R 20.5 5 -10",
            "R 20.5 5 2",
            "R 20 5 2"
        ]
    );
    // The spindle stands while the tool is aside, and only then.
    let items = &reading.program.items;
    let stands: Vec<bool> = (0..items.len())
        .filter(|i| matches!(items.get(*i), Item::Move(_)))
        .map(|i| reading.program.state(i).spindle == Spindle::Off)
        .collect();
    let places: Vec<usize> = (1..stands.len()).filter(|i| stands[*i]).collect();
    assert_eq!(places, [4, 5, 6, 10, 11, 12]);
    assert!(matches!(items.get(4), Item::Dwell(s) if (s - 0.1).abs() < 1e-12));
    assert!(
        reading.findings.iter().any(|f| f.severity == Severity::Doubt && f.message.contains("5148")),
        "{:?}",
        reading.findings
    );
}

#[test]
fn i_and_j_say_the_step_aside() {
    let body = "G0 Z25.\nG99 G76 X10. Y5. Z-10. R2. I-0.3 J0.4 F100.\nG80";
    assert_eq!(
        run(body, Fanuc)[3..],
        ["F 10 5 -10", "F 9.7 5.4 -10", "R 9.7 5.4 2", "F 10 5 2"].map(str::to_owned)
    );
    assert_eq!(
        run(body, Haas)[3..],
        ["F 10 5 -10", "R 9.7 5.4 -10", "R 9.7 5.4 2", "R 10 5 2"].map(str::to_owned)
    );
    let reading = read(&format!("{START}{body}\nM30\n"), Haas).unwrap();
    assert!(reading.findings.iter().all(|f| f.severity != Severity::Doubt), "{:?}", reading.findings);
    assert!(refused("G0 Z25.\nG76 X1. Z-10. R2. F100.", Fanuc).contains("without Q"));
    assert!(refused("G0 Z25.\nG76 X1. Z-10. R2. Q1. I1. F100.", Fanuc).contains("6200"));
}

#[test]
fn back_boring_goes_below_the_work_and_bores_upwards() {
    let body = "G0 Z25.\nG98 G87 X10. Y5. Z-4. R-12. Q0.5 F100.\nG80";
    assert_eq!(
        run(body, Fanuc),
        [
            "R 0 0 25",
            "R 10 5 25",
            "R 10.5 5 25",
            "R 10.5 5 -12",
            "R 10 5 -12",
            "F 10 5 -4",
            "R 10.5 5 -4",
            "R 10.5 5 25",
            "R 10 5 25"
        ]
    );
    // As increments: R from the start, Z from R.
    let body = "G0 Z25.\nG91 G98 G87 X10. Y5. Z8. R-37. Q0.5 F100.\nG80";
    assert_eq!(run(body, Fanuc)[5], "F 10 5 -4");
    assert!(refused("G0 Z25.\nG99 G87 X10. Z-4. R-12. Q0.5 F100.", Fanuc).contains("G98"));
    assert!(refused("G0 Z25.\nG87 X10. Z-12. R-4. Q0.5 F100.", Fanuc).contains("R below Z"));
}

#[test]
fn cycles_left_by_hand_stop_the_program() {
    for (control, code) in [(Fanuc, "G88"), (Haas, "G88"), (Haas, "G87")] {
        let text = format!("{START}G99 {code} X10. Z-10. R2. P500 F100.\nG80\nM30\n");
        let reading = read(&text, control).unwrap();
        assert_eq!(moves(&reading), ["R 0 0 25", "R 10 0 25", "R 10 0 2", "F 10 0 -10", "R 10 0 2"]);
        let items = &reading.program.items;
        let stop = (0..items.len()).find(|i| items.get(*i) == Item::Stop(StopKind::Program)).unwrap();
        assert_eq!(reading.program.state(stop).spindle, Spindle::Off);
        assert!(reading.findings.iter().any(|f| f.message.contains("by hand")));
    }
}

/// Heights of the feeds of the only cycle.
fn depths(body: &str) -> (Vec<f64>, Cycle) {
    let reading = read(&format!("{START}{body}\nG80\nM30\n"), Haas).expect(body);
    let items = &reading.program.items;
    let found = (0..items.len()).find_map(|i| match items.get(i) {
        Item::Cycle(cycle, steps) => Some((
            steps
                .iter()
                .filter_map(|s| if let CycleStep::Feed(height) = s { Some(*height) } else { None })
                .collect(),
            *cycle,
        )),
        _ => None,
    });
    found.expect("a cycle")
}

#[test]
fn haas_steps_shorten_by_i_j_and_k() {
    // 5, 4, 3, 2, 2 (not below K), and what is left: 2 of 18.
    let (steps, _) = depths("G99 G83 X1. Z-18. R0. I5. J1. K2. F100.");
    assert_eq!(steps, [-5.0, -9.0, -12.0, -14.0, -16.0, -18.0]);
    let (steps, _) = depths("G99 G73 X1. Z-18. R0. I5. J1. K2. F100.");
    assert_eq!(steps.len(), 6);
    let (steps, cycle) = depths("G99 G83 X1. Z-10. R0. Q4. P500 F100.");
    assert_eq!(steps, [-4.0, -8.0, -10.0]);
    assert!(cycle.expansion().unwrap().contains(&CycleStep::Dwell(0.5)));
    let body = "G0 Z25.\nG99 G73 X1. Z-18. R0. Q1. K5. F100.";
    assert!(refused(body, Haas).contains("all three"));
}

#[test]
fn haas_taps_without_m29() {
    let text = format!("{START}G99 G84 X1. Z-8. R2. F400.\nG80\nM30\n");
    let reading = read(&text, Haas).unwrap();
    let items = &reading.program.items;
    let tap = (0..items.len()).find(|i| matches!(items.get(*i), Item::Cycle(Cycle::Tap(_), _))).unwrap();
    let Speed::PerRevolution(pitch) = reading.program.state(tap).speed else { panic!() };
    assert!((pitch - 0.8).abs() < 1e-12);
    assert!(reading.findings.iter().all(|f| !f.message.contains("M29")), "{:?}", reading.findings);
}

#[test]
fn no_repetitions_make_no_hole() {
    for (control, word) in [(Haas, "L0"), (Fanuc, "K0")] {
        let body = format!("G0 Z25.\nG99 G81 Z-5. R2. {word} F100.\nX10.\nG80");
        assert_eq!(run(&body, control), ["R 0 0 25", "R 10 0 25", "H 2 -5 2"]);
        assert!(refused(&format!("G0 Z25.\nG81 X1. Z-5. R2. {word} F100."), control).contains("place"));
    }
}

#[test]
fn a_cycle_with_a_wait_may_have_none() {
    // In inches: six more holes at .48 each, then one .45 below.
    let body = "G20 G0 X.56 Y-.425 Z1.\nG99 G82 Z-.195 R.1 F10.\nG91 X.48 L6\nY-.45\nG90 G80";
    let done = run(body, Haas);
    let holes: Vec<&String> = done.iter().filter(|m| m.starts_with('H')).collect();
    assert_eq!(holes.len(), 8);
    assert!(holes.iter().all(|h| *h == "H 2.54 -4.953 2.54"), "{holes:?}");
    let last = done.iter().rfind(|m| m.starts_with('R')).unwrap();
    assert_eq!(last, "R 87.376 -22.225 2.54");
}

#[test]
fn behind_a_cycle_the_motion_before_it_goes_on() {
    for control in [Fanuc, Haas] {
        let text = "G21 G17 G90 G94\nG0 X0. Y0. Z9.\nG98 G81 X1. Z-1. R2. F50.\n#1=#4001\nG80 X5. Z[20.+#1]\nG1 Z3.\n\
                    G98 G82 X6. Z-1. R2. P900\nG80\nX8.\nM30\n";
        let reading = read(text, control).unwrap();
        let ends = moves(&reading);
        assert_eq!(
            ends[ends.len() - 4..],
            ["F 5 0 3", "R 6 0 3", "H 2 -1 3", "F 8 0 3"],
            "{control:?} {ends:?}"
        );
        assert!(ends.contains(&"R 5 0 20".to_owned()), "{ends:?}");
    }
    let refused = read("G21 G90 G0 X0 Y0 Z9\nG80\nX5\nM2\n", LinuxCnc).unwrap_err();
    assert!(refused.contains("axis words without a motion code"), "{refused}");
}

#[test]
fn a_move_before_any_motion_code_is_a_rapid() {
    let doubts = |control| {
        let reading = read("G21 G17 G90\nX5. Y6. Z7.\nG1 X8. F50.\nM30\n", control).unwrap();
        assert_eq!(moves(&reading), ["R 5 6 7", "F 8 6 7"]);
        reading.findings.iter().filter(|f| f.message.contains("before any motion code")).count()
    };
    assert_eq!((doubts(Fanuc), doubts(Haas)), (1, 0));
}
