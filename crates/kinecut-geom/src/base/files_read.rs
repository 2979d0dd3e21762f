//! The files that a run has read, so that it does not write over it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The files that loaders have read, shared by its clones.
///
/// A file counts under both of its names: as it was reached (its folder without links), and as it lies on the disk
/// (without any link).
#[derive(Clone, Debug, Default)]
pub struct FilesRead(Arc<Mutex<BTreeSet<PathBuf>>>);

impl FilesRead {
    /// Notes that the file at `path`, which is there, is read.
    pub fn note(&self, path: &Path) {
        // A panic between lock and insertion leaves a set that is still a set.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.extend(names(path));
    }

    /// True if writing `path` would replace a file that was read.
    pub fn holds(&self, path: &Path) -> bool {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        names(path).any(|name| known.contains(&name))
    }
}

/// The names of a file without links; none when its folder is not there.
fn names(path: &Path) -> impl Iterator<Item = PathBuf> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let reached = folder.canonicalize().ok().zip(path.file_name()).map(|(folder, name)| folder.join(name));
    reached.into_iter().chain(path.canonicalize().ok())
}
