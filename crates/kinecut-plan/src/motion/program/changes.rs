//! Tool changes of a program, and changes of the spindle's speed.

use super::program_time::Changes;
use crate::machine::MotionControl;
use crate::program::{Item, Program};

/// Tool changes, and changes of the spindle's speed that a move waits for.
pub(super) fn changes(program: &Program, control: &MotionControl) -> [Changes; 2] {
    let (mut tool, mut rate) = (None, 0.0);
    let (mut tools, mut ramps, mut ramped) = (0, 0, 0.0);
    for i in 0..program.items.len() {
        match program.items.get(i) {
            Item::Tool { id, .. } if tool != Some(id) => {
                tools += 1;
                tool = Some(id);
            }
            Item::Move(_) | Item::Cycle(..) => {
                let next = program.state(i).spindle.signed_rate();
                if next != rate {
                    ramps += 1;
                    ramped += (next - rate).abs();
                    rate = next;
                }
            }
            _ => {}
        }
    }
    let of_speed = control.spindle_ramp.zip(control.max_speed).map(|(ramp, most)| ramp * ramped / most);
    [
        Changes { count: tools, time: control.tool_change.map(|time| time * tools as f64) },
        Changes { count: ramps, time: of_speed },
    ]
}
