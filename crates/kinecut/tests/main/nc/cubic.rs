//! Cubics (`G5` of LinuxCNC): what is written on request, what is read, and that both agree.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use kinecut::base::{Code, Error, Sources};
use kinecut::geom::{
    ConstantEngagement, CubicSpan, Curve, CurveKind, InvoluteRecord, LensOrder, Line, PlaneCurve, Rise,
    Spiral, Support,
};
use kinecut::nc::{self, Control, PostSettings, Posted, Reading};
use kinecut::program::{
    Blend, Comp, Frame, Item, Move, Origin, Program, SetupId, Speed, State, Target, ToolNumber, WorkOffset,
};
use proptest::prelude::*;

const LINUXCNC: Control = Control::LinuxCnc;

fn settings(decimals: u8, arc_tolerance: f64) -> PostSettings {
    PostSettings { decimals, arc_tolerance, cubic: true, ..PostSettings::new(LINUXCNC) }
}

fn read(text: &str) -> Result<Reading, Error> {
    nc::read(&mut Sources::default(), "test", text, LINUXCNC, &[])
}

/// A program that cuts along curves that join.
fn program(curves: &[Curve]) -> Program {
    let mut program = Program::default();
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    program.push_tool(ToolNumber(1), Some(1), None, &state, Origin::default());
    let start = curves[0].start();
    state.speed = Speed::Rapid { linear: true };
    state.blend = Blend::Continuous;
    program.push_move(Move::along(&Line { start, end: start }.into()), &state, Origin::default());
    state.speed = Speed::PerMinute(20.0);
    for curve in curves {
        program.push_move(Move::along(curve), &state, Origin::default());
    }
    program
}

/// The curves of the feed moves of a program.
fn cuts(program: &Program) -> Vec<Curve> {
    let mut at = DVec3::NAN;
    let mut out = Vec::new();
    for i in 0..program.items.len() {
        let Item::Move(motion) = program.items.get(i) else { continue };
        let Target::Tip { point, .. } = motion.end else { continue };
        if !matches!(program.state(i).speed, Speed::Rapid { .. }) {
            out.push(motion.curve(at).unwrap());
        }
        at = point;
    }
    out
}

/// Largest distance of points of the posted path from an exact curve, which they follow: the nearest of points of the
/// exact curve about the place of the same length, then along its tangent.
fn deviation(found: &[Curve], exact: &Curve) -> f64 {
    let total: f64 = found.iter().map(Curve::length).sum();
    let length = exact.length();
    assert!((total - length).abs() < 0.02 + 2e-4 * length, "{total} {length}");
    // The branches of a cusp are near each other.
    let apart = if length < 60.0 { 0.02 } else { 0.2 };
    let n = 200 + 2 * (0.5 * length / apart).ceil() as usize;
    let step = length / n as f64;
    let fine: Vec<DVec3> = (0..=n).map(|i| exact.at(step * i as f64).p).collect();
    let mut before = 0.0;
    let mut worst: f64 = 0.0;
    for c in found {
        for k in 0..=16 {
            let s = c.length() * f64::from(k) / 16.0;
            let p = c.at(s).p;
            let guess = ((before + s) / total * n as f64) as usize;
            let near = (guess.saturating_sub(30)..(guess + 31).min(n + 1))
                .min_by(|a, b| fine[*a].distance(p).total_cmp(&fine[*b].distance(p)))
                .unwrap();
            let mut least = fine[near].distance(p);
            let mut s = step * near as f64;
            for _ in 0..4 {
                let jet = exact.at(s.clamp(0.0, length));
                least = least.min(jet.p.distance(p));
                s += (p - jet.p).dot(jet.d1);
            }
            // At a cusp the tangent leads astray.
            let mut width = if least > worst { step } else { 0.0 };
            s = step * near as f64;
            while width > 1e-6 {
                for t in [s - width, s + width] {
                    let off = exact.at(t.clamp(0.0, length)).p.distance(p);
                    if off < least {
                        (least, s) = (off, t);
                    }
                }
                width *= 0.6;
            }
            worst = worst.max(least);
        }
        before += c.length();
    }
    worst
}

