//! Cutting data of a shop in a file of their own.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{EdgeName, UnitsName};
use crate::base::Result;
use crate::base::bounded::{positive, text};

/// Cutting data of a shop: the first row that fits has the number that neither an operation nor the preset of its tool has.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CuttingFileTable {
    /// Unit of its lengths: "mm", or "in" for inches, with feeds in in/min and cutting speeds in ft/min; default mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units: Option<UnitsName>,
    /// The rows.
    #[serde(default, rename = "cutting")]
    pub rows: Vec<CuttingRow>,
}

/// A row: speeds and feeds, and the cuts for which they are.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CuttingRow {
    /// The material of the part, as `material` of a job names it.
    #[schemars(example = &"C45")]
    pub material: String,
    /// The kind of the tool.
    #[schemars(example = &"end-mill")]
    pub tool: CuttingTool,
    /// The material of its edges; default: any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tool_material: Option<EdgeName>,
    /// Least and greatest diameter of the tool; default: any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diameter: Option<[f64; 2]>,
    /// Largest angle of the cutter's circle that cuts, degrees: 180 is the full width, which contours and slots have; default 180.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub engagement: Option<f64>,
    /// Cutting speed, m/min.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutting_speed: Option<f64>,
    /// Feed per tooth of mills.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feed_per_tooth: Option<f64>,
    /// Feed per revolution of drills and reamers, mm/rev.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feed_per_rev: Option<f64>,
}

/// Kinds of tools by what they do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CuttingTool {
    /// An end mill, ball-nosed or with a corner radius too.
    EndMill,
    /// A face mill.
    FaceMill,
    /// A cutter that breaks edges.
    Chamfer,
    /// A drill in the solid.
    Drill,
    /// A spot drill or a countersink.
    SpotDrill,
    /// A reamer.
    Reamer,
    /// A tap.
    Tap,
    /// A thread mill.
    ThreadMill,
}

impl CuttingRow {
    /// Checks its numbers.
    ///
    /// # Errors
    /// `KC0103` with the key of the first that is out of range.
    pub(in crate::job) fn check(&self) -> Result<()> {
        text("material", &self.material)?;
        let [least, most] = self.diameter.unwrap_or([0.0, 1.0]);
        positive("diameter[1]", most, 1000.0, "mm")?;
        if least != 0.0 {
            positive("diameter[0]", least, most, "mm")?;
        }
        for (key, value, most, unit) in [
            ("engagement", self.engagement, 180.0, "deg"),
            ("cutting_speed", self.cutting_speed, 10_000.0, "m/min"),
            ("feed_per_tooth", self.feed_per_tooth, 100.0, "mm"),
            ("feed_per_rev", self.feed_per_rev, 100.0, "mm"),
        ] {
            value.map(|v| positive(key, v, most, unit)).transpose()?;
        }
        Ok(())
    }
}
