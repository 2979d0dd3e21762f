//! One hole at a time: a bore operation with its tool, planned alone or compared over all strategies.
//!
//! Input is a table, or a list of tables, in TOML (`[[hole]]`) or JSON; the operation is the same table as in a job. A
//! list gives a list, and an item that fails carries its own error.

mod compare;
mod compare_page;

use compare_page::compare_html;

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Spanned;
use toml::de::DeTable;

use crate::base::bounded::positive;
use crate::base::{Code, Error, FileId, Finding, MemoryLoader, Result, Silent, Sources};
use crate::holes::compare::{Comparison, Terms, compare};
use crate::holes::entry::chosen;
use crate::holes::{BoreSpec, Entry, ToolpathPace, ToolpathRole};
use crate::job::Outputs;
use crate::job::check::{Job, check};
use crate::job::file::{
    BoxTable, DynamicsTable, JobFile, PostTable, SetupTable, SimulateTable, StockTable, ToolTable,
};
use crate::job::items::{self, Items};
use crate::job::plan::{plan, setting};
use crate::job::read::{decode, decode_operation, span};
use crate::motion::Limits;
use crate::nc;
use crate::operations::bore::spec;
use crate::operations::{Operation, OperationPlan, OperationTable};
use crate::page::{Block, Cell, Fact, Row, Section, Table, duration, length};
use crate::verbs::{Answer, page};
use compare::number;

/// A hole: one operation with its tool; lengths in mm, feeds in mm/min, angles in degrees, speeds in rev/min.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HoleTable {
    /// What it is called.
    #[serde(default)]
    pub title: Option<String>,
    /// The tool, as in a job; its holder is not looked at.
    pub tool: ToolTable,
    /// The operation, as in a job: `type = "bore"` for `kinecut hole`, `type = "drill"` for `kinecut
    /// drill`, `type = "face"` for `kinecut face`.
    pub operation: OperationTable,
    /// For drilling: a part as a mesh, with the place and direction of the hole on it.
    #[serde(default)]
    pub part: Option<PartTable>,
    /// The control; default sinumerik-840d.
    #[serde(default)]
    pub post: Option<PostTable>,
    /// What the axes can do: rapid mm/min, acceleration m/s2, jerk m/s3; default 30000, 5, 100. For comparing.
    #[serde(default)]
    pub dynamics: Option<DynamicsTable>,
}

/// A part as a mesh, and where it is drilled.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PartTable {
    /// STL file.
    pub mesh: String,
    /// A point of the hole's axis, in coordinates of the mesh: the zero of the hole's Z.
    pub at: [f64; 3],
    /// The way of the feed; default [0, 0, -1].
    #[serde(default)]
    pub direction: Option<[f64; 3]>,
}

/// A hole without its operation, which is decoded for itself.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HoleHead {
    #[serde(default)]
    pub(super) title: Option<String>,
    pub(super) tool: ToolTable,
    #[serde(default)]
    pub(super) part: Option<PartTable>,
    #[serde(default)]
    pub(super) post: Option<PostTable>,
    #[serde(default)]
    pub(super) dynamics: Option<DynamicsTable>,
}

/// Names that a list of operations may have.
const LISTS: [&str; 3] = ["hole", "drill", "face"];

/// The JSON Schema of the input of `kinecut hole`.
pub fn hole_schema() -> serde_json::Value {
    let what = "What `kinecut hole`, `drill` and `face` read: one operation, a list, or a table with a list `hole`, \
                `drill` or `face`.";
    items::schema::<HoleTable>("HoleInput", what, &LISTS)
}

/// Reads what `kinecut hole`, `drill` and `face` read, TOML or JSON: one operation, a list, or a table with a list `hole`,
/// `drill` or `face`.
///
/// # Errors
/// `KC0101` for a text that is neither. What is wrong with one item stands in its place.
pub fn read_holes(name: &str, text: impl Into<String>) -> Result<Items<HoleTable>> {
    Items::read_named(name, text.into(), &LISTS, decode_hole)
}

