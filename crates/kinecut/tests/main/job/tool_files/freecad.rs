//! Tool bits and libraries of FreeCAD.

use kinecut::base::{MemoryLoader, Sources};
use kinecut::job::file::{ToolFileTable, ToolType};
use kinecut::job::library::{Library, LibraryFormat, LibraryTool, read_library};
use kinecut::tool::Hand;
use serde_json::{Value, json};

use super::{lacks, named, near, read, wrong};

/// A bit of a shape with parameters.
fn bit(shape: &str, parameter: Value) -> LibraryTool {
    let value = json!({ "version": 2, "name": "a bit", "shape": format!("{shape}.fcstd"), "parameter": parameter, "attribute": {} });
    let loader = MemoryLoader::default().with("a.fctb", value.to_string());
    let wants = ToolFileTable { number: Some(4), ..named("a.fctb") };
    read_library(&mut Sources::default(), &wants, &loader).unwrap().tools.remove(0)
}

#[test]
fn values_have_units_commas_and_fractions() {
    let tool = bit(
        "endmill",
        json!({ "Diameter": "1/4 \"", "CuttingEdgeHeight": "0,5 in", "Length": "50.0000 mm",
        "ShankDiameter": "6,35 mm", "Flutes": "3", "Stickout": "2 cm", "SpindleDirection": "Reverse", "Chipload": "0,04 mm" }),
    );
    let table = &tool.table;
    assert!(
        near(table.diameter, 6.35)
            && near(table.flute_length, 12.7)
            && near(table.shank_diameter.unwrap(), 6.35)
    );
    assert_eq!((table.number, table.teeth, table.stickout, table.hand), (4, Some(3), Some(20.0), Hand::Left));
    assert!(tool.missing.is_empty() && tool.assumed.is_empty());
    assert_eq!(tool.dropped, ["parameter.Chipload", "parameter.Length"]);
    // A number alone is taken as mm, and that is said.
    let tool = bit("endmill", json!({ "Diameter": 6, "CuttingEdgeHeight": "20" }));
    assert_eq!((tool.table.diameter, tool.table.flute_length), (6.0, 20.0));
    assert_eq!(tool.assumed, ["Diameter as 6 mm", "CuttingEdgeHeight as 20 mm"]);
    // In a file of imperial units it could be inches; lengths with their units are certain.
    for units in ["Imperial", "imperial"] {
        let tool = bit("endmill", json!({ "Diameter": 0.25, "CuttingEdgeHeight": "20 mm", "Units": units }));
        assert_eq!((lacks(&tool), tool.assumed.len()), (vec!["unit"], 0));
        let tool =
            bit("endmill", json!({ "Diameter": "0.25 in", "CuttingEdgeHeight": "1 in", "Units": units }));
        assert!(tool.missing.is_empty() && tool.dropped.is_empty(), "{tool:?}");
    }
    let tool = bit("endmill", json!({ "Diameter": 6, "CuttingEdgeHeight": "20 mm", "Units": "Metric" }));
    assert_eq!((tool.missing.len(), tool.assumed.len()), (0, 1));
    let tool = bit("endmill", json!({ "Diameter": "six", "CuttingEdgeHeight": "20 deg" }));
    assert_eq!(lacks(&tool), ["diameter", "flute_length"]);
    assert_eq!(tool.dropped, ["parameter.Diameter (no number with a unit)", "CuttingEdgeHeight (an angle)"]);
}

