//! The verb `kinecut face`: an operation planned for itself, as a sheet of numbers for a person or another program.

use crate::base::{Code, Finding, Loader, Progress, Result};
use crate::facing::optimum::{ObjectiveMap, Options, map_size, objective_map_watched};
use crate::facing::{
    DescentStatistics, NelderMead, Objective, OffsetRule, SimplexDescent, SimplexStep, SurveyPoint,
    ToothCrossing, descend, descend_steps, descents, survey,
};
use crate::job::file::{BoxTable, SetupTable, StockTable};
use crate::job::{Job, check};
use crate::nc;
use crate::operations::face::{PlannedFace, options};
use crate::operations::outlines::OutlineEntry;
use crate::operations::{OperationPlan, OperationTable};
use crate::verbs::hole::{HoleTable, job_file, own_key};
use crate::verbs::{safe_height, unknown_stock};

/// Results wanted with the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SheetWants {
    /// Other ways than the one asked for: rows, frames, other straight passes, each with its price.
    pub compare: bool,
    /// Results of the paper's program.
    pub paper: bool,
    /// Every crossing of every tooth.
    pub events: bool,
    /// The bad length over all placements of one straight pass.
    pub map: bool,
    /// The way of the paper's method from the placement that is chosen.
    pub walk: bool,
}

/// Result of the program of Kryzhanivskyi and Kryzhanivska 2011 for the same face: kept as the baseline. As an M3
/// spindle sees it.
#[derive(Clone, Debug)]
pub struct PaperBaseline {
    /// Largest exit angle and bad length over the orientation, the cutter over the middle (their figure 5).
    pub survey: Vec<SurveyPoint>,
    /// End of Nelder and Mead's method from the part as drawn, the cutter over the middle, if that is a placement.
    pub from_drawn: Option<SimplexDescent>,
    /// Its ends from random starts.
    pub descents: Vec<SimplexDescent>,
    /// The descents against the certified optimum.
    pub statistics: Option<DescentStatistics>,
    /// The bad length over all placements.
    pub map: ObjectiveMap,
}

/// A way of the paper's method, triangle by triangle; as an M3 spindle sees it.
#[derive(Clone, Debug)]
pub struct SimplexWalk {
    /// Its start and its end.
    pub descent: SimplexDescent,
    /// The triangles, from the first to the last.
    pub steps: Vec<SimplexStep>,
}

/// Orientations of the survey: one for each degree.
const ORIENTATIONS: u32 = 360;
/// Random starts, as in the comparison of the specification.
const STARTS: u32 = 100;
/// Any number: the starts are the same in every run.
const SEED: u64 = 2011;
/// Columns and rows of the map.
const MAP: [usize; 2] = [240, 48];

/// Columns and rows of the map that is asked for by itself.
const OWN_MAP: [usize; 2] = [180, 41];

fn baseline(face: &PlannedFace, options: &Options, progress: &dyn Progress) -> Result<PaperBaseline> {
    let case = &face.plan.guarded;
    let margin = options.margin;
    let method = NelderMead::within(options);
    // A part that no straight pass covers has no feasible start.
    let descents = match &face.plan.optimum {
        Ok(_) => descents(case, &Objective::Limit, &method, STARTS, SEED, progress)?,
        Err(_) => Vec::new(),
    };
    let from_drawn =
        face.plan.as_drawn.map(|start| descend(case, &Objective::Limit, &method, start)).transpose()?;
    let statistics = face.plan.optimum.as_ref().ok().and_then(|o| DescentStatistics::of(&descents, o.value));
    Ok(PaperBaseline {
        survey: survey(case, &Objective::Limit, OffsetRule::Share(0.5), margin, ORIENTATIONS, progress)?,
        map: objective_map_watched(case, options, map_size(MAP, case.outline.edges().len()), progress)?,
        from_drawn,
        descents,
        statistics,
    })
}

/// A planned face.
#[derive(Clone, Debug)]
pub struct FaceSheet {
    /// Title.
    pub title: String,
    /// The plan.
    pub face: PlannedFace,
    /// Every crossing of the real teeth with the outline, if they were wanted and one straight pass was chosen.
    pub events: Vec<ToothCrossing>,
    /// The way of the paper's program, if it was asked for.
    pub paper: Option<PaperBaseline>,
    /// The bad length over all placements of one straight pass, if it was asked for; as an M3 spindle sees it.
    pub map: Option<ObjectiveMap>,
    /// The way of the paper's method from the chosen placement, if it was asked for and one straight pass was chosen.
    pub walk: Option<SimplexWalk>,
    /// Findings.
    pub findings: Vec<Finding>,
    /// Control posted for.
    pub control: &'static str,
    /// The program, not simulated: blocks to look at.
    pub program: String,
}

