//! The wear register of a finish along an outline.

use super::ContourFinishTable;
use crate::base::Result;
use crate::holes::Wear;
use crate::operations::wall::WearKeys;
use crate::operations::{Setting, WearRegister};
use crate::tool::Tool;

/// Largest wear of the register where the job does not say it [mm].
const USUAL_WEAR: f64 = 0.05;

impl ContourFinishTable {
    /// The register, read and checked.
    ///
    /// # Errors
    /// Those of [`WearKeys`], with the key of `finish`.
    pub(crate) fn wear(&self, setting: &Setting<'_>, tool: &Tool) -> Result<Option<Wear>> {
        let keys = WearKeys {
            register: self.wear_offset.as_deref(),
            largest: self.wear_largest,
            value: self.wear_value,
        };
        let wear = keys.wear(USUAL_WEAR).map_err(|e| e.under("finish"))?;
        keys.check(setting, tool.number, wear).map_err(|e| e.under("finish"))?;
        Ok(wear)
    }

    /// A register with the value with which it is simulated.
    pub(crate) fn register(&self, wear: Wear) -> WearRegister {
        WearRegister { number: wear.register, value: self.wear_value.unwrap_or(0.0) }
    }
}
