//! Texts of others: what they mean, and what is refused.

use super::*;
use kinecut::program::{Item, StopKind};

/// The moves of a program with their states.
fn moves(reading: &Reading) -> Vec<(Move, State)> {
    let program = &reading.program;
    let of = |i: usize| match program.items.get(i) {
        Item::Move(motion) => Some((motion, *program.state(i))),
        _ => None,
    };
    (0..program.items.len()).filter_map(of).collect()
}

fn motion_of(reading: &Reading, state: &State) -> (Rigid, RotarySolution) {
    match reading.program.frames[state.frame.0 as usize] {
        Frame::Tilted { motion, branch, parent } => {
            assert_eq!(reading.program.frames[parent.0 as usize], Frame::Work(WorkOffset::G54));
            (motion, branch)
        }
        ref other => panic!("{other:?}"),
    }
}

/// The tilted frame of the first orientation of a text.
fn plane(text: &str, control: Control) -> (Rigid, RotarySolution) {
    let reading = read_text(text, control);
    let all = moves(&reading);
    let (_, state) = all.iter().find(|m| m.0.end == Target::Orient).unwrap();
    motion_of(&reading, state)
}

/// Indexed by hand, then along the plane, then with the tip controlled: the order of a usual post-processor.
#[test]
fn fanuc_program_of_a_post_processor() {
    let text = "%\nO1001\nN10 G90 G94 G17 G49 G40 G80\nN15 G21\nN20 G53 G0 Z0.\nN30 G69\nN35 G0 A0. C0.\n\
        N40 T2 M6\nN45 S5000 M3\nN55 G54\nN60 G0 A30. C0.\nN70 G68.2 X1. Y2. Z3. I0. J30. K0.\nN75 G53.1\n\
        N80 G0 X51.289 Y-18.553\nN82 G43 H2 Z5.\nN84 G1 Z-1. F100.\nN85 G69\nN90 G43.4 H2\n\
        N95 G0 X51.289 Y-29.817 Z14.539 A30. C0.\nN105 G1 Y-20.268 Z-2. F1000.\nN106 X10. A-12500\nN110 G49\n\
        N115 G43 H2 G0 Z100.\nN120 G0 A0. C0.\nN125 X0.\nM30\n%\n";
    let reading = read_text(text, Control::Fanuc);
    let all = moves(&reading);
    let (tilted, branch) = motion_of(&reading, &all[3].1);
    assert_eq!(all[3].0.end, Target::Orient);
    let wanted = Rigid { rotation: euler(0.0, 30.0, 0.0), translation: DVec3::new(1.0, 2.0, 3.0) };
    assert!(apart(&tilted, &wanted) < 1e-14 && branch == RotarySolution::Free);
    let tip = |i: usize| match all[i].0.end {
        Target::Tip { point, axis } => (point.to_array(), axis, all[i].1.tcp),
        other => panic!("{other:?}"),
    };
    // In the plane the tool stands along it; Z is not known before it is said.
    let (point, axis, tcp) = tip(4);
    assert!(point[2].is_nan() && axis == ToolAxis::Fixed && tcp == Tcp::Off);
    assert_eq!(tip(6), ([51.289, -18.553, -1.0], ToolAxis::Fixed, Tcp::Off));
    assert_eq!(tip(7), ([51.289, -29.817, 14.539], rotary(Some(30.0), None, Some(0.0)), Tcp::Axes));
    // Nothing turns: the tool axis is kept.
    assert_eq!(tip(8), ([51.289, -20.268, -2.0], ToolAxis::Rotary([None; 3]), Tcp::Axes));
    // Without a point the number counts thousandths of a degree.
    assert_eq!(tip(9), ([10.0, -20.268, -2.0], rotary(Some(-12.5), None, None), Tcp::Axes));
    // What was known of the place is not known any more.
    let (point, axis, tcp) = tip(10);
    assert!(point[0].is_nan() && point[2] == 100.0 && tcp == Tcp::Off);
    assert_eq!(axis, ToolAxis::Rotary([None; 3]));
    // With all rotary axes at zero the tool stands along Z again.
    assert_eq!(tip(12).1, ToolAxis::Fixed);
    // The length was the program's throughout: one tool item.
    let tools = (0..reading.program.items.len())
        .filter(|i| matches!(reading.program.items.get(*i), Item::Tool { .. }))
        .count();
    assert_eq!(tools, 1);
    let last = reading.program.items.len() - 1;
    assert_eq!(reading.program.items.get(last), Item::Stop(StopKind::End));
}

