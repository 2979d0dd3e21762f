//! What is refused: programs that the control cannot say, and texts that kinecut does not follow.

use super::*;
use kinecut::base::Code;
use kinecut::program::Comp;

/// A program that is not written, by what is said about it.
fn unwritten(build: impl Fn(&mut Builder)) -> String {
    let mut b = Builder::new();
    b.line(0.0, 0.0, 50.0, RAPID);
    build(&mut b);
    match b.post() {
        Err(error) => format!("{:?} {:?}: {error}", error.0.key, error.0.item),
        Ok(posted) => panic!("{}", posted.text),
    }
}

#[test]
fn what_the_control_cannot_say_is_named_with_the_item() {
    let vector = ToolAxis::Vector(DVec3::Z);
    let a = degrees([Some(30.0), None, None]);
    let of = |build: &dyn Fn(&mut Builder), words: &str| {
        let message = unwritten(build);
        let key = if words == "left-handed" { "frame[1]" } else { "Some(2)" };
        assert!(message.contains(words) && message.contains(key), "{words}: {message}");
    };
    of(&|b| b.tip(0.0, 0.0, 0.0, vector, FEED), "needs control of the tool centre point");
    of(&|b| b.tip(1.0, 0.0, 0.0, a, Speed::Duration(2.0)), "no inverse time");
    let message = unwritten(|b: &mut Builder| {
        b.tip(1.0, 0.0, 0.0, a, FEED);
        b.line(2.0, 0.0, 0.0, FEED);
    });
    assert!(message.contains("along Z while the rotary axes stand elsewhere"), "{message}");
    of(
        &|b| {
            b.state.comp = Comp::Left(1);
            b.tip(1.0, 0.0, 0.0, a, FEED);
        },
        "compensation",
    );
    of(
        &|b| {
            b.tilt(about(DVec3::X, 30.0), DVec3::ZERO, RotarySolution::Free);
            b.tip(1.0, 0.0, 0.0, a, RAPID);
        },
        "within a tilted plane",
    );
    of(
        &|b| {
            b.tilt(about(DVec3::X, 30.0), DVec3::ZERO, RotarySolution::Free);
            b.state.tcp = Tcp::Axes;
            b.line(1.0, 0.0, 0.0, RAPID);
        },
        "within a tilted plane",
    );
    of(
        &|b| {
            b.tilt(DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0)), DVec3::ZERO, RotarySolution::Free);
            b.to(Target::Orient, RAPID);
        },
        "left-handed",
    );
    of(
        &|b| {
            b.tilt(about(DVec3::X, 30.0), DVec3::ZERO, RotarySolution::Free);
            b.to(Target::Orient, Speed::Duration(1.0));
        },
        "in rapid",
    );
    of(&|b| b.tip(1.0, 0.0, 0.0, degrees([Some(1e9), None, None]), FEED), "does not fit");
    of(&|b| b.tip(1.0, 0.0, 0.0, degrees([Some(f64::NAN), None, None]), FEED), "does not fit");
    of(
        &|b| {
            b.state.tcp = Tcp::Vector;
            b.tip(0.0, 0.0, 1.0, ToolAxis::Vector(DVec3::new(0.0, 0.0, 1.1)), FEED);
        },
        "unit vector",
    );
    of(
        &|b| {
            b.state.speed = FEED;
            let end = Target::Tip { point: DVec3::new(2.0, 0.0, 50.0), axis: a };
            let path =
                Path::Arc { centre: DVec3::new(1.0, 0.0, 50.0), axis: DVec3::Z, sweep: 3.0, rise: 0.0 };
            b.program.push_move(Move { end, path }, &b.state, Origin::default());
        },
        "straight",
    );
}

