//! The value that a person most likely meant with one of a wrong form.

use serde_json::{Value, json};
use toml::Spanned;
use toml::de::DeValue;

use super::{Form, Kind, Unit, number_with_unit};

impl Form<'_> {
    /// The value that a wrong one most likely means; `None` where that cannot be said without a guess: a number in a unit
    /// of another kind is not converted.
    pub(in crate::job) fn mended<'v>(self, value: &'v Spanned<DeValue<'v>>) -> Option<Value> {
        if self.kind() != Kind::Choice && self.misfit(value).is_none() {
            return plain(value.get_ref());
        }
        match (self.kind(), value.get_ref()) {
            (Kind::Number, DeValue::String(text)) => {
                let (number, unit) = number_with_unit(text)?;
                let own = match self.unit() {
                    Some(Unit::Of(own)) => own,
                    _ => "",
                };
                (unit?.is_empty() || unit? == own).then(|| json!(number))
            }
            (Kind::Whole, DeValue::String(text)) => {
                whole(number_with_unit(text).filter(|(_, u)| *u == Some(""))?.0)
            }
            (Kind::Whole, DeValue::Float(number)) => whole(number.as_str().parse().ok()?),
            (Kind::Number | Kind::Whole, DeValue::Array(list)) if list.len() == 1 => {
                self.mended(list.iter().next()?)
            }
            (Kind::Text, DeValue::Integer(_) | DeValue::Float(_) | DeValue::Boolean(_)) => {
                Some(super::given(value.get_ref()).into())
            }
            (Kind::Truth, DeValue::String(text)) => match text.trim().to_ascii_lowercase().as_str() {
                "true" | "yes" | "on" => Some(true.into()),
                "false" | "no" | "off" => Some(false.into()),
                _ => None,
            },
            (Kind::Truth, DeValue::Integer(number)) => match number.as_str() {
                "1" => Some(true.into()),
                "0" => Some(false.into()),
                _ => None,
            },
            (Kind::List, _) => self.mended_list(value),
            (Kind::Table, _) => {
                // The value of the only key that is needed.
                let key = self.required().next().filter(|_| self.required().count() == 1)?;
                let form = self.key(key)?;
                form.misfit(value)
                    .is_none()
                    .then(|| plain(value.get_ref()).map(|value| json!({ key: value })))?
            }
            (Kind::Choice, _) => self
                .choices()
                .into_iter()
                .filter(|form| form.kind() != Kind::Text)
                .find_map(|form| form.mended(value)),
            _ => None,
        }
    }

    fn mended_list<'v>(self, value: &'v Spanned<DeValue<'v>>) -> Option<Value> {
        let item = self.item();
        let (least, most) = self.counts();
        let is_long = |n: usize| (least..=most).contains(&(n as u64));
        match value.get_ref() {
            DeValue::Array(list) if is_long(list.len()) => {
                let each: Option<Vec<Value>> = list.iter().map(|v| item.mended(v)).collect();
                each.map(Value::Array).or_else(|| {
                    // The coordinates of points one behind the other.
                    let flat: Option<Vec<Value>> = list.iter().map(|v| number(v.get_ref())).collect();
                    let (of, to) = item.counts();
                    let n = usize::try_from(of)
                        .ok()
                        .filter(|n| item.kind() == Kind::List && of == to && *n > 0)?;
                    let flat = flat.filter(|f| !f.is_empty() && f.len() % n == 0)?;
                    Some(flat.chunks(n).map(|c| Value::from(c.to_vec())).collect())
                })
            }
            DeValue::Integer(_) | DeValue::Float(_) if is_long(1) => Some(json!([item.mended(value)?])),
            DeValue::String(text) => {
                let parts: Vec<&str> =
                    text.trim_matches(['[', ']', '(', ')']).split([',', ';', ' ']).collect();
                let numbers: Option<Vec<f64>> = parts
                    .iter()
                    .map(|p| p.trim())
                    .filter(|p| !p.is_empty())
                    .map(|p| p.parse().ok())
                    .collect();
                match numbers.filter(|n| !n.is_empty() && is_long(n.len()) && item.kind() == Kind::Number) {
                    Some(numbers) => Some(numbers.into()),
                    None if is_long(1) => Some(json!([item.mended(value)?])),
                    None => None,
                }
            }
            _ => None,
        }
    }
}

fn whole(number: f64) -> Option<Value> {
    (number.fract() == 0.0 && number.abs() < 1e9 && number >= 0.0).then(|| json!(number as i64))
}

fn number(value: &DeValue<'_>) -> Option<Value> {
    matches!(value, DeValue::Integer(_) | DeValue::Float(_)).then(|| plain(value)).flatten()
}

/// A value of a text as JSON has it; `None` for a date, and for a number that JSON has not.
fn plain(value: &DeValue<'_>) -> Option<Value> {
    match value {
        DeValue::String(text) => Some(text.as_ref().into()),
        DeValue::Integer(number) => {
            i64::from_str_radix(number.as_str(), number.radix()).ok().map(Value::from)
        }
        DeValue::Float(number) => {
            number.as_str().parse::<f64>().ok().and_then(serde_json::Number::from_f64).map(Value::Number)
        }
        DeValue::Boolean(truth) => Some((*truth).into()),
        DeValue::Datetime(_) => None,
        DeValue::Array(list) => {
            list.iter().map(|v| plain(v.get_ref())).collect::<Option<Vec<_>>>().map(Value::Array)
        }
        DeValue::Table(table) => {
            let one = |(key, value): (&toml::Spanned<_>, &toml::Spanned<DeValue<'_>>)| {
                let key: &std::borrow::Cow<'_, str> = key.get_ref();
                Some((key.to_string(), plain(value.get_ref())?))
            };
            table.iter().map(one).collect::<Option<serde_json::Map<_, _>>>().map(Value::Object)
        }
    }
}
