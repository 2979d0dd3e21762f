//! A planned hole: its ways down, its passes, its times.

use serde::{Deserialize, Serialize};

use super::HoleTable;
use super::compare::number;
use super::job::{job, own_key};
use super::page::hole_html;
use super::passes::{HoleCurve, curves, run};
use crate::base::{Finding, Result, Silent};
use crate::holes::compare::PassRun;
use crate::holes::{PassFigures, Sense, ToolpathPace, ToolpathRole};
use crate::job::Outputs;
use crate::job::plan::plan;
use crate::nc;
use crate::operations::OperationPlan;
use crate::operations::wall::{LeadFigure, lead_drawings, lead_figure};
use crate::page::{Block, Cell, Drawing, Fact, Row, Section, Table, duration, length};
use crate::verbs::Answer;

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
    /// Turns from the bore's centre to the wall, the paper's n; of a clearing those of its path.
    pub whole_turns: f64,
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
    /// Base radius of the involute at the wall [mm]; zero for other curves.
    pub base_radius: f64,
    /// Roll angle at the start [rad], the paper's phi0; of a lens spiral the tangent angle that takes its place.
    pub roll: f64,
    /// Direction from the bore's centre in which the path touches the wall, counter-clockwise from X [deg].
    pub touch_angle_deg: f64,
    /// Radius of curvature at the start [mm], the paper's Rn.
    pub start_curvature_radius: f64,
    /// Length of the circle at the wall [mm].
    pub circle_length: f64,
    /// Number of curves of the path, its circle among them.
    pub curve_count: usize,
    /// The first of them.
    pub curves: Vec<HoleCurve>,
    /// The involute with its base circle and turn by psi; only with samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub figure: Option<LeadFigure>,
    /// The pass of the last level as it is run; only with samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run: Option<PassRun>,
}

/// Limits of the axes that the runs keep, in the units of their table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct HoleLimits {
    /// Rapid of an axis [mm/min].
    pub rapid: f64,
    /// Acceleration of an axis [m/s2].
    pub acceleration: f64,
    /// Jerk of an axis [m/s3].
    pub jerk: f64,
}

/// Passes that are given as they are run, in samples, with the figures of their involutes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HoleSamples {
    /// None.
    #[default]
    None,
    /// Roughing.
    Rough,
    /// Finishing.
    Finish,
    /// Both.
    All,
}

impl HoleSamples {
    fn of(self, finishing: bool) -> bool {
        match self {
            HoleSamples::None => false,
            HoleSamples::Rough => !finishing,
            HoleSamples::Finish => finishing,
            HoleSamples::All => true,
        }
    }
}

/// A planned hole, in the units of the shop.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HolePlan {
    /// Title.
    pub title: String,
    /// Centre of the bore [mm].
    pub at: [f64; 2],
    /// Its diameter at the last level [mm].
    pub diameter: f64,
    /// Diameter of the cutter [mm].
    pub cutter_diameter: f64,
    /// Strategy of roughing.
    pub strategy: String,
    /// Whether the path runs clockwise.
    pub clockwise: bool,
    /// Limits of the axes; only with samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limits: Option<HoleLimits>,
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
    /// Remarks for a person.
    pub findings: Vec<Finding>,
    /// Figures 3, 4 and 5 of the paper for the lead-in of finishing; empty without finishing.
    #[serde(skip)]
    pub drawings: Vec<Drawing>,
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

    fn files(answers: &[&HolePlan]) -> Result<Outputs> {
        Ok(crate::verbs::page("hole.html", hole_html(answers)))
    }
}

/// Direction from the bore's centre in which a pass touches the wall [rad]: there its circle begins.
fn touch_angle(pass: &PassFigures) -> f64 {
    pass.curves.last().map_or(0.0, |circle| circle.start().to_angle())
}

/// Plans a hole.
///
/// # Errors
/// Those of the job's checks, the planner and the writer, with the key in the hole's own table.
pub fn plan_hole(table: &HoleTable) -> Result<HolePlan> {
    plan_hole_sheet(table, HoleSamples::None)
}

/// Plans a hole, with passes in samples.
///
/// # Errors
/// As [`plan_hole`]; with samples those of the limits of the axes.
pub fn plan_hole_sheet(table: &HoleTable, samples: HoleSamples) -> Result<HolePlan> {
    let job = job(table)?;
    let planned = plan(&job, &Silent).map_err(own_key)?;
    let mut result = HolePlan {
        title: job.title.clone(),
        at: [0.0; 2],
        diameter: 0.0,
        cutter_diameter: 0.0,
        strategy: String::new(),
        clockwise: false,
        limits: None,
        entries: Vec::new(),
        passes: Vec::new(),
        feed_length: 0.0,
        entry_length: 0.0,
        feed_time: 0.0,
        control: job.post.control.name(),
        program_lines: 0,
        findings: Vec::new(),
        drawings: Vec::new(),
    };
    for setup in &planned {
        result.program_lines += nc::write(&setup.program, &job.tools, &job.post)?.text.lines().count();
        for operation in &setup.operations {
            let OperationPlan::Bore(planned) = &operation.plan else { continue };
            let bore = &planned.plan;
            let of = &planned.of;
            result.at = of.table.at;
            result.diameter = of.table.bottom_diameter.unwrap_or(of.table.diameter);
            result.cutter_diameter = of.milling.tool.cutter.diameter(of.milling.tool.flute_length);
            result.strategy = of.table.strategy.name();
            result.clockwise = of.table.direction == Sense::Conventional;
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
                let Some(pass) = pass else { continue };
                let finishing = name == "finish";
                let wanted = samples.of(finishing);
                let run = if wanted { Some(run(table, bore, of, finishing)?) } else { None };
                let (run, limits) = run.unzip();
                result.limits = limits.or(result.limits);
                result.passes.push(hole_pass(name, pass, wanted, run.flatten()));
            }
            result.drawings.extend(bore.finish.iter().flat_map(lead_drawings));
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

fn hole_pass(name: &'static str, pass: &PassFigures, drawn: bool, run: Option<PassRun>) -> HolePass {
    // A clearing of several curves is no single involute.
    let is_involute = name == "finish" || (pass.base_radius > 0.0 && pass.curves.len() == 2);
    HolePass {
        pass: name,
        path_radius: pass.path_radius,
        turns: pass.visible_turns,
        whole_turns: pass.turns,
        step: pass.step,
        entry_radius: pass.inner_radius,
        engagement_deg: pass.engagement.map(f64::to_degrees),
        length: pass.length,
        floors: pass.floors.clone(),
        base_radius: pass.base_radius,
        roll: pass.roll,
        touch_angle_deg: touch_angle(pass).to_degrees(),
        start_curvature_radius: pass.curves.first().map_or(0.0, |c| 1.0 / c.at(0.0).curvature.abs()),
        circle_length: pass.curves.last().map_or(0.0, |c| c.length()),
        curve_count: pass.curves.len(),
        curves: curves(pass),
        figure: (drawn && is_involute).then(|| lead_figure(pass)).flatten(),
        run,
    }
}
