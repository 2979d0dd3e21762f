//! Notes about cutting data that operations were given.

use super::taken::{DataOrigin, TakenData, TakenNumber};
use crate::base::{Code, Finding};
use crate::page::trimmed;

/// A note for each tool and each origin of its data, at the first operation that takes them; one for each speed that was lowered.
pub(in crate::job) fn notes(all: &[TakenData], machine_has_limit: bool) -> Vec<Finding> {
    let mut notes: Vec<Finding> = Vec::new();
    for taken in all {
        let key = format!("setup[{}].operation[{}]", taken.operation.0, taken.operation.1);
        let mut add = |message: String, help: Option<&str>| {
            if notes.iter().all(|note| note.message != message) {
                let note = Finding::note(Code::TOOL_CHOSEN, message).key(&*key);
                // The same help once is enough.
                notes.push(match help.filter(|help| notes.iter().all(|note| note.help != *help)) {
                    Some(help) => note.help(help),
                    None => note,
                });
            }
        };
        let numbers = || taken.numbers();
        let of_preset = || numbers().filter(|n| matches!(n.origin, DataOrigin::Preset { .. }));
        if let Some(DataOrigin::Preset { material, file }) = of_preset().next().map(|n| &n.origin) {
            let words: Vec<String> = of_preset().map(TakenNumber::to_string).collect();
            let of = file.as_ref().map(|file| format!(" of `{file}`")).unwrap_or_default();
            add(format!("{} from the preset {material} of T{}{of}", words.join(", "), taken.tool), None);
        }
        for number in numbers() {
            if let DataOrigin::Table { file, line } = &number.origin {
                add(format!("{number} of T{} from line {line} of `{file}`", taken.tool), None);
            }
        }
        let of_start = || numbers().filter(|n| matches!(n.origin, DataOrigin::Start { .. }));
        if let Some(DataOrigin::Start { row, assumed }) = of_start().next().map(|n| &n.origin) {
            let words = of_start().map(|n| match n.way() {
                Some(way) => format!("{n} ({way})"),
                None => n.to_string(),
            });
            let words: Vec<String> = words.collect();
            let taken_as = assumed.map(|edge| format!("; T{} is taken as {edge}", taken.tool));
            let has_limit = machine_has_limit || taken.limited.is_some();
            let open = if has_limit || taken.speed.is_none() {
                ""
            } else {
                "; the largest speed of the machine is not known"
            };
            let message = format!(
                "T{} has {} to start with, no recommendation: {row}{}{open}",
                taken.tool,
                words.join(", "),
                taken_as.unwrap_or_default()
            );
            let help = "give the shop's own in the operation, or as [[tool.preset]]; `material` of a tool says \"carbide\" or \"hss\"";
            add(message, Some(help));
        }
        if let Some(limited) = taken.limited {
            let of = if limited.of_tool { format!("T{}", taken.tool) } else { "the machine".to_owned() };
            let slower = match (limited.cutting_speed, &taken.speed) {
                (Some(v), Some(wanted)) => format!(
                    ": the cutting speed falls from {} to {} m/min",
                    trimmed(wanted.value, 1),
                    trimmed(v, 1)
                ),
                _ => String::new(),
            };
            add(
                format!(
                    "T{} would turn at {:.0} rev/min, and {of} has {:.0}{slower}",
                    taken.tool, limited.wanted, limited.limit
                ),
                None,
            );
        }
    }
    notes
}
