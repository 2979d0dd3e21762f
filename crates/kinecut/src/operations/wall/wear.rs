//! The wear register of a finishing pass as a table gives it: the name read, and checked against the control.

use crate::base::{Code, Finding, Result};
use crate::holes::Wear;
use crate::operations::Setting;
use crate::program::ToolNumber;

/// The keys `wear_offset`, `wear_largest`, `wear_value` of a table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WearKeys<'a> {
    pub(crate) register: Option<&'a str>,
    pub(crate) largest: Option<f64>,
    pub(crate) value: Option<f64>,
    /// Whether the register holds the cutter's radius.
    pub(crate) full: bool,
}

/// Largest register that a control has.
const MOST_REGISTER: u32 = 999;

impl WearKeys<'_> {
    /// The register; `usual`: the largest value that it may get where the table does not say [mm].
    ///
    /// # Errors
    /// `KC0103` for a name that is no wear register.
    pub(crate) fn wear(self, usual: f64) -> Result<Option<Wear>> {
        let Some(name) = self.register else { return Ok(None) };
        let number = name.strip_prefix(['D', 'd']).and_then(|n| n.parse().ok());
        let register = number.filter(|n| (1..=MOST_REGISTER).contains(n)).ok_or_else(|| {
            Finding::error(Code::JOB_VALUE, format!("`{}` is no wear register", name.escape_default()))
                .help("write the letter D and a number, such as \"D2\"")
                .key("wear_offset")
        })?;
        Ok(Some(Wear { register, largest: self.largest.unwrap_or(usual) }))
    }

    /// Checks that the control offers the wear register, which no tool has as its length, and the value to simulate with.
    ///
    /// # Errors
    /// `KC0102`, `KC0103`, `KC0301` with the key of the table.
    pub(crate) fn check(self, setting: &Setting<'_>, tool: ToolNumber, wear: Option<Wear>) -> Result<()> {
        let Some(wear) = wear else {
            if self.value.is_some() || self.largest.is_some() {
                return Err(Finding::error(
                    Code::JOB_SHAPE,
                    "a value of the wear register needs the register",
                )
                .help("add wear_offset = \"D2\"")
                .key("wear_value")
                .into());
            }
            if self.full {
                let finding = Finding::error(
                    Code::JOB_SHAPE,
                    "compensation by the control needs the register of the radius",
                );
                return Err(finding.help("add wear_offset = \"D2\"").key("wear_offset").into());
            }
            return Ok(());
        };
        let value = self.value.unwrap_or(0.0);
        if !(value.abs() <= wear.largest) {
            return Err(Finding::error(Code::JOB_VALUE, "the wear exceeds what the pass is planned for")
                .value_mm(value)
                .bound_mm(wear.largest)
                .help("raise `wear_largest`, or finish with another cutter")
                .key("wear_value")
                .into());
        }
        let control = setting.post.control;
        if !control.has_compensation() {
            return Err(Finding::error(
                Code::POST_CONTROL,
                format!("{} has no cutter compensation", control.title()),
            )
            .help("leave out `wear_offset`")
            .key("wear_offset")
            .into());
        }
        if !self.full && wear.register == control.length_register(tool) {
            return Err(Finding::error(
                Code::JOB_VALUE,
                format!(
                    "the register D{} is that of {tool} itself and may hold its whole radius",
                    wear.register
                ),
            )
            .help(format!(
                "use a register of its own that holds the wear only: D{}",
                control.wear_register(tool)
            ))
            .key("wear_offset")
            .into());
        }
        Ok(())
    }
}
