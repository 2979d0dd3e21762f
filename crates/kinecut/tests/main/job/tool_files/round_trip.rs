//! Tools written and read again.

use kinecut::job::file::{ToolTable, ToolType};
use kinecut::job::library::{Library, library_json, library_table, library_toml};
use kinecut::verbs::tools::{ToolsTo, convert_tools, tools_sheet};
use proptest::prelude::*;

use super::{lacks, near, read, wrong};

fn read_toml(text: &str) -> Library {
    read("again.toml", text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A length with three decimals [mm].
fn length() -> impl Strategy<Value = f64> {
    (1u32..200_000).prop_map(|v| f64::from(v) / 1000.0)
}

/// An angle with one decimal, in degrees.
fn angle() -> impl Strategy<Value = f64> {
    (200u32..1790).prop_map(|v| f64::from(v) / 10.0)
}

fn name() -> impl Strategy<Value = String> {
    "[A-Za-zäß\"'\\\\#=\\[\\]0-9][A-Za-z \"'\\\\;#=.0-9]{0,20}[A-Za-z0-9]"
}

/// The TOML of a tool with many keys.
fn tool(number: u32) -> impl Strategy<Value = String> {
    let kind = prop_oneof![
        Just("type = \"end-mill\"".to_owned()),
        length().prop_map(|r| format!("type = \"bull-nose\"\ncorner_radius = {r}")),
        angle().prop_map(|a| format!("type = \"drill\"\npoint_angle = {a}")),
        (angle(), angle()).prop_map(|(a, b)| {
            format!("type = \"drill\"\npoint = {{ double-ground = {{ point_angle = {a}, second_angle = {b} }} }}")
        }),
        (length(), angle()).prop_map(|(d, a)| {
            format!("type = \"drill\"\npoint = {{ stepped = {{ stages = [{{ diameter = {d}, length = 3, shoulder_angle = {a} }}] }} }}")
        }),
        Just("type = \"drill\"\npoint = \"flat\"".to_owned()),
        length().prop_map(|p| format!("type = \"tap\"\npitch = {p}\nchamfer = \"B\"\nhand = \"left\"")),
        Just("type = \"tapered\"\nhalf_angle = 45".to_owned()),
        angle().prop_map(|a| format!("type = \"face-mill\"\nentering_angle = {a}\ntooth_angles = [0, 90.5]\nrunout = [0, 0.01]")),
    ];
    let preset = prop::option::of((name(), length(), length()).prop_map(|(material, v, f)| {
        let material = serde_json::Value::from(material).to_string();
        format!("[[tool.preset]]\nmaterial = {material}\ncutting_speed = {v}\nfeed_per_tooth = {f}\n")
    }));
    (kind, name(), length(), length(), prop::option::of(length()), prop::option::of(1u32..12), preset).prop_map(
        move |(kind, name, diameter, flutes, gauge, teeth, preset)| {
            let name = serde_json::Value::from(name).to_string();
            let gauge = gauge.map(|v| format!("gauge_length = {v}\nstickout = {v}\nholder = \"a \\\"b\\\"\"\n"));
            let teeth = teeth.map(|v| format!("teeth = {v}\ncentre_cutting = true\nmax_speed = 12000\n"));
            format!(
                "[[tool]]\nnumber = {number}\nname = {name}\n{kind}\ndiameter = {diameter}\nflute_length = {flutes}\n{}{}{}\n",
                gauge.unwrap_or_default(),
                teeth.unwrap_or_default(),
                preset.unwrap_or_default()
            )
        },
    )
}

fn file() -> impl Strategy<Value = String> {
    let tools = (tool(1), tool(2), tool(7)).prop_map(|(a, b, c)| a + &b + &c);
    (tools, length(), prop::option::of(length())).prop_map(|(tools, height, upper)| {
        let upper = upper.map(|v| format!(", upper_diameter = {v}")).unwrap_or_default();
        format!("[[holder]]\nname = \"a \\\"b\\\"\"\nsegments = [{{ height = {height}, lower_diameter = 40{upper} }}]\n\n{tools}")
    })
}

proptest! {
    #![proptest_config(kinecut_cases::property(200))]

    /// Ours to TOML or JSON to ours: the same tools and holders.
    #[test]
    fn a_library_written_is_read_back_equal(text in file()) {
        let first = read_toml(&text);
        let again = read_toml(&library_toml(&first).unwrap());
        prop_assert_eq!(&again.tools, &first.tools);
        prop_assert_eq!(&again.holders, &first.holders);
        let json = read("again.json", library_json(&first)).unwrap();
        prop_assert_eq!(&json.tools, &first.tools);
        // The text is the same when it is written again.
        prop_assert_eq!(library_toml(&again).unwrap(), library_toml(&first).unwrap());
    }

    /// Ours to a tool table to ours: number, diameter, length and name.
    #[test]
    fn a_tool_table_keeps_what_it_can_hold(text in file()) {
        let first = read_toml(&text);
        let again = read("again.tbl", library_table(&first)).unwrap();
        let held = |t: &ToolTable| (t.number, t.gauge_length, t.name.clone());
        let all = |l: &Library| l.tools.iter().map(|t| held(&t.table)).collect::<Vec<_>>();
        for (first, again) in first.tools.iter().zip(&again.tools) {
            // A cone of 45 degrees is wider by twice its height.
            let cone = if first.table.kind == ToolType::Tapered { 2.0 * first.table.flute_length } else { 0.0 };
            prop_assert!(!again.has("diameter") || near(again.table.diameter, first.table.diameter + cone));
        }
        let mut wanted = all(&first);
        for (.., name) in &mut wanted {
            *name = name.as_ref().map(|name| name.trim_start_matches(';').trim().to_owned());
        }
        prop_assert_eq!(all(&again), wanted);
        prop_assert!(again.tools.iter().all(|t| !t.has("flute_length")));
    }

    /// Any text is read or refused.
    #[test]
    fn any_text_has_an_answer(text in ".{0,200}", cut in 0usize..4000) {
        let shop = include_str!("../../../../../../examples/shop.toml");
        let cut = (0..=cut.min(shop.len())).rev().find(|at| shop.is_char_boundary(*at)).unwrap_or(0);
        for file in ["a.toml", "a.tbl", "a.json", "a.tools", "a.fctb"] {
            _ = read(file, text.clone());
            _ = read(file, format!("{}{text}", &shop[..cut]));
        }
    }
}

#[test]
fn what_is_missing_is_written_as_comments_to_be_filled_in() {
    let table = read("tool.tbl", "T3 P3 Z80 D10 ;end mill\nT4 ;something\n").unwrap();
    let text = library_toml(&table).unwrap();
    assert!(text.contains("# flute_length = ?  # not in a tool table"), "{text}");
    assert!(text.contains("# diameter = ?") && text.contains("# type = ?"), "{text}");
    // Whatever is filled in makes a file of tools.
    let filled = text
        .replace("# flute_length = ?", "flute_length = 22")
        .replace("# diameter = ?", "diameter = 4")
        .replace("# type = ?", "type = \"drill\"");
    let again = read_toml(&filled);
    assert_eq!((again.tools[0].table.kind, again.tools[1].table.kind), (ToolType::EndMill, ToolType::Drill));
    assert_eq!((again.tools[0].table.gauge_length, again.tools[1].table.diameter), (Some(80.0), 4.0));
    assert!(again.faults().is_empty() && again.tools.iter().all(|t| lacks(t).is_empty()));
    // JSON has no comments: these tools are not in it.
    assert_eq!(read("a.json", library_json(&table)).unwrap().tools.len(), 0);
}

/// A tool of a Fusion library with cutting data, written as TOML.
fn fusion_toml(kind: &str, unit: &str, geometry: &str) -> String {
    let text = format!(
        r#"{{"data": [{{"type": "{kind}", {unit} "geometry": {geometry}, "post-process": {{"number": 7}},
            "start-values": {{"presets": [{{"name": "C45", "n": 3000, "f_z": 0.05}}]}}}}]}}"#
    );
    library_toml(&read("a.json", text).unwrap()).unwrap()
}

