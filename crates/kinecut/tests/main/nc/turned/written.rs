//! The words themselves, letter by letter, and what stands around them.

use kinecut::base::Code;
use kinecut::program::{Comp, Item};

use super::*;
use crate::common::fixture::assert_is_fixture;

/// Two rows of a face mill along a turned feed, a hole series in the same coordinates, an arc in them, and a slot in
/// coordinates that are shifted only.
fn part(control: Control) -> Program {
    let mut b = Builder::new(control);
    let feed = Speed::PerMinute(800.0 / 60.0);
    let g54 = b.work("G54");
    let turned = b.shifted(g54, motion(32.5, 40.0, -12.5, 1.5));
    let about_zero = b.shifted(g54, motion(-90.0, 0.0, 0.0, 0.0));
    let shifted = b.shifted(g54, motion(0.0, 100.0, 0.0, 0.0));
    b.frame(turned);
    b.partly(DVec3::new(-40.0, 0.0, f64::NAN));
    b.line(RAPID, -40.0, 0.0, 20.0);
    b.line(feed, -40.0, 0.0, 0.0);
    b.line(feed, 150.0, 0.0, 0.0);
    b.arc(feed, 25.0, -TAU / 4.0, TAU / 2.0, 0.0);
    b.line(feed, -40.0, 50.0, 0.0);
    b.line(RAPID, -40.0, 50.0, 20.0);
    b.stop(StopKind::Program);
    b.line(RAPID, -20.0, 50.0, 20.0);
    b.retract();
    b.tool(2);
    for x in [0.0, 20.0, 40.0, 60.0, 80.0] {
        if x == 0.0 {
            b.partly(DVec3::new(x, 10.0, f64::NAN));
        }
        b.line(RAPID, x, 10.0, 20.0);
        let hole = Cycle::Drill { reference: 2.0, bottom: -9.0, retract: 20.0, dwell: 0.0 };
        b.cycle(Speed::PerMinute(2.0), hole);
    }
    b.frame(about_zero);
    b.line(RAPID, 10.0, 5.0, 20.0);
    b.line(feed, 10.0, 5.0, -1.0);
    b.line(feed, 30.0, 5.0, -1.0);
    b.line(RAPID, 30.0, 5.0, 20.0);
    b.frame(shifted);
    b.line(RAPID, 0.0, 0.0, 20.0);
    b.line(feed, 0.0, 0.0, -1.0);
    b.line(feed, 0.0, 30.0, -1.0);
    b.line(RAPID, 0.0, 30.0, 20.0);
    b.retract();
    b.stop(StopKind::End);
    b.program
}

fn post(program: &Program, control: Control) -> Posted {
    let settings = PostSettings { program_name: "TURNED".to_owned(), ..PostSettings::new(control) };
    nc::write(program, &[], &settings).unwrap()
}

#[test]
fn the_text_is_that_of_the_fixture() {
    for &control in Control::WRITTEN {
        let program = part(control);
        let posted = post(&program, control);
        assert_is_fixture(&posted.text, "turned", control);
        let reading = read_text(&posted.text, control);
        assert!(reading.findings.is_empty(), "{:?}", reading.findings);
        assert_eq!(post(&reading.program, control).text, posted.text);
    }
}

