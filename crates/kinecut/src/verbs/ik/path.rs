//! A path of poses to joint positions: which solution at which turn, and where the tool must be retracted.

use std::borrow::Cow;
use std::fmt::Write as _;

use serde::Serialize;

use super::inverse::{InverseWants, held, is_polar, pose};
use super::straight::{StraightStep, StraightWants, straight_steps};
use crate::base::{Code, Finding, Progress, Result};
use crate::machine::kinematics::{PathOptions, RetractKind, ToolPose};
use crate::machine::{Elementary, JointValues, MOST_JOINTS, Machine};
use crate::page::{Block, Fact, Section};
use crate::verbs::Answer;
use crate::verbs::poses::PoseTexts;
use crate::verbs::poses::{AxisValues, number};

/// Settings of a path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathWants {
    /// Axes that are held, length of the tool.
    pub poses: InverseWants,
    /// Positions of the axes before the path, zero for axes not named; `None`: they may start anywhere.
    pub from: Option<AxisValues>,
    /// Whether the tool may not be retracted.
    pub without_retract: bool,
    /// An axis that should start at a positive position.
    pub prefer_positive: Option<char>,
    /// Straightness wanted of the tool when the axes go straight between the solutions: on a control that does not keep
    /// the tip on its path.
    pub straight: Option<StraightWants>,
}

/// A step for which the tool must be retracted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RetractRow {
    /// Index of the pose after the step, from zero.
    pub index: usize,
    /// "flip" to another solution, or "unwind" by whole turns.
    pub kind: &'static str,
    /// The axis that turns farthest.
    pub axis: char,
    /// Its turn [deg].
    pub degrees: f64,
}

impl RetractRow {
    fn words(&self) -> String {
        format!("{} of {} by {} deg", self.kind, self.axis, number(self.degrees))
    }
}

/// Joint positions along a path.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PathSheet {
    /// One for each pose.
    pub joints: Vec<AxisValues>,
    /// Travel of the rotary axes together, retractions counted with their cost [deg].
    pub cost_deg: f64,
    /// Steps at which the tool must be retracted.
    pub retracts: Vec<RetractRow>,
    /// Deviations of the tool from its straight steps, and the points that prevent them, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub straight: Option<Vec<StraightStep>>,
}

/// The joint positions along a path of poses within travel that turn the rotary axes least.
///
/// # Errors
/// The first pose that cannot be read, with its place; `KC1115` when no solution of a pose lies inside the travel; `KC1116`
/// when the tool would have to be retracted and must not; those of [`super::inverse`].
pub fn path(
    machine: &Machine,
    poses: &PoseTexts,
    wants: &PathWants,
    progress: &dyn Progress,
) -> Result<PathSheet> {
    let (given, locked) = held(machine, &wants.poses.locked)?;
    let polar = is_polar(machine, &locked);
    let mut tools = Vec::with_capacity(poses.items.len());
    for (i, item) in poses.items.iter().enumerate() {
        let (tip, axis) = item.clone().and_then(|words| pose(&words)).map_err(|e| poses.locate(i, e))?;
        let axis = axis.or((!polar).then(|| Elementary::Z.direction()).flatten());
        tools.push(ToolPose { tip, axis });
    }
    let mut options = PathOptions::new(machine.travels());
    let mut start = match &wants.from {
        Some(from) => from.joints(machine)?,
        None => JointValues::zero(machine.joints.len()),
    };
    for (i, &held) in locked.iter().enumerate().take(MOST_JOINTS) {
        options.locked[i] = held;
        if held {
            start[i] = given[i];
        }
    }
    options.start = wants.from.is_some().then_some(start);
    options.held = start;
    options.may_retract = !wants.without_retract;
    options.prefer_positive = match wants.prefer_positive {
        Some(letter) => {
            AxisValues(vec![(letter, 0.0)]).joints(machine)?;
            machine.joint(letter).map(|(i, _)| i)
        }
        None => None,
    };
    if let Some(straight) = wants.straight.as_ref().filter(|_| polar) {
        return Err(Finding::error(
            Code::NO_CLOSED_FORM,
            "points between are made for machines whose poses have a direction, not for two translations and a rotation",
        )
        .value_mm(straight.tolerance)
        .help("leave the tolerance out and give poses that are near to each other")
        .key("tolerance")
        .into());
    }
    let chain = machine.kinematics(wants.poses.length);
    let found = chain.path(&tools, &options, progress)?;
    let straight = wants.straight.as_ref().map(|straight| {
        straight_steps(machine, &chain, &found.values, (&found.retracts, &locked), straight, progress)
    });
    let retracts = found.retracts.iter().map(|r| RetractRow {
        index: r.index,
        kind: match r.kind {
            RetractKind::Flip => "flip",
            RetractKind::Unwind => "unwind",
        },
        axis: machine.joints.get(r.joint).map_or('?', |j| j.letter),
        degrees: r.travel.to_degrees(),
    });
    Ok(PathSheet {
        joints: found.values.iter().map(|v| AxisValues::of(machine, v)).collect(),
        cost_deg: found.cost.to_degrees(),
        retracts: retracts.collect(),
        straight: straight.transpose()?,
    })
}

impl Answer for PathSheet {
    fn sections(&self) -> Vec<Section> {
        let mut facts = vec![
            Fact::new("Poses", self.joints.len().to_string()),
            Fact::new("Turning", format!("{} deg", number(self.cost_deg)))
                .note("of the rotary axes, with the cost of retractions"),
        ];
        facts.extend(
            self.retracts
                .iter()
                .map(|r| Fact::new("Retract", r.words()).note(format!("before pose[{}]", r.index))),
        );
        if let Some(steps) = &self.straight {
            let worst = |of: fn(&StraightStep) -> f64| number(steps.iter().map(of).fold(0.0, f64::max));
            let points: usize = steps.iter().map(|s| s.inserted.len()).sum();
            let left = worst(|s| s.left);
            let turned = worst(|s| s.axis_left_deg);
            facts.push(
                Fact::new(
                    "Straight axes",
                    format!("leave the line by {} mm at most", worst(|s| s.deviation)),
                )
                .note(format!("with {points} points between by {left} mm, the direction by {turned} deg")),
            );
        }
        vec![Section::default().with(Block::Facts(facts))]
    }

    /// A line of words for each pose, which `kinecut fk` reads again.
    fn data(&self) -> Cow<'_, str> {
        let mut out = String::new();
        let mut retracts = self.retracts.iter().peekable();
        let mut steps = self.straight.as_deref().unwrap_or_default().iter().peekable();
        for (i, joints) in self.joints.iter().enumerate() {
            if let Some(r) = retracts.next_if(|r| r.index == i) {
                let _ = writeln!(out, "; retract: {}", r.words());
            }
            if let Some(step) = steps.next_if(|s| s.index == i) {
                out.push_str(&step.text());
            }
            let _ = writeln!(out, "{}", joints.words());
        }
        Cow::Owned(out)
    }

    /// Steps for which no points between help.
    fn findings(&self) -> Vec<&Finding> {
        self.straight.iter().flatten().filter_map(|step| step.finding.as_ref()).collect()
    }

    /// Retractions and steps that no points help are no path of one piece.
    fn is_no(&self) -> bool {
        !self.retracts.is_empty() || !self.findings().is_empty()
    }
}
