//! Standing still in the cut, tool changes inside the stock.

use kinecut::base::{Code, Severity};

use super::*;

#[test]
fn a_dwell_at_a_wall_is_told_and_one_above_the_part_is_not() {
    let dwell = |how: &str| mill(&format!("G1 Z-2. F200.\nX30. F400.\n{how}\nX45."));
    told(&fanuc(&dwell("G4 P5000")), Code::DWELL_IN_CUT, Severity::Warning, "G4 P5000");
    right(&fanuc(&dwell("G4 P100")));
    right(&fanuc(&dwell("Z2.\nG4 P5000\nZ-2.")));
    told(&fanuc(&dwell("M0\nS3000 M3")), Code::DWELL_IN_CUT, Severity::Warning, "M0");
    told(&fanuc(&dwell("M1\nS3000 M3")), Code::DWELL_IN_CUT, Severity::Warning, "M1");
    right(&fanuc(&dwell("Z2.\nM1\nS3000 M3\nZ-2.")));
}

#[test]
fn a_dwell_within_a_compensated_contour_is_at_its_place() {
    // Along the side X0 of the plate, one millimetre inside it, and on beyond its end.
    let contour = |beside: &str, beyond: &str| {
        let way = format!("G41 D1 X1. Y-8. F300.\nY20.\n{beside}\nY50.\n{beyond}\nG40 X-10. Y60.");
        fanuc(&mill(&format!("G0 X-10. Y-10.\nG1 Z-4. F200.\n{way}")))
    };
    told(&contour("G4 P5000", ""), Code::DWELL_IN_CUT, Severity::Warning, "G4 P5000");
    right(&contour("", "G4 P5000"));
}

#[test]
fn a_dwell_at_the_bottom_of_a_hole_is_right() {
    right(&fanuc(&drill("G82 X15. Y20. Z-6. R2. P1000 F150.\nG80")));
    right(&fanuc(&drill("G1 Z-6. F150.\nG4 P1000\nZ2.")));
    // Spot facing with a mill.
    right(&fanuc(&mill("G1 Z-2. F150.\nG4 P1000\nZ2.")));
}

#[test]
fn a_tool_is_not_changed_inside_the_stock() {
    let inside = GOOD.replace("G0 Z20. M9\nG91 G28 Z0. M5\nG90\nT2 M6", "M9\nM5\nT2 M6");
    let outcome = fanuc(&inside);
    told(&outcome, Code::CHANGE_IN_STOCK, Severity::Error, "T2 M6");
    let found = outcome.verdict.found.iter().find(|f| f.code == Code::CHANGE_IN_STOCK).unwrap();
    assert!((found.value.as_ref().unwrap().value - 4.0).abs() < 1e-3);
    // Above the part, and at the same height beside it.
    assert!(blocks(&fanuc(&GOOD.replace("G91 G28 Z0. M5\nG90\n", "M5\n")), Code::CHANGE_IN_STOCK).is_empty());
    let beside = GOOD.replace("X15. F400.\nG0 Z20. M9\nG91 G28 Z0. M5\nG90\n", "X-20. F400.\nM9\nM5\n");
    assert!(blocks(&fanuc(&beside), Code::CHANGE_IN_STOCK).is_empty());
}
