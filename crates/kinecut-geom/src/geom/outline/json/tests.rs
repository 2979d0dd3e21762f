use super::super::OutlineReads;
use super::*;

fn read(text: &str) -> Result<OutlineRead> {
    read_json("plate.json", text.as_bytes(), &OutlineOptions::default())
}

#[test]
fn labels_weights_and_units_stay_with_their_edges_whichever_way_the_loop_runs() {
    let text = r#"{
        "about": "a plate", "unit": "in", "weights": {"seal": 5},
        "loops": [
            [[0, 0], {"x": 4, "y": 0, "label": "seal"}, {"x": 4, "y": 3, "bulge": 0.5, "weight": 0.25}, [0, 3], [0, 0]],
            {"centre": [2, 1.5], "radius": 0.5, "label": "seal"},
            {"points": [[0.2, 0.2], [0.4, 0.2], {"x": 0.4, "y": 0.4, "label": "mark"}], "label": "rest", "weight": 0}
        ]
    }"#;
    let read = read(text).unwrap();
    let outline = &read.outline;
    assert!((outline.extent(DVec2::X)[1] - 101.6).abs() < 1e-12);
    // The outer loop was drawn counter-clockwise: its edges are turned round, and the weights with them.
    for (i, edge) in outline.edges()[..4].iter().enumerate() {
        let middle = edge.at(0.5) / 25.4;
        let (label, weight) = if (middle.x - 4.0).abs() < 1e-9 {
            (Some("seal"), 5.0)
        } else if edge.turn.is_some() {
            (None, 0.25)
        } else {
            (None, 1.0)
        };
        assert_eq!((outline.label(i), read.weights[i]), (label, weight), "{middle}");
    }
    assert_eq!(outline.label(4), Some("seal"));
    assert_eq!(read.weights[4..], [5.0, 0.0, 0.0, 0.0]);
    let labels: Vec<_> = (5..8).filter_map(|i| outline.label(i)).collect();
    assert_eq!((labels.len(), labels.contains(&"mark")), (3, true));
    assert!(outline.loops()[0].outer && !outline.loops()[1].outer && !outline.loops()[2].outer);
}

#[test]
fn mistakes_are_named_with_their_line_or_key() {
    let refused = |text: &str, words: &[&str]| {
        let error = read(text).unwrap_err().to_string();
        assert!(words.iter().all(|w| error.contains(w)), "{error}");
    };
    refused("{\n \"loops\": [[[0,0],\n  [1,\"a\"]]]}", &["plate.json:3", "string"]);
    refused("{\n \"loop\": []}", &["plate.json:2", "unknown field `loop`"]);
    refused("{\"loops\": [[[0,0],[1,0,0,4],[1,1]]]}", &["loops[0][1]", "4 numbers"]);
    refused("{\"loops\": [{\"centre\": [0,0]}]}", &["loops[0]", "either `points`"]);
    refused("{\"loops\": [{\"centre\": [0,0], \"radius\": -1}]}", &["loops[0]", "-1 mm"]);
    refused("{\"loops\": [], \"weights\": {\"a\": -1}}", &["weights.a"]);
    refused("{\"loops\": []}", &["no lines or arcs"]);
    refused("{\"loops\": [[[0,0],[4,0],[0,4],[4,4]]]}", &["loops[0][", "meet at (2.0000, 2.0000)"]);
    refused("{\"loops\": [[[0,0],[4,0],[4,0],[0,4]]]}", &["loops[0][1]", "no length"]);
    refused("{\"unit\": \"ell\", \"loops\": []}", &["plate.json:1", "unknown variant `ell`"]);
}

#[test]
fn a_file_written_is_the_file_read() {
    let table = OutlinePoint { x: 1.0, y: 2.0, bulge: 0.5, label: Some("a".into()), weight: None };
    let file = OutlineFile {
        about: None,
        unit: Some(LengthUnit::Centimetre),
        loops: vec![
            LoopEntry::Points(vec![
                PointEntry::Numbers(vec![0.0, 0.0]),
                PointEntry::Table(table),
                PointEntry::Numbers(vec![0.0, 1.0, -0.1]),
            ]),
            LoopEntry::Table(LoopTable {
                centre: Some([9.0, 9.0]),
                radius: Some(1.0),
                ..LoopTable::default()
            }),
        ],
        lines: vec![LoopEntry::Points(vec![
            PointEntry::Numbers(vec![20.0, 0.0, 1.0]),
            PointEntry::Numbers(vec![22.0, 0.0, 1.0]),
            PointEntry::Numbers(vec![20.0, 0.0]),
        ])],
        weights: BTreeMap::new(),
    };
    let text = serde_json::to_string(&file).unwrap();
    assert_eq!(serde_json::from_str::<OutlineFile>(&text).unwrap(), file);
    assert_eq!(read(&text).unwrap(), file.outline(&OutlineOptions::default()).unwrap());
}