/// The block that begins it may say the first direction: K is no count there, with its decimal point as without.
#[test]
fn fanuc_vectors_begin_in_the_block_of_their_code() {
    let text =
        "%\nO1\nG17 G21 G90 G94\nT1 M6\nG54\nG0 G43.5 H1 X1. Y2. Z50. I0. J0.6 K0.8\nG1 Z5. F300.\nM30\n%\n";
    let reading = read_text(text, Control::Fanuc);
    let all = moves(&reading);
    let Target::Tip { axis, .. } = all[0].0.end else { panic!("{:?}", all[0].0.end) };
    assert_eq!((axis, all[0].1.tcp), (ToolAxis::Vector(DVec3::new(0.0, 0.6, 0.8)), Tcp::Axes));
    let error = refused(&text.replace("G43.5", "G43"), Control::Fanuc);
    assert!(
        error.contains("`K0.8` is malformed: it is a count here, write it without a decimal point"),
        "{error}"
    );
}

#[test]
fn sinumerik_angles_count_as_their_words_say() {
    let text = "G710 G17 G90 G94 G54\nORIAXES\nTRAORI(1)\nG0 X10 Y0 Z5 A=0 C=350\nG1 Z0 A10 C=DC(10) F300\n\
        G3 X0 Y10 CR=10 A=20 C=IC(90)\nG1 X=IC(-10) C=ACN(0)\nC=ACP(30)\nORIVECT\nA3=0 B3=3 C3=4 X5\nTRAFOOF\nM30\n";
    let reading = read_text(text, Control::Sinumerik840d);
    let axes: Vec<ToolAxis> = moves(&reading)
        .iter()
        .map(|(m, _)| match m.end {
            Target::Tip { axis, .. } => axis,
            other => panic!("{other:?}"),
        })
        .collect();
    let degrees = |axis: ToolAxis, letter: usize| match axis {
        ToolAxis::Rotary(angles) => angles[letter].map(f64::to_degrees),
        other => panic!("{other:?}"),
    };
    let near = |a: Option<f64>, b: f64| assert!((a.unwrap() - b).abs() < 1e-9, "{a:?} {b}");
    near(degrees(axes[1], 2), 370.0);
    near(degrees(axes[1], 0), 10.0);
    near(degrees(axes[2], 2), 460.0);
    near(degrees(axes[3], 2), 360.0);
    near(degrees(axes[4], 2), 390.0);
    assert_eq!(degrees(axes[3], 0), None);
    assert_eq!(axes[5], ToolAxis::Vector(DVec3::new(0.0, 0.6, 0.8)));
    let tcp: Vec<Tcp> = moves(&reading).iter().map(|m| m.1.tcp).collect();
    assert_eq!(tcp, [Tcp::Axes, Tcp::Axes, Tcp::Axes, Tcp::Axes, Tcp::Axes, Tcp::Vector]);
    let points: Vec<f64> = moves(&reading)
        .iter()
        .map(|(m, _)| if let Target::Tip { point, .. } = m.end { point.x } else { 0.0 })
        .collect();
    assert_eq!(points, [10.0, 10.0, 0.0, -10.0, -10.0, 5.0]);
}

