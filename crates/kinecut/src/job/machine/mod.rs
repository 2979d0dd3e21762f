//! Machines in files of their own: read with places, written so that reading gives the same machine, told in words.

mod write;

pub use write::machine_toml;

use super::check::machine::machine;
use super::read::read_machine;
use crate::base::{Code, Finding, Result, Sources};
use crate::machine::Machine;

/// Reads a machine file.
///
/// ```
/// use kinecut::job::machine::read;
/// let text = "code = \"641203\"\ntravel = { A = [-100, 50] }\n[axis.A]\npoint = [0, 20, 10]\n";
/// let machine = read("trunnion.toml", text).unwrap();
/// assert_eq!(machine.travel('A').unwrap()[1], 50f64.to_radians());
/// let error = read("trunnion.toml", &text.replace("50]", "-150]")).unwrap_err();
/// assert_eq!(error.0.place.unwrap().line, 2);
/// ```
///
/// # Errors
/// `KC0101` and `KC0102` for a text that is no machine file; `KC0702` for its code, `KC0703` for an axis, `KC0103` for
/// another number; each with its place in the text.
pub fn read(name: &str, text: &str) -> Result<Machine> {
    let mut sources = Sources::default();
    let id = sources.add(name, text);
    read_machine(&sources, id, machine)
}

/// A machine that kinecut knows.
///
/// # Errors
/// `KC0104` for another name.
pub fn preset(name: &str) -> Result<Machine> {
    Err(Finding::error(Code::JOB_REFERENCE, format!("there is no machine `{name}`")).into())
}
