//! The parts of a job that a verdict is about, with their hashes.

use serde::Serialize;

use super::file::{JobFile, MachineEntry, StockTable};
use super::{JobProgram, Subject, json_text, sha256, subprograms};
use crate::base::{FileKind, Loader, Result};
use crate::nc::Control;

/// Tools, machine, stock, setups and design as subjects of a verdict: the hash of their canonical JSON (and of the
/// bytes of the meshes and drawings they name).
///
/// # Errors
/// Those of the loader, for meshes and drawings.
pub fn parts(file: &JobFile, loader: &dyn Loader) -> Result<Vec<Subject>> {
    let part = |role: &str, json: String| Subject {
        role: role.to_owned(),
        file: None,
        sha256: sha256(json.as_bytes()),
    };
    let bytes = |role: &str, name: &str| -> Result<Subject> {
        Ok(Subject {
            role: role.to_owned(),
            file: Some(name.to_owned()),
            sha256: sha256(&loader.read(name)?),
        })
    };
    let mut parts = vec![
        part("tools", canonical(&(&file.tools, &file.holders))),
        part("machine", canonical(&file.machine)),
        part("stock", canonical(&(&file.stock, &file.drilled))),
        part("setups", canonical(&file.setups)),
        part("design", canonical(&file.design)),
    ];
    for name in &file.tool_files {
        parts.push(bytes("tools", name)?);
    }
    if let Some(name) = &file.cutting {
        parts.push(bytes("cutting data", name)?);
    }
    if let StockTable::Mesh(name) = &file.stock {
        parts.push(bytes("stock", name)?);
    }
    if let Some(design) = &file.design {
        parts.push(bytes("design", &design.mesh)?);
    }
    for program in file.setups.iter().filter_map(|s| s.program.as_ref()) {
        parts.push(bytes("external program", &program.file)?);
        for (role, name) in [("tool table", &program.tool_table), ("parameters", &program.parameters)] {
            if let Some(name) = name {
                parts.push(bytes(role, name)?);
            }
        }
        let control = Control::parse(program.control.as_deref().unwrap_or(&file.post.control))?;
        let text =
            JobProgram::new(&*program.file, &loader.read_as(&program.file, FileKind::Program)?, control).text;
        for called in subprograms(&program.file, &text, control, &program.subprograms, loader) {
            let subject = bytes("external program", &called.file)?;
            if !parts.contains(&subject) {
                parts.push(subject);
            }
        }
    }
    if let Some(MachineEntry::Table(machine)) = &file.machine {
        for name in machine.bodies.iter().filter_map(|body| body.mesh.as_ref()) {
            let subject = bytes("machine", name)?;
            if !parts.contains(&subject) {
                parts.push(subject);
            }
        }
    }
    for operation in file.setups.iter().flat_map(|s| &s.operations) {
        if let Some((role, name)) = operation.file() {
            let subject = bytes(role, name)?;
            if !parts.contains(&subject) {
                parts.push(subject);
            }
        }
    }
    Ok(parts)
}

fn canonical(value: &impl Serialize) -> String {
    json_text(value)
}
