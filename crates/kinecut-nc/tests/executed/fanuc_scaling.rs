//! Scaled and mirrored coordinates: `G51`, `G51.1` of FANUC, `G51` of Haas.
//!
//! Expected values are worked out by hand: `q = centre + factor (p - centre)`, mirrored first, then scaled, then turned.

use crate::{read, refused, run};
use kinecut_nc::nc::Control::{Fanuc, Haas};
use kinecut_nc::nc::Reading;
use kinecut_nc::program::{Comp, Item, Path, Target};

fn text(body: &str) -> String {
    format!("G21 G54 G0 X0. Y0. Z0.\n{body}\nM30\n")
}

/// Ends of the moves in the work offset.
fn in_work(reading: &Reading) -> Vec<[f64; 3]> {
    let program = &reading.program;
    let round = |v: f64| (v * 1e6).round() / 1e6 + 0.0;
    (0..program.items.len())
        .filter_map(|i| {
            let Item::Move(motion) = program.items.get(i) else { return None };
            let Target::Tip { point, .. } = motion.end else { return None };
            let (_, to_work) = program.in_work(program.state(i).frame)?;
            Some(to_work.point(point).to_array().map(round))
        })
        .collect()
}

/// Angle of each arc in quarter turns, against the clock.
fn sweeps(reading: &Reading) -> Vec<f64> {
    let items = &reading.program.items;
    (0..items.len())
        .filter_map(|i| match items.get(i) {
            Item::Move(motion) => match motion.path {
                Path::Arc { sweep, axis, .. } => {
                    assert!(axis.min_element() >= 0.0);
                    Some((sweep / std::f64::consts::FRAC_PI_2 * 1e6).round() / 1e6)
                }
                _ => None,
            },
            _ => None,
        })
        .collect()
}

#[test]
fn points_and_arcs_are_scaled_about_a_centre() {
    let body =
        "G51 X10. Y10. P2000\nG1 X20. Y10. F100.\nG3 X10. Y20. R10.\nG91 X5.\nG90 G1 X0. Z1.\nG50\nG1 X1.";
    assert_eq!(
        run(&body.replace("G91 X5.\n", "G91 G1 X5.\n"), Fanuc),
        ["F 30 10 0", "F 10 30 0 arc", "F 20 30 0", "F -10 30 2", "F 1 30 2"]
    );
    let reading = read(&text("G51 X10. Y10. P2000\nG1 X20. Y10. F100.\nG3 X10. Y20. I-10."), Fanuc).unwrap();
    let Item::Move(motion) = reading.program.items.get(2) else { panic!() };
    let Path::Arc { centre, .. } = motion.path else { panic!() };
    assert_eq!(([centre.x, centre.y], sweeps(&reading)), ([10.0, 10.0], vec![1.0]));
    // With a point it is the factor itself, on both controls.
    for control in [Fanuc, Haas] {
        assert_eq!(run("G51 X10. Y10. P2.\nG0 X20. Y10.", control), ["R 30 10 0"], "{control}");
    }
    assert!(refused("G51 X10. Y10. P2", Haas).contains("not clear"));
    // About the present place where no centre is said.
    assert_eq!(run("G0 X5. Y5.\nG51 P500\nX15.", Fanuc), ["R 5 5 0", "R 10 5 0"]);
}

#[test]
fn each_axis_has_its_factor() {
    let reading = read(
        &text("G51 X0. Y0. Z0. I1000 J-1000 K1000\nG1 X10. Y5. F100.\nG2 X20. Y-5. I10. J0.\nG50"),
        Fanuc,
    )
    .unwrap();
    assert_eq!(in_work(&reading), [[0.0; 3], [10.0, -5.0, 0.0], [20.0, 5.0, 0.0]]);
}

#[test]
fn unequal_factors_make_no_circle() {
    assert_eq!(run("G51 X0. Y0. Z0. I2000 J3000 K1000\nG0 X1. Y1.", Fanuc), ["R 2 3 0"]);
    let error = refused("G51 X0. Y0. Z0. I2000 J3000 K1000\nG2 X10. Y0. I5. F100.", Fanuc);
    assert!(error.contains("no circle"), "{error}");
    // In the plane of the two equal factors they are.
    assert_eq!(run("G51 X0. Y0. Z0. I2000 J3000 K2000\nG18 G2 X10. Z0. I5. F100.", Fanuc), ["F 20 0 0 arc"]);
}

