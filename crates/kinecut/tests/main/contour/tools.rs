//! Contours of all forms of tools: random dimensions are accepted, what is spoilt is refused where it is spoilt, and measures
//! and unions are those of numeric integrals and of points.

use std::f64::consts::PI;

use glam::DVec2;
use kinecut::base::Code;
use kinecut::tool::{
    Apt, Assembly, Contour, ContourElement, ContourFile, ContourShape, DrillPoint, ElementRole,
    HolderSegment, StepStage, ToolForm,
};
use proptest::prelude::*;

/// A form from numbers between 0 and 1; all kinds.
fn form(kind: usize, n: &[f64; 6]) -> ToolForm {
    let deg = f64::to_radians;
    let between = |i: usize, a: f64, b: f64| a + (b - a) * n[i];
    let diameter = between(0, 1.0, 60.0);
    let radius = 0.5 * diameter;
    let length = diameter * between(1, 1.5, 6.0);
    let part = between(2, 0.05, 0.95);
    let other = between(3, 0.05, 0.95);
    let neck_diameter = if n[5] < 0.3 { 0.0 } else { 0.3 * diameter * other };
    match kind {
        0 => ToolForm::EndMill { diameter, flute_length: length },
        1 => ToolForm::BallNose { diameter, flute_length: length },
        2 => ToolForm::BullNose { diameter, corner_radius: radius * n[2], flute_length: length },
        3 => {
            let half_angle = deg(between(3, 1.0, 80.0));
            let room = radius / (0.25 * PI - 0.5 * half_angle).tan();
            let corner_radius = if n[4] < 0.3 { 0.0 } else { room.min(diameter) * n[2] };
            ToolForm::Tapered { diameter, corner_radius, half_angle, flute_length: length }
        }
        4 => ToolForm::TaperedBall {
            ball_diameter: diameter,
            half_angle: deg(between(2, 1.0, 80.0)),
            flute_length: length,
        },
        5 => ToolForm::Barrel {
            diameter,
            profile_radius: diameter * between(2, 4.0, 30.0),
            flute_length: diameter * between(3, 0.2, 2.0),
        },
        6 => {
            let profile_radius = diameter * between(3, 1.0, 20.0);
            let length = 20.0 * diameter;
            ToolForm::Oval {
                diameter,
                profile_radius,
                tip_radius: radius * part,
                neck_diameter: diameter * (0.6 + 0.4 * n[4]),
                neck_length: length,
            }
        }
        7 => {
            let profile_radius = diameter * between(3, 1.0, 20.0);
            ToolForm::Tangent {
                diameter,
                profile_radius,
                tip_radius: radius * part,
                flute_length: 20.0 * diameter,
            }
        }
        8 => {
            let (profile_radius, half_angle) = (diameter * between(3, 3.0, 30.0), deg(between(4, 1.0, 45.0)));
            ToolForm::Taper {
                diameter,
                profile_radius,
                tip_radius: radius * part,
                half_angle,
                flute_length: 20.0 * diameter,
            }
        }
        9 => {
            let corner_radius = if n[4] < 0.3 { 0.0 } else { radius * part };
            ToolForm::Lens {
                diameter,
                profile_radius: radius * between(3, 1.0, 20.0),
                corner_radius,
                flute_length: length,
            }
        }
        10 => ToolForm::Lollipop { diameter, neck_diameter: diameter * part, neck_length: length },
        11 => {
            let (angle, corner_radius) = (deg(between(2, 40.0, 85.0)), 0.2 * radius * n[3]);
            ToolForm::Dovetail {
                diameter,
                angle,
                corner_radius,
                height: 0.41 * radius,
                neck_diameter: 0.5 * neck_diameter,
                neck_length: length,
            }
        }
        12 => {
            let height = diameter * between(3, 0.05, 1.0);
            let corner_radius = (0.5 * height).min(0.3 * diameter) * n[2];
            ToolForm::TSlot { diameter, height, corner_radius, neck_diameter, neck_length: length }
        }
        13 => ToolForm::Convex {
            diameter,
            profile_radius: 0.5 * radius * part,
            neck_diameter,
            neck_length: length,
        },
        14 => {
            let height = 0.9 * diameter * part;
            ToolForm::Concave {
                diameter,
                profile_radius: 0.5 * height * between(3, 1.0, 3.0),
                height,
                neck_diameter,
                neck_length: length,
            }
        }
        15 => ToolForm::Drill {
            diameter,
            point_angle: None,
            point: Some(point(n, diameter)),
            flute_length: 8.0 * diameter,
        },
        16 => ToolForm::Countersink {
            diameter,
            angle: deg(between(2, 40.0, 170.0)),
            nose_diameter: diameter * part * n[4],
            flute_length: length,
        },
        17 => ToolForm::HollowMill {
            diameter,
            core_diameter: diameter * part,
            depth: length * other,
            flute_length: length,
        },
        18 => {
            let r = radius * part;
            let tip_diameter = diameter * between(3, 0.1, 1.0);
            ToolForm::CornerRounding {
                tip_diameter,
                tip_length: r * n[4],
                radius: r,
                diameter: Some(tip_diameter + (2.0 + n[5]) * r),
                length,
            }
        }
        19 => ToolForm::Dished {
            diameter,
            dish_angle: deg(between(2, 1.0, 40.0)),
            corner_radius: 0.5 * radius * n[3],
            flute_length: length,
        },
        _ => {
            let corner_radius = if n[4] < 0.2 { 0.0 } else { radius * n[2] };
            ToolForm::Apt(Apt {
                corner_radius,
                // Also beyond the axis, and with both cones falling.
                centre_radius: Some(if n[4] > 0.8 { -0.5 * corner_radius } else { radius * part }),
                centre_height: Some(between(5, -2.0, 5.0)),
                lower_angle: deg(between(3, -30.0, 50.0)),
                upper_angle: deg(between(1, 0.0, 40.0)),
                height: 5.0 + 3.0 * diameter,
                ..Apt::default()
            })
        }
    }
}

