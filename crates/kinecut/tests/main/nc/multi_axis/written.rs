//! Texts as a hand would write them.

use super::*;

/// Mill of a table-table machine A C: indexed, in a tilted plane, and with the tip controlled.
#[test]
fn fanuc_tilted_plane_and_tip() {
    let mut b = Builder::new(Control::Fanuc, 2);
    let work = b.state.frame;
    let both = |a: f64, c: f64| rotary(Some(a), None, Some(c));
    b.to(f64::NAN, f64::NAN, f64::NAN, both(30.0, 0.0), RAPID);
    let frame = b.tilted(euler(0.0, 30.0, 0.0), DVec3::new(10.0, -5.5, 0.0), RotarySolution::Free);
    b.orient(frame);
    b.to(51.289, -18.553, f64::NAN, ToolAxis::Fixed, RAPID);
    b.to(51.289, -18.553, 5.0, ToolAxis::Fixed, RAPID);
    b.to(51.289, -18.553, -2.0, ToolAxis::Fixed, Speed::PerMinute(5.0));
    b.to(40.0, -18.553, -2.0, ToolAxis::Fixed, Speed::PerMinute(5.0));
    b.go(
        Target::Tip { point: DVec3::new(40.0, 1.447, -2.0), axis: ToolAxis::Fixed },
        Path::Arc { centre: DVec3::new(40.0, -8.553, -2.0), axis: DVec3::Z, sweep: TAU / 2.0, rise: 0.0 },
        Speed::PerMinute(5.0),
    );
    b.state.frame = work;
    b.state.tcp = Tcp::Axes;
    b.to(51.289, -29.817, 14.539, both(30.0, 0.0), RAPID);
    b.to(50.0, -20.0, -2.0, both(25.5, 0.0), Speed::PerMinute(20.0));
    b.to(49.0, -20.0, -2.0, both(25.5, -12.25), Speed::PerMinute(20.0));
    b.state.tcp = Tcp::Off;
    b.to(0.0, 0.0, 100.0, both(0.0, 0.0), RAPID);
    b.go(Target::Joints([Some(0.0), None, Some(0.0), Some(0.0), None, Some(0.0)]), Path::Line, RAPID);
    let text = "\
T2 M6
G64
G54
S1000 M3
G0 A30. C0.
G68.2 X10. Y-5.5 Z0. I0. J30. K0.
G0
G53.1
G0 X51.289 Y-18.553
G43 H2 G0 Z5.
G1 Z-2. F300.
X40.
G3 X40. Y1.447 I0. J10.
G69
G43.4 H2
G0 X51.289 Y-29.817 Z14.539 A30. C0.
G1 X50. Y-20. Z-2. A25.5 F1200.
X49. C-12.25
G49
G43 H2 G0 X0. Y0. Z100. A0. C0.
G53 G0 X0. Z0. A0. C0.
M5
M30
";
    assert_eq!(b.blocks(), text);
}

#[test]
fn fanuc_tool_axis_as_a_vector() {
    let mut b = Builder::new(Control::Fanuc, 1);
    b.state.tcp = Tcp::Axes;
    b.to(0.0, 0.0, 50.0, ToolAxis::Vector(DVec3::Z), RAPID);
    b.to(10.0, 0.0, 0.0, ToolAxis::Vector(DVec3::new(0.6, 0.0, 0.8)), Speed::PerMinute(10.0));
    b.to(20.0, 0.0, 0.0, ToolAxis::Rotary([None; 3]), Speed::PerMinute(10.0));
    b.to(20.0, 0.0, 9.0, rotary(None, Some(10.0), Some(0.0)), RAPID);
    let text = "\
T1 M6
G64
G54
S1000 M3
G43.5 H1
G0 X0. Y0. Z50. I0. J0. K1.
G1 X10. Z0. I0.6 J0. K0.8 F600.
X20.
G49
G43.4 H1
G0 X20. Y0. Z9. B10. C0.
G49
M5
M30
";
    assert_eq!(b.blocks(), text);
}

