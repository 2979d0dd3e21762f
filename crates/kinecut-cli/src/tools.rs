//! The verb `tools`: tool files shown and converted.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use kinecut::base::{DiskLoader, Error};
use kinecut::job::file::ToolFileTable;
use kinecut::verbs::tools::{ToolsTo, convert_tools, read_tools, tools_sheet};

use crate::answers::{Data, To, answer};
use crate::files;
use crate::printing::Printing;

#[derive(Debug, clap::Args)]
pub(crate) struct Tools {
    /// A tool file: TOML with [[tool]], a tool table of LinuxCNC (.tbl), Fusion .json or .tools, FreeCAD .fctb or .fctl
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Write the tools in this format instead: on standard output, or into the file of --out
    #[arg(long, value_enum, conflicts_with = "json")]
    to: Option<Format>,
    /// File for the tools; its ending is their format, if --to is not given
    #[arg(long, value_name = "FILE", conflicts_with = "json")]
    out: Option<PathBuf>,
    /// The lengths of the tool table of LinuxCNC are in inches; other files say their units
    #[arg(long)]
    inches: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// TOML of kinecut
    Toml,
    /// The same tables in JSON
    Json,
    /// A tool table of LinuxCNC, lengths in mm
    Tbl,
}

impl Tools {
    /// Shows a tool file, or converts it.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let (loader, name) = self.place();
        let wants = ToolFileTable { file: name, inches: self.inches, number: None };
        let library = read_tools(&wants, &loader)?;
        let ending = |path: &Path| path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        let by_name = self.out.as_deref().and_then(ending).map(|ending| match ending.as_str() {
            "tbl" => Format::Tbl,
            "json" => Format::Json,
            _ => Format::Toml,
        });
        let Some(to) = self.to.or(by_name).or(self.out.is_some().then_some(Format::Toml)) else {
            return answer(args, To::default(), tools_sheet(&library));
        };
        let to = match to {
            Format::Toml => ToolsTo::Toml,
            Format::Json => ToolsTo::Json,
            Format::Tbl => ToolsTo::Table,
        };
        let data = self.out.as_deref().map_or(Data::Alone, Data::File);
        answer(args, To { data, ..To::default() }, convert_tools(&library, to)?)
    }

    /// A loader of the file, and its name there. The bits of a library of FreeCAD lie in a folder beside its own.
    fn place(&self) -> (DiskLoader, String) {
        let (loader, name) = files::beside(&self.file);
        let library = self.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("fctl"));
        let whole = if library { self.file.canonicalize().ok() } else { None };
        let folder = whole.as_deref().and_then(Path::parent);
        match folder.and_then(|folder| Some((folder.parent()?, folder.file_name()?))) {
            Some((above, folder)) => {
                let name = format!("{}/{name}", folder.to_string_lossy());
                (DiskLoader::new(above).noting(files::read()), name)
            }
            None => (loader, name),
        }
    }
}
