//! The parts of a kind of operation: the table of the job file, the checked operation, its plan.

use std::sync::Arc;

use serde::Serialize;

use super::edge::FaceEdges;
use super::face::FacingTable;
use super::measured::{BoreMeasure, FaceMeasure, Loose, Probe, Proof, TakenOut, WallProbe};
use super::named::NamedOutline;
use super::wanted::{PlannedOutline, WantedPlane, WantedWall};
use super::{
    Around, CalledTool, MadeMouth, MadePlane, Milling, Pen, PlaneTable, PostedPlan, RoundHole, Setting,
};
use crate::base::{Finding, Result};
use crate::cutting::{MillingCut, StartCut};
use crate::drilling::FeedChoice;
use crate::page::Section;
use crate::program::Setup;
use crate::stock::{PointEngagement, WallEnd};

/// The table of an operation in the job file.
pub(crate) trait Table {
    /// The checked operation.
    type Of: Checked;

    /// Checks the table.
    ///
    /// # Errors
    /// One finding with the key of the first wrong value, counted from the table.
    fn check(&self, around: &Around<'_>) -> Result<Self::Of>;

    /// The tool that it calls.
    fn called(&mut self) -> &mut CalledTool;

    /// The keys of its speed and feed that may be left out where the tool has data for the material.
    fn data(&mut self) -> Option<CuttingKeys<'_>> {
        None
    }

    /// The tilted plane in which it works, if it names one.
    fn plane(&self) -> Option<&PlaneTable> {
        None
    }

    /// The outline along which it works, under the name by which others may refer to it.
    fn named_outline(&self) -> Option<NamedOutline<'_>> {
        None
    }

    /// Itself, if it mills a face.
    fn face(&self) -> Option<&FacingTable> {
        None
    }

    /// The file that it names, with the role that the file has in a verdict.
    fn file(&self) -> Option<(&'static str, &str)> {
        None
    }
}

/// Keys of the speed of an operation.
pub(crate) struct CuttingKeys<'a> {
    /// `speed` [rev/min].
    pub(crate) speed: &'a mut Option<f64>,
    /// `cutting_speed` [m/min].
    pub(crate) cutting_speed: &'a mut Option<f64>,
    /// Keys of its feed, where that may be left out.
    pub(crate) feed: Option<FeedKeys<'a>>,
    /// `feed_per_rev` of a drill.
    pub(crate) per_rev: Option<&'a mut Option<FeedChoice>>,
    /// The cut for which values to start with are wanted.
    pub(crate) cut: StartCut,
}

/// Keys of the feed of an operation.
pub(crate) struct FeedKeys<'a> {
    /// `feed` [mm/min].
    pub(crate) feed: &'a mut Option<f64>,
    /// `feed_per_tooth` [mm].
    pub(crate) per_tooth: &'a mut Option<f64>,
}

/// A checked operation.
pub(crate) trait Checked {
    /// Its plan.
    type Plan: Plan;

    /// The noun by which its measured shapes are counted: "bore"; empty where none of them is measured.
    const NOUN: &'static str = "";

    /// Tool, speed, coolant, tolerance, plane.
    fn milling(&self) -> &Milling;

    /// The same, to be completed.
    fn milling_mut(&mut self) -> &mut Milling;

    /// A person's name for it: kind, size, place.
    fn name(&self) -> String;

    /// Whether its tool cuts left-handed: the spindle turns counter-clockwise.
    fn is_left_hand(&self) -> bool {
        false
    }

    /// The surface that it leaves, where that is compared with nothing.
    fn not_compared(&self) -> Option<&'static str> {
        None
    }

    /// Passes along the finished wall that take off what the tool's deflection left.
    fn spring_passes(&self) -> u32 {
        0
    }

    /// The cut of a straight stretch of its finishing, on which the wall's place depends.
    fn finishing(&self) -> Option<MillingCut> {
        None
    }

    /// The outline that has to lie in the stock.
    fn outline(&self) -> Option<PlannedOutline> {
        None
    }

    /// A warning if the raw stock is this high over its zero [mm] and the operation is the first of all.
    fn under_stock(&self, _top: f64) -> Option<Finding> {
        None
    }

    /// Plans it.
    ///
    /// # Errors
    /// One finding with a key counted from the table.
    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<Self::Plan>>;
}

/// The result of planning.
pub(crate) enum Attempt<P> {
    /// A plan, and findings about it with keys counted from the table.
    SetupPlan(P, Vec<Finding>),
    /// The operation is left out, for this reason.
    LeftOut(Box<Finding>),
}

/// A wear register of the control that an operation uses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WearRegister {
    /// Its number.
    pub(crate) number: u32,
    /// The value with which the program is simulated [mm].
    pub(crate) value: f64,
    /// The radius that it holds beside that: of a cutter whose contour is posted, else 0 [mm].
    pub(crate) radius: f64,
}

/// A planned operation.
pub(crate) trait Plan: Sized {
    /// Its part of `plan.json`; [`Nothing`] where it has none.
    type Json: Serialize;

    /// The list of `plan.json` that the parts of this kind are in.
    const LIST: &'static str = "";

    /// The wear register that it uses.
    fn wear(&self) -> Option<WearRegister> {
        None
    }

