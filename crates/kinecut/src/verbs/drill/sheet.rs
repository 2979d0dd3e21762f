//! The verb `kinecut drill`: an operation planned for itself, as a sheet of numbers for a person or another program.

use crate::base::{Code, Error, Finding, Loader, Result, Severity, Silent};
use crate::job::check;
use crate::job::file::{BoxTable, OrientTable, SetupTable, StockTable};
use crate::job::plan::{plan, setting};
use crate::nc;
use crate::operations::drill::{DrillOperation, DrillTable, FaceTable, PlannedHole, SurfaceName, plan_each};
use crate::operations::{Operation, OperationTable};
use crate::verbs::hole::{HoleTable, job_file, own_key};
use crate::verbs::{safe_height, unknown_stock};

/// A planned drilling: one tool, one or many holes.
#[derive(Clone, Debug)]
pub struct DrillSheet {
    /// Title.
    pub title: String,
    /// Kind of drilling, in words.
    pub name: String,
    /// Diameter of the tool [mm].
    pub diameter: f64,
    /// Its point.
    pub point: crate::tool::DrillPoint,
    /// Places of the holes [mm].
    pub places: Vec<[f64; 2]>,
    /// The holes, each planned or the reason why it cannot be.
    pub holes: Vec<Result<PlannedHole>>,
    /// Control posted for.
    pub control: &'static str,
    /// The program, not simulated: blocks to look at.
    pub program: String,
    /// Findings about the holes that can be drilled; of a pattern the first of each code, and their number.
    pub findings: Vec<Finding>,
    /// Whether the result of the paper's own formulas is shown too.
    pub paper: bool,
    /// Whether the JSON has the load along the way of each hole.
    pub load: bool,
}

/// Plans a drilling; `paper`: with what the paper's own formulas give.
///
/// # Errors
/// Those of the job's checks and of a single hole, with the key in the operation's own table. An error of one
/// hole of several is in its place.
pub fn plan_drill_sheet(table: &HoleTable, paper: bool, loader: &dyn Loader) -> Result<DrillSheet> {
    let OperationTable::Drill(drill) = &table.operation else {
        return Err(Finding::error(Code::JOB_SHAPE, "this verb plans drilling only")
            .help("write type = \"drill\", or use `kinecut hole`")
            .key("operation.type")
            .into());
    };
    let mut drill = drill.clone();
    if drill.points.is_none() && drill.pattern.is_none() {
        drill.points = Some(vec![[0.0, 0.0]]);
    }
    let (stock, mut setup) = around(table, &mut drill)?;
    setup.operations = vec![OperationTable::Drill(drill)];
    let job = check(&job_file(table, stock, setup), "DRILL", loader).map_err(own_key)?;
    let setup = &job.setups[0];
    let Some(Operation::Drill(drill)) = setup.operations.first() else {
        return Err(Finding::error(Code::JOB_SHAPE, "a drilling has one operation").into());
    };
    // The sheet has the cutting speed as it is given, the program whole revolutions.
    let mut exact = DrillOperation::clone(drill);
    exact.milling.spindle = drill.exact_spindle;
    let clamping = setup.at(&drill.milling);
    let mut holes =
        plan_each(&setting(&job, setup, &clamping, 0, &Silent), &exact).map_err(|e| e.under("operation"))?;
    for hole in &mut holes {
        if let Err(e) = hole {
            *e = e.clone().under("operation");
        }
    }
    if let [Err(e)] = &holes[..] {
        return Err(e.clone());
    }
    // Each hole gives its reason if none can be drilled.
    let (mut program, mut findings) = (String::new(), Vec::new());
    if let Some(planned) = plan(&job, &Silent).ok().and_then(|all| all.into_iter().next()) {
        let (mut one, mut post) = (planned.program, job.post.clone());
        if table.part.is_none() {
            unknown_stock::left_out(&mut one, &mut post);
        }
        program = safe_height::to_fill_in(&nc::write(&one, &job.tools, &post)?.text);
        findings = planned.findings;
        findings.retain(|f| f.severity < Severity::Error);
    }
    Ok(DrillSheet {
        title: job.title.clone(),
        name: job.setups[0].operations[0].name(),
        diameter: drill.diameter(),
        point: drill.milling.tool.cutter.point().clone(),
        places: drill.holes.iter().map(|h| h.at).collect(),
        holes,
        control: job.post.control.name(),
        program,
        findings,
        paper,
        load: false,
    })
}

/// The stock and clamping around the hole: the part's mesh turned under the tool, or a block that nobody looks at.
fn around(table: &HoleTable, drill: &mut DrillTable) -> Result<(StockTable, SetupTable)> {
    let mut setup = SetupTable::of(table.operation.clone());
    if let Some(part) = &table.part {
        let way = glam::DVec3::from_array(part.direction.unwrap_or([0.0, 0.0, -1.0]));
        let Some(way) = way.try_normalize() else {
            return Err(Finding::error(Code::JOB_VALUE, "this is no direction").key("part.direction").into());
        };
        let z = -way;
        // Looking down along the drill, X stays as near to X as it can.
        let helper = if z.x.abs() < 0.9 { glam::DVec3::X } else { glam::DVec3::Y };
        let x = (helper - z * helper.dot(z)).try_normalize().unwrap_or(glam::DVec3::X);
        setup.zero = Some(part.at);
        if z != glam::DVec3::Z {
            setup.orient = Some(OrientTable { x: x.to_array(), z: z.to_array() });
        }
        return Ok((StockTable::Mesh(part.mesh.clone()), setup));
    }
    if drill.entry.is_none() && drill.body.is_none() {
        drill.entry = Some(FaceTable {
            surface: SurfaceName::Plane,
            radius: None,
            inclination: None,
            offset: None,
            at: None,
            direction: None,
        });
    }
    /// Larger than any hole, so that its height never matters [mm].
    const BLOCK: f64 = 5000.0;
    setup.safe_height = Some(safe_height::UNKNOWN);
    Ok((StockTable::Box(BoxTable { min: [-BLOCK; 3], max: [BLOCK; 3] }), setup))
}

impl DrillSheet {
    /// The holes that cannot be drilled.
    pub fn errors(&self) -> impl Iterator<Item = &Error> {
        self.holes.iter().filter_map(|h| h.as_ref().err())
    }
}
