//! The opened folder: its files by identifier, and nothing outside of it.

use std::collections::BTreeMap;
use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use kinecut::base::{DiskLoader, FileKind, Loader as _, Location, Result};
use kinecut::job::sha256;
use serde::Serialize;

use crate::kind::Kind;

/// Most files that are listed.
pub(crate) const MOST_FILES: usize = 4096;
/// Depth of folders in which files are looked for.
const DEPTH: usize = 6;
/// Most bytes of a text that are looked at for its kind.
const LOOKED_AT: u64 = 1 << 20;
/// Digits of an identifier.
const DIGITS: usize = 16;

/// A folder with the files that may be read and written.
pub(crate) struct Folder {
    /// Canonical.
    root: PathBuf,
    known: Mutex<BTreeMap<String, Known>>,
}

/// A file of the folder.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Listed {
    /// Identifier.
    pub(crate) id: String,
    /// Path below the folder, with `/`.
    pub(crate) name: String,
    pub(crate) kind: Kind,
    pub(crate) bytes: u64,
}

#[derive(Clone)]
struct Known {
    listed: Listed,
    stamp: Stamp,
}

/// What changes when a file does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Stamp {
    length: u64,
    modified: Option<std::time::SystemTime>,
    #[cfg(unix)]
    inode: u64,
}

impl Stamp {
    fn of(metadata: &Metadata) -> Stamp {
        Stamp {
            length: metadata.len(),
            modified: metadata.modified().ok(),
            #[cfg(unix)]
            inode: std::os::unix::fs::MetadataExt::ino(metadata),
        }
    }
}

/// All files of a folder.
#[derive(Clone, Debug, Default)]
pub(crate) struct Files {
    pub(crate) files: Vec<Listed>,
    /// Whether there are more.
    pub(crate) truncated: bool,
}

/// The identifier of a file: the same in each start, and nothing that a path could be made of.
pub(crate) fn id_of(name: &str) -> String {
    let mut id = sha256(name.as_bytes());
    id.truncate(DIGITS);
    id
}

impl Folder {
    /// Opens a folder.
    ///
    /// # Errors
    /// That of a folder that is not there.
    pub(crate) fn open(root: &Path) -> io::Result<Folder> {
        let root = root.canonicalize()?;
        if !root.is_dir() {
            return Err(io::Error::new(io::ErrorKind::NotADirectory, "this is no folder"));
        }
        Ok(Folder { root, known: Mutex::default() })
    }

    /// Its own name.
    pub(crate) fn name(&self) -> String {
        let last = self.root.file_name().unwrap_or(self.root.as_os_str());
        last.to_string_lossy().into_owned()
    }

    /// Its canonical path.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// Its files as they are now, sorted by name.
    pub(crate) fn list(&self) -> Files {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let mut found = BTreeMap::new();
        let mut truncated = false;
        self.gather(&self.root, "", 0, &known, &mut found, &mut truncated);
        *known = found;
        let mut files: Vec<Listed> = known.values().map(|k| k.listed.clone()).collect();
        files.sort_by(|a, b| a.name.cmp(&b.name));
        Files { files, truncated }
    }

