//! Travel limits.

use glam::DVec3;

use super::Trace;
use crate::base::{Code, Finding};
use crate::geom::Aabb;
use crate::machine::Machine;
use crate::program::Program;

/// Axis positions beyond the travel of the machine: one finding for each setup and axis, with the item that goes
/// farthest in its key. In a setup that is not located on the machine only the span of the positions is compared
/// with the length of the travel.
pub fn travel_findings(trace: &Trace, program: &Program, machine: &Machine) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (number, setup) in program.setups.iter().enumerate() {
        let boxes: Vec<(u32, Aabb)> = trace
            .segments
            .iter()
            .filter(|s| s.setup.0 as usize == number)
            .map(|s| (s.item, s.axis_path().bounds()))
            .collect();
        let Some(first) = boxes.first() else { continue };
        for (i, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
            let Some([min, max]) = machine.travel(letter) else { continue };
            let low = boxes.iter().fold(*first, |a, b| if b.1.min[i] < a.1.min[i] { *b } else { a });
            let high = boxes.iter().fold(*first, |a, b| if b.1.max[i] > a.1.max[i] { *b } else { a });
            let finding = |what: &str, value: f64, bound: f64, item: u32, at: DVec3| {
                Finding::error(Code::TRAVEL_EXCEEDED, format!("{letter} {what}"))
                    .value_mm(value)
                    .bound_mm(bound)
                    .key(format!("item[{item}]"))
                    .point(setup.part_on_table.inverse().point(at).to_array())
                    .cure("move the part on the table, or use another machine")
            };
            if !setup.located {
                let span = high.1.max[i] - low.1.min[i];
                if span > max - min {
                    findings.push(finding(
                        "needs more travel than the machine has",
                        span,
                        max - min,
                        high.0,
                        high.1.max,
                    ));
                }
                continue;
            }
            if low.1.min[i] < min {
                findings.push(finding("leaves its travel", low.1.min[i], min, low.0, low.1.min));
            }
            if high.1.max[i] > max {
                findings.push(finding("leaves its travel", high.1.max[i], max, high.0, high.1.max));
            }
        }
    }
    findings
}
