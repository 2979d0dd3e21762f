use std::f64::consts::PI;
use std::fmt::Write;

use super::*;
use crate::base::Code;

/// A drawing with entities given as "CODE VALUE CODE VALUE ..." words, in mm.
fn drawing(entities: &[&str]) -> String {
    let mut text = String::from(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n0\nLINE\n8\nX\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n",
    );
    for words in entities {
        for word in words.split_whitespace() {
            writeln!(text, "  {word}").unwrap();
        }
    }
    text + "  0\nENDSEC\n  0\nEOF\n"
}

fn read_with(entities: &[&str], options: &OutlineOptions) -> Result<OutlineRead> {
    read_dxf("part.dxf", drawing(entities).as_bytes(), options)
}

fn read(entities: &[&str]) -> Result<OutlineRead> {
    read_with(entities, &OutlineOptions::default())
}

fn refused(entities: &[&str], code: Code, words: &[&str]) {
    let error = read(entities).unwrap_err();
    let text = error.to_string();
    assert_eq!(error.code(), code, "{text}");
    assert!(words.iter().all(|w| text.contains(w)), "{text}");
}

const SQUARE: &str = "0 LWPOLYLINE 8 rim 90 4 70 1 10 0 20 0 10 40 20 0 10 40 20 30 42 1 10 0 20 30";
const LEFT: &str = "0 LINE 8 A 10 0 20 0 11 0 21 30";
const TOP: &str = "0 LINE 8 A 10 0 20 30 11 40 21 30";
const RIGHT: &str = "0 LINE 8 B 10 40 20 0 11 40 21 30";
const BOTTOM: &str = "0 LINE 8 B 10 0 20 0 11 40 21 0";

#[test]
fn polylines_keep_their_bulges_and_layers_are_labels() {
    let read = read(&[SQUARE, "0 CIRCLE 8 bore 10 10 20 10 40 5"]).unwrap();
    // The bulge 1 is a half circle over the upper side.
    assert!((read.outline.area() - (1200.0 + PI * 200.0 - PI * 25.0)).abs() < 1e-9);
    assert_eq!(read.outline.edges().len(), 5);
    assert_eq!(read.outline.label(4), Some("bore"));
    assert_eq!(read.outline.label(0), Some("rim"));
    assert!(read.weights.iter().all(|&w| w == 1.0) && read.notes.is_empty(), "{:?}", read.notes);
}

#[test]
fn old_polylines_are_read_like_light_ones() {
    let old = "0 POLYLINE 8 rim 66 1 70 1 10 0 20 0 30 0 0 VERTEX 8 rim 10 0 20 0 0 VERTEX 8 rim 10 40 20 0 \
               0 VERTEX 8 rim 10 40 20 30 42 1 0 VERTEX 8 rim 10 0 20 30 0 SEQEND 8 rim";
    let (old, light) = (read(&[old]).unwrap(), read(&[SQUARE]).unwrap());
    assert_eq!(old.outline, light.outline);
}

#[test]
fn lines_and_arcs_in_any_order_and_direction_close_within_the_snap() {
    let arc = "0 ARC 8 A 10 40.003 20 15 40 15 50 -90 51 90";
    let read = read(&[TOP, arc, BOTTOM, LEFT]).unwrap();
    assert!((read.outline.area() - (1200.0 + 0.5 * PI * 225.0)).abs() < 0.2);
    // The arc stays as drawn: the lines come to it.
    let arc = read.outline.edges().iter().find_map(|e| e.turn).unwrap();
    assert!((arc.radius - 15.0).abs() < 1e-12 && (arc.centre.x - 40.003).abs() < 1e-12);
    assert!(read.notes[0].contains("2 joints") && read.notes[0].contains("3.00e-3"), "{:?}", read.notes);
}

#[test]
fn a_gap_is_named_with_place_width_and_entities() {
    let short = "0 LINE 8 B 10 40 20 0.37 11 40 21 30";
    refused(
        &[LEFT, TOP, short, BOTTOM],
        Code::OUTLINE_OPEN,
        &["(40.0000, 0.3700)", "(40.0000, 0.0000)", "0.37 mm", "LINE of \"B\"", "2 open ends", "part.dxf:"],
    );
    let wide = OutlineOptions { snap: 0.4, ..OutlineOptions::default() };
    assert!(read_with(&[LEFT, TOP, short, BOTTOM], &wide).is_ok());
    // The line of the first open end.
    let text = drawing(&[LEFT, TOP, short, BOTTOM]);
    let error = read_dxf("part.dxf", text.as_bytes(), &OutlineOptions::default()).unwrap_err();
    let line = error.0.place.unwrap().line as usize;
    assert_eq!(text.lines().nth(line - 1).unwrap().trim(), "LINE");
    assert_eq!(text.lines().nth(line + 1).unwrap().trim(), "B");
}

