//! The rotary axes along a tool path: positions for every point, more points where the axes would leave the way between two,
//! and a retraction where they have to go around.

use glam::{DQuat, DVec3};

use super::PathOperation;
use super::path_point::PointPace;
use crate::base::{Code, Error, Finding, Result, Silent};
use crate::geom::Rigid;
use crate::machine::kinematics::{PathOptions, ToolPose};
use crate::machine::{JointValues, Kinematics, Machine};
use crate::operations::{OrientationName, Setting, kind};

/// A point of the path with the positions of the joints.
#[derive(Clone, Copy, Debug)]
pub(super) struct TurnedPoint {
    /// Tool tip [work offset].
    pub(super) tip: DVec3,
    /// Unit vector from tip to holder [work offset].
    pub(super) axis: DVec3,
    /// Positions of the joints.
    pub(super) joints: JointValues,
    /// Speed at which it is reached.
    pub(super) pace: PointPace,
    /// Index of the point of the operation that it leads to.
    pub(super) of: usize,
}

/// A path on a machine: runs between which the tool is retracted.
#[derive(Clone, Debug)]
pub(super) struct TurnedPath {
    pub(super) runs: Vec<Vec<TurnedPoint>>,
    /// Form of the directions in the text.
    pub(super) orientation: OrientationName,
    /// Whether the control turns the tool in the plane of two directions.
    pub(super) in_plane: bool,
    /// Findings about the way.
    pub(super) findings: Vec<Finding>,
}

/// Angle between the direction on the way and the one in the plane of its ends [rad]: a hundredth of a degree, 1.7
/// micrometres at 10 mm from the tip.
const DIRECTION: f64 = 1.75e-4;
/// Angle between the directions on both sides of a retraction [rad]: a tenth of a degree.
const AT_BREAK: f64 = 1.75e-3;
/// Most times that the points are made denser; each halves the steps that need it.
const ROUNDS: u32 = 12;
/// Most points of a path on a machine.
const MOST_POINTS: usize = 4_000_000;

/// Finds the joints of a path with the tool of the operation.
///
/// # Errors
/// Those of [`Kinematics::path`] with the index of the point; `KC0104` when axis positions are asked for and the place of
/// the work on the machine or the length of the tool is not known.
pub(super) fn turned_path(
    operation: &PathOperation,
    setting: &Setting<'_>,
    machine: &Machine,
) -> Result<TurnedPath> {
    let tool = &operation.milling.tool;
    let (orientation, in_plane) = (setting.orientation, setting.post.control.turns_in_plane());
    let located = setting.clamping.setup.located;
    if orientation == OrientationName::Axes {
        let lacking = if !located {
            Some(("`position` of the setup", "position"))
        } else if tool.gauge_length.is_none() {
            Some(("`gauge_length` of the tool", "tool"))
        } else {
            None
        };
        if let Some((what, key)) = lacking {
            return Err(Finding::error(
                Code::JOB_REFERENCE,
                format!("axis positions without control of the tool centre point need the {what}"),
            )
            .help("give it, or let the control do it (post.orientation = \"angles\")")
            .key(key)
            .into());
        }
    }
    let chain = machine.kinematics(tool.gauge_length.unwrap_or(0.0));
    let work = setting.clamping.work();
    let mut options = PathOptions::new(machine.travels());
    if !located {
        let rotary = |joint: usize| machine.joints.get(joint).is_some_and(|j| j.motion.is_rotation());
        options.travels = options.travels.only(rotary);
    }
    options.start = None;
    let mut points = spread(operation);
    for round in 0.. {
        let poses: Vec<ToolPose> = points
            .iter()
            .map(|p| ToolPose { tip: work.point(p.tip), axis: Some(work.vector(p.axis)) })
            .collect();
        let path =
            chain.path(&poses, &options, setting.progress).map_err(|e| of_point(e, &points, machine))?;
        for (point, joints) in points.iter_mut().zip(&path.values) {
            point.joints = *joints;
        }
        let breaks: Vec<usize> = path.retracts.iter().map(|r| r.index).filter(|&i| i > 0).collect();
        let way =
            BetweenPoints { chain: &chain, work: &work, operation, options: &options, orientation, in_plane };
        let needs = |i: &usize| match breaks.contains(i) {
            // The place of a retraction is found where both solutions are within reach: near the pole.
            true => points[i - 1].axis.angle_between(points[*i].axis) > AT_BREAK,
            false => way.too_far(&points[i - 1], &points[*i]),
        };
        let split: Vec<usize> = (1..points.len()).filter(needs).collect();
        let last = round >= ROUNDS || points.len() + split.len() > MOST_POINTS;
        if split.is_empty() || last {
            let mut findings =
                if split.is_empty() { Vec::new() } else { vec![near_pole(&points[split[0]], operation)] };
            let runs = runs(points, &breaks, &way, &mut findings);
            return Ok(TurnedPath { runs, orientation, in_plane, findings });
        }
        points = halved(&points, &split);
    }
    Err(Finding::error(Code::GEOMETRY, "the path could not be followed").into())
}