/// None of work that was cancelled: the plan is an answer without it.
fn unless_cancelled<T>(done: Result<T>) -> Result<Option<T>> {
    match done {
        Err(e) if e.code() == Code::CANCELLED => Ok(None),
        done => done.map(Some),
    }
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
            .help("write type = \"face\", or use `kinecut hole` or `kinecut drill`")
            .key("operation.type")
            .into());
    };
    if matches!(&face.outline, OutlineEntry::Name(name) if name == "top") {
        return Err(Finding::error(Code::JOB_REFERENCE, "here is no stock whose top could be milled")
            .help("name a drawing, or run the operation as a job")
            .key("operation.outline")
            .into());
    }
    /// Larger than any face, so that its height never matters [mm].
    const BLOCK: f64 = 5000.0;
    let stock = StockTable::Box(BoxTable { min: [-BLOCK; 3], max: [BLOCK; 3] });
    let mut setup = SetupTable::of(table.operation.clone());
    setup.safe_height = Some(safe_height::UNKNOWN);
    let job = check(&job_file(table, stock, setup), "FACE", loader).map_err(own_key)?;
    let job = Job { compare: wants.compare, ..job };
    let planned = crate::job::plan(&job, progress).map_err(own_key)?;
    let [one] = &planned[..] else {
        return Err(Finding::error(Code::JOB_SHAPE, "a face has one operation").into());
    };
    let Some(OperationPlan::Face(face)) = one.operations.first().map(|o| &o.plan) else {
        return Err(Finding::error(Code::JOB_SHAPE, "a face has one operation").into());
    };
    let events = match (wants.events, face.toothed_pass()) {
        (true, Some(pass)) => pass.crossings(&face.plan.case.outline)?,
        _ => Vec::new(),
    };
    let constraints = options(&face.of, face.plan.left_hand);
    let paper = match wants.paper && !progress.cancelled() {
        true => unless_cancelled(baseline(face, &constraints, progress))?,
        false => None,
    };
    let guarded = &face.plan.guarded;
    let map = match wants.map {
        true => {
            let size = map_size(OWN_MAP, guarded.outline.edges().len());
            unless_cancelled(objective_map_watched(guarded, &constraints, size, progress))?
        }
        false => None,
    };
    let start = face.plan.ways[face.plan.chosen].placement();
    let walk = match start.filter(|_| wants.walk) {
        Some(start) => {
            let method = NelderMead::within(&constraints);
            let walk = descend_steps(guarded, &Objective::Limit, &method, start, progress);
            unless_cancelled(walk)?.map(|(descent, steps)| SimplexWalk { descent, steps })
        }
        None => None,
    };
    let (mut program, mut post) = (one.program.clone(), job.post.clone());
    unknown_stock::left_out(&mut program, &mut post);
    let mut findings = one.findings.clone();
    if wants.events && face.toothed_pass().is_none() {
        findings.push(Finding::note(
            Code::FACE_ADVICE,
            "crossings of the teeth are listed for one straight pass: none was chosen",
        ));
    }
    let cut_short = |wanted: bool, has: bool| wanted && !has && progress.cancelled();
    if cut_short(wants.paper, paper.is_some())
        || cut_short(wants.map, map.is_some())
        || cut_short(wants.walk && start.is_some(), walk.is_some())
    {
        findings.push(Finding::note(
            Code::CANCELLED,
            "the map, the walk or the results of the paper's method are left out: the work was cancelled",
        ));
    }
    if wants.walk && start.is_none() {
        findings.push(Finding::note(
            Code::FACE_ADVICE,
            "the paper's method walks from one straight pass: none was chosen",
        ));
    }
    Ok(FaceSheet {
        title: job.title.clone(),
        face: PlannedFace::clone(face),
        events,
        paper,
        map,
        walk,
        findings,
        control: job.post.control.name(),
        program: safe_height::to_fill_in(&nc::write(&program, &job.tools, &post)?.text),
    })
}
