//! Removing nothing, lying beside the stock, going below it, feeding through air.

use kinecut::base::{Code, Severity};

use super::*;

#[test]
fn a_program_that_runs_above_the_stock_is_not_proven() {
    let outcome = fanuc(&mill("G1 Z1. F200.\nX45. F400."));
    told(&outcome, Code::NOTHING_REMOVED, Severity::Doubt, "G1 Z1. F200.");
    assert!(!outcome.verdict.is_safe());
}

#[test]
fn a_shaving_of_a_hundredth_is_removed() {
    right(&fanuc(&mill("G1 Z-0.01 F200.\nX45. F400.")));
}

#[test]
fn a_program_beside_the_stock_is_wrong() {
    let outcome = fanuc(&mill("G1 Z-2. F200.\nX45. F400.").replace("Y20.", "Y200."));
    told(&outcome, Code::BESIDE_STOCK, Severity::Error, "G1 Z-2. F200.");
    // Half of it in the stock is not beside it.
    right(&fanuc(&mill("G1 Z-2. F200.\nX45. F400.").replace("Y20.", "Y42.")));
}

#[test]
fn far_below_the_stock_is_wrong_and_breaking_through_is_right() {
    // The point of 118 degrees is 1.8 long: down to 16.8 below Z0 is allowed.
    right(&fanuc(&drill("G81 X15. Y20. Z-16.7 R2. F150.\nG80")));
    let deep = drill("G81 X15. Y20. Z-14. R2. F150.\nX30. Z-17.\nG80");
    let outcome = fanuc(&deep);
    told(&outcome, Code::BELOW_STOCK, Severity::Error, "X30. Z-17.");
    let found = outcome.verdict.found.iter().find(|f| f.code == Code::BELOW_STOCK).unwrap();
    assert!((found.value.as_ref().unwrap().value - 5.0).abs() < 1e-6 && found.help.contains("breakthrough"));
    // The setup may say that there is room.
    let room = format!("breakthrough = 5\n{PLAIN}");
    right(&super::outcome(&job("fanuc", "", "", &room), &deep));
}

#[test]
fn beside_the_part_the_table_is_as_near_and_far_away_it_is_not_asked_for() {
    let around =
        |y: &str, z: &str| mill(&format!("G1 Z-2. F200.\nX45. F400.\nG0 Z20.\nX70. Y{y}\nZ{z}\nZ20."));
    right(&fanuc(&around("20.", "-15.")));
    told(&fanuc(&around("20.", "-15.5")), Code::BELOW_STOCK, Severity::Error, "Z-15.5");
    right(&fanuc(&around("150.", "-15.5")));
}

#[test]
fn a_stated_table_is_cut_by_nothing() {
    let with = |table: &str, z: &str| {
        let setup = format!("table = {table}\n{PLAIN}");
        super::outcome(&job("fanuc", "", "", &setup), &drill(&format!("G81 X15. Y20. Z{z} R2. F150.\nG80")))
    };
    right(&with("-14", "-13.9"));
    told(&with("-14", "-14.1"), Code::BELOW_STOCK, Severity::Error, "G81 X15. Y20. Z-14.1 R2. F150.");
    // A deep pit under the part: nothing is assumed beside it.
    right(&with("-40", "-30."));
}

#[test]
fn feeding_through_air_at_depth_is_told_and_rubbing_along_a_floor_is_not() {
    let small =
        "\n[[tool]]\nnumber = 3\ntype = \"end-mill\"\ndiameter = 4\nflute_length = 12\ngauge_length = 90";
    let second = |z: &str| {
        let more = format!(
            "G91 G28 Z0. M5\nG90\nT3 M6\nG54 G0 X15. Y20. S4000 M3\nG43 H3 Z20. M8\nZ2.\nG1 Z{z} F210.\nX45. F410."
        );
        with_mill(small, &mill(&format!("G1 Z-3. F200.\nX45. F400.\nG0 Z20. M9\n{more}")))
    };
    told(&second("-2.5"), Code::FEED_IN_AIR, Severity::Warning, "G1 Z-2.5 F210.");
    right(&second("-3."));
    right(&second("-3.1"));
}

#[test]
fn a_drilling_cycle_into_a_hole_that_is_there_is_told() {
    let more = "[[drilled]]\nat = [30, 20]\ndiameter = 8\ntop = 0\nbottom = -12";
    let run = |y: &str| {
        let program = drill(&format!("G99 G81 X15. Y20. Z-10. R2. F150.\nX30. Y{y}\nG80"));
        super::outcome(&job("fanuc", "", more, PLAIN), &program)
    };
    told(&run("20."), Code::FEED_IN_AIR, Severity::Warning, "X30. Y20.");
    right(&run("30."));
}
