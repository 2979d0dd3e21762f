//! Programs of others: what their words mean, by hand.

use kinecut::base::Code;
use kinecut::program::Item;

use super::*;

/// Ends of the moves in the coordinates of the work offset, as far as they are known.
fn ends(text: &str, control: Control) -> Vec<[f64; 3]> {
    let reading = read_text(text, control);
    let program = &reading.program;
    let b = Builder { control, program: program.clone(), ..Builder::new(control) };
    (0..program.items.len())
        .filter_map(|i| {
            let Item::Move(Move { end: Target::Tip { point, .. }, .. }) = program.items.get(i) else {
                return None;
            };
            let (_, motion) = b.resolved(program.state(i).frame);
            Some(motion.point(point).to_array())
        })
        .collect()
}

fn check(text: &str, control: Control, wanted: &[[f64; 3]]) {
    let found = ends(text, control);
    assert_eq!(found.len(), wanted.len(), "{found:?}\n{text}");
    for (a, b) in found.iter().zip(wanted) {
        let gap = (DVec3::from_array(*a) - DVec3::from_array(*b)).length();
        assert!(gap < 1e-9, "{a:?} {b:?}\n{text}");
    }
}

fn refused(text: &str, control: Control, code: Code, words: &str) {
    let error = nc::read(&mut Sources::default(), "a", text, control, &[setup()]).expect_err(text);
    assert_eq!(error.code(), code, "{error}");
    assert!(error.to_string().contains(words), "{error}");
}

const H: f64 = 0.866_025_403_784_438_6;

#[test]
fn fanuc_turns_about_a_centre_and_shifts() {
    let control = Control::Fanuc;
    let head = "G17 G21 G90 G94\nG54\nG0 X0. Y0. Z5.\n";
    let first = [0.0, 0.0, 5.0];
    // About (10, 0): (20, 0) goes to (10, 10); an increment turns; G69 keeps the tool where it is.
    check(
        &format!("{head}G68 X10. Y0. R90.\nG0 X20. Y0.\nG91 G0 X5.\nG90 G69\nG0 Z1.\nG0 X0.\nM30\n"),
        control,
        &[first, [10.0, 10.0, 5.0], [10.0, 15.0, 5.0], [10.0, 15.0, 1.0], [0.0, 15.0, 1.0]],
    );
    // Without a centre about the present place; what is left out is that of the turned coordinates.
    check(
        "G17 G21 G90 G94\nG54\nG0 X3. Y4. Z5.\nG68 R30.\nG91 G0 X2.\nG90 G0 X3.\nM30\n",
        control,
        &[[3.0, 4.0, 5.0], [3.0 + 2.0 * H, 5.0, 5.0], [3.0, 4.0, 5.0]],
    );
    // A local shift first; thousandths without a point; G69 in a block with a move.
    check(
        &format!(
            "{head}G52 X100. Y50.\nG68 X0 Y0 R90000\nG0 X1. Y2.\nG69 G0 X1. Y2.\nG52 X0. Y0.\nG0 X1.\nM30\n"
        ),
        control,
        &[first, [98.0, 51.0, 5.0], [101.0, 52.0, 5.0], [1.0, 52.0, 5.0]],
    );
    // An arc by I and J, one by R, and a cycle series.
    let text = format!(
        "{head}G68 X0. Y0. R90.\nG0 X10. Y0.\nG1 Z0. F100.\nG3 X0. Y10. I-10. J0.\nG2 X10. Y0. R10.\nG0 Z5.\n\
         G81 X7. Y8. Z-3. R2. F50.\nX9.\nG80\nG69\nM30\n"
    );
    check(
        &text,
        control,
        &[
            first,
            [0.0, 10.0, 5.0],
            [0.0, 10.0, 0.0],
            [-10.0, 0.0, 0.0],
            [0.0, 10.0, 0.0],
            [0.0, 10.0, 5.0],
            [-8.0, 7.0, 5.0],
            [-8.0, 9.0, 5.0],
        ],
    );
    let program = read_text(&text, control).program;
    let arcs: Vec<Curve> =
        traced(&program).segments.iter().map(|s| s.curve.clone()).filter(|c| c.length() > 15.0).collect();
    assert!(arcs.iter().filter(|c| (c.length() - TAU * 2.5).abs() < 1e-9).count() == 2);
    // The same centre again, another angle.
    check(
        &format!("{head}G68 X10. Y0. R90.\nG68 X10. Y0. R-90.\nG0 X20. Y0.\nG69\nM30\n"),
        control,
        &[first, [10.0, -10.0, 5.0]],
    );
}