fn point(n: &[f64; 6], diameter: f64) -> DrillPoint {
    let deg = f64::to_radians;
    let angle = deg(80.0 + 80.0 * n[2]);
    match (12.0 * n[4]) as usize {
        0 => DrillPoint::SinglePlane { angle },
        1 => DrillPoint::DoubleGround { angle, second: deg(70.0) },
        2 => DrillPoint::CastIron {
            angle: deg(118.0),
            second: deg(70.0),
            third: deg(55.0),
            slot: 0.02 * diameter * n[5],
        },
        3 => DrillPoint::Rounded { radius: diameter * (0.5 + n[5]) },
        4 => DrillPoint::CornerRadius { angle, radius: 0.4 * diameter * (0.1 + n[5]) },
        5 => DrillPoint::ThinnedWeb { angle, flat: 0.1 * diameter * (0.1 + n[5]) },
        6 => DrillPoint::SlottedChisel { angle, slot: 0.1 * diameter * n[5] },
        7 => DrillPoint::Annular { core: 0.8 * diameter * (0.1 + n[5]) },
        8 => DrillPoint::Cannon { overlap: 0.1 * diameter * n[5], edge_angle: deg(80.0) },
        9 => DrillPoint::Gun {
            apex: Some(0.5 * diameter * n[5]),
            outer_angle: deg(60.0),
            inner_angle: deg(70.0),
        },
        10 => {
            let stage = |share: f64, length: f64| StepStage {
                diameter: share * diameter,
                length: length * diameter,
                shoulder: deg(120.0),
            };
            DrillPoint::Stepped { angle, stages: vec![stage(0.4, 1.0), stage(0.7, 2.0)] }
        }
        _ => DrillPoint::Flat,
    }
}

/// The place of a share of an element, and how it changes with the share.
fn at(shape: &ContourShape, s: f64) -> (DVec2, DVec2) {
    match *shape {
        ContourShape::Line { start, end } => (start + s * (end - start), end - start),
        ContourShape::Arc { centre, radius, convex, from, to } => {
            let r = if convex { radius } else { -radius };
            let phi = from + s * (to - from);
            let rate = r * (to - from);
            (centre + r * DVec2::new(phi.cos(), phi.sin()), rate * DVec2::new(-phi.sin(), phi.cos()))
        }
    }
}