/// A planned way down, for the entry table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HoleEntry {
    /// The way.
    pub way: &'static str,
    /// Whether the cutter may take it.
    pub possible: bool,
    /// Diameter of the core it would leave [mm].
    pub core: f64,
    /// Why, or why not.
    pub reason: String,
    /// Whether it is taken.
    pub chosen: bool,
}

/// A pass of a planned hole.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HolePass {
    /// "rough" or "finish".
    pub pass: &'static str,
    /// Radius of the path at the wall [mm].
    pub path_radius: f64,
    /// Turns.
    pub turns: f64,
    /// Normal step [mm].
    pub step: f64,
    /// Radius of the circle on which the path starts [mm].
    pub entry_radius: f64,
    /// Engagement that is kept [deg].
    pub engagement_deg: Option<f64>,
    /// Length of the path of one level, without its circle [mm].
    pub length: f64,
    /// Heights of the floors [mm].
    pub floors: Vec<f64>,
}

/// A planned hole, in the units of the shop.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HolePlan {
    /// Title.
    pub title: String,
    /// The ways down.
    pub entries: Vec<HoleEntry>,
    /// Roughing and finishing.
    pub passes: Vec<HolePass>,
    /// Way at feed in material and in leads [mm].
    pub feed_length: f64,
    /// Way at feed down into the material [mm].
    pub entry_length: f64,
    /// Time at programmed feeds, rapids not counted [s].
    pub feed_time: f64,
    /// Control posted for.
    pub control: &'static str,
    /// Lines of its program.
    pub program_lines: usize,
    /// What a person should know.
    pub findings: Vec<Finding>,
}

/// A compared hole.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HoleComparison {
    /// Title.
    pub title: String,
    /// Diameter and depth [mm].
    pub diameter: f64,
    /// Depth [mm].
    pub depth: f64,
    /// All strategies in one plane.
    pub comparison: Comparison,
    /// What a person should know.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<Finding>,
}

impl Answer for HolePlan {
    fn sections(&self) -> Vec<Section> {
        let way = |e: &HoleEntry| {
            let mark = if e.chosen { "->" } else { "" };
            let possible = if e.possible { "possible" } else { "not possible" };
            Row::new([mark, e.way, possible, &e.reason].map(Cell::new).to_vec())
        };
        let ways = Table::new("", "; Way down; ; Why").rows(self.entries.iter().map(way));
        let pass = |p: &HolePass| {
            let floors = p.floors.iter().map(|f| number(Some(*f))).collect::<Vec<_>>().join(", ");
            let numbers = [p.path_radius, p.turns, p.step].map(|v| number(Some(v)));
            let [radius, turns, step] = numbers;
            let cells = [p.pass.to_owned(), radius, turns, step, length(p.length), floors];
            Row::new(cells.map(Cell::new).to_vec())
        };
        let passes = Table::new("", "Pass; Wall path R [mm]; Turns []; Step [mm]; A level []; Floors at")
            .rows(self.passes.iter().map(pass));
        let facts = vec![
            Fact::new("At feed", length(self.feed_length + self.entry_length))
                .note(format!("{} of it down into the material", length(self.entry_length))),
            Fact::new("Time", duration(self.feed_time)).note("without rapids"),
            Fact::new("Program", format!("{} lines for {}", self.program_lines, self.control)),
        ];
        vec![Section::new(self.title.as_str()).with(Block::Facts(facts)).with(ways).with(passes)]
    }

    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }

    fn add_findings(&mut self, findings: Vec<Finding>) {
        self.findings.extend(findings);
    }
}

impl Answer for HoleComparison {
    fn sections(&self) -> Vec<Section> {
        compare::words(self)
    }

    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }

    fn add_findings(&mut self, findings: Vec<Finding>) {
        self.findings.extend(findings);
    }

    fn files(answers: &[&HoleComparison]) -> Result<Outputs> {
        Ok(page("compare.html", compare_html(answers)))
    }
}

