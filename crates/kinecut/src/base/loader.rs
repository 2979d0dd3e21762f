//! The only file access below the job layer.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use super::{Code, Finding, Location, Result};

/// Reads the files that a job names. Paths are as the job file spells them.
pub trait Loader: Sync {
    /// The bytes of a file.
    ///
    /// # Errors
    /// `KC0001` when it is not there, cannot be read or is larger than the loader's limit.
    fn read(&self, path: &str) -> Result<Vec<u8>>;

    /// The text of a file.
    ///
    /// # Errors
    /// As [`Loader::read`]; `KC0002` when it is not UTF-8.
    fn read_text(&self, path: &str) -> Result<String> {
        String::from_utf8(self.read(path)?).map_err(|e| {
            Finding::error(Code::NOT_TEXT, format!("`{path}` is not a UTF-8 text"))
                .value(e.utf8_error().valid_up_to() as f64, "valid bytes")
                .at(Location::whole_file(path))
                .cure("save it as UTF-8")
                .into()
        })
    }
}

/// Reads from disk, below one folder: a job from a stranger cannot name files outside its own folder, neither by
/// `..`, nor by an absolute path, nor through a link.
#[derive(Clone, Debug)]
pub struct DiskLoader {
    root: PathBuf,
    limit: u64,
}

impl DiskLoader {
    /// Largest file read by default [bytes].
    pub const LIMIT: u64 = 1 << 30;

    /// A loader for the paths of a file in `root`.
    pub fn new(root: impl Into<PathBuf>) -> DiskLoader {
        DiskLoader { root: root.into(), limit: DiskLoader::LIMIT }
    }
}

impl Loader for DiskLoader {
    fn read(&self, path: &str) -> Result<Vec<u8>> {
        let full = self.root.join(path);
        let outside =
            Path::new(path).components().any(|c| !matches!(c, Component::Normal(_) | Component::CurDir));
        let resolved = full.canonicalize().ok().zip(self.root.canonicalize().ok());
        if outside || resolved.is_some_and(|(file, root)| !file.starts_with(root)) {
            return Err(Finding::error(
                Code::FILE_NOT_READ,
                format!("`{path}` lies outside the folder of the job"),
            )
            .at(Location::whole_file(path))
            .cure("put the file beside the job file")
            .into());
        }
        let cannot = |e: std::io::Error| {
            Finding::error(Code::FILE_NOT_READ, format!("cannot read `{}`: {e}", full.display()))
                .at(Location::whole_file(path))
                .cure("give the path relative to the folder of the job file")
        };
        let size = std::fs::metadata(&full).map_err(cannot)?.len();
        if size > self.limit {
            return Err(Finding::error(Code::FILE_NOT_READ, format!("`{path}` is too large"))
                .value(size as f64, "bytes")
                .bound(self.limit as f64, "bytes")
                .at(Location::whole_file(path))
                .into());
        }
        Ok(std::fs::read(&full).map_err(cannot)?)
    }
}

/// Files held in memory: for tests and for callers without a disk.
#[derive(Clone, Debug, Default)]
pub struct MemoryLoader {
    files: BTreeMap<String, Vec<u8>>,
}

impl MemoryLoader {
    /// With one more file.
    #[must_use]
    pub fn with(mut self, path: &str, bytes: impl Into<Vec<u8>>) -> MemoryLoader {
        self.files.insert(path.to_owned(), bytes.into());
        self
    }
}

impl Loader for MemoryLoader {
    fn read(&self, path: &str) -> Result<Vec<u8>> {
        self.files.get(path).cloned().ok_or_else(|| {
            Finding::error(Code::FILE_NOT_READ, format!("cannot read `{path}`: no such file"))
                .at(Location::whole_file(path))
                .cure("give the path relative to the folder of the job file")
                .into()
        })
    }
}