/// Angles against products of quaternions about axes that turn along.
#[test]
fn planes_by_their_angles() {
    let fanuc = |words: &str| plane(&format!("G21 G54 G0\nG68.2 {words}\nG53.1\nM30\n"), Control::Fanuc).0;
    let sinumerik = |arguments: &str| {
        plane(&format!("G710 G54 G0\nCYCLE800({arguments})\nM30\n"), Control::Sinumerik840d)
    };
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
    let check = |read: Rigid, rotation: DMat3, translation: DVec3| {
        assert!(apart(&read, &Rigid { rotation, translation }) < 1e-13, "{read:?}");
    };
    check(fanuc("X1. Y2. Z3. I20. J-30. K40."), euler(20.0, -30.0, 40.0), DVec3::new(1.0, 2.0, 3.0));
    check(fanuc("I45000 J90."), euler(45.0, 90.0, 0.0), DVec3::ZERO);
    // Axes that stand still: the last rotation comes first in the product.
    check(fanuc("P1 Q123 I10. J20. K30."), turned(&[(z, 30.0), (y, 20.0), (x, 10.0)]), DVec3::ZERO);
    check(fanuc("P1 Q312 I10. J20. K30."), turned(&[(y, 20.0), (x, 10.0), (z, 30.0)]), DVec3::ZERO);
    let (read, branch) = sinumerik("1,\"TC1\",0,57,1,2,3,10,20,30,0,0,0,1");
    check(read, turned(&[(x, 10.0), (y, 20.0), (z, 30.0)]), DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(branch, RotarySolution::Positive);
    let (read, branch) = sinumerik("0,\"\",200000,54,0,0,0,10,20,30,0,0,5,-1,,1");
    let rotation = turned(&[(y, 10.0), (x, 20.0), (z, 30.0)]);
    check(read, rotation, rotation * (z * 5.0));
    assert_eq!(branch, RotarySolution::Negative);
    let (read, _) = sinumerik("0,,0,27,0,0,0,10,20,30,0,0,0,-1");
    check(read, turned(&[(z, 10.0), (y, 20.0), (x, 30.0)]), DVec3::ZERO);
}

/// A plane within a plane: about the axes of the first one.
#[test]
fn an_additive_plane_lies_in_the_one_before() {
    let text = "G710 G54 G0\nCYCLE800(0,\"\",0,57,0,0,50,-15,0,0,0,0,0,1)\nCYCLE800(0,\"\",1,57,10,0,0,0,20,0,0,0,0,1)\n\
        G0 X0 Y0 Z5\nM30\n";
    let reading = read_text(text, Control::Sinumerik840d);
    let all = moves(&reading);
    let Frame::Tilted { parent, motion, .. } = reading.program.frames[all[2].1.frame.0 as usize] else {
        panic!()
    };
    let Frame::Tilted { motion: outer, .. } = reading.program.frames[parent.0 as usize] else { panic!() };
    let rotation = turned(&[(DVec3::X, -15.0), (DVec3::Y, 20.0)]);
    let translation = DVec3::Z * 50.0 + turned(&[(DVec3::X, -15.0)]) * (DVec3::X * 10.0);
    assert!(apart(&outer.after(&motion), &Rigid { rotation, translation }) < 1e-13);
    // Written again it is one plane from the work offset.
    let settings = PostSettings { block_numbers: false, ..PostSettings::new(Control::Sinumerik840d) };
    let text = nc::write(&reading.program, &[], &settings).unwrap().text;
    assert!(text.contains("CYCLE800(0,\"\",0,57,10,0,50,-15,20,0,0,0,0,1)\nG0 X0 Y0 Z5\n"), "{text}");
}

/// A shift within a plane, as text and back: the points are given in the plane.
#[test]
fn a_shift_within_a_plane() {
    let text = "G710 G54 G0\nT1 M6\nCYCLE800(0,\"\",0,57,0,0,50,-15,0,0,0,0,0,1)\nG0 X0 Y0 Z5\nTRANS X10 Y2\nAROT RPL=90\n\
        G0 X1\nG1 Y4 F100\nTRANS\nCYCLE800()\nM30\n";
    let reading = read_text(text, Control::Sinumerik840d);
    let all = moves(&reading);
    let Frame::Shift { parent, .. } = reading.program.frames[all[3].1.frame.0 as usize] else { panic!() };
    assert!(matches!(reading.program.frames[parent.0 as usize], Frame::Tilted { .. }));
    let settings = PostSettings { block_numbers: false, ..PostSettings::new(Control::Sinumerik840d) };
    let text = nc::write(&reading.program, &[], &settings).unwrap().text;
    // The place X0 Y0 is (-2, 10) in the turned coordinates: (1, 10) is X0 Y3, (1, 4) is X6 Y3.
    assert!(text.contains("G0 X0 Y0 Z5\nG0 Y3\nG1 X6 F100\nCYCLE800()\n"), "{text}");
    // The words of another control.
    let settings = PostSettings { block_numbers: false, ..PostSettings::new(Control::Fanuc) };
    let text = nc::write(&reading.program, &[], &settings).unwrap().text;
    assert!(text.contains("G68.2 X0. Y0. Z50. I0. J-15. K0.\nG0\nG53.1 P1\n"), "{text}");
}

/// The feed of a block that turns an axis is certain in inverse time only; turns beyond the first are said in the head.
#[test]
fn what_numbers_of_rotary_axes_count_on_is_said() {
    let text = |feed: &str| format!("G21 G54 G90\nT1 M6\nG0 X0. Y0. A0.\nG43 H1 Z5.\n{feed}\nM30\n");
    let noted = |feed: &str| {
        let reading = read_text(&text(feed), Control::Fanuc);
        reading.findings.iter().any(|f| f.message.contains("millimetres or degrees"))
    };
    assert!(noted("G1 X5. A30. F100."));
    assert!(!noted("G93 G1 X5. A30. F100."));
    assert!(!noted("G1 X5. F100."));
    let head = |angle: &str| {
        let reading = read_text(&text(&format!("G0 A{angle}")), Control::Fanuc);
        nc::write(&reading.program, &[], &PostSettings::new(Control::Fanuc)).unwrap().text
    };
    assert!(head("370.").contains("NO ROLL-OVER") && !head("350.").contains("ROLL-OVER"));
}

#[test]
fn withdrawing_and_unknown_interpolation_are_said() {
    let text = "G710 G54\nCYCLE800(2,\"TISCH\",200000,57,0,0,50,-15,0,0,0,0,0,1,,1)\nCYCLE800(2,\"0\",200000,57,0,0,0,0,0,0,0,0,0,1,,1)\n\
        TRAORI\nG0 X1 Y1 Z1 A=0 C=0\nM30\n";
    let reading = read_text(text, Control::Sinumerik840d);
    for words in ["withdraws the tool", "ORIVECT is assumed"] {
        assert!(reading.findings.iter().any(|f| f.message.contains(words)), "{:?}", reading.findings);
    }
    let all = moves(&reading);
    assert_eq!(all[1].1.tcp, Tcp::Vector);
    assert_eq!(reading.program.frames[all[1].1.frame.0 as usize], Frame::Work(WorkOffset::G54));
}

#[test]
fn what_is_not_read_is_refused_by_name() {
    let fanuc = "G21 G54 G90\nT1 M6\nG0 X0. Y0.\nG43 H1 Z5.\n";
    let sinumerik = "G710 G54 G90\nT1 M6\nG0 X0 Y0 Z5\n";
    let linuxcnc = "G21 G54 G90\nT1 M6\nG0 X0 Y0 Z5\n";
    let cases = [
        (Control::Fanuc, fanuc, "G68.2 P2 Q0 X0. Y0. Z0.", "three points"),
        (Control::Fanuc, fanuc, "G68.2 P3 X0. Y0. Z0.", "two vectors"),
        (Control::Fanuc, fanuc, "G68.2 P4 X0. Y0. Z0.", "projected angles"),
        (Control::Fanuc, fanuc, "G68.2 P9 X0. Y0. Z0.", "not known"),
        (Control::Fanuc, fanuc, "G68.2 P1 Q122 I1.", "names 1, 2 and 3"),
        (Control::Fanuc, fanuc, "G68.3 X0. Y0. Z0.", "direction of the tool"),
        (Control::Fanuc, fanuc, "G53.1", "there is none"),
        (Control::Fanuc, fanuc, "G68.2 J30.\nG0 X1.", "was not turned"),
        (Control::Fanuc, fanuc, "G68.2 J30.\nG53.1 P3", "P0 to P2"),
        (Control::Fanuc, fanuc, "G68.2 J30.\nG53.1\nG68.2 J20.", "not in a tilted plane"),
        (Control::Fanuc, fanuc, "G68.2 J30.\nG53.1\nG43.4 H1", "not in a tilted plane"),
        (Control::Fanuc, fanuc, "G68.2 J30.\nG53.1\nG55", "not in a tilted plane"),
        (Control::Fanuc, fanuc, "G68.2 J30.\nG53.1\nT2 M6", "not in a tilted plane"),
        (Control::Fanuc, fanuc, "G68.2 J30.\nG53.1\nG0 A30.", "rotary axis moves in a tilted plane"),
        (Control::Fanuc, fanuc, "G43.4 H1\nG68.2 J30.", "under control of the tool centre point"),
        (Control::Fanuc, fanuc, "G43.4 H1\nT2 M6", "tool change under control"),
        (Control::Fanuc, fanuc, "G43.4", "without a register"),
        (Control::Fanuc, fanuc, "G52 X1.\nG68.2 J30.", "shifted or turned"),
        (Control::Fanuc, fanuc, "G41 D1\nG1 X10. F100.\nG43.4 H1", "compensation"),
        (Control::Fanuc, fanuc, "G43.4 H1\nG41 D1", "compensation"),
        (
            Control::Fanuc,
            fanuc,
            "G43.5 H1\nG0 X0. Y0. Z0. K1.\nG2 X10. Y0. I5. J0. F100.",
            "where I, J and K are the tool axis",
        ),
        (Control::Fanuc, fanuc, "G43.5 H1\nG0 X0. Y0. Z0. I0. J0. K0.", "no length"),
        (Control::Fanuc, fanuc, "G43.4 H1\nG0 X0. Y0. Z0.\nG81 Z-5. R1. F100.", "cycle under control"),
        (Control::Fanuc, fanuc, "G91 A5.", "has not set"),
        (Control::Sinumerik840d, sinumerik, "CYCLE800(0,\"\",0,192,0,0,0,1,2,3,0,0,0,1)", "given directly"),
        (Control::Sinumerik840d, sinumerik, "CYCLE800(0,\"\",0,64,0,0,0,1,2,3,0,0,0,1)", "solid angles"),
        (Control::Sinumerik840d, sinumerik, "CYCLE800(0,\"\",0,128,0,0,0,1,2,3,0,0,0,1)", "projected"),
        (Control::Sinumerik840d, sinumerik, "CYCLE800(0,\"\",10,57,0,0,0,1,2,3,0,0,0,1)", "_ST"),
        (Control::Sinumerik840d, sinumerik, "CYCLE800(0,\"\",0,57,0,0,0,1,2,3,0,0,0)\nX5", "_DIR -1 or 1"),
        (Control::Sinumerik840d, sinumerik, "CYCLE800(0,\"A,0,57,0,0,0,1,2,3,0,0,0,1)", "quote"),
        (
            Control::Sinumerik840d,
            sinumerik,
            "TRANS X5\nCYCLE800(0,\"\",0,57,0,0,0,1,2,3,0,0,0,1)",
            "take them back",
        ),
        (
            Control::Sinumerik840d,
            sinumerik,
            "TRAORI\nCYCLE800(0,\"\",0,57,0,0,0,1,2,3,0,0,0,1)",
            "TRAFOOF first",
        ),
        (
            Control::Sinumerik840d,
            sinumerik,
            "CYCLE800(0,\"\",0,57,0,0,0,1,2,3,0,0,0,1)\nTRAORI",
            "end it first (CYCLE800())",
        ),
        (Control::Sinumerik840d, sinumerik, "TRAORI(2)", "first transformation"),
        (Control::Sinumerik840d, sinumerik, "ORIMKS", "not understood"),
        (
            Control::Sinumerik840d,
            sinumerik,
            "G1 A3=1 B3=0 C3=0 F5",
            "without control of the tool centre point",
        ),
        (Control::Sinumerik840d, sinumerik, "TRAORI\nG0 X0 Y0 Z0 A=1 A3=1", "both as angles and as a vector"),
        (Control::Sinumerik840d, sinumerik, "G0 A=IC(5)", "has not set"),
        (Control::Sinumerik840d, sinumerik, "G0 X=DC(5)", "belongs to a rotary axis"),
        (Control::Sinumerik840d, sinumerik, "G4 F=IC(5)", "without a time"),
        (Control::LinuxCnc, linuxcnc, "M428", "M428"),
        (Control::LinuxCnc, linuxcnc, "G43.4 H1", "G43.4"),
        (Control::LinuxCnc, linuxcnc, "G81 X1 Z-5 R1 A5 F100", "lines and arcs only"),
        (Control::Grbl, "G21 G54\nG0 X0 Y0 Z5\n", "G0 A5", "no rotary axes"),
    ];
    for (control, before, text, words) in cases {
        let message = refused(&format!("{before}{text}\nM30\n"), control);
        assert!(message.contains(words), "{text}: {message}");
        // With the line of the block.
        let line = before.lines().count() + text.lines().count();
        assert!(message.starts_with(&format!("test:{line}:")), "{text}: {message}");
    }
}