#[test]
fn fanuc_refuses_what_its_manual_forbids_or_leaves_open() {
    let head = "G17 G21 G90 G94\nG54\nG0 X0. Y0. Z5.\n";
    let on = format!("{head}G68 X0. Y0. R30.\n");
    for (block, words) in [
        ("G53 G0 Z0.", "G69"),
        ("G55", "G69"),
        ("G52 X1.", "G69"),
        ("G18", "G69"),
        ("G91 G68 R10.", "5400"),
        ("G68 X1. Y1. R10.", "another centre"),
        ("G69\nG68 X0. Y0.", "5410"),
        ("G69\nG68 X0. R10.", "both"),
        ("G69\nG91 G52 X0.", "G91"),
        ("G69\nG53 G0 X0.\nG68 R10.", "present place"),
    ] {
        refused(&format!("{on}{block}\n"), Control::Fanuc, Code::NC_STATE, words);
    }
    for (block, code) in [
        ("G68 X0. Y0. Z0. I0. J0. K1 R30.", Code::NC_WORD),
        ("G68.2 P2 Q0 X0. Y0. Z0.", Code::NC_WORD),
        ("G51 X0. Y0.", Code::NC_STATE),
        ("G18\nG68 X0. Z0. R30.", Code::NC_WORD),
        ("G68 X0. Y0. R30. G52 X1.", Code::NC_SYNTAX),
    ] {
        refused(&format!("{head}{block}\n"), Control::Fanuc, code, "");
    }
    let compensated = format!("{head}G1 G41 D1 X9. Y0. F100.\nG68 X0. Y0. R30.\n");
    refused(&compensated, Control::Fanuc, Code::COMPENSATION, "G68");
    for control in [Control::Grbl, Control::LinuxCnc, Control::Sinumerik840d] {
        refused("G17 G90\nG0 X0 Y0 Z5\nG68 X0 Y0 R30\n", control, Code::NC_WORD, "G68");
    }
}

#[test]
fn sinumerik_replaces_or_goes_on() {
    let control = Control::Sinumerik840d;
    let head = "G17 G90 G94 G710\nG54\nG0 X0 Y0 Z5\n";
    let first = [0.0, 0.0, 5.0];
    check(
        &format!(
            "{head}TRANS X10 Y20 Z1\nAROT RPL=90\nG0 X3 Y0 Z5\nATRANS X0 Y2\nG0 X0 Y0\nROT RPL=30\nG0 X2 Y0 Z5\nROT\nG0 X1\nM30\n"
        ),
        control,
        &[first, [10.0, 23.0, 6.0], [8.0, 20.0, 6.0], [2.0 * H, 1.0, 5.0], [1.0, 1.0, 5.0]],
    );
    check(
        &format!(
            "{head}ROT Z=90\nG0 X3 Y0\nG91 G0 X1\nG90\nTRANS X5\nG0 X0 Y0\nG55\nG0 X1 Y1 Z5\nTRANS\nG0 X1 Y1\nM30\n"
        ),
        control,
        &[first, [0.0, 3.0, 5.0], [0.0, 4.0, 5.0], [5.0, 0.0, 5.0], [6.0, 1.0, 5.0], [1.0, 1.0, 5.0]],
    );
    // A move in machine coordinates leaves them aside, and both coordinates of the turned frame unknown.
    let reading = read_text(&format!("{head}ROT RPL=30\nG0 X1 Y1\nG0 SUPA X0 D0\nG0 X2\nM30\n"), control);
    let last = (0..reading.program.items.len())
        .filter_map(|i| match reading.program.items.get(i) {
            Item::Move(Move { end: Target::Tip { point, .. }, .. }) => Some(point),
            _ => None,
        })
        .next_back();
    assert!(last.is_some_and(|p| p.x == 2.0 && p.y.is_nan() && p.z == 5.0), "{last:?}");
    // Holes along turned coordinates, called after each move.
    check(
        &format!("{head}ROT RPL=90\nF100\nMCALL CYCLE81(5,0,2,-9)\nG0 X1 Y0\nX2\nMCALL\nROT\nM30\n"),
        control,
        &[first, [0.0, 1.0, 5.0], [0.0, 2.0, 5.0]],
    );
    for (block, code, words) in [
        ("ROT X30", Code::NC_WORD, "about Z only"),
        ("AROT Y=30", Code::NC_WORD, "about Z only"),
        ("MIRROR X0", Code::NC_WORD, "MIRROR"),
        ("SCALE X2", Code::NC_WORD, "SCALE"),
        ("ROTS X1 Y2", Code::NC_WORD, "ROTS"),
        ("G0 TRANS X5", Code::NC_STATE, "own"),
        ("AROT", Code::NC_STATE, "angle"),
        ("ATRANS", Code::NC_STATE, "axis"),
        ("ROT Z30 RPL=30", Code::NC_SYNTAX, "RPL"),
        ("G18\nROT RPL=30", Code::NC_WORD, "G17"),
        ("TRANS X5\nG91 G0 X1", Code::NC_STATE, "42440"),
        ("G0 X1 RPL=30", Code::NC_WORD, "RPL"),
        ("F100\nMCALL CYCLE81(5,0,2,-9)\nTRANS X5", Code::NC_STATE, "cycle"),
    ] {
        refused(&format!("{head}{block}\n"), control, code, words);
    }
}

