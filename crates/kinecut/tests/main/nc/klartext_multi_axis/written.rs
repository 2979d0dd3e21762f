//! Texts by hand.

use super::*;

#[test]
fn rotary_axes_are_named_where_they_change() {
    let mut b = Builder::new();
    b.tip(10.0, 0.0, 50.0, degrees([Some(0.0), None, Some(0.0)]), RAPID);
    b.tip(10.0, 5.0, 50.0, degrees([Some(-30.0), None, Some(0.0)]), FEED);
    b.tip(10.0, 5.0, 50.0, degrees([None, None, Some(370.125)]), FEED);
    // Nothing changes.
    b.tip(10.0, 5.0, 50.0, degrees([Some(-30.0), None, None]), FEED);
    b.tip(11.0, 5.0, 50.0, degrees([None; 3]), FEED);
    b.program.push_tool(ToolNumber(5), Some(1), Some(1), &b.state, Origin::default());
    // After a tool change it is not taken for granted where an axis stands.
    b.tip(0.0, 0.0, 50.0, degrees([Some(-30.0), None, Some(370.125)]), RAPID);
    let blocks = b.blocks();
    let wanted = [
        "CYCL DEF 32.0 TOLERANCE",
        "CYCL DEF 32.1",
        "CYCL DEF 247 DATUM SETTING ~",
        "    Q339=+1 ;DATUM NUMBER",
        "L X+10 Y+0 Z+50 A+0 C+0 R0 FMAX",
        "L Y+5 A-30 F600",
        "L C+370.125",
        "L X+11",
        "TOOL CALL 5 Z",
        "CYCL DEF 247 DATUM SETTING ~",
        "    Q339=+1 ;DATUM NUMBER",
        "L X+0 Y+0 Z+50 A-30 C+370.125 R0 FMAX",
        "M30",
        "END PGM PROGRAM MM",
    ];
    assert_eq!(blocks, wanted);
}

#[test]
fn the_tool_centre_point_is_controlled_between_m128_and_m129() {
    let mut b = Builder::new();
    b.line(0.0, 0.0, 50.0, RAPID);
    b.state.tcp = Tcp::Axes;
    b.tip(0.0, 0.0, 10.0, degrees([Some(10.0), None, Some(20.0)]), RAPID);
    b.tip(5.0, 0.0, 10.0, degrees([Some(11.0), None, Some(20.0)]), FEED);
    b.tip(5.0, 0.0, 10.0, ToolAxis::Vector(DVec3::new(0.6, 0.0, 0.8)), FEED);
    b.state.tcp = Tcp::Off;
    b.to(Target::Joints([None, None, Some(-10.0), None, None, None]), RAPID);
    b.to(Target::Joints([None, None, None, Some(0.0), None, Some(0.0)]), RAPID);
    b.line(0.0, 0.0, 50.0, RAPID);
    b.state.tcp = Tcp::Vector;
    b.tip(1.0, 0.0, 40.0, ToolAxis::Vector(DVec3::new(0.0, -0.28, 0.96)), RAPID);
    let blocks = b.blocks();
    let wanted = [
        "L X+0 Y+0 Z+50 R0 FMAX",
        "M128",
        "L X+0 Y+0 Z+10 A+10 C+20 R0 FMAX",
        "L X+5 A+11 F600",
        "LN X+5 Y+0 Z+10 TX+0.6 TY+0 TZ+0.8",
        "M129",
        "L Z-10 R0 FMAX M91",
        "L A+0 C+0 R0 FMAX M91",
        "L X+0 Y+0 Z+50 R0 FMAX",
        "FUNCTION TCPM F TCP AXIS POS PATHCTRL VECTOR",
        "LN X+1 Y+0 Z+40 TX+0 TY-0.28 TZ+0.96 R0 FMAX",
        "FUNCTION RESET TCPM",
        "M30",
        "END PGM PROGRAM MM",
    ];
    assert_eq!(blocks[4..], wanted);
}

