//! Rounded and chamfered corners of FANUC and Haas: `,R`, `,C`.
//!
//! Expected values are worked out by hand: a rounding `r` between two lines that turn by an angle `t` touches them `r tan(t/2)` from
//! the corner, a chamfer `c` begins and ends `c` from it.

use crate::{moves, read, refused, run};
use kinecut_nc::nc::Control::{Fanuc, Haas, LinuxCnc};
use kinecut_nc::program::{Item, Path, Speed};

#[test]
fn corners_between_lines_are_rounded_and_chamfered() {
    let body = "G1 X20. ,R5. F100.\nY10. ,C2.\nX0.\nY0.";
    for control in [Fanuc, Haas] {
        assert_eq!(
            run(body, control),
            ["F 15 0 0", "F 20 5 0 arc", "F 20 8 0", "F 18 10 0", "F 0 10 0", "F 0 0 0"],
            "{control}"
        );
    }
    let reading = read(&format!("G21 G54 G0 X0. Y0. Z0.\n{body}\nM30\n"), Fanuc).unwrap();
    let Item::Move(motion) = reading.program.items.get(2) else { panic!() };
    let Path::Arc { centre, sweep, .. } = motion.path else { panic!() };
    assert_eq!([centre.x, centre.y], [15.0, 5.0]);
    assert!((sweep - 0.5 * std::f64::consts::PI).abs() < 1e-12);
    // Of its own block, as the place in the text.
    assert_eq!(reading.program.items.origin(1), reading.program.items.origin(2));
}

#[test]
fn a_corner_counts_from_where_it_would_be() {
    // The increment goes on from the corner (20, 0), not from the end of the rounding.
    assert_eq!(
        run("G91 G1 X20. ,R5. F100.\nY10.\nX-20.", Fanuc),
        ["F 15 0 0", "F 20 5 0 arc", "F 20 10 0", "F 0 10 0"]
    );
    // Turned by 60 degrees to the left: 3 tan 30.
    let tangent = 3.0 / 3.0f64.sqrt();
    let done = run("G1 X10. ,R3. F100.\nG91 X5. Y8.660254", Fanuc);
    let number = |v: f64| ((v * 1e4).round() / 1e4).to_string();
    assert_eq!(done[0], format!("F {} 0 0", number(10.0 - tangent)));
    let (x, y) = (10.0 + 0.5 * tangent, 0.75f64.sqrt() * tangent);
    assert_eq!(done[1], format!("F {} {} 0 arc", number(x), number(y)));
}

#[test]
fn corners_are_in_the_plane_in_force() {
    assert_eq!(run("G18 G1 X20. ,R5. F100.\nZ-10.", Fanuc), ["F 15 0 0", "F 20 0 -5 arc", "F 20 0 -10"]);
    assert!(refused("G1 X20. ,R5. F100.\nZ-10.", Fanuc).contains("do not stay in the plane"));
    assert!(refused("G1 X20. Z-1. ,R5. F100.\nY10.", Fanuc).contains("do not stay in the plane"));
}

#[test]
fn a_line_and_an_arc_are_rounded_on_fanuc() {
    // To the left inside the circle r 10 about (0, 0): the centre of r 2 is 8 from it and 2 above the line.
    let body = "G1 X10. ,R2. F100.\nG3 X-10. I-10.";
    let done = run(body, Fanuc);
    assert_eq!(done, ["F 7.746 0 0", "F 9.6825 2.5 0 arc", "F -10 0 0 arc"]);
    assert!(refused(body, Haas).contains("between straight moves only"));
    let text = "G21 G54 G0 X0. Y0. Z0.\nG1 X10. ,C10. F100.\nG3 X-10. I-10.\nM30\n";
    let notes = read(text, Fanuc).unwrap().findings;
    assert!(notes.iter().any(|f| f.message.contains("along the chord")), "{notes:?}");
    // The chord of the chamfer is 10: an angle of sixty degrees of that circle.
    assert_eq!(
        run("G1 X10. ,C10. F100.\nG3 X-10. I-10.", Fanuc),
        ["F 0 0 0", "F 5 8.6603 0", "F -10 0 0 arc"]
    );
}

#[test]
fn a_dwell_and_comments_may_stand_between() {
    let text = "G21 G54 G0 X0. Y0. Z0.\nG1 X20. ,R5. F100.\n(A)\nG4 P500\n#1=5.\nY10.\nM30\n";
    let reading = read(text, Fanuc).unwrap();
    let shown = moves(&reading);
    assert_eq!(shown, ["R 0 0 0", "F 15 0 0", "F 20 5 0 arc", "F 20 10 0"]);
    let items = &reading.program.items;
    let place = |of: &dyn Fn(Item<'_>) -> bool| (0..items.len()).position(|i| of(items.get(i))).unwrap();
    let dwell = place(&|item| item == Item::Dwell(0.5));
    let arc = place(&|item| matches!(item, Item::Move(m) if matches!(m.path, Path::Arc { .. })));
    assert!(dwell > arc);
    assert!(matches!(reading.program.state(arc).speed, Speed::PerMinute(_)));
}

#[test]
fn a_corner_that_cannot_be_made_is_an_error_at_its_word() {
    let said = |body: &str, part: &str| {
        let error = refused(body, Fanuc);
        assert!(error.starts_with("a.nc:2:") && error.contains(",R5.") && error.contains(part), "{error}");
    };
    said("G1 X4. ,R5. F100.\nY10.", "too short");
    said("G1 X10. ,R5. F100.\nY4.", "too short");
    said("G1 X10. ,R5. F100.\nX0.", "too short");
    said("G1 X10. ,R5. F100.\nG0 Y10.", "no move by G1");
    said("G1 X10. ,R5. F100.\nM8\nY10.", "no move by G1");
    said("G1 X10. ,R5. F100.\nG4 P5\nG4 P5\nY10.", "no move by G1");
    said("G1 X10. ,R5. F100.\nG18 X5.", "no move by G1");
    said("G1 X10. ,R5. F100.", "no move by G1");
    said("G0 X10. ,R5.\nG1 Y10. F100.", "no move by G1");
    assert!(refused("G1 X10. ,R5. ,C5. F100.\nY10.", Fanuc).contains("twice"));
    assert!(refused("G1 X10. ,R0. F100.\nY10.", Fanuc).contains("positive"));
    assert!(refused("G1 X10 ,R5 F100\nY10", LinuxCnc).contains("no meaning"));
}

#[test]
fn a_corner_without_a_point_counts_increments() {
    assert_eq!(run("G1 X20. ,R5000 F100.\nY10.", Fanuc)[0], "F 15 0 0");
    assert_eq!(run("#1=5.\nG1 X20. ,R#1 F100.\nY10.", Fanuc)[0], "F 15 0 0");
}

#[test]
fn a_corner_at_the_end_of_the_text_is_an_error_among_others() {
    use kinecut_nc::base::Sources;
    use kinecut_nc::nc::{self, ReadSettings};
    let settings = ReadSettings { reads_on: true, ..ReadSettings::default() };
    let mut sources = Sources::default();
    let file = sources.add("a.nc", "G21 G54 G0 X0. Y0. Z0.\nM777\nG0 X0. Y0. Z0.\nG1 X9. ,R1. F100.\n");
    let reading = nc::read_source(&sources, file, Fanuc, &[], &settings).unwrap();
    assert_eq!(reading.errors.len(), 2, "{:?}", reading.errors);
}
