//! The operations that make a hole of a size.

use std::collections::BTreeMap;

use super::choose::{ToolList, short, title};
use super::size::{SAME, Size};
use crate::base::bounded::{MAX_LENGTH, length, positive};
use crate::base::{Code, Finding, Result};
use crate::drilling::DrillMethod;
use crate::job::file::{HoleTable, ToolTable, ToolType, tool};
use crate::nc::Control;
use crate::operations::drill::{DrillTable, PeckName, PeckTable, PreHoleTable};
use crate::operations::tap::TapTable;
use crate::operations::thread_mill::ThreadMillTable;
use crate::operations::{CalledTool, OperationTable};
use crate::tool::{Cutter, Tool};

/// Width of the chamfer that a spot leaves, where nothing says it [mm].
const CHAMFER: f64 = 0.2;
/// Way that stays free below a reamer in a blind hole [mm].
const BELOW_REAMER: f64 = 0.3;
/// Way that stays free below a tap or a thread mill in a blind hole, in pitches.
const BELOW_THREAD: f64 = 1.0;
/// Depth from which a drill goes in steps, and the depth of a step, in diameters.
const PECKED: f64 = 4.0;
const PECK: f64 = 1.0;
/// Way of a thread mill below the full thread, in pitches.
const BELOW_MILL: f64 = 0.75;

/// Order in which the steps of holes that follow one another run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Stage {
    Spot,
    Drill,
    Recess,
    Finish,
}

/// An operation of a hole.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub(super) stage: Stage,
    /// Number of its tool.
    pub(super) tool: u32,
    pub(super) table: OperationTable,
}

/// The tools that a hole names, found.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Named<'a> {
    pub(super) spot: Option<&'a ToolTable>,
    pub(super) drill: Option<&'a ToolTable>,
    pub(super) tool: Option<&'a ToolTable>,
    /// Of its countersink or counterbore.
    pub(super) recess: Option<&'a ToolTable>,
}

/// A hole, its height, and the tools from which it is made.
pub(super) struct Maker<'a> {
    pub(super) hole: &'a HoleTable,
    pub(super) size: Size,
    /// Height from which depths count [mm].
    pub(super) top: f64,
    pub(super) control: Control,
    pub(super) tools: &'a ToolList<'a>,
    pub(super) named: Named<'a>,
    /// Notes about tools that were chosen.
    pub(super) notes: Vec<String>,
}