/// A job of this hole alone, in a block around it.
fn job(table: &HoleTable) -> Result<Job> {
    let OperationTable::Bore(bore) = &table.operation else {
        let help = match &table.operation {
            OperationTable::Drill(_) => "use `kinecut drill`",
            OperationTable::Face(_) => "use `kinecut face`",
            OperationTable::Path(_) => "use `kinecut run`: a path is part of a job",
            _ => "write type = \"bore\", or run the operation as a job",
        };
        return Err(Finding::error(Code::JOB_SHAPE, "this verb plans bores only")
            .help(help)
            .key("operation.type")
            .into());
    };
    // What is absurd is told by the checks of its own key, not by those of the block.
    const MODEST: f64 = 4000.0;
    let modest = |v: f64, default: f64| if v.abs() < MODEST { v } else { default };
    let half = modest(bore.diameter, 1.0).abs() + 1.0;
    let [x, y] = bore.at.map(|v| modest(v, 0.0));
    let top = modest(bore.top, 0.0);
    let bottom = top - modest(bore.depth, 1.0).abs() - modest(bore.breakthrough, 0.0).abs() - 1.0;
    let stock =
        StockTable::Box(BoxTable { min: [x - half, y - half, bottom], max: [x + half, y + half, top] });
    let setup = SetupTable::of(table.operation.clone());
    let file = job_file(table, stock, setup);
    check(&file, "HOLE", &MemoryLoader::default()).map_err(own_key)
}

/// The file of a job of one operation.
pub(super) fn job_file(table: &HoleTable, stock: StockTable, setup: SetupTable) -> JobFile {
    let post = table.post.clone().unwrap_or(PostTable {
        control: nc::Control::Sinumerik840d.name().to_owned(),
        ..PostTable::default()
    });
    JobFile {
        format: 1,
        title: table.title.clone(),
        design: None,
        stock,
        drilled: Vec::new(),
        post,
        simulate: SimulateTable::default(),
        machine: None,
        holders: Vec::new(),
        tools: vec![ToolTable { holder: None, ..table.tool.clone() }],
        setups: vec![setup],
    }
}

/// An error with the key that the user wrote instead of that of the job around it.
pub(super) fn own_key(mut error: Error) -> Error {
    if let Some(key) = error.0.key.take() {
        let own = [("setup[0].operation[0]", "operation"), ("tool[0]", "tool")]
            .iter()
            .find_map(|(from, to)| Some(format!("{to}{}", key.strip_prefix(from)?)));
        error.0.key = Some(own.unwrap_or(key));
    }
    error
}

/// Plans a hole.
///
/// # Errors
/// Those of the job's checks, the planner and the writer, with the key in the hole's own table.
pub fn plan_hole(table: &HoleTable) -> Result<HolePlan> {
    let job = job(table)?;
    let planned = plan(&job, &crate::base::Silent).map_err(own_key)?;
    let mut result = HolePlan {
        title: job.title.clone(),
        entries: Vec::new(),
        passes: Vec::new(),
        feed_length: 0.0,
        entry_length: 0.0,
        feed_time: 0.0,
        control: job.post.control.name(),
        program_lines: 0,
        findings: Vec::new(),
    };
    for setup in &planned {
        result.program_lines += nc::write(&setup.program, &job.tools, &job.post)?.text.lines().count();
        for operation in &setup.operations {
            let OperationPlan::Bore(planned) = &operation.plan else { continue };
            let bore = &planned.plan;
            for m in &bore.moves {
                if let ToolpathPace::Feed(feed) = m.pace {
                    let length = m.curve.length();
                    if m.role == ToolpathRole::Entry {
                        result.entry_length += length
                    } else {
                        result.feed_length += length
                    }
                    result.feed_time += length / feed;
                }
            }
            for (name, pass) in [("rough", &bore.rough), ("finish", &bore.finish)] {
                result.passes.extend(pass.iter().map(|p| HolePass {
                    pass: name,
                    path_radius: p.path_radius,
                    turns: p.visible_turns,
                    step: p.step,
                    entry_radius: p.inner_radius,
                    engagement_deg: p.engagement.map(f64::to_degrees),
                    length: p.length,
                    floors: p.floors.clone(),
                }));
            }
            result.entries.extend(bore.ways.iter().map(|w| HoleEntry {
                way: w.way.title(),
                possible: w.possible,
                core: w.core,
                reason: w.reason.clone(),
                chosen: w.chosen,
            }));
            result.findings.extend(bore.findings.iter().cloned());
        }
    }
    Ok(result)
}

