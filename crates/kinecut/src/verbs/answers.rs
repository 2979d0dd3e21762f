//! Answers to the questions of one text: as one JSON document, and as an exit code.

use serde::Serialize;

use super::Answer;
use crate::base::{Error, Finding, Severity};
use crate::page::terminal;

/// The answers given so far.
///
/// ```
/// use kinecut::base::Severity;
/// use kinecut::verbs::{Answers, explain};
/// let mut answers = Answers::new(false, Severity::Doubt);
/// let text = answers.json(explain::page("KC0501").as_ref());
/// assert!(text.contains("\"code\": \"KC0501\"") && text.ends_with("}\n"));
/// assert_eq!(answers.exit_code(), 0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Answers {
    list: bool,
    least: Severity,
    count: usize,
    parts: usize,
    failed: usize,
    told: bool,
}

impl Answers {
    /// None yet; for a `list` of questions the answers are a list. Findings of the `least` severity and above count in the exit
    /// code.
    pub fn new(list: bool, least: Severity) -> Answers {
        Answers { list, least, count: 0, parts: 0, failed: 0, told: false }
    }

    /// Number of answers so far.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Takes one into account.
    pub fn add<A: Answer>(&mut self, one: Result<&A, &Error>) {
        let [parts, failed] = one.map_or([1, 1], Answer::parts);
        self.parts += parts;
        self.failed += failed;
        let found = |answer: &A| answer.findings().into_iter().any(|f| f.severity >= self.least);
        self.told |= one.is_ok_and(|answer| answer.is_no() || found(answer));
        self.count += 1;
    }

    /// Takes one into account; its text in the document, with what stands before it.
    pub fn json<A: Answer>(&mut self, one: Result<&A, &Error>) -> String {
        #[derive(Serialize)]
        struct Wrong<'a> {
            error: &'a Finding,
        }
        let text = match one {
            Ok(answer) => pretty(answer),
            Err(error) if self.list => pretty(&Wrong { error: &error.0 }),
            Err(error) => pretty(&*error.0),
        };
        let text = match (self.list, self.count) {
            (false, _) => format!("{text}\n"),
            (true, 0) => format!("[\n  {}", text.replace('\n', "\n  ")),
            (true, _) => format!(",\n  {}", text.replace('\n', "\n  ")),
        };
        self.add(one);
        text
    }

    /// The end of the document.
    pub fn json_end(&self) -> &'static str {
        match (self.list, self.count) {
            (false, _) => "",
            (true, 0) => "[]\n",
            (true, _) => "\n]\n",
        }
    }

    /// The exit code of a verb: 0 done; 1 a no, findings that count, or a part that could not be answered; 2 nothing could be.
    pub fn exit_code(&self) -> u8 {
        match self.failed {
            0 if self.told => 1,
            0 => 0,
            failed if failed == self.parts => 2,
            _ => 1,
        }
    }
}

/// A value as a JSON document with a line end; what a terminal would obey is written as JSON escapes, which mean the same.
///
/// ```
/// assert_eq!(kinecut::verbs::json_document(&"a\u{202e}b"), "\"a\\u202eb\"\n");
/// ```
pub fn json_document(value: &impl Serialize) -> String {
    format!("{}\n", pretty(value))
}

fn pretty(value: &impl Serialize) -> String {
    // Serialisation of plain data to a string fails only for maps with keys that are no strings; there are none.
    let text = serde_json::to_string_pretty(value);
    debug_assert!(text.is_ok(), "{:?}", text.as_ref().err());
    harmless(&text.unwrap_or_default())
}

/// JSON text without characters that steer a terminal; outside of its strings there are none.
fn harmless(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if c == '\n' || *terminal(c.encode_utf8(&mut [0; 4])) == *c.encode_utf8(&mut [0; 4]) {
            out.push(c);
        } else {
            c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| out.push_str(&format!("\\u{unit:04x}")));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_document_steers_a_terminal() {
        let text = "a\u{1b}]0;x\u{7}\u{9b}31m\u{202e}\nb\r\tc";
        let json = json_document(&[text, "Ø µm"]);
        assert!(json.chars().all(|c| c == '\n' || !(c.is_control() || c == '\u{202e}')));
        assert_eq!(serde_json::from_str::<Vec<String>>(&json).ok(), Some(vec![text.into(), "Ø µm".into()]));
    }

    #[test]
    fn a_list_is_a_document_and_an_item_that_fails_has_its_error() {
        let page = super::super::explain::page("KC0501");
        let none = super::super::explain::page("KC9999");
        let mut answers = Answers::new(true, Severity::Doubt);
        let mut text = answers.json(page.as_ref());
        text += &answers.json(none.as_ref());
        text += answers.json_end();
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value[0]["code"], "KC0501");
        assert_eq!(value[1]["error"]["code"], "KC0104");
        assert!(text.starts_with("[\n  {\n    \"code\"") && text.ends_with("\n  }\n]\n"), "{text}");
        assert_eq!((answers.exit_code(), Answers::new(true, Severity::Doubt).json_end()), (1, "[]\n"));
    }
}
