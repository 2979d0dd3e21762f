//! A moment of a move of a job's program: the program on the job's machine is followed, and the pose of the tool with its
//! derivative by arc length and the speed make the twist.

use glam::{DMat3, DVec3};

use super::MomentTable;
use super::given_motion::{GivenMotion, MotionSource};
use crate::base::{Code, Finding, Loader, Result};
use crate::geom::Rigid;
use crate::machine::Twist;
use crate::sweep::twist_of;
use crate::trace::{Segment, SegmentPace};
use crate::verbs::program_line::{ProgramLine, program_line};

/// Speed of a move whose own is not known [mm/s]: the curve does not depend on it.
const UNKNOWN_SPEED: f64 = 1.0;

pub(crate) fn moment(table: &MomentTable, with_tool: bool, loader: &dyn Loader) -> Result<GivenMotion> {
    let part = table.part.unwrap_or(0.5);
    if !(0.0..=1.0).contains(&part) {
        return Err(Finding::error(Code::JOB_VALUE, "the part of the way is not within the move")
            .value(part, "")
            .bound(1.0, "")
            .key("part")
            .into());
    }
    let line = program_line(&table.program_line(), Code::GRAZING_MOTION, loader)?;
    let (segment, t) = place(&line.segments, part);
    let (pose, twist) = twist(segment, t)?;
    let tool = if with_tool { line.tool(segment)? } else { None };
    let ProgramLine { program, block, .. } = line;
    let source = MotionSource::Moment { program, line: table.line, block, part, pose };
    Ok(GivenMotion { twist, source, tool })
}

/// The segment of a part of the way over several, and the part of its own way.
fn place(segments: &[Segment], part: f64) -> (&Segment, f64) {
    let lengths: Vec<f64> = segments.iter().map(|s| s.curve.length()).collect();
    let all: f64 = lengths.iter().sum();
    let mut left = part * all;
    for (segment, length) in segments.iter().zip(&lengths) {
        if left <= *length && *length > 0.0 {
            return (segment, left / length);
        }
        left -= length;
    }
    // Turning on the spot, or the end but for rounding.
    let last = &segments[segments.len() - 1];
    (last, if all > 0.0 { 1.0 } else { part })
}

/// The pose of the tool (X where the tip goes, seen across the axis) and its twist [mm/s, rad/s].
fn twist(segment: &Segment, t: f64) -> Result<(Rigid, Twist)> {
    let length = segment.curve.length();
    let pose = segment.pose(t * length);
    let (axis, velocity, turning) = if length > 0.0 {
        let speed = match (segment.motion, segment.duration) {
            (SegmentPace::Feed(feed), None) => feed,
            (_, Some(duration)) if duration > 0.0 => length / duration,
            _ => UNKNOWN_SPEED,
        };
        (pose.axis, pose.tip.d1 * speed, pose.turning * speed)
    } else {
        let (axis, rate) =
            segment.turning.as_ref().map_or((segment.axis, DVec3::ZERO), |turning| turning.axis(t));
        let time = segment.duration.filter(|d| *d > 0.0).unwrap_or(1.0);
        (axis, DVec3::ZERO, rate / time)
    };
    let ahead = velocity - axis * velocity.dot(axis);
    let helper = if axis.x.abs() < 0.9 { DVec3::X } else { DVec3::Y };
    let x = ahead
        .try_normalize()
        .or_else(|| turning.cross(axis).try_normalize())
        .or_else(|| (helper - axis * helper.dot(axis)).try_normalize())
        .unwrap_or(DVec3::X);
    let rotation = DMat3::from_cols(x, axis.cross(x), axis);
    let rate = DMat3::from_cols(
        turning.cross(rotation.x_axis),
        turning.cross(rotation.y_axis),
        turning.cross(rotation.z_axis),
    );
    let pose = Rigid { rotation, translation: pose.tip.p };
    Ok((pose, twist_of(&pose, rate, velocity)?))
}
