//! What texts mean.

use super::*;

fn point(motion: &Move) -> DVec3 {
    let Target::Tip { point, .. } = motion.end else { panic!("{motion:?}") };
    point
}

fn rotary(motion: &Move) -> [Option<f64>; 3] {
    let Target::Tip { axis: ToolAxis::Rotary(angles), .. } = motion.end else { panic!("{motion:?}") };
    angles.map(|a| a.map(|a| (a.to_degrees() * 1e6).round() / 1e6))
}

#[test]
fn rotary_words_stay_and_count_on() {
    let (_, found) = moves_of("L X+1 A-30.5 C+90\nL Y2 IC-450\nL B+10,25 FMAX\nL X+5");
    assert_eq!(
        (point(&found[0].0), rotary(&found[0].0)),
        (DVec3::new(1.0, 0.0, 100.0), [Some(-30.5), None, Some(90.0)])
    );
    assert_eq!(
        (point(&found[1].0), rotary(&found[1].0)),
        (DVec3::new(1.0, 2.0, 100.0), [None, None, Some(-360.0)])
    );
    assert_eq!(
        (point(&found[2].0), rotary(&found[2].0)),
        (DVec3::new(1.0, 2.0, 100.0), [None, Some(10.25), None])
    );
    assert_eq!(found[2].1.speed, RAPID);
    // The axes stay where they are.
    assert_eq!((point(&found[3].0), rotary(&found[3].0)), (DVec3::new(5.0, 2.0, 100.0), [None; 3]));
    assert!(found.iter().all(|(_, s)| s.tcp == Tcp::Off));
}

#[test]
fn rotary_axes_alone_are_axes_of_the_machine_where_the_tip_is_not_known() {
    let text = "BEGIN PGM A MM\nCYCL DEF 247 Q339=+1\nTOOL CALL 4 Z S1000\nL A0 C0 R0 FMAX\nL X0 Y0 Z0 FMAX\nL Z5 B9 FMAX \
                M91\nM30\n";
    let found = moves(&read_text(text).program);
    assert_eq!(found[0].0.end, Target::Joints([None, None, None, Some(0.0), None, Some(0.0)]));
    assert_eq!(found[2].0.end, Target::Joints([None, None, Some(5.0), None, Some(9f64.to_radians()), None]));
}

#[test]
fn m128_holds_from_the_start_of_its_block_and_m129_to_the_end() {
    let (_, found) =
        moves_of("L X+1 B+10 F500 M128 F1000\nL X+2 B+11\nL X+3 B+12 M129\nL X+4 Y+0 Z+0 FMAX\nL X+5");
    let tcp: Vec<Tcp> = found.iter().map(|(_, s)| s.tcp).collect();
    assert_eq!(tcp, [Tcp::Axes, Tcp::Axes, Tcp::Axes, Tcp::Off, Tcp::Off]);
    // The feed after M128 is that of the compensating moves.
    assert_eq!(found[1].1.speed, Speed::PerMinute(500.0 / 60.0));
    assert_eq!(found[4].1.speed, Speed::PerMinute(500.0 / 60.0));
    // Where the axes stand turned, positions of the axes are none of the tip.
    let text = "L B+10 FMAX\nL X+1 F90 M128";
    let head = "BEGIN PGM A MM\nCYCL DEF 247 Q339=1\nTOOL CALL 4 Z\nL X0 Y0 Z9 FMAX\n";
    let error = try_read(&format!("{head}{text} F50\nM30\n")).unwrap_err();
    assert!(error.to_string().contains("has not set"), "{error}");
    // Where they do not, they are.
    let (_, found) = moves_of("M128\nL X+1\nM129");
    assert_eq!((found[0].0, found[0].1.tcp), (line_to(1.0, 0.0, 100.0), Tcp::Axes));
}

#[test]
fn tcpm_is_read_by_its_path() {
    let on = "FUNCTION TCPM F TCP AXIS POS PATHCTRL";
    let text = format!(
        "{on} AXIS REFPNT TIP-TIP F500\nL X1\nFUNCTION RESET TCPM\nL X2\n{on} VECTOR\nL X3\nM129\nL X4\nFUNCTION TCPM F CONT \
         AXIS POS PATHCTRL AXIS\nL X5\nM129"
    );
    let (_, found) = moves_of(&text);
    let tcp: Vec<Tcp> = found.iter().map(|(_, s)| s.tcp).collect();
    assert_eq!(tcp, [Tcp::Axes, Tcp::Off, Tcp::Vector, Tcp::Off, Tcp::Axes]);
    assert_eq!(found[4].1.speed, FEED);
}

