//! Tables whose lengths are in inches, turned into mm before they are decoded.
//!
//! The units of the keys are those of their words, so that a key that is new is in inches too.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use schemars::generate::SchemaGenerator;
use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Form, Kind, Unit};
use crate::job::renamed::old_name;

/// Millimetres of an inch.
const INCH: f64 = 25.4;
/// Metres of a foot.
const FOOT: f64 = 0.3048;

/// The numbers of a table that are in inches, in mm: a text that is kept beside that of the table, as what is decoded borrows
/// from both.
#[derive(Debug, Default)]
pub(in crate::job) struct InMm(String);

impl InMm {
    /// Of a table of a type; nothing where no `units` says inches.
    pub(in crate::job) fn of<T: JsonSchema>(root: &mut Spanned<DeTable<'_>>) -> InMm {
        if !says_inches(root.get_ref()) {
            return InMm::default();
        }
        let mut text = String::from("v=[");
        walk::<T>(root, &mut |value, factor| {
            // What is no number stays, and is refused as it is.
            let number = number(value).map(|n| n * factor).filter(|n| n.is_finite());
            text.push_str(&number.map_or_else(|| "0".to_owned(), |n| format!("{n:?}")));
            text.push(',');
        });
        text.push(']');
        InMm(text)
    }

    /// Puts them into the table.
    pub(in crate::job) fn put_into<'a, T: JsonSchema>(&'a self, root: &mut Spanned<DeTable<'a>>) {
        let Ok(parsed) = DeTable::parse(&self.0) else { return };
        let list = parsed.into_inner().into_iter().next().map(|(_, list)| list.into_inner());
        let Some(DeValue::Array(list)) = list else { return };
        let mut list = list.into_iter();
        walk::<T>(root, &mut |value, _| {
            if let (Some(number), Some(_)) = (list.next(), number(value)) {
                *value = number.into_inner();
            }
        });
    }
}

/// The number of a value.
fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(n) => i128::from_str_radix(n.as_str(), n.radix()).ok().map(|n| n as f64),
        DeValue::Float(n) => n.as_str().parse().ok(),
        _ => None,
    }
}

/// Whether a table, or one in it, is in inches.
fn says_inches(table: &DeTable<'_>) -> bool {
    fn in_value(value: &DeValue<'_>) -> bool {
        match value {
            DeValue::Table(table) => says_inches(table),
            DeValue::Array(list) => list.iter().any(|value| in_value(value.get_ref())),
            _ => false,
        }
    }
    is_inch(table) == Some(true) || table.values().any(|value| in_value(value.get_ref()))
}

/// Whether a table says that it is in inches; nothing where it says no units.
fn is_inch(table: &DeTable<'_>) -> Option<bool> {
    table.get("units")?.get_ref().as_str().map(|units| units == "in")
}

/// Calls `each` with every number in inches, and its factor to the unit that a key takes.
fn walk<'t, T: JsonSchema>(root: &mut Spanned<DeTable<'t>>, each: &mut dyn FnMut(&mut DeValue<'t>, f64)) {
    let schema = SchemaGenerator::default().into_root_schema_for::<T>().to_value();
    let place = Place { inch: false, axis: "", at: 0, of_loops: false };
    in_table(root.get_mut(), Form::of_root(&schema), place, each);
}

/// The place of a value.
#[derive(Clone, Copy)]
struct Place<'p> {
    /// Whether its lengths are in inches.
    inch: bool,
    /// The axis of a machine that it belongs to: the letter, or the digit of an inclined one.
    axis: &'p str,
    /// Its index in the list that holds it.
    at: usize,
    /// Whether it belongs to the loops or lines of an outline or to a polyline, whose points may have a bulge: [x, y, bulge].
    of_loops: bool,
}

fn in_table<'t>(
    table: &mut DeTable<'t>,
    form: Form<'_>,
    place: Place<'_>,
    each: &mut dyn FnMut(&mut DeValue<'t>, f64),
) {
    let Some(form) = form.meant_table(table) else { return };
    let inch = is_inch(table).unwrap_or(place.inch);
    // Loops with a unit of their own are in that, whatever the file is in.
    let own_unit = table.contains_key("unit");
    for (name, value) in table.iter_mut() {
        let name: &str = name.get_ref();
        let renamed = || form.keys().find(|(key, _)| old_name(key) == Some(name)).map(|(_, form)| form);
        let Some(own) = form.key(name).or_else(renamed) else { continue };
        let inch = inch && !(own_unit && (name == "outline" || form.key("loops").is_some()));
        let axis = if name.len() == 1 { name } else { place.axis };
        let is_line = name == "polyline" || name == "lines" && form.key("loops").is_some();
        let of_loops = place.of_loops || name == "loops" || is_line;
        in_value(value, own, Place { inch, axis, at: 0, of_loops }, each);
    }
}

