//! The pocket before another in its setup, of which that one clears only what the larger cutter has left.

use super::PocketTable;
use crate::base::{Code, Finding, Result};
use crate::clearing::EarlierCutter;
use crate::operations::outlines::outline_keys;
use crate::operations::{Around, OperationTable, tool_of};
use crate::tool::{Cutter, Tool};

/// Height that is rounding [mm].
const ROUNDING: f64 = 1e-6;

/// A pocket that a larger cutter has cleared.
#[derive(Clone, Copy, Debug)]
pub(super) struct EarlierPocket<'a> {
    /// Its table.
    table: &'a PocketTable,
    /// The table that says the outline: its own, or that of a pocket before it, of which it has cleared the rest.
    pub(super) outline: &'a PocketTable,
}

impl<'a> EarlierPocket<'a> {
    /// The pocket of a name among the operations before another.
    ///
    /// # Errors
    /// `KC0104` with the key `rest` where none has the name, or more than one.
    pub(super) fn find(name: &str, before: &'a [OperationTable]) -> Result<EarlierPocket<'a>> {
        let of_name = |(i, operation): (usize, &'a OperationTable)| match operation {
            OperationTable::Pocket(t) if t.name.as_deref() == Some(name) => Some((i, &**t)),
            _ => None,
        };
        let mut found = before.iter().enumerate().filter_map(of_name);
        let (i, table) = match (found.next(), found.next()) {
            (Some(found), None) => found,
            (Some(_), Some(_)) => {
                let what = format!("two pockets before it have the name `{name}`");
                let finding = Finding::error(Code::JOB_REFERENCE, what).help("give each a name of its own");
                return Err(finding.key("rest").into());
            }
            (None, _) => {
                let what = format!("no pocket before it in the setup has the name `{name}`");
                let help = format!("give the pocket of the larger cutter a name: name = \"{name}\"");
                return Err(Finding::error(Code::JOB_REFERENCE, what).help(help).key("rest").into());
            }
        };
        let outline = match &table.rest {
            Some(name) => EarlierPocket::find(name, &before[..i])?.outline,
            None => table,
        };
        Ok(EarlierPocket { table, outline })
    }

    /// Its cutter for the planner of a pocket after it with a tool.
    ///
    /// # Errors
    /// `KC0104` with the key of the table after it where that one has an outline of its own, lies in another plane, goes higher or
    /// deeper, or has no smaller cutter.
    pub(super) fn cutter(&self, of: &PocketTable, tool: &Tool, around: &Around<'_>) -> Result<EarlierCutter> {
        let t = self.table;
        let name = t.name.as_deref().unwrap_or_default();
        let refused = |key: &str, what: String, help: String| {
            Finding::error(Code::JOB_REFERENCE, what).help(help).key(key)
        };
        if !outline_keys!(of).is_empty() {
            let what =
                format!("`rest` takes the outline of the pocket `{name}`: no other is given beside it");
            return Err(refused("rest", what, "leave the outline out".to_owned()).into());
        }
        if of.plane != t.plane {
            let what = format!("the pocket `{name}` lies in another plane");
            return Err(refused("plane", what, "write the plane of that pocket".to_owned()).into());
        }
        if of.top > t.top + ROUNDING {
            let what = format!("the pocket `{name}` begins lower: what is over it is not cleared");
            let help = format!("write top = {}", t.top);
            return Err(refused("top", what, help).value_mm(of.top).bound_mm(t.top).into());
        }
        let [bottom, deepest] = [of, t].map(|t| t.top - t.depth - t.breakthrough);
        if bottom < deepest - ROUNDING {
            let what = format!("the pocket `{name}` is less deep: below it nothing is cleared");
            let help = format!("go no lower than Z {}", crate::page::trimmed(deepest, 3));
            return Err(refused("depth", what, help).value_mm(bottom).bound_mm(deepest).into());
        }
        let before = tool_of(&t.tool, around.tools)?;
        let (diameter, corner) = match before.cutter {
            Cutter::BullNose { diameter, corner_radius } => (diameter, corner_radius),
            ref other => (other.diameter(before.flute_length), 0.0),
        };
        let own = tool.cutter.diameter(tool.flute_length);
        if own >= diameter {
            let what = format!(
                "the cutter is not smaller than that of the pocket `{name}`: {} there",
                before.number
            );
            let help = "take a smaller cutter, or leave the operation out".to_owned();
            return Err(refused("tool", what, help).value_mm(own).bound_mm(diameter).into());
        }
        // A register that leaves stock does so for operations after it.
        let worn = t.finish.as_ref().and_then(|f| f.wear_value).unwrap_or(0.0).max(0.0);
        Ok(EarlierCutter { radius: 0.5 * diameter, corner, allowance: t.stock_to_leave + worn })
    }
}
