//! Every required key of every table has an example of its form and, where it is a number, its unit.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use schemars::generate::SchemaGenerator;
use serde::de::DeserializeOwned;
use serde_json::Value;
use toml::de::DeTable;

use super::{Form, Kind, Unit};
use crate::job::file;

/// The schemas of a job and of the files that it names.
fn schemas() -> Vec<Value> {
    vec![
        file::schema(),
        file::machine_schema(),
        file::tools_schema(),
        file::cutting_schema(),
        file::contour_schema(),
        file::surface_schema(),
        file::outline_schema(),
    ]
}

/// All tables within a schema, each with a name.
fn tables<'a>(root: Form<'a>, schema: &'a Value, name: &str, all: &mut Vec<(String, Form<'a>)>) {
    match schema {
        Value::Object(map) => {
            if schema["properties"].is_object() {
                all.push((name.to_owned(), root.with(schema)));
            }
            map.iter().for_each(|(key, value)| tables(root, value, &format!("{name}/{key}"), all));
        }
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, value)| tables(root, value, &format!("{name}/{i}"), all));
        }
        _ => {}
    }
}

/// The unit that the name of a key asks for, as the trade has it; nothing for names that say none.
fn unit_of_name(key: &str, form: Form<'_>) -> Option<&'static str> {
    let ends = |all: &[&str]| all.iter().any(|end| key == *end || key.ends_with(&format!("_{end}")));
    Some(match key {
        "cutting_speed" => "m/min",
        "feed_per_tooth" => "mm",
        "feed_per_rev" | "steady" => "mm/rev",
        "turn" if form.kind() == Kind::Number => "degrees",
        "angle" | "guard" | "inclination" | "ramp" | "forbidden" => "degrees",
        _ if ends(&["angle"]) && form.kind() == Kind::Number => "degrees",
        _ if ends(&["speed"]) => "rev/min",
        _ if ends(&["feed"]) => "mm/min",
        _ if ends(&["length", "diameter", "radius", "width", "height", "depth", "clearance", "stepdown"]) => {
            "mm"
        }
        "top" | "bottom" | "points" | "corner" | "size" | "stickout" | "min" | "max" | "base" => "mm",
        "x" | "z" if form.kind() == Kind::List => "",
        "axis" | "about" => "",
        _ => return None,
    })
}

#[test]
fn every_required_key_has_an_example_of_its_form_and_every_number_its_unit() {
    let mut seen = 0;
    for schema in schemas() {
        let root = Form::of_root(&schema);
        let mut all = Vec::new();
        tables(root, &schema, "", &mut all);
        for (name, table) in all {
            for (key, form) in table.keys() {
                let what = format!("{name} {key}");
                if let Some(unit) = form.unit() {
                    let named = match unit {
                        Unit::Of(unit) => unit,
                        Unit::Pure | Unit::Count => "",
                    };
                    let is_right = unit_of_name(key, form).is_none_or(|of| of == named);
                    assert!(is_right || unit == Unit::Count, "{what}: {named}");
                }
                if !table.required().any(|k| k == key) {
                    continue;
                }
                let example = form.example().unwrap_or_else(|| panic!("{what} has no example"));
                let text = format!("{key:?} = {example}");
                let parsed = DeTable::parse(&text).unwrap_or_else(|e| panic!("{what}: {text}: {e}"));
                let value = parsed.get_ref().values().next().unwrap();
                assert!(form.misfit(value).is_none(), "{what}: {text}: {:?}", form.misfit(value));
                assert!(!form.first_words().is_empty() || matches!(form.kind(), Kind::Word(_)), "{what}");
                seen += 1;
            }
        }
    }
    assert!(seen > 200, "{seen}");
}

/// Each choice of a type, put together of examples, is read by serde; the choices.
fn read<T: JsonSchema + DeserializeOwned>() -> usize {
    let schema = SchemaGenerator::default().into_root_schema_for::<T>().to_value();
    let choices = Form::of_root(&schema).choices();
    for form in &choices {
        let example = form.example().unwrap_or_else(|| panic!("{form:?}"));
        let text = format!("it = {example}");
        toml::from_str::<BTreeMap<String, T>>(&text).unwrap_or_else(|e| panic!("{text}: {e}"));
    }
    choices.len()
}

#[test]
fn tables_put_together_of_examples_are_read() {
    use crate::operations as of;
    let one = [
        read::<file::JobFile>(),
        read::<file::MachineTable>(),
        read::<file::ToolTable>(),
        read::<file::ContourTable>(),
        read::<file::FixtureTable>(),
        read::<file::ViseTable>(),
        read::<file::ClampTable>(),
        read::<file::BodyTable>(),
        read::<file::BodyCylinderTable>(),
        read::<file::DesignTable>(),
        read::<file::RegionTable>(),
        read::<file::DrilledTable>(),
        read::<file::OrientTable>(),
        read::<file::ProgramTable>(),
        read::<file::PresetTable>(),
        read::<crate::tool::Holder>(),
        read::<of::PlaneTable>(),
        read::<of::slot_outline::OutlineSlot>(),
        read::<of::outlines::OutlineCircle>(),
        read::<of::outlines::OutlineRectangle>(),
    ];
    assert_eq!(one, [1; 20]);
    assert_eq!(read::<of::OperationTable>(), of::OperationTable::NAMES.len());
    assert_eq!(read::<file::StockTable>(), 3);
    assert_eq!(read::<of::places::PatternTable>(), 3);
    assert_eq!(read::<crate::facing::PassesChoice>(), 6);
    assert_eq!(read::<crate::tool::DrillPoint>(), 16);
    assert!(read::<crate::tool::ToolForm>() > 20);
    assert_eq!(read::<crate::holes::Entry>(), 3);
}
