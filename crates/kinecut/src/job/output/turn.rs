//! Runs into one folder take turns.

use std::fs::{File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::failed;
use crate::base::{Code, Finding, Location, Progress, Result};

/// The right to write into a folder; it ends with the value, and with the process.
pub(super) struct Turn {
    file: Option<File>,
    path: PathBuf,
}

/// Name of the file that is locked.
const NAME: &str = ".kinecut.lock";

/// Time between two tries.
const PAUSE: Duration = Duration::from_millis(25);

/// Tries before the wait is given up: a minute.
const MOST_TRIES: u32 = 2400;

impl Turn {
    /// Waits for the turn.
    ///
    /// # Errors
    /// `KC0003` when the file to lock cannot be made, `KC0005` after a minute, `KC0009` when cancelled.
    pub(super) fn wait(folder: &Path, progress: &dyn Progress) -> Result<Turn> {
        Turn::wait_for(folder, progress, MOST_TRIES)
    }

    pub(super) fn wait_for(folder: &Path, progress: &dyn Progress, tries: u32) -> Result<Turn> {
        let path = folder.join(NAME);
        for i in 0..tries {
            match take(&path) {
                Ok(Some(file)) => return Ok(Turn { file: Some(file), path }),
                Ok(None) => {}
                // Without locks two runs may mix their files; no verdict then holds, because each is about all of them.
                Err(e) if e.kind() == io::ErrorKind::Unsupported => return Ok(Turn { file: None, path }),
                Err(e) => return Err(failed(&path, &e).into()),
            }
            if i == 0 {
                progress.stage("waiting for a run", 1);
            }
            if progress.cancelled() {
                return Err(Finding::error(Code::CANCELLED, "cancelled while another run was writing").into());
            }
            std::thread::sleep(PAUSE);
        }
        Err(Finding::error(Code::OUTPUT_BUSY, format!("another run is writing into `{}`", folder.display()))
            .at(Location::whole_file(folder.display().to_string()))
            .help("run it again when the other one has ended, or choose another folder with --out")
            .into())
    }

    /// Whether no other run can be writing.
    pub(super) fn is_held(&self) -> bool {
        self.file.is_some()
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        // Removed while it is locked: who has opened it meanwhile sees that it is no longer the one of that name.
        if cfg!(unix) && self.file.is_some() {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// Locks the file of that name; none when another run has it.
fn take(path: &Path) -> io::Result<Option<File>> {
    let file = match OpenOptions::new().write(true).create_new(true).open(path) {
        Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {
            // A link or a pipe of that name is not ours: it is neither followed nor waited for.
            match std::fs::symlink_metadata(path) {
                Ok(found) if !found.is_file() => {
                    return Err(io::Error::other("something else than a file is in the way"));
                }
                Ok(_) => {}
                Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(None),
                Err(e) => return Err(e),
            }
            match OpenOptions::new().write(true).open(path) {
                Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(None),
                opened => opened?,
            }
        }
        made => made?,
    };
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => return Ok(None),
        Err(TryLockError::Error(e)) => return Err(e),
    }
    // The run before may have removed it between opening and locking.
    Ok(is_still(&file, path)?.then_some(file))
}

#[cfg(unix)]
fn is_still(file: &File, path: &Path) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt as _;
    let open = file.metadata()?;
    match std::fs::symlink_metadata(path) {
        Ok(named) => Ok((named.dev(), named.ino()) == (open.dev(), open.ino())),
        Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(e) => Err(e),
    }
}

/// Elsewhere the file stays.
#[cfg(not(unix))]
fn is_still(_: &File, _: &Path) -> io::Result<bool> {
    Ok(true)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_lock_whose_file_was_taken_away_is_none() {
        let path = std::env::temp_dir().join(format!("kinecut-turn-{}", std::process::id()));
        let held = take(&path).unwrap().unwrap();
        assert!(is_still(&held, &path).unwrap() && take(&path).unwrap().is_none());
        std::fs::remove_file(&path).unwrap();
        assert!(!is_still(&held, &path).unwrap());
        std::fs::write(&path, "").unwrap();
        assert!(!is_still(&held, &path).unwrap());
        std::fs::remove_file(path).unwrap();
    }
}
