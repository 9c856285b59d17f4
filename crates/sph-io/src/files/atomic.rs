//! Files that are either the old one or the new one, never half of each.
//!
//! Content goes to a temporary name in the same folder, which is renamed over
//! the target once complete. If anything fails before (full disk, a value that
//! cannot be written, a panic) the temporary is removed and the target keeps
//! its former content. Only a killed process can leave a temporary behind;
//! [`sweep_temporaries`] removes those.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::error::{IoError, Result};

/// Durability of a write when the call returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Durability {
    /// The process may die: the content is with the operating system.
    Process,
    /// The machine may lose power: the content is on the disk (fsync of file and folder).
    Power,
}

/// A file being written under a temporary name.
///
/// Dropping it without [`commit`](Self::commit) removes the temporary.
#[derive(Debug)]
pub struct AtomicFile {
    target: PathBuf,
    temporary: PathBuf,
    /// `None` once closed.
    file: Option<BufWriter<File>>,
}

/// Makes the temporary names of one process distinct.
static SERIAL: AtomicU64 = AtomicU64::new(0);

impl AtomicFile {
    /// Opens a temporary beside `target`.
    pub fn create(target: impl AsRef<Path>) -> Result<Self> {
        let target = target.as_ref();
        let Some(name) = target.file_name() else {
            return Err(IoError::input(target, "the path names no file"));
        };
        let serial = SERIAL.fetch_add(1, Ordering::Relaxed);
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}-{serial}.tmp", process::id()));
        let temporary = target.with_file_name(hidden);
        let file = File::create(&temporary).map_err(|e| IoError::write(target, e))?;
        Ok(Self {
            target: target.to_path_buf(),
            temporary,
            file: Some(BufWriter::with_capacity(1 << 18, file)),
        })
    }

    /// Makes the content appear under the target's name.
    pub fn commit(mut self, durability: Durability) -> Result<()> {
        let done = self.close(durability);
        done.map_err(|e| IoError::write(&self.target, e))
    }

    fn close(&mut self, durability: Durability) -> io::Result<()> {
        self.flush()?;
        // Dropping the handle first lets the rename succeed on every platform.
        if let Some(buffer) = self.file.take() {
            let file = buffer.into_inner().map_err(|e| e.into_error());
            let kept = file.and_then(|file| match durability {
                Durability::Process => Ok(()),
                Durability::Power => file.sync_all(),
            });
            if let Err(error) = kept.and_then(|()| fs::rename(&self.temporary, &self.target)) {
                let _ = fs::remove_file(&self.temporary);
                return Err(error);
            }
        }
        if durability == Durability::Power {
            sync_folder(&self.target);
        }
        Ok(())
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.file {
            Some(file) => file.write(bytes),
            None => Err(io::ErrorKind::BrokenPipe.into()),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.as_mut().map_or(Ok(()), Write::flush)
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if let Some(buffer) = self.file.take() {
            // Not flushed: the content is discarded.
            drop(buffer.into_parts());
            let _ = fs::remove_file(&self.temporary);
        }
    }
}

/// Writes `target` through `fill`, all or nothing.
///
/// ```
/// # use sph_io::{Durability, write_atomic};
/// # let folder = tempfile::tempdir()?;
/// let path = folder.path().join("note.txt");
/// write_atomic(&path, Durability::Process, |file| file.write_all(b"whole"))?;
/// assert_eq!(std::fs::read(&path)?, b"whole");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_atomic(
    target: impl AsRef<Path>,
    durability: Durability,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<()> {
    let target = target.as_ref();
    let mut file = AtomicFile::create(target)?;
    fill(&mut file).map_err(|e| IoError::write(target, e))?;
    file.commit(durability)
}

/// Removes temporaries that a killed process left in `folder` and in the folders directly below it; returns how many.
///
/// Call it when a run takes possession of its folder, not while another
/// process writes there.
pub fn sweep_temporaries(folder: impl AsRef<Path>) -> Result<usize> {
    let folder = folder.as_ref();
    let (mut removed, below) = swept(folder)?;
    for folder in below {
        removed += swept(&folder)?.0;
    }
    Ok(removed)
}

/// Removes the temporaries of one folder; their number, and the folders in it.
fn swept(folder: &Path) -> Result<(usize, Vec<PathBuf>)> {
    let (mut removed, mut below) = (0, Vec::new());
    for entry in fs::read_dir(folder).map_err(|e| IoError::read(folder, e))? {
        let entry = entry.map_err(|e| IoError::read(folder, e))?;
        let Ok(kind) = entry.file_type() else {
            continue;
        };
        if kind.is_dir() {
            below.push(entry.path());
        } else if kind.is_file() && entry.file_name().to_str().is_some_and(is_temporary) {
            let path = entry.path();
            fs::remove_file(&path).map_err(|e| IoError::write(&path, e))?;
            removed += 1;
        }
    }
    Ok((removed, below))
}

/// True if `name` has the form `.NAME.PID-SERIAL.tmp`, or `.writable-PID` as earlier versions tried folders with.
fn is_temporary(name: &str) -> bool {
    let digits = |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
    if name.strip_prefix(".writable-").is_some_and(digits) {
        return true;
    }
    name.strip_prefix('.')
        .and_then(|rest| rest.strip_suffix(".tmp"))
        .and_then(|rest| rest.rsplit_once('.'))
        .and_then(|(_, mark)| mark.split_once('-'))
        .is_some_and(|(pid, serial)| digits(pid) && digits(serial))
}

/// Puts the renamed entry itself on the disk, where folders can be synced.
fn sync_folder(target: &Path) {
    if let Some(parent) = target.parent() {
        let parent = if parent.as_os_str().is_empty() {
            Path::new(".")
        } else {
            parent
        };
        let _ = File::open(parent).and_then(|folder| folder.sync_all());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        entries
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect()
    }

    #[test]
    fn a_failure_leaves_the_old_content_and_no_temporary() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        write_atomic(&path, Durability::Power, |f| f.write_all(b"old")).unwrap();
        let error = write_atomic(&path, Durability::Process, |f| {
            f.write_all(&[0; 1 << 20])?;
            Err(io::ErrorKind::StorageFull.into())
        })
        .unwrap_err();
        assert!(matches!(error, IoError::DiskFull { .. }), "{error}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["a.json"]);
    }

    #[test]
    fn a_target_that_is_a_folder_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("taken");
        fs::create_dir(&path).unwrap();
        let error = write_atomic(&path, Durability::Process, |f| f.write_all(b"x")).unwrap_err();
        assert!(error.to_string().contains("taken"), "{error}");
        assert_eq!(names(folder.path()), ["taken"]);
        assert!(AtomicFile::create("..").is_err());
    }

    #[test]
    fn only_temporaries_are_swept_and_those_of_folders_below() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir_all(folder.path().join("animations/old")).unwrap();
        for name in [
            ".a.vtu.12-3.tmp",
            ".writable-77",
            ".hidden",
            "b.tmp",
            ".c.x-1.tmp",
            "animations/.phase.gif.1058-8.tmp",
            "animations/old/.phase.gif.1058-8.tmp",
        ] {
            fs::write(folder.path().join(name), b"").unwrap();
        }
        assert_eq!(sweep_temporaries(folder.path()).unwrap(), 3);
        assert_eq!(names(folder.path()).len(), 4);
        assert_eq!(names(&folder.path().join("animations")), ["old"]);
        assert_eq!(names(&folder.path().join("animations/old")).len(), 1);
    }
}
