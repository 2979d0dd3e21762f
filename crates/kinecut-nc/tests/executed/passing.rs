//! Segments that are handed over while a program is followed are those that are kept otherwise.

use kinecut_nc::base::Sources;
use kinecut_nc::geom::Rigid;
use kinecut_nc::nc::{self, Control};
use kinecut_nc::program::{Setup, WorkOffset};
use kinecut_nc::trace::{CompStart, RegisterState, Segment, TraceOptions, trace, trace_passing};

fn setup() -> Setup {
    Setup {
        name: "setup 1".to_owned(),
        part_on_table: Rigid::from_translation(glam::DVec3::new(1.0, 2.0, 3.0)),
        work_offsets: [(WorkOffset::G54, Rigid::IDENTITY)].into(),
        located: false,
        stock: None,
        fixtures: Vec::new(),
    }
}

#[test]
fn what_is_handed_over_is_what_is_kept() {
    // Rapids with their other ways, waits, a contour under compensation longer than what is handed over together.
    let mut text = "G21 G17 G90 G94 G54 G64\nG0 X0 Y0 Z5\nG1 Z-1 F300\n".to_owned();
    let zigzag = |i: u32| format!("X{} Y{}.5\n", i, i % 13 * 7);
    text.extend((0..700).map(zigzag));
    text.extend((0..40).map(|i| format!("G0 X{} Y{} Z{}\nG4 P0.5\n", i % 3, i % 5, i % 2)));
    text += "G0 X0 Y0\nG1 G41 D1 X10 Y0\nG4 P1\n";
    text.extend((1..400).map(|i| format!("G1 X{}\n", 10 + i)));
    text += "G4 P2\nG1 G40 Y-9\nG4 P3\nM2\n";
    let read = nc::read(&mut Sources::default(), "a.ngc", &text, Control::LinuxCnc, &[setup()]).unwrap();
    let options = TraceOptions {
        machine: None,
        tools: &[],
        retract_height: 0.0,
        radii: &[(1, 2.0)],
        operator: RegisterState::default(),
        comp_start: CompStart::default(),
        chord: 1e-3,
    };
    let kept = trace(&read.program, &options).unwrap();
    let (mut segments, mut most) = (Vec::new(), 0);
    let passed = trace_passing(&read.program, &options, &mut |some: &[Segment]| {
        segments.extend_from_slice(some);
        most = most.max(some.len());
    })
    .unwrap();
    assert_eq!(segments, kept.segments);
    assert!(segments.len() > 1100 && most < 2 * 256 + 400 && passed.segments.is_empty());
    assert_eq!(passed.stands, kept.stands);
    assert_eq!((passed.assumed, passed.dwells), (kept.assumed, kept.dwells));
    assert_eq!(passed.untraced, kept.untraced);
}

#[test]
fn the_zero_of_another_offset_moves_no_tool() {
    let mut setup = setup();
    let g55 = WorkOffset::from_tenths(550).unwrap();
    setup.work_offsets.insert(g55, Rigid::from_translation(glam::DVec3::new(-100.0, 0.0, 0.0)));
    let text = "G21 G54 G64\nG0 X0 Y0 Z5\nG10 L20 P2 X100 Y0 Z5\nG1 X10 F300\nM2\n";
    let read = nc::read(&mut Sources::default(), "a.ngc", text, Control::LinuxCnc, &[setup]).unwrap();
    let options = TraceOptions {
        machine: None,
        tools: &[],
        retract_height: 0.0,
        radii: &[],
        operator: RegisterState::default(),
        comp_start: CompStart::default(),
        chord: 1e-3,
    };
    let segments = trace(&read.program, &options).unwrap().segments;
    let feed = segments.last().unwrap();
    let way = feed.curve.end() - feed.curve.start();
    assert_eq!(way.to_array(), [10.0, 0.0, 0.0]);
}