#[test]
fn each_shape_has_its_own() {
    let sizes = |more: Value| {
        let mut all = json!({ "Diameter": "6.0 mm", "CuttingEdgeHeight": "20.0 mm" });
        all.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        all
    };
    assert_eq!(bit("ballend", sizes(json!({}))).table.kind, ToolType::BallNose);
    // The radius of the flat of an older bit, the torus, and the corner of a newer one.
    for (key, value, radius) in
        [("FlatRadius", "2 mm", 1.0), ("TorusRadius", "2 mm", 2.0), ("CornerRadius", "1.5 mm", 1.5)]
    {
        let tool = bit("bullnose", sizes(json!({ key: value })));
        assert_eq!((tool.table.kind, tool.table.corner_radius), (ToolType::BullNose, Some(radius)), "{key}");
    }
    let vee = bit("v-bit", sizes(json!({ "CuttingEdgeAngle": "60 °", "TipDiameter": "1 mm" })));
    assert_eq!(
        (vee.table.kind, vee.table.diameter, vee.table.half_angle),
        (ToolType::Tapered, 1.0, Some(30.0))
    );
    assert!(near(vee.table.flute_length, 2.5 * 3f64.sqrt()), "{}", vee.table.flute_length);
    assert!(vee.assumed.is_empty(), "{:?}", vee.assumed);
    let cone = |more: Value| bit("chamfer", sizes(more));
    let sharp = cone(json!({ "CuttingEdgeAngle": "60 °" }));
    assert_eq!(sharp.assumed, ["a sharp tip, as there is no TipDiameter"]);
    for nought in [json!("0 mm"), json!(0)] {
        let stated = cone(json!({ "CuttingEdgeAngle": "60 °", "TipDiameter": nought.clone() }));
        assert!(stated.missing.is_empty() && stated.assumed.is_empty(), "{stated:?}");
        assert_eq!(stated.table, sharp.table, "{nought}");
    }
    // From 1 to 6 mm at 30 degrees it is 4.33 mm high.
    let keys = json!({ "CuttingEdgeAngle": "60 °", "TipDiameter": "1 mm", "CuttingEdgeHeight": "4 mm" });
    assert_eq!(lacks(&cone(keys)), ["half_angle"]);
    let drill = bit("drill", json!({ "Diameter": "5.0 mm", "TipAngle": "119.0 °" }));
    assert_eq!((drill.table.kind, lacks(&drill)), (ToolType::Drill, vec!["flute_length"]));
    assert!(near(drill.table.point_angle.unwrap().to_degrees(), 119.0));
    let tap = bit(
        "tap",
        json!({ "Diameter": "8 mm", "CuttingEdgeLength": "24 mm", "Pitch": "1.25 mm", "TipAngle": "90 °" }),
    );
    assert_eq!((tap.table.kind, tap.table.pitch, tap.table.flute_length), (ToolType::Tap, Some(1.25), 24.0));
    assert_eq!(tap.dropped, ["parameter.TipAngle"]);
    assert_eq!(lacks(&bit("tap", sizes(json!({ "Pitch": "0.000 in" })))), ["pitch"]);
    assert_eq!(lacks(&bit("slittingsaw", sizes(json!({})))), ["type"]);
}

#[test]
fn a_library_gives_bits_their_numbers() {
    let mill = |name: &str| {
        json!({ "name": name, "shape-type": "Endmill", "shape": "x.fcstd",
                "parameter": { "Diameter": "6 mm", "CuttingEdgeHeight": "20 mm" } })
        .to_string()
    };
    let library = json!({ "version": 1, "tools": [
        { "nr": 2, "path": "six.fctb" }, { "nr": 5, "path": "gone.fctb" }, { "nr": 6, "path": "beside.fctb" }] });
    let loader = MemoryLoader::default()
        .with("Tools/Library/mine.fctl", library.to_string())
        .with("Tools/Bit/six.fctb", mill("six"))
        .with("Tools/Library/beside.fctb", mill("beside"));
    let read = |loader: &MemoryLoader| -> Library {
        read_library(&mut Sources::default(), &named("Tools/Library/mine.fctl"), loader).unwrap()
    };
    let library = read(&loader);
    assert_eq!(library.format, LibraryFormat::FreeCadLibrary);
    let all: Vec<_> =
        library.tools.iter().map(|t| (t.table.number, t.table.name.as_deref().unwrap())).collect();
    assert_eq!(all, [(2, "six"), (5, "gone.fctb"), (6, "beside")]);
    assert_eq!(lacks(&library.tools[1]), ["type", "diameter", "flute_length"]);
    assert!(library.tools[1].missing[0].why.contains("gone.fctb"));
    // All that was read is part of what a verdict is about.
    assert_eq!(library.files, ["Tools/Library/mine.fctl", "Tools/Bit/six.fctb", "Tools/Library/beside.fctb"]);
}

#[test]
fn a_bit_alone_has_no_number_and_wrong_entries_are_refused() {
    let text = json!({ "name": "a", "shape": "endmill.fcstd",
        "parameter": { "Diameter": "6 mm", "CuttingEdgeHeight": "20 mm" } });
    assert_eq!(lacks(&read("a.fctb", text.to_string()).unwrap().tools[0]), ["number"]);
    for entry in [json!(1), json!({ "nr": 1 }), json!({ "nr": -1, "path": "a" }), json!({ "path": "a" })] {
        let error = wrong("a.fctl", json!({ "tools": [entry] }).to_string());
        assert_eq!((error.code().to_string().as_str(), error.0.key.as_deref()), ("KC0706", Some("tools[0]")));
    }
}