/// Volume and surface by Simpson's rule along the elements.
fn integrals(contour: &Contour) -> [f64; 2] {
    const N: u32 = 400;
    let mut sums = [0.0; 2];
    for element in contour.elements() {
        for i in 0..=N {
            let weight = if i == 0 || i == N { 1.0 } else { f64::from(2 + 2 * (i % 2)) } / f64::from(3 * N);
            let (p, rate) = at(&element.shape, f64::from(i) / f64::from(N));
            sums[0] += weight * PI * p.x * p.x * rate.y;
            sums[1] += weight * 2.0 * PI * p.x * rate.length();
        }
    }
    sums
}

/// Whether a point lies in the half section: by how often a ray away from the axis crosses dense chords of the contour.
fn inside(contour: &Contour, p: DVec2) -> bool {
    const N: u32 = 100;
    let mut crossings = 0;
    for element in contour.elements() {
        for i in 0..N {
            let (a, b) = (
                at(&element.shape, f64::from(i) / f64::from(N)).0,
                at(&element.shape, f64::from(i + 1) / f64::from(N)).0,
            );
            if (a.y <= p.y) != (b.y <= p.y) && a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) > p.x {
                crossings += 1;
            }
        }
    }
    crossings % 2 == 1
}

/// Distance of a point from the contour, by dense points.
fn apart(contour: &Contour, p: DVec2) -> f64 {
    const N: u32 = 100;
    let points = contour
        .elements()
        .iter()
        .flat_map(|e| (0..=N).map(move |i| at(&e.shape, f64::from(i) / f64::from(N)).0));
    points.map(|q| q.distance(p)).fold(f64::INFINITY, f64::min)
}

const KINDS: usize = 21;

fn numbers() -> impl Strategy<Value = [f64; 6]> {
    prop::array::uniform6(0.0..1.0f64)
}

proptest! {
    #![proptest_config(kinecut_cases::property(600))]

    #[test]
    fn every_form_has_a_contour_and_its_measures_are_those_of_integrals(kind in 0..KINDS, n in numbers()) {
        let form = form(kind, &n);
        let contour = match form.contour() {
            Ok(contour) => contour,
            // Parameters of APT that leave no tool are named.
            Err(e) => {
                prop_assert!(matches!(form, ToolForm::Apt(_)) && e.code() == Code::TOOL_VALUE && e.0.key.is_some(), "{form:?} {e}");
                return Ok(());
            }
        };
        let [volume, surface] = integrals(&contour);
        prop_assert!((contour.volume() - volume).abs() < 1e-7 * volume, "{form:?}: {} {volume}", contour.volume());
        prop_assert!((contour.surface() - surface).abs() < 1e-7 * surface, "{form:?}: {} {surface}", contour.surface());
        let short = |e: &ContourElement| {
            let [a, b] = e.shape.normals();
            (b - a).abs() < PI + 1e-9 && a.abs() <= PI
        };
        prop_assert!(contour.elements().iter().all(short));
        let points = contour.points(1e-3);
        prop_assert!(points[0].x.abs() < 1e-12);
        // Through a file and back.
        let text = serde_json::to_string(&ContourFile::from(&contour)).unwrap();
        let again = serde_json::from_str::<ContourFile>(&text).unwrap().contour().unwrap();
        prop_assert_eq!(again.elements().len(), contour.elements().len());
        for (a, b) in again.elements().iter().zip(contour.elements()) {
            prop_assert!(a.shape.end().distance(b.shape.end()) < 1e-10 * contour.height().abs().max(1.0));
            prop_assert_eq!((a.role, a.body), (b.role, b.body));
        }
    }

}

