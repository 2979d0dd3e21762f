//! Keys of the job file that have a new name: they are read as before, and a note tells the new one.

use crate::base::{Code, Finding};

/// End of a key with its old name, and the new name of its last part.
const RENAMED: &[(&str, &str)] = &[
    (".rough.step", "stepover"),
    (".axial_step", "stepdown"),
    (".leave", "stock_to_leave"),
    (".leave_floor", "stock_to_leave_floor"),
];

/// The new name of the last part of a key, if that is an old one.
fn new_name(key: &str) -> Option<&'static str> {
    let operation = key.contains("operation");
    RENAMED.iter().find(|(old, _)| operation && key.ends_with(old)).map(|(_, new)| *new)
}

/// The key under its old name, if it has one.
pub(super) fn old_key(key: &str) -> Option<String> {
    let (above, last) = key.rsplit_once('.')?;
    Some(format!("{above}.{}", old_name(last)?))
}

/// The old name of a key of an operation, if it has one.
pub(super) fn old_name(new: &str) -> Option<&'static str> {
    let (old, _) = RENAMED.iter().find(|(_, of)| *of == new)?;
    old.rsplit('.').next()
}

/// A message that lists the keys of a table, without the old names of those that it lists by their new ones.
pub(super) fn without_old_names(message: &str) -> String {
    let mut message = message.to_owned();
    for (old, new) in RENAMED {
        let old = old.rsplit('.').next().unwrap_or(old);
        if message.contains(&format!("`{new}`")) {
            message =
                message.replace(&format!(", `{old}`"), "").replace(&format!("one of `{old}`, "), "one of ");
        }
    }
    message
}

/// A note about a key that has a new name.
pub(super) fn note(key: &str) -> Option<Finding> {
    let new = new_name(key)?;
    let old = key.rsplit('.').next().unwrap_or(key);
    let finding = Finding::note(Code::KEY_RENAMED, format!("`{old}` is now called `{new}`"));
    Some(finding.key(key).help(format!("write `{new}`")))
}
