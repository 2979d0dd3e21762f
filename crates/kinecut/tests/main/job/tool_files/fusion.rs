//! Libraries of Fusion.

use std::io::{Cursor, Write as _};

use kinecut::job::file::ToolType;
use kinecut::tool::Hand;
use serde_json::{Value, json};
use zip::write::SimpleFileOptions;

use super::{lacks, near, read, wrong};

fn library(tools: Vec<Value>) -> String {
    json!({ "data": tools, "version": 1 }).to_string()
}

/// A mill with all that a tool may have.
fn mill() -> Value {
    json!({
        "type": "flat end mill", "unit": "millimeters", "description": "Mill ten", "vendor": "A shop", "guid": "0-1",
        "BMC": "carbide", "product-link": "",
        "geometry": { "DC": 10, "LCF": 20, "LB": 40, "OAL": 75, "SFDM": 10, "NOF": 3, "HAND": true, "RE": 0, "CSP": false,
                      "shoulder-length": 25, "assemblyGaugeLength": 120 },
        "holder": { "unit": "millimeters", "description": "Collet", "gaugeLength": 80, "type": "holder", "vendor": "B",
                    "segments": [{ "height": 10, "lower-diameter": 20, "upper-diameter": 30 },
                                 { "height": 40, "lower-diameter": 50, "upper-diameter": 50 }] },
        "post-process": { "number": 7, "comment": "", "live": true, "length-offset": 7 },
        "start-values": { "presets": [
            { "name": "rough", "material": { "query": "C45" }, "n": 4774.648, "v_c": 150, "f_z": 0.05, "v_f": 716.2,
              "f_n": 0.15, "use-feed-per-revolution": false, "tool-coolant": "flood" },
            { "name": "Brass", "n": 5000, "v_c": 900, "f_z": 0.04 }] }
    })
}

#[test]
fn every_field_is_taken_or_named() {
    let library = read("a.json", library(vec![mill()])).unwrap();
    let (tool, table) = (&library.tools[0], &library.tools[0].table);
    assert_eq!((table.number, table.kind, table.name.as_deref()), (7, ToolType::EndMill, Some("Mill ten")));
    // The stick-out is the body length, not the overall one.
    assert_eq!((table.diameter, table.flute_length, table.stickout), (10.0, 20.0, Some(40.0)));
    assert_eq!((table.teeth, table.shank_diameter, table.gauge_length), (Some(3), Some(10.0), Some(120.0)));
    assert!(tool.missing.is_empty() && library.faults().is_empty(), "{:?}", library.faults());
    // The first segment is the one at the tool.
    let holder = &library.holders[0];
    assert_eq!((table.holder.as_deref(), holder.name.as_str()), (Some("Collet"), "Collet"));
    assert_eq!(
        holder.segments.iter().map(|s| (s.height, s.lower_diameter, s.upper())).collect::<Vec<_>>(),
        [(10.0, 20.0, 30.0), (40.0, 50.0, 50.0)]
    );
    let [rough, brass] = &table.presets[..] else { panic!("{:?}", table.presets) };
    assert_eq!((rough.material.as_str(), rough.name.as_deref()), ("C45", Some("rough")));
    assert_eq!((rough.cutting_speed, rough.speed, rough.feed_per_tooth), (Some(150.0), None, Some(0.05)));
    // A cutting speed that is not that of the turns has another unit: the turns are taken.
    assert_eq!((brass.material.as_str(), brass.cutting_speed, brass.speed), ("Brass", None, Some(5000.0)));
    let mut wanted = [
        "BMC",
        "geometry.OAL",
        "geometry.shoulder-length",
        "guid",
        "holder.vendor",
        "post-process.length-offset",
        "post-process.live",
        "start-values.presets.f_n",
        "start-values.presets.tool-coolant",
        "start-values.presets.v_c",
        "vendor",
    ]
    .map(str::to_owned);
    wanted.sort();
    let mut dropped = tool.dropped.clone();
    dropped.sort();
    assert_eq!(dropped, wanted);
}

