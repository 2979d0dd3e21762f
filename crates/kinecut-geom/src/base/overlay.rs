//! Files from memory over those of another loader.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Component, Path};

use super::{FileKind, Loader, Result};

/// Serves some files from memory and the others from elsewhere: texts that are being edited over those on disk, a program that
/// was given over what lies beside its job.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::base::{Loader, MemoryLoader, OverlayLoader};
/// let disk = MemoryLoader::default().with("a.toml", "x = 1").with("b.toml", "y = 1");
/// let edited = OverlayLoader::new(&disk).with("a.toml", b"x = 2".as_slice());
/// assert_eq!(edited.read_text("./a.toml").unwrap(), "x = 2");
/// assert_eq!(edited.read_text("b.toml").unwrap(), "y = 1");
/// ```
pub struct OverlayLoader<'a> {
    files: BTreeMap<String, Cow<'a, [u8]>>,
    others: &'a dyn Loader,
}

impl<'a> OverlayLoader<'a> {
    /// A loader that serves nothing from memory yet.
    pub fn new(others: &'a dyn Loader) -> OverlayLoader<'a> {
        OverlayLoader { files: BTreeMap::new(), others }
    }

    /// With one more file.
    #[must_use]
    pub fn with(mut self, path: &str, bytes: impl Into<Cow<'a, [u8]>>) -> OverlayLoader<'a> {
        self.files.insert(plain(path), bytes.into());
        self
    }
}

/// A path without steps to where it is: `./a` is `a`. A path that leads elsewhere stays, and so stays unlike all others.
fn plain(path: &str) -> String {
    let below = Path::new(path).components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir));
    if !below {
        return path.to_owned();
    }
    let names = Path::new(path).components().filter_map(|c| match c {
        Component::Normal(name) => name.to_str(),
        _ => None,
    });
    names.collect::<Vec<_>>().join("/")
}

impl Loader for OverlayLoader<'_> {
    fn read_as(&self, path: &str, kind: FileKind) -> Result<Vec<u8>> {
        self.lend_as(path, kind).map(Cow::into_owned)
    }

    fn lend_as(&self, path: &str, kind: FileKind) -> Result<Cow<'_, [u8]>> {
        match self.files.get(&plain(path)) {
            Some(bytes) => {
                super::loader::within(path, kind, bytes.len() as u64)?;
                Ok(Cow::Borrowed(bytes))
            }
            None => self.others.lend_as(path, kind),
        }
    }

    fn mesh_unit(&self) -> f64 {
        self.others.mesh_unit()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::{Code, MemoryLoader};

    #[test]
    fn a_path_that_leads_elsewhere_is_that_of_the_others() {
        let none = MemoryLoader::default();
        let loader = OverlayLoader::new(&none).with("sub/a.toml", b"1".as_slice());
        assert_eq!(loader.read("sub/./a.toml").unwrap(), b"1");
        for path in ["../sub/a.toml", "/sub/a.toml", "sub/../sub/a.toml", "a.toml", ""] {
            assert_eq!(loader.read(path).unwrap_err().code(), Code::FILE_NOT_READ, "{path}");
        }
    }

    #[test]
    fn a_text_in_memory_is_bounded_as_one_on_disk() {
        let none = MemoryLoader::default();
        let long = vec![b' '; FileKind::Text.limit() as usize + 1];
        let loader = OverlayLoader::new(&none).with("a", long);
        assert_eq!(loader.read_text("a").unwrap_err().code(), Code::FILE_NOT_READ);
    }
}