#[test]
fn directions_of_the_tool_are_unit_vectors() {
    let (_, found) = moves_of(
        "M128\nLN X+1 Y+2 Z+3 NX+0 NY+0 NZ+1 TX+0.6 TY+0 TZ+0.8 F400\nLN X+2 Y+2 Z+3 TX-0.2637 TY+0.0078 TZ+0.9646\nLN X+3 \
         Y+2 Z+3 NX+0 NY+0 NZ+1\nM129",
    );
    let axis = |i: usize| match found[i].0.end {
        Target::Tip { axis, .. } => axis,
        _ => panic!(),
    };
    assert_eq!(point(&found[0].0), DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(axis(0), ToolAxis::Vector(DVec3::new(0.6, 0.0, 0.8)));
    let ToolAxis::Vector(v) = axis(1) else { panic!() };
    let long = DVec3::new(-0.2637, 0.0078, 0.9646);
    assert!((v.length() - 1.0).abs() < 1e-15 && v.cross(long).length() < 1e-15);
    assert_eq!(axis(2), ToolAxis::Rotary([None; 3]));
}

/// Spatial angles as rotations about the fixed axes, X first, by Rodrigues' formula.
fn spatial(a: f64, b: f64, c: f64) -> DMat3 {
    about(DVec3::Z, c) * about(DVec3::Y, b) * about(DVec3::X, a)
}

#[test]
fn planes_are_frames_at_the_shifted_datum() {
    let (program, found) = moves_of(
        "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X0\nCYCL DEF 7.2 Y55\nCYCL DEF 7.3 Z-25\nPLANE SPATIAL SPA90 SPB0 SPC180 \
         STAY SEQ- TABLE ROT\nL A+Q120 C+Q122 R0 FMAX M126\nL X-174.5 Y7 R0 F MAX\nL Z70 R0 F MAX\nPLANE SPATIAL SPA+10 \
         SPB-20 SPC+30 TURN F900 SYM+ COORD ROT\nL X1 Y2 Z3 FMAX\nL X2\nPLANE RESET TURN FMAX\nCYCL DEF 7.1 X0\nCYCL DEF \
         7.2 Y0\nCYCL DEF 7.3 Z0\nL X0 Y0 Z0 FMAX",
    );
    let ends: Vec<Target> = found.iter().map(|f| f.0.end).collect();
    assert_eq!((ends[0], found[0].1.speed), (Target::Orient, RAPID));
    let (motion, branch) = tilted(&program, &found[0].1);
    assert_eq!((motion.translation, branch), (DVec3::new(0.0, 55.0, -25.0), RotarySolution::Negative));
    assert!(same_rotation(&motion.rotation, &spatial(90.0, 0.0, 180.0), 1e-15));
    assert_eq!(
        program.frames[found[0].1.frame.0 as usize],
        Frame::Tilted { parent: FrameId(0), motion, branch }
    );
    let partly = point(&found[1].0);
    assert!(partly.truncate() == glam::DVec2::new(-174.5, 7.0) && partly.z.is_nan());
    assert_eq!(point(&found[2].0), DVec3::new(-174.5, 7.0, 70.0));
    // The turn's feed is its own.
    assert_eq!((ends[3], found[3].1.speed), (Target::Orient, Speed::PerMinute(15.0)));
    let (motion, branch) = tilted(&program, &found[3].1);
    assert_eq!((motion.translation, branch), (DVec3::new(0.0, 55.0, -25.0), RotarySolution::Positive));
    assert!(same_rotation(&motion.rotation, &spatial(10.0, -20.0, 30.0), 1e-15));
    assert_eq!(found[5].1.speed, FEED);
    assert_eq!(ends[6], Target::Orient);
    assert!(program.in_tilted(found[6].1.frame).is_none());
    assert_eq!(program.frames[found[7].1.frame.0 as usize], Frame::Work(WorkOffset::G54));
}

#[test]
fn a_plane_says_itself_in_several_ways() {
    for (words, wanted) in [
        (
            "EULER EULPR25 EULNU60 EULROT-40",
            about(DVec3::Z, 25.0) * about(DVec3::X, 60.0) * about(DVec3::Z, -40.0),
        ),
        ("VECTOR BX0.8 BY0 BZ-0.6 NX0.6 NY0 NZ0.8", about(DVec3::Y, 3f64.atan2(4.0).to_degrees())),
        ("VECTOR BX0 BY2 BZ0 NX1 NY0 NZ0", DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X)),
        ("RELATIV SPB-45", about(DVec3::Y, -45.0)),
    ] {
        let (program, found) = moves_of(&format!("PLANE {words} STAY\nL X0 Y0 Z0 FMAX"));
        let (motion, branch) = tilted(&program, &found[0].1);
        assert!(same_rotation(&motion.rotation, &wanted, 1e-14), "{words}: {motion:?}");
        assert_eq!(branch, RotarySolution::Free);
    }
    // One turn more about the axis of the plane in force.
    let (program, found) =
        moves_of("PLANE SPATIAL SPA30 SPB0 SPC0 STAY\nPLANE RELATIV SPC+20 STAY\nL X0 Y0 Z0 FMAX");
    let (motion, _) = tilted(&program, &found[0].1);
    assert!(same_rotation(&motion.rotation, &(about(DVec3::X, 30.0) * about(DVec3::Z, 20.0)), 1e-14));
}

