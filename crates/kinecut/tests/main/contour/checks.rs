//! What is no contour is refused, with the number of the element; what is one is kept as it is.

use std::f64::consts::PI;

use glam::DVec2;
use kinecut::base::Code;
use kinecut::tool::{Contour, ContourElement, ContourShape, DOWN, ElementRole, UP};

fn line(start: [f64; 2], end: [f64; 2]) -> ContourElement {
    ContourElement::line(start, end, ElementRole::Cutting)
}

/// The key and message of the refusal.
fn refused(elements: Vec<ContourElement>) -> (String, String) {
    let error = Contour::new(elements).unwrap_err();
    assert_eq!(error.code(), Code::CONTOUR);
    (error.0.key.clone().unwrap_or_default(), error.to_string())
}

fn flat() -> Vec<ContourElement> {
    vec![line([0.0, 0.0], [5.0, 0.0]), line([5.0, 0.0], [5.0, 30.0]), line([5.0, 30.0], [0.0, 30.0])]
}

#[test]
fn what_is_no_contour_is_refused_with_the_element() {
    let with = |i: usize, e: ContourElement| {
        let mut elements = flat();
        elements[i] = e;
        refused(elements)
    };
    let is = |(key, text): (String, String), element: usize, words: &str| {
        assert_eq!(key, format!("elements[{element}]"), "{text}");
        assert!(text.contains(words), "{text}");
    };
    is(with(0, line([1.0, 0.0], [5.0, 0.0])), 0, "does not begin on the axis");
    is(with(1, line([5.0, 0.1], [5.0, 30.0])), 1, "gap");
    is(with(2, line([5.0, 30.0], [0.1, 30.0])), 2, "does not end on the axis");
    is(with(2, line([5.0, 30.0], [-0.1, 30.0])), 2, "passes the axis");
    is(with(1, line([5.0, f64::NAN], [5.0, 30.0])), 1, "not finite");
    is(with(1, line([5.0, f64::INFINITY], [5.0, 30.0])), 1, "not finite");
    assert!(Contour::new(vec![]).is_err());
    // An arc whose ends are right of the axis and whose middle is left of it.
    let bulge = ContourElement::arc([5.0, 15.0], 15.0, 0.5 * PI, -0.5 * PI, ElementRole::Cutting);
    is(
        refused(vec![line([0.0, 0.0], [5.0, 0.0]), bulge, line([5.0, 30.0], [0.0, 30.0])]),
        1,
        "passes the axis",
    );
    let mut reversed: Vec<ContourElement> = flat();
    reversed.reverse();
    for e in &mut reversed {
        e.shape = ContourShape::Line { start: e.shape.end(), end: e.shape.start() };
    }
    assert!(refused(reversed).1.contains("material on the right"));
    let negative =
        ContourShape::Arc { centre: DVec2::new(5.0, 15.0), radius: -15.0, convex: true, from: DOWN, to: UP };
    is(
        with(1, ContourElement { shape: negative, role: ElementRole::Cutting, body: 0 }),
        1,
        "positive radius",
    );
    let against =
        ContourShape::Arc { centre: DVec2::new(5.0, 15.0), radius: 15.0, convex: false, from: DOWN, to: UP };
    is(with(1, ContourElement { shape: against, role: ElementRole::Cutting, body: 0 }), 1, "convexity");
    is(refused(vec![line([0.0, 0.0], [0.0, 5.0])]), 0, "lies on the axis");
    is(refused(vec![line([0.0, 0.0], [5.0, 3.0]), line([5.0, 3.0], [0.0, 0.0])]), 1, "ends where");
    // A pin that touches the axis on its way.
    let pinched = [[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 6.0], [5.0, 7.0], [5.0, 9.0], [0.0, 9.0]];
    let pinched: Vec<_> = pinched.windows(2).map(|p| line(p[0], p[1])).collect();
    is(refused(pinched), 2, "touches the axis");
    // A crossing, a touch and a way back.
    let crossed = [[0.0, 0.0], [5.0, 0.0], [5.0, 9.0], [3.0, 9.0], [6.0, 6.0], [6.0, 12.0], [0.0, 12.0]];
    let crossed: Vec<_> = crossed.windows(2).map(|p| line(p[0], p[1])).collect();
    is(refused(crossed), 1, "touched by element 3");
    let retraced = [[0.0, 0.0], [5.0, 0.0], [3.0, 0.0], [3.0, 9.0], [0.0, 9.0]];
    let retraced: Vec<_> = retraced.windows(2).map(|p| line(p[0], p[1])).collect();
    is(refused(retraced), 0, "touched by element 1");
}

#[test]
fn long_arcs_are_halved_and_their_angles_wrapped() {
    // A bulb about a thin neck, given one turn on.
    let start = -0.9 * PI;
    let (x, z) = (3.0 + 2.0 * start.cos(), 4.0 + 2.0 * start.sin());
    let (u, v) = (3.0 + 2.0 * (0.9 * PI).cos(), 4.0 + 2.0 * (0.9 * PI).sin());
    let bulb = ContourElement::arc([3.0, 4.0], 2.0, start + 2.0 * PI, 2.9 * PI, ElementRole::Cutting);
    let contour = Contour::new(vec![line([0.0, z], [x, z]), bulb, line([u, v], [0.0, v])]).unwrap();
    assert_eq!(contour.elements().len(), 4);
    let [a, b] = [contour.elements()[1].shape.normals(), contour.elements()[2].shape.normals()];
    assert!((a[0] - start).abs() < 1e-12 && a[1].abs() < 1e-12 && b[1] - b[0] < PI);
    assert!((contour.largest_radius() - 5.0).abs() < 1e-12);
}

#[test]
fn cusps_are_refused() {
    // Two circles tangent from inside at the outermost point.
    let elements = vec![
        ContourElement::arc([0.0, 0.0], 5.0, DOWN, 0.0, ElementRole::Cutting),
        ContourElement::arc([4.0, 0.0], 1.0, -PI, -1.5 * PI, ElementRole::Cutting),
        line([4.0, -1.0], [0.0, -1.0]),
    ];
    let text = refused(elements).1;
    assert!(text.contains("element 1") && text.contains("cusp"), "{text}");
}