#[test]
fn a_branch_is_named() {
    let inner = "0 LINE 8 C 10 0 20 0 11 20 21 15";
    refused(&[LEFT, TOP, RIGHT, BOTTOM, inner], Code::OUTLINE_OPEN, &["3 ends meet at (0.0000, 0.0000)"]);
}

#[test]
fn what_is_drawn_twice_is_left_out_and_said() {
    let back = "0 LINE 8 A 10 0 20 30 11 0 21 0";
    let circle = "0 CIRCLE 8 A 10 10 20 10 40 5";
    let half = "0 ARC 8 C 10 10 20 10 40 5 50 0 51 360";
    let once = read(&[LEFT, TOP, RIGHT, BOTTOM, circle]).unwrap();
    let twice = read(&[LEFT, TOP, back, RIGHT, BOTTOM, circle, half]).unwrap();
    assert_eq!(once.outline.edges().len(), twice.outline.edges().len());
    assert_eq!(twice.notes.iter().filter(|n| n.contains("repeats")).count(), 2, "{:?}", twice.notes);
}

#[test]
fn entities_seen_from_below_are_mirrored() {
    // The same D shape drawn from above, and from below with X turned round.
    let above = ["0 LWPOLYLINE 8 0 70 1 10 0 20 0 10 9 20 0 42 0.4 10 9 20 6 10 0 20 6"];
    let below =
        ["0 LWPOLYLINE 8 0 70 1 10 0 20 0 10 -9 20 0 42 -0.4 10 -9 20 6 10 0 20 6 210 0 220 0 230 -1"];
    assert_eq!(read(&above).unwrap().outline, read(&below).unwrap().outline);
    // A quarter circle in the first quadrant of its own coordinates lies in the second of the drawing.
    let arc = "0 ARC 8 0 10 0 20 0 40 10 50 0 51 90 230 -1.0";
    let (a, b) = ("0 LINE 8 0 10 0 20 0 11 -10 21 0", "0 LINE 8 0 10 0 20 0 11 0 21 10");
    let quarter = read(&[arc, a, b]).unwrap().outline;
    assert!((quarter.area() - 25.0 * PI).abs() < 1e-9);
    assert!(quarter.extent(glam::DVec2::X)[1] < 1e-9);
    refused(&["0 CIRCLE 8 0 10 0 20 0 40 1 210 1 220 0 230 0"], Code::OUTLINE_FILE, &["XY plane", "90 deg"]);
}

#[test]
fn ellipses_and_splines_stand_as_arcs() {
    let ellipse = "0 ELLIPSE 8 0 10 5 20 5 11 16 21 12 40 0.5 41 0 42 6.283185307179586";
    let whole = read(&[ellipse]).unwrap();
    assert!((whole.outline.area() - PI * 200.0).abs() < 0.3, "{}", whole.outline.area());
    assert!(whole.notes[0].contains("1 ellipses and splines"), "{:?}", whole.notes);
    // The upper half, closed by a line along the long axis; from below the lower half.
    let half =
        |n: &str| format!("0 ELLIPSE 8 0 10 0 20 0 11 20 21 0 40 0.5 41 0 42 3.141592653589793 230 {n}");
    let line = "0 LINE 8 0 10 -20 20 0 11 20 21 0";
    for (normal, low, high) in [("1", 0.0, 10.0), ("-1", -10.0, 0.0)] {
        let outline = read(&[&half(normal), line]).unwrap().outline;
        let [y0, y1] = outline.extent(glam::DVec2::Y);
        assert!((y0 - low).abs() < 0.01 && (y1 - high).abs() < 0.01, "{y0} {y1}");
    }
    let spline = "0 SPLINE 8 0 70 8 71 3 72 8 73 4 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 \
                  10 0 20 0 10 0 20 20 10 40 20 20 10 40 20 0";
    let outline = read(&[spline, BOTTOM]).unwrap().outline;
    // Area under the curve x = 120 t^2 - 80 t^3, y = 60 t (1 - t): integral of y dx.
    assert!((outline.area() - 480.0).abs() < 0.2, "{}", outline.area());
    let passing = "0 SPLINE 8 0 71 3 11 0 21 0 11 9 21 9";
    refused(&[passing], Code::OUTLINE_FILE, &["points to pass", "convert"]);
}

