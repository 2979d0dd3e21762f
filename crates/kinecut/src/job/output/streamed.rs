//! One file that is written piece by piece, whole or not at all: what is in it need not lie in memory.

use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};

use super::disk::{Disk as _, RealDisk};
use super::turn::Turn;
use super::{failed, in_the_way, make_folder, remove_leftovers};
use crate::base::{FilesRead, Progress, Result};

/// A file that is being written under a temporary name beside its place; it is removed if it is not finished.
pub(crate) struct StreamedFile {
    place: PathBuf,
    folder: PathBuf,
    temporary: Option<PathBuf>,
    file: BufWriter<File>,
    /// Other runs wait: one of them would take the temporary file for a leftover.
    _turn: Turn,
}

impl StreamedFile {
    /// Begins a file, in a folder that is made if it is not there.
    ///
    /// # Errors
    /// Those of [`Outputs::write_with`](super::Outputs::write_with).
    pub(crate) fn begin(place: &Path, read: &FilesRead, progress: &dyn Progress) -> Result<StreamedFile> {
        if read.holds(place) {
            return Err(in_the_way(place).into());
        }
        let folder = place.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        make_folder(folder)?;
        if place.file_name().is_none() || place.is_dir() {
            let e = std::io::Error::other("a folder of this name is in the way");
            return Err(failed(place, &e).into());
        }
        let turn = Turn::wait(folder, progress)?;
        if turn.is_held() {
            remove_leftovers(folder);
        }
        let (temporary, file) = RealDisk.create(folder).map_err(|e| failed(place, &e))?;
        Ok(StreamedFile {
            place: place.to_owned(),
            folder: folder.to_owned(),
            temporary: Some(temporary),
            file: BufWriter::new(file),
            _turn: turn,
        })
    }

    /// Appends a text.
    ///
    /// # Errors
    /// `KC0003` when it cannot be written.
    pub(crate) fn put(&mut self, text: &str) -> Result<()> {
        self.file.write_all(text.as_bytes()).map_err(|e| failed(&self.place, &e).into())
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// `KC0003` when it cannot be written.
    pub(crate) fn finish(mut self) -> Result<()> {
        let written = self.file.flush().and_then(|()| self.file.get_ref().sync_all());
        let placed = written.and_then(|()| match &self.temporary {
            Some(temporary) => RealDisk.rename(temporary, &self.place),
            None => Ok(()),
        });
        placed.map_err(|e| failed(&self.place, &e))?;
        self.temporary = None;
        RealDisk.settle(&self.folder);
        Ok(())
    }
}

impl Drop for StreamedFile {
    fn drop(&mut self) {
        if let Some(temporary) = self.temporary.take() {
            // A leftover that the next run removes.
            let _ = RealDisk.remove(&temporary);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::{Code, Silent};

    #[test]
    fn a_file_is_there_whole_or_not_at_all() {
        let folder = std::env::temp_dir().join(format!("kinecut-streamed-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        let place = folder.join("deep").join("samples.csv");
        let begin = |read: &FilesRead| StreamedFile::begin(&place, read, &Silent);
        let none = FilesRead::default();
        let mut first = begin(&none).unwrap();
        first.put("a\n").unwrap();
        assert!(!place.exists());
        first.put("b\n").unwrap();
        first.finish().unwrap();
        let mut second = begin(&none).unwrap();
        second.put("c\n").unwrap();
        drop(second);
        assert_eq!(std::fs::read_to_string(&place).unwrap(), "a\nb\n");
        assert_eq!(std::fs::read_dir(place.parent().unwrap()).unwrap().count(), 1);
        none.note(&place);
        assert_eq!(begin(&none).err().unwrap().code(), Code::INPUT_IN_THE_WAY);
        assert_eq!(
            StreamedFile::begin(&folder, &FilesRead::default(), &Silent).err().unwrap().code(),
            Code::OUTPUT_NOT_WRITTEN
        );
        std::fs::remove_dir_all(folder).unwrap();
    }
}