/// Compares all strategies on a hole, in the plane of its first level.
///
/// # Errors
/// As [`plan_hole`]; `KC0102` when the hole is not roughed.
pub fn compare_hole(table: &HoleTable) -> Result<HoleComparison> {
    let job = job(table)?;
    let [setup] = &job.setups[..] else {
        return Err(Finding::error(Code::JOB_SHAPE, "a hole has one operation").into());
    };
    let Some(Operation::Bore(bore)) = setup.operations.first() else {
        return Err(Finding::error(Code::JOB_SHAPE, "strategies are compared for bores")
            .key("operation.type")
            .into());
    };
    let under = |e: Error| e.under("operation");
    let clamping = setup.at(&bore.milling);
    let spec = spec(&setting(&job, setup, &clamping, 0, &Silent), bore).map_err(under)?;
    spec.check().map_err(under)?;
    let terms = terms(&spec, &job, table)?;
    Ok(HoleComparison {
        title: job.title.clone(),
        diameter: spec.diameter,
        depth: spec.depth,
        comparison: compare(&terms).map_err(under)?,
        findings: Vec::new(),
    })
}

fn terms(spec: &BoreSpec, job: &Job, table: &HoleTable) -> Result<Terms> {
    let rough = spec.rough.as_ref().ok_or_else(|| {
        Finding::error(Code::JOB_SHAPE, "strategies are compared in roughing")
            .help("add rough = { stepover = .., feed = .. }")
            .key("operation.rough")
    })?;
    let cutter = spec.cutter_radius();
    let wall = spec.rough_radius(rough, spec.floor()).map_err(|e| e.under("operation.rough"))?;
    let (entry, drilled) = match chosen(spec, rough, wall) {
        Entry::PreDrilled { diameter } => {
            let room = 0.5 * diameter - cutter;
            (if room > 0.0 { room } else { 0.0 }, Some(0.5 * diameter))
        }
        Entry::Helix { radius, .. } => (radius, None),
        Entry::Plunge => (0.0, None),
    };
    let usual = Limits::usual(rough.feed);
    let dynamics = table.dynamics.clone().unwrap_or_default();
    let given = |key: &str, value: Option<f64>, most: f64, unit: &str, factor: f64, default: f64| match value
    {
        Some(v) => positive(&format!("dynamics.{key}"), v, most, unit).map(|v| v * factor),
        None => Ok(default),
    };
    let limits = Limits {
        // mm/min, m/s2, m/s3 to mm and s; bounds beyond what machines have.
        axis_velocity: given("rapid", dynamics.rapid, 1e6, "mm/min", 1.0 / 60.0, usual.axis_velocity)?,
        acceleration: given("acceleration", dynamics.acceleration, 1e3, "m/s2", 1e3, usual.acceleration)?,
        jerk: given("jerk", dynamics.jerk, 1e6, "m/s3", 1e3, usual.jerk)?,
        ..usual
    };
    Ok(Terms {
        entry,
        drilled,
        engagement: rough.engagement.unwrap_or(TAU / 6.0),
        allowance: rough.allowance,
        lead_turns: spec.finish.as_ref().map_or(2, |f| f.turns),
        limits,
        decimals: job.post.decimals,
        control: job.post.control,
        ..Terms::new(wall, cutter, rough.stepover, rough.feed)
    })
}

/// A hole of a TOML table; its operation is decoded for itself, so that errors keep their place.
fn decode_hole(sources: &Sources, id: FileId, mut table: Spanned<DeTable<'_>>) -> Result<HoleTable> {
    let range = table.span();
    let Some(operation) = table.get_mut().remove("operation") else {
        return Err(Finding::error(Code::JOB_SHAPE, "there is no operation")
            .at(sources.locate(span(id, &range)))
            .help("add [operation] with type = \"bore\", \"drill\" or \"face\"")
            .into());
    };
    let operation = decode_operation(sources, id, operation)?;
    let HoleHead { title, tool, part, post, dynamics } = decode(sources, id, table)?;
    Ok(HoleTable { title, tool, operation, part, post, dynamics })
}
