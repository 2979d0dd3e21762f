//! A value of another form than its key takes, in plain words, with what to write instead.

use toml::de::DeValue;

use super::forms::{Form, KeyAt, Kind, Misfit, Unit, given, number_with_unit, toml_text};

/// Longest text that is proposed as it is.
const LONGEST: usize = 80;

/// A wrong value in words, and what to write; `at` is the nearest key around it, `said` what its type says that it takes.
pub(super) fn wrong_value(
    misfit: &Misfit<'_, '_>,
    at: KeyAt<'_, '_>,
    said: Option<&str>,
) -> (String, String) {
    let KeyAt { key, form, .. } = at;
    let is_itself = misfit.lists == 0;
    let unit_of = |form: Form<'_>| match form.unit() {
        Some(Unit::Of(unit)) => unit.to_owned(),
        _ => String::new(),
    };
    let number = match (misfit.form.kind(), misfit.value) {
        (Kind::Number | Kind::Whole, DeValue::String(text)) => {
            number_with_unit(text).and_then(|(_, unit)| unit)
        }
        _ => None,
    };
    let own = unit_of(misfit.form);
    let without = match number {
        Some("") => ", without quotes".to_owned(),
        Some(unit) if unit == own && is_itself => ", without its unit".to_owned(),
        Some(unit) if unit == own => ", without units".to_owned(),
        Some(unit) if !own.is_empty() => format!(", not in {unit}"),
        Some(_) => ", without a unit".to_owned(),
        None => String::new(),
    };
    let other = number.filter(|unit| !unit.is_empty() && *unit != own);
    let given = given(misfit.value);
    let not = match (is_itself, misfit.value) {
        (true, DeValue::Array(list)) if form.kind() == Kind::List => format!(", not of {}", list.len()),
        (true, _) if other.is_some() => format!(": {given}"),
        (true, _) => format!(", not {given}"),
        (false, _) => format!(", not one with {given} in it"),
    };
    let takes = said.map_or_else(|| form.takes(), str::to_owned);
    (format!("`{key}` takes {takes}{without}{not}"), help(at, other))
}

/// The help for a wrong value: what to write in its place; `other` is the unit that it has and its key has not.
fn help(at: KeyAt<'_, '_>, other: Option<&str>) -> String {
    let KeyAt { key, within, form, value } = at;
    let given = value.get_ref();
    let is_table_list = form.kind() == Kind::List && form.item().kind() == Kind::Table;
    if is_table_list && matches!(given, DeValue::Table(_)) {
        return format!("write [[{key}]] in place of [{key}], or put the table in square brackets");
    }
    let is_tables = given.as_array().is_some_and(|list| list.iter().all(|item| item.get_ref().is_table()));
    if form.kind() == Kind::Table && is_tables {
        return format!("write [{key}] in place of [[{key}]]: there is one only");
    }
    if let Some(other) = other {
        let mut keys = within.keys().filter(|(_, form)| form.unit() == Some(Unit::Of(other)));
        if let (Some((taking, of)), None) = (keys.next(), keys.next()) {
            let example = of.example().map_or(String::new(), |example| format!(", as {taking} = {example}"));
            return format!("a number in {other} belongs to `{taking}`{example}");
        }
    } else if let Some(text) = form.named(given).or_else(|| form.mended(value).map(|value| toml_text(&value)))
        && text.len() <= LONGEST
    {
        return format!("write {key} = {text}");
    }
    match form.example().or_else(|| form.blank()) {
        Some(example) => format!("write it as {key} = {example}"),
        None => String::new(),
    }
}

impl Form<'_> {
    /// An example of the table that a value names: `{ rows = 3 }` for "rows".
    fn named(self, value: &DeValue<'_>) -> Option<String> {
        let name = value.as_str()?;
        let named = |form: &Form<'_>| form.kind() == Kind::Table && form.required().eq([name]);
        (self.kind() == Kind::Choice).then(|| self.choices().into_iter().find(named)?.example())?
    }
}