#[test]
fn a_tilted_plane_is_a_shift_and_three_spatial_angles() {
    let mut b = Builder::new();
    b.line(0.0, 0.0, 100.0, RAPID);
    b.to(Target::Joints([None, None, Some(-1.0), None, None, None]), RAPID);
    // The front: its X is that of the part, its Y is up.
    b.tilt(about(DVec3::X, 90.0), DVec3::new(0.0, -55.0, -25.0), RotarySolution::Negative);
    b.to(Target::Orient, RAPID);
    b.line(10.0, 20.0, 50.0, RAPID);
    b.line(10.0, 20.0, 5.0, RAPID);
    b.state.speed = FEED;
    b.program.push_cycle(drill(), &b.state, Origin::default()).unwrap();
    b.line(10.0, 20.0, -3.0, FEED);
    b.to(Target::Joints([None, None, Some(-1.0), None, None, None]), RAPID);
    // The same plane once more, without a turn of the axes.
    b.line(0.0, 0.0, 60.0, RAPID);
    b.work();
    b.to(Target::Orient, RAPID);
    b.line(0.0, 0.0, 100.0, RAPID);
    let wanted = [
        "L X+0 Y+0 Z+100 R0 FMAX",
        "L Z-1 R0 FMAX M91",
        "CYCL DEF 7.0 DATUM SHIFT",
        "CYCL DEF 7.1 X+0",
        "CYCL DEF 7.2 Y-55",
        "CYCL DEF 7.3 Z-25",
        "PLANE SPATIAL SPA+90 SPB+0 SPC+0 TURN FMAX SEQ- TABLE ROT",
        "L X+10 Y+20 Z+50 R0 FMAX",
        "L Z+5 R0 FMAX",
        "CYCL DEF 200 DRILLING ~",
        "    Q200=+2 ;SET-UP CLEARANCE ~",
        "    Q201=-10 ;DEPTH ~",
        "    Q206=+600 ;FEED RATE FOR PLNGNG ~",
        "    Q202=+10 ;PLUNGING DEPTH ~",
        "    Q210=+0 ;DWELL TIME AT TOP ~",
        "    Q203=+0 ;SURFACE COORDINATE ~",
        "    Q204=+5 ;2ND SET-UP CLEARANCE ~",
        "    Q211=+0 ;DWELL TIME AT DEPTH",
        "CYCL CALL",
        "L Z-3 F600",
        "PLANE RESET STAY",
        "CYCL DEF 7.0 DATUM SHIFT",
        "CYCL DEF 7.1 X+0",
        "CYCL DEF 7.2 Y+0",
        "CYCL DEF 7.3 Z+0",
        "L Z-1 R0 FMAX M91",
        "CYCL DEF 7.0 DATUM SHIFT",
        "CYCL DEF 7.1 X+0",
        "CYCL DEF 7.2 Y-55",
        "CYCL DEF 7.3 Z-25",
        "PLANE SPATIAL SPA+90 SPB+0 SPC+0 STAY SEQ- TABLE ROT",
        "L X+0 Y+0 Z+60 R0 FMAX",
        "PLANE RESET TURN FMAX",
        "CYCL DEF 7.0 DATUM SHIFT",
        "CYCL DEF 7.1 X+0",
        "CYCL DEF 7.2 Y+0",
        "CYCL DEF 7.3 Z+0",
        "L X+0 Y+0 Z+100 R0 FMAX",
        "M30",
        "END PGM PROGRAM MM",
    ];
    assert_eq!(b.blocks()[4..], wanted);
}