/// The numbers are those of the control's own interpreter for this text.
#[test]
fn linuxcnc_turns_its_work_offset() {
    let text = "G17 G21 G40 G49 G80\nG90 G91.1 G94\nG54\nG0 X1 Y2 Z30\nG10 L2 P1 R30\nG52 X10 Y20 Z3\nG0 X0 Y0 Z5\n\
        G1 X10 F100\nG91 G1 X5\nG90\nG53 G0 Z0\nG0 X1 Y2\nG0 Z-3\nG52 X0 Y0 Z0\nG10 L2 P1 R0\nG0 X3\nM2\n";
    let turned = |x: f64, y: f64| [H * x - 0.5 * y, 0.5 * x + H * y];
    let at = |x: f64, y: f64, z: f64| {
        let [u, v] = turned(x + 10.0, y + 20.0);
        [u, v, z + 3.0]
    };
    let found = ends(text, Control::LinuxCnc);
    let y = turned(11.0, 22.0)[1];
    let wanted = [[1.0, 2.0, 30.0], at(0.0, 0.0, 5.0), at(10.0, 0.0, 5.0), at(15.0, 0.0, 5.0)];
    for (a, b) in found.iter().zip(wanted) {
        assert!((DVec3::from_array(*a) - DVec3::from_array(b)).length() < 1e-9, "{a:?} {b:?}");
    }
    let last = found[found.len() - 1];
    assert!((y - 24.5526).abs() < 1e-4 && (last[1] - y).abs() < 1e-9 && last[0] == 3.0, "{last:?}");
    // Another offset is turned before it is called; P0 is the one in force.
    check(
        "G17 G21 G90\nG54\nG10 L2 P2 R90\nG0 X1 Y0 Z1\nG55\nG0 X1 Y0 Z1\nG10 L2 P0 R0\nG0 X1 Y0\nM2\n",
        Control::LinuxCnc,
        &[[1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]],
    );
    let reading = read_text("G17 G21 G90\nG54\nG10 L2 P1 R90\nG0 X1 Y0 Z1\nM2\n", Control::LinuxCnc);
    assert!(reading.findings.iter().any(|f| f.message.contains("stays beyond")), "{:?}", reading.findings);
    let head = "G17 G21 G90\nG54\nG0 X0 Y0 Z0\n";
    for (block, code, words) in [
        ("G10 L2 P1 X0 Y0", Code::NC_STATE, "changes after moves in it"),
        ("G10 L13 P1 X0", Code::NC_WORD, "only work offsets and the tool table are read"),
        ("G10 L2 R30", Code::NC_STATE, "P"),
        ("G10 L2 P1", Code::NC_STATE, "rotation"),
        ("G10 L2 P10 R1", Code::NC_SYNTAX, "P9"),
    ] {
        refused(&format!("{head}{block}\n"), Control::LinuxCnc, code, words);
    }
}

