//! Half a section as a drawing, in every way it is drawn.

use kinecut::base::Code;
use kinecut::geom::{OutlineOptions, SectionAxis};
use kinecut::tool::{Contour, ContourRead, ContourShape, ElementRole, ToolForm};

use crate::common::drawing::dxf;

fn read(entities: &str, axis: SectionAxis) -> Result<ContourRead, kinecut::base::Error> {
    let options = OutlineOptions { half_section: Some(axis), ..OutlineOptions::default() };
    ContourRead::of_drawing("tool.dxf", &dxf(entities), &options)
}

/// A bull-nose cutter of 10 mm with a corner of 2 mm, by its dimensions.
fn bull() -> Contour {
    ToolForm::BullNose { diameter: 10.0, corner_radius: 2.0, flute_length: 30.0 }.contour().unwrap()
}

fn same(a: &Contour, b: &Contour) {
    assert_eq!(a.elements().len(), b.elements().len(), "{a:#?}");
    for (e, f) in a.elements().iter().zip(b.elements()) {
        assert!(e.shape.start().distance(f.shape.start()) < 1e-9, "{e:?} {f:?}");
        assert!(e.shape.end().distance(f.shape.end()) < 1e-9, "{e:?} {f:?}");
        let ([p, q], [r, s]) = (e.shape.normals(), f.shape.normals());
        assert!((p - r).abs() < 1e-9 && (q - s).abs() < 1e-9, "{e:?} {f:?}");
        assert_eq!(matches!(e.shape, ContourShape::Arc { .. }), matches!(f.shape, ContourShape::Arc { .. }));
        assert_eq!(e.role, f.role);
    }
}

#[test]
fn a_half_section_is_read_however_it_is_drawn() {
    // Lines and an arc in any order and direction, about Y; the centre line is drawn, and longer than the tool.
    let open = "0 LINE 8 cutting 10 5 20 30 11 5 21 2 0 ARC 8 cutting 10 3 20 2 40 2 50 270 51 360 \
        0 LINE 8 cutting 10 3 20 0 11 0 21 0 0 LINE 8 shank 10 5 20 30 11 0 21 30 0 LINE 8 centre 10 0 20 -5 11 0 21 99";
    same(&read(open, SectionAxis::Y).unwrap().contour, &bull());
    // A closed polyline with the axis as its last side, the corner as a bulge; both ways round, and left of the axis.
    let bulge = 0.41421356237309503;
    let closed =
        format!("0 LWPOLYLINE 90 5 70 1 10 0 20 0 10 3 20 0 42 {bulge} 10 5 20 2 10 5 20 30 10 0 20 30");
    same(&read(&closed, SectionAxis::Y).unwrap().contour, &bull());
    let back =
        format!("0 LWPOLYLINE 90 5 70 1 10 0 20 30 10 5 20 30 10 5 20 2 42 -{bulge} 10 3 20 0 10 0 20 0");
    same(&read(&back, SectionAxis::Y).unwrap().contour, &bull());
    let left =
        format!("0 LWPOLYLINE 90 5 70 0 10 0 20 0 10 -3 20 0 42 -{bulge} 10 -5 20 2 10 -5 20 30 10 0 20 30");
    same(&read(&left, SectionAxis::Y).unwrap().contour, &bull());
    // The same lying along X, above and below it.
    let above =
        format!("0 LWPOLYLINE 90 5 70 0 10 0 20 0 10 0 20 3 42 -{bulge} 10 2 20 5 10 30 20 5 10 30 20 0");
    same(&read(&above, SectionAxis::X).unwrap().contour, &bull());
    let below =
        format!("0 LWPOLYLINE 90 5 70 1 10 30 20 0 10 30 20 -5 10 2 20 -5 42 -{bulge} 10 0 20 -3 10 0 20 0");
    same(&read(&below, SectionAxis::X).unwrap().contour, &bull());
}

#[test]
fn layers_say_what_a_part_is_there_for() {
    let drawn = "0 ARC 8 Cutting 10 0 20 4 40 4 50 270 51 60 0 LINE 8 SHANK 10 2 20 7.464101615137754 11 2 21 25 \
        0 LINE 8 holder 10 2 20 25 11 9 21 25 0 LINE 8 holder 10 9 20 25 11 9 21 40 0 LINE 8 paint 10 9 20 40 11 0 21 40";
    let ContourRead { contour, notes } = read(drawn, SectionAxis::Y).unwrap();
    let roles: Vec<(ElementRole, u16)> = contour.elements().iter().map(|e| (e.role, e.body)).collect();
    use ElementRole::{Cutting as C, Holder as H, Shank as S};
    // The face at the top is held, whatever its layer.
    assert_eq!(roles, [(C, 0), (S, 1), (H, 2), (H, 2), (S, 2)]);
    assert_eq!(notes, ["layer \"paint\" is taken as cutting"]);
}

#[test]
fn what_is_no_half_section_is_refused_with_its_place() {
    let refused = |entities: &str, code: Code, words: &[&str]| {
        let error = read(entities, SectionAxis::Y).unwrap_err();
        assert_eq!(error.code(), code, "{error}");
        assert!(error.0.place.is_some(), "{error}");
        for word in words {
            assert!(error.to_string().contains(word), "{error}");
        }
    };
    // Open aside of the axis, drawn on both sides of it, crossing itself, a second contour, nothing on the axis.
    let aside =
        "0 LINE 8 a 10 0 20 0 11 5 21 0 0 LINE 8 b 10 5 20 0 11 5 21 30 0 LINE 8 c 10 5 20 30 11 0.5 21 30";
    refused(aside, Code::OUTLINE_OPEN, &["aside of the axis", "LINE of \"c\" in line", "0.5 mm"]);
    let both = "0 LWPOLYLINE 90 4 70 1 10 -5 20 0 10 5 20 0 10 5 20 30 10 -5 20 30";
    refused(both, Code::CONTOUR, &["no edge on the axis", "draw one half"]);
    let crossed =
        "0 LWPOLYLINE 90 5 70 0 10 0 20 0 10 5 20 0 10 5 20 9 10 3 20 9 10 6 20 6 10 6 20 30 10 0 20 30";
    refused(crossed, Code::OUTLINE_CROSSES, &["LWPOLYLINE", "meet at (5.0000, 7.0000)"]);
    let two = "0 LWPOLYLINE 90 4 70 1 10 0 20 0 10 5 20 0 10 5 20 30 10 0 20 30 0 CIRCLE 10 50 20 9 40 3";
    refused(two, Code::CONTOUR, &["more than one contour"]);
    let over = "0 LWPOLYLINE 90 4 70 0 10 0 20 0 10 5 20 0 10 -5 20 30 10 0 20 30";
    refused(over, Code::OUTLINE_CROSSES, &[]);
}
