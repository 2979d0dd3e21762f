//! Tools written and read again.

use kinecut::job::file::{ToolTable, ToolType};
use kinecut::job::library::{Library, library_json, library_table, library_toml};
use proptest::prelude::*;

use super::{lacks, read};

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
        let held = |t: &ToolTable| (t.number, t.diameter, t.gauge_length, t.name.clone());
        let all = |l: &Library| l.tools.iter().map(|t| held(&t.table)).collect::<Vec<_>>();
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