#[test]
fn the_words_are_taken_back_before_a_person_or_the_machine_meets_them() {
    let words: [(Control, &[&str], &[&str]); 4] = [
        (Control::Sinumerik840d, &["ROT RPL=", "TRANS X", "AROT"], &["ROT", "TRANS"]),
        (Control::Fanuc, &["G52 X", "G68"], &["G52 X0. Y0. Z0.", "G69"]),
        (Control::LinuxCnc, &["G10 L2 P1 R", "G52 X"], &["G10 L2 P1 R0", "G52 X0 Y0 Z0"]),
        (
            Control::Heidenhain,
            &["CYCL DEF 7.1", "CYCL DEF 10.1"],
            &["CYCL DEF 10.1 ROT+0", "CYCL DEF 7.1 X+0"],
        ),
    ];
    for (control, on, off) in words {
        let posted = post(&part(control), control);
        let mut in_force = false;
        let mut changes = 0;
        for line in posted.text.lines() {
            let block = if line.starts_with(['N', '0', '1', '2', '3', '4', '5', '6', '7', '8', '9']) {
                line.split_once(' ').map_or("", |l| l.1)
            } else {
                line
            };
            if off.contains(&block) {
                in_force = false;
                changes += 1;
            } else if on.iter().any(|w| block.starts_with(w)) {
                in_force = true;
            }
            let machine = ["SUPA", "G53", "M91", " M6", "TOOL CALL 2 Z", "M30", "M2", "M0"];
            let meets = machine.iter().any(|w| block.split(' ').any(|part| part == *w) || block.ends_with(w));
            assert!(!(meets && in_force), "{control} `{line}`\n{}", posted.text);
        }
        assert!(changes >= 4, "{changes} {control}");
    }
}

/// A corner of a turned square by hand: 30 degrees, (20, 10) becomes (20 cos - 10 sin + 5, 20 sin + 10 cos - 4).
#[test]
fn a_control_without_rotation_gets_the_coordinates_themselves() {
    let build = |control| {
        let mut b = Builder::new(control);
        let g54 = b.work("G54");
        let turned = b.shifted(g54, motion(30.0, 5.0, -4.0, 2.0));
        b.frame(turned);
        b.line(RAPID, 0.0, 0.0, 10.0);
        b.line(Speed::PerMinute(10.0), 20.0, 10.0, 1.0);
        b.arc(Speed::PerMinute(10.0), 10.0, 0.0, TAU / 4.0, 0.0);
        b.stop(StopKind::End);
        b.program
    };
    let text = post(&build(Control::Grbl), Control::Grbl).text;
    assert!(
        text.contains("G0 X5 Y-4 Z12\nG1 X17.3205 Y14.6603 Z3 F600\nG3 X3.6603 Y18.3205 I-8.660"),
        "{text}"
    );
    // And on request on all others.
    for &control in Control::WRITTEN {
        let settings = PostSettings { rotation: false, ..PostSettings::new(control) };
        let text = nc::write(&build(control), &[], &settings).unwrap().text;
        let [x, y] = [if control == Control::Fanuc { "X17.321" } else { "17.3205" }, "14.66"];
        assert!(text.contains(x) && text.contains(y) && !text.contains("ROT"), "{text}");
    }
}

/// An angle between two steps of FANUC's thousandth: the points are given in the turn that can be said.
#[test]
fn an_angle_that_a_control_cannot_say_moves_no_point() {
    for &control in Control::WRITTEN {
        let mut b = Builder::new(control);
        let g54 = b.work("G54");
        let turned = b.shifted(g54, motion(12.345_678_9, 0.0, 0.0, 0.0));
        b.frame(turned);
        b.line(RAPID, -800.0, 0.0, 10.0);
        b.line(Speed::PerMinute(10.0), 900.0, 0.0, 0.0);
        b.stop(StopKind::End);
        let settings = PostSettings { decimals: 5, ..PostSettings::new(control) };
        let posted = nc::write(&b.program, &[], &settings).unwrap();
        let apart = apart(&b.program, &posted, control);
        // Half a step in each coordinate; a tenth of one for an angle of six decimals.
        assert!(apart < 1e-5, "{control} {apart}\n{}", posted.text);
        if control == Control::Fanuc {
            // 12.346 instead of 12.3456789: 800 mm lie 4.5 um off the turned axis.
            assert!(posted.text.contains("R12.346\n") && posted.text.contains("Y0.00448"), "{}", posted.text);
        }
        if control == Control::Sinumerik840d {
            assert!(posted.text.contains("ROT RPL=12.345679\n"), "{}", posted.text);
        }
    }
}

