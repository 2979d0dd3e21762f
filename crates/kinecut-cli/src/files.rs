//! Files of one command: what it reads is noted, and never replaced by what it writes.

use std::path::Path;
use std::sync::LazyLock;

use kinecut::base::{
    Code, DiskLoader, Error, FileKind, FilesRead, Finding, Loader as _, Location, read_text_stream,
};
use kinecut::job::Outputs;

/// The files that this command has read.
static READ: LazyLock<FilesRead> = LazyLock::new(FilesRead::default);

/// The files that this command has read so far.
pub(crate) fn read() -> &'static FilesRead {
    &READ
}

/// The folder of a file, and its name there.
fn split(path: &Path) -> (&Path, String) {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    (folder, path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default())
}

/// A loader for what is named as seen from a file, and the name of the file itself.
pub(crate) fn beside(file: &Path) -> (DiskLoader, String) {
    let (folder, name) = split(file);
    (DiskLoader::new(folder).noting(&READ), name)
}

/// The bytes of a file that the user names.
pub(crate) fn bytes(path: &Path, kind: FileKind) -> Result<Vec<u8>, Error> {
    let (loader, name) = beside(path);
    loader.read_as(&name, kind).map_err(|e| named(path, e))
}

/// The text of a file that the user names; `-` is standard input.
pub(crate) fn text(file: &str) -> Result<String, Error> {
    if file == "-" {
        return read_text_stream("standard input", std::io::stdin().lock());
    }
    let (loader, name) = beside(Path::new(file));
    loader.read_text(&name).map_err(|e| named(Path::new(file), e))
}

/// The text of a question, and a loader for what it names: as seen from its file.
pub(crate) fn question(file: &str) -> Result<(String, DiskLoader), Error> {
    Ok((text(file)?, beside(Path::new(file)).0))
}

/// An error with the name of the file as the user gave it.
fn named(path: &Path, mut error: Error) -> Error {
    error.0.place = Some(Location::whole_file(path.display().to_string()));
    if error.code() == Code::FILE_NOT_READ {
        error.0.help = String::new();
    }
    error
}

/// Writes all files into a folder, which is made if it is not there.
pub(crate) fn write(mut outputs: Outputs, folder: &Path) -> Result<(), Error> {
    outputs.spare(&READ);
    outputs.write_with(folder, &crate::progress::Bar::new())
}

/// Writes one file whole, into a folder that is made if it is not there.
pub(crate) fn write_one(file: &Path, text: &str) -> Result<(), Error> {
    if file.file_name().is_none() {
        let what = format!("`{}` is no name of a file", file.display());
        return Err(Finding::error(Code::OUTPUT_NOT_WRITTEN, what).into());
    }
    let (folder, name) = split(file);
    let mut outputs = Outputs::default();
    outputs.add(name, text.as_bytes());
    write(outputs, folder)
}