#[test]
fn faults_of_a_text_are_named_with_their_place() {
    let head = "BEGIN PGM E MM\nCYCL DEF 247 Q339=1\nTOOL CALL 1 Z S100\nL X0 Y0 Z0 R0 FMAX\nL F100\n";
    for (blocks, code, at, words) in [
        ("L X1 A", Code::NC_SYNTAX, 6, "number is missing"),
        ("L A1 IA2", Code::NC_SYNTAX, 6, "twice"),
        ("L A1 A2", Code::NC_SYNTAX, 6, "twice"),
        ("L IA5", Code::NC_STATE, 3, "increment"),
        ("L A+Q5", Code::NC_WORD, 3, "Q parameters"),
        ("L A+Q120", Code::NC_WORD, 3, "in a tilted plane"),
        ("L X+Q120", Code::NC_WORD, 3, "Q parameters"),
        ("L X1 A10 RL", Code::COMPENSATION, 1, "straight in the plane"),
        ("L X1 M128 F", Code::NC_SYNTAX, 11, "number"),
        ("LN X1 Y1 Z1 TX0 TY0 TZ1", Code::NC_STATE, 13, "tool centre point"),
        ("LN X1 Y1 Z1 NX0 NY0", Code::NC_STATE, 13, "NZ"),
        ("LN X1 Y1 Z1 NX0 NY0 NZ2", Code::NC_SYNTAX, 13, "length 1"),
        ("LN NX0 NY0 NZ1", Code::NC_STATE, 1, "names X, Y and Z"),
        ("LN X1 Y1 Z1 NX0 NY0 NZ1 A5", Code::NC_WORD, 25, "does not use"),
        ("C X1 Y1 A5 DR+", Code::NC_ARC, 1, "pole"),
        ("PLANE", Code::NC_SYNTAX, 1, "kind"),
        ("PLANE SPATIAL SPA0 SPB0 SPC0", Code::NC_STATE, 1, "rotary axes do"),
        ("PLANE SPATIAL SPA0 SPB0 TURN FMAX", Code::NC_STATE, 1, "SPC"),
        ("PLANE SPATIAL SPA0 SPB0 SPC0 MOVE DIST50 FMAX", Code::NC_WORD, 30, "TURN or STAY"),
        ("PLANE SPATIAL SPA0 SPB0 SPC0 TURN MB MAX FMAX", Code::NC_WORD, 35, "TURN or STAY"),
        ("PLANE SPATIAL SPA0 SPB0 SPC0 TURN STAY", Code::NC_SYNTAX, 35, "twice"),
        ("PLANE SPATIAL SPA0 SPB0 SPC0 STAY SEQ+ SYM-", Code::NC_SYNTAX, 40, "twice"),
        ("PLANE SPATIAL SPA0 SPB0 SPC0 STAY SEQ", Code::NC_SYNTAX, 35, "sign"),
        ("PLANE SPATIAL SPA0 SPB0 SPC0 STAY SPA1", Code::NC_SYNTAX, 35, "twice"),
        ("PLANE SPATIAL SPA0 SPB0 SPC0 STAY X1", Code::NC_WORD, 35, "does not use"),
        ("PLANE PROJECTED PROPR0 PROMIN0 ROT0 STAY", Code::NC_WORD, 1, "projected"),
        ("PLANE POINTS P1X0 STAY", Code::NC_WORD, 1, "points"),
        ("PLANE AXIAL A30 STAY", Code::NC_WORD, 1, "axis angles"),
        ("PLANE SLANTED A30 STAY", Code::NC_WORD, 7, "does not know"),
        ("PLANE VECTOR BX1 BY0 BZ0 NX1 NY0 NZ1 STAY", Code::NC_STATE, 1, "across its normal"),
        ("PLANE RELATIV SPA5 SPB5 STAY", Code::NC_STATE, 1, "one of"),
        ("FUNCTION TCPM F TCP AXIS SPAT PATHCTRL AXIS", Code::NC_WORD, 21, "spatial"),
        ("FUNCTION TCPM F TCP AXIS POS", Code::NC_STATE, 1, "PATHCTRL"),
        ("FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS REFPNT CENTER-CENTER", Code::NC_WORD, 44, "tip"),
        ("FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS PATHCTRL AXIS", Code::NC_WORD, 44, "twice"),
        ("FUNCTION TURNDATA CORR", Code::NC_WORD, 1, "function"),
        ("CYCL DEF 19.0 WORKING PLANE", Code::NC_WORD, 6, "not read yet"),
    ] {
        fault(head, blocks, code, (6, at), words);
    }
}