    /// Turns the part on the table, where the plan wants that.
    fn turn_part(&self, _setting: &Setting<'_>, _setup: &mut Setup) {}

    /// Writes its moves.
    ///
    /// # Errors
    /// One finding with a key counted from the table.
    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()>;

    /// Whether the rotary axes are not at zero after it.
    fn leaves_axes_turned(&self) -> bool {
        false
    }

    /// Findings of the planner about the plan as a whole.
    fn remarks(&self) -> &[Finding] {
        &[]
    }

    /// Depth to which it may go below the stock by itself, besides the length of the tool's point [mm].
    fn breakthrough(&self) -> f64 {
        0.0
    }

    /// Cores that a person takes out at the program stops, in order.
    fn taken_out(&self) -> &[TakenOut] {
        &[]
    }

    /// Cores that fall out by themselves.
    fn falling(&self, _posted: &PostedPlan<'_>) -> Vec<Loose> {
        Vec::new()
    }

    /// The walls that it wants.
    fn walls(&self) -> Vec<WantedWall> {
        Vec::new()
    }

    /// Whether it cuts along a line as it is given, and says nothing of the surfaces that it leaves.
    fn wants_nothing(&self) -> bool {
        false
    }

    /// The round holes that it leaves.
    fn holes(&self) -> Vec<RoundHole> {
        self.walls().iter().filter_map(RoundHole::of_wall).collect()
    }

    /// The plane that it leaves, for operations after it.
    fn made_plane(&self) -> Option<MadePlane> {
        None
    }

    /// The recesses at the mouths of holes that it leaves, for drills after it.
    fn mouths(&self) -> Vec<MadeMouth> {
        Vec::new()
    }

    /// The face that it has milled, for operations after it that go by its edges.
    fn milled(&self) -> Option<FaceEdges> {
        None
    }

    /// The plane that it wants.
    fn plane(&self) -> Option<WantedPlane<'_>> {
        None
    }

    /// The measures that it wants taken in the stock; at most `most` probes of points.
    fn probes(&self, _posted: &PostedPlan<'_>, _most: usize) -> Probes {
        Probes::default()
    }

    /// Compares the plan with what was measured; it keeps what it shows later.
    fn judge(&mut self, _name: &str, _posted: &PostedPlan<'_>, _found: &Found<'_>) -> Judged {
        Judged::default()
    }

    /// The claim that the tallies of all operations of the kind make together, and what they leave unchecked; `step`: distance
    /// of the stock's lines [mm].
    fn sum_up(_tallies: &[Tally], _step: f64) -> (Option<Proof>, Option<String>) {
        (None, None)
    }

    /// The sections of the report for all operations of the kind.
    fn sections(_all: &[(&Self, &Shown<'_>)]) -> Vec<Section> {
        Vec::new()
    }

    /// Its part of `plan.json`.
    fn json(&self, _shown: &Shown<'_>) -> Option<Self::Json> {
        None
    }
}

/// No part of `plan.json`.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) enum Nothing {}

/// Measures that an operation wants taken in the stock.
#[derive(Clone, Debug, Default)]
pub(crate) struct Probes {
    /// Engagements of points.
    pub(crate) points: Vec<Probe>,
    /// The walls before a face is milled.
    pub(crate) walls: Option<WallProbe>,
}

/// The measures taken for an operation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<'a> {
    /// Distance of the stock's lines [mm].
    pub(crate) step: f64,
    /// The places at which points were measured.
    pub(crate) probes: &'a Probes,
    /// Engagements of these points.
    pub(crate) points: &'a [PointEngagement],
    /// The walls before the face was milled.
    pub(crate) walls: &'a [WallEnd],
}

/// The result of comparing an operation with its measures.
#[derive(Clone, Debug, Default)]
pub(crate) struct Judged {
    /// Findings, each with the item of the text.
    pub(crate) findings: Vec<(Finding, u32)>,
    /// A claim of the operation by itself.
    pub(crate) proven: Option<Proof>,
    /// A part of its shape that was not checked, in words.
    pub(crate) unchecked: Option<String>,
    /// Counts for the claim of all operations of the kind.
    pub(crate) tally: Tally,
}

/// Measures as numbers of places.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Tally {
    /// Places that are as planned.
    pub(crate) good: usize,
    /// Places that are not.
    pub(crate) bad: usize,
    /// Places that were not measured.
    pub(crate) unmeasured: usize,
    /// Largest difference of the good ones [mm].
    pub(crate) worst: f64,
}

impl Shown<'_> {
    /// Its name as a heading.
    pub(crate) fn title(&self) -> String {
        crate::page::heading(&self.name)
    }
}

/// A planned operation with all that its section of the report may show.
#[derive(Clone, Debug)]
pub(crate) struct Shown<'a> {
    /// Number of the operation over all setups.
    pub(crate) number: u32,
    /// Its name.
    pub(crate) name: String,
    /// The program of its setup.
    pub(crate) posted: PostedPlan<'a>,
    /// First line of the setup's program in the lines of all programs.
    pub(crate) first_line: u32,
    /// For each line of all programs the time at which it begins [s], and last the time of all.
    pub(crate) begins: &'a [f64],
    /// Time of the programs before that of its setup, and of all [s].
    pub(crate) time: [f64; 2],
    /// Speed of the machine's rapids [mm/s], if it is known.
    pub(crate) rapid: Option<f64>,
    /// Engagements of the points that it wanted measured.
    pub(crate) points: &'a [PointEngagement],
    /// Its walls as measured.
    pub(crate) walls: Vec<&'a BoreMeasure>,
    /// Its plane as measured.
    pub(crate) plane: Option<&'a FaceMeasure>,
}
