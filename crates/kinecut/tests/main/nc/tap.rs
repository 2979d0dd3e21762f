//! Threads: each control's own rigid tapping, written and read back with feed over speed the pitch, and refused without.

use std::f64::consts::TAU;

use glam::DVec3;
use kinecut::base::Sources;
use kinecut::geom::Rigid;
use kinecut::nc::{self, Control, PostSettings, Reading};
use kinecut::program::{
    Cycle, CycleStep, Frame, Item, Move, Origin, Path, Program, SAME_PITCH, Setup, SetupId, Speed, Spindle,
    State, Tapping, Target, ToolAxis, ToolNumber, WorkOffset,
};
use kinecut::tool::Hand;
use proptest::prelude::*;

const RAPID: Speed = Speed::Rapid { linear: true };
const M8: Tapping = Tapping { reference: 4.0, bottom: -18.0, retract: 50.0, pitch: 1.25, hand: Hand::Right };

fn setup() -> Setup {
    Setup {
        name: "one".to_owned(),
        part_on_table: Rigid::IDENTITY,
        work_offsets: [(WorkOffset::G54, Rigid::IDENTITY)].into(),
        located: false,
        stock: None,
        fixtures: Vec::new(),
    }
}

/// Two holes tapped at a speed [rev/min], 50 mm above the work between them.
fn program(control: Control, tapping: Tapping, rpm: f64) -> Program {
    let mut program = Program::new(vec![setup()]);
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    state.blend = control.usual_blend();
    let register = Some(control.length_register(ToolNumber(1)));
    program.push_tool(ToolNumber(1), register, register, &state, Origin::default());
    state.spindle = Spindle::turning(tapping.hand, rpm / 60.0 * TAU);
    let rapid = |program: &mut Program, to: [f64; 3]| {
        let end = Target::Tip { point: DVec3::from_array(to), axis: ToolAxis::Fixed };
        let state = State { speed: RAPID, ..state };
        program.push_move(Move { end, path: Path::Line }, &state, Origin::default());
    };
    for x in [10.0, 30.0] {
        rapid(&mut program, [x, 5.0, 50.0]);
        let state = State { speed: Speed::PerRevolution(tapping.pitch), ..state };
        program.push_cycle(Cycle::Tap(tapping), &state, Origin::default()).unwrap();
    }
    rapid(&mut program, [0.0, 0.0, 60.0]);
    program
}

fn read(text: &str, control: Control) -> Reading {
    nc::read(&mut Sources::default(), "test", text, control, &[setup()])
        .unwrap_or_else(|e| panic!("{control}: {e}\n{text}"))
}

/// Heights of the threads of a program, each with pitch and spindle.
fn threads(program: &Program) -> Vec<(f64, f64, Spindle)> {
    let mut found = Vec::new();
    for i in 0..program.items.len() {
        let Item::Cycle(Cycle::Tap(_), steps) = program.items.get(i) else { continue };
        for step in steps {
            if let CycleStep::Thread { height, pitch } = *step {
                found.push((height, pitch, program.state(i).spindle));
            }
        }
    }
    found
}

/// Whether two spindles turn alike, but for rounding.
fn alike(a: Spindle, b: Spindle) -> bool {
    std::mem::discriminant(&a) == std::mem::discriminant(&b) && (a.rate() - b.rate()).abs() < 1e-9
}

/// The tapping controls, each with words that must stand in its text for a right-hand and for a left-hand thread.
const WORDS: [(Control, [&[&str]; 2]); 4] = [
    (Control::Fanuc, [&["M29 S500", "G95 G98 G84", "F1.25", "G80"], &["M29 S500", "G74", "M4"]]),
    (
        Control::Sinumerik840d,
        [&["CYCLE84(50,0,4,-18,,,3,,1.25,0,500,500)"], &["CYCLE84(50,0,4,-18,,,4,,-1.25,0,500,500)"]],
    ),
    (Control::Heidenhain, [&["CYCL DEF 207", "Q239=+1.25", "Q201=-18"], &["Q239=-1.25", "M4"]]),
    (Control::LinuxCnc, [&["G33.1 Z-18 K1.25", "M3"], &["G33.1 Z-18 K1.25", "M4"]]),
];

#[test]
fn every_control_taps_by_its_own_cycle_and_reads_it_back() {
    for (control, words) in WORDS {
        for (hand, words) in [Hand::Right, Hand::Left].into_iter().zip(words) {
            let tapping = Tapping { hand, ..M8 };
            let text =
                nc::write(&program(control, tapping, 500.0), &[], &PostSettings::new(control)).unwrap().text;
            for word in words {
                assert!(text.contains(word), "{control}: no `{word}` in\n{text}");
            }
            assert!(!text.contains("G1 Z"), "a thread is no feed move:\n{text}");
            let reading = read(&text, control);
            let spindle = Spindle::turning(hand, 500.0 / 60.0 * TAU);
            let found = threads(&reading.program);
            let wanted = [-18.0, 4.0, -18.0, 4.0].map(|height| (height, 1.25, spindle));
            assert_eq!(found.len(), wanted.len(), "{control}\n{text}");
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found.0 - wanted.0).abs() < 1e-9 && (found.1 - wanted.1).abs() < 1e-9, "{control}");
                assert!(alike(found.2, wanted.2), "{control}: {found:?}");
            }
        }
    }
}

