//! HEIDENHAIN klartext: helices by their angle, what programs contain, and what is refused.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};
use kinecut::base::{Code, Error, Severity, Sources};
use kinecut::geom::{Aabb, Arc, Curve, Line, Rigid, Solid};
use kinecut::nc::{self, Control, PostSettings, Reading};
use kinecut::program::{
    Blend, Comp, Coolant, Cycle, CycleStep, Frame, Item, Move, Origin, Path, Program, Setup, SetupId, Speed,
    Spindle, State, StopKind, Target, ToolAxis, ToolNumber, WorkOffset,
};
use proptest::prelude::*;

mod written;

const RAPID: Speed = Speed::Rapid { linear: true };
const FEED: Speed = Speed::PerMinute(10.0);

fn try_read(text: &str) -> Result<Reading, Error> {
    nc::read(&mut Sources::default(), "a.h", text, Control::Heidenhain, &[])
}

fn read(text: &str) -> Reading {
    try_read(text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// The moves of a program that begins above the origin with preset, tool, feed and spindle.
fn moves(blocks: &str) -> Vec<(Option<Curve>, Move, State)> {
    let text = format!(
        "0 BEGIN PGM A MM\n1 CYCL DEF 247 DATUM SETTING ~\n  Q339=+1 ;DATUM NUMBER\n2 TOOL CALL 4 Z S1000\n\
         3 L X+0 Y+0 Z+10 R0 FMAX M3\n4 L F600\n{blocks}\n9 END PGM A MM\n"
    );
    let reading = read(&text);
    assert!(reading.findings.is_empty(), "{:?}", reading.findings);
    all(&reading.program)[1..].to_vec()
}

fn all(program: &Program) -> Vec<(Option<Curve>, Move, State)> {
    let mut at = DVec3::NAN;
    let mut out = Vec::new();
    for i in 0..program.items.len() {
        let Item::Move(motion) = program.items.get(i) else { continue };
        let curve = if at.is_finite() { motion.curve(at) } else { None };
        at = match motion.end {
            Target::Tip { point, .. } => point,
            Target::Joints(_) | Target::Orient => DVec3::NAN,
        };
        out.push((curve, motion, *program.state(i)));
    }
    out
}

fn point(motion: &Move) -> DVec3 {
    let Target::Tip { point, .. } = motion.end else { panic!("{motion:?}") };
    point
}

fn near(a: DVec3, b: [f64; 3]) -> bool {
    (a - DVec3::from_array(b)).length() < 1e-12
}

struct Builder {
    program: Program,
    state: State,
    at: DVec3,
}

impl Builder {
    fn new(at: DVec3) -> Builder {
        let mut program = Program::default();
        let frame = program.add_frame(Frame::Work(WorkOffset::G54));
        let mut state = State::start(SetupId(0), frame);
        state.blend = Blend::Continuous;
        program.push_tool(ToolNumber(4), Some(1), Some(1), &state, Origin::default());
        let mut b = Builder { program, state, at };
        b.line(RAPID, at);
        b
    }

    fn go(&mut self, speed: Speed, curve: impl Into<Curve>) {
        self.state.speed = speed;
        let curve = curve.into();
        self.at = curve.end();
        self.program.push_move(Move::along(&curve), &self.state, Origin::default());
    }

    fn line(&mut self, speed: Speed, to: DVec3) {
        self.go(speed, Line { start: self.at, end: to });
    }

    fn helix(&mut self, radius: f64, from: f64, sweep: f64, rise: f64) {
        let centre = self.at - (DVec2::from_angle(from) * radius).extend(0.0);
        self.go(FEED, Arc { start: self.at, centre, axis: DVec3::Z, sweep, rise });
    }

    fn post(&self, decimals: u8) -> Result<String, Error> {
        let settings = PostSettings { decimals, ..PostSettings::new(Control::Heidenhain) };
        nc::write(&self.program, &[], &settings).map(|p| p.text.to_string())
    }
}

fn blocks(text: &str) -> Vec<&str> {
    text.lines().map(|l| l.split_once(' ').map_or(l, |p| p.1)).collect()
}

// ---- helices ----

#[test]
fn a_helix_ends_where_its_angle_leads() {
    // Radius 5 about (2, -3) from 90 degrees: four turns and 28.027 degrees more, 6 mm down.
    let found = moves("L X+2 Y+2\nCC X+2 Y-3\nCP IPA+1468.027 IZ-6 DR+\nCP IPA-1440 Z+0 DR-\nCP PA+90 DR-");
    let angle = (90.0 + 28.027f64).to_radians();
    let end = [2.0 + 5.0 * angle.cos(), -3.0 + 5.0 * angle.sin(), 4.0];
    let Path::Arc { centre, axis, sweep, rise } = found[1].1.path else { panic!() };
    assert!(near(point(&found[1].1), end));
    assert_eq!((centre, axis, rise), (DVec3::new(2.0, -3.0, 10.0), DVec3::Z, -6.0));
    assert!((sweep - (4.0 * TAU + 28.027 * PI / 180.0)).abs() < 1e-12);
    let length = (5.0 * sweep).hypot(6.0);
    assert!((found[1].0.as_ref().unwrap().length() - length).abs() < 1e-9);
    // Whole turns end where they began, to the last bit.
    assert_eq!(point(&found[2].1).truncate(), point(&found[1].1).truncate());
    assert_eq!(point(&found[2].1).z, 0.0);
    // Back to 90 degrees by the polar angle.
    let Path::Arc { sweep, .. } = found[3].1.path else { panic!() };
    assert!((sweep + 28.027f64.to_radians()).abs() < 1e-12 && near(point(&found[3].1), [2.0, 2.0, 0.0]));
}

#[test]
fn whole_turns_are_one_block_and_more_than_fifteen_are_parted() {
    let mut b = Builder::new(DVec3::new(5.0, 0.0, 0.0));
    b.helix(5.0, 0.0, 4.0 * TAU, -8.0);
    b.helix(5.0, 0.0, -20.0 * TAU, 8.0);
    let text = b.post(4).unwrap();
    let lines = blocks(&text);
    let wanted = ["CC X+0 Y+0", "CP IPA+1440 Z-8 DR+ F600", "CP IPA-5400 Z-2 DR-", "CP IPA-1800 Z+0 DR-"];
    assert!(lines.windows(4).any(|w| w == wanted), "{text}");
    // Quarters of a turn lead to points of the grid: no line closes them.
    let mut b = Builder::new(DVec3::new(5.0, 0.0, 0.0));
    b.helix(5.0, 0.0, TAU + FRAC_PI_2, -3.0);
    let text = b.post(4).unwrap();
    let wanted = ["CC X+0 Y+0", "CP IPA+450 Z-3 DR+ F600", "M30"];
    assert!(blocks(&text).windows(3).any(|w| w == wanted), "{text}");
}

#[test]
fn a_helix_of_any_angle_is_closed_by_a_line_that_lies_on_it() {
    // Radius 400: a step of the angle is 0.7 um, seven steps of the coordinates.
    let mut b = Builder::new(DVec3::new(400.0, 0.0, 0.0));
    b.helix(400.0, 0.0, 1.0, -2.0);
    let text = b.post(4).unwrap();
    assert!(text.contains("L X+216.1209 Y+336.5884 Z-2\n"), "{text}");
    let found = all(&read(&text).program);
    let (arc, closing) = (found[1].0.as_ref().unwrap(), found[2].0.as_ref().unwrap());
    // It keeps the direction of the helix within half a milliradian, and its height on the way.
    let (before, after) =
        (arc.at(arc.length()).d1.normalize_or_zero(), closing.at(0.0).d1.normalize_or_zero());
    assert!((before - after).length() < 1e-3, "{}", (before - after).length());
    assert!((0.1..1.0).contains(&closing.length()), "{}", closing.length());
    assert!((point(&found[2].1) - DVec3::new(400.0 * 1f64.cos(), 400.0 * 1f64.sin(), -2.0)).length() < 1e-4);
}

proptest! {
    #![proptest_config(kinecut_cases::property(200))]

    /// However many helices follow one another: each ends within half a step of where it should, and no point
    /// of the text lies further from the helix than the rounding explains.
    #[test]
    fn helices_do_not_drift(
        parts in prop::collection::vec((0.5..300.0f64, -3.2..3.2f64, 0.5..14.0f64, any::<bool>(), -9.0..9.0f64), 1..12),
        decimals in 3u8..=4,
    ) {
        let unit = Control::Heidenhain.resolution(decimals);
        let mut b = Builder::new(DVec3::new(0.25, -0.5, 10.0));
        let mut plan = Vec::new();
        for (radius, from, sweep, ccw, rise) in parts {
            let (start, sweep) = (b.at, if ccw { sweep } else { -sweep });
            b.helix(radius, from, sweep, rise);
            plan.push((start, start.truncate() - DVec2::from_angle(from) * radius, radius, sweep, rise, b.at));
        }
        let text = b.post(decimals).unwrap();
        let found = all(&read(&text).program);
        let mut next = 1;
        for (start, centre, radius, sweep, rise, end) in plan {
            // The curves up to the one that ends there.
            let mut length = 0.0;
            loop {
                let curve = found[next].0.as_ref().unwrap();
                for k in 0..=8 {
                    let p = curve.at(curve.length() * f64::from(k) / 8.0).p;
                    // By hand: the distance from the axis, and the height for the angle.
                    let arm = p.truncate() - centre;
                    prop_assert!((arm.length() - radius).abs() < 3.0 * unit, "{} {text}", arm.length() - radius);
                    let turned = (p.z - start.z) / rise * sweep;
                    let first = (start.truncate() - centre).to_angle();
                    if rise.abs() > 1.0 {
                        let off = (arm.to_angle() - first - turned + PI).rem_euclid(TAU) - PI;
                        // Half a step of height is an angle, on a flat helix a large one.
                        let slope = (sweep / rise).abs() * unit + 4.0 * unit / radius + 1e-9;
                        prop_assert!(off.abs() < slope, "{off} {slope} {text}");
                    }
                }
                length += curve.length();
                next += 1;
                if (curve.end() - end).abs().max_element() <= 0.501 * unit && length > 0.9 * radius * sweep.abs() {
                    break;
                }
            }
            prop_assert!((length - (radius * sweep).hypot(rise)).abs() < 40.0 * unit, "{length} {text}");
        }
        prop_assert_eq!(next, found.len());
        // And again the same bytes.
        let settings = PostSettings { decimals, ..PostSettings::new(Control::Heidenhain) };
        prop_assert_eq!(nc::write(&read(&text).program, &[], &settings).unwrap().text.to_string(), text);
    }

    /// Whatever the words, a reader answers: a program or an error with a place inside the text.
    #[test]
    fn any_words_are_answered(words in prop::collection::vec(prop_oneof![
        Just("\n"), Just("\n"), Just("L"), Just("CC"), Just("C"), Just("CP"), Just("LP"), Just("CR"), Just("CT"),
        Just("X+1"), Just("IX-2,5"), Just("Y0"), Just("IZ"), Just("Z+Q1"), Just("DR+"), Just("DR-"), Just("IPA+400"),
        Just("PA 3"), Just("PR2"), Just("R0"), Just("RL"), Just("R+5"), Just("FMAX"), Just("F MAX"), Just("F100"),
        Just("M3"), Just("M91"), Just("M99"), Just("M140 MB MAX"), Just("TOOL CALL 1 Z S100"), Just("TOOL"), Just("~\n"),
        Just("CYCL DEF 7.1 X+1"), Just("CYCL DEF 9.1 2"), Just("CYCL DEF 200 Q200=2 Q201=-3 Q206=100 Q202=1 Q203=0"),
        Just("CYCL CALL"), Just("Q339=1"), Just("BEGIN PGM A MM"), Just("END PGM"), Just("; x"), Just("* -"), Just("\"a"),
        Just("LBL 1"), Just("\u{e4}"), Just("/"), Just("12"), Just("+"), Just("~"), Just("STOP"), Just("FU.1"), Just("FT1"),
    ], 0..25)) {
        let text = words.join(" ");
        if let Err(error) = try_read(&text) {
            let place = error.0.place.clone().unwrap_or_else(|| panic!("{error}"));
            prop_assert!(place.line >= 1 && place.start as usize <= text.len(), "{error}");
        }
    }
}

// ---- what programs contain ----

#[test]
fn lines_increments_commas_and_blanks() {
    let found = moves("5 L X10,5 IY-2.25 RL\n6L IX+0 IY+0.25 Z + 3 F MAX R0 ; over\n7 L IX+0.5\n8 L Y1");
    assert!(near(point(&found[0].1), [10.5, -2.25, 10.0]));
    assert_eq!(found[0].2.comp, Comp::Left(1));
    assert!(near(point(&found[1].1), [10.5, -2.0, 3.0]));
    assert_eq!((found[1].2.speed, found[1].2.comp), (RAPID, Comp::Off));
    // FMAX holds for its block only.
    assert!(near(point(&found[2].1), [11.0, -2.0, 3.0]));
    assert_eq!(found[2].2.speed, FEED);
    assert!(near(point(&found[3].1), [11.0, 1.0, 3.0]));
}

#[test]
fn feeds_per_revolution_in_time_and_of_the_tool() {
    let found = moves(
        "L X1 FU0.2\nL X2\nL X3 FT 2.5\nL X4\nTOOL CALL S2000 F300\nL X5\nL X6 F6\nL X7 FAUTO\nM136\nL X8 F0.1\nM137\nL X9 F60",
    );
    let speeds: Vec<Speed> = found.iter().map(|m| m.2.speed).collect();
    use Speed::{Duration, PerMinute, PerRevolution};
    assert_eq!(
        speeds,
        [
            PerRevolution(0.2),
            PerRevolution(0.2),
            Duration(2.5),
            PerRevolution(0.2),
            PerMinute(5.0),
            PerMinute(0.1),
            PerMinute(5.0),
            PerRevolution(0.1),
            PerMinute(1.0)
        ]
    );
    for (item, rpm) in [(3, 1000.0), (4, 2000.0)] {
        let Spindle::Clockwise(rate) = found[item].2.spindle else { panic!() };
        assert!((rate / TAU * 60.0 - rpm).abs() < 1e-9);
    }
}

#[test]
fn arcs_by_pole_by_radius_and_tangent() {
    // A quarter, the other three, a full circle.
    let found = moves("L X+10 Y+0\nCC IX-10 IY+0\nC X+0 Y+10 DR+\nC X+10 Y+0 DR+\nC X10 Y0 DR-");
    let sweeps: Vec<f64> = found[1..]
        .iter()
        .map(|m| if let Path::Arc { sweep, .. } = m.1.path { sweep } else { panic!() })
        .collect();
    for (found, wanted) in sweeps.iter().zip([FRAC_PI_2, 1.5 * PI, -TAU]) {
        assert!((found - wanted).abs() < 1e-12, "{sweeps:?}");
    }
    // By radius: the small and the large arc of radius 5 over a chord of 6, on either side.
    for (block, centre, sweep) in [
        ("CR X+6 Y+0 R+5 DR+", [3.0, 4.0], 2.0 * 0.6f64.asin()),
        ("CR X+6 Y+0 R+5 DR-", [3.0, -4.0], -2.0 * 0.6f64.asin()),
        ("CR X+6 Y+0 R-5 DR+", [3.0, -4.0], TAU - 2.0 * 0.6f64.asin()),
        ("CR X+6 Y+0 R-5 DR-", [3.0, 4.0], 2.0 * 0.6f64.asin() - TAU),
    ] {
        let found = moves(block);
        let Path::Arc { centre: c, sweep: s, .. } = found[0].1.path else { panic!() };
        assert!(near(c, [centre[0], centre[1], 10.0]) && (s - sweep).abs() < 1e-12, "{block} {c} {s}");
    }
    // Tangent to a line along X: to (15, 5) a quarter about (10, 5); then on, tangent to the arc.
    let found = moves("L X+10\nCT X+15 Y+5\nCT X+20 Y+10\nCT X+25 IY+0");
    let centres: Vec<DVec3> = found[1..]
        .iter()
        .map(|m| if let Path::Arc { centre, .. } = m.1.path { centre } else { DVec3::NAN })
        .collect();
    assert!(near(centres[0], [10.0, 5.0, 10.0]) && near(centres[1], [20.0, 5.0, 10.0]), "{centres:?}");
    assert!(centres[2].is_nan() && matches!(found[3].1.path, Path::Line), "straight on: {found:?}");
}

#[test]
fn polar_positions() {
    let found = moves("CC X+1 Y+2\nLP PR+10 PA+30\nLP IPA+60 IZ-1\nLP IPR+2 FMAX\nCC\nLP PR1 PA180");
    let s = 10.0 * 0.75f64.sqrt();
    assert!(near(point(&found[0].1), [1.0 + s, 7.0, 10.0]));
    assert!(near(point(&found[1].1), [1.0, 12.0, 9.0]));
    assert!(near(point(&found[2].1), [1.0, 14.0, 9.0]));
    assert!(near(point(&found[3].1), [0.0, 14.0, 9.0]));
}

#[test]
fn datum_shift_dwell_tolerance_and_coolant() {
    let text = "BEGIN PGM S MM\nCYCL DEF 247 Q339=3\nTOOL CALL 2 Z S500\nCYCL DEF 7.0 DATUM SHIFT\n\
        CYCL DEF 7.1 X+100\nCYCL DEF 7.2 IY-5\nL X1 Y1 Z1 FMAX M13\nCYCLE DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL 1.5\n\
        CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.02\nCYCL DEF 32.2 HSC-MODE:1 TA0.5\nL X2 F100 M9\nSTOP\nM1\nL IX1\nM30\nLBL 1\n";
    let reading = read(text);
    let found = all(&reading.program);
    assert!(near(point(&found[0].1), [1.0, 1.0, 1.0]) && near(point(&found[2].1), [3.0, 1.0, 1.0]));
    let (offset, shift) = reading.program.in_work(found[0].2.frame).unwrap();
    assert_eq!(offset, WorkOffset::parse("G56").unwrap());
    assert_eq!(shift.point(DVec3::ZERO), DVec3::new(100.0, -5.0, 0.0));
    assert_eq!((found[0].2.coolant, found[2].2.coolant), (Coolant::Flood, Coolant::Off));
    // M9 acts at the end of its block.
    assert_eq!(found[1].2.coolant, Coolant::Flood);
    assert_eq!(found[1].2.blend, Blend::within(0.02));
    let others: Vec<Item<'_>> = (0..reading.program.items.len())
        .map(|i| reading.program.items.get(i))
        .filter(|i| !matches!(i, Item::Move(_)))
        .collect();
    assert_eq!(
        others,
        [
            Item::Tool { id: ToolNumber(2), length: Some(1), radius: Some(1), again: false },
            Item::Dwell(1.5),
            Item::Stop(StopKind::Program),
            Item::Stop(StopKind::Optional),
            Item::Stop(StopKind::End)
        ]
    );
    let messages: Vec<&str> = reading.findings.iter().map(|f| f.message.as_str()).collect();
    assert!(messages.iter().any(|m| m.starts_with("text after the end")), "{messages:?}");
}

#[test]
fn drilling_and_reaming_are_run_at_each_call() {
    let drill = "CYCL DEF 200 DRILLING ~\n Q200=2 ;SET-UP CLEARANCE ~\n Q201=-10 ;DEPTH ~\n Q206=+120 ;FEED ~\n \
        Q202=4 ;STEP ~\n Q210=0 ~\n Q203=+1 ;SURFACE ~\n Q204=50 ~\n Q211=0.5\nL X5 Y6 FMAX M99\nL X7 FMAX\nCYCL CALL";
    let text = format!("BEGIN PGM D MM\nTOOL CALL 1 Z S1\nL X0 Y0 Z9 FMAX\n{drill}\n");
    let program = read(&text).program;
    // Surface 1: from 3 to -3, out, back to -1, to -7, out, back to -5, to -9, out to 51.
    let (r, f, d) = (CycleStep::Rapid, CycleStep::Feed, CycleStep::Dwell(0.5));
    let wanted = [r(3.0), f(-3.0), r(3.0), r(-1.0), f(-7.0), r(3.0), r(-5.0), f(-9.0), d, r(51.0)];
    let places: Vec<f64> = all(&program).iter().map(|m| point(&m.1).x).collect();
    assert_eq!(places, [0.0, 5.0, 7.0]);
    for index in [3, 5] {
        let Item::Cycle(Cycle::DeepHole(_), steps) = program.items.get(index) else {
            panic!("{:?}", program.items.get(index));
        };
        assert_eq!(steps, wanted);
        assert_eq!(program.state(index).speed, Speed::PerMinute(2.0));
    }
    // In one go it is the cycle of the waist.
    let text = "BEGIN PGM D MM\nTOOL CALL 1 Z S1\nL X1 Y2 Z9 FMAX\nCYCL DEF 200 Q200=2 Q201=-10 Q206=90 Q202=10 Q203=1 Q204=0 Q211=.5\nM99\n";
    let program = read(text).program;
    let wanted = Cycle::Drill { reference: 3.0, bottom: -9.0, retract: 3.0, dwell: 0.5 };
    assert!(matches!(program.items.get(2), Item::Cycle(c, _) if *c == wanted), "{:?}", program.items);
    assert_eq!(program.state(2).speed, Speed::PerMinute(1.5));
    let ream = "CYCL DEF 201 REAMING Q200=2 Q201=-10 Q206=120 Q211=0 Q208=240 Q203=0 Q204=2\nCYCL CALL";
    let speeds: Vec<(f64, Speed)> = moves(ream).iter().map(|m| (point(&m.1).z, m.2.speed)).collect();
    assert_eq!(speeds, [(2.0, RAPID), (-10.0, Speed::PerMinute(2.0)), (2.0, Speed::PerMinute(4.0))]);
}

#[test]
fn inches_and_the_lift_to_the_end_of_travel() {
    let text = "BEGIN PGM I INCH\nTOOL CALL 1 Z S100\nL M140 MB MAX\nL X1 Y0 FMAX\nL Z1 FMAX\nL X2 F100\nM30\nEND PGM I INCH\n";
    let reading = read(text);
    let found = all(&reading.program);
    assert!(point(&found[0].1).z.is_nan());
    assert!(near(point(&found[2].1), [50.8, 0.0, 25.4]));
    // Tenths of an inch in a minute.
    assert_eq!(found[2].2.speed, Speed::PerMinute(100.0 * 2.54 / 60.0));
    // The lift is a warning; the preset that is assumed, a note.
    let severities: Vec<Severity> = reading.findings.iter().map(|f| f.severity).collect();
    assert_eq!(severities, [Severity::Warning, Severity::Note], "{:?}", reading.findings);
}

#[test]
fn comments_structure_and_header() {
    let text = "0 BEGIN PGM C MM\n1 ;made by hand~\n and longer\n2 BLK FORM 0.1 Z X-1 Y-1 Z-1\n3 BLK FORM 0.2 X+1 Y+1 Z+0\n\
        4 * - structure\n5 CYCL DEF 247 Q339=+1 ;one\n6 TOOL CALL 1 Z S5 ;mill\n7 ;now\n8 * - rough\n9 END PGM C MM\n";
    let reading = read(text);
    assert_eq!(reading.header, ["made by hand", "and longer", "- structure"]);
    let texts: Vec<Item<'_>> =
        (0..reading.program.items.len()).map(|i| reading.program.items.get(i)).collect();
    assert!(matches!(texts[1..3], [Item::Text("now"), Item::Text("- rough")]), "{texts:?}");
    assert!(reading.findings.is_empty());
}

// ---- what is refused ----

#[test]
fn each_fault_is_named_with_its_place() {
    let head = "BEGIN PGM E MM\nCYCL DEF 247 Q339=1\nTOOL CALL 1 Z S100\nL X0 Y0 Z0 R0 FMAX\nL F100\n";
    for (block, code, at, words) in [
        ("L X+1 Q5", Code::NC_WORD, 7, "Q parameters"),
        ("L X+Q5", Code::NC_WORD, 3, "Q parameters"),
        ("L X1 U90", Code::NC_WORD, 6, "`U90`"),
        ("L X1 Y1 X2", Code::NC_SYNTAX, 9, "twice"),
        ("L X1 IX2", Code::NC_SYNTAX, 6, "twice"),
        ("L X1.2.3", Code::NC_SYNTAX, 3, "two decimal points"),
        ("L X1O", Code::NC_SYNTAX, 3, "letter O"),
        ("L X", Code::NC_SYNTAX, 3, "number is missing"),
        ("L X1 R1", Code::NC_WORD, 6, "`R1`"),
        ("L X1 F-5", Code::NC_SYNTAX, 6, "not negative"),
        ("L X1 F0", Code::NC_STATE, 1, "feed zero"),
        ("L X1 FZ0.1", Code::NC_WORD, 6, "number of teeth"),
        ("L X1 M118", Code::NC_WORD, 6, "`M118`"),
        ("L X1 M3 M4", Code::NC_SYNTAX, 9, "twice"),
        ("L M91", Code::NC_STATE, 3, "without an axis"),
        ("L IX1 M91", Code::NC_STATE, 7, "without an axis"),
        ("L X1 RL M91", Code::COMPENSATION, 1, "straight in the plane"),
        ("L RL", Code::COMPENSATION, 1, "straight in the plane"),
        ("L Z5 RR", Code::COMPENSATION, 1, "straight in the plane"),
        ("L M140 MB50", Code::NC_WORD, 3, "MB MAX"),
        ("C X1 Y1 DR+", Code::NC_ARC, 1, "pole"),
        ("CC X1", Code::NC_WORD, 1, "with X and Y"),
        ("CC X1 Z1", Code::NC_WORD, 1, "plane"),
        ("CR X1 Y0 R0.4 DR+", Code::NC_ARC, 10, "radius"),
        ("CR X1 Y0 DR+", Code::NC_ARC, 1, "radius"),
        ("CR X0 Y0 R1 DR+", Code::NC_ARC, 10, "radius"),
        ("CT X1 Y1", Code::NC_ARC, 1, "direction"),
        ("CP IPA360 DR+", Code::NC_ARC, 1, "pole"),
        ("RND R5", Code::NC_WORD, 1, "rounded corners"),
        ("CHF 2", Code::NC_WORD, 1, "chamfers"),
        ("CALL LBL 1 REP 2", Code::NC_WORD, 1, "calls"),
        ("FN 0: Q1 = 5", Code::NC_WORD, 1, "Q parameters"),
        ("Q1 = 5", Code::NC_WORD, 1, "Q parameters"),
        ("FUNCTION MODE TURN", Code::NC_WORD, 1, "function"),
        ("TCH PROBE 417", Code::NC_WORD, 1, "probing"),
        ("APPR LT X1 LEN5", Code::NC_WORD, 1, "approaches"),
        ("FL X1", Code::NC_WORD, 1, "free contours"),
        ("CYCL DEF 11.1 SCL0.5", Code::NC_WORD, 6, "not read yet"),
        ("CYCL DEF 7.1 #5", Code::NC_SYNTAX, 14, "no meaning"),
        ("CYCL DEF 247 Q339=0", Code::NC_WORD, 14, "presets"),
        ("CYCL DEF 9.1 -3", Code::NC_SYNTAX, 14, "0 to 3600"),
        ("CYCL CALL", Code::NC_STATE, 1, "not defined"),
        ("CYCL DEF 200 Q200=2 Q201=-5", Code::NC_STATE, 1, "Q206"),
        ("CYCL DEF 200 Q200=2 Q201=5 Q206=9 Q203=0", Code::NC_STATE, 1, "below zero"),
        ("CYCL DEF 200 Q200=2 Q201=-5 Q206=9 Q203=0 Q999=1", Code::NC_WORD, 43, "does not use"),
        ("TOOL CALL \"MILL\" Z", Code::NC_WORD, 11, "by their number"),
        ("TOOL CALL 1.55 Z", Code::NC_SYNTAX, 6, "index"),
        ("TOOL CALL 1.1 Z", Code::NC_WORD, 6, ".2 to .9"),
        ("TOOL CALL 1 Z DL+0.1", Code::NC_WORD, 15, "allowances"),
        ("X+5 R0 F100", Code::NC_WORD, 1, "kinecut does not know"),
        ("BEGIN PGM B MM", Code::NC_WORD, 1, "within a program"),
        ("L X\u{e4}", Code::NC_SYNTAX, 4, "no meaning"),
        ("L X1 \"a", Code::NC_SYNTAX, 6, "not closed"),
        ("L X99999999999", Code::NC_SYNTAX, 3, "too large"),
    ] {
        let result = try_read(&format!("{head}{block}\nEND PGM E MM\n"));
        let error = result.map(|r| format!("{:?}", r.program.items)).expect_err(block);
        let place = error.0.place.clone().unwrap();
        assert_eq!((error.code(), place.line, place.column), (code, 6, at), "{block}: {error}");
        assert!(error.to_string().contains(words), "{block}: {error}");
    }
    // The arc that would be another one.
    let text = format!("{head}CC X5 Y0\nC X9.98 Y0 DR+\nEND PGM E MM\n");
    let error = try_read(&text).unwrap_err();
    assert_eq!((error.code(), error.0.place.as_ref().unwrap().line), (Code::NC_ARC, 7));
    assert!(error.to_string().contains("5.00000 mm from its centre, the end 4.98000"), "{error}");
    for (block, words) in [
        ("CP IPA-30 DR+", "contradict"),
        ("CP IPA0 DR+", "contradict"),
        ("CP DR+", "angle"),
        ("CP X1 IPA9 DR+", "no X"),
    ] {
        let error = try_read(&format!("{head}CC X5 Y0\n{block}\n")).unwrap_err();
        assert!(error.to_string().contains(words), "{block} {error}");
    }
    for (block, words) in [
        ("L X1 Y9 RR", "side"),
        ("L X5 M91", "machine coordinates"),
        ("TOOL CALL 1.2 Z", "a tool is called"),
        ("CYCL DEF 247 Q339=2", "preset"),
        ("CYCL DEF 7.1 X1", "datum"),
        ("CYCL CALL", "cycle"),
        ("L R0", "straight in the plane"),
        ("L Z9 R0", "straight in the plane"),
    ] {
        let error = try_read(&format!("{head}L X5 Y0 RL\nCC X0 Y0\nC X5 Y0 DR-\n{block}\n")).unwrap_err();
        assert_eq!(
            (error.code(), error.0.place.as_ref().unwrap().line),
            (Code::COMPENSATION, 9),
            "{block} {error}"
        );
        assert!(error.to_string().contains(words), "{block} {error}");
    }
    // Nothing is known after a tool change.
    let error = try_read("BEGIN PGM E MM\nTOOL CALL 1 Z S1\nL X1 Y1 F100\n").unwrap_err();
    assert!(error.to_string().contains("has not set X, Y, Z"), "{error}");
}
