//! Forms and values in words.

use toml::de::DeValue;

use super::{Form, Kind, Unit};

/// Most choices that a message lists.
const LISTED: usize = 20;
/// Most letters of a text that a message repeats.
const SHOWN: usize = 40;

impl Form<'_> {
    /// The first words about its key, without what is in brackets.
    pub(in crate::job) fn first_words(self) -> String {
        let line = self.about.split("\n\n").next().unwrap_or_default().replace('\n', " ");
        let mut depth = 0u32;
        let mut words = String::new();
        for c in line.chars() {
            match c {
                '(' => depth += 1,
                ')' => depth = depth.saturating_sub(1),
                '.' | ';' if depth == 0 => break,
                c if depth == 0 => words.push(c),
                _ => {}
            }
        }
        words.replace(" ,", ",").replace("  ", " ").trim().to_owned()
    }

    /// The words of a value that it takes: "a number in rev/min".
    pub(in crate::job) fn takes(self) -> String {
        match self.kind() {
            Kind::Number => match self.unit() {
                Some(Unit::Of(unit)) => format!("a number in {unit}"),
                _ => "a number".to_owned(),
            },
            Kind::Whole => match self.bounds() {
                (Some(least), Some(most)) => format!("a whole number from {least} to {most}"),
                (Some(least), None) => format!("a whole number from {least}"),
                _ => "a whole number".to_owned(),
            },
            Kind::Text => "a text in quotes".to_owned(),
            Kind::Truth => "true or false".to_owned(),
            Kind::Word(word) => format!("\"{word}\""),
            Kind::List => format!("a list of {}", self.items_in_words()),
            Kind::Table => match self.required().next() {
                Some(key) if self.required().count() == 1 && self.keys().count() == 1 => {
                    format!("a table {{ {key} = .. }}")
                }
                _ => "a table".to_owned(),
            },
            Kind::Choice => {
                let mut all: Vec<String> = Vec::new();
                for words in self.choices().into_iter().map(Form::takes) {
                    let keyed = |words: &String| words.starts_with("a table {");
                    let words = match words.strip_prefix("a table ") {
                        Some(rest) if all.last().is_some_and(|last| keyed(last) || last.starts_with('{')) => {
                            rest.to_owned()
                        }
                        _ => words,
                    };
                    if !all.contains(&words) {
                        all.push(words);
                    }
                }
                all.truncate(LISTED);
                match all.split_last() {
                    Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
                    _ => all.concat(),
                }
            }
            Kind::Any => "another value".to_owned(),
        }
    }

    /// The items of a list, more than one: "2 numbers in mm".
    fn items_in_words(self) -> String {
        let item = self.item();
        let words = match item.kind() {
            Kind::Number => match item.unit() {
                Some(Unit::Of(unit)) => format!("numbers in {unit}"),
                _ => "numbers".to_owned(),
            },
            Kind::Whole => "whole numbers".to_owned(),
            Kind::Text => "texts in quotes".to_owned(),
            Kind::List => format!("lists, {} each", item.items_in_words()),
            Kind::Table => "tables".to_owned(),
            _ => format!("which each is {}", item.takes()),
        };
        match self.counts() {
            (least, most) if least == most => format!("{least} {words}"),
            (least, most) if least > 0 && most < u64::MAX => format!("{least} to {most} {words}"),
            _ => words,
        }
    }
}

/// A value of a text in words.
pub(in crate::job) fn given(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => {
            let mut short: String = text.chars().take(SHOWN).collect();
            if short.len() < text.len() {
                short.push_str("..");
            }
            format!("{short:?}")
        }
        DeValue::Integer(number) => number.to_string(),
        DeValue::Float(number) => number.to_string(),
        DeValue::Boolean(truth) => truth.to_string(),
        DeValue::Datetime(date) => format!("the date {date}"),
        DeValue::Array(list) => match list.len() {
            0 => "an empty list".to_owned(),
            1 => "a list of one".to_owned(),
            n => format!("a list of {n}"),
        },
        DeValue::Table(_) => "a table".to_owned(),
    }
}
