//! The only file access below the job layer.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use super::{Code, FileKind, FilesRead, Finding, Location, Result};

/// Reads the files that a job names. Paths are as the job file spells them.
pub trait Loader: Sync {
    /// The bytes of a file, at most [`FileKind::limit`].
    ///
    /// # Errors
    /// `KC0001` when it is not there, is no regular file, cannot be read or is larger than the limit of its kind.
    fn read_as(&self, path: &str, kind: FileKind) -> Result<Vec<u8>>;

    /// The bytes of a file, of whatever kind: to be hashed.
    ///
    /// # Errors
    /// As [`Loader::read_as`].
    fn read(&self, path: &str) -> Result<Vec<u8>> {
        self.read_as(path, FileKind::Bytes)
    }

    /// As [`Loader::read_as`], without a copy of what is in memory already.
    ///
    /// # Errors
    /// As [`Loader::read_as`].
    fn lend_as(&self, path: &str, kind: FileKind) -> Result<Cow<'_, [u8]>> {
        self.read_as(path, kind).map(Cow::Owned)
    }

    /// Unit of the lengths in meshes that do not say theirs [mm].
    fn mesh_unit(&self) -> f64 {
        1.0
    }

    /// The text of a job file, a machine file and the like.
    ///
    /// # Errors
    /// As [`Loader::read_as`]; `KC0002` when it is not UTF-8, or holds a NUL.
    fn read_text(&self, path: &str) -> Result<String> {
        self.read_text_as(path, FileKind::Text)
    }

    /// The text of a file of a kind.
    ///
    /// # Errors
    /// As [`Loader::read_text`].
    fn read_text_as(&self, path: &str, kind: FileKind) -> Result<String> {
        text_of(path, self.read_as(path, kind)?)
    }
}

/// A loader for meshes in a unit of their own.
pub struct MeshesIn<'a> {
    /// The loader of the files.
    pub loader: &'a dyn Loader,
    /// Unit of the lengths in meshes that do not say theirs [mm].
    pub unit: f64,
}

impl Loader for MeshesIn<'_> {
    fn read_as(&self, path: &str, kind: FileKind) -> Result<Vec<u8>> {
        self.loader.read_as(path, kind)
    }

    fn lend_as(&self, path: &str, kind: FileKind) -> Result<Cow<'_, [u8]>> {
        self.loader.lend_as(path, kind)
    }

    fn read_text_as(&self, path: &str, kind: FileKind) -> Result<String> {
        self.loader.read_text_as(path, kind)
    }

    fn mesh_unit(&self) -> f64 {
        self.unit
    }
}

/// Bytes as text: UTF-8 without NUL.
fn text_of(name: &str, bytes: Vec<u8>) -> Result<String> {
    let not_text = |valid: usize| {
        Finding::error(Code::NOT_TEXT, format!("`{name}` is not a UTF-8 text"))
            .value(valid as f64, "valid bytes")
            .at(Location::whole_file(name))
            .help("save it as UTF-8")
    };
    let text = String::from_utf8(bytes).map_err(|e| not_text(e.utf8_error().valid_up_to()))?;
    match text.find('\0') {
        Some(at) => Err(not_text(at).into()),
        None => Ok(text),
    }
}

/// All that a stream gives, at most the limit of the kind; `name` is that of messages.
///
/// # Errors
/// `KC0001` when it cannot be read or gives more than the limit.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::base::{Code, FileKind, read_stream};
/// assert_eq!(read_stream("standard input", FileKind::Text, b"x = 1".as_slice()).unwrap(), b"x = 1");
/// let endless = std::io::repeat(b' ');
/// assert_eq!(read_stream("/dev/zero", FileKind::Text, endless).unwrap_err().code(), Code::FILE_NOT_READ);
/// ```
pub fn read_stream(name: &str, kind: FileKind, stream: impl Read) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    // One byte more than allowed tells a stream that is too long from one that just fits.
    stream
        .take(kind.limit() + 1)
        .read_to_end(&mut bytes)
        .map_err(|e| Finding::error(Code::FILE_NOT_READ, format!("cannot read `{name}`: {e}")))?;
    within(name, kind, bytes.len() as u64)?;
    Ok(bytes)
}

/// As [`read_stream`], for a text.
///
/// # Errors
/// As [`read_stream`]; `KC0002` when it is not UTF-8, or holds a NUL.
pub fn read_text_stream(name: &str, stream: impl Read) -> Result<String> {
    text_of(name, read_stream(name, FileKind::Text, stream)?)
}

pub(super) fn within(name: &str, kind: FileKind, size: u64) -> Result<()> {
    if size <= kind.limit() {
        return Ok(());
    }
    Err(Finding::error(Code::FILE_NOT_READ, format!("`{name}` is too large for a {}", kind.word()))
        .value(size as f64, "bytes")
        .bound(kind.limit() as f64, "bytes")
        .at(Location::whole_file(name))
        .into())
}

/// Reads from disk, below one folder: a job from a stranger cannot name files outside its own folder, neither by
/// `..`, nor by an absolute path, nor through a link. Only regular files are read: no pipe, no device.
#[derive(Clone, Debug)]
pub struct DiskLoader {
    root: PathBuf,
    read: FilesRead,
}

impl DiskLoader {
    /// A loader for the paths of a file in `root`.
    pub fn new(root: impl Into<PathBuf>) -> DiskLoader {
        DiskLoader { root: root.into(), read: FilesRead::default() }
    }

    /// A loader that notes what it reads in `read`.
    #[must_use]
    pub fn noting(self, read: &FilesRead) -> DiskLoader {
        DiskLoader { read: read.clone(), ..self }
    }
}

impl Loader for DiskLoader {
    fn read_as(&self, path: &str, kind: FileKind) -> Result<Vec<u8>> {
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
            .help("put the file beside the job file")
            .into());
        }
        let cannot = |e: io::Error| {
            Finding::error(Code::FILE_NOT_READ, format!("cannot read `{}`: {e}", full.display()))
                .at(Location::whole_file(path))
                .help("give the path relative to the folder of the job file")
        };
        let (file, size) = open_regular(&full).map_err(cannot)?;
        within(path, kind, size)?;
        self.read.note(&full);
        read_stream(path, kind, file)
    }
}

/// Opens a regular file; its size [bytes].
fn open_regular(path: &Path) -> io::Result<(File, u64)> {
    let regular = |metadata: &std::fs::Metadata| {
        let fine = metadata.is_file();
        if fine { Ok(()) } else { Err(io::Error::other("only regular files are read")) }
    };
    // Before, because opening a pipe waits for its writer; after, because it may have been exchanged.
    regular(&std::fs::metadata(path)?)?;
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    regular(&metadata)?;
    Ok((file, metadata.len()))
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
    fn read_as(&self, path: &str, kind: FileKind) -> Result<Vec<u8>> {
        let bytes = self.files.get(path).cloned().ok_or_else(|| {
            Finding::error(Code::FILE_NOT_READ, format!("cannot read `{path}`: no such file"))
                .at(Location::whole_file(path))
                .help("give the path relative to the folder of the job file")
        })?;
        within(path, kind, bytes.len() as u64)?;
        Ok(bytes)
    }
}