fn in_value<'t>(
    value: &mut Spanned<DeValue<'t>>,
    form: Form<'_>,
    place: Place<'_>,
    each: &mut dyn FnMut(&mut DeValue<'t>, f64),
) {
    match value.get_mut() {
        DeValue::Table(table) => in_table(table, form, place, each),
        DeValue::Array(_) => {
            let form = meant(form, value);
            if let (Kind::List, DeValue::Array(list)) = (form.kind(), value.get_mut()) {
                let item = form.item();
                list.iter_mut().enumerate().for_each(|(at, value)| {
                    in_value(value, item, Place { at, ..place }, each);
                });
            }
        }
        DeValue::Integer(_) | DeValue::Float(_) if place.inch => {
            if let Some(factor) = meant(form, value).unit().and_then(|unit| factor(unit, place)) {
                each(value.get_mut(), factor);
            }
        }
        _ => {}
    }
}

/// The form that a value has; of several of its kind the first, as all of them have one unit.
fn meant<'a>(form: Form<'a>, value: &Spanned<DeValue<'_>>) -> Form<'a> {
    if form.kind() != Kind::Choice {
        return form;
    }
    let of_kind = |form: &Form<'_>| match value.get_ref() {
        DeValue::Array(_) => form.kind() == Kind::List,
        _ => form.kind() == Kind::Number,
    };
    form.meant(value).or_else(|| form.choices().into_iter().find(of_kind)).unwrap_or(form)
}

/// The factor from the number of a text in inches to that of a key; nothing where it stays.
fn factor(unit: Unit<'_>, place: Place<'_>) -> Option<f64> {
    let Unit::Of(unit) = unit else { return None };
    if place.of_loops && place.at == 2 {
        return None;
    }
    let rotary = place.axis.starts_with(|c: char| matches!(c, 'A'..='C' | 'a'..='c' | '4'..='9'));
    Some(match unit {
        "mm" | "mm/min" | "mm/rev" => INCH,
        "m/min" => FOOT,
        "mm/min, of rotary axes rev/min" | "mm, rotary axes degrees" | "mm, or degrees" if !rotary => INCH,
        "m/s2, of rotary axes degrees/s2" | "m/s3, of rotary axes degrees/s3" if !rotary => INCH / 1000.0,
        "m/s2" | "m/s3" => INCH / 1000.0,
        "degrees and mm" if place.at == 1 => INCH,
        "mm and degrees" if place.at == 0 => INCH,
        _ => return None,
    })
}

/// The factors from inches of the keys of a job whose number is a length, a feed or a speed, where all keys of a name agree.
pub(in crate::job) fn factors<T: JsonSchema>() -> BTreeMap<String, f64> {
    fn collect(root: Form<'_>, schema: &Value, all: &mut BTreeMap<String, Option<f64>>) {
        match schema {
            Value::Object(map) => {
                if schema["properties"].is_object() {
                    for (key, form) in root.with(schema).keys() {
                        let mut item = meant_number(form);
                        while item.kind() == Kind::List {
                            item = item.item();
                        }
                        let place = Place { inch: true, axis: "", at: 0, of_loops: false };
                        let own = item.unit().and_then(|unit| factor(unit, place));
                        let agreed = all.entry(key.to_owned()).or_insert(own);
                        if *agreed != own && item.unit().is_some() {
                            *agreed = None;
                        }
                    }
                }
                map.values().for_each(|value| collect(root, value, all));
            }
            Value::Array(list) => list.iter().for_each(|value| collect(root, value, all)),
            _ => {}
        }
    }
    let schema = SchemaGenerator::default().into_root_schema_for::<T>().to_value();
    let mut all = BTreeMap::new();
    collect(Form::of_root(&schema), &schema, &mut all);
    all.into_iter().filter_map(|(key, factor)| Some((key, factor?))).collect()
}

/// Of a choice the form that is a number or a list.
fn meant_number(form: Form<'_>) -> Form<'_> {
    let choices = form.choices();
    choices.into_iter().find(|form| matches!(form.kind(), Kind::Number | Kind::List)).unwrap_or(form)
}

#[cfg(test)]
mod tests;
