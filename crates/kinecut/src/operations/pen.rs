//! The pen that the moves of an operation are written with: the program of its setup, and its present state.

use std::collections::BTreeMap;

use super::Setting;
use crate::geom::Curve;
use crate::motion::feed_parts;
use crate::program::{Coolant, Move, Origin, Program, Role, Speed, Spindle, State, StopKind};

/// The program of a setup where an operation begins: the tool is in the spindle, the plane is chosen, the name is written.
pub(crate) struct Pen<'a> {
    /// The program.
    pub(crate) program: &'a mut Program,
    /// The state of the next item.
    pub(crate) state: &'a mut State,
    /// The operation.
    pub(crate) origin: Origin,
    /// The retraction along the machine's Z.
    pub(crate) retract: Move,
    /// Items with a lower feed than the job asks for, with the asked one [mm/s].
    pub(crate) lowered: &'a mut BTreeMap<u32, f64>,
    /// The surroundings in which the operation was planned.
    pub(crate) setting: Setting<'a>,
}

impl Pen<'_> {
    /// A comment.
    pub(crate) fn text(&mut self, text: impl Into<String>) {
        self.program.push_text(text, self.state, self.origin);
    }

    /// A move along a curve at a speed.
    pub(crate) fn along(&mut self, curve: &Curve, speed: Speed, role: Role) {
        self.state.speed = speed;
        self.push(curve, Origin { role, ..self.origin });
    }

    /// A move along a curve in the present state; in parts where the axes cannot hold its feed all along, and feeds are to
    /// keep within their limits.
    pub(crate) fn push(&mut self, curve: &Curve, origin: Origin) {
        let (Some(limit), Speed::PerMinute(asked)) = (&self.setting.feed_limit, self.state.speed) else {
            self.program.push_move(Move::along(curve), self.state, origin);
            return;
        };
        for part in feed_parts(curve, asked, limit) {
            if part.feed < asked {
                self.lowered.insert(self.program.items.len() as u32, asked);
            }
            let state = State { speed: Speed::PerMinute(part.feed), ..*self.state };
            self.program.push_move(Move::along(&part.curve), &state, origin);
        }
    }

    /// Stops for a person who reaches under the tool: retracted, spindle and coolant off, and the spindle on again after it.
    pub(crate) fn stop_for(&mut self, what: &str) {
        let running = self.state.spindle;
        (self.state.spindle, self.state.coolant) = (Spindle::Off, Coolant::Off);
        self.state.speed = Speed::Rapid { linear: true };
        self.program.push_move(self.retract, self.state, self.origin);
        self.text(what);
        self.program.push_stop(StopKind::Program, self.state, self.origin);
        self.state.spindle = running;
    }
}
