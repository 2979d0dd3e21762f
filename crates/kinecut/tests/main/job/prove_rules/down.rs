//! Going down into material, working deeper than the flutes, a drill that moves sideways.

use kinecut::base::{Code, Severity};

use super::*;

const FACE: &str = "centre_cutting = false\nmax_ramp_angle = 3";

#[test]
fn a_mill_that_does_not_cut_at_its_centre_does_not_plunge_into_the_solid() {
    let plunge = mill("G1 Z0. F200.\nZ-3.\nX45. F400.");
    told(&with_mill(FACE, &plunge), Code::PLUNGE, Severity::Error, "Z-3.");
    right(&with_mill("centre_cutting = true\nmax_ramp_angle = 3", &plunge));
    // In a drilled hole its middle is free.
    let more = "[[drilled]]\nat = [15, 20]\ndiameter = 5\ntop = 0\nbottom = -12";
    right(&outcome(&job("fanuc", FACE, more, PLAIN), &plunge));
    // Beside the part too.
    right(&with_mill(FACE, &mill("G0 X-10.\nG1 Z-3. F200.\nX45. F400.")));
    // A drilling cycle with it is a plunge.
    let cycle = "G81 X15. Y20. Z-3. R2. F150.";
    told(&with_mill(FACE, &mill(&format!("{cycle}\nG80"))), Code::PLUNGE, Severity::Error, cycle);
}

#[test]
fn ramps_and_helices_are_no_steeper_than_the_tool_may_go() {
    // 1.5 in 30 is 2.86 degrees, 2 in 30 is 3.81.
    right(&with_mill(FACE, &mill("G1 Z0. F200.\nX45. Z-1.5 F400.")));
    let steep = "X45. Z-2. F400.";
    told(
        &with_mill(FACE, &mill(&format!("G1 Z0. F200.\n{steep}"))),
        Code::RAMP_TOO_STEEP,
        Severity::Error,
        steep,
    );
    // A turn of a helix of 4 mm radius is 25.1 long.
    right(&with_mill(FACE, &mill("G1 Z0. F200.\nG3 X15. Y20. I4. J0. Z-1.3 F400.")));
    let helix = "G3 X15. Y20. I4. J0. Z-1.4 F400.";
    told(
        &with_mill(FACE, &mill(&format!("G1 Z0. F200.\n{helix}"))),
        Code::RAMP_TOO_STEEP,
        Severity::Error,
        helix,
    );
    // Above the part it goes down as it likes.
    right(&with_mill(FACE, &mill("G0 Z20.\nG1 X45. Z0. F400.\nX15. Z-1.5")));
}

#[test]
fn no_hole_is_deeper_than_the_flutes() {
    let short = |z: &str| {
        let text = job("fanuc", "", "", PLAIN).replace("flute_length = 40", "flute_length = 11");
        outcome(&text, &drill(&format!("G81 X15. Y20. Z{z} R2. F150.\nG80")))
    };
    right(&short("-10.9"));
    told(&short("-11.2"), Code::TOO_DEEP, Severity::Error, "G81 X15. Y20. Z-11.2 R2. F150.");
}

#[test]
fn a_shank_as_thick_as_the_cutter_rubs_in_a_slot_deeper_than_the_flutes() {
    let slot = mill("G1 Z-4. F200.\nX45. F400.\nZ-8. F200.\nX15. F400.");
    let with = |keys: &str| {
        let text = job("fanuc", keys, "", PLAIN).replace("flute_length = 20", "flute_length = 6");
        outcome(&text, &slot)
    };
    told(&with(""), Code::TOO_DEEP, Severity::Warning, "Z-8. F200.");
    right(&with("shank_diameter = 7.5"));
    right(&fanuc(&slot));
}

#[test]
fn a_drill_does_not_mill_and_a_spot_drill_may_chamfer() {
    let sideways = drill("G1 Z-4. F150.\nX20. F160.\nG0 X20.");
    told(&fanuc(&sideways), Code::DRILL_SIDEWAYS, Severity::Error, "X20. F160.");
    right(&fanuc(&drill("G1 Z-4. F150.\nZ1.\nX20. F160.")));
    let pointed = job("fanuc", "", "", PLAIN).replace("diameter = 6\n", "diameter = 6\npoint_angle = 90\n");
    let chamfer = drill("G0 X-5. Y0.\nG1 Z-1. F150.\nX65. F160.");
    right(&outcome(&pointed, &chamfer));
    told(&fanuc(&chamfer), Code::DRILL_SIDEWAYS, Severity::Error, "X65. F160.");
}

#[test]
fn a_reamer_goes_only_into_a_hole_that_is_there() {
    let cycle = "G81 X15.25 Y20.25 Z-10. R2. F150.";
    let reamed = |keys: &str, more: &str| {
        let text = job("fanuc", "", more, PLAIN)
            .replace("gauge_length = 130", &format!("gauge_length = 130\n{keys}"));
        outcome(&text, &drill(&format!("{cycle}\nG80")))
    };
    told(&reamed("centre_cutting = false", ""), Code::PLUNGE, Severity::Error, cycle);
    right(&reamed("", ""));
    // A steepest ramp is no matter of a drill.
    right(&reamed("max_ramp_angle = 3", ""));
    let hole = "[[drilled]]\nat = [15.25, 20.25]\ndiameter = 5\ntop = 0\nbottom = -12";
    assert!(blocks(&reamed("centre_cutting = false", hole), Code::PLUNGE).is_empty());
}
