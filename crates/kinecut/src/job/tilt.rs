//! Tilted planes of a setup's program: their frames, and the moves that turn the rotary axes.

use glam::{DMat3, DVec3};

use super::check::{Job, JobSetup};
use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;
use crate::machine::Machine;
use crate::operations::{JobPlane, Milling, OrientationName};
use crate::program::{Coolant, Frame, FrameId, Move, Origin, Path, Program, Speed, State, Target};
use crate::trace::{axis_frame, rotary_positions};

/// The frame of a tilted plane, and what turns the rotary axes to it.
pub(super) fn tilted(
    job: &Job,
    setup: &JobSetup,
    milling: &Milling,
    plane: &JobPlane,
    machine: &Machine,
) -> Result<(Frame, Target)> {
    // The planner adds the frame of the work offset first.
    let parent = FrameId(0);
    let work = setup.work();
    let axis = work.vector(plane.motion.vector(DVec3::Z));
    let [a, b, c] = rotary_positions(machine, axis, [0.0; 3], plane.branch).map_err(|e| e.under("plane"))?;
    if job.orientation != OrientationName::Axes {
        return Ok((Frame::Tilted { parent, motion: plane.motion, branch: plane.branch }, Target::Orient));
    }
    if !setup.setup.located {
        return Err(Finding::error(
            Code::JOB_REFERENCE,
            "axis positions in a tilted plane need the `position` of the setup on the machine",
        )
        .help("give it, or use a control that has tilted planes")
        .key("plane")
        .into());
    }
    let counted = axis_frame(machine, milling.tool.gauge_length, [a, b, c])?;
    let motion = work.inverse().after(&counted).after(&work).after(&plane.motion);
    let has = |letter: char, angle: f64| machine.joint(letter).map(|_| angle);
    let turn = Target::Joints([None, None, None, has('A', a), has('B', b), has('C', c)]);
    Ok((Frame::Shift { parent, motion: upright(motion) }, turn))
}

/// A motion that turns about Z but for rounding, without the rounding.
fn upright(motion: Rigid) -> Rigid {
    let x = motion.rotation.x_axis;
    Rigid { rotation: DMat3::from_rotation_z(x.y.atan2(x.x)), ..motion }
}

/// All rotary axes at zero.
pub(super) fn all_zero(machine: Option<&Machine>) -> Target {
    let zero = |letter| machine.and_then(|m| m.joint(letter)).map(|_| 0.0);
    Target::Joints([None, None, None, zero('A'), zero('B'), zero('C')])
}

/// Goes over to another plane: retracts along the machine's Z and turns the rotary axes.
pub(super) fn tilt(
    program: &mut Program,
    state: &mut State,
    to: FrameId,
    (retract, turn): (Move, Target),
    origin: Origin,
) {
    state.speed = Speed::Rapid { linear: true };
    // Cutting fluid would hit a turning table.
    state.coolant = Coolant::Off;
    program.push_move(retract, state, origin);
    state.frame = to;
    program.push_move(Move { end: turn, path: Path::Line }, state, origin);
}