#[test]
fn a_face_of_one_thousandth_of_a_degree_stays_along_the_text() {
    for &control in Control::WRITTEN {
        let Some(step) = control.rotation_step() else { continue };
        let degrees = (12_346.0f64 * 0.001f64.to_radians() / step).round() * step.to_degrees();
        let mut b = Builder::new(control);
        let g54 = b.work("G54");
        let turned = b.shifted(g54, motion(degrees, 0.0, 0.0, 0.0));
        b.frame(turned);
        b.line(RAPID, -800.0, 0.0, 10.0);
        b.line(RAPID, -800.0, 0.0, 0.0);
        b.line(Speed::PerMinute(10.0), 900.0, 0.0, 0.0);
        b.stop(StopKind::End);
        let text = post(&b.program, control).text;
        let along = ["G1 X900. F600.", "G1 X900 F600", "L X+900 F600"];
        assert!(along.iter().any(|a| text.contains(a)), "{text}");
    }
}

#[test]
fn a_curve_or_a_hole_right_after_a_change_of_frame_begins_where_the_tool_is() {
    for &control in Control::WRITTEN {
        let mut b = Builder::new(control);
        let g54 = b.work("G54");
        let turned = b.shifted(g54, motion(25.0, 3.0, 4.0, 0.0));
        b.line(RAPID, 10.0, 20.0, 30.0);
        b.frame(turned);
        b.arc(Speed::PerMinute(10.0), 15.0, 0.3, 2.0, 0.0);
        b.frame(g54);
        let hole = Cycle::Drill { reference: 22.0, bottom: 9.0, retract: 30.0, dwell: 0.0 };
        b.cycle(Speed::PerMinute(2.0), hole);
        b.frame(turned);
        b.cycle(Speed::PerMinute(2.0), hole);
        b.partly(DVec3::new(5.0, f64::NAN, f64::NAN));
        b.frame(g54);
        b.partly(DVec3::new(f64::NAN, 7.0, f64::NAN));
        b.line(Speed::PerMinute(10.0), 1.0, 2.0, 3.0);
        b.stop(StopKind::End);
        let posted = post(&b.program, control);
        let apart = apart(&b.program, &posted, control);
        assert!(apart < 0.001 + control.resolution(4), "{control} {apart}\n{}", posted.text);
        let drilled =
            (0..b.program.items.len()).filter(|i| matches!(b.program.items.get(*i), Item::Cycle(..)));
        assert_eq!(drilled.count(), 2);
    }
}