#[test]
fn a_mirror_image_changes_the_sense_of_arcs() {
    // The example of the NCT manual, section 15.3.
    let sub = "O101\nG90 G0 X180. Y120. F120.\nG1 X240.\nY160.\nG3 X180. Y120. R80.\nM99";
    let body = format!(
        "M98 P101\nG51.1 X140.\nM98 P101\nG51.1 Y100.\nM98 P101\nG50.1 X0\nM98 P101\nG50.1 Y0\nM98 P101\nM30\n{sub}"
    );
    let reading = read(&text(&body), Fanuc).unwrap();
    let places = in_work(&reading).split_off(1);
    let contour = |x: &dyn Fn(f64) -> f64, y: &dyn Fn(f64) -> f64| {
        [[180.0, 120.0], [240.0, 120.0], [240.0, 160.0], [180.0, 120.0]].map(|p| [x(p[0]), y(p[1]), 0.0])
    };
    let same = |v: f64| v;
    let (x, y) = (|v: f64| 280.0 - v, |v: f64| 200.0 - v);
    let expected: Vec<[f64; 3]> = [
        contour(&same, &same),
        contour(&x, &same),
        contour(&x, &y),
        contour(&same, &y),
        contour(&same, &same),
    ]
    .concat();
    assert_eq!(places, expected);
    let sense: Vec<bool> = sweeps(&reading).iter().map(|s| *s > 0.0).collect();
    assert_eq!(sense, [true, false, true, false, true]);
}

#[test]
fn a_mirror_image_changes_the_side_of_the_compensation_and_the_angle_of_a_rotation() {
    let reading = read(&text("G51.1 X0.\nG41 D1 G1 X10. F100.\nY20.\nG40 X0."), Fanuc).unwrap();
    let comps: Vec<Comp> = (1..4).map(|i| reading.program.state(i).comp).collect();
    assert_eq!(comps, [Comp::Right(1), Comp::Right(1), Comp::Off]);
    // Turned by 30 degrees (8.660254, 5), then mirrored.
    let reading = read(&text("G51.1 X0.\nG68 X0. Y0. R30.\nG0 X10. Y0.\nG69\nG50.1 X0."), Fanuc).unwrap();
    assert_eq!(in_work(&reading).last(), Some(&[-8.660254, 5.0, 0.0]));
}

#[test]
fn a_rotation_within_a_scaling_turns_about_the_scaled_centre() {
    let body = "G51 X0 Y0 P2000\nG68 X10. Y0 R90.\nG0 X20. Y0\nG69\nG50\nG0 X20.";
    let reading = read(&text(body), Fanuc).unwrap();
    assert_eq!(in_work(&reading), [[0.0; 3], [20.0, 20.0, 0.0], [20.0, 20.0, 0.0]]);
}

#[test]
fn cycles_are_read_where_their_axis_is_not_scaled() {
    let body = "G0 Z25.\nG51 X0. Y0. Z0. I2000 J2000 K1000\nG99 G81 X10. Y5. Z-5. R2. F100.\nX20.\nG80\nG50";
    assert_eq!(run(body, Fanuc), ["R 0 0 25", "R 20 10 25", "H 2 -5 2", "R 40 10 2", "H 2 -5 2"]);
    assert!(refused("G0 Z25.\nG51 X0 Y0 P2000\nG81 X1. Z-5. R2. F100.", Fanuc).contains("heights"));
    assert_eq!(run("G51.1 Y0.\nG99 G81 X1. Y2. Z-5. R2. F100.", Fanuc)[1..], ["R 1 -2 2", "H 2 -5 2"]);
}

#[test]
fn what_the_control_does_not_take_is_refused() {
    let scaled = "G51 X0 Y0 P2000\n";
    for word in ["G91 G28 Z0.", "G53 G0 Z0.", "G55", "G52 X1.", "G51.1 X0.", "G1 X1. ,R1. F100.\nY5."] {
        assert!(
            refused(&format!("{scaled}{word}"), Fanuc).contains("while the coordinates are scaled"),
            "{word}"
        );
    }
    assert!(refused("G68 X0. Y0. R30.\nG51 P2000", Fanuc).contains("turned"));
    assert!(refused("G41 D1 G1 X5. F100.\nG51 P2000", Fanuc).contains("compensation"));
    assert!(refused("G51 X0. Y0.", Fanuc).contains("needs P"));
    assert!(refused("G51 X0. I2000", Fanuc).contains("needs P"));
    assert!(refused("G51 P0", Fanuc).contains("no factor"));
    assert!(refused("G51.1", Fanuc).contains("without an axis"));
    assert!(
        refused("G51 X0. Y0. Z0. I-1000 J1000 K1000\nG68 X0. Y0. R5.", Fanuc).contains("negative factors")
    );
    assert!(refused("G51.1 X0.", Haas).contains("not understood"));
    assert!(refused("T1 M6\nG51 X0. Y0. P2000", Fanuc).contains("present Z"));
}
