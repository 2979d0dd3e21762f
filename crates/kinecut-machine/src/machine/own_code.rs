//! Codes that a machine's control has of its own.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::{Code, Finding, Result};

/// Effect of a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CodeEffect {
    /// Coordinates are those of the tool tip at the work, and the linear axes follow the rotary ones.
    TipControl,
    /// Coordinates are those of the axes.
    NoTipControl,
    /// It moves no axis and changes no coordinate: a device of the machine.
    NoMotion,
}

/// A G or M code that the maker of a machine has added to its control: a remap of LinuxCNC, a relay.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::{CodeEffect, OwnCode};
/// let code = OwnCode::parse("m428", CodeEffect::TipControl).unwrap();
/// assert_eq!((code.letter, code.tenths, code.to_string().as_str()), ('M', 4280, "M428"));
/// assert!(OwnCode::parse("X1", CodeEffect::NoMotion).is_err());
/// assert!(OwnCode::parse("M4.5", CodeEffect::NoMotion).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OwnCode {
    /// `G` or `M`.
    pub letter: char,
    /// Its number times ten.
    pub tenths: u32,
    /// Its effect.
    pub effect: CodeEffect,
}

impl OwnCode {
    /// The code of a name such as `M428` or `G68.2`.
    ///
    /// # Errors
    /// `KC0703` when the name is no G or M code.
    pub fn parse(name: &str, effect: CodeEffect) -> Result<OwnCode> {
        let wrong = || {
            Finding::error(Code::MACHINE_AXIS, format!("`{}` is no G or M code", name.escape_default()))
                .help("write it as \"M428\" or \"G68.2\"")
        };
        let letter = name.chars().next().map(|c| c.to_ascii_uppercase()).filter(|c| matches!(c, 'G' | 'M'));
        let letter = letter.ok_or_else(wrong)?;
        let (whole, part) = name[1..].split_once('.').unwrap_or((&name[1..], "0"));
        let digits = |t: &str, most: usize| {
            let ok = !t.is_empty() && t.len() <= most && t.bytes().all(|b| b.is_ascii_digit());
            ok.then(|| t.parse::<u32>().ok()).flatten()
        };
        let (Some(whole), Some(part)) = (digits(whole, 5), digits(part, 1)) else {
            return Err(wrong().into());
        };
        if letter == 'M' && part != 0 {
            return Err(wrong().into());
        }
        Ok(OwnCode { letter, tenths: whole * 10 + part, effect })
    }
}

impl std::fmt::Display for OwnCode {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}{}", self.letter, self.tenths / 10)?;
        match self.tenths % 10 {
            0 => Ok(()),
            part => write!(f, ".{part}"),
        }
    }
}
