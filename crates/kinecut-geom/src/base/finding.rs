//! Findings: the one form in which kinecut reports an error, a danger or a remark.
//!
//! An error of the library is a finding too: what is wrong, where, the value, the bound it broke and the
//! help, under a stable code with a manual page ([`crate::base::manual`]).

use std::fmt;

use serde::{Deserialize, Serialize};

use super::{Code, Location};

/// Severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Good to know.
    Note,
    /// Look at it before the first part.
    Warning,
    /// It could not be proven: neither right nor wrong is known.
    Doubt,
    /// Unsafe, wrong, or not possible.
    Error,
}

impl Severity {
    /// From the worst to the least.
    pub const WORST_FIRST: [Severity; 4] =
        [Severity::Error, Severity::Doubt, Severity::Warning, Severity::Note];

    /// The word before a message ("error", "not proven").
    pub fn word(self) -> &'static str {
        match self {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Doubt => "not proven",
            Severity::Error => "error",
        }
    }
}

/// A number with the unit in which it is shown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quantity {
    /// The number, in `unit`.
    pub value: f64,
    /// Unit as printed ("mm", "deg", "mm/min", "" for a count).
    pub unit: String,
}

impl Quantity {
    /// A number with its unit.
    pub fn new(value: f64, unit: &str) -> Quantity {
        Quantity { value, unit: unit.to_owned() }
    }

    /// A length [mm].
    pub fn mm(value: f64) -> Quantity {
        Quantity::new(value, "mm")
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded = (self.value * 1e6).round() / 1e6;
        // Without three hundred digits, and without a small value shown as zero.
        let long = self.value.abs() >= 1e15;
        let shown = if long || (rounded == 0.0 && self.value != 0.0) {
            format!("{:e}", self.value)
        } else {
            rounded.to_string()
        };
        if self.unit.is_empty() { f.write_str(&shown) } else { write!(f, "{shown} {}", self.unit) }
    }
}

/// One error, danger or remark: what, where, value, bound, help.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::base::{Code, Finding};
/// let f = Finding::error(Code::CUTTER_TOO_LARGE, "the cutter does not fit into the bore")
///     .value_mm(220.0).bound_mm(200.0).help("use a smaller cutter");
/// assert_eq!(f.to_string(), "the cutter does not fit into the bore: 220 mm, bound 200 mm; use a smaller cutter");
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Stable code.
    pub code: Code,
    /// Its severity.
    pub severity: Severity,
    /// The fault, without numbers that are in `value` and `bound`.
    pub message: String,
    /// Key in the job file to which the message belongs (`setup[0].operation[1].rough.step`).
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub key: Option<String>,
    /// Index of what it is about in a list that the caller has given: an item of a program, a pose. Whoever knows where that
    /// came from makes a place of it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub item: Option<u32>,
    /// Place in a file.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub place: Option<Location>,
    /// Place in space, part coordinates of the setup [mm].
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub point: Option<[f64; 3]>,
    /// The offending value.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub value: Option<Quantity>,
    /// The bound it broke.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub bound: Option<Quantity>,
    /// The remedy; may be empty.
    #[serde(skip_serializing_if = "String::is_empty", default, alias = "cure")]
    pub help: String,
}

impl Finding {
    /// A finding of the given severity.
    pub fn new(code: Code, severity: Severity, message: impl Into<String>) -> Finding {
        Finding {
            code,
            severity,
            message: message.into(),
            key: None,
            item: None,
            place: None,
            point: None,
            value: None,
            bound: None,
            help: String::new(),
        }
    }

    /// An error.
    pub fn error(code: Code, message: impl Into<String>) -> Finding {
        Finding::new(code, Severity::Error, message)
    }

    /// A warning.
    pub fn warning(code: Code, message: impl Into<String>) -> Finding {
        Finding::new(code, Severity::Warning, message)
    }

    /// A doubt: something that could not be proven.
    pub fn doubt(code: Code, message: impl Into<String>) -> Finding {
        Finding::new(code, Severity::Doubt, message)
    }

    /// A note.
    pub fn note(code: Code, message: impl Into<String>) -> Finding {
        Finding::new(code, Severity::Note, message)
    }

    /// With the offending value.
    #[must_use]
    pub fn value(mut self, value: f64, unit: &str) -> Finding {
        self.value = Some(Quantity::new(value, unit));
        self
    }

    /// With the offending length [mm].
    #[must_use]
    pub fn value_mm(self, value: f64) -> Finding {
        self.value(value, "mm")
    }

    /// With the bound that was broken.
    #[must_use]
    pub fn bound(mut self, value: f64, unit: &str) -> Finding {
        self.bound = Some(Quantity::new(value, unit));
        self
    }

    /// With the bound that was broken [mm].
    #[must_use]
    pub fn bound_mm(self, value: f64) -> Finding {
        self.bound(value, "mm")
    }

    /// With the help.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Finding {
        self.help = help.into();
        self
    }

    /// With the job key it belongs to; an earlier, more precise key stays as the tail.
    #[must_use]
    pub fn key(mut self, key: impl Into<String>) -> Finding {
        self.key = Some(key.into());
        self
    }

    /// With the index of the item that it is about.
    #[must_use]
    pub fn item(mut self, item: u32) -> Finding {
        self.item = Some(item);
        self
    }

    /// Puts a prefix before the key (`setup[0]` and `offset` give `setup[0].offset`).
    #[must_use]
    pub fn under(mut self, prefix: &str) -> Finding {
        self.key = Some(match self.key.take() {
            Some(key) if key.starts_with('[') => format!("{prefix}{key}"),
            Some(key) => format!("{prefix}.{key}"),
            None => prefix.to_owned(),
        });
        self
    }

    /// With its place in a file.
    #[must_use]
    pub fn at(mut self, place: Location) -> Finding {
        self.place = Some(place);
        self
    }

    /// With its place in space [mm].
    #[must_use]
    pub fn point(mut self, point: [f64; 3]) -> Finding {
        self.point = Some(point);
        self
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.place {
            match place.line {
                0 => write!(f, "{}: ", place.file)?,
                line => write!(f, "{}:{}:{}: ", place.file, line, place.column)?,
            }
        }
        f.write_str(&self.message)?;
        match (&self.value, &self.bound) {
            (Some(value), Some(bound)) => write!(f, ": {value}, bound {bound}")?,
            (Some(value), None) => write!(f, ": {value}")?,
            (None, Some(bound)) => write!(f, ": bound {bound}")?,
            (None, None) => {}
        }
        if !self.help.is_empty() {
            write!(f, "; {}", self.help)?;
        }
        Ok(())
    }
}

/// The error of every layer: a boxed [`Finding`] of severity error.
#[derive(Clone, Debug, PartialEq)]
pub struct Error(pub Box<Finding>);

impl Error {
    /// The stable code.
    pub fn code(&self) -> Code {
        self.0.code
    }

    /// The error with a prefix before its job key.
    #[must_use]
    pub fn under(self, prefix: &str) -> Error {
        Error(Box::new(self.0.under(prefix)))
    }
}

impl From<Finding> for Error {
    fn from(finding: Finding) -> Error {
        Error(Box::new(finding))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Error {}

/// Result of a fallible function of the library.
pub type Result<T> = std::result::Result<T, Error>;
