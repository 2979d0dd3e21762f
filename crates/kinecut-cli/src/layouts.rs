//! The verb `layouts`: all layouts of a code or a set of axes.

use std::path::PathBuf;

use kinecut::base::Error;
use kinecut::machine::layouts::{Query, Search, Stacking};
use kinecut::verbs::layouts::{attitudes, criteria, kinds, layout_sheet, motions};

use crate::answers::{To, answer};
use crate::numbers::{stacking, triple, weight};
use crate::printing::Printing;

#[derive(Debug, clap::Args)]
pub(crate) struct Layouts {
    /// A code (641203), a chain of ISO 10791, letters of axes in any order (XYZAC), or "regular"
    of: String,
    /// Only layouts of full mobility
    #[arg(long)]
    full: bool,
    /// Only layouts whose translations stay at right angles
    #[arg(long)]
    regular: bool,
    /// Most axes that carry the work; 0 or 1 for a heavy part
    #[arg(long, value_name = "N")]
    work_links: Option<usize>,
    /// Only these axes may carry the work: XYC
    #[arg(long, value_name = "AXES")]
    work_axes: Option<String>,
    /// Only these axes may carry the tool: XYZ
    #[arg(long, value_name = "AXES")]
    tool_axes: Option<String>,
    /// Kind: table-table, head-table, head-head, table, head, linear; may be given again
    #[arg(long)]
    kind: Vec<String>,
    /// Tilt of the tool from home that must be reached, degrees
    #[arg(long, value_name = "DEG")]
    tilt: Option<f64>,
    /// Strokes of X, Y, Z, mm: 600,500,500; shows measures of the workspace too
    #[arg(long, value_name = "X,Y,Z", value_parser = triple)]
    stroke: Option<[f64; 3]>,
    /// Size of the part, mm; with strokes, only layouts that have room for it
    #[arg(long, value_name = "X,Y,Z", value_parser = triple)]
    part: Option<[f64; 3]>,
    /// Distance from the tip to the rotary axes of a head, mm
    #[arg(long, value_name = "MM")]
    tool_length: Option<f64>,
    /// At most so many translations on the tool side where a stroke is above so many mm: 2,1000
    #[arg(long, value_name = "N,MM", value_parser = stacking)]
    stacking: Option<(usize, f64)>,
    /// Stand of the spindle: vertical, horizontal, both
    #[arg(long)]
    spindle: Option<String>,
    /// Layouts that differ by a quarter turn of the machine count once
    #[arg(long)]
    quarter_turns: bool,
    /// Weight of a score, instead of the usual: moved-mass=2; may be given again
    #[arg(long, value_name = "NAME=WEIGHT", value_parser = weight)]
    weight: Vec<(String, f64)>,
    /// Number of layouts listed
    #[arg(long, default_value_t = 24, value_name = "N")]
    show: usize,
    /// Draw those that are listed, to scale, into this SVG file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Folder for layouts.html, made if it is not there
    #[arg(long)]
    out: Option<PathBuf>,
}

impl Layouts {
    /// Searches for layouts.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let to = To { out: self.out.as_deref(), svg: self.svg.as_deref(), ..To::default() };
        answer(args, to, layout_sheet(&self.of, &self.query()?)?)
    }

    fn query(&self) -> Result<Query, Error> {
        let mut query = Query::new(Search::parse(&self.of)?);
        query.quarter_turns_are_one = self.quarter_turns;
        query.listed = self.show;
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