#[test]
fn compensation_within_turned_coordinates_is_the_same_path() {
    for control in Control::WRITTEN.iter().copied().filter(|c| c.has_compensation()) {
        let mut b = Builder::new(control);
        let g54 = b.work("G54");
        let turned = b.shifted(g54, motion(-63.0, 30.0, 4.0, 0.0));
        let feed = Speed::PerMinute(10.0);
        b.line(RAPID, 10.0, 20.0, 30.0);
        b.frame(turned);
        b.line(RAPID, -30.0, -20.0, 0.0);
        b.state.comp = Comp::Left(1);
        b.line(feed, 0.0, 0.0, 0.0);
        b.line(feed, 50.0, 0.0, 0.0);
        b.arc(feed, 20.0, -TAU / 4.0, TAU / 2.0, 0.0);
        b.line(feed, 0.0, 40.0, 0.0);
        b.state.comp = Comp::Off;
        b.line(feed, -30.0, 60.0, 0.0);
        // Into a compensation from the place of another frame.
        b.frame(g54);
        b.state.comp = Comp::Left(1);
        let at = b.at;
        b.line(feed, at.x + 30.0, at.y, 0.0);
        b.line(feed, at.x + 60.0, at.y, 0.0);
        b.state.comp = Comp::Off;
        b.line(feed, at.x + 90.0, at.y + 20.0, 0.0);
        b.stop(StopKind::End);
        let posted = post(&b.program, control);
        let back = read_text(&posted.text, control).program;
        let path = |p: &Program| -> Vec<Curve> {
            traced(p)
                .segments
                .iter()
                .filter(|s| !s.alternative)
                .map(|s| s.curve.clone())
                .filter(|c| c.length() > 0.002)
                .collect()
        };
        let (planned, written) = (path(&b.program), path(&back));
        assert_eq!(planned.len(), written.len(), "{control}\n{}", posted.text);
        for (a, b) in planned.iter().zip(&written) {
            for k in 0..=4 {
                let at = |c: &Curve| c.at(c.length() * f64::from(k) / 4.0).p;
                assert!((at(a) - at(b)).length() < 0.003, "{control} {} {}\n{}", at(a), at(b), posted.text);
            }
        }
        // The compensation does not outlive its frame.
        let mut b = Builder::new(control);
        let g54 = b.work("G54");
        let turned = b.shifted(g54, motion(-63.0, 30.0, 4.0, 0.0));
        b.line(RAPID, -30.0, -20.0, 0.0);
        b.state.comp = Comp::Left(1);
        b.line(feed, 0.0, 0.0, 0.0);
        b.frame(turned);
        b.line(feed, 1.0, 50.0, 0.0);
        let error = nc::write(&b.program, &[], &PostSettings::new(control)).unwrap_err();
        assert_eq!(error.code(), Code::COMPENSATION, "{error}");
    }
}

#[test]
fn frames_that_are_no_turn_about_z_are_refused() {
    let cases: [(Rigid, bool); 3] = [
        (Rigid { rotation: DMat3::from_rotation_x(0.1), ..motion(0.0, 0.0, 0.0, 0.0) }, false),
        (
            Rigid {
                rotation: DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0)),
                ..motion(0.0, 0.0, 0.0, 0.0)
            },
            false,
        ),
        (motion(0.1, 0.0, 0.0, 0.0), true),
    ];
    for &control in Control::WRITTEN {
        for (inner, fits) in cases {
            let mut b = Builder::new(control);
            let g54 = b.work("G54");
            b.state.frame = b.shifted(g54, inner);
            b.line(RAPID, 1.0, 2.0, 3.0);
            let answer = nc::write(&b.program, &[], &PostSettings::new(control));
            assert_eq!(answer.is_ok(), fits, "{control}");
            if let Err(error) = answer {
                assert_eq!(error.code(), Code::POST_CONTROL, "{error}");
            }
        }
    }
    // Only X, turned by the writer, from an unknown Y.
    let mut b = Builder::new(Control::Grbl);
    let g54 = b.work("G54");
    b.state.frame = b.shifted(g54, motion(30.0, 0.0, 0.0, 0.0));
    b.partly(DVec3::new(1.0, f64::NAN, f64::NAN));
    let error = nc::write(&b.program, &[], &PostSettings::new(Control::Grbl)).unwrap_err();
    assert_eq!(error.code(), Code::NC_STATE, "{error}");
}

#[test]
fn a_start_template_may_not_leave_the_coordinates_turned() {
    for (control, start) in [
        (Control::Fanuc, "G21 G17 G90\nG68 X0. Y0. R30."),
        (Control::LinuxCnc, "G21 G17 G90\nG10 L2 P2 R30"),
        (Control::Sinumerik840d, "G710 G17 G90\nTRANS X10"),
        (Control::Heidenhain, "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10"),
    ] {
        let b = Builder::new(control);
        let mut settings = PostSettings::new(control);
        settings.start_template = Some(start.to_owned());
        let error = nc::write(&b.program, &[], &settings).unwrap_err();
        assert_eq!(error.code(), Code::POST_TEMPLATE, "{error}");
        assert!(error.to_string().contains("coordinates"), "{error}");
    }
}