fn blocks(posted: &Posted) -> Vec<&str> {
    posted.text.lines().filter(|l| l.contains("G5 ")).collect()
}

/// Writes a curve, reads it back, writes again.
fn check(curve: PlaneCurve, decimals: u8, tolerance: f64) -> Posted {
    let exact = curve.at_height(-3.0, 0.0);
    let settings = settings(decimals, tolerance);
    let posted = nc::write(&program(std::slice::from_ref(&exact)), &[], &settings).unwrap();
    let reading = read(&posted.text).unwrap();
    // Nothing to warn of: the control's own biarcs are near these cubics.
    assert!(reading.findings.iter().all(|f| !f.message.contains("biarcs")), "{:?}", reading.findings);
    let unit = LINUXCNC.resolution(decimals);
    let found = cuts(&reading.program);
    // Rounding moves a control point by half a step along each axis.
    let bound = tolerance + 0.75 * unit;
    let worst = deviation(&found, &exact);
    assert!(worst <= bound, "{worst} > {bound}\n{}", posted.text);
    let end = found[found.len() - 1].end();
    assert!((end - exact.end()).truncate().abs().max_element() <= 0.5 * unit + 1e-12);
    let again = nc::write(&reading.program, &[], &settings).unwrap();
    let third = nc::write(&read(&again.text).unwrap().program, &[], &settings).unwrap();
    assert_eq!(again.text, third.text);
    let moves = |p: &Posted| {
        let is_move =
            |l: &&str| ["G0", "G1", "G2", "G3", "G5"].iter().any(|w| l.starts_with(&format!("{w} ")));
        p.text.lines().filter(is_move).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(moves(&posted), moves(&again));
    posted
}

#[test]
fn spirals_and_involutes_are_cubics_on_request() {
    let r = 69.0 / (20.0 * TAU);
    let lens = Support::Lens { inner: 10.0, base_radius: r, order: LensOrder::Two };
    let engaged = ConstantEngagement::new(5.0, 40.0, 5.0, 1.2, LensOrder::One);
    let spirals: [PlaneCurve; 3] = [
        Spiral::new(lens.into(), 0.0, 4.0 * TAU).unwrap().into(),
        Spiral::new(Support::ConstantEngagement(engaged).into(), 0.0, 3.0 * TAU).unwrap().reversed().into(),
        InvoluteRecord::new(600.0, [0.0; 2], 0.3, 0.0, 40.0).unwrap().into(),
    ];
    for curve in spirals {
        let posted = check(curve, 4, 0.0005);
        assert!(blocks(&posted).len() > 20);
        assert_eq!((posted.notes.chains, posted.notes.chain_tolerance), (1, 0.0005));
        assert_eq!(posted.notes.cubics as usize, blocks(&posted).len());
        let arcs = PostSettings { cubic: false, ..settings(4, 0.0005) };
        let chain = nc::write(&program(&[curve.at_height(-3.0, 0.0)]), &[], &arcs).unwrap();
        assert!(blocks(&chain).is_empty() && chain.notes.cubics == 0);
        let count = |p: &Posted| p.text.lines().count();
        assert!(count(&posted) < count(&chain), "{} {}", count(&posted), count(&chain));
    }
}

#[test]
fn the_paper_spiral_takes_fewer_blocks_than_arcs() {
    let record = InvoluteRecord::new(4963.71639267187, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
    let found: Vec<usize> =
        [0.01, 0.001, 0.0001].map(|eps| blocks(&check(record.into(), 5, eps)).len()).to_vec();
    // Arcs: 102, 217, 465. The sixth root pays off below a hundredth.
    assert!(found[0] <= 120 && found[1] <= 167 && found[2] <= 244, "{found:?}");
}

proptest! {
    #![proptest_config(kinecut_cases::property(16))]

    #[test]
    fn an_involute_comes_back_within_tolerance_and_resolution(
        a in 0.0..30.0f64, turned in 0.5..4.0f64, r in 0.05..1.5f64, exponent in -4.0..-2.0f64,
        decimals in 3u8..=6, cw in any::<bool>(), inward in any::<bool>(),
    ) {
        let b = a + turned;
        let plain = InvoluteRecord::new(0.5 * r * (b - a) * (b + a), [3.0, -1.0], 0.4, r * a, r * b).unwrap();
        let plain = if cw { plain.mirrored() } else { plain };
        let record = if inward { plain.reversed() } else { plain };
        check(record.into(), decimals, 10f64.powf(exponent));
    }

    #[test]
    fn a_cubic_of_a_text_is_kept_to_the_digit(
        digits in proptest::array::uniform8(-99_999i32..99_999), leave in any::<bool>(),
    ) {
        let [x, y, i, j, p, q, x2, y2] = digits.map(|d| f64::from(d) / 1e4);
        prop_assume!(i.hypot(j) > 0.01 && p.hypot(q) > 0.01);
        let [i2, j2] = [-p, -q];
        let ahead = if leave { String::new() } else { format!("I{i2} J{j2} ") };
        let text = format!(
            "%\nG17 G21 G40 G49 G80\nG90 G91.1 G94\nG54\nG0 X1.5 Y-2\nZ5\nG1 Z-1 F600\n\
             G5 X{x} Y{y} I{i} J{j} P{p} Q{q}\nG5 X{x2} Y{y2} {ahead}P{p} Q{q}\nM2\n%\n"
        );
        let reading = read(&text).unwrap();
        let found = cuts(&reading.program);
        let CurveKind::Bezier { span, .. } = found[1].kind() else { panic!("{found:?}") };
        let expected = [[1.5, -2.0], [1.5 + i, -2.0 + j], [x + p, y + q], [x, y]].map(DVec2::from_array);
        for (a, b) in span.points().into_iter().zip(expected) {
            prop_assert!((a - b).length() < 1e-13);
        }
        let CurveKind::Bezier { span: next, .. } = found[2].kind() else { panic!("{found:?}") };
        prop_assert!((next.points()[1] - (DVec2::new(x, y) - DVec2::new(p, q))).length() < 1e-13);
        let again = nc::write(&reading.program, &[], &PostSettings::new(LINUXCNC)).unwrap();
        let block = format!("G5 X{x} Y{y} I{i} J{j} P{p} Q{q}\n");
        prop_assert!(again.text.contains(&block), "{block}{}", again.text);
        let second = format!("G5 X{x2} Y{y2} I{i2} J{j2} P{p} Q{q}\n").replace("I-0 ", "I0 ").replace("J-0 ", "J0 ");
        prop_assert!(again.text.contains(&second), "{second}{}", again.text);
    }
}

#[test]
fn inches_increments_and_other_words_of_a_cubic_are_read() {
    let head = "G17 G21 G90 G94 G54\nG0 X0 Y0 Z0\n";
    let span = |text: &str| -> [DVec2; 4] {
        let reading = read(&format!("{head}{text}M2\n")).unwrap();
        let found = cuts(&reading.program);
        let CurveKind::Bezier { span, .. } = found[found.len() - 1].kind() else { panic!("{found:?}") };
        span.points()
    };
    let inch = span("G20\nG5 X1 I.1 J.2 P-.3 Q.4 F10\n");
    let expected = [[0.0, 0.0], [2.54, 5.08], [17.78, 10.16], [25.4, 0.0]].map(DVec2::from_array);
    assert!(inch.iter().zip(expected).all(|(a, b)| (*a - b).length() < 1e-12), "{inch:?}");
    let steps = span("G1 X10 F100\nG91\nG5 X10 Y1 I1 J3 P-2 Q-3\n");
    assert_eq!(steps, [[10.0, 0.0], [11.0, 3.0], [18.0, -2.0], [20.0, 1.0]].map(DVec2::from_array));
    // A block of another kind does not break the chain; another motion does.
    let on = span("G5 X10 Y0 I1 J3 P-2 Q-3 F100\nM8\nG5 X20 Y0 P-2 Q3\n");
    assert_eq!(on[1], DVec2::new(12.0, 3.0));
}

#[test]
fn a_cubic_that_the_control_itself_does_not_follow_is_remarked() {
    let head = "G17 G21 G90 G94 G54 F100\nG0 X0 Y0 Z0\n";
    for (block, warned) in [
        ("G5 X200 Y0 I300 J300 P-300 Q300", true),
        ("G5 X10 Y0 I3 J1 P-3 Q1", false),
        ("G5 X10 Y0 I10 J10 P-10 Q10", true),
    ] {
        let reading = read(&format!("{head}{block}\nM2\n")).unwrap();
        let found = reading.findings.iter().any(|f| f.message.contains("biarcs"));
        assert_eq!(found, warned, "{block} {:?}", reading.findings);
    }
}

#[test]
fn what_the_control_would_not_run_is_refused() {
    let head = "G17 G21 G90 G94 G54 F100\nG0 X0 Y0 Z0\n";
    let refused = |text: &str| read(&format!("{head}{text}\nM2\n")).unwrap_err();
    let good = "G5 X10 Y0 I1 J3 P-2 Q-3";
    for (text, code, word) in [
        ("G18 G5 X10 Y0 I1 J3 P-2 Q-3", Code::NC_ARC, "G17"),
        ("G5 X10 Y0 I1 P-2 Q-3", Code::NC_ARC, "only one"),
        ("G5 X10 Y0 J1 P-2 Q-3", Code::NC_ARC, "only one"),
        ("G5 X10 Y0 P-2 Q-3", Code::NC_ARC, "needs I and J"),
        ("G5 X10 Y0 Z-2 I1 J3 P-2 Q-3", Code::NC_ARC, "X and Y only"),
        ("G5 X10 Y0 I1 J3 P-2", Code::NC_ARC, "P and Q"),
        ("G5 X10 Y0 I1 J3", Code::NC_ARC, "P and Q"),
        ("G5 I1 J3 P-2 Q-3", Code::NC_STATE, "X or Y"),
        ("G5", Code::NC_STATE, "X or Y"),
        ("G5 X0 Y0 I0 J0 P0 Q0", Code::GEOMETRY, "not all the same"),
        ("G5 X10 Y0 I1 J3 K1 P-2 Q-3", Code::NC_WORD, "K1"),
        ("G42 D1 G1 X5 Y5\nG5 X10 Y0 I1 J3 P-2 Q-3", Code::COMPENSATION, "compensation"),
        (&format!("{good}\nX20 Y0 P-2 Q3"), Code::NC_ARC, "not modal"),
        (&format!("{good}\nG1 X11\nG5 X20 Y0 P-2 Q3"), Code::NC_ARC, "needs I and J"),
    ] {
        let error = refused(text);
        let place = error.0.place.clone().unwrap_or_else(|| panic!("{error}"));
        assert!(place.line >= 3, "{error}");
        let message = error.to_string();
        assert_eq!(error.code(), code, "{text}: {message}");
        assert!(message.contains(word), "{text}: {message}");
    }
    // Other controls have no G5 or mean something else by it.
    let text = format!("{head}{good}\nM2\n");
    for control in Control::WRITTEN.iter().filter(|c| **c != LINUXCNC) {
        assert!(nc::read(&mut Sources::default(), "test", &text, *control, &[]).is_err(), "{control:?}");
    }
}

#[test]
fn a_control_without_cubics_says_so_and_gets_arcs_for_those_it_is_given() {
    let points = [[0.0, 0.0], [12.0, 3.0], [15.0, 14.0], [10.0, 20.0]].map(DVec2::from_array);
    let span = CubicSpan::new(points).unwrap();
    let exact = Curve::cubic(span, -1.0);
    for &control in Control::WRITTEN {
        let wanted = PostSettings { cubic: true, ..PostSettings::new(control) };
        let answer = nc::write(&program(std::slice::from_ref(&exact)), &[], &wanted);
        assert_eq!(answer.is_err(), control != LINUXCNC);
        if let Err(error) = answer {
            assert_eq!(error.code(), Code::POST_CONTROL);
            assert!(error.to_string().contains("leave"), "{error}");
        }
        let posted =
            nc::write(&program(std::slice::from_ref(&exact)), &[], &PostSettings::new(control)).unwrap();
        assert_eq!(posted.notes.cubics > 0, control == LINUXCNC);
        let reading = nc::read(&mut Sources::default(), "test", &posted.text, control, &[]).unwrap();
        let worst = deviation(&cuts(&reading.program), &exact);
        assert!(worst < PostSettings::ARC_TOLERANCE + 2.0 * control.resolution(4), "{control:?} {worst}");
        let arcs = posted.text.lines().filter(|l| ["G2 ", "G3 ", "C "].iter().any(|w| l.contains(w))).count();
        assert!(control == LINUXCNC || (10..60).contains(&arcs), "{control:?} {arcs}");
    }
}

#[test]
fn rises_compensation_circles_and_chords_are_not_cubics() {
    let record = InvoluteRecord::new(300.0, [0.0; 2], 0.0, 5.0, 40.0).unwrap();
    let post = |curve: Curve, settings: &PostSettings| nc::write(&program(&[curve]), &[], settings).unwrap();
    let cubic = settings(4, 0.0005);
    assert!(blocks(&post(Curve::involute(record, -1.0, 0.0), &cubic)).len() > 10);
    assert!(blocks(&post(Curve::involute(record, -1.0, -0.5), &cubic)).is_empty());
    let spiral =
        Spiral::new(Support::Ellipse { half_axes: [30.0, 20.0], offset: 2.0 }.into(), 0.0, 7.0).unwrap();
    assert!(blocks(&post(Curve::spiral(spiral, -1.0, Rise::NONE), &cubic)).len() > 5);
    assert!(blocks(&post(Curve::spiral(spiral, -1.0, Rise::even(-1.0)), &cubic)).is_empty());
    let circle = InvoluteRecord::new(100.0, [0.0; 2], 0.0, 20.0, 20.0).unwrap();
    assert!(blocks(&post(Curve::involute(circle, -1.0, 0.0), &cubic)).is_empty());
    let chords = PostSettings { arcs: false, ..cubic.clone() };
    assert!(blocks(&post(Curve::involute(record, -1.0, 0.0), &chords)).is_empty());

    // On a compensated contour it is arcs, and again cubics after it.
    let entry = Line { start: DVec3::new(-9.0, 0.0, -1.0), end: DVec3::new(0.0, 0.0, -1.0) };
    let curve = Curve::involute(record, -1.0, 0.0);
    let exit = Line { start: curve.end(), end: curve.end() + DVec3::X * 9.0 };
    let mut compensated = Program::default();
    let frame = compensated.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    state.speed = Speed::Rapid { linear: true };
    let mut push =
        |curve: Curve, state: &State| compensated.push_move(Move::along(&curve), state, Origin::default());
    push(Line { start: entry.start, end: entry.start }.into(), &state);
    state.speed = Speed::PerMinute(10.0);
    push(entry.into(), &State { comp: Comp::Left(1), ..state });
    push(curve, &State { comp: Comp::Left(1), ..state });
    push(exit.into(), &state);
    let posted = nc::write(&compensated, &[], &cubic).unwrap();
    assert!(blocks(&posted).is_empty() && posted.text.contains("G3 "), "{}", posted.text);
}

#[test]
fn a_cubic_with_a_cusp_or_without_handles_is_posted_as_what_every_control_runs() {
    let cusp = [[0.0, 0.0], [10.0, 10.0], [0.0, 10.0], [10.0, 0.0]].map(DVec2::from_array);
    let none = [[0.0, 0.0], [0.0, 0.0], [10.0, 10.0], [20.0, 0.0]].map(DVec2::from_array);
    for points in [cusp, none] {
        let exact = Curve::cubic(CubicSpan::new(points).unwrap(), -1.0);
        for control in [Control::Sinumerik840d, LINUXCNC] {
            let posted =
                nc::write(&program(std::slice::from_ref(&exact)), &[], &PostSettings::new(control)).unwrap();
            let reading = nc::read(&mut Sources::default(), "test", &posted.text, control, &[]).unwrap();
            let worst = deviation(&cuts(&reading.program), &exact);
            assert!(worst < 2e-3, "{control:?} {worst}");
        }
    }
}
