//! Machines in files of their own: read with places, written so that reading gives the same machine, and described.

pub(crate) mod write;

pub use write::machine_toml;

use super::check::machine::machine;
use super::read::read_table;
use crate::base::{Code, Loader, Location, MemoryLoader, Result, Sources};
use crate::machine::linuxcnc::{self, Import};
use crate::machine::{CoordinateCode, Machine, presets};

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
    read_with(name, text, &MemoryLoader::default())
}

/// Reads a machine file whose bodies may be meshes: files that `loader` reads.
///
/// # Errors
/// Those of [`read()`]; `KC0705` for a body, those of the loader and of [`crate::geom::read_stl`] for its mesh.
pub fn read_with(name: &str, text: &str, loader: &dyn Loader) -> Result<Machine> {
    let mut sources = Sources::default();
    let id = sources.add(name, text);
    read_table(&sources, id, |table| machine(table, loader))
}

/// A machine with how it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The machine.
    pub machine: Machine,
    /// Result of importing a configuration of LinuxCNC.
    pub import: Option<Import>,
}

/// Options of loading a machine, given with its name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadOptions {
    /// HAL files other than those that the INI file names, for LinuxCNC.
    pub hal: Vec<String>,
    /// Coordinate code, for a configuration of LinuxCNC that does not tell it.
    pub code: Option<String>,
}

/// Refuses an imported machine that, written as a machine file, would be refused.
fn keeps_to_the_file(machine: &Machine, shown: &str) -> Result<()> {
    read(shown, &machine_toml(machine)).map(|_| ()).map_err(|e| {
        let mut finding = *e.0;
        // The place is in the file that would be written; the key says what of the configuration is meant.
        finding.place = Some(Location::whole_file(shown));
        finding.help =
            "correct it in the configuration: MIN_LIMIT, MAX_LIMIT, MAX_VELOCITY, MAX_ACCELERATION"
                .to_owned();
        finding.into()
    })
}

/// The machine of a name: that of a machine file, an INI file of LinuxCNC (a name that ends in `.ini`, its HAL files
/// beside it), or a machine that kinecut knows. `shown` is the name in messages.
///
/// # Errors
/// Those of the loader, of [`read()`], [`Machine::preset`] and of [`linuxcnc::import`].
pub fn load(name: &str, shown: &str, options: &LoadOptions, loader: &dyn Loader) -> Result<Loaded> {
    let known = presets().iter().find(|preset| preset.name == name);
    if let Some(preset) = known {
        return Ok(Loaded { machine: preset.machine()?, import: None });
    }
    let text = loader.read_text(name).map_err(|mut e| {
        if !name.contains('.') && e.code() == Code::FILE_NOT_READ {
            return Machine::preset(name).err().unwrap_or(e);
        }
        e.0.place = Some(Location::whole_file(shown));
        e
    })?;
    if !name.to_ascii_lowercase().ends_with(".ini") {
        return read_with(shown, &text, loader).map(|machine| Loaded { machine, import: None });
    }
    let mut names = linuxcnc::hal_files(&text);
    // A file that the configuration names may be made at run time or lie elsewhere; the user's own must be there.
    names.retain(|file| loader.read(file).is_ok() && !options.hal.contains(file));
    names.extend(options.hal.iter().cloned());
    let texts: Vec<String> = names.iter().map(|file| loader.read_text(file)).collect::<Result<_>>()?;
    let hal: Vec<(&str, &str)> = names.iter().zip(&texts).map(|(n, t)| (n.as_str(), t.as_str())).collect();
    let code = options.code.as_deref().map(CoordinateCode::parse_any).transpose()?;
    let import = linuxcnc::import((shown, &text), &hal, code.as_ref())?;
    keeps_to_the_file(&import.machine, shown)?;
    Ok(Loaded { machine: import.machine.clone(), import: Some(import) })
}
