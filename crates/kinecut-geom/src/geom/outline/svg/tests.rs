use std::f64::consts::PI;

use super::*;
use crate::base::Code;
use crate::geom::LengthUnit;

fn page_of(body: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:inkscape='{INKSCAPE}' width='200mm' height='100mm' \
         viewBox='0 0 200 100'>\n{body}\n</svg>"
    )
}

fn read(body: &str) -> Result<OutlineRead> {
    read_svg("part.svg", page_of(body).as_bytes(), &OutlineOptions::default())
}

fn refused(body: &str, words: &[&str]) {
    let error = read(body).unwrap_err().to_string();
    assert!(words.iter().all(|w| error.contains(w)), "{error}");
}

/// Area, and box.
fn measures(body: &str) -> (f64, [DVec2; 2]) {
    let outline = read(body).unwrap().outline;
    (outline.area(), outline.bounds())
}

#[test]
fn y_points_upwards_from_the_lower_left_corner_of_the_page() {
    let (area, [low, high]) = measures("<path d='M10 80 h40 v-30 l-40 0 Z'/>");
    assert!((area - 1200.0).abs() < 1e-9);
    assert!(low.distance(DVec2::new(10.0, 20.0)) < 1e-9 && high.distance(DVec2::new(50.0, 50.0)) < 1e-9);
}

#[test]
fn circular_arcs_stay_one_exact_arc() {
    // A D: relative arc, by its long and its short way.
    for (flags, area) in [("0 1", 0.5 * PI * 100.0), ("1 1", 0.5 * PI * 100.0)] {
        let body = format!("<path d='M50 30 a10,10 0 {flags} 0,20 z'/>");
        let outline = read(&body).unwrap().outline;
        assert_eq!(outline.edges().len(), 2);
        assert!((outline.area() - area).abs() < 1e-9, "{flags}");
    }
    // Radius 10 over a chord of 10: the long way round is 300 degrees.
    let outline = read("<path d='M50 50 A10 10 0 1 0 60 50 Z'/>").unwrap().outline;
    let turn = outline.edges().iter().find_map(|e| e.turn).unwrap();
    assert!((turn.sweep.abs().to_degrees() - 300.0).abs() < 1e-9 && (turn.radius - 10.0).abs() < 1e-12);
    // Sweep 0 goes counter-clockwise on the screen: from (50, 50) over the lower side.
    assert!(outline.bounds()[0].y < 35.0 && outline.bounds()[1].y < 50.0 + 1e-9);
    // A radius that is too small grows.
    let (area, _) = measures("<path d='M50 30 a1,1 0 0 1 0,20 z'/>");
    assert!((area - 50.0 * PI).abs() < 1e-6, "{area}");
}

#[test]
fn shapes_have_their_areas() {
    let cases = [
        ("<rect x='1' y='2' width='30' height='20'/>", 600.0, 4),
        ("<rect x='1' y='2' width='30' height='20' rx='5'/>", 600.0 - (4.0 - PI) * 25.0, 8),
        ("<rect x='1' y='2' width='30' height='20' rx='5' ry='99'/>", 600.0 - (4.0 - PI) * 50.0, 0),
        ("<circle cx='50' cy='50' r='10'/>", 100.0 * PI, 1),
        ("<ellipse cx='50' cy='50' rx='20' ry='10'/>", 200.0 * PI, 0),
        ("<polygon points='0,0 40,0 40,30'/>", 600.0, 3),
        ("<polyline points='0,0 40,0 40,30 0,0'/>", 600.0, 3),
        (
            "<line x1='0' y1='0' x2='40' y2='0'/><line x1='0' x2='40' y2='30'/><line x1='40' x2='40' y2='30'/>",
            600.0,
            3,
        ),
        ("<path d='M0 0 Q20 40 40 0 Z'/>", 2.0 / 3.0 * 40.0 * 20.0, 0),
        ("<path d='M0 50 q10 20 20 0 t20 0 v30 h-40 Z'/>", 1200.0, 0),
        ("<path d='M0 50 C0 70 20 70 20 50 S40 30 40 50 L40 90 L0 90 Z'/>", 1600.0, 0),
    ];
    for (body, area, edges) in cases {
        let outline = read(body).unwrap().outline;
        // Arcs leave curves by 0.005 mm at most.
        let slack = if edges > 0 { 1e-9 } else { 0.005 * outline.perimeter() };
        assert!((outline.area() - area).abs() <= slack, "{body} {}", outline.area());
        assert!(edges == 0 || outline.edges().len() == edges, "{body} {}", outline.edges().len());
    }
}

#[test]
fn transforms_of_groups_move_turn_mirror_and_scale() {
    let shape = "<path d='M10 0 A10 10 0 0 1 0 10 L0 0 Z'/>";
    let quarter = 25.0 * PI;
    let with = |t: &str| format!("<g transform='{t}'><g transform='translate(20,20)'>{shape}</g></g>");
    for (t, scale) in [("rotate(33 5 6)", 1.0), ("scale(-2,2)", 4.0), ("matrix(0 3 3 0 1 2)", 9.0)] {
        let outline = read(&with(t)).unwrap().outline;
        assert_eq!(outline.edges().len(), 3, "{t}");
        assert!((outline.area() - scale * quarter).abs() < 1e-9 * scale, "{t}");
    }
    // A circle that is squeezed is an ellipse.
    let read = read(&with("scale(1,0.5)")).unwrap();
    assert!((read.outline.area() - 0.5 * quarter).abs() < 0.05);
    assert!(read.notes.iter().any(|n| n.contains("1 curves stand as arcs")));
    refused(&with("scale(0,1)"), &["leaves nothing"]);
    refused(&with("turn(3)"), &["transform", "part.svg:"]);
    refused("<g style='transform:rotate(3deg)'/>", &["transform in a style"]);
}