#[test]
fn sinumerik_orientations() {
    let mut b = Builder::new(Control::Sinumerik840d, 7);
    b.state.tcp = Tcp::Vector;
    b.to(10.0, 0.0, 5.0, ToolAxis::Vector(DVec3::Z), RAPID);
    b.to(10.0, 0.0, 0.0, ToolAxis::Vector(DVec3::new(0.0, -0.28, 0.96)), Speed::PerMinute(5.0));
    b.state.tcp = Tcp::Axes;
    b.to(0.0, 10.0, 0.0, rotary(Some(20.0), None, Some(90.125)), Speed::PerMinute(5.0));
    b.go(
        Target::Tip { point: DVec3::new(-10.0, 0.0, 0.0), axis: rotary(Some(20.0), None, Some(180.0)) },
        Path::Arc { centre: DVec3::ZERO, axis: DVec3::Z, sweep: TAU / 4.0, rise: 0.0 },
        Speed::PerMinute(5.0),
    );
    b.state.tcp = Tcp::Off;
    b.to(0.0, 0.0, 100.0, rotary(Some(0.0), None, Some(0.0)), RAPID);
    b.to(1.0, 0.0, 100.0, ToolAxis::Fixed, RAPID);
    let text = "\
T7 M6
D1
G64
G54
S1000 M3
TRAORI
ORIVECT
G0 X10 Y0 Z5 A3=0 B3=0 C3=1
G1 Z0 A3=0 B3=-0.28 C3=0.96 F300
ORIAXES
X0 Y10 A=20 C=90.125
G3 X-10 Y0 C=180 I0 J-10
TRAFOOF
G0 X0 Y0 Z100 A=0 C=0
G0 X1
M5
M30
";
    assert_eq!(b.blocks(), text);
}

