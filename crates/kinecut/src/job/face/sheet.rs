//! The verb `kinecut face`: an operation planned for itself, as a sheet of numbers for a person or another program.

use super::super::file::{BoxTable, OperationTable, OutlineEntry, SetupTable, StockTable};
use super::super::hole::{HoleTable, job_file, own_key};
use super::super::{FaceOperation, Operation, check};
use super::PlannedFace;
use crate::base::{Code, Finding, Loader, Progress, Result};
use crate::facing::Crossing;
use crate::nc;

/// What is wanted beside the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SheetWants {
    /// What the paper's program does.
    pub paper: bool,
    /// Every crossing of every tooth.
    pub events: bool,
}

/// What the program of Kryzhanivskyi and Kryzhanivska 2011 does with the same face: kept as the baseline.
#[derive(Clone, Debug)]
pub struct PaperBaseline {}

/// A planned face.
#[derive(Clone, Debug)]
pub struct FaceSheet {
    /// Title.
    pub title: String,
    /// The operation, checked.
    pub operation: FaceOperation,
    /// The plan.
    pub face: PlannedFace,
    /// Every crossing of the real teeth with the outline, if they were wanted and one straight pass was chosen.
    pub events: Vec<Crossing>,
    /// What the paper's program does, if it was wanted.
    pub paper: Option<PaperBaseline>,
    /// What a person should know.
    pub findings: Vec<Finding>,
    /// Control posted for.
    pub control: &'static str,
    /// The program, not simulated: blocks to look at.
    pub program: String,
}

/// Plans a face.
///
/// # Errors
/// Those of the job's checks, the outline, the planner and the writer, with the key in the operation's own table.
pub fn plan_face_sheet(
    table: &HoleTable,
    wants: SheetWants,
    loader: &dyn Loader,
    progress: &dyn Progress,
) -> Result<FaceSheet> {
    let OperationTable::Face(face) = &table.operation else {
        return Err(Finding::error(Code::JOB_SHAPE, "this verb plans faces only")
            .cure("write type = \"face\", or use `kinecut hole` or `kinecut drill`")
            .key("operation.type")
            .into());
    };
    if matches!(&face.outline, OutlineEntry::Name(name) if name == "top") {
        return Err(Finding::error(Code::JOB_REFERENCE, "here is no stock whose top could be milled")
            .cure("name a drawing, or run the operation as a job")
            .key("operation.outline")
            .into());
    }
    /// Larger than any face, so that its height never matters [mm].
    const BLOCK: f64 = 5000.0;
    let stock = StockTable::Box(BoxTable { min: [-BLOCK; 3], max: [BLOCK; 3] });
    let mut setup = SetupTable::of(table.operation.clone());
    setup.safe_height = Some(2.0 * BLOCK);
    let job = check(&job_file(table, stock, setup), "FACE", loader).map_err(own_key)?;
    let planned = super::super::plan(&job, progress).map_err(own_key)?;
    let [one] = &planned[..] else {
        return Err(Finding::error(Code::JOB_SHAPE, "a face has one operation").into());
    };
    let (Some(face), Some(Operation::Face(operation))) =
        (one.faces.first(), job.setups[0].operations.first())
    else {
        return Err(Finding::error(Code::JOB_SHAPE, "a face has one operation").into());
    };
    let events = match (wants.events, face.toothed_pass()) {
        (true, Some(pass)) => pass.crossings(&face.plan.case.outline)?,
        _ => Vec::new(),
    };
    let _ = wants.paper;
    Ok(FaceSheet {
        title: job.title.clone(),
        operation: (**operation).clone(),
        face: face.clone(),
        events,
        paper: None,
        findings: one.findings.clone(),
        control: job.post.control.name(),
        program: nc::write(&one.program, &job.tools, &job.post)?.text,
    })
}
