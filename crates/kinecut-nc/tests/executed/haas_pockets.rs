//! Round pockets of a Haas: `G12` and `G13`.
//!
//! Expected values are those of the words: circles of radius I, I + Q, ..., K about the present place.

use crate::{moves, read, refused, run};
use kinecut_nc::base::Severity;
use kinecut_nc::nc::Control::{Fanuc, Haas};
use kinecut_nc::program::{Comp, Item, Path};

#[test]
fn a_circle_is_cut_about_the_present_place() {
    assert_eq!(
        run("G0 X5. Y6. Z1.\nG12 I10. Z-5. D0 F200.\nX7.", Haas),
        ["R 5 6 1", "F 5 6 -5", "F 15 6 -5", "F 15 6 -5 arc", "F 5 6 -5", "R 7 6 -5"]
    );
    let text = "G21 G54 G0 X0. Y0. Z0.\nG13 X5. I3. Z-5. D2 F200.\nG12 I3. Z-5. D2\nM30\n";
    let reading = read(text, Haas).unwrap();
    let mut sweeps = Vec::new();
    let items = &reading.program.items;
    for i in 0..items.len() {
        let comp = reading.program.state(i).comp;
        match items.get(i) {
            Item::Move(motion) => match motion.path {
                Path::Arc { sweep, centre, .. } => sweeps.push((sweep.round(), centre.to_array(), comp)),
                _ => continue,
            },
            _ => continue,
        }
    }
    assert_eq!(sweeps, [(6.0, [5.0, 0.0, -5.0], Comp::Left(2)), (-6.0, [5.0, 0.0, -5.0], Comp::Right(2))]);
    let last = (0..items.len()).rev().find(|i| matches!(items.get(*i), Item::Move(_))).unwrap();
    assert_eq!(reading.program.state(last).comp, Comp::Off);
    let doubts =
        reading.findings.iter().filter(|f| f.severity == Severity::Doubt && f.message.contains("G13"));
    assert_eq!(doubts.count(), 1);
}

#[test]
fn wider_circles_follow_and_deeper_ones() {
    let ends =
        |body: &str| -> Vec<String> { run(body, Haas).into_iter().filter(|m| m.ends_with("arc")).collect() };
    let circles = ["F 3 0 -5 arc", "F 6 0 -5 arc", "F 9 0 -5 arc"];
    assert_eq!(ends("G13 I3. K9. Q3. Z-5. D1 F200."), circles);
    assert_eq!(ends("G13 I3. K8. Q3. Z-5. D0 F200."), ["F 3 0 -5 arc", "F 6 0 -5 arc", "F 8 0 -5 arc"]);
    assert_eq!(ends("G0 Z1.\nG91 G12 I2. Z-2. L2 D0 F200."), ["F 2 0 -1 arc", "F 2 0 -3 arc"]);
    // In inches, and scaled: the centre too.
    assert_eq!(ends("G20\nG12 I1. Z-1. D0 F20."), ["F 25.4 0 -25.4 arc"]);
    let text = "G21 G54 G0 X0. Y0. Z0.\nG51 X0. Y0. Z0. P2.\nG12 X5. I2. Z-1. D0 F200.\nM30\n";
    let reading = read(text, Haas).unwrap();
    assert_eq!(
        moves(&reading),
        ["R 0 0 0", "R 10 0 0", "F 10 0 -2", "F 14 0 -2", "F 14 0 -2 arc", "F 10 0 -2"]
    );
    let items = &reading.program.items;
    let centres = (0..items.len()).filter_map(|i| match items.get(i) {
        Item::Move(motion) => match motion.path {
            Path::Arc { centre, .. } => Some(centre.to_array()),
            _ => None,
        },
        _ => None,
    });
    assert_eq!(centres.collect::<Vec<_>>(), [[10.0, 0.0, -2.0]]);
}

#[test]
fn what_a_pocket_lacks_is_said() {
    for (block, why) in [
        ("G12 Z-1. D0 F100.", "without its radius I"),
        ("G12 I5. D0 F100.", "without its depth Z"),
        ("G12 I5. Z-1. F100.", "without the register D"),
        ("G12 I5. Z-1. D0", "without a feed"),
        ("G12 I5. Z-1. D0 K9. F100.", "one of K and Q"),
        ("G12 I5. Z-1. D0 K4. Q1. F100.", "not larger than the first"),
        ("G12 I5. Z-1. D0 K9. Q0. F100.", "positive"),
        ("G12 I-5. Z-1. D0 F100.", "positive"),
        ("G12 I1. Z-1. D0 K9. Q0.001 F100.", "more than 1000 circles"),
        ("G12 I5. Z-1. D0 L0 F100.", "number of depths"),
        ("G18\nG12 I5. Z-1. D0 F100.", "G17 only"),
        ("D1\nG41 G1 X1. F100.\nG12 I5. Z-1. D0", "compensation is on"),
    ] {
        let error = refused(block, Haas);
        assert!(error.contains(why), "{block}: {error}");
    }
    assert!(refused("G12 I5. Z-1. D0 F100.", Fanuc).contains("not understood"));
}
