//! Examples of values: those of the schema, and tables put together from those of their keys.

use serde_json::Value;

use super::{Form, Kind};

/// Tables within tables that are put together; none of a file goes deeper.
const DEEPEST: usize = 8;

impl Form<'_> {
    /// An example of a value, as TOML writes it.
    pub(in crate::job) fn example(self) -> Option<String> {
        self.example_within(DEEPEST)
    }

    /// An example of the keys that a table must have, one line each in TOML.
    pub(in crate::job) fn example_rows(self) -> Option<Vec<String>> {
        self.rows(DEEPEST)
    }

    fn example_within(self, depth: usize) -> Option<String> {
        let depth = depth.checked_sub(1)?;
        if let Some(given) = self.beside["examples"].get(0).or_else(|| self.own["examples"].get(0)) {
            return Some(toml_text(given));
        }
        match self.kind() {
            Kind::Word(word) => Some(toml_text(&word.into())),
            Kind::Choice => self.choices().first()?.example_within(depth),
            Kind::Table => {
                let rows = self.rows(depth)?;
                Some(if rows.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", rows.join(", ")) })
            }
            Kind::List if self.item().kind() == Kind::Table => {
                Some(format!("[{}]", self.item().example_within(depth)?))
            }
            _ => None,
        }
    }

    /// A list of numbers to be filled in.
    pub(in crate::job) fn blank(self) -> Option<String> {
        let (least, most) = self.counts();
        let is_short = self.kind() == Kind::List && least == most && (1..7).contains(&most);
        is_short.then(|| format!("[{}]", vec![".."; usize::try_from(most).unwrap_or(1)].join(", ")))
    }

    fn rows(self, depth: usize) -> Option<Vec<String>> {
        let row = |key| Some(format!("{key} = {}", self.key(key)?.example_within(depth)?));
        self.required().map(row).collect()
    }
}

/// A value as TOML writes it, on one line.
pub(in crate::job) fn toml_text(value: &Value) -> String {
    let bare =
        |key: &str| !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || "_-".contains(c));
    let key = |key: &String| if bare(key) { key.clone() } else { Value::from(key.as_str()).to_string() };
    match value {
        Value::Array(list) => format!("[{}]", list.iter().map(toml_text).collect::<Vec<_>>().join(", ")),
        Value::Object(table) if table.is_empty() => "{}".to_owned(),
        Value::Object(table) => {
            let all: Vec<String> =
                table.iter().map(|(k, v)| format!("{} = {}", key(k), toml_text(v))).collect();
            format!("{{ {} }}", all.join(", "))
        }
        Value::Number(number) => match number.as_f64() {
            Some(whole) if number.is_f64() && whole.fract() == 0.0 && whole.abs() < 1e15 => {
                format!("{whole}")
            }
            _ => number.to_string(),
        },
        other => other.to_string(),
    }
}