#[test]
fn keys_that_are_not_needed_are_refused_until_they_are_filled_in() {
    const MM: &str = r#""unit": "millimeters","#;
    let spot = library_toml(&read("tool.tbl", "T3 D10 ;spot drill\n").unwrap()).unwrap();
    let spot = spot.replace("# flute_length = ?", "flute_length = 20");
    for (key, value, text) in [
        ("point_angle", "90", fusion_toml("spot drill", MM, r#"{"DC": 8, "LCF": 10}"#)),
        ("entering_angle", "45", fusion_toml("face mill", MM, r#"{"DC": 50, "LCF": 6, "TA": 45}"#)),
        ("unit", "", fusion_toml("flat end mill", "", r#"{"DC": 8, "LCF": 10}"#)),
        ("point", "\"flat\"", spot),
    ] {
        let line = format!("{key} = \"?\"");
        let at = text.find(&line).unwrap_or_else(|| panic!("{key}\n{text}"));
        // It is a key of the tool, not of its cutting data.
        assert!(text.find("[[tool.preset]]").is_none_or(|preset| at < preset), "{text}");
        let error = wrong("again.toml", text.clone());
        let place = error.0.place.as_ref().unwrap();
        assert_eq!(error.0.key.as_deref(), Some(format!("tool[0].{key}").as_str()), "{error}");
        assert!(place.file == "again.toml" && place.text.starts_with(&line), "{place:?}");
        let filled = match value {
            "" => {
                text.lines().filter(|text| !text.starts_with(&line)).map(|text| format!("{text}\n")).collect()
            }
            value => text.replace(&line, &format!("{key} = {value}")),
        };
        let again = read_toml(&filled);
        assert!(again.faults().is_empty(), "{:?}\n{filled}", again.faults());
        let table = &again.tools[0].table;
        assert_eq!(table.presets.len(), usize::from(key != "point"));
        assert_eq!(
            (table.point_angle.is_some(), table.entering_angle.is_some(), table.point.is_some()),
            (key == "point_angle", key == "entering_angle", key == "point")
        );
    }
    // `unit` is no key: a value in place of the question is refused, too.
    let inches = fusion_toml("flat end mill", "", r#"{"DC": 8, "LCF": 10}"#).replace("\"?\"", "\"inches\"");
    assert!(wrong("again.toml", inches).to_string().contains("no `unit`"));
    // Comments are before the cutting data.
    let bull = fusion_toml("bull nose end mill", MM, r#"{"DC": 10, "LCF": 22}"#);
    let again = read_toml(&bull.replace("# corner_radius = ?", "corner_radius = 1"));
    assert_eq!((again.tools[0].table.corner_radius, again.tools[0].table.presets.len()), (Some(1.0), 1));
}

#[test]
fn what_was_assumed_is_written_and_shown() {
    let table = read("tool.tbl", "T3 P3 Z80 D10 ;end mill\n").unwrap();
    let assumed = ["the type, from the remark", "gauge_length 80 mm, as Z counts from the spindle"];
    let toml = convert_tools(&table, ToolsTo::Toml).unwrap();
    for what in assumed {
        assert!(toml.text.contains(&format!("\n# assumed: {what}\n")), "{}", toml.text);
    }
    assert_eq!(toml.assumed, [format!("T3 `end mill`: {}", assumed.join(", "))]);
    assert_eq!(tools_sheet(&table).tools[0].assumed, assumed);
    // JSON has not this tool, and so nothing that was assumed of it.
    assert!(convert_tools(&table, ToolsTo::Json).unwrap().assumed.is_empty());
}

#[test]
fn a_tool_table_has_the_largest_diameter_of_a_cone() {
    let own = "[[tool]]\nnumber = 3\ntype = \"tapered\"\ndiameter = 2\nhalf_angle = 45\nflute_length = 5\n";
    let table = convert_tools(&read_toml(own), ToolsTo::Table).unwrap();
    assert!(table.text.contains("\nT3 P3 D12\n"), "{}", table.text);
    assert!(table.lost[0].contains("diameter") && table.lost[0].contains("half_angle"), "{:?}", table.lost);
    // Without its angle it is not known; D of a tool table is not that of the tip.
    let again = read("again.tbl", "T3 D12 ;chamfer mill\n").unwrap();
    let written = convert_tools(&again, ToolsTo::Table).unwrap();
    assert!(written.text.contains("\nT3 P3 ;chamfer mill\n"), "{}", written.text);
    assert!(written.lost[0].contains("D (12 mm, the largest diameter)"), "{:?}", written.lost);
    // Lengths without a unit are in no table.
    let text = r#"{"data": [{"type": "flat end mill", "geometry": {"DC": 8, "LCF": 9}, "post-process": {"number": 7}}]}"#;
    let bare = read("a.json", text).unwrap();
    let written = convert_tools(&bare, ToolsTo::Table).unwrap();
    assert_eq!(written.text, "; lengths in mm\n");
    assert!(written.lost[0].contains("unit"), "{:?}", written.lost);
    let row = &tools_sheet(&bare).tools[0];
    assert_eq!((row.diameter, row.flute_length), (None, None));
}
