//! Slots as outlines: a line or an arc of a width, with round ends.

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::bounded::{MAX_LENGTH, bounded, length, positive};
use crate::base::{Code, Finding, Result};
use crate::clearing::CentreLine;
use crate::geom::Outline;

/// A slot: a line or an arc of a width, with round ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutlineSlot {
    /// Centres of its two round ends, in coordinates of the work offset; or give `arc`.
    #[serde(default)]
    pub line: Option<[[f64; 2]; 2]>,
    /// Its centre line as an arc between the centres of its ends.
    #[serde(default)]
    pub arc: Option<SlotArc>,
    /// Its width.
    #[schemars(example = 12)]
    pub width: f64,
}

/// The centre line of a curved slot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SlotArc {
    /// Centre of the arc, in coordinates of the work offset; default [0, 0].
    #[serde(default)]
    pub centre: [f64; 2],
    /// Radius of the arc, at the middle of the slot.
    #[schemars(example = 30)]
    pub radius: f64,
    /// Polar angle of the centre of one end, degrees, counter-clockwise from X.
    #[schemars(example = 0)]
    pub from: f64,
    /// Polar angle of the centre of the other end, degrees; greater than `from`: the arc runs counter-clockwise.
    #[schemars(example = 90)]
    pub to: f64,
}

impl OutlineSlot {
    /// Its centre line, and its width [mm].
    ///
    /// # Errors
    /// One finding with the key of the first wrong value.
    pub(crate) fn centre_line(&self) -> Result<CentreLine> {
        positive("width", self.width, MAX_LENGTH, "mm")?;
        match (self.line, self.arc) {
            (Some(line), None) => {
                for (i, v) in line.iter().flatten().enumerate() {
                    length(&format!("line[{}][{}]", i / 2, i % 2), *v, -MAX_LENGTH, MAX_LENGTH)?;
                }
                let [from, to] = line.map(DVec2::from_array);
                CentreLine::line(from, to).map_err(|e| e.under("line"))
            }
            (None, Some(arc)) => arc.centre_line().map_err(|e| e.under("arc")),
            (given, _) => {
                let what = match given {
                    Some(_) => "`line` and `arc` exclude each other",
                    None => "the slot needs a centre line",
                };
                let help = "give line = [[x, y], [x, y]], or arc = { radius = .., from = .., to = .. }";
                Err(Finding::error(Code::JOB_SHAPE, what).help(help).key("line").into())
            }
        }
    }

    /// Its outline.
    ///
    /// # Errors
    /// One finding with the key of the first wrong value.
    pub(crate) fn outline(&self) -> Result<Outline> {
        self.centre_line()?.outline(self.width)
    }
}

impl SlotArc {
    fn centre_line(&self) -> Result<CentreLine> {
        for (i, v) in self.centre.into_iter().enumerate() {
            length(&format!("centre[{i}]"), v, -MAX_LENGTH, MAX_LENGTH)?;
        }
        let radius = positive("radius", self.radius, MAX_LENGTH, "mm")?;
        let from = bounded("from", self.from, -360.0, 360.0, "deg")?;
        let to = bounded("to", self.to, from, from + 360.0, "deg")?;
        let centre = DVec2::from_array(self.centre);
        CentreLine::arc(centre, radius, from.to_radians(), (to - from).to_radians())
    }
}