#[test]
fn blocks_are_refused_by_name_and_texts_passed_over() {
    refused(&["0 INSERT 8 0 2 BOLT 10 0 20 0"], Code::OUTLINE_FILE, &["no block \"BOLT\""]);
    let read =
        read(&["0 TEXT 8 0 1 plate", SQUARE, "0 DIMENSION 8 0 10 1", "0 POINT 10 1 20 1", "0 POINT 8 0"]);
    let notes = read.unwrap().notes;
    assert_eq!(notes, ["1 DIMENSION passed over", "2 POINT passed over", "1 TEXT passed over"]);
    refused(&["0 TEXT 8 0 1 plate"], Code::OUTLINE_FILE, &["no lines or arcs", "1 TEXT passed over"]);
}

#[test]
fn layers_may_be_chosen() {
    let inner = "0 LINE 8 C 10 0 20 0 11 20 21 15";
    let only = |layers: &[&str]| OutlineOptions {
        layers: layers.iter().map(|&l| l.to_owned()).collect(),
        ..OutlineOptions::default()
    };
    let drawn = [LEFT, TOP, RIGHT, BOTTOM, inner];
    let read = read_with(&drawn, &only(&["A", "B"])).unwrap();
    assert_eq!(read.outline.labels(), ["A", "B"]);
    assert_eq!(read.notes, ["layer \"C\": 1 entities passed over"]);
    let error = read_with(&drawn, &only(&["D"])).unwrap_err().to_string();
    assert!(error.contains("\"D\"") && error.contains("\"A\", \"B\", \"C\""), "{error}");
}

#[test]
fn units_are_the_drawings_or_the_callers_never_a_guess() {
    let with = |unit: &str| drawing(&[SQUARE]).replace("70\n4\n", &format!("70\n{unit}\n"));
    let width = |text: &str, options: &OutlineOptions| {
        let [x0, x1] = read_dxf("part.dxf", text.as_bytes(), options)?.outline.extent(glam::DVec2::X);
        Ok::<_, crate::base::Error>(x1 - x0)
    };
    let free = OutlineOptions::default();
    for (unit, mm) in [("1", 25.4), ("4", 1.0), ("5", 10.0), ("6", 1000.0)] {
        assert!((width(&with(unit), &free).unwrap() - 40.0 * mm).abs() < 1e-9);
    }
    for unit in ["0", "20"] {
        let error = width(&with(unit), &free).unwrap_err().to_string();
        assert!(error.contains("unknown units"), "{error}");
    }
    let inch = OutlineOptions { unit: Some(LengthUnit::Inch), ..OutlineOptions::default() };
    assert!((width(&with("0"), &inch).unwrap() - 1016.0).abs() < 1e-9);
}

#[test]
fn crossings_are_named_by_their_entities() {
    let circle = "0 CIRCLE 8 bore 10 0 20 10 40 5";
    refused(
        &[SQUARE, circle],
        Code::OUTLINE_CROSSES,
        &["LWPOLYLINE of \"rim\" in line", "CIRCLE of \"bore\" in line", "meet at (0.0000, "],
    );
}

