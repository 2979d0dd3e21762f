//! The recess at the mouth of a hole: for the head of a screw, or countersunk.

use super::choose::{SAME_ANGLE, title};
use super::size::SAME;
use super::steps::{Maker, Stage, Step};
use crate::base::bounded::{MAX_LENGTH, positive};
use crate::base::{Code, Finding, Result};
use crate::drilling::DrillMethod;
use crate::job::file::ToolTable;
use crate::operations::OperationTable;
use crate::operations::drill::{DrillTable, PreHoleTable};
use crate::tool::DrillPoint;

impl<'a> Maker<'a> {
    /// Checks the numbers of the recess.
    ///
    /// # Errors
    /// One finding with a key of the hole.
    pub(super) fn check_recess(&self) -> Result<()> {
        let hole = self.hole;
        let wider = |key: &str, diameter: f64| -> Result<()> {
            let diameter = positive("diameter", diameter, MAX_LENGTH, "mm").map_err(|e| e.under(key))?;
            if diameter > self.size.diameter() + SAME {
                return Ok(());
            }
            let finding = Finding::error(Code::JOB_VALUE, "the recess is not wider than the hole");
            Err(finding
                .value_mm(diameter)
                .bound_mm(self.size.diameter())
                .help("write a larger diameter, or leave it out")
                .key("diameter")
                .under(key)
                .into())
        };
        match (&hole.countersink, &hole.counterbore) {
            (None, None) => Ok(()),
            (Some(_), Some(_)) => {
                let what = "`countersink` and `counterbore` exclude each other";
                Err(Finding::error(Code::JOB_SHAPE, what)
                    .help("leave one of them out")
                    .key("counterbore")
                    .into())
            }
            (Some(cone), None) => {
                wider("countersink", cone.diameter)?;
                if cone.angle > 0.0 && cone.angle < std::f64::consts::PI {
                    return Ok(());
                }
                let what = "the angle of a countersink must lie between 0 and 180 degrees";
                let finding = Finding::error(Code::JOB_VALUE, what).value(cone.angle.to_degrees(), "deg");
                Err(finding.bound(180.0, "deg").help("write 90").key("countersink.angle").into())
            }
            (None, Some(flat)) => {
                wider("counterbore", flat.diameter)?;
                let most = hole.depth.unwrap_or(MAX_LENGTH);
                positive("counterbore.depth", flat.depth, most, "mm").map(drop)
            }
        }
    }

    /// Height at which the hole begins below its recess: the floor of a counterbore [mm].
    pub(super) fn mouth(&self) -> f64 {
        self.top - self.hole.counterbore.as_ref().map_or(0.0, |flat| flat.depth)
    }

    /// Depth of full thread below that height [mm].
    pub(super) fn thread_depth(&self) -> Option<f64> {
        self.hole.depth.map(|depth| depth - (self.top - self.mouth()))
    }

    /// The recess about a hole of a diameter [mm].
    ///
    /// # Errors
    /// One finding with a key of the hole: a tool that is not there, or that does not fit.
    pub(super) fn recess(&self, drilled: f64) -> Result<Option<Step>> {
        let there = Some(PreHoleTable { diameter: drilled, offset: None, bottom: None, bottom_angle: None });
        let (tool, table) = match (&self.hole.countersink, &self.hole.counterbore) {
            (Some(cone), _) => {
                let tool = match self.named.recess {
                    Some(tool) => tool,
                    None => self.tools.countersink(cone.diameter, cone.angle, drilled)?,
                };
                let method = match tool.point {
                    Some(DrillPoint::Cone { .. }) => DrillMethod::Countersinking,
                    _ => DrillMethod::Centring,
                };
                fits(tool, cone.diameter, cone.angle)?;
                let table = DrillTable {
                    method,
                    reach_diameter: Some(cone.diameter),
                    pre_hole: there,
                    ..self.drilling(tool)
                };
                (tool, table)
            }
            (None, Some(flat)) => {
                let tool = match self.named.recess {
                    Some(tool) => tool,
                    None => self.tools.counterbore(flat.diameter)?,
                };
                if (tool.diameter - flat.diameter).abs() > SAME {
                    return Err(misfit("counterbore", tool, flat.diameter));
                }
                let table = DrillTable {
                    method: DrillMethod::Counterboring,
                    depth: Some(flat.depth),
                    pre_hole: there,
                    ..self.drilling(tool)
                };
                (tool, table)
            }
            (None, None) => return Ok(None),
        };
        let table = OperationTable::Drill(Box::new(table));
        Ok(Some(Step { stage: Stage::Recess, tool: tool.number, table }))
    }
}

/// Whether a tool makes the cone.
fn fits(tool: &ToolTable, diameter: f64, angle: f64) -> Result<()> {
    let own = match tool.point {
        Some(DrillPoint::Cone { angle, .. }) => Some(angle),
        Some(_) => None,
        None => tool.point_angle,
    };
    if !own.is_some_and(|own| (own - angle).abs() < SAME_ANGLE) {
        let what = format!("{} has another angle than the countersink", title(tool));
        let finding = Finding::error(Code::JOB_VALUE, what);
        let finding = match own {
            Some(own) => finding.value(own.to_degrees(), "deg").bound(angle.to_degrees(), "deg"),
            None => finding,
        };
        return Err(finding.help("name another tool, or its angle").key("countersink.tool").into());
    }
    if tool.diameter < diameter - SAME {
        return Err(misfit("countersink", tool, diameter));
    }
    Ok(())
}

fn misfit(key: &str, tool: &ToolTable, diameter: f64) -> crate::base::Error {
    let what = format!("{} does not fit the diameter of the {key}", title(tool));
    let finding = Finding::error(Code::JOB_VALUE, what).value_mm(tool.diameter).bound_mm(diameter);
    finding.help("name another tool, or leave it out to have one chosen").key(format!("{key}.tool")).into()
}
