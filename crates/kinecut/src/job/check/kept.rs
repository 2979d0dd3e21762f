//! Files in which the machine of a program keeps its offsets: the tool table and the parameters of LinuxCNC.

use super::super::file::ProgramTable;
use super::super::{Subject, sha256};
use super::program::program_text;
use crate::base::{Code, FileKind, Finding, Loader, Result, Sources};
use crate::nc::{Control, Kept, parameters, tool_table};

/// What the machine keeps, and the files that tell it.
pub(super) fn kept(t: &ProgramTable, control: Control, loader: &dyn Loader) -> Result<(Kept, Vec<Subject>)> {
    let (mut kept, mut subjects) = (Kept::default(), Vec::new());
    let unit = if t.machine_in_inches { 25.4 } else { 1.0 };
    let mut sources = Sources::default();
    for (key, role, name) in
        [("tool_table", "tool table", &t.tool_table), ("parameters", "parameters", &t.parameters)]
    {
        let Some(name) = name else { continue };
        if control != Control::LinuxCnc {
            let finding = Finding::error(Code::JOB_VALUE, format!("`{name}` is a file of LinuxCNC"));
            let help = format!("give the values of {} by registers and start", control.title());
            return Err(finding.key(key).help(help).into());
        }
        let bytes = loader.lend_as(name, FileKind::Program).map_err(|e| e.under(key))?;
        let file = sources.add(name, program_text(&bytes).0);
        subjects.push(Subject { role: role.to_owned(), file: Some(name.clone()), sha256: sha256(&bytes) });
        match key {
            "tool_table" => kept.tools = Some(tool_table(&sources, file, unit)?),
            _ => kept.parameters = Some(parameters(&sources, file, unit)?),
        }
    }
    if t.machine_in_inches && subjects.is_empty() {
        let finding = Finding::error(Code::JOB_VALUE, "no file of the machine has lengths in inches");
        let help = "give its tool table or its parameters, or leave it out: a program says its own units";
        return Err(finding.key("machine_in_inches").help(help).into());
    }
    Ok((kept, subjects))
}