#[test]
fn tools_and_holders_have_units_of_their_own() {
    let mut tool = mill();
    tool["unit"] = "inches".into();
    tool["geometry"]["DC"] = json!(0.5);
    let read_again = read("a.json", library(vec![tool.clone()])).unwrap();
    let table = &read_again.tools[0].table;
    assert!(
        near(table.diameter, 12.7)
            && near(table.flute_length, 508.0)
            && near(table.gauge_length.unwrap(), 3048.0)
    );
    assert!(near(table.presets[0].feed_per_tooth.unwrap(), 1.27));
    assert_eq!(read_again.holders[0].segments[0].height, 10.0);
    // 900 is the speed of neither unit; the speed of the first preset was that of 10 mm.
    assert!(table.presets.iter().all(|p| p.cutting_speed.is_none()));
    // An expression for a number that is no longer true.
    tool["expressions"] = json!({ "tool_diameter": ".1875 in" });
    let read_again = read("a.json", library(vec![tool.clone()])).unwrap();
    assert!(near(read_again.tools[0].table.diameter, 4.7625));
    assert!(read_again.tools[0].dropped.iter().any(|d| d.starts_with("geometry.DC (")));
    // Without a unit nothing is certain.
    tool.as_object_mut().unwrap().remove("unit");
    assert_eq!(lacks(&read("a.json", library(vec![tool])).unwrap().tools[0]), ["unit"]);
}

#[test]
fn angles_are_whole_for_drills_and_half_for_chamfer_mills() {
    let of = |kind: &str, geometry: Value| {
        let tool = json!({ "type": kind, "unit": "millimeters", "geometry": geometry, "post-process": { "number": 1 } });
        read("a.json", library(vec![tool])).unwrap().tools.remove(0)
    };
    let drill = of("drill", json!({ "DC": 8, "LCF": 40, "SIG": 118 }));
    assert!(near(drill.table.point_angle.unwrap().to_degrees(), 118.0) && drill.missing.is_empty());
    assert_eq!(lacks(&of("spot drill", json!({ "DC": 8, "LCF": 10 }))), ["point_angle"]);
    let chamfer = of("chamfer mill", json!({ "DC": 10, "LCF": 12, "TA": 45, "tip-diameter": 2 }));
    assert_eq!(
        (chamfer.table.kind, chamfer.table.diameter, chamfer.table.half_angle),
        (ToolType::Tapered, 2.0, Some(45.0))
    );
    assert!(near(chamfer.table.flute_length, 4.0), "{}", chamfer.table.flute_length);
    assert_eq!(chamfer.dropped, ["geometry.LCF (12 mm: the cone ends at the diameter)"]);
    let bull = of("bull nose end mill", json!({ "DC": 10, "LCF": 22, "RE": 1.5 }));
    assert_eq!((bull.table.kind, bull.table.corner_radius), (ToolType::BullNose, Some(1.5)));
    assert_eq!(lacks(&of("bull nose end mill", json!({ "DC": 10, "LCF": 22 }))), ["corner_radius"]);
    let ball = of("ball end mill", json!({ "DC": 6, "LCF": 10, "RE": 3, "HAND": false }));
    assert_eq!((ball.table.kind, ball.table.hand, ball.dropped.len()), (ToolType::BallNose, Hand::Left, 0));
    let tap = of("tap left hand", json!({ "DC": 8, "LCF": 20, "TP": 1.25 }));
    assert_eq!((tap.table.pitch, tap.table.hand, tap.missing.len()), (Some(1.25), Hand::Left, 0));
    assert_eq!(lacks(&of("face mill", json!({ "DC": 50, "LCF": 6, "TA": 45 }))), ["entering_angle"]);
    assert_eq!(lacks(&of("dovetail mill", json!({ "DC": 20, "LCF": 6 }))), ["type"]);
}

#[test]
fn a_package_holds_the_same_library() {
    let text = library(vec![mill(), json!({ "type": "holder", "description": "Chuck" })]);
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    zip.start_file("tools.json", SimpleFileOptions::default()).unwrap();
    zip.write_all(text.as_bytes()).unwrap();
    let bytes = zip.finish().unwrap().into_inner();
    let library = read("a.tools", bytes.clone()).unwrap();
    assert_eq!(library.tools, read("a.json", text).unwrap().tools);
    assert_eq!(library.dropped, ["holder `Chuck` without a tool"]);
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    zip.start_file("readme.txt", SimpleFileOptions::default()).unwrap();
    assert!(wrong("a.tools", zip.finish().unwrap().into_inner()).to_string().contains("no tools.json"));
    // A package that unpacks to far more than a library of tools.
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    zip.start_file("tools.json", SimpleFileOptions::default()).unwrap();
    let blanks = vec![b' '; 1 << 20];
    for _ in 0..65 {
        zip.write_all(&blanks).unwrap();
    }
    assert!(wrong("a.tools", zip.finish().unwrap().into_inner()).to_string().contains("too large"));
    // Cut off anywhere it is an error or the same library, never a panic.
    for end in (0..bytes.len()).step_by(7) {
        _ = read("a.tools", bytes[..end].to_vec());
    }
}