#[test]
fn faults_of_order_are_named_with_their_place() {
    let head = "BEGIN PGM E MM\nCYCL DEF 247 Q339=1\nTOOL CALL 1 Z S100\nL X0 Y0 Z0 R0 FMAX\nL F100\n";
    let plane = "PLANE SPATIAL SPA0 SPB30 SPC0 STAY";
    for (blocks, code, place, words) in [
        // A feed from where nobody knows.
        (format!("{plane}\nL X1"), Code::NC_STATE, (7, 1), "has not set X, Y, Z"),
        ("L A10 FMAX\nM128\nL X1".to_owned(), Code::NC_STATE, (8, 1), "has not set"),
        (format!("{plane}\nL X1 A10 FMAX"), Code::NC_WORD, (7, 1), "together"),
        (format!("{plane}\nM128"), Code::NC_WORD, (7, 1), "within a tilted plane"),
        (format!("M128\n{plane}"), Code::NC_STATE, (7, 1), "M129"),
        ("M128\nL Z-5 FMAX M91".to_owned(), Code::NC_STATE, (7, 12), "M129"),
        ("M126\nL A10 FMAX\nL A200 FMAX".to_owned(), Code::NC_WORD, (8, 3), "half a turn"),
        (format!("{plane}\nCYCL DEF 247 Q339=2"), Code::NC_WORD, (7, 6), "preset"),
        (format!("CYCL DEF 10.1 ROT+30\n{plane}"), Code::NC_WORD, (7, 1), "ROT+0"),
        (format!("{plane}\nCYCL DEF 10.1 ROT+30\nPLANE RESET STAY"), Code::NC_WORD, (8, 1), "ROT+0"),
        // A shift within the plane while the plane itself is shifted: which one is meant?
        (
            format!("CYCL DEF 7.1 X+5\n{plane}\nCYCL DEF 7.1 X+7\nL X0 Y0 Z0 FMAX"),
            Code::NC_WORD,
            (8, 1),
            "reverse order",
        ),
        (
            format!("{plane}\nCYCL DEF 7.1 X+7\nPLANE RESET STAY\nL X0 Y0 Z0 FMAX"),
            Code::NC_WORD,
            (8, 1),
            "reverse order",
        ),
        (format!("{plane}\nCYCL CALL"), Code::NC_STATE, (7, 1), "not defined"),
    ] {
        fault(head, &blocks, code, place, words);
    }
}

fn fault(head: &str, blocks: &str, code: Code, at: (u32, u32), words: &str) {
    let result = try_read(&format!("{head}{blocks}\nEND PGM E MM\n"));
    let error = result.map(|r| format!("{:?}", r.program.items)).expect_err(blocks);
    let place = error.0.place.clone().unwrap();
    assert_eq!((error.code(), (place.line, place.column)), (code, at), "{blocks}: {error}");
    assert!(error.to_string().contains(words), "{blocks}: {error}");
}

#[test]
fn what_stays_on_at_the_end_is_told() {
    let end = |blocks: &str| {
        let text = format!(
            "BEGIN PGM E MM\nCYCL DEF 247 Q339=1\nTOOL CALL 1 Z\nL X0 Y0 Z0 R0 FMAX\n{blocks}\nM30\n"
        );
        let found = read_text(&text).findings;
        found.iter().map(|f| f.message.clone()).collect::<Vec<_>>().join("; ")
    };
    assert!(end("M128").contains("M128"));
    assert!(end("PLANE SPATIAL SPA1 SPB0 SPC0 STAY").contains("tilted"));
    assert_eq!(end("M128\nM129\nPLANE SPATIAL SPA1 SPB0 SPC0 STAY\nPLANE RESET STAY"), "");
    assert!(end("M128\nTOOL CALL 2 Z\nM129").contains("a tool is called"));
}
