//! Tool changes of a program, and changes of the spindle's speed.

use super::program_time::Changes;
use crate::machine::MotionControl;
use crate::program::{Item, Program};

/// A change for which the path waits.
#[derive(Clone, Copy)]
pub(super) enum Change {
    /// Of the tool.
    Tool,
    /// Of the spindle's speed by this much [rad/s].
    Spindle(f64),
}

impl Change {
    /// Its time [s], where the machine states it.
    pub(super) fn time(self, control: &MotionControl) -> Option<f64> {
        match self {
            Change::Tool => control.tool_change,
            Change::Spindle(step) => {
                control.spindle_ramp.zip(control.max_speed).map(|(ramp, most)| ramp * step / most)
            }
        }
    }
}

/// Tool changes, and changes of the spindle's speed that a move waits for, each at its item.
pub(super) fn each_change(program: &Program) -> Vec<(u32, Change)> {
    let (mut tool, mut rate) = (None, 0.0);
    let mut found = Vec::new();
    for i in 0..program.items.len() {
        match program.items.get(i) {
            Item::Tool { id, .. } if tool != Some(id) => {
                tool = Some(id);
                found.push((i as u32, Change::Tool));
            }
            Item::Move(_) | Item::Cycle(..) => {
                let next = program.state(i).spindle.signed_rate();
                if next != rate {
                    found.push((i as u32, Change::Spindle((next - rate).abs())));
                    rate = next;
                }
            }
            _ => {}
        }
    }
    found
}

/// Tool changes together, and changes of the spindle's speed.
pub(super) fn changes(program: &Program, control: &MotionControl) -> [Changes; 2] {
    let found = each_change(program);
    let all = |is_one: fn(&Change) -> bool, none: Change| {
        let of = found.iter().map(|(_, change)| change).filter(|change| is_one(change));
        let sum = of.clone().try_fold(0.0, |sum, change| Some(sum + change.time(control)?));
        // Where nothing changes, too, the machine states a time or does not.
        Changes { count: of.count(), time: none.time(control).and(sum) }
    };
    [
        all(|change| matches!(change, Change::Tool), Change::Tool),
        all(|change| matches!(change, Change::Spindle(_)), Change::Spindle(0.0)),
    ]
}