#[test]
fn a_circle_of_four_cubics_is_four_arcs() {
    let k = 10.0 * 4.0 / 3.0 * (2f64.sqrt() - 1.0);
    let (a, b) = (50.0 - k, 50.0 + k);
    let body = format!("<path d='M60 50 C60 {b} {b} 60 50 60 S40 {b} 40 50 S{a} 40 50 40 S60 {a} 60 50 Z'/>");
    let outline = read(&body).unwrap().outline;
    assert!(outline.edges().len() <= 8, "{}", outline.edges().len());
    assert!((outline.area() - 100.0 * PI).abs() < 0.2);
}

#[test]
fn labels_are_names_of_elements_or_of_the_groups_around_them() {
    let body = "<g inkscape:label='faces' id='layer1'>\
        <path id='path12' d='M0 0 H90 V90 H0 Z'/>\
        <circle id='seal' cx='20' cy='20' r='5'/>\
        <circle class='bolt small' id='x' cx='50' cy='20' r='5'/>\
        <circle inkscape:label='pin' class='bolt' cx='50' cy='50' r='5'/></g>\
        <circle id='circle9' cx='150' cy='50' r='5'/>";
    let outline = read(body).unwrap().outline;
    let labels: Vec<_> = (3..9).map(|i| outline.label(i)).collect();
    assert_eq!(labels, [Some("faces"), Some("seal"), Some("bolt"), Some("pin"), None, None]);
    let options = OutlineOptions { layers: vec!["bolt".into()], ..OutlineOptions::default() };
    let chosen = read_svg("part.svg", page_of(body).as_bytes(), &options).unwrap().outline;
    assert_eq!(chosen.edges().len(), 2);
    let options = OutlineOptions { layers: vec!["nut".into()], ..OutlineOptions::default() };
    let error = read_svg("part.svg", page_of(body).as_bytes(), &options).unwrap_err().to_string();
    assert!(error.contains("\"nut\"") && error.contains("\"seal\""), "{error}");
}

#[test]
fn units_come_from_the_page_or_the_caller_never_a_guess() {
    let width = |head: &str, unit: Option<LengthUnit>| {
        let text =
            format!("<svg xmlns='http://www.w3.org/2000/svg' {head}><rect width='40' height='30'/></svg>");
        let options = OutlineOptions { unit, ..OutlineOptions::default() };
        let [x0, x1] = read_svg("part.svg", text.as_bytes(), &options)?.outline.extent(DVec2::X);
        Ok::<_, crate::base::Error>(x1 - x0)
    };
    let near = |head: &str, mm: f64| assert!((width(head, None).unwrap() - mm).abs() < 1e-9, "{head}");
    near("width='80mm' height='60mm' viewBox='0 0 80 60'", 40.0);
    near("width='80mm' viewBox='0 0 800 600'", 4.0);
    near("width='8in' height='6in' viewBox='0 0 80 60'", 101.6);
    near("width='96px' height='96px' viewBox='0 0 96 96'", 40.0 / 96.0 * 25.4);
    near("width='96px' height='96px'", 40.0 / 96.0 * 25.4);
    near("width='8cm' height='90mm' viewBox='0 0 80 60'", 40.0);
    for head in ["", "width='80' height='60'", "viewBox='0 0 80 60'", "width='100%' viewBox='0 0 80 60'"] {
        assert!(width(head, None).unwrap_err().to_string().contains("unknown units"), "{head}");
        assert!((width(head, Some(LengthUnit::Centimetre)).unwrap() - 400.0).abs() < 1e-9);
    }
    let stretched = "width='80mm' height='90mm' viewBox='0 0 80 60' preserveAspectRatio='none'";
    assert!(width(stretched, None).unwrap_err().to_string().contains("stretched"));
}

#[test]
fn what_cannot_be_read_is_refused_or_said() {
    let square = "<path d='M0 0 H90 V90 H0 Z'/>";
    refused(&format!("{square}<use href='#a'/>"), &["use", "unlink", "part.svg:2"]);
    refused("<path d='M0 0 H90 V90'/>", &["gap", "path in line 2"]);
    refused("<path d='M0 0 H90 V'/>", &["path", "not well formed"]);
    refused("<circle cx='1' r='0'/>", &["radius"]);
    refused("<circle cx='1em' r='3'/>", &["cx is relative"]);
    refused("<path d='M0 0 C 10 0 -5 0 5 0 L 5 5 Z'/>", &["path"]);
    refused("", &["no lines or arcs"]);
    let read = read(&format!(
        "{square}<text>plate</text><image/><defs><path d='M0 0 H1'/></defs>\
         <rect style='fill:red; display : none' width='3' height='3'/><g clip-path='url(#c)'/>"
    ));
    assert_eq!(
        read.unwrap().notes,
        [
            "1 clip-path of a g passed over",
            "1 image passed over",
            "1 invisible rect passed over",
            "1 text passed over"
        ]
    );
    let error = read_svg("part.svg", b"<svg>\n<g></svg>", &OutlineOptions::default()).unwrap_err();
    assert!(error.to_string().contains("part.svg:2") && error.code() == Code::OUTLINE_FILE, "{error}");
}

#[test]
fn deep_nesting_is_no_danger() {
    let depth = 20_000;
    let body = format!("{}<circle r='3'/>{}", "<g>".repeat(depth), "</g>".repeat(depth));
    // Read or refused, but nothing breaks.
    drop(read(&body));
}