#[test]
fn the_schema_knows_both_forms_of_points() {
    let schema = schemars::schema_for!(OutlineFile).to_value().to_string();
    for word in ["bulge", "centre", "weights", "minItems", "unit"] {
        assert!(schema.contains(word), "{word}");
    }
}

#[test]
fn open_lines_are_read_in_their_direction_and_have_to_close_where_a_face_is_wanted() {
    let text = r#"{ "unit": "cm", "loops": [{"centre": [9, 9], "radius": 1}],
        "lines": [[[3, 0], [1, 0, 1], [1, 2]], {"points": [[0, 5], [4, 5]], "label": "mark", "weight": 2}] }"#;
    let of = |reads| {
        read_json("plate.json", text.as_bytes(), &OutlineOptions { reads, ..OutlineOptions::default() })
    };
    let lines = of(OutlineReads::Lines).unwrap();
    let all: Vec<&[OutlineEdge]> = lines.outline.lines().collect();
    assert_eq!(all.iter().map(|l| l.len()).collect::<Vec<_>>(), [2, 1]);
    assert_eq!((all[0][0].start, all[0][1].end), (DVec2::new(30.0, 0.0), DVec2::new(10.0, 20.0)));
    // A half circle to the right of the way from (10, 0) to (10, 20).
    assert!((all[0][1].at(0.5) - DVec2::new(20.0, 10.0)).length() < 1e-12);
    assert_eq!(lines.outline.label(lines.outline.edges().len() - 1), Some("mark"));
    assert!(lines.notes.iter().any(|n| n.contains("passed over")), "{:?}", lines.notes);
    // With the circle as a line that ends where it begins.
    let drawn = of(OutlineReads::Drawn).unwrap().outline;
    let length: f64 = drawn.lines().flatten().map(OutlineEdge::length).sum();
    let pi = std::f64::consts::PI;
    assert!((length - (20.0 + 10.0 * pi + 40.0 + 20.0 * pi)).abs() < 1e-9, "{length}");
    let open = of(OutlineReads::Loops).unwrap_err();
    assert_eq!(open.code(), Code::OUTLINE_OPEN, "{open}");
    assert!(open.to_string().contains("lines["), "{open}");
    // Two lines that close.
    let closed = r#"{ "lines": [[[0, 0], [4, 0], [4, 3]], [[0, 0], [4, 3]]] }"#;
    assert_eq!(read(closed).unwrap().outline.area(), 6.0);
    let refused = |lines: &str, words: &str| {
        let error = read(&format!(r#"{{ "lines": [{lines}] }}"#)).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused("[[0, 0]]", "lines[0]: a line has two points at least");
    refused(r#"{"centre": [0, 0], "radius": 1}"#, "belongs to `loops`");
    refused("[[0, 0], [1]]", "lines[0][1]");
}

#[test]
fn lines_that_branch_and_cross_are_read_where_a_cutter_runs_on_them() {
    let text = r#"{ "lines": [[[0, 0], [4, 0]], [[4, 0], [8, 4]], [[4, 0], [8, -4]], [[2, -2], [2, 2]]] }"#;
    let of = |reads| {
        read_json("letter.json", text.as_bytes(), &OutlineOptions { reads, ..OutlineOptions::default() })
    };
    assert_eq!(of(OutlineReads::Drawn).unwrap().outline.lines().count(), 4);
    assert_eq!(of(OutlineReads::Lines).unwrap_err().code(), Code::OUTLINE_OPEN);
}

#[test]
fn layers_are_the_labels_of_loops() {
    let text = r#"{ "loops": [{"centre": [0, 0], "radius": 1, "label": "seal"}, [[5, 0], [9, 0], [9, 4]]] }"#;
    let of = |layer: &str| {
        let options = OutlineOptions { layers: vec![layer.to_owned()], ..OutlineOptions::default() };
        read_json("plate.json", text.as_bytes(), &options)
    };
    assert!((of("seal").unwrap().outline.area() - std::f64::consts::PI).abs() < 1e-12);
    let error = of("gasket").unwrap_err();
    assert!(error.0.help.contains("\"seal\"") && error.0.key.as_deref() == Some("layers"), "{error}");
}