proptest! {
    #![proptest_config(kinecut_cases::property(300))]

    #[test]
    fn the_radii_at_a_height_are_those_within(kind in 0..KINDS, n in numbers(), share in 0.0..1.0f64, out in 0.0..1.2f64) {
        let Ok(contour) = form(kind, &n).contour() else { return Ok(()) };
        let [low, high] = contour.extent();
        let p = DVec2::new(out * contour.largest_radius(), low + (high - low) * share);
        prop_assume!(apart(&contour, p) > 0.02 * contour.largest_radius());
        let radii = contour.radii_at(p.y);
        prop_assert_eq!(radii.iter().any(|[a, b]| (*a..*b).contains(&p.x)), inside(&contour, p), "{:?} {:?}", p, radii);
    }

    #[test]
    fn a_spoilt_contour_is_refused_where_it_is_spoilt(kind in 0..KINDS, n in numbers(), which in 0.0..1.0f64, how in 0..4usize) {
        let Ok(contour) = form(kind, &n).contour() else { return Ok(()) };
        let mut elements = contour.elements().to_vec();
        let i = (which * elements.len() as f64) as usize;
        let size = contour.largest_radius();
        match how {
            // A gap before the element.
            0 => match &mut elements[i].shape {
                ContourShape::Line { start, .. } => *start += 1e-6 * size,
                ContourShape::Arc { centre, .. } => *centre += 1e-6 * size,
            },
            1 => match &mut elements[i].shape {
                ContourShape::Line { start, .. } => start.x = f64::NAN,
                ContourShape::Arc { radius, .. } => *radius = -*radius,
            },
            // A way out and back again over the same line.
            2 => {
                let at = elements[i].shape.start();
                let to = at + DVec2::new(0.3 * size, 0.1 * size);
                let there = ContourElement { shape: ContourShape::Line { start: at, end: to }, role: ElementRole::Cutting, body: 0 };
                let back = ContourElement { shape: ContourShape::Line { start: to, end: at }, ..there };
                elements.splice(i..i, [there, back]);
            }
            _ => match &mut elements[i].shape {
                ContourShape::Line { start, end } => *end = *start,
                ContourShape::Arc { convex, .. } => *convex = !*convex,
            },
        }
        let error = Contour::new(elements).unwrap_err();
        prop_assert_eq!(error.code(), Code::CONTOUR);
        let key = error.0.key.clone().unwrap();
        if how != 2 {
            prop_assert_eq!(key, format!("elements[{i}]"), "{}", error);
        }
        prop_assert!(error.0.value.is_some() || how == 2, "{}", error);
    }

}

proptest! {
    #![proptest_config(kinecut_cases::property(120))]

    #[test]
    fn a_stack_fills_what_its_bodies_fill(
        bodies in prop::collection::vec((prop::sample::select(vec![0usize, 1, 2, 10]), numbers(), 0.0..1.0f64), 2..5),
        places in prop::collection::vec((0.0..1.0f64, 0.0..1.0f64), 40),
    ) {
        let mut stack: Vec<(Contour, f64)> = Vec::new();
        let mut top = 0.0;
        for (kind, n, overlap) in bodies {
            let body = form(kind, &n).contour().unwrap();
            // Touching, or sunk into the one below; what is round would hang on a point, or leave a cusp.
            let low = if overlap < 0.4 && kind == 0 { top } else { top * overlap };
            top = if low + body.height() > top { low + body.height() } else { top };
            stack.push((body, low));
        }
        let union = Contour::stack(&stack).unwrap();
        prop_assert!((union.height() - top).abs() < 1e-9);
        let raised: Vec<Contour> = stack.iter().map(|(c, by)| c.raised(*by).unwrap()).collect();
        let size = union.largest_radius();
        for (u, v) in places {
            let p = DVec2::new(u * 1.1 * size, v * top);
            if raised.iter().any(|c| apart(c, p) < 0.02 * size) {
                continue;
            }
            prop_assert_eq!(inside(&union, p), raised.iter().any(|c| inside(c, p)), "{:?} {:#?}", p, union);
        }
        // Everything of the boundary is of a body, and lies in no other.
        for e in union.elements() {
            let p = at(&e.shape, 0.37).0;
            prop_assert!(apart(&raised[usize::from(e.body)], p) < 0.02 * top);
        }
    }
}