#[test]
fn files_that_are_no_dxf_text_are_told_apart() {
    let options = OutlineOptions::default();
    let refused = |bytes: &[u8], words: &str| {
        let error = read_dxf("part.dxf", bytes, &options).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(b"AutoCAD Binary DXF\r\n\x1a\x00\x00\x00SECTION", "binary DXF");
    refused(b"AC1027\x00\x00", "DWG");
    refused(b"", "no section ENTITIES");
    refused(b"hello", "group code is expected");
    refused(b"0\nSECTION\n2\nENTITIES\n0\nLINE\n8", "ends in a group");
    refused(b"0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n", "ends before");
    let bad = drawing(&["0 CIRCLE 8 0 10 0 20 abc 40 5"]);
    let error = read_dxf("part.dxf", bad.as_bytes(), &options).unwrap_err();
    let line = error.0.place.as_ref().unwrap().line as usize;
    assert!(error.to_string().contains("\"abc\"") && bad.lines().nth(line - 1).unwrap().contains("abc"));
    // Carriage returns are as good.
    let dos = drawing(&[SQUARE]).replace('\n', "\r\n");
    assert!(read_dxf("part.dxf", dos.as_bytes(), &options).is_ok());
}

/// A drawing with blocks, in mm.
fn with_blocks(blocks: &[&str], entities: &[&str]) -> String {
    let empty = "0\nLINE\n8\nX\n0\nENDSEC\n";
    let words: Vec<String> = blocks.join(" ").split_whitespace().map(str::to_owned).collect();
    drawing(entities).replacen(empty, &format!("{}\n0\nENDSEC\n", words.join("\n")), 1)
}

fn read_blocks(blocks: &[&str], entities: &[&str]) -> Result<OutlineRead> {
    read_dxf("part.dxf", with_blocks(blocks, entities).as_bytes(), &OutlineOptions::default())
}

/// A square of 10 with a corner of 2 rounded and a bore of 4 in it, from (0, 0); its base point is (1, 2).
const PART: &str = "0 BLOCK 8 0 2 PART 70 0 10 1 20 2 30 0 3 PART \
    0 LWPOLYLINE 8 0 90 5 70 1 10 0 20 0 10 10 20 0 10 10 20 10 10 2 20 10 42 0.414213562373095 10 0 20 8 \
    0 CIRCLE 8 bore 10 5 20 5 40 2 0 ENDBLK 8 0";

#[test]
fn blocks_stand_where_they_are_inserted() {
    let area = 100.0 - (4.0 - PI) - 4.0 * PI;
    for (insert, scale, low, high) in [
        ("10 0 20 0", 1.0, (-1.0, -2.0), (9.0, 8.0)),
        // Twice as large, turned by a quarter.
        ("10 100 20 50 41 2 42 2 43 2 50 90", 4.0, (84.0, 48.0), (104.0, 68.0)),
        // Mirrored, and seen from below.
        ("10 100 20 50 41 -1", 1.0, (91.0, 48.0), (101.0, 58.0)),
        ("10 100 20 50 210 0 220 0 230 -1", 1.0, (-109.0, 48.0), (-99.0, 58.0)),
    ] {
        let read = read_blocks(&[PART], &[&format!("0 INSERT 8 steel 2 PART {insert}")]).unwrap();
        assert!((read.outline.area() - scale * area).abs() < 1e-9, "{insert}: {}", read.outline.area());
        let [min, max] = read.outline.bounds();
        assert!(min.distance(low.into()) < 1e-9 && max.distance(high.into()) < 1e-9, "{insert}: {min} {max}");
        // Layer 0 of a block is the layer on which it is inserted; arcs stay arcs.
        let label = |label: &str| {
            (0..read.outline.edges().len()).filter(|e| read.outline.label(*e) == Some(label)).count()
        };
        assert_eq!((label("steel"), label("bore"), label("0")), (5, 1, 0), "{insert}");
    }
}

#[test]
fn blocks_are_stretched_nested_and_repeated() {
    // 3 in X and 2 in Y: the bore is an ellipse.
    let read = read_blocks(&[PART], &["0 INSERT 8 A 2 PART 10 0 20 0 41 3 42 2 50 30"]).unwrap();
    let area = 100.0 - (4.0 - PI) - 4.0 * PI;
    assert!((read.outline.area() - 6.0 * area).abs() < 0.5 && read.outline.edges().len() > 10);
    let wide = OutlineOptions { curve_tolerance: 1e-5, ..OutlineOptions::default() };
    let fine = with_blocks(&[PART], &["0 INSERT 8 A 2 PART 10 0 20 0 41 3 42 2 50 30"]);
    let fine = read_dxf("part.dxf", fine.as_bytes(), &wide).unwrap();
    assert!((fine.outline.area() - 6.0 * area).abs() < 1e-3, "{}", fine.outline.area() - 6.0 * area);
    // Two columns and three rows of a block with a block in it, each turned.
    let pair = "0 BLOCK 8 0 2 PAIR 70 0 10 0 20 0 0 INSERT 8 0 2 PART 10 0 20 0 0 INSERT 8 0 2 PART 10 20 20 0 50 180 0 ENDBLK 8 0";
    let rows = "0 INSERT 8 A 2 PAIR 10 5 20 5 50 90 70 2 71 3 44 60 45 40";
    let read = read_blocks(&[PART, pair], &[rows]).unwrap();
    assert_eq!(read.outline.loops().len(), 2 * 2 * 2 * 3);
    assert!((read.outline.area() - 12.0 * area).abs() < 1e-8);
    let [min, max] = read.outline.bounds();
    // Columns run along the turned X.
    assert!(
        (max.y - min.y - (60.0 + 22.0)).abs() < 1e-9 && (max.x - min.x - (80.0 + 16.0)).abs() < 1e-9,
        "{min} {max}"
    );
}

#[test]
fn blocks_that_cannot_be_inserted_are_refused_with_their_line() {
    let refused = |blocks: &[&str], entities: &[&str], words: &[&str]| {
        let error = read_blocks(blocks, entities).unwrap_err();
        let text = error.to_string();
        assert!(words.iter().all(|w| text.contains(w)), "{text}");
    };
    refused(&[PART], &["0 INSERT 8 A 2 OTHER 10 0 20 0"], &["no block \"OTHER\""]);
    refused(&[PART], &["0 INSERT 8 A 2 PART 10 0 20 0 41 0"], &["size 0"]);
    let own = "0 BLOCK 8 0 2 OWN 70 0 10 0 20 0 0 INSERT 8 0 2 OWN 10 0 20 0 0 ENDBLK 8 0";
    refused(&[own], &["0 INSERT 8 A 2 OWN 10 0 20 0"], &["contains itself"]);
    let other = "0 BLOCK 8 0 2 XREF 70 4 10 0 20 0 1 other.dwg 0 ENDBLK 8 0";
    refused(&[other], &["0 INSERT 8 A 2 XREF 10 0 20 0"], &["in another file"]);
    // On a layer that is not asked for neither matters.
    let frame =
        with_blocks(&[other], &[SQUARE, "0 INSERT 8 A 2 XREF 10 0 20 0", "0 INSERT 8 A 2 GONE 10 0 20 0"]);
    let rim = OutlineOptions { layers: vec!["rim".to_owned()], ..OutlineOptions::default() };
    let read = read_dxf("part.dxf", frame.as_bytes(), &rim).unwrap();
    assert_eq!(read.outline.edges().len(), 4);
    assert!(read.notes.iter().any(|note| note.starts_with("2 INSERT")), "{:?}", read.notes);
    refused(&[PART], &["0 INSERT 8 A 2 PART 10 0 20 0 70 30000 71 30000"], &["too many entities"]);
    // Each contains the next ten times: counted, not made.
    let chain: Vec<String> = (0..12)
        .map(|i| {
            let inside = format!("0 INSERT 8 0 2 B{} 10 0 20 0 70 10", i + 1);
            let inside = if i == 11 { "0 CIRCLE 8 0 10 0 20 0 40 1".to_owned() } else { inside };
            format!("0 BLOCK 8 0 2 B{i} 70 0 10 0 20 0 {inside} 0 ENDBLK 8 0")
        })
        .collect();
    let chain: Vec<&str> = chain.iter().map(String::as_str).collect();
    refused(&chain, &["0 INSERT 8 A 2 B0 10 0 20 0"], &["too many entities"]);
}

#[test]
fn entities_without_length_are_passed_over_with_their_line() {
    let rest = [
        SQUARE,
        "0 CIRCLE 8 bore 10 10 20 10 40 0",
        "0 ARC 8 A 10 40 20 0 40 0 50 0 51 90",
        "0 LINE 8 A 10 3 20 3 11 3 21 3",
        "0 LWPOLYLINE 8 A 90 2 70 0 10 5 20 5 10 5 20 5",
        "0 ELLIPSE 8 A 10 5 20 5 11 0 21 0 40 0.5 41 0 42 6.283185307179586",
        "0 SPLINE 8 A 71 3 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 10 7 20 7 10 7 20 7 10 7 20 7 10 7 20 7",
    ];
    let all = read(&rest).unwrap();
    assert_eq!(
        all.outline,
        read(&[SQUARE])
            .unwrap()
            .outline
            .relabelled(|_| all.outline.edges()[0].label, all.outline.labels().to_vec())
    );
    assert_eq!(all.notes.len(), 6, "{:?}", all.notes);
    let first = "CIRCLE of \"bore\" in line 52 has no length and is passed over";
    assert_eq!(all.notes[0], first);
    assert!(all.notes[5].contains("1 more"), "{:?}", all.notes);
    // Between ends that meet it is no loss; where they do not, the gap is named.
    let point = "0 ARC 8 A 10 40 20 30 40 0 50 0 51 90";
    assert!(read(&[LEFT, TOP, RIGHT, BOTTOM, point]).is_ok());
    refused(&[LEFT, TOP, BOTTOM, point], Code::OUTLINE_OPEN, &["open"]);
    refused(&["0 CIRCLE 8 bore 10 10 20 10 40 -1"], Code::OUTLINE_EDGE, &["radius", "negative"]);
}