#[test]
fn klartext_shifts_then_turns() {
    let control = Control::Heidenhain;
    let head = "BEGIN PGM T MM\nCYCL DEF 247 Q339=1\nTOOL CALL 1 Z S1000\nL X0 Y0 Z5 R0 FMAX\n";
    let first = [0.0, 0.0, 5.0];
    check(
        &format!(
            "{head}CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nCYCL DEF 7.2 Y+20\nCYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+60\n\
             CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 IROT+30\nL X3 Y0 FMAX\nL IX1 FMAX\nCYCL DEF 10.1 ROT+0\nL X0 FMAX\nCYCL DEF 7.1 X0\nCYCL DEF 7.2 IY-20\nL X1 FMAX\nM30\n"
        ),
        control,
        &[first, [10.0, 23.0, 5.0], [10.0, 24.0, 5.0], [10.0, 24.0, 5.0], [1.0, 24.0, 5.0]],
    );
    // The shift may be taken back before the rotation; a preset takes back both.
    check(
        &format!(
            "{head}CYCL DEF 7.1 X+10\nCYCL DEF 10.1 ROT+90\nL X3 Y0 FMAX\nCYCL DEF 7.1 X+0\nCYCL DEF 10.1 ROT+0\nL X1 Y1 FMAX\n\
             CYCL DEF 10.1 ROT+90\nCYCL DEF 247 Q339=1\nL X2 Y1 FMAX\nM30\n"
        ),
        control,
        &[first, [10.0, 3.0, 5.0], [1.0, 1.0, 5.0], [2.0, 1.0, 5.0]],
    );
    // The newer words for the same.
    check(
        &format!(
            "{head}TRANS DATUM AXIS X+10 Y+20 Z+1\nTRANS ROTATION ROT+90\nL X3 Y0 Z5 FMAX\nTRANS ROTATION RESET\nTRANS DATUM RESET\n\
             L X1 FMAX\nM30\n"
        ),
        control,
        &[first, [10.0, 23.0, 6.0], [1.0, 23.0, 6.0]],
    );
    // Arcs about a pole, a helix by its angle, and a hole.
    let text = format!(
        "{head}CYCL DEF 10.1 ROT-90\nCC X0 Y0\nL X10 Y0 FMAX\nL Z0 F100\nC X0 Y10 DR+\nCP IPA+90 IZ-1 DR+\n\
         CYCL DEF 200 DRILLING ~\nQ200=2 ~\nQ201=-5 ~\nQ206=100 ~\nQ202=5 ~\nQ203=0\nL X7 Y8 Z5 FMAX M99\nM30\n"
    );
    check(
        &text,
        control,
        &[first, [0.0, -10.0, 5.0], [0.0, -10.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, -1.0], [8.0, -7.0, 5.0]],
    );
    for (block, code, words) in [
        (
            "CYCL DEF 10.1 ROT+30\nCYCL DEF 7.1 X+10\nL X1 FMAX",
            Code::NC_WORD,
            "an order in which it is not certain",
        ),
        ("CYCL DEF 10.1", Code::NC_STATE, "ROT"),
        ("TRANS MIRROR AXIS X", Code::NC_WORD, "TRANS"),
        ("TRANS DATUM AXIS X+10", Code::NC_WORD, "TRANS"),
        ("TRANS DATUM TABLE TABLINE1", Code::NC_WORD, "TRANS"),
        ("CYCL DEF 8.0 MIRROR", Code::NC_WORD, "8"),
        ("CYCL DEF 11.0 SCALING", Code::NC_WORD, "11"),
        ("CYCL DEF 19.0 WORKING PLANE", Code::NC_WORD, "19"),
        ("CC X0 Y0\nCYCL DEF 10.1 ROT+30\nC X0 Y10 DR+ F100", Code::NC_ARC, "pole"),
        ("L X9 Y0 RL F100\nCYCL DEF 10.1 ROT+30", Code::COMPENSATION, "turned"),
    ] {
        refused(&format!("{head}{block}\n"), control, code, words);
    }
}