/// An error about a pose, at the point of the operation that it belongs to.
fn of_point(error: Error, points: &[TurnedPoint], machine: &Machine) -> Error {
    match error.0.item.and_then(|i| points.get(i as usize)) {
        Some(point) => {
            let mut finding = *error.0;
            finding.item = None;
            finding.key = Some(format!("points[{}]", point.of));
            // The chain counts joints; a person names axes.
            for (i, joint) in machine.joints.iter().enumerate() {
                finding.message =
                    finding.message.replace(&format!("joint {} ", i + 1), &format!("{} ", joint.letter));
            }
            finding.point(point.tip.to_array()).into()
        }
        None => error,
    }
}

fn spread(operation: &PathOperation) -> Vec<TurnedPoint> {
    let mut axis = DVec3::Z;
    let points = operation.points.iter().enumerate().map(|(of, p)| {
        axis = p.axis.unwrap_or(axis);
        TurnedPoint { tip: p.tip, axis, joints: JointValues::zero(0), pace: p.pace, of }
    });
    points.collect()
}

/// Whether the way between two points needs a point in its middle.
fn too_far(
    chain: &Kinematics,
    work: &Rigid,
    a: &TurnedPoint,
    b: &TurnedPoint,
    (orientation, in_plane): (OrientationName, bool),
    tolerance: f64,
) -> bool {
    let mut middle = a.joints;
    for (m, q) in middle.iter_mut().zip(b.joints.iter()) {
        *m = 0.5 * (*m + q);
    }
    let to_work = work.inverse();
    let reached = chain.forward(&middle);
    let off = (to_work.point(reached.translation) - a.tip.lerp(b.tip, 0.5)).length();
    let wanted = between(a.axis, b.axis);
    let turned = to_work.vector(reached.rotation.z_axis);
    let direction = turned.cross(wanted).length().atan2(turned.dot(wanted));
    match orientation {
        // The control turns the tool in the plane of its ends.
        OrientationName::Vectors if in_plane => false,
        OrientationName::Vectors | OrientationName::Angles => direction > DIRECTION,
        // Half of the tolerance for the way, the rest for the rounding of its ends.
        OrientationName::Axes => direction > DIRECTION || off > 0.5 * tolerance,
    }
}

/// The direction midway between two.
fn between(a: DVec3, b: DVec3) -> DVec3 {
    DQuat::from_rotation_arc(a, b).slerp(DQuat::IDENTITY, 0.5) * a
}

fn halved(points: &[TurnedPoint], split: &[usize]) -> Vec<TurnedPoint> {
    let mut dense = Vec::with_capacity(points.len() + split.len());
    let mut next = split.iter().copied().peekable();
    for (i, point) in points.iter().enumerate() {
        if next.next_if_eq(&i).is_some() {
            let before = &points[i - 1];
            let (tip, axis) = (before.tip.lerp(point.tip, 0.5), between(before.axis, point.axis));
            dense.push(TurnedPoint { tip, axis, ..*point });
        }
        dense.push(*point);
    }
    dense
}