#[test]
fn a_height_that_is_no_number_raises_nothing() {
    let mill = ToolForm::EndMill { diameter: 10.0, flute_length: 30.0 }.contour().unwrap();
    let up = mill.raised(7.5).unwrap();
    assert_eq!((up.bottom(), up.height(), up.largest_radius()), (7.5, 37.5, 5.0));
    for by in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let wrong = mill.raised(by).unwrap_err();
        assert_eq!(wrong.0.code, Code::CONTOUR);
        assert!(wrong.0.value.is_some(), "{wrong}");
        let wrong = Contour::stack(&[(mill.clone(), 0.0), (mill.clone(), by)]).unwrap_err();
        assert_eq!(wrong.0.key.as_deref(), Some("body[1]"), "{wrong}");
    }
    // 30 mm are lost in what lies 1e17 mm away, and in what overflows.
    for by in [1e17, -1e17, f64::MAX] {
        assert!(mill.raised(by).is_err(), "{by}");
    }
}

#[test]
fn numbers_that_make_no_tool_are_named() {
    let deg = f64::to_radians;
    let neck = 0.0;
    let wrong = [
        (ToolForm::EndMill { diameter: 0.0, flute_length: 5.0 }, "diameter"),
        (ToolForm::EndMill { diameter: 5.0, flute_length: f64::NAN }, "flute_length"),
        (ToolForm::BallNose { diameter: 10.0, flute_length: 4.0 }, "flute_length"),
        (ToolForm::BullNose { diameter: 10.0, corner_radius: 5.1, flute_length: 20.0 }, "corner_radius"),
        (ToolForm::BullNose { diameter: 10.0, corner_radius: -1.0, flute_length: 20.0 }, "corner_radius"),
        (
            ToolForm::Tapered { diameter: 0.0, corner_radius: 1.0, half_angle: deg(20.0), flute_length: 9.0 },
            "corner_radius",
        ),
        (
            ToolForm::Tapered { diameter: 2.0, corner_radius: 0.0, half_angle: deg(90.0), flute_length: 9.0 },
            "half_angle",
        ),
        (
            ToolForm::TaperedBall { ball_diameter: 2.0, half_angle: deg(10.0), flute_length: 0.5 },
            "flute_length",
        ),
        (ToolForm::Barrel { diameter: 10.0, profile_radius: 8.0, flute_length: 20.0 }, "profile_radius"),
        (ToolForm::Barrel { diameter: 10.0, profile_radius: 20.0, flute_length: 35.0 }, "flute_length"),
        (
            ToolForm::Oval {
                diameter: 10.0,
                profile_radius: 85.0,
                tip_radius: 6.0,
                neck_diameter: 8.0,
                neck_length: 60.0,
            },
            "tip_radius",
        ),
        (
            ToolForm::Oval {
                diameter: 10.0,
                profile_radius: 85.0,
                tip_radius: 2.0,
                neck_diameter: 12.0,
                neck_length: 60.0,
            },
            "neck_diameter",
        ),
        (
            ToolForm::Tangent { diameter: 10.0, profile_radius: 4.0, tip_radius: 2.0, flute_length: 60.0 },
            "profile_radius",
        ),
        (
            ToolForm::Tangent { diameter: 10.0, profile_radius: 85.0, tip_radius: 2.0, flute_length: 2.0 },
            "flute_length",
        ),
        (
            ToolForm::Taper {
                diameter: 10.0,
                profile_radius: 85.0,
                tip_radius: 2.0,
                half_angle: 0.0,
                flute_length: 60.0,
            },
            "half_angle",
        ),
        (
            ToolForm::Lens { diameter: 10.0, profile_radius: 4.0, corner_radius: 1.0, flute_length: 9.0 },
            "profile_radius",
        ),
        (ToolForm::Lollipop { diameter: 10.0, neck_diameter: 11.0, neck_length: 30.0 }, "neck_diameter"),
        (
            ToolForm::Dovetail {
                diameter: 10.0,
                angle: deg(30.0),
                corner_radius: 0.0,
                height: 5.0,
                neck_diameter: neck,
                neck_length: 9.0,
            },
            "height",
        ),
        (
            ToolForm::TSlot {
                diameter: 20.0,
                height: 4.0,
                corner_radius: 2.5,
                neck_diameter: 8.0,
                neck_length: 30.0,
            },
            "corner_radius",
        ),
        (
            ToolForm::TSlot {
                diameter: 20.0,
                height: 4.0,
                corner_radius: 1.0,
                neck_diameter: 8.0,
                neck_length: 3.0,
            },
            "neck_length",
        ),
        (
            ToolForm::Convex { diameter: 20.0, profile_radius: 11.0, neck_diameter: neck, neck_length: 30.0 },
            "profile_radius",
        ),
        (
            ToolForm::Concave {
                diameter: 4.0,
                profile_radius: 3.0,
                height: 6.0,
                neck_diameter: neck,
                neck_length: 9.0,
            },
            "diameter",
        ),
        (
            ToolForm::Countersink {
                diameter: 20.0,
                angle: deg(180.0),
                nose_diameter: 0.0,
                flute_length: 20.0,
            },
            "angle",
        ),
        (
            ToolForm::HollowMill { diameter: 20.0, core_diameter: 14.0, depth: 30.0, flute_length: 30.0 },
            "flute_length",
        ),
        (
            ToolForm::CornerRounding {
                tip_diameter: 4.0,
                tip_length: 1.0,
                radius: 3.0,
                diameter: Some(9.0),
                length: 20.0,
            },
            "diameter",
        ),
        (
            ToolForm::Dished {
                diameter: 10.0,
                dish_angle: deg(-5.0),
                corner_radius: 0.0,
                flute_length: 20.0,
            },
            "dish_angle",
        ),
    ];
    for (form, key) in wrong {
        let error = form.contour().unwrap_err();
        assert_eq!(
            (error.code(), error.0.key.as_deref()),
            (Code::TOOL_VALUE, Some(key)),
            "{form:?}: {error}"
        );
        assert!(error.0.value.is_some() && error.0.bound.is_some(), "{error}");
    }
}

