//! Threads of LinuxCNC: `G33`, `G76`, and diameters.
//!
//! Expected values are those of the interpreter's stand-alone version (2.9).

use crate::{moves, read, refused, run};
use kinecut_nc::nc::Control::{GrblHal, LinuxCnc};
use kinecut_nc::program::{Item, Speed, ToolNumber};

/// Feeds per revolution of the feed moves.
fn pitches(body: &str) -> Vec<f64> {
    let reading = read(&format!("G21 G54 G0 X0 Y0 Z0 S300 M3\n{body}\nM2\n"), LinuxCnc).expect(body);
    let items = &reading.program.items;
    let of = |i: usize| match (items.get(i), reading.program.state(i).speed) {
        (Item::Move(_), Speed::PerRevolution(pitch)) => Some((pitch * 1e6).round() / 1e6),
        _ => None,
    };
    (0..items.len()).filter_map(of).collect()
}

#[test]
fn a_straight_move_is_geared_to_the_spindle() {
    let body = "S300 M3\nG33 Z-3 K0.5\nX1 K2\nG1 X2 F100";
    assert_eq!(run(body, LinuxCnc), ["F 0 0 -3", "F 1 0 -3", "F 2 0 -3"]);
    assert_eq!(pitches(body), [0.5, 2.0]);
    assert_eq!(pitches("G20 G33 Z-1 K0.1"), [2.54]);
    for (body, why) in [
        ("G33 Z-3 K1", "while the spindle does not turn"),
        ("S0 M3\nG33 Z-3 K1", "while the spindle does not turn"),
        ("S9 M3\nG33 Z-3", "without its pitch"),
        ("S9 M3\nG33 Z-3 K1 F5", "with a feed"),
        ("S9 M3\nG33 Z-3 K0", "positive"),
    ] {
        let error = refused(body, LinuxCnc);
        assert!(error.contains(why), "{body}: {error}");
    }
    assert!(refused("S9 M3\nG33 Z-3 K1", GrblHal).contains("not understood"));
}

#[test]
fn a_thread_is_cut_in_passes() {
    let outside = run("S300 M3\nG0 X20 Z5\nG76 P1.5 Z-20 I-1 J0.4 K1 R2 Q29.5 H1 E2 L3", LinuxCnc);
    // Seven passes, the last twice, with seven moves each but for the drive line, and the way back.
    assert_eq!(outside.len(), 1 + 8 * 6 + 1);
    assert_eq!(
        outside[1..8],
        [
            "R 20.6 0 4.7737",
            "F 19.6 0 4.7737",
            "F 18.6 0 2.7737",
            "F 18.6 0 -17.6605",
            "F 19.6 0 -19.6605",
            "R 20.6 0 -19.6605",
            "R 20.4343 0 4.68",
        ]
    );
    assert_eq!(
        outside[outside.len() - 7..],
        [
            "R 20 0 4.4342",
            "F 19 0 4.4342",
            "F 18 0 2.4342",
            "F 18 0 -18",
            "F 19 0 -20",
            "R 20 0 -20",
            "R 20 0 -20",
        ]
    );
    let inside = "G0 X4 Z20\nG76 P2 Z30 I2 J0.5 K1.2 E1 L1";
    assert_eq!(
        run(&format!("S300 M3\n{inside}"), LinuxCnc)[1..7],
        ["R 3.3 0 20", "F 5.3 0 20", "F 6.5 0 21", "F 6.5 0 30", "R 3.3 0 30", "R 3.8 0 20"]
    );
    assert_eq!(pitches(inside)[..4], [3.1241, 3.1241, 2.0, 3.1241]);
    // Without a taper the tool goes in at once.
    let plain = run("S300 M3\nG0 X4 Z20\nG76 P2 Z0 I-1 J1 K1.5 H0", LinuxCnc);
    assert_eq!(plain[1..5], ["R 4.5 0 20", "R 2 0 20", "F 2 0 0", "R 4.5 0 0"]);
}

#[test]
fn what_a_thread_lacks_is_said() {
    for (words, why) in [
        ("Z-20 I-1 J0.4 K1", "without P"),
        ("P1 Z-20 J0.4 K1", "without I"),
        ("P1 Z-20 I-1 K1", "without J"),
        ("P1 Z-20 I-1 J0.4", "without K"),
        ("P0 Z-20 I-1 J0.4 K1", "pitch of a thread is positive"),
        ("P1 Z-20 I0 J0.4 K1", "not zero"),
        ("P1 Z-20 I-1 J0 K1", "J of a thread (G76) is positive"),
        ("P1 Z-20 I-1 J1 K1", "larger than J"),
        ("P1 Z-20 I-1 J0.4 K1 Q90", "below 90"),
        ("P1 Z-20 I-1 J0.4 K1 H0.5", "whole number"),
        ("P1 Z-20 I-1 J0.4 K1 H20000", "10000 passes"),
        ("P1 Z-20 I-1 J0.001 K10 R9", "10000 passes"),
    ] {
        let error = refused(&format!("S300 M3\nG76 {words}"), LinuxCnc);
        assert!(error.contains(why), "{words}: {error}");
    }
    assert!(refused("G76 P1 Z-20 I-1 J0.4 K1", LinuxCnc).contains("while the spindle does not turn"));
}

#[test]
fn diameters_are_halved() {
    assert_eq!(
        run("G7 X30\nX31 Y3\nG91 X1\nG90 G8 X4 Z1\nM70\nG7\nM72\nX5", LinuxCnc),
        ["R 15 0 0", "R 15.5 3 0", "R 16 3 0", "R 4 3 1", "R 5 3 1"]
    );
    assert_eq!(run("G7\nX[20+2*#<_lathe_diameter_mode>+#<_lathe_radius_mode>]", LinuxCnc), ["R 11 0 0"]);
    // Heights across of a thread are diameters then, too.
    let thread = run("S300 M3\nG7 G0 X8 Z20\nG76 P2 Z0 I-2 J2 K3", LinuxCnc);
    assert_eq!(thread[1..3], ["R 4.5 0 20", "R 2 0 20"]);
    // The interpreter scales them twice where the mode changes in the same block.
    let once = run("S300 M3\nG0 X4 Z20\nG76 P2 Z0 I-1 J0.5 K1.5", LinuxCnc);
    assert_eq!(run("S300 M3\nG0 X4 Z20\nG7 G76 P2 Z0 I-4 J2 K6", LinuxCnc), once);
    assert_eq!(run("S300 M3\nG7 G0 X8 Z20\nG8 G76 P2 Z0 I-0.5 J0.25 K0.75", LinuxCnc), once);
    assert!(refused("G7 G8 X1", LinuxCnc).contains("twice") || refused("G7 G8 X1", LinuxCnc).contains("one"));
}

#[test]
fn a_tool_can_be_said_to_be_in_the_spindle() {
    let text = "G21 G54 G0 X1 Y2 Z3\nM61 Q4\nX5\nM2\n";
    let reading = read(text, LinuxCnc).unwrap();
    assert_eq!(moves(&reading), ["R 1 2 3", "R 5 2 3"]);
    let items = &reading.program.items;
    let tools = (0..items.len()).filter(|i| matches!(items.get(*i), Item::Tool { id: ToolNumber(4), .. }));
    assert_eq!(tools.count(), 1);
    assert!(reading.findings.iter().any(|f| f.message.contains("makes no change")));
    assert!(refused("M61", LinuxCnc).contains("without the number Q"));
}