#[test]
fn values_of_another_type_are_named_and_nothing_panics() {
    let odd = [
        json!(null),
        json!(true),
        json!("x"),
        json!(-1),
        json!(1e308),
        json!([]),
        json!({}),
        json!([1, "a"]),
    ];
    let keys = [
        "/type",
        "/unit",
        "/description",
        "/geometry",
        "/geometry/DC",
        "/geometry/LCF",
        "/geometry/NOF",
        "/holder",
        "/holder/unit",
        "/holder/segments",
        "/holder/segments/0",
        "/holder/segments/0/height",
        "/post-process",
        "/post-process/number",
        "/start-values",
        "/start-values/presets",
        "/start-values/presets/0",
        "/start-values/presets/0/n",
    ];
    for key in keys {
        for value in &odd {
            let mut tool = mill();
            *tool.pointer_mut(key).unwrap() = value.clone();
            let library = read("a.json", library(vec![tool])).unwrap();
            // Each is usable or says why not.
            assert_eq!(library.checked()[0].is_some(), library.faults().is_empty(), "{key} = {value}");
        }
    }
    for text in ["{\"data\": [1, null, \"a\", []]}", "{\"data\": [{}]}"] {
        let library = read("a.json", text).unwrap();
        assert!(library.tools.iter().all(|tool| !tool.missing.is_empty()));
    }
    let many = format!("{{\"data\": [{}]}}", vec!["{}"; 10_001].join(","));
    assert!(wrong("a.json", many).to_string().contains("too many tools"));
}

#[test]
fn contradictions_of_a_cone_are_found() {
    let of = |geometry: Value| {
        let tool = json!({ "type": "chamfer mill", "unit": "millimeters", "geometry": geometry, "post-process": { "number": 1 } });
        read("a.json", library(vec![tool])).unwrap().tools.remove(0)
    };
    // From 2 to 10 mm at 45 degrees it is 4 mm high: edges of 3 mm do not reach the largest diameter.
    let short = of(json!({ "DC": 10, "LCF": 3, "TA": 45, "tip-diameter": 2 }));
    assert_eq!((lacks(&short), short.table.half_angle), (vec!["half_angle"], None));
    let why = &short.missing[0].why;
    assert!(why.contains("geometry.LCF is 3 mm") && why.contains("needs 4 mm from 2 mm to 10 mm"), "{why}");
    assert_eq!(short.dropped, ["geometry.DC (10 mm, the largest diameter)"]);
    let exact = of(json!({ "DC": 10, "LCF": 3.9999, "TA": 45, "tip-diameter": 2 }));
    assert!(exact.missing.is_empty() && exact.dropped.is_empty(), "{exact:?}");
    assert_eq!(lacks(&of(json!({ "DC": 10, "LCF": 3, "TA": 45, "tip-diameter": 10 }))), ["flute_length"]);
    // Without an angle the diameter that stays is that of the tip.
    let open = of(json!({ "DC": 10, "LCF": 3, "tip-diameter": 2 }));
    assert_eq!((lacks(&open), open.table.diameter), (vec!["half_angle"], 2.0));
    assert_eq!(lacks(&of(json!({ "DC": 10, "LCF": 3 }))), ["half_angle", "diameter"]);
    // Tip, angle and height are a whole cone.
    let whole = of(json!({ "LCF": 3, "TA": 45, "tip-diameter": 2 }));
    assert_eq!((lacks(&whole).len(), whole.table.diameter, whole.table.flute_length), (0, 2.0, 3.0));
    assert_eq!(lacks(&of(json!({ "LCF": 3, "TA": 45 }))), ["diameter"]);
    // A tip that no field gives is assumed to be sharp; one of 0 is stated.
    let sharp = of(json!({ "DC": 10, "LCF": 5, "TA": 45 }));
    assert_eq!(sharp.assumed, ["a sharp tip, as there is no geometry.tip-diameter"]);
    let stated = of(json!({ "DC": 10, "LCF": 5, "TA": 45, "tip-diameter": 0 }));
    assert!(stated.assumed.is_empty() && stated.table == sharp.table, "{stated:?}");
}

#[test]
fn a_cone_takes_the_spindle_speed_of_its_presets() {
    let mut tool = mill();
    tool["type"] = "chamfer mill".into();
    tool["geometry"]["TA"] = json!(45);
    let library = read("a.json", library(vec![tool])).unwrap();
    let (tool, preset) = (&library.tools[0], &library.tools[0].table.presets[0]);
    // 150 m/min is that of 10 mm: an operation would take it at the width of its chamfer.
    assert_eq!((preset.speed, preset.cutting_speed), (Some(4774.648), None));
    assert!(tool.dropped.iter().any(|field| field == "start-values.presets.v_c"), "{:?}", tool.dropped);
}
