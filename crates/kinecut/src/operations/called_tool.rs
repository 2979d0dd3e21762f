//! A tool as operations call it: by its number on the control, or by its name.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, de};

/// The number of a tool, or its name. Names are compared without case, and with any run of blanks as one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum CalledTool {
    /// Its number on the control.
    Number(u32),
    /// Its name.
    Name(String),
}

impl CalledTool {
    /// Whether it is the name of a tool of this name.
    ///
    /// ```
    /// use kinecut::operations::CalledTool;
    /// let called: CalledTool = serde_json::from_str("\"End  Mill 10\"").unwrap();
    /// assert!(called.is_name("end mill 10") && !called.is_name("end mill 1"));
    /// assert_eq!(serde_json::from_str::<CalledTool>("5").unwrap(), CalledTool::Number(5));
    /// ```
    pub fn is_name(&self, name: &str) -> bool {
        matches!(self, CalledTool::Name(called) if plain_name(called) == plain_name(name))
    }
}

impl Default for CalledTool {
    fn default() -> CalledTool {
        CalledTool::Number(0)
    }
}

impl From<u32> for CalledTool {
    fn from(number: u32) -> CalledTool {
        CalledTool::Number(number)
    }
}

impl fmt::Display for CalledTool {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CalledTool::Number(number) => write!(f, "T{number}"),
            CalledTool::Name(name) => write!(f, "`{}`", name.escape_debug()),
        }
    }
}

impl<'de> Deserialize<'de> for CalledTool {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<CalledTool, D::Error> {
        struct Called;

        impl de::Visitor<'_> for Called {
            type Value = CalledTool;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the number or the name of a tool")
            }

            fn visit_u64<E: de::Error>(self, v: u64) -> Result<CalledTool, E> {
                u32::try_from(v)
                    .map(CalledTool::Number)
                    .map_err(|_| E::invalid_value(de::Unexpected::Unsigned(v), &self))
            }

            fn visit_i64<E: de::Error>(self, v: i64) -> Result<CalledTool, E> {
                u32::try_from(v)
                    .map(CalledTool::Number)
                    .map_err(|_| E::invalid_value(de::Unexpected::Signed(v), &self))
            }

            fn visit_str<E: de::Error>(self, v: &str) -> Result<CalledTool, E> {
                Ok(CalledTool::Name(v.to_owned()))
            }
        }

        deserializer.deserialize_any(Called)
    }
}

/// A name as it is compared: in small letters, a run of blanks as one.
pub(crate) fn plain_name(name: &str) -> String {
    name.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase()
}