    fn gather(
        &self,
        folder: &Path,
        above: &str,
        depth: usize,
        known: &BTreeMap<String, Known>,
        found: &mut BTreeMap<String, Known>,
        truncated: &mut bool,
    ) {
        let Ok(entries) = fs::read_dir(folder) else { return };
        let mut entries: Vec<_> = entries.flatten().collect();
        entries.sort_by_key(fs::DirEntry::file_name);
        for entry in entries {
            // A name that is no text, or that hides, is none of a job.
            let Ok(own) = entry.file_name().into_string() else { continue };
            if own.starts_with('.') || own.chars().any(char::is_control) {
                continue;
            }
            let name = format!("{above}{own}");
            let Some(place) = self.place(&name) else { continue };
            let Ok(metadata) = fs::metadata(&place) else { continue };
            if metadata.is_dir() {
                let skipped = matches!(own.as_str(), "node_modules" | "target" | "__pycache__");
                // A link to a folder may lead back to where it is.
                let linked = entry.file_type().is_ok_and(|t| t.is_symlink());
                match depth < DEPTH && !skipped && !linked {
                    true => self.gather(&place, &format!("{name}/"), depth + 1, known, found, truncated),
                    false => *truncated |= !skipped && !linked,
                }
                continue;
            }
            let Some(kind) = Kind::of_name(&own).filter(|_| metadata.is_file()) else { continue };
            if found.len() >= MOST_FILES {
                *truncated = true;
                return;
            }
            let (id, stamp) = (id_of(&name), Stamp::of(&metadata));
            let before = known.get(&id).filter(|k| k.stamp == stamp).map(|k| k.listed.kind);
            let kind = kind.or(before).unwrap_or_else(|| kind_of(&place, &metadata));
            let listed = Listed { id: id.clone(), name, kind, bytes: metadata.len() };
            found.insert(id, Known { listed, stamp });
        }
    }

    /// A file of an identifier, as it was when the folder was last listed.
    pub(crate) fn file(&self, id: &str) -> Option<Listed> {
        let known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        known.get(id).map(|k| k.listed.clone())
    }

    /// What tells that a file has changed.
    pub(crate) fn stamp(&self, name: &str) -> Option<Stamp> {
        let metadata = fs::metadata(self.place(name)?).ok()?;
        metadata.is_file().then(|| Stamp::of(&metadata))
    }

    /// The canonical place of a file that is there, if it lies below the folder.
    pub(crate) fn place(&self, name: &str) -> Option<PathBuf> {
        let place = self.root.join(name).canonicalize().ok()?;
        place.starts_with(&self.root).then_some(place)
    }

    /// A loader for what a file of the folder names: from its own folder, which holds all that it may read.
    pub(crate) fn beside(&self, name: &str) -> DiskLoader {
        DiskLoader::new(self.root.join(split(name).0))
    }

    /// The bytes of a file, at most the limit of the kind.
    ///
    /// # Errors
    /// As [`DiskLoader`].
    pub(crate) fn read(&self, name: &str, kind: FileKind) -> Result<Vec<u8>> {
        let loader = DiskLoader::new(&self.root);
        loader.read_as(name, kind).map_err(|mut e| {
            e.0.place = Some(Location::whole_file(name));
            e
        })
    }
}

/// The folder of a file, and its name there.
pub(crate) fn split(name: &str) -> (&str, &str) {
    name.rsplit_once('/').unwrap_or(("", name))
}

fn kind_of(place: &Path, metadata: &Metadata) -> Kind {
    if metadata.len() > LOOKED_AT {
        return Kind::Text;
    }
    fs::read_to_string(place).map_or(Kind::Text, |text| Kind::of_text(&text))
}

/// Whether a word may be the name of a new file: one name, visible, of the kinds that the folder lists.
pub(crate) fn may_be_new(name: &str) -> bool {
    let odd = |c: char| c.is_control() || matches!(c, '/' | '\\' | ':' | '*' | '?' | '"' | '<' | '>' | '|');
    name.len() <= 120
        && !name.starts_with(['.', ' ', '-'])
        && !name.ends_with(['.', ' '])
        && !name.chars().any(odd)
        && Kind::of_name(name).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_file_has_one_plain_name() {
        for name in ["job.toml", "BORE200.MPF", "O1234", "Деталь 7.toml"] {
            assert!(may_be_new(name), "{name}");
        }
        for name in [
            "",
            "..",
            "../a.toml",
            "a/b.toml",
            "a\\b.toml",
            ".hidden.toml",
            "a\0.toml",
            "a.exe",
            "c:a.toml",
            "a.toml.",
        ] {
            assert!(!may_be_new(name), "{name}");
        }
    }
}