#[test]
fn sinumerik_cycle800() {
    let mut b = Builder::new(Control::Sinumerik840d, 1);
    let work = b.state.frame;
    // X by -15 deg, then about the new Y by 20 deg.
    let rotation = turned(&[(DVec3::X, -15.0), (DVec3::Y, 20.0)]);
    let frame = b.tilted(rotation, DVec3::new(0.0, 1.25, 50.0), RotarySolution::Positive);
    b.orient(frame);
    b.to(0.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
    b.to(0.0, 0.0, -1.0, ToolAxis::Fixed, Speed::PerMinute(5.0));
    // Withdrawn in machine coordinates, and on in the same plane: the rotary axes have not moved.
    b.go(Target::Joints([None, None, Some(0.0), None, None, None]), Path::Line, RAPID);
    b.to(9.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
    b.state.frame = work;
    b.to(0.0, 0.0, 100.0, rotary(None, Some(0.0), Some(0.0)), RAPID);
    let text = "\
T1 M6
D1
G64
G54
S1000 M3
CYCLE800(0,\"\",0,57,0,1.25,50,-15,20,0,0,0,0,1)
G0 X0 Y0 Z5
G1 Z-1 F300
CYCLE800()
G0 SUPA Z0 D0
D1
CYCLE800(0,\"\",0,57,0,1.25,50,-15,20,0,0,0,0,0)
G0 X9 Y0 Z5
CYCLE800()
G0 X0 Y0 Z100 B=0 C=0
M5
M30
";
    assert_eq!(b.blocks(), text);
}

/// Positions of the axes with the time of each block, as LinuxCNC takes them.
#[test]
fn linuxcnc_positions_of_axes_in_inverse_time() {
    let mut b = Builder::new(Control::LinuxCnc, 3);
    b.to(0.0, 0.0, 50.0, rotary(Some(-71.841), None, Some(-35.93)), RAPID);
    b.to(1.0, 2.0, 3.0, rotary(Some(-71.266), None, Some(-32.919)), Speed::Duration(0.5));
    b.to(1.0, 2.0, 3.0, rotary(None, None, Some(-30.0)), Speed::Duration(0.25));
    b.to(1.0, 2.0, 9.0, ToolAxis::Rotary([None; 3]), Speed::PerMinute(10.0));
    b.go(Target::Joints([None, None, Some(0.0), Some(0.0), None, Some(0.0)]), Path::Line, RAPID);
    b.to(5.0, 2.0, 9.0, ToolAxis::Fixed, RAPID);
    let text = "\
T3 M6
G43 H3
G64
G54
S1000 M3
G0 X0 Y0 Z50 A-71.841 C-35.93
G93 G1 X1 Y2 Z3 A-71.266 C-32.919 F120
C-30 F240
G94 Z9 F600
G53 G0 Z0 A0 C0
G0 X5 Z9
M5
M2
";
    assert_eq!(b.blocks(), text);
}

/// Where FANUC turns along a plane that is said again after a retract, G53.1 is not.
#[test]
fn choices_of_a_plane_and_its_return() {
    let mut b = Builder::new(Control::Fanuc, 1);
    for (branch, word) in [(RotarySolution::Positive, "G53.1 P1"), (RotarySolution::Negative, "G53.1 P2")] {
        let frame = b.tilted(euler(90.0, 45.0, 0.0), DVec3::ZERO, branch);
        b.orient(frame);
        b.to(0.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
        let text = b.blocks();
        assert!(text.contains(&format!("G68.2 X0. Y0. Z0. I90. J45. K0.\nG0\n{word}\n")), "{text}");
    }
    let before = b.blocks().matches("G53.1").count();
    b.go(Target::Joints([None, None, Some(0.0), None, None, None]), Path::Line, RAPID);
    b.to(9.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
    let text = b.blocks();
    assert_eq!(text.matches("G53.1").count(), before);
    assert!(
        text.contains("G69\nG53 G0 Z0.\nG68.2 X0. Y0. Z0. I90. J45. K0.\nG43 H1 G0 X9. Y0. Z5.\n"),
        "{text}"
    );
}

#[test]
fn what_cannot_be_said_is_refused_with_its_item() {
    let wants = |b: &Builder, words: &str| {
        let (message, item) = b.refused();
        assert!(message.contains(words), "{message}");
        assert!(item.is_some(), "{message}");
    };
    for control in [Control::Fanuc, Control::Sinumerik840d] {
        let mut b = Builder::new(control, 1);
        let frame = b.tilted(euler(0.0, 30.0, 0.0), DVec3::ZERO, RotarySolution::Positive);
        b.state.frame = frame;
        b.to(0.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
        wants(&b, "along which the tool does not stand");

        // A rotary axis has moved since.
        let mut b = Builder::new(control, 1);
        let work = b.state.frame;
        let frame = b.tilted(euler(0.0, 30.0, 0.0), DVec3::ZERO, RotarySolution::Positive);
        b.orient(frame);
        b.to(0.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
        b.state.frame = work;
        b.to(0.0, 0.0, 5.0, rotary(Some(30.0), None, Some(0.0)), RAPID);
        b.state.frame = frame;
        b.to(0.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
        wants(&b, "along which the tool does not stand");

        let mut b = Builder::new(control, 1);
        b.to(0.0, 0.0, 5.0, rotary(Some(30.0), None, Some(0.0)), RAPID);
        b.to(1.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
        wants(&b, "while the rotary axes stand elsewhere");

        let mut b = Builder::new(control, 1);
        b.to(0.0, 0.0, 5.0, ToolAxis::Vector(DVec3::X), RAPID);
        wants(&b, "without control of the tool centre point");

        let mut b = Builder::new(control, 1);
        b.state.tcp = Tcp::Axes;
        b.to(0.0, 0.0, 5.0, ToolAxis::Vector(DVec3::X * 1.1), RAPID);
        wants(&b, "no unit vector");

        let mut b = Builder::new(control, 1);
        b.to(0.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
        b.state.tcp = Tcp::Axes;
        b.state.comp = kinecut::program::Comp::Left(1);
        b.to(9.0, 0.0, 5.0, ToolAxis::Fixed, Speed::PerMinute(5.0));
        wants(&b, "cutter compensation under control of the tool centre point");

        let mut b = Builder::new(control, 1);
        let frame = b.tilted(euler(0.0, 30.0, 0.0), DVec3::ZERO, RotarySolution::Positive);
        b.orient(frame);
        b.to(0.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
        b.state.tcp = Tcp::Axes;
        b.to(9.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
        wants(&b, "in a tilted plane");

        let mut b = Builder::new(control, 1);
        let frame = b.tilted(euler(0.0, 30.0, 0.0) * 1.1, DVec3::ZERO, RotarySolution::Positive);
        b.orient(frame);
        assert!(b.refused().0.contains("no rotation"));
    }
    let mut b = Builder::new(Control::Fanuc, 1);
    b.state.tcp = Tcp::Vector;
    b.to(0.0, 0.0, 5.0, ToolAxis::Vector(DVec3::X), RAPID);
    wants(&b, "does not turn the tool axis in a plane");

    for control in [Control::LinuxCnc, Control::Grbl] {
        let mut b = Builder::new(control, 1);
        let frame = b.tilted(euler(0.0, 30.0, 0.0), DVec3::ZERO, RotarySolution::Positive);
        b.orient(frame);
        wants(&b, "no words for a tilted plane");
        wants(&b, "post to positions of the machine's axes");
        let mut b = Builder::new(control, 1);
        b.state.tcp = Tcp::Axes;
        b.to(0.0, 0.0, 5.0, ToolAxis::Fixed, RAPID);
        wants(&b, "no words for control of the tool centre point");
    }
    let mut b = Builder::new(Control::Grbl, 1);
    b.to(0.0, 0.0, 5.0, rotary(Some(1.0), None, None), RAPID);
    wants(&b, "no rotary axes");
}

/// Half a tick of an angle at 300 mm: what the rounding moves is told.
#[test]
fn rounding_of_angles_is_noted() {
    let mut b = Builder::new(Control::Fanuc, 1);
    let frame = b.tilted(euler(0.0, 30.0004, 0.0), DVec3::ZERO, RotarySolution::Free);
    b.orient(frame);
    b.to(0.0, 300.0, 5.0, ToolAxis::Fixed, RAPID);
    let tilt = b.post().notes.tilt;
    assert!((tilt - 300.0 * 0.0004f64.to_radians()).abs() < 1e-9, "{tilt}");
}