#[test]
fn from_plane_to_plane_and_to_the_tool_change() {
    let mut b = Builder::new();
    b.tilt(about(DVec3::Y, 90.0), DVec3::ZERO, RotarySolution::Positive);
    b.to(Target::Orient, FEED);
    b.line(0.0, 0.0, 50.0, RAPID);
    b.tilt(about(DVec3::Y, -90.0), DVec3::ZERO, RotarySolution::Free);
    b.to(Target::Orient, RAPID);
    b.line(0.0, 0.0, 50.0, RAPID);
    // Within the plane nothing is said again, and orienting twice is.
    b.to(Target::Orient, RAPID);
    b.program.push_tool(ToolNumber(5), Some(1), Some(1), &b.state, Origin::default());
    b.work();
    b.state.tcp = Tcp::Axes;
    b.tip(0.0, 0.0, 90.0, degrees([None, Some(-90.0), None]), RAPID);
    let wanted = [
        "PLANE SPATIAL SPA+0 SPB+90 SPC+0 TURN F600 SEQ+ TABLE ROT",
        "L X+0 Y+0 Z+50 R0 FMAX",
        "PLANE RESET STAY",
        "PLANE SPATIAL SPA+0 SPB-90 SPC+0 TURN FMAX TABLE ROT",
        "L X+0 Y+0 Z+50 R0 FMAX",
        "PLANE SPATIAL SPA+0 SPB-90 SPC+0 TURN FMAX TABLE ROT",
        "PLANE RESET STAY",
        "TOOL CALL 5 Z",
        "CYCL DEF 247 DATUM SETTING ~",
        "    Q339=+1 ;DATUM NUMBER",
        "M128",
        "L X+0 Y+0 Z+90 B-90 R0 FMAX",
        "M129",
        "M30",
        "END PGM PROGRAM MM",
    ];
    assert_eq!(b.blocks()[4..], wanted);
}

#[test]
fn a_shift_within_a_plane_is_the_plane_moved() {
    let mut b = Builder::new();
    let parent = b.tilt(about(DVec3::X, -90.0), DVec3::new(1.0, 2.0, 3.0), RotarySolution::Free);
    let motion = Rigid { rotation: about(DVec3::Z, 90.0), translation: DVec3::new(10.0, 20.0, 0.5) };
    b.state.frame = b.program.add_frame(Frame::Shift { parent, motion });
    b.to(Target::Orient, RAPID);
    b.line(4.0, 0.0, 0.0, RAPID);
    let blocks = b.blocks();
    // Y of the plane points to -Z of the part, its Z to +Y.
    assert_eq!(blocks[5..8], ["CYCL DEF 7.1 X+11", "CYCL DEF 7.2 Y+2.5", "CYCL DEF 7.3 Z-17"]);
    // X of the shifted coordinates is the plane's Y, their Y is the opposite of its X.
    let found = read_text(&b.post().unwrap().text).program;
    let (_, state) = moves(&found)[1];
    let (motion, _) = tilted(&found, &state);
    assert!((motion.rotation * DVec3::X - DVec3::NEG_Z).length() < 1e-12, "{blocks:?}");
    assert!((motion.rotation * DVec3::Y - DVec3::NEG_X).length() < 1e-12, "{blocks:?}");
    assert!((motion.point(DVec3::new(4.0, 0.0, 0.0)) - DVec3::new(11.0, 2.5, -21.0)).length() < 1e-12);
}

#[test]
fn a_time_becomes_the_feed_of_the_tip() {
    let mut b = Builder::new();
    b.state.tcp = Tcp::Axes;
    b.tip(0.0, 0.0, 10.0, degrees([Some(0.0), None, None]), RAPID);
    // 5 mm in half a second.
    b.tip(3.0, 4.0, 10.0, degrees([Some(20.0), None, None]), Speed::Duration(0.5));
    let blocks = b.blocks();
    assert_eq!(blocks[blocks.len() - 4], "L X+3 Y+4 A+20 F600");
}

#[test]
fn the_raw_part_is_drawn_although_the_first_move_is_in_a_plane() {
    let mut b = Builder::new();
    b.tilt(about(DVec3::X, 90.0), DVec3::ZERO, RotarySolution::Free);
    b.to(Target::Orient, RAPID);
    b.line(0.0, 0.0, 50.0, RAPID);
    let stock = kinecut::geom::Solid::Box(kinecut::geom::Aabb {
        min: DVec3::ZERO,
        max: DVec3::new(10.0, 20.0, 30.0),
    });
    b.program.setups.push(kinecut::program::Setup {
        name: "1".to_owned(),
        part_on_table: Rigid::IDENTITY,
        work_offsets: [(WorkOffset::G54, Rigid::from_translation(DVec3::X))].into(),
        located: false,
        stock: Some(stock),
        fixtures: Vec::new(),
    });
    let text = b.post().unwrap().text;
    assert!(text.contains("BLK FORM 0.1 Z X-1 Y+0 Z+0\nBLK FORM 0.2 X+9 Y+20 Z+30\n"), "{text}");
}