/// All legal cases of the seven parameters: what the contour must begin and end with.
#[test]
fn parameters_of_apt_may_be_none_or_negative() {
    let deg = f64::to_radians;
    let apt = |r: f64, e: f64, f: f64, a: f64, b: f64, h: f64| Apt {
        corner_radius: r,
        centre_radius: Some(e),
        centre_height: Some(f),
        lower_angle: deg(a),
        upper_angle: deg(b),
        height: h,
        ..Apt::default()
    };
    let count = |a: Apt| a.contour().unwrap().elements().len();
    // An edge, a ball, a cone alone, a corner cut by the top, a body that falls in.
    assert_eq!(count(apt(0.0, 5.0, 0.0, 0.0, 0.0, 20.0)), 3);
    assert_eq!(count(apt(5.0, 0.0, 5.0, 0.0, 0.0, 20.0)), 3);
    assert_eq!(count(apt(0.0, 0.0, 0.0, 0.0, 30.0, 20.0)), 2);
    assert_eq!(count(apt(5.0, 3.0, 5.0, 0.0, 0.0, 4.0)), 3);
    let falling = apt(2.0, 8.0, 2.0, 0.0, -20.0, 12.0).contour().unwrap();
    assert!(falling.largest_radius() == 10.0 && falling.elements().len() == 4);
    // A hollow end: the axis is the highest of it.
    assert!(apt(1.0, 4.0, 1.0, -10.0, 0.0, 20.0).contour().unwrap().bottom() > 0.5);
    // The corner itself meets the axis.
    let pointed = apt(50.0, -40.0, 30.0, 0.0, 0.0, 60.0).contour().unwrap();
    assert!(pointed.bottom().abs() < 1e-12);
    assert!((pointed.largest_radius() - 10.0).abs() < 1e-12);
    assert!((apt(0.0, 5.0, 0.0, 0.0, 0.0, 20.0).cone_diameter() - 10.0).abs() < 1e-12);
    let wrong = [
        (apt(-1.0, 5.0, 0.0, 0.0, 0.0, 20.0), "corner_radius"),
        (apt(1.0, -5.0, 0.0, 0.0, 0.0, 20.0), "centre_radius"),
        (apt(1.0, 5.0, 1.0, 60.0, 40.0, 20.0), "upper_angle"),
        (apt(1.0, 5.0, 1.0, 90.0, 0.0, 20.0), "lower_angle"),
        (apt(1.0, 5.0, 1.0, 0.0, 0.0, -1.0), "height"),
        (apt(1.0, 5.0, 1.0, 0.0, -45.0, 20.0), "height"),
        (apt(1.0, 5.0, f64::NAN, 0.0, 0.0, 20.0), "centre_height"),
    ];
    for (a, key) in wrong {
        let error = a.contour().unwrap_err();
        assert_eq!((error.code(), error.0.key.as_deref()), (Code::TOOL_VALUE, Some(key)), "{a:?}: {error}");
    }
}

