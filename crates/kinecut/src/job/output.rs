//! Writing results: whole or not at all.

use std::io::Write;
use std::path::Path;

use crate::base::{Code, Finding, Location, Result};

/// Files to be written into one folder.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    files: Vec<(String, Vec<u8>)>,
}

impl Outputs {
    /// Adds a file.
    pub fn add(&mut self, name: impl Into<String>, bytes: impl Into<Vec<u8>>) {
        self.files.push((name.into(), bytes.into()));
    }

    /// Names and contents, in order.
    pub fn files(&self) -> impl Iterator<Item = (&str, &[u8])> {
        self.files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice()))
    }

    /// Writes all files into `folder`, making it if it is not there. Each file is first written whole under a
    /// temporary name beside its place; only when all are there are they renamed into place. On an error the
    /// temporary files are removed and what was in the folder before is untouched.
    ///
    /// # Errors
    /// `KC0003` when the folder or a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let fail = |path: &Path, e: std::io::Error| {
            Finding::error(Code::OUTPUT_NOT_WRITTEN, format!("cannot write `{}`: {e}", path.display()))
                .at(Location::whole_file(path.display().to_string()))
                .cure("choose a folder that can be written, with --out")
        };
        std::fs::create_dir_all(folder).map_err(|e| fail(folder, e))?;
        let temporary = |name: &str| folder.join(format!(".{name}.part"));
        let write_one = |name: &str, bytes: &[u8]| {
            let mut file = std::fs::File::create(temporary(name))?;
            file.write_all(bytes)?;
            file.sync_all()
        };
        let cleaned = |result: std::result::Result<(), Finding>| {
            if result.is_err() {
                for (name, _) in &self.files {
                    // A file that was not yet made cannot be removed; the error that counts is the first one.
                    let _ = std::fs::remove_file(temporary(name));
                }
            }
            result
        };
        for (name, bytes) in &self.files {
            // A folder in the way of a file would only be found by the rename, when others are already in place.
            let in_the_way = folder.join(name).is_dir();
            let written = if in_the_way {
                Err(std::io::Error::other("a folder of this name is in the way"))
            } else {
                write_one(name, bytes)
            };
            cleaned(written.map_err(|e| fail(&folder.join(name), e)))?;
        }
        for (name, _) in &self.files {
            let renamed = std::fs::rename(temporary(name), folder.join(name));
            cleaned(renamed.map_err(|e| fail(&folder.join(name), e)))?;
        }
        Ok(())
    }
}
