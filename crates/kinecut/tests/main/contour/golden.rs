//! The golden tools made by their dimensions: element by element, and the chains that come of them.

use glam::DVec2;
use kinecut::sweep::{ChainPiece, PieceShape, ProfileChain};
use kinecut::tool::{
    Apt, Contour, ContourElement, ContourShape, Cutter, DrillPoint, ElementRole, Holder, HolderSegment, Tool,
    ToolForm, ToolNumber, ToothSpacing,
};
use serde_json::Value;

use crate::common::golden::{self, number};

/// How far numbers may differ: rounding.
const SAME: f64 = 1e-12;

fn made(name: &str) -> Contour {
    let deg = f64::to_radians;
    let form = match name {
        "flat" => ToolForm::EndMill { diameter: 10.0, flute_length: 30.0 },
        "ball" => ToolForm::BallNose { diameter: 10.0, flute_length: 30.0 },
        "bull" => ToolForm::BullNose { diameter: 10.0, corner_radius: 2.0, flute_length: 30.0 },
        "vcone" => {
            let point = DrillPoint::SinglePlane { angle: deg(60.0) };
            ToolForm::Drill { diameter: 12.0, point_angle: None, point: Some(point), flute_length: 25.0 }
        }
        "apt7" => ToolForm::Apt(Apt {
            corner_radius: 2.0,
            centre_radius: Some(4.0),
            centre_height: Some(3.0),
            lower_angle: deg(10.0),
            upper_angle: deg(5.0),
            height: 28.0,
            ..Apt::default()
        }),
        "lollipop" => ToolForm::Lollipop { diameter: 8.0, neck_diameter: 4.0, neck_length: 25.0 },
        "cornerround" => ToolForm::CornerRounding {
            tip_diameter: 4.0,
            tip_length: 1.0,
            radius: 3.0,
            diameter: Some(12.0),
            length: 20.0,
        },
        // Its origin lies below its lower end.
        "barrel" => {
            return ToolForm::Barrel { diameter: 12.0, profile_radius: 50.0, flute_length: 24.0 }
                .contour()
                .unwrap()
                .raised(3.0)
                .unwrap();
        }
        "wheel" => {
            ToolForm::Convex { diameter: 22.0, profile_radius: 3.0, neck_diameter: 0.0, neck_length: 6.0 }
        }
        "dished" => ToolForm::Dished {
            diameter: 10.0,
            dish_angle: 0.2f64.atan(),
            corner_radius: 0.0,
            flute_length: 30.0,
        },
        "stack" => return Contour::of_tool(&in_its_holder()).unwrap(),
        "hourglass" => ToolForm::Concave {
            diameter: 12.0,
            profile_radius: 3.5 * 2f64.sqrt(),
            height: 7.0,
            neck_diameter: 0.0,
            neck_length: 7.0,
        },
        other => panic!("a tool that is not known: {other}"),
    };
    form.contour().unwrap()
}

fn in_its_holder() -> Tool {
    let segment = |height, lower_diameter, upper_diameter| HolderSegment {
        height,
        lower_diameter,
        upper_diameter: Some(upper_diameter),
    };
    Tool {
        number: ToolNumber(1),
        name: "bull in a holder".to_owned(),
        cutter: Cutter::BullNose { diameter: 10.0, corner_radius: 1.0 },
        teeth: 2,
        spacing: ToothSpacing::default(),
        flute_length: 15.0,
        stickout: 35.0,
        shank_diameter: 8.0,
        holder: Some(Holder {
            name: "cone".to_owned(),
            segments: vec![segment(5.0, 8.0, 24.0), segment(20.0, 24.0, 24.0)],
        }),
        centre_cutting: true,
        max_ramp_angle: None,
        gauge_length: None,
        limits: Default::default(),
        elasticity: None,
    }
}

fn point(value: &Value, key: &str) -> DVec2 {
    DVec2::new(value[key][0].as_f64().unwrap(), value[key][1].as_f64().unwrap())
}

fn role(value: &Value) -> ElementRole {
    match value["role"].as_str().unwrap() {
        "cutting" => ElementRole::Cutting,
        "shank" => ElementRole::Shank,
        _ => ElementRole::Holder,
    }
}

fn same(a: f64, b: f64, words: &str) {
    assert!((a - b).abs() <= SAME, "{words}: {a} {b}");
}

fn same_element(element: &ContourElement, expected: &Value, words: &str) {
    assert_eq!(element.role, role(expected), "{words}");
    match element.shape {
        ContourShape::Line { start, end } => {
            assert_eq!(expected["kind"], "line", "{words}");
            same(start.distance(point(expected, "p0")), 0.0, words);
            same(end.distance(point(expected, "p1")), 0.0, words);
        }
        ContourShape::Arc { centre, radius, convex, from, to } => {
            assert_eq!(expected["kind"], "arc", "{words}");
            same(centre.distance(point(expected, "c")), 0.0, words);
            same(radius, number(expected, "r"), words);
            assert_eq!(convex, number(expected, "s") > 0.0, "{words}");
            same(from, number(expected, "phi0"), words);
            same(to, number(expected, "phi1"), words);
        }
    }
}

fn same_piece(piece: &ChainPiece, expected: &Value, words: &str) {
    match piece.shape {
        PieceShape::Line { start, .. } => {
            assert_eq!(expected["kind"], "line", "{words}");
            same(start.distance(point(expected, "p0")), 0.0, words);
            same(piece.point(piece.to).distance(point(expected, "p1")), 0.0, words);
        }
        PieceShape::Arc { centre, radius } => {
            assert_eq!(expected["kind"], "arc", "{words}");
            same(centre.distance(point(expected, "c")), 0.0, words);
            same(
                radius,
                number(expected, "r") * if radius == 0.0 { 1.0 } else { number(expected, "s") },
                words,
            );
            same(piece.from, number(expected, "phi0"), words);
            same(piece.to, number(expected, "phi1"), words);
            assert_eq!(piece.is_fan(), expected["edge"] == true || expected["pole"] == true, "{words}");
        }
    }
}

#[test]
fn the_golden_tools_follow_from_their_dimensions() {
    let golden = golden::file("sweep");
    let tools = golden["tools"].as_object().unwrap();
    assert_eq!(tools.len(), 12);
    for (name, tool) in tools {
        let contour = made(name);
        let elements = tool["elements"].as_array().unwrap();
        assert_eq!(contour.elements().len(), elements.len(), "{name}: {contour:#?}");
        for (i, (element, expected)) in contour.elements().iter().zip(elements).enumerate() {
            same_element(element, expected, &format!("{name} {i}"));
        }
        let chain = ProfileChain::new(&contour);
        let pieces = tool["chain"].as_array().unwrap();
        assert_eq!(chain.pieces().len(), pieces.len(), "{name}");
        for (i, (piece, expected)) in chain.pieces().iter().zip(pieces).enumerate() {
            same_piece(piece, expected, &format!("chain of {name} {i}"));
        }
    }
}

#[test]
fn bodies_of_a_tool_in_its_holder_are_counted_from_the_tip() {
    let bodies: Vec<u16> = made("stack").elements().iter().map(|e| e.body).collect();
    assert_eq!(bodies, [0, 0, 0, 0, 1, 2, 2, 2]);
}
