//! Writing results: whole or not at all, one run at a time, and never over what was read.

mod disk;
mod streamed;
#[cfg(test)]
mod tests;
mod turn;

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::base::{Code, FilesRead, Finding, Location, Progress, Result, Silent};

use disk::{Disk, RealDisk};
use turn::Turn;

pub(crate) use streamed::StreamedFile;

/// Files to be written into one folder.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    files: Vec<(String, Arc<Vec<u8>>)>,
    seal: Option<(String, Arc<Vec<u8>>)>,
    read: FilesRead,
}

impl Outputs {
    /// Adds a file.
    pub fn add(&mut self, name: impl Into<String>, bytes: impl Into<Vec<u8>>) {
        self.files.push((name.into(), Arc::new(bytes.into())));
    }

    /// The file that speaks about the others (a verdict): the one in the folder is taken away before the first other
    /// file is replaced, and the new one is put there last.
    pub fn seal(&mut self, name: impl Into<String>, bytes: impl Into<Vec<u8>>) {
        self.seal = Some((name.into(), Arc::new(bytes.into())));
    }

    /// Files that must not be replaced, because they were read.
    pub fn spare(&mut self, read: &FilesRead) {
        self.read = read.clone();
    }

    /// Names and contents in the order of writing.
    pub fn files(&self) -> impl Iterator<Item = (&str, &[u8])> {
        self.files.iter().chain(&self.seal).map(|(name, bytes)| (name.as_str(), bytes.as_slice()))
    }

    /// [`Outputs::write_with`] without progress.
    ///
    /// # Errors
    /// As [`Outputs::write_with`].
    pub fn write(&self, folder: &Path) -> Result<()> {
        self.write_with(folder, &Silent)
    }

    /// Writes all files into `folder`, making it if it is not there.
    ///
    /// All are first written whole under temporary names of their own beside their places, and renamed only when all
    /// are there; the seal last. A file that is replaced leaves its rights to the new one. Runs into one folder take turns. What a killed run has left is removed. On an
    /// error the temporary files are removed, and unless a file was already replaced, all is as it was before.
    ///
    /// # Errors
    /// `KC0003` when the folder or a file cannot be written, `KC0004` when a file would replace one that was read (nothing
    /// is written), `KC0005` when another run is still writing after a minute, `KC0009` when cancelled while waiting.
    pub fn write_with(&self, folder: &Path, progress: &dyn Progress) -> Result<()> {
        for (name, _) in self.files() {
            let path = folder.join(name);
            if self.read.holds(&path) {
                return Err(in_the_way(&path).into());
            }
        }
        make_folder(folder)?;
        let turn = Turn::wait(folder, progress)?;
        if turn.is_held() {
            remove_leftovers(folder);
        }
        self.write_on(&mut RealDisk, folder).map_err(|(path, e)| failed(&path, &e).into())
    }

    /// Writes by a disk; the path that failed, and why.
    fn write_on(&self, disk: &mut dyn Disk, folder: &Path) -> std::result::Result<(), (PathBuf, io::Error)> {
        let mut made = Vec::new();
        let result = self.put_in_place(disk, folder, &mut made);
        if result.is_err() {
            for temporary in made {
                // A file that was already renamed is no longer there; the error that counts is the first one.
                let _ = disk.remove(&temporary);
            }
        }
        result
    }

    fn put_in_place(
        &self,
        disk: &mut dyn Disk,
        folder: &Path,
        made: &mut Vec<PathBuf>,
    ) -> std::result::Result<(), (PathBuf, io::Error)> {
        let mut moves = Vec::new();
        for (name, bytes) in self.files() {
            let place = folder.join(name);
            // A folder in the way of a file would only be found by the rename, when others are already in place.
            let written = if place.is_dir() {
                Err(io::Error::other("a folder of this name is in the way"))
            } else {
                disk.create(folder).and_then(|(temporary, file)| {
                    made.push(temporary.clone());
                    disk.fill(file, bytes)?;
                    disk::keep_rights(&temporary, &place);
                    Ok(temporary)
                })
            };
            let temporary = written.map_err(|e| (place.clone(), e))?;
            moves.push((temporary, place));
        }
        let seal = if self.seal.is_some() { moves.pop() } else { None };
        let taken = match &seal {
            None => None,
            Some((_, place)) => take_seal(disk, folder, place, made).map_err(|e| (place.clone(), e))?,
        };
        for (i, (temporary, place)) in moves.iter().enumerate() {
            if let Err(e) = disk.rename(temporary, place) {
                // Nothing was replaced yet: what the old seal says still holds.
                if let (Some(taken), Some((_, place)), 0) = (&taken, &seal, i) {
                    let _ = disk.rename(taken, place);
                }
                return Err((place.clone(), e));
            }
        }
        if let Some((temporary, place)) = seal {
            disk.settle(folder);
            disk.rename(&temporary, &place).map_err(|e| (place, e))?;
        }
        disk.settle(folder);
        if let Some(taken) = taken {
            // A leftover that the next run removes.
            let _ = disk.remove(&taken);
        }
        Ok(())
    }
}

/// Takes the old seal out of its place, if there is one; the name it has now.
fn take_seal(
    disk: &mut dyn Disk,
    folder: &Path,
    place: &Path,
    made: &mut Vec<PathBuf>,
) -> io::Result<Option<PathBuf>> {
    if std::fs::symlink_metadata(place).is_err() {
        return Ok(None);
    }
    let (aside, file) = disk.create(folder)?;
    drop(file);
    made.push(aside.clone());
    disk.rename(place, &aside)?;
    disk.settle(folder);
    Ok(Some(aside))
}

fn in_the_way(path: &Path) -> Finding {
    let what = format!("`{}` was read by this run and would be replaced", path.display());
    Finding::error(Code::INPUT_IN_THE_WAY, what)
        .at(Location::whole_file(path.display().to_string()))
        .help("choose another folder or name; nothing was written")
}

fn failed(path: &Path, e: &io::Error) -> Finding {
    Finding::error(Code::OUTPUT_NOT_WRITTEN, format!("cannot write `{}`: {e}", path.display()))
        .at(Location::whole_file(path.display().to_string()))
        .help("choose a folder that can be written, with --out")
}

/// Makes a folder, with those above it.
fn make_folder(folder: &Path) -> Result<()> {
    // Without a dot at its end (`new/.`), which no system makes.
    let whole: PathBuf = folder.components().collect();
    std::fs::create_dir_all(whole).map_err(|e| failed(folder, &e).into())
}

/// Removes the temporary files that killed runs have left; only the holder of the turn may.
fn remove_leftovers(folder: &Path) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let is_folder = entry.file_type().is_ok_and(|t| t.is_dir());
        if !is_folder && entry.file_name().to_str().is_some_and(disk::is_temporary) {
            // One that stays does no harm: names are never used twice.
            let _ = std::fs::remove_file(entry.path());
        }
    }
}
