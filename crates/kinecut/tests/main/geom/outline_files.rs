//! Outlines from files: golden polygons, the same part in every form, and files that are damaged.

use std::f64::consts::PI;
use std::fmt::Write;

use kinecut::geom::{LengthUnit, OutlineOptions, OutlineRead, read_outline};
use proptest::prelude::*;

fn read(name: &str, text: &str) -> OutlineRead {
    read_outline(name, text.as_bytes(), &OutlineOptions::default()).unwrap()
}

/// A plate of 60 x 40 with round ends of radius 20, a bore of 8 and a slot, in each form.
const JSON: &str = r#"{ "unit": "cm", "loops": [
    [[0, 0], [6, 0, 1], [6, 4], [0, 4, 1]],
    {"centre": [1, 2], "radius": 0.8, "label": "bore"},
    {"label": "slot", "points": [[3, 1], [5, 1, 1], [5, 2], [3, 2, 1]]}
]}"#;

const SVG: &str = r#"<?xml version="1.0"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">
<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="80mm" viewBox="0 0 1200 800">
  <g transform="translate(200,600) scale(10,-10)">
    <path d="M0 0 H60 A20,20 0 0 1 60,40 L0,40 a20 20 0 0 1 0 -40 z"/>
    <circle id="bore" cx="10" cy="20" r="8"/>
    <path id="slot" d="M30 10 h20 a5 5 0 0 1 0 10 h-20 a5 5 0 0 1 0,-10"/>
  </g>
</svg>"#;

fn dxf() -> String {
    let words = "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 ENTITIES \
        0 LINE 8 rim 10 0 20 0 11 60 21 0 0 ARC 8 rim 10 60 20 20 40 20 50 270 51 90 \
        0 LINE 8 rim 10 0 20 40.002 11 60 21 40 0 ARC 8 rim 10 0 20 20 40 20 50 90 51 270 \
        0 CIRCLE 8 bore 10 10 20 20 40 8 0 TEXT 8 words 1 PLATE \
        0 LWPOLYLINE 8 slot 90 4 70 1 10 30 20 10 10 50 20 10 42 1 10 50 20 20 10 30 20 20 42 1 0 ENDSEC 0 EOF";
    words.split_whitespace().fold(String::new(), |mut text, word| {
        writeln!(text, "{word}").unwrap();
        text
    })
}

#[test]
fn golden_polygons_written_as_json_are_read_bit_for_bit() {
    for (name, polygon) in &crate::common::burr_golden::Golden::read().polygons {
        let text = serde_json::json!({ "loops": polygon.loops }).to_string();
        let read = read("part.json", &text);
        let outline = polygon.outline();
        assert_eq!(read.outline.edges().len(), outline.edges().len(), "{name}");
        for (a, b) in read.outline.edges().iter().zip(outline.edges()) {
            assert_eq!((a.start, a.end), (b.start, b.end), "{name}");
        }
        assert!((read.outline.perimeter() - polygon.optima[0].perimeter).abs() < 1e-9 * outline.perimeter());
    }
}

#[test]
fn one_part_is_the_same_in_every_form() {
    let area = 2400.0 + 400.0 * PI - 64.0 * PI - (200.0 + 25.0 * PI);
    let perimeter = 120.0 + 40.0 * PI + 16.0 * PI + 40.0 + 10.0 * PI;
    for (name, text) in [("part.json", JSON.to_owned()), ("part.SVG", SVG.to_owned()), ("part.dxf", dxf())] {
        let read = read(name, &text);
        let outline = &read.outline;
        assert_eq!(outline.edges().iter().filter(|e| e.turn.is_some()).count(), 5, "{name}");
        assert_eq!(outline.edges().len(), 9, "{name}");
        // One end of the drawing is off by 0.002 mm.
        let slack = if name == "part.dxf" { 0.2 } else { 1e-8 };
        assert!((outline.area() - area).abs() < slack, "{name} {}", outline.area());
        assert!((outline.perimeter() - perimeter).abs() < slack, "{name}");
        let bore = outline.edges().iter().position(|e| e.turn.is_some_and(|t| t.sweep.abs() > 6.0)).unwrap();
        assert_eq!(outline.label(bore), Some("bore"), "{name}");
        let outer = outline.loops().iter().filter(|l| l.outer).count();
        assert_eq!((outer, outline.loops().len()), (1, 3), "{name}");
    }
}

#[test]
fn a_caller_may_say_the_unit_and_no_other_endings_are_read() {
    let inch = OutlineOptions { unit: Some(LengthUnit::Inch), ..OutlineOptions::default() };
    let [x0, x1] = read_outline("p.json", JSON.as_bytes(), &inch).unwrap().outline.extent(glam::DVec2::X);
    assert!((x1 - x0 - 10.0 * 25.4).abs() < 1e-9);
    let error = read_outline("part.step", b"ISO-10303-21;", &inch).unwrap_err().to_string();
    assert!(error.contains("part.step") && error.contains("\"step\""), "{error}");
    let bad = OutlineOptions { curve_tolerance: 0.0, ..OutlineOptions::default() };
    assert!(
        read_outline("p.json", JSON.as_bytes(), &bad).unwrap_err().to_string().contains("curve tolerance")
    );
}

/// Curves beside the part, which the damage shall meet too.
const CURVES: &str = r#"</g><g id="more" transform="rotate(3) matrix(1 0 .1 1 700 0)" style="fill:red">
  <path d="M0 0C10 0 20 10 20 20S30 50 40 40Q50 30 60 40T90 20L90 -20A60 30 15 0 1 5-10z"/>
  <ellipse cx="50" cy="300" rx="30" ry="20"/><polygon points="0,500 30,500 30,520"/><text>x</text></g>"#;