#[test]
fn grbl_refuses_a_thread_with_the_reason() {
    let error =
        nc::write(&program(Control::Grbl, M8, 500.0), &[], &PostSettings::new(Control::Grbl)).unwrap_err();
    assert_eq!(error.code(), kinecut::base::Code::POST_CONTROL);
    assert!(error.to_string().contains("synchronised spindle"), "{error}");
}

#[test]
fn a_thread_needs_its_spindle() {
    for (control, _) in WORDS {
        // A right-hand thread while the spindle turns to the left.
        let mut turned = program(control, M8, 500.0);
        let state = State { spindle: Spindle::CounterClockwise(50.0), ..*turned.state(2) };
        turned.push_cycle(Cycle::Tap(M8), &state, Origin::default()).unwrap();
        assert!(nc::write(&turned, &[], &PostSettings::new(control)).is_err(), "{control}");
        assert!(
            nc::write(&program(control, M8, 0.0), &[], &PostSettings::new(control)).is_err(),
            "{control}"
        );
    }
    let mut program = program(Control::Fanuc, M8, 500.0);
    let state = *program.state(2);
    let none = Cycle::Tap(Tapping { pitch: 0.0, ..M8 });
    assert!(program.push_cycle(none, &state, Origin::default()).is_err());
}

#[test]
fn the_pitch_of_a_fanuc_text_is_the_feed_over_the_speed() {
    let text = |mode: &str, feed: &str, rigid: &str, code: &str| {
        format!(
            "%\nO1\nT1 M6\nG17 G21 G90 G54\nG0 X10. Y5.\nG43 H1 Z50.\nS500\n{rigid}{mode} G98 {code} Z-18. R4. {feed}\nG80\nM30\n%\n"
        )
    };
    for (mode, feed) in [("G95", "F1.25"), ("G94", "F625.")] {
        for (code, hand) in [("G84", Hand::Right), ("G74", Hand::Left)] {
            let reading = read(&text(mode, feed, "M29 S500\n", code), Control::Fanuc);
            let found = threads(&reading.program);
            let spindle = Spindle::turning(hand, 500.0 / 60.0 * TAU);
            assert_eq!(found.len(), 2);
            assert!((found[0].1 - 1.25).abs() < 1e-12 && alike(found[0].2, spindle), "{found:?}");
            assert!(reading.findings.iter().all(|f| !f.message.contains("M29")), "{:?}", reading.findings);
        }
    }
    let floating = read(&text("G95", "F1.25", "", "G84"), Control::Fanuc);
    assert!(floating.findings.iter().any(|f| f.message.contains("without M29")), "{:?}", floating.findings);
    let refused =
        |text: &str| nc::read(&mut Sources::default(), "t", text, Control::Fanuc, &[setup()]).is_err();
    assert!(refused(&text("G95", "F1.25 Q3.", "M29 S500\n", "G84")), "steps are not read");
    assert!(refused(&text("G95", "F1.25", "", "G84").replace("S500\n", "")), "a thread without a speed");
}

#[test]
fn a_sinumerik_call_says_its_own_speed_and_the_spindle_after_it() {
    let text = |call: &str| {
        format!("G17 G90 G54 G710\nT1 M6\nD1\nG0 X10 Y5\nZ50\nS300 M3\n{call}\nG1 F100 Z40\nM30\n")
    };
    let spindle_after = |call: &str| {
        let program = read(&text(call), Control::Sinumerik840d).program;
        let items = program.items.len();
        let last = (0..items).rev().find(|i| matches!(program.items.get(*i), Item::Move(_))).unwrap();
        (threads(&program), program.state(last).spindle)
    };
    let (found, after) = spindle_after("CYCLE84(50,0,4,-18,,,3,,1.25,0,600,600)");
    assert!((found[0].2.rate() - 600.0 / 60.0 * TAU).abs() < 1e-9);
    assert_eq!(after, Spindle::Clockwise(300.0 * TAU / 60.0));
    assert_eq!(spindle_after("CYCLE84(50,0,4,-18,,,5,,-1.25,0,600)").1, Spindle::Off);
    for call in
        ["CYCLE84(50,0,4,-18,,,3,8,,0,600)", "CYCLE84(50,0,4,-18,,,7,,1.25,0,600)", "CYCLE84(50,0,4,-18,,,3)"]
    {
        let read = nc::read(&mut Sources::default(), "t", &text(call), Control::Sinumerik840d, &[setup()]);
        assert!(read.is_err(), "{call}");
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(24))]

    #[test]
    fn any_pitch_and_speed_keep_together(
        pitch in 0.1f64..6.0,
        rpm in 20u32..6000,
        depth in 1.0f64..80.0,
        left in any::<bool>(),
    ) {
        let hand = if left { Hand::Left } else { Hand::Right };
        let tapping = Tapping { reference: 3.0 * pitch, bottom: -depth, pitch, hand, ..M8 };
        for (control, _) in WORDS {
            let text = nc::write(&program(control, tapping, f64::from(rpm)), &[], &PostSettings::new(control)).unwrap().text;
            let found = threads(&read(&text, control).program);
            prop_assert_eq!(found.len(), 4, "{}\n{}", control, text);
            for (height, read, spindle) in found {
                // Feed over speed.
                prop_assert!((read - pitch).abs() <= SAME_PITCH, "{control}: {read} {pitch}");
                prop_assert!((spindle.rate() / TAU * 60.0 - f64::from(rpm)).abs() < 1e-6);
                prop_assert!(height < 3.0 * pitch + 1e-3);
            }
        }
    }
}