/// The tool that brings a drilled hole to its size.
enum Finisher<'a> {
    Reamer(&'a ToolTable),
    Tap(&'a ToolTable),
    ThreadMill(&'a ToolTable),
}

impl<'a> Maker<'a> {
    /// The operations of the hole, in their order.
    ///
    /// # Errors
    /// One finding with a key of the hole: a value out of range, or a tool that is not there.
    pub(super) fn steps(&mut self) -> Result<Vec<Step>> {
        self.check()?;
        let hole = self.hole;
        let finisher = self.finisher()?;
        let drilled = match hole.depth {
            Some(depth) => Some(depth + self.below(finisher.as_ref())?),
            None => None,
        };
        let drill = match self.named.drill {
            Some(drill) => drill,
            None => self.tools.drill(self.core(finisher.as_ref()), &self.size, hole.pilot, drilled)?,
        };
        let mut steps = Vec::with_capacity(4);
        if hole.spot {
            steps.push(self.spot()?);
        }
        steps.push(self.drill(drill, drilled));
        steps.extend(self.recess(drill.diameter)?);
        if let Some(finisher) = finisher {
            steps.push(self.finish(&finisher, drill, drilled));
        }
        Ok(steps)
    }

    fn check(&self) -> Result<()> {
        let hole = self.hole;
        for (key, value) in [("depth", hole.depth), ("pilot", hole.pilot)] {
            value.map(|v| positive(key, v, MAX_LENGTH, "mm")).transpose()?;
        }
        length("chamfer", hole.chamfer.unwrap_or(CHAMFER), 0.0, MAX_LENGTH)?;
        length("top", self.top, -MAX_LENGTH, MAX_LENGTH)?;
        let wrong = |key: &str, what: &str, help: &str| {
            Err(Finding::error(Code::JOB_SHAPE, what).help(help).key(key).into())
        };
        let is_plain = matches!(self.size, Size::Plain(_));
        match hole.pilot {
            Some(_) if is_plain => return wrong("pilot", "a plain hole has no pilot", "leave it out"),
            Some(_) if hole.drill.is_some() => {
                return wrong("pilot", "`pilot` and `drill` exclude each other", "leave one of them out");
            }
            Some(pilot) if pilot >= self.size.diameter() => {
                let what = "the pilot is as wide as the hole";
                let finding = Finding::error(Code::JOB_VALUE, what).value_mm(pilot);
                return Err(finding
                    .bound_mm(self.size.diameter())
                    .help("write a smaller one")
                    .key("pilot")
                    .into());
            }
            _ => {}
        }
        if is_plain && hole.tool.is_some() {
            return wrong("tool", "a plain hole has only a drill", "write it as `drill`");
        }
        if !hole.spot && (hole.spot_drill.is_some() || hole.chamfer.is_some()) {
            let key = if hole.chamfer.is_some() { "chamfer" } else { "spot_drill" };
            return wrong(
                key,
                "a hole without a spot has none of its keys",
                "leave it out, or leave out `spot`",
            );
        }
        self.check_recess()
    }

    /// The reamer, tap or thread mill.
    fn finisher(&mut self) -> Result<Option<Finisher<'a>>> {
        match (&self.size, self.named.tool) {
            (Size::Plain(_), _) => Ok(None),
            (Size::Fit(..), Some(tool)) => Ok(Some(Finisher::Reamer(tool))),
            (Size::Fit(diameter, fit), None) => {
                let (tool, says_fit) = self.tools.reamer(*diameter, fit)?;
                if !says_fit {
                    let title = title(tool);
                    self.notes.push(format!(
                        "{title} is taken for {}; nothing says that it makes {fit}",
                        self.size.word()
                    ));
                }
                Ok(Some(Finisher::Reamer(tool)))
            }
            (Size::Thread(_), Some(tool)) if tool.kind == ToolType::ThreadMill => {
                Ok(Some(Finisher::ThreadMill(tool)))
            }
            (Size::Thread(_), Some(tool)) => Ok(Some(Finisher::Tap(tool))),
            (Size::Thread(thread), None) => {
                let tap = self.tools.tap(thread.diameter, thread.pitch);
                let tap = tap.filter(|_| self.control.has_rigid_tapping());
                let mill = || self.tools.thread_mill(thread.diameter, thread.pitch);
                match tap.map(Finisher::Tap).or_else(|| mill().map(Finisher::ThreadMill)) {
                    Some(found) => Ok(Some(found)),
                    None if self.control.has_rigid_tapping() => {
                        let what = format!("no tap {} and no thread mill for it", self.size.word());
                        Err(self.tools.missing(&what, "add one"))
                    }
                    None => {
                        let what = format!("no thread mill for {}", self.size.word());
                        let title = self.control.title();
                        let help = format!("add one: {title} has no synchronised spindle and cannot tap");
                        Err(self.tools.missing(&what, &help))
                    }
                }
            }
        }
    }

    /// Least, usual and largest diameter of the drill [mm].
    fn core(&self, finisher: Option<&Finisher<'_>>) -> [f64; 3] {
        match (self.hole.pilot, finisher) {
            (Some(pilot), _) => [pilot - SAME, pilot, pilot + SAME],
            // A tap that forms leaves its core hole half closed: 0.42 to 0.5 pitches less than the diameter.
            (None, Some(Finisher::Tap(tap))) if tap.forming == Some(true) => {
                let pitch = tap.pitch.unwrap_or(0.0);
                [
                    tap.diameter - 0.5 * pitch - SAME,
                    tap.diameter - 0.46 * pitch,
                    tap.diameter - 0.42 * pitch + SAME,
                ]
            }
            _ => self.size.drill(),
        }
    }

    /// Way by which the drill goes deeper than the finished depth, where the hole is blind [mm].
    fn below(&self, finisher: Option<&Finisher<'_>>) -> Result<f64> {
        // A tenth of a millimetre as a person would write it.
        let rounded = |v: f64| (v * 10.0 - 1e-6).ceil() / 10.0;
        Ok(match finisher {
            None => 0.0,
            Some(Finisher::Reamer(reamer)) => rounded(checked(reamer)?.cutter.tip_height() + BELOW_REAMER),
            Some(Finisher::Tap(tap)) => {
                let pitch = tap.pitch.unwrap_or(0.0);
                match checked(tap)?.cutter {
                    Cutter::Tap(tap) => rounded(tap.below_thread() + BELOW_THREAD * pitch),
                    _ => 0.0,
                }
            }
            Some(Finisher::ThreadMill(mill)) => {
                rounded((BELOW_MILL + BELOW_THREAD) * mill.pitch.unwrap_or(0.0))
            }
        })
    }

    fn spot(&mut self) -> Result<Step> {
        let chamfer = self.hole.chamfer.unwrap_or(CHAMFER);
        let wanted = self.size.diameter() + 2.0 * chamfer;
        let (tool, reached) = match self.named.spot {
            Some(tool) => (tool, ToolList::spot_within(tool, wanted)),
            None => self.tools.spot(wanted)?,
        };
        if reached < wanted - 1e-9 {
            let title = title(tool);
            let what = if reached > self.size.diameter() { "a narrower chamfer" } else { "no chamfer" };
            self.notes.push(format!(
                "{title} spots {} to {}, not to {}: {what} is left",
                self.size.word(),
                short(reached),
                short(wanted)
            ));
        }
        let table = DrillTable {
            method: DrillMethod::Centring,
            reach_diameter: Some(reached),
            ..self.drilling(tool)
        };
        Ok(Step { stage: Stage::Spot, tool: tool.number, table: OperationTable::Drill(Box::new(table)) })
    }

    fn drill(&self, tool: &ToolTable, depth: Option<f64>) -> Step {
        let deep = PECKED * tool.diameter;
        let steps = PeckTable { step: PECK * tool.diameter, after: PeckName::BreakChip };
        let peck = depth.is_some_and(|depth| depth > deep).then_some(steps);
        // How deep a hole goes that goes through is known when it is planned.
        let peck_deep = depth.is_none().then_some((deep, steps));
        let table = DrillTable { depth, peck, peck_deep, ..self.drilling(tool) };
        Step { stage: Stage::Drill, tool: tool.number, table: OperationTable::Drill(Box::new(table)) }
    }

    fn finish(&self, finisher: &Finisher<'_>, drill: &ToolTable, drilled: Option<f64>) -> Step {
        let hole = self.hole;
        let (tool, table) = match finisher {
            Finisher::Reamer(tool) => {
                let there = PreHoleTable {
                    diameter: drill.diameter,
                    offset: None,
                    // Without the cone of the drill below it.
                    bottom: drilled.map(|depth| self.top - depth),
                    bottom_angle: None,
                };
                let table = DrillTable {
                    method: DrillMethod::Reaming,
                    depth: hole.depth,
                    pre_hole: Some(there),
                    ..self.drilling(tool)
                };
                (tool, OperationTable::Drill(Box::new(table)))
            }
            Finisher::Tap(tool) => {
                let table = TapTable {
                    tool: CalledTool::Number(tool.number),
                    points: hole.points.clone(),
                    pattern: hole.pattern.clone(),
                    top: self.mouth(),
                    depth: self.thread_depth(),
                    clearance: hole.clearance,
                    coolant: hole.coolant,
                    ..TapTable::default()
                };
                (tool, OperationTable::Tap(Box::new(table)))
            }
            Finisher::ThreadMill(tool) => {
                let table = ThreadMillTable {
                    tool: CalledTool::Number(tool.number),
                    points: hole.points.clone(),
                    pattern: hole.pattern.clone(),
                    size: Some(hole.size.to_string()),
                    top: self.mouth(),
                    depth: self.thread_depth(),
                    clearance: hole.clearance,
                    coolant: hole.coolant,
                    ..ThreadMillTable::default()
                };
                (tool, OperationTable::ThreadMill(Box::new(table)))
            }
        };
        Step { stage: Stage::Finish, tool: tool.number, table }
    }

    /// Drilling with a tool, all else of it as usual.
    pub(super) fn drilling(&self, tool: &ToolTable) -> DrillTable {
        let hole = self.hole;
        DrillTable {
            tool: CalledTool::Number(tool.number),
            points: hole.points.clone(),
            pattern: hole.pattern.clone(),
            top: self.top,
            clearance: hole.clearance,
            coolant: hole.coolant,
            ..DrillTable::usual()
        }
    }
}

/// A tool as checked; its holder does not matter here.
fn checked(table: &ToolTable) -> Result<Tool> {
    let bare = ToolTable { holder: None, ..table.clone() };
    tool(&bare, &BTreeMap::new())
}
