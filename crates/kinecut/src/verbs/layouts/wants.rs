//! A question about layouts as options put it, in the units of the shop.

use serde::Deserialize;

use super::{attitudes, criteria, kinds, motions};
use crate::base::Result;
use crate::machine::layouts::{Query, Search, Stacking};

/// Layouts listed where nothing is said.
pub const LISTED: usize = 24;

/// Conditions, sizes and weights by the names of the options of `kinecut layouts`.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
pub struct LayoutWants {
    /// Only layouts of full mobility.
    pub full: bool,
    /// Only layouts whose translations stay at right angles.
    pub regular: bool,
    /// Most axes that carry the work.
    pub work_links: Option<usize>,
    /// Letters of the axes that may carry the work.
    pub work_axes: Option<String>,
    /// Letters of the axes that may carry the tool.
    pub tool_axes: Option<String>,
    /// Kinds by their names; all where none is named.
    pub kind: Vec<String>,
    /// Tilt of the tool from home that must be reached [deg].
    pub tilt: Option<f64>,
    /// Strokes of X, Y, Z [mm].
    pub stroke: Option<[f64; 3]>,
    /// Size of the part [mm].
    pub part: Option<[f64; 3]>,
    /// Distance from the tip to the rotary axes of a head [mm].
    pub tool_length: Option<f64>,
    /// At most so many translations on the tool side where a stroke is above so many mm.
    pub stacking: Option<(usize, f64)>,
    /// "vertical", "horizontal", "both".
    pub spindle: Option<String>,
    /// Whether layouts that differ by a quarter turn of the machine count once.
    pub quarter_turns: bool,
    /// Weights of scores by their names, instead of the usual.
    pub weight: Vec<(String, f64)>,
    /// Number of layouts listed.
    pub show: Option<usize>,
}

impl LayoutWants {
    /// The question about a code, a chain, or letters of axes.
    ///
    /// # Errors
    /// `KC0102` for a name that is not known; those of [`Search::parse`].
    pub fn query(&self, of: &str) -> Result<Query> {
        let mut query = Query::new(Search::parse(of)?);
        query.quarter_turns_are_one = self.quarter_turns;
        query.listed = self.show.unwrap_or(LISTED);
        query.workspaces = self.stroke.is_some() || self.part.is_some();
        query.attitudes = attitudes(self.spindle.as_deref().unwrap_or("vertical"))?;
        let conditions = &mut query.conditions;
        conditions.full_mobility = self.full;
        conditions.regular = self.regular;
        conditions.most_work_links = self.work_links;
        conditions.work_motions = self.work_axes.as_deref().map(motions).transpose()?;
        conditions.tool_motions = self.tool_axes.as_deref().map(motions).transpose()?;
        conditions.tilt = self.tilt.map(f64::to_radians);
        conditions.stacking = self.stacking.map(|(most, above)| Stacking { most, above });
        conditions.within_stroke = self.stroke.is_some() && self.part.is_some();
        conditions.kinds = if self.kind.is_empty() { None } else { Some(kinds(&self.kind)?) };
        query.sizes.stroke = self.stroke.unwrap_or(query.sizes.stroke);
        query.sizes.part = self.part;
        query.sizes.tool_length = self.tool_length.unwrap_or(query.sizes.tool_length);
        if !self.weight.is_empty() {
            query.weights = criteria(&self.weight)?;
        }
        Ok(query)
    }
}
