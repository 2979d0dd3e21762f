//! A tool path as moves of a program.

use glam::DVec3;

use super::super::check::PathOperation;
use super::Pace;
use crate::program::{Coolant, Move, Origin, Path, Program, Role, Speed, State, Target, Tcp, ToolAxis};

/// Appends a path: from above the first point along the tool down to it, along all points, and back up along the tool.
/// The rotary axes are turned by a move of their own before it, where the tool stands retracted.
pub(in crate::job) fn push_path(
    program: &mut Program,
    state: &mut State,
    operation: &PathOperation,
    coolant: Coolant,
    origin: Origin,
) {
    let multi_axis = operation.is_multi_axis();
    let mut axis = DVec3::Z;
    let mut last = None;
    for point in &operation.points {
        axis = point.axis.unwrap_or(axis);
        let said = if multi_axis { ToolAxis::Vector(axis) } else { ToolAxis::Fixed };
        let to = |tip: DVec3| Move { end: Target::Tip { point: tip, axis: said }, path: Path::Line };
        if last.is_none() {
            let above = point.tip + axis * operation.clearance;
            state.speed = Speed::Rapid { linear: true };
            if multi_axis {
                state.tcp = Tcp::Vector;
            } else {
                let over = DVec3::new(above.x, above.y, f64::NAN);
                let end = Target::Tip { point: over, axis: ToolAxis::Fixed };
                program.push_move(Move { end, path: Path::Line }, state, Origin { role: Role::Link, ..origin });
            }
            program.push_move(to(above), state, Origin { role: Role::Link, ..origin });
            state.coolant = coolant;
        }
        let pace = if last.is_none() && point.pace == Pace::Rapid { Pace::OfOperation } else { point.pace };
        state.speed = match pace {
            Pace::Rapid => Speed::Rapid { linear: true },
            Pace::Feed(feed) => Speed::PerMinute(feed),
            Pace::OfOperation => Speed::PerMinute(operation.feed),
        };
        program.push_move(to(point.tip), state, Origin { role: Role::Finish, ..origin });
        last = Some(point.tip);
    }
    if let Some(tip) = last {
        let said = if multi_axis { ToolAxis::Vector(axis) } else { ToolAxis::Fixed };
        state.speed = Speed::Rapid { linear: true };
        let end = Target::Tip { point: tip + axis * operation.clearance, axis: said };
        program.push_move(Move { end, path: Path::Line }, state, Origin { role: Role::Link, ..origin });
    }
    state.tcp = Tcp::Off;
}