fn curves_dxf() -> String {
    let words = "0 ELLIPSE 8 e 10 300 20 0 11 16 21 12 40 0.5 41 0 42 6.283185307179586 \
        0 POLYLINE 8 p 66 1 70 1 0 VERTEX 10 200 20 0 42 0.3 0 VERTEX 10 220 20 0 0 VERTEX 10 220 20 9 0 SEQEND \
        0 SPLINE 8 s 70 8 71 3 72 8 73 4 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 10 400 20 0 10 400 20 20 \
        10 440 20 20 10 440 20 0 0 LINE 8 s 10 400 20 0 11 440 21 0 230 -1 0 ENDSEC";
    let more = words.split_whitespace().collect::<Vec<_>>().join("\n");
    let plain = dxf();
    let at = plain.rfind("0\nENDSEC").unwrap();
    format!("{}{more}{}", &plain[..at], &plain[at + "0\nENDSEC".len()..])
}

/// A wedge as STL text.
fn stl() -> String {
    let corners = ["0 0 0", "9 0 0", "9 9 0", "0 9 0", "0 0 5", "9 0 5", "9 9 5", "0 9 5"];
    let sides =
        [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7]];
    let more = [[2, 7, 6], [3, 0, 4], [3, 4, 7]];
    let facet = |t: &[usize; 3]| {
        let vertices: String = t.iter().map(|&i| format!("vertex {}\n", corners[i])).collect();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let facets: String = sides.iter().chain(&more).map(facet).collect();
    format!("solid box\n{facets}endsolid box\n")
}

#[test]
fn the_files_to_be_damaged_are_sound() {
    assert_eq!(read("p.svg", &SVG.replace("</g>", CURVES)).outline.loops().len(), 6);
    assert_eq!(read("p.dxf", &curves_dxf()).outline.loops().len(), 6);
    assert_eq!(read("p.stl", &stl()).outline.area(), 81.0);
}

/// Words that upset readers.
const WORDS: [&str; 22] = [
    "nan",
    "inf",
    "1e308",
    "-1e308",
    "1e-320",
    "99999999999999999999",
    "-1",
    "0",
    "1",
    "2",
    "10",
    "42",
    "70",
    "",
    "\n",
    "<g>",
    "]",
    "{",
    "\"",
    "0\nPOLYLINE\n",
    "A",
    "\u{fffd}",
];

#[derive(Clone, Debug)]
enum Damage {
    Byte(f64, u8),
    Cut(f64, f64),
    Twice(f64, f64),
    Word(f64, usize),
    End(f64),
}

fn damage() -> impl Strategy<Value = Damage> {
    let at = || 0.0..1.0f64;
    prop_oneof![
        (at(), any::<u8>()).prop_map(|(a, b)| Damage::Byte(a, b)),
        (at(), 0.0..0.1f64).prop_map(|(a, l)| Damage::Cut(a, l)),
        (at(), 0.0..0.2f64).prop_map(|(a, l)| Damage::Twice(a, l)),
        (at(), 0..WORDS.len()).prop_map(|(a, w)| Damage::Word(a, w)),
        at().prop_map(Damage::End),
    ]
}

/// Applies a damage; words replace a whole word of the text.
fn damaged(mut bytes: Vec<u8>, damage: &Damage) -> Vec<u8> {
    let n = bytes.len();
    let place = |a: f64| (a * n as f64) as usize;
    let span = |a: f64, l: f64| place(a)..place(a + l).clamp(place(a), n);
    match *damage {
        _ if n == 0 => {}
        Damage::Byte(a, b) => bytes[place(a)] = b,
        Damage::Cut(a, l) => drop(bytes.drain(span(a, l))),
        Damage::Twice(a, l) => {
            let copy = bytes[span(a, l)].to_vec();
            bytes.splice(place(a)..place(a), copy);
        }
        Damage::Word(a, w) => {
            let ends = |b: &u8| b.is_ascii_whitespace() || b",\"'[]{}<>()".contains(b);
            let from = bytes[..place(a)].iter().rposition(ends).map_or(0, |i| i + 1);
            let to = bytes[place(a)..].iter().position(ends).map_or(n, |i| i + place(a));
            bytes.splice(from..to.max(from), WORDS[w].bytes());
        }
        Damage::End(a) => bytes.truncate(place(a)),
    }
    bytes
}

proptest! {
    #![proptest_config(kinecut_cases::property(400))]

    /// Whatever a file holds, it is an outline that is valid, or an error in words.
    #[test]
    fn damaged_files_are_outlines_or_errors(
        form in 0..4usize,
        damages in prop::collection::vec(damage(), 1..4),
    ) {
        let (name, text) = match form {
            0 => ("p.json", JSON.to_owned()),
            1 => ("p.svg", SVG.replace("</g>", CURVES)),
            2 => ("p.dxf", curves_dxf()),
            _ => ("p.stl", stl()),
        };
        let bytes = damages.iter().fold(text.into_bytes(), damaged);
        match read_outline(name, &bytes, &OutlineOptions::default()) {
            Ok(read) => {
                prop_assert_eq!(read.weights.len(), read.outline.edges().len());
                prop_assert!(read.outline.perimeter().is_finite() && !read.outline.edges().is_empty());
            }
            Err(error) => prop_assert!(!error.to_string().is_empty() && error.0.place.is_some(), "{error}"),
        }
    }
}