/// The runs between retractions. A new run begins where the old one ends, on the solution of its own points, so that nothing
/// of the way is left out; where it cannot, that is said.
fn runs(
    points: Vec<TurnedPoint>,
    breaks: &[usize],
    way: &BetweenPoints<'_>,
    findings: &mut Vec<Finding>,
) -> Vec<Vec<TurnedPoint>> {
    let mut runs = vec![Vec::new()];
    for (i, point) in points.into_iter().enumerate() {
        if breaks.contains(&i)
            && let Some(last) = runs.last().and_then(|run: &Vec<TurnedPoint>| run.last()).copied()
        {
            let mut run = Vec::new();
            match way.lead_in(&last, &point, ROUNDS) {
                Some(lead) => run.extend(lead),
                None => findings.push(left_out(&point, way.operation)),
            }
            runs.push(run);
        }
        if let Some(run) = runs.last_mut() {
            run.push(point);
        }
    }
    runs
}

/// Data by which the way between two points is judged.
struct BetweenPoints<'a> {
    chain: &'a Kinematics,
    work: &'a Rigid,
    operation: &'a PathOperation,
    options: &'a PathOptions,
    orientation: OrientationName,
    in_plane: bool,
}

impl BetweenPoints<'_> {
    /// Whether the way between two points needs a point in its middle.
    fn too_far(&self, a: &TurnedPoint, b: &TurnedPoint) -> bool {
        let how = (self.orientation, self.in_plane);
        too_far(self.chain, self.work, a, b, how, self.operation.milling.tolerance)
    }

    /// The points from `last` up to `next`, without it, on the solution that `next` has; `None` where that solution
    /// lies outside the travel, or an axis would have to swing round.
    fn lead_in(&self, last: &TurnedPoint, next: &TurnedPoint, deep: u32) -> Option<Vec<TurnedPoint>> {
        let start = self.beside(last.tip, last.axis, next)?;
        let start = TurnedPoint { pace: PointPace::OfOperation, of: next.of, ..start };
        if !self.too_far(&start, next) {
            return Some(vec![start]);
        }
        let deep = deep.checked_sub(1)?;
        let middle = self.beside(last.tip.lerp(next.tip, 0.5), between(last.axis, next.axis), next)?;
        let mut points = self.lead_in(last, &middle, deep)?;
        points.extend(self.lead_in(&middle, next, deep)?);
        Some(points)
    }

    /// A point with the joint positions nearest to those of another one, inside the travel.
    fn beside(&self, tip: DVec3, axis: DVec3, near: &TurnedPoint) -> Option<TurnedPoint> {
        let pose = ToolPose { tip: self.work.point(tip), axis: Some(self.work.vector(axis)) };
        let options = PathOptions { start: Some(near.joints), may_retract: false, ..*self.options };
        let path = self.chain.path(&[pose], &options, &Silent).ok()?;
        Some(TurnedPoint { tip, axis, joints: *path.values.first()?, ..*near })
    }
}

fn left_out(point: &TurnedPoint, operation: &PathOperation) -> Finding {
    Finding::warning(
        Code::PATH_BROKEN,
        format!(
            "{}: the tool is retracted, and the way to this point is left out: the axes cannot come to it from where they end",
            kind::Checked::name(operation)
        ),
    )
    .point(point.tip.to_array())
    .key(format!("points[{}]", point.of))
    .help("tilt the part so that the tool does not pass a pole or the end of a travel there")
}

fn near_pole(point: &TurnedPoint, operation: &PathOperation) -> Finding {
    Finding::warning(
        Code::TRAVEL_EXCEEDED,
        format!(
            "{}: near a pole of the rotary axes the tool leaves the way between two points",
            kind::Checked::name(operation)
        ),
    )
    .point(point.tip.to_array())
    .key(format!("points[{}]", point.of))
    .help("tilt the part so that the tool does not pass the pole")
}
