//! The steps of writing, so that each of them can be made to fail.

use std::fs::{File, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Steps of writing to a disk.
pub(super) trait Disk {
    /// A new, empty file in `folder` under a temporary name that nothing had: no link is followed.
    fn create(&mut self, folder: &Path) -> io::Result<(PathBuf, File)>;

    /// Writes bytes and waits until they are on the disk.
    fn fill(&mut self, file: File, bytes: &[u8]) -> io::Result<()>;

    /// Renames; a file of the new name is replaced.
    fn rename(&mut self, from: &Path, to: &Path) -> io::Result<()>;

    /// Removes a file.
    fn remove(&mut self, path: &Path) -> io::Result<()>;

    /// Waits until renamings in a folder are on the disk, where the system can.
    fn settle(&mut self, folder: &Path);
}

/// The disk of the machine.
pub(super) struct RealDisk;

impl Disk for RealDisk {
    fn create(&mut self, folder: &Path) -> io::Result<(PathBuf, File)> {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        // A leftover of an earlier process of the same number may be in the way of some names.
        for _ in 0..MOST_NAMES {
            let path = folder.join(temporary(std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed)));
            match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(file) => return Ok((path, file)),
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
                Err(e) => return Err(e),
            }
        }
        Err(io::Error::new(io::ErrorKind::AlreadyExists, "no temporary name is free"))
    }

    fn fill(&mut self, mut file: File, bytes: &[u8]) -> io::Result<()> {
        file.write_all(bytes)?;
        file.sync_all()
    }

    fn rename(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        std::fs::rename(from, to)
    }

    fn remove(&mut self, path: &Path) -> io::Result<()> {
        std::fs::remove_file(path)
    }

    fn settle(&mut self, folder: &Path) {
        // Not every system can open or wait for a folder.
        let _ = File::open(folder).and_then(|f| f.sync_all());
    }
}

/// Gives a temporary file the rights of the file that it will replace; where the system cannot, it has those of a new one.
pub(super) fn keep_rights(temporary: &Path, place: &Path) {
    if let Some(old) = std::fs::symlink_metadata(place).ok().filter(std::fs::Metadata::is_file) {
        let _ = std::fs::set_permissions(temporary, old.permissions());
    }
}

/// Names tried before writing is given up.
const MOST_NAMES: u32 = 10_000;

const BEGIN: &str = ".kinecut-";
const END: &str = ".part";

fn temporary(process: u32, number: u64) -> String {
    format!("{BEGIN}{process}-{number}{END}")
}

/// Whether a name is that of a temporary file.
pub(super) fn is_temporary(name: &str) -> bool {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    name.strip_prefix(BEGIN)
        .and_then(|rest| rest.strip_suffix(END))
        .and_then(|middle| middle.split_once('-'))
        .is_some_and(|(process, number)| digits(process) && digits(number))
}
