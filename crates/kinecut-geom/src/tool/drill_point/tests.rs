//! Tests of points of drills.

use super::*;

fn deg(angle: f64) -> f64 {
    angle.to_radians()
}

fn length(point: &DrillPoint) -> f64 {
    let [low, high] = point.edge(20.0).unwrap().extent();
    assert_eq!(low, 0.0, "{point:?}: heights are counted from the lowest point");
    high
}

#[test]
fn lengths_of_the_points_are_those_of_the_corrected_table() {
    let cot = |angle: f64| deg(angle).tan().recip();
    let cases = [
        (DrillPoint::SinglePlane { angle: deg(118.0) }, 10.0 * cot(59.0)),
        (DrillPoint::Auger { angle: deg(120.0) }, 10.0 * cot(60.0)),
        (DrillPoint::CastIron { angle: deg(118.0), second: deg(70.0), third: deg(55.0), slot: 0.0 }, 9.7353),
        (DrillPoint::Rounded { radius: 14.0 }, 14.0 - 96f64.sqrt()),
        (DrillPoint::ThinnedWeb { angle: deg(118.0), flat: 1.5 }, 8.5 * cot(59.0)),
        (DrillPoint::SlottedChisel { angle: deg(118.0), slot: 1.5 }, 8.5 * cot(59.0)),
        (DrillPoint::Annular { core: 12.0 }, 0.0),
        (DrillPoint::Flat, 0.0),
        (DrillPoint::Cannon { overlap: 0.4, edge_angle: deg(80.0) }, 10.4 * cot(80.0)),
        (
            DrillPoint::Gun { apex: Some(5.0), outer_angle: deg(60.0), inner_angle: deg(70.0) },
            5.0 * cot(60.0),
        ),
        // The nub in the middle is the highest point here.
        (DrillPoint::Gun { apex: Some(8.0), outer_angle: deg(60.0), inner_angle: deg(45.0) }, 8.0),
        (DrillPoint::Cone { angle: deg(90.0), nose: 3.0 }, 8.5),
    ];
    for (point, expected) in cases {
        assert!((length(&point) - expected).abs() < 1e-4, "{point:?}: {} {expected}", length(&point));
    }
}

#[test]
fn a_centre_drill_is_a_stepped_tool_with_a_band_for_each_diameter() {
    let pilot = StepStage { diameter: 4.0, length: 5.0, shoulder: deg(60.0) };
    let stages = vec![pilot];
    let point = DrillPoint::Stepped { angle: deg(120.0), stages };
    let edge = point.edge(10.0).unwrap();
    assert!((edge.extent()[1] - (5.0 + 3.0 * deg(30.0).tan().recip())).abs() < 1e-12);
    let bands = point.bands(10.0).unwrap();
    assert_eq!(bands.len(), 2);
    assert_eq!((bands[0].outer_radius(), bands[1].inner_radius()), (2.0, 2.0));
    assert_eq!(bands[1].extent()[0], 5.0);
    let flat = StepStage { diameter: 6.0, length: 12.0, shoulder: PI };
    let counterbore = DrillPoint::Stepped { angle: deg(140.0), stages: vec![flat] };
    assert_eq!(counterbore.edge(11.0).unwrap().extent()[1], 12.0);
}

#[test]
fn numbers_that_make_no_point_are_named() {
    let wrong = [
        (DrillPoint::SinglePlane { angle: deg(180.0) }, "point_angle"),
        (DrillPoint::SinglePlane { angle: f64::NAN }, "point_angle"),
        (DrillPoint::Rounded { radius: 9.0 }, "lip_radius"),
        (DrillPoint::DoubleGround { angle: deg(118.0), second: deg(0.0) }, "second_angle"),
        (
            DrillPoint::CastIron { angle: deg(118.0), second: deg(170.0), third: deg(170.0), slot: 4.0 },
            "second_angle",
        ),
        (DrillPoint::ThinnedWeb { angle: deg(118.0), flat: 10.0 }, "flat"),
        (DrillPoint::SlottedChisel { angle: deg(118.0), slot: 10.0 }, "slot"),
        (DrillPoint::Annular { core: 20.0 }, "core_diameter"),
        (DrillPoint::Cannon { overlap: -0.1, edge_angle: deg(80.0) }, "overlap"),
        (DrillPoint::Gun { apex: Some(11.0), outer_angle: deg(60.0), inner_angle: deg(70.0) }, "apex"),
        (DrillPoint::Gun { apex: Some(5.0), outer_angle: deg(90.0), inner_angle: deg(70.0) }, "outer_angle"),
        (DrillPoint::CornerRadius { angle: deg(118.0), radius: 11.0 }, "corner_radius"),
        (DrillPoint::Cone { angle: deg(90.0), nose: 20.0 }, "nose_diameter"),
    ];
    for (point, key) in wrong {
        let error = point.edge(20.0).unwrap_err();
        assert_eq!((error.code(), error.0.key.as_deref()), (Code::TOOL_VALUE, Some(key)), "{point:?}");
    }
    assert_eq!(DrillPoint::Flat.edge(0.0).unwrap_err().0.key.as_deref(), Some("diameter"));
    let short = StepStage { diameter: 4.0, length: 1.0, shoulder: deg(60.0) };
    let point = DrillPoint::Stepped { angle: deg(120.0), stages: vec![short] };
    assert_eq!(point.edge(10.0).unwrap_err().0.key.as_deref(), Some("stages[0].length"));
}
