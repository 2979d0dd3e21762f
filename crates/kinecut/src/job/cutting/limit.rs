//! Speeds that an operation was given, within the limits of its tool and its machine.

use std::f64::consts::TAU;

use super::taken::{SpeedLimit, TakenData};
use crate::base::Result;
use crate::cutting::StartChange;
use crate::machine::Machine;
use crate::operations::{Operation, OperationTable};

/// Checks an operation, with its speed lowered to what tool and machine allow where that speed was given to it: one of its own stays
/// as it is, and is an error later.
pub(in crate::job) fn within_limit(
    table: &OperationTable,
    check: &dyn Fn(&OperationTable) -> Result<Operation>,
    machine: Option<&Machine>,
    taken: Option<&mut TakenData>,
) -> Result<Operation> {
    let operation = check(table)?;
    let milling = operation.milling();
    let Some((taken, speed)) = taken.and_then(|t| t.speed.clone().map(|speed| (t, speed))) else {
        return Ok(operation);
    };
    let of_machine = machine.and_then(|m| m.control.max_speed).map(|limit| (limit, false));
    let of_tool = milling.tool.limits.max_speed.map(|limit| (limit, true));
    let limits = of_machine.into_iter().chain(of_tool);
    let Some((limit, of_tool)) = limits.min_by(|a, b| a.0.total_cmp(&b.0)) else { return Ok(operation) };
    if milling.spindle <= limit * (1.0 + 1e-9) {
        return Ok(operation);
    }
    let per_minute = |rate: f64| rate * 60.0 / TAU;
    // Whole turns, never more than allowed; a rounded limit is itself.
    let lowered = (per_minute(limit) + 1e-6).floor();
    let cutting_speed = match speed.key {
        "cutting_speed" => Some(speed.value * lowered / per_minute(milling.spindle)),
        _ => None,
    };
    taken.limited =
        Some(SpeedLimit { wanted: per_minute(milling.spindle), limit: lowered, cutting_speed, of_tool });
    let share = lowered / per_minute(milling.spindle);
    let mut slower = table.clone();
    if let Some(keys) = slower.data() {
        *keys.cutting_speed = None;
        *keys.speed = Some(lowered);
        // A feed in a minute that was given beside the speed falls with it: the chip stays.
        if let (Some(own), Some(feed)) = (keys.feed, taken.feed.as_mut().filter(|feed| feed.key == "feed")) {
            feed.value *= share;
            feed.changes.push(StartChange { what: "lower speed", factor: share });
            *own.feed = Some(feed.value);
        }
    }
    check(&slower)
}
