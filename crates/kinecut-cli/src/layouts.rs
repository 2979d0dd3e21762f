//! The verb `layouts`: all layouts of a code or a set of axes.

use std::path::PathBuf;

use kinecut::base::{Error, Silent};
use kinecut::machine::layouts::Query;
use kinecut::verbs::layouts::{LISTED, LayoutWants, layout_sheet};

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
    #[arg(long, default_value_t = LISTED, value_name = "N")]
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
        answer(args, to, layout_sheet(&self.of, &self.query()?, &Silent)?)
    }

    fn query(&self) -> Result<Query, Error> {
        let wants = LayoutWants {
            full: self.full,
            regular: self.regular,
            work_links: self.work_links,
            work_axes: self.work_axes.clone(),
            tool_axes: self.tool_axes.clone(),
            kind: self.kind.clone(),
            tilt: self.tilt,
            stroke: self.stroke,
            part: self.part,
            tool_length: self.tool_length,
            stacking: self.stacking,
            spindle: self.spindle.clone(),
            quarter_turns: self.quarter_turns,
            weight: self.weight.clone(),
            show: Some(self.show),
        };
        wants.query(&self.of)
    }
}