#[test]
fn shifts_and_rotations_within_a_plane_count_in_it() {
    let (program, found) = moves_of(
        "PLANE SPATIAL SPA0 SPB90 SPC0 TURN FMAX\nCYCL DEF 7.1 X+10\nCYCL DEF 10.1 ROT+90\nL X5 Y0 Z2 FMAX\nCYCL DEF 10.1 \
         ROT+0\nCYCL DEF 7.1 X+0\nPLANE RESET STAY\nL X0 Y0 Z0 FMAX",
    );
    let (motion, _) = tilted(&program, &found[1].1);
    // (5, 0, 2), turned: (0, 5, 2); shifted: (10, 5, 2); X of the plane is -Z of the part, its Z the part's X.
    assert!((motion.point(point(&found[1].0)) - DVec3::new(2.0, 5.0, -10.0)).length() < 1e-14);
    assert_eq!(program.frames[found[2].1.frame.0 as usize], Frame::Work(WorkOffset::G54));
}

#[test]
fn taking_the_shift_back_before_the_plane_is_read_when_nothing_moves_between() {
    let (program, found) = moves_of(
        "CYCL DEF 7.1 X+10\nPLANE SPATIAL SPA0 SPB90 SPC0 TURN FMAX\nL X0 Y0 Z50 FMAX\nCYCL DEF 7.1 X0\nPLANE RESET \
         STAY\nL X0 Y0 Z0 FMAX\nTRANS DATUM AXIS X+5 Y+0 Z+0\nPLANE SPATIAL SPA0 SPB90 SPC0 TURN FMAX\nTRANS DATUM \
         RESET\nPLANE RESET STAY\nL X1 Y0 Z0 FMAX",
    );
    assert_eq!(program.frames[found[2].1.frame.0 as usize], Frame::Work(WorkOffset::G54));
    assert_eq!(tilted(&program, &found[3].1).0.translation, DVec3::new(5.0, 0.0, 0.0));
    assert_eq!(program.frames[found[4].1.frame.0 as usize], Frame::Work(WorkOffset::G54));
}

#[test]
fn rotary_axes_alone_turn_in_a_plane() {
    let (_, found) = moves_of("PLANE SPATIAL SPA0 SPB90 SPC0 STAY\nL B-90 C+0 R0 FMAX\nL X0 Y0 Z9 FMAX");
    let wanted = [None, None, None, None, Some((-90f64).to_radians()), Some(0.0)];
    assert_eq!((found[0].0.end, found[0].1.speed), (Target::Joints(wanted), RAPID));
}

#[test]
fn cycles_run_in_a_plane() {
    let text = "CYCL DEF 200 Q200=2 Q201=-10 Q206=150 Q202=10 Q210=0 Q203=+0 Q204=5 Q211=0\nPLANE SPATIAL SPA0 SPB90 SPC0 \
                TURN FMAX\nL X3 Y4 Z50 FMAX\nL Z5 FMAX M99\nL X13 FMAX M99\nPLANE RESET STAY";
    let (program, _) = moves_of(text);
    let cycles: Vec<_> = (0..program.items.len())
        .filter_map(|i| match program.items.get(i) {
            Item::Cycle(cycle, _) => Some((*cycle, program.state(i))),
            _ => None,
        })
        .collect();
    assert_eq!(cycles.len(), 2);
    assert!(cycles.iter().all(|(c, s)| *c == drill() && program.in_tilted(s.frame).is_some()));
}
