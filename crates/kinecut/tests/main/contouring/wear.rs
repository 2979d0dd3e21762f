//! Wear registers as planned: paths that lose a part under the largest wear are refused.

use super::*;

/// A contour inside a corner, finished under a wear.
fn worn(outline: Outline, largest: f64) -> ContourSpec {
    let wear = Some(Wear { register: 2, largest });
    let finish = ContourFinish {
        allowance: 0.2,
        feed: 15.0,
        stepdown: None,
        spring_passes: 0,
        wear,
        corner_feed: false,
    };
    ContourSpec { side: ContourSide::Inside, finish: Some(finish), ..spec(outline) }
}

/// A rectangle of 40 x 30 mm with rounded corners.
fn rounded(r: f64) -> Outline {
    let corner = |x: f64, y: f64, from: f64| OutlineEdge::arc(dvec2(x, y), r, from, 0.5 * PI);
    let arcs = [
        corner(r, r, PI),
        corner(40.0 - r, r, 1.5 * PI),
        corner(40.0 - r, 30.0 - r, 0.0),
        corner(r, 30.0 - r, 0.5 * PI),
    ];
    let edges = (0..4).flat_map(|i| [arcs[i], OutlineEdge::line(arcs[i].end, arcs[(i + 1) % 4].start)]);
    Outline::new(vec![edges.collect()], vec![]).unwrap()
}

#[test]
fn a_wear_that_makes_an_arc_vanish_is_refused_with_the_largest_that_fits() {
    let error = plan_contour(&worn(rounded(3.02), 0.05)).unwrap_err().0;
    assert_eq!((error.code, error.key.as_deref()), (Code::PLAN_VALUE, Some("finish.wear_largest")));
    assert!(error.message.contains("inside arc of radius 0.02 at ("), "{}", error.message);
    assert!(error.message.contains("R3.02 in the drawing beside a cutter of R3"), "{}", error.message);
    assert_eq!(error.value.as_ref().unwrap().value, 0.05);
    let largest = error.bound.as_ref().unwrap().value;
    assert!((0.0199 - 1e-9..0.02).contains(&largest), "{largest}");
    let at = error.point.unwrap();
    assert!((at[0].min(40.0 - at[0]) - 3.006).abs() < 0.01 && (at[1].min(30.0 - at[1]) - 3.006).abs() < 0.01);
    // With that it is planned, sharp corners and wide ones are with any, and so is the outside.
    assert!(plan_contour(&worn(rounded(3.02), largest)).is_ok());
    assert!(plan_contour(&worn(rounded(3.0), 0.05)).is_ok());
    assert!(plan_contour(&worn(rounded(4.0), 0.2)).is_ok());
    assert!(plan_contour(&worn(rectangle(40.0, 30.0), 0.2)).is_ok());
    let outside = ContourSpec { side: ContourSide::Outside, ..worn(rounded(3.02), 0.05) };
    assert!(plan_contour(&outside).is_ok());
}

#[test]
fn a_wear_that_takes_a_line_or_a_neck_away_is_refused() {
    // A slot of 6.3 mm in the side: its end is a line of 0.3 mm of the path.
    let notched = |wide: f64| {
        let (low, high) = (20.0 - 0.5 * wide, 20.0 + 0.5 * wide);
        let corners = [
            dvec2(0.0, 0.0),
            dvec2(60.0, 0.0),
            dvec2(60.0, low),
            dvec2(80.0, low),
            dvec2(80.0, high),
            dvec2(60.0, high),
            dvec2(60.0, 40.0),
            dvec2(0.0, 40.0),
        ];
        Outline::polygon(&corners).unwrap()
    };
    let line = plan_contour(&worn(notched(6.3), 0.16)).unwrap_err().0;
    assert!(line.message.contains("the path has a line of 0.3 mm between inside corners at (77"), "{line:?}");
    assert!((line.bound.unwrap().value - 0.1499).abs() < 2e-4);
    assert!(plan_contour(&worn(notched(6.3), 0.1)).is_ok());
    // Two rooms, joined by a neck of 6.2 mm.
    let corners = [
        dvec2(0.0, 0.0),
        dvec2(30.0, 0.0),
        dvec2(30.0, 12.0),
        dvec2(50.0, 12.0),
        dvec2(50.0, 0.0),
        dvec2(80.0, 0.0),
        dvec2(80.0, 40.0),
        dvec2(50.0, 40.0),
        dvec2(50.0, 18.2),
        dvec2(30.0, 18.2),
        dvec2(30.0, 40.0),
        dvec2(0.0, 40.0),
    ];
    let rooms = Outline::polygon(&corners).unwrap();
    let neck = plan_contour(&worn(rooms.clone(), 0.12)).unwrap_err().0;
    assert_eq!(neck.key.as_deref(), Some("finish.wear_largest"), "{neck:?}");
    assert!((neck.bound.as_ref().unwrap().value - 0.0999).abs() < 2e-4);
    let at = neck.point.unwrap();
    assert!((29.0..51.0).contains(&at[0]) && (14.9..15.3).contains(&at[1]), "{at:?}");
    assert!(neck.message.contains("comes too near to itself"), "{neck:?}");
    assert!(plan_contour(&worn(rooms, 0.09)).is_ok());
    let large = plan_contour(&worn(rectangle(40.0, 30.0), 3.0)).unwrap_err().0;
    assert_eq!(large.key.as_deref(), Some("finish.wear_largest"));
}