#[test]
fn circle_segment_cutters_are_tangent_where_ball_and_profile_meet() {
    let forms = [
        ToolForm::Oval {
            diameter: 10.0,
            profile_radius: 85.0,
            tip_radius: 2.0,
            neck_diameter: 8.0,
            neck_length: 60.0,
        },
        ToolForm::Tangent { diameter: 10.0, profile_radius: 85.0, tip_radius: 2.0, flute_length: 60.0 },
        ToolForm::Taper {
            diameter: 10.0,
            profile_radius: 250.0,
            tip_radius: 1.0,
            half_angle: 0.35,
            flute_length: 60.0,
        },
        ToolForm::Lens { diameter: 16.0, profile_radius: 40.0, corner_radius: 1.0, flute_length: 20.0 },
    ];
    for form in &forms {
        let contour = form.contour().unwrap();
        let shapes: Vec<ContourShape> = contour.elements().iter().map(|e| e.shape).collect();
        let jump = shapes[1].normals()[0] - shapes[0].normals()[1];
        assert!(jump.abs() < 1e-12 && shapes[0].end().distance(shapes[1].start()) < 1e-12, "{form:?}");
        assert!(contour.extent()[0].abs() < 1e-12);
    }
    // The widest of the oval form is its diameter, though its neck is thinner.
    let oval = forms[0].contour().unwrap();
    assert!((oval.largest_radius() - 5.0).abs() < 1e-12 && oval.radii_at(59.0) == [[0.0, 4.0]]);
    // The profile of the conical form ends at its diameter, leaning by the angle.
    let ContourShape::Arc { to, .. } = forms[2].contour().unwrap().elements()[1].shape else { panic!() };
    assert!((to + 0.35).abs() < 1e-15);
    assert!((forms[2].contour().unwrap().elements()[1].shape.end().x - 5.0).abs() < 1e-12);
}

#[test]
fn a_holder_may_narrow_and_a_shank_may_be_wider_than_the_cutter() {
    let cutting = ToolForm::BallNose { diameter: 6.0, flute_length: 10.0 }.contour().unwrap();
    let segment = |height, lower_diameter, upper_diameter| HolderSegment {
        height,
        lower_diameter,
        upper_diameter: Some(upper_diameter),
    };
    let whole = Assembly {
        cutting: cutting.clone(),
        shank_diameter: Some(8.0),
        stickout: 25.0,
        holder: vec![segment(10.0, 30.0, 20.0), segment(5.0, 40.0, 40.0)],
    };
    let contour = whole.contour().unwrap();
    assert_eq!(contour.radii_at(35.0 - 1e-9).len(), 1);
    assert!((contour.radii_at(30.0)[0][1] - 12.5).abs() < 1e-12);
    let roles: Vec<ElementRole> = contour.elements().iter().map(|e| e.role).collect();
    use ElementRole::{Cutting as C, Holder as H, Shank as S};
    assert_eq!(roles, [C, C, S, S, H, H, H, H, H]);
    let gap = Assembly { shank_diameter: None, ..whole.clone() };
    assert_eq!(gap.contour().unwrap_err().0.key.as_deref(), Some("stickout"));
    let short = Assembly { stickout: 9.0, ..whole };
    assert_eq!(short.contour().unwrap_err().0.key.as_deref(), Some("stickout"));
    let apart = Contour::stack(&[(cutting.clone(), 0.0), (cutting, 10.5)]).unwrap_err();
    assert_eq!((apart.code(), apart.0.key.as_deref()), (Code::CONTOUR, Some("body[1]")));
    assert!(Contour::stack(&[]).is_err());
}
