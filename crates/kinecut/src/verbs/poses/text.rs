//! Poses as written: JSON (an object, or a list), or a line of words each (`X10 A-30`, as on a control).

use serde_json::Value;

use crate::base::{Code, Error, Finding, Result, Sources, Span};

/// Numbers under letters, in the order written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PoseWords {
    /// Letter and number.
    pub words: Vec<(char, f64)>,
}

/// The poses of a text.
#[derive(Clone, Debug, Default)]
pub struct PoseTexts {
    /// Each as read, or why it cannot be.
    pub items: Vec<Result<PoseWords>>,
    /// Whether the text is a list, so that the answer is one too.
    pub list: bool,
    /// Place of each item, for texts of words.
    spans: Vec<Span>,
    sources: Sources,
}

impl PoseTexts {
    /// Reads a text: JSON if it begins with `[` or `{`, lines of words otherwise (empty lines and what follows `;`, `#`
    /// or `(` are left out; one line alone is no list). In JSON a pose is an object of letters (`{"X": 10, "A": -30}`),
    /// or has `tip` and `axis` (three numbers each) for X Y Z and I J K.
    ///
    /// # Errors
    /// `KC0101` for a text that begins like JSON and is not; `KC0102` for one without any pose. An error of one
    /// pose is in its place.
    pub fn read(name: &str, text: &str) -> Result<PoseTexts> {
        if text.trim_start().starts_with(['[', '{']) {
            return PoseTexts::json(text);
        }
        let mut poses = PoseTexts::default();
        let file = poses.sources.add(name, text);
        let mut start = 0usize;
        for raw in text.split_inclusive('\n') {
            let line = raw.split([';', '#', '(']).next().unwrap_or("").trim_end();
            let span = Span { file, start: start as u32, end: (start + line.len()) as u32 };
            if !line.trim().is_empty() {
                poses.spans.push(span);
                let item = words(line).map_err(|(from, to, what)| {
                    let span = Span { file, start: span.start + from as u32, end: span.start + to as u32 };
                    Finding::error(Code::JOB_SHAPE, what)
                        .at(poses.sources.locate(span))
                        .help("write letters with numbers, as in X10 Y-3.5 A30")
                        .into()
                });
                poses.items.push(item);
            }
            start += raw.len();
        }
        if poses.items.is_empty() {
            return Err(Finding::error(Code::JOB_SHAPE, "there is no pose")
                .help("write a line of words for each, as in X10 Y-3.5 A30, or JSON")
                .into());
        }
        poses.list = poses.items.len() > 1;
        Ok(poses)
    }

    /// The one pose of a text.
    ///
    /// # Errors
    /// As [`PoseTexts::read`], with the place of the error; `KC0102` for several poses.
    pub fn one(name: &str, text: &str) -> Result<PoseWords> {
        let mut poses = PoseTexts::read(name, text)?;
        if poses.items.len() > 1 || poses.list {
            return Err(Finding::error(Code::JOB_SHAPE, format!("{name} has more than one pose"))
                .value(poses.items.len() as f64, "")
                .bound(1.0, "")
                .help("write one line of words, as in X10 Y-3.5 A30")
                .into());
        }
        poses.items.remove(0).map_err(|e| poses.locate(0, e))
    }

    fn json(text: &str) -> Result<PoseTexts> {
        let value: Value = serde_json::from_str(text)
            .map_err(|e| Finding::error(Code::JOB_SYNTAX, format!("the text is no JSON: {e}")))?;
        let (values, list) = match value {
            Value::Array(values) => (values, true),
            one => (vec![one], false),
        };
        let items = values.iter().map(of_json).collect();
        Ok(PoseTexts { items, list, ..PoseTexts::default() })
    }

    /// An item's error with its place in the text.
    pub fn locate(&self, index: usize, mut error: Error) -> Error {
        match self.spans.get(index) {
            Some(&span) => {
                if error.0.place.is_none() {
                    error.0.place = Some(self.sources.locate(span));
                }
                error
            }
            None if self.list => error.under(&format!("[{index}]")),
            None => error,
        }
    }
}

/// The words of a line, or the bytes of the fault and what it is.
fn words(line: &str) -> std::result::Result<PoseWords, (usize, usize, String)> {
    let bytes = line.as_bytes();
    let mut pose = PoseWords::default();
    let mut at = 0;
    while at < bytes.len() {
        let c = bytes[at];
        if c.is_ascii_whitespace() || c == b',' {
            at += 1;
            continue;
        }
        if !c.is_ascii_alphabetic() {
            let end = at + line[at..].chars().next().map_or(1, char::len_utf8);
            return Err((at, end, format!("`{}` is no letter of an axis", &line[at..end])));
        }
        let letter = c.to_ascii_uppercase() as char;
        let from = at;
        at += 1;
        while at < bytes.len() && (bytes[at] == b'=' || bytes[at] == b' ') {
            at += 1;
        }
        let start = at;
        while at < bytes.len()
            && (bytes[at].is_ascii_digit()
                || matches!(bytes[at], b'+' | b'-' | b'.')
                || (matches!(bytes[at], b'e' | b'E') && at > start && is_exponent(&bytes[at + 1..])))
        {
            at += 1;
        }
        let value = line[start..at].parse::<f64>().ok().filter(|v| v.is_finite());
        let Some(value) = value else {
            return Err((from, at.max(from + 1), format!("{letter} has no number")));
        };
        pose.words.push((letter, value));
    }
    Ok(pose)
}

/// Whether these bytes go on with an exponent: digits, with a sign before them or none.
fn is_exponent(rest: &[u8]) -> bool {
    match rest {
        [b'+' | b'-', digit, ..] | [digit, ..] => digit.is_ascii_digit(),
        [] => false,
    }
}

fn of_json(value: &Value) -> Result<PoseWords> {
    let Value::Object(map) = value else {
        return Err(Finding::error(Code::JOB_SHAPE, "a pose is an object of letters and numbers")
            .help("write {\"X\": 10, \"A\": -30}, or {\"tip\": [10, 0, 5], \"axis\": [0, 0, 1]}")
            .into());
    };
    let mut pose = PoseWords::default();
    for (key, value) in map {
        let letters: [char; 3] = match key.as_str() {
            "tip" => ['X', 'Y', 'Z'],
            "axis" => ['I', 'J', 'K'],
            letter => {
                let mut chars = letter.chars();
                let (Some(c), None) = (chars.next(), chars.next()) else {
                    return Err(shape(key, format!("`{key}` is no letter of an axis")));
                };
                let Some(v) = value.as_f64() else {
                    return Err(shape(key, format!("{key} has no number")));
                };
                pose.words.push((c.to_ascii_uppercase(), v));
                continue;
            }
        };
        let numbers: Option<Vec<f64>> =
            value.as_array().map(|list| list.iter().filter_map(Value::as_f64).collect());
        match numbers.as_deref() {
            Some([x, y, z]) if value.as_array().is_some_and(|list| list.len() == 3) => {
                pose.words.extend(letters.into_iter().zip([*x, *y, *z]));
            }
            _ => return Err(shape(key, format!("{key} has three numbers"))),
        }
    }
    Ok(pose)
}

fn shape(key: &str, message: String) -> Error {
    Finding::error(Code::JOB_SHAPE, message).key(key).into()
}
