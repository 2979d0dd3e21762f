//! The wear register of a finish along an outline.

use super::{Compensation, ContourFinishTable};
use crate::base::Result;
use crate::holes::{CutterData, Wear};
use crate::operations::wall::WearKeys;
use crate::operations::{Setting, WearRegister};
use crate::tool::Tool;
use crate::trace::CompStart;

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
            full: self.compensation == Compensation::Full,
        };
        let wear = keys.wear(USUAL_WEAR).map_err(|e| e.under("finish"))?;
        keys.check(setting, tool.number, wear).map_err(|e| e.under("finish"))?;
        Ok(wear)
    }

    /// A register with the value with which it is simulated.
    pub(crate) fn register(&self, wear: Wear, tool: &Tool) -> WearRegister {
        let radius = match self.compensation {
            Compensation::Wear => 0.0,
            Compensation::Full => 0.5 * CutterData::of(tool).diameter,
        };
        WearRegister { number: wear.register, value: self.wear_value.unwrap_or(0.0), radius }
    }

    /// Least lengths of the entry and of the straight way behind it, in radii of the cutter, where the contour itself is posted.
    ///
    /// A control that ends its entry square to the first element comes to the beginning of the path from any direction, if the entry
    /// is longer than the radius. One that ends it square to the entry itself cuts an inside corner between entry and path: of 45 degrees
    /// after an entry of one radius, which takes tan(22.5) radii of the way behind it.
    pub(crate) fn onto_wall(&self, setting: &Setting<'_>) -> Option<[f64; 2]> {
        (self.compensation == Compensation::Full).then(|| match setting.post.control.comp_start() {
            CompStart::AtNext => [0.6, 0.0],
            CompStart::AtEntry => [1.0, 0.5],
        })
    }
}
