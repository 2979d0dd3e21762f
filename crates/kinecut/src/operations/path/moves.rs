//! A tool path as moves of a program.

use glam::DVec3;

use super::PathOperation;
use super::path_point::PointPace;
use super::turned::{TurnedPath, TurnedPoint};
use crate::base::Result;
use crate::geom::Rigid;
use crate::machine::{JointValues, Machine};
use crate::operations::setting::{ABOVE_STOCK, corners};
use crate::operations::{OrientationName, Pen};
use crate::program::{Coolant, Move, Origin, Path, Role, Speed, State, Target, Tcp, ToolAxis};
use crate::trace::axis_positions;

fn rapid() -> Speed {
    Speed::Rapid { linear: true }
}

fn pace_of(pace: PointPace, first: bool, operation: &PathOperation) -> Speed {
    match pace {
        // The first point is in the material: it is reached at feed whatever the file says.
        PointPace::Rapid if !first => rapid(),
        PointPace::Feed(feed) => Speed::PerMinute(feed),
        _ => Speed::PerMinute(operation.feed),
    }
}

/// Appends a path along which the tool stands along Z: from above the first point down to it, along all points, and back up.
pub(super) fn write_upright(pen: &mut Pen<'_>, operation: &PathOperation) {
    let (program, state, origin) = (&mut *pen.program, &mut *pen.state, pen.origin);
    let coolant = operation.milling.coolant;
    let to = |tip: DVec3| Move { end: Target::Tip { point: tip, axis: ToolAxis::Fixed }, path: Path::Line };
    let link = Origin { role: Role::Link, ..origin };
    let [Some(first), Some(last)] = [operation.points.first(), operation.points.last()] else { return };
    let above = first.tip + DVec3::Z * operation.clearance;
    state.speed = rapid();
    program.push_move(to(DVec3::new(above.x, above.y, f64::NAN)), state, link);
    program.push_move(to(above), state, link);
    state.coolant = coolant;
    for (i, point) in operation.points.iter().enumerate() {
        state.speed = pace_of(point.pace, i == 0, operation);
        program.push_move(to(point.tip), state, Origin { role: Role::Finish, ..origin });
    }
    state.speed = rapid();
    program.push_move(to(last.tip + DVec3::Z * operation.clearance), state, link);
}

/// The machine that a path is written for, with the stock in front of it.
struct OnMachine<'a> {
    machine: &'a Machine,
    /// Work offset in the table frame.
    work: Rigid,
    /// The retraction along the machine's Z.
    retract: Move,
    /// Coolant while cutting.
    coolant: Coolant,
    /// The stock in coordinates of the work offset: corners of its box.
    corners: [DVec3; 8],
}

impl OnMachine<'_> {
    /// Distance by which the tool is withdrawn along its direction to clear the stock [mm].
    fn over(&self, point: &TurnedPoint) -> f64 {
        let highest = self.corners.iter().map(|c| c.dot(point.axis)).fold(f64::NEG_INFINITY, f64::max);
        (highest + ABOVE_STOCK - point.tip.dot(point.axis)).max(0.0)
    }
}

/// Appends a path on a machine with rotary axes. For each run the tool is retracted, the rotary axes are turned, the tool
/// goes to above the stock and down along its direction to the first point, along the points, and out again.
///
/// # Errors
/// Those of [`axis_positions`].
pub(super) fn write_turned(
    pen: &mut Pen<'_>,
    operation: &PathOperation,
    path: &TurnedPath,
    machine: &Machine,
) -> Result<()> {
    let clamping = pen.setting.clamping;
    let with = OnMachine {
        machine,
        work: clamping.work(),
        retract: pen.retract,
        coolant: operation.milling.coolant,
        corners: corners(&pen.setting.stock.bounds(), &clamping.to_work()),
    };
    let (program, state, origin) = (&mut *pen.program, &mut *pen.state, pen.origin);
    let link = Origin { role: Role::Link, ..origin };
    for run in &path.runs {
        let [Some(first), Some(last)] = [run.first(), run.last()] else { continue };
        state.speed = rapid();
        state.coolant = Coolant::Off;
        program.push_move(with.retract, state, link);
        let turn = Target::Joints(rotary_only(with.machine, &first.joints));
        program.push_move(Move { end: turn, path: Path::Line }, state, link);
        let above = TurnedPoint { tip: first.tip + first.axis * operation.clearance, ..*first };
        let behind = TurnedPoint { tip: last.tip + last.axis * operation.clearance, ..*last };
        state.tcp = match path.orientation {
            OrientationName::Vectors if path.in_plane => Tcp::Vector,
            OrientationName::Vectors | OrientationName::Angles => Tcp::Axes,
            OrientationName::Axes => Tcp::Off,
        };
        let length = operation.milling.tool.gauge_length.unwrap_or(0.0);
        let counted = |point: &TurnedPoint| -> Result<DVec3> {
            let [_, _, _, a, b, c] = rotary_only(with.machine, &point.joints).map(|q| q.unwrap_or(0.0));
            let tip = axis_positions(with.machine, length, [a, b, c], with.work.point(point.tip))?;
            Ok(with.work.inverse().point(tip))
        };
        let mut push = |point: &TurnedPoint, state: &State, origin: Origin| -> Result<()> {
            let end = match path.orientation {
                OrientationName::Vectors => {
                    Target::Tip { point: point.tip, axis: ToolAxis::Vector(point.axis) }
                }
                OrientationName::Angles => {
                    Target::Tip { point: point.tip, axis: rotary(with.machine, &point.joints) }
                }
                OrientationName::Axes => {
                    Target::Tip { point: counted(point)?, axis: rotary(with.machine, &point.joints) }
                }
            };
            program.push_move(Move { end, path: Path::Line }, state, origin);
            Ok(())
        };
        let out = |point: &TurnedPoint| TurnedPoint {
            tip: point.tip + point.axis * with.over(point).max(operation.clearance),
            ..*point
        };
        push(&out(first), state, link)?;
        push(&above, state, link)?;
        state.coolant = with.coolant;
        let mut before = above;
        for (i, point) in run.iter().enumerate() {
            state.speed = pace_of(point.pace, i == 0, operation);
            if let (OrientationName::Axes, Speed::PerMinute(feed)) = (path.orientation, state.speed) {
                // The feed is that of the tip along the work, which no sum of axis speeds tells.
                let way = (point.tip - before.tip).length();
                if point.joints[..] != before.joints[..] && way > 0.0 {
                    state.speed = Speed::Duration(way / feed);
                }
            }
            push(point, state, Origin { role: Role::Finish, ..origin })?;
            before = *point;
        }
        state.speed = rapid();
        push(&behind, state, link)?;
        push(&out(last), state, link)?;
        state.tcp = Tcp::Off;
    }
    Ok(())
}

/// The rotary axes of joint positions, by letter.
fn rotary_only(machine: &Machine, joints: &JointValues) -> [Option<f64>; 6] {
    let mut said = [None; 6];
    for (i, letter) in ['A', 'B', 'C'].into_iter().enumerate() {
        said[3 + i] = machine.joint(letter).and_then(|(place, _)| joints.get(place).copied());
    }
    said
}

fn rotary(machine: &Machine, joints: &JointValues) -> ToolAxis {
    let [_, _, _, a, b, c] = rotary_only(machine, joints);
    ToolAxis::Rotary([a, b, c])
}
