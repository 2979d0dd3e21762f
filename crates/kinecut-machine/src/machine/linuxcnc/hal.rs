//! Values of HAL pins: `setp pin value`, `sets signal value` with `net signal pins`, in HAL files and in `[HAL]HALCMD`
//! of the INI file; `[SECTION]KEY` in a value is looked up in the INI file.

use super::ini::Ini;
use super::{Fate, ImportedLine};
use crate::base::{FileId, Sources, Span};

/// A statement of the HAL.
#[derive(Clone, Debug)]
struct Statement {
    words: Vec<String>,
    span: Span,
    used: Option<String>,
}

/// The statements of all HAL files and commands, in order.
#[derive(Clone, Debug, Default)]
pub(super) struct Hal {
    statements: Vec<Statement>,
}

impl Hal {
    /// Reads the commands of the INI file, then the files. Statements that are not known are kept to be reported.
    pub(super) fn read(sources: &Sources, files: &[FileId], ini: &mut Ini) -> Hal {
        let mut hal = Hal::default();
        let commands: Vec<(String, Span)> =
            ini.all("HAL", "HALCMD").map(|e| (e.value.clone(), e.span)).collect();
        for (text, span) in commands {
            hal.add(&text, span, ini);
        }
        for &file in files {
            let name = sources.name(file).to_owned();
            let base = name.rsplit(['/', '\\']).next().unwrap_or(&name).to_owned();
            for entry in &mut ini.entries {
                if entry.section == "HAL" && entry.key.ends_with("HALFILE") && entry.value.ends_with(&base) {
                    entry.used = Some("read".to_owned());
                }
            }
            let mut start = 0usize;
            let mut joined = (String::new(), 0usize);
            for raw in sources.text(file).split_inclusive('\n') {
                let line = raw.trim();
                if joined.0.is_empty() {
                    joined.1 = start + (raw.len() - raw.trim_start().len());
                }
                start += raw.len();
                let (part, more) = match line.strip_suffix('\\') {
                    Some(part) => (part, true),
                    None => (line, false),
                };
                joined.0.push_str(part);
                if more {
                    joined.0.push(' ');
                    continue;
                }
                let (text, from) = std::mem::take(&mut joined);
                hal.add(&text, Span { file, start: from as u32, end: start as u32 }, ini);
            }
        }
        hal
    }

    fn add(&mut self, text: &str, span: Span, ini: &Ini) {
        let text = text.split('#').next().unwrap_or("").trim();
        if text.is_empty() {
            return;
        }
        let words = text.split_whitespace().map(|word| looked_up(word, ini)).collect();
        self.statements.push(Statement { words, span, used: None });
    }

    /// The value of a pin of a module, by `setp` or over a signal; the last one counts, as in the HAL.
    pub(super) fn take(&mut self, module: &str, pin: &str, what: &str) -> Option<(String, Span)> {
        let is_pin = |word: &str| {
            word.rsplit_once('.').is_some_and(|(m, p)| p.eq_ignore_ascii_case(pin) && same(m, module))
        };
        let mut found: Option<(usize, String)> = None;
        let mut links: Vec<usize> = Vec::new();
        let mut signals: Vec<String> = Vec::new();
        for (i, s) in self.statements.iter().enumerate() {
            match s.words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
                ["setp", name, value, ..] if is_pin(name) => found = Some((i, value.to_owned())),
                ["net", signal, ref pins @ ..] | ["linksp", signal, ref pins @ ..]
                    if pins.iter().any(|p| is_pin(p)) =>
                {
                    links.push(i);
                    signals.push(signal.to_owned());
                }
                ["linkps", name, signal, ..] if is_pin(name) => {
                    links.push(i);
                    signals.push(signal.to_owned());
                }
                _ => {}
            }
        }
        for (i, s) in self.statements.iter().enumerate() {
            if let [verb, signal, value, ..] = &s.words[..]
                && verb == "sets"
                && signals.contains(signal)
            {
                found = Some((i, value.clone()));
            }
        }
        let (i, value) = found?;
        for link in links {
            self.statements[link].used = Some(format!("carries {what}"));
        }
        self.statements[i].used = Some(format!("{what} = {value}"));
        Some((value, self.statements[i].span))
    }

    /// Fate of each statement.
    pub(super) fn lines(&self, sources: &Sources) -> Vec<ImportedLine> {
        let line = |s: &Statement| ImportedLine {
            file: sources.name(s.span.file).to_owned(),
            line: sources.line(s.span),
            text: s.words.join(" "),
            fate: match &s.used {
                Some(what) => Fate::Used(what.clone()),
                None => Fate::Ignored("sets no value of the kinematics".to_owned()),
            },
        };
        self.statements.iter().map(line).collect()
    }
}

/// True if two names are of one component: `xyzab_tdr_kins`, `xyzab-tdr-kins` and `xyzab-tdr` are.
pub(super) fn same(a: &str, b: &str) -> bool {
    let plain = |name: &str| {
        let name = name.to_ascii_lowercase().replace('_', "-");
        name.strip_suffix("-kins").map(str::to_owned).unwrap_or(name)
    };
    plain(a) == plain(b)
}

/// A word with `[SECTION]KEY` or `[SECTION](KEY)` replaced by the INI file's value.
fn looked_up(word: &str, ini: &Ini) -> String {
    let value = word.strip_prefix('[').and_then(|rest| rest.split_once(']')).and_then(|(section, key)| {
        let key = key.trim_start_matches('(').trim_end_matches(')').to_ascii_uppercase();
        let section = section.to_ascii_uppercase();
        ini.all(&section, &key).next().map(|e| e.value.clone())
    });
    value.unwrap_or_else(|| word.to_owned())
}
