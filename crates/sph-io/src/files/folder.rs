//! Is there a place to write to, before hours are spent computing?

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Component, Path, PathBuf};

use flate2::CrcReader;

use crate::error::{IoError, Result, is_full};

/// Size of the test file in bytes: one block, so that a full disk shows.
const BLOCK: usize = 4096;

/// Refuses a path that is no plain file or has more than `most` bytes, before it is opened.
///
/// # Errors
/// The kind of the file instead: a folder, a pipe, a file that is too long or not there.
pub fn readable(path: impl AsRef<Path>, most: u64) -> Result<()> {
    let path = path.as_ref();
    let known = fs::metadata(path).map_err(|e| IoError::read(path, e))?;
    let refused = |why: String| Err(IoError::read(path, io::Error::other(why)));
    match known.len() {
        _ if !known.is_file() => refused("it is not a file".to_string()),
        n if n > most => refused(format!("it is longer than {} MiB", most >> 20)),
        _ => Ok(()),
    }
}

/// Digest of a file, in a few bytes.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Checksum {
    /// Length, bytes.
    pub bytes: u64,
    /// CRC-32 of the content.
    pub crc: u32,
}

impl std::fmt::Display for Checksum {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {:08x}", self.bytes, self.crc)
    }
}

/// Length and CRC-32 of a plain file of at most `most` bytes, read piece by piece.
///
/// # Errors
/// Refusals of [`readable`], and errors of the system.
pub fn checksum(path: impl AsRef<Path>, most: u64) -> Result<Checksum> {
    let path = path.as_ref();
    readable(path, most)?;
    let read = || -> io::Result<Checksum> {
        let mut file = CrcReader::new(File::open(path)?.take(most + 1));
        let bytes = io::copy(&mut file, &mut io::sink())?;
        let crc = file.crc().sum();
        Ok(Checksum { bytes, crc })
    };
    read().map_err(|e| IoError::read(path, e))
}

/// Creates `folder` with its parents if need be and proves by a file without a name that it can be written.
///
/// A file without a name is gone with the process, however that ends.
pub fn writable(folder: impl AsRef<Path>) -> Result<()> {
    let folder = folder.as_ref();
    fs::create_dir_all(folder).map_err(|e| IoError::CreateFolder(folder.into(), e))?;
    let write_block = || -> io::Result<()> {
        let mut file = tempfile::tempfile_in(folder)?;
        file.write_all(&[0; BLOCK])?;
        // Some file systems report a full disk only when the data go out.
        file.sync_data()
    };
    write_block().map_err(|e| match is_full(&e) {
        true => IoError::DiskFull(folder.into(), e),
        false => IoError::NotWritable(folder.into(), e),
    })
}

pub(crate) fn folder_of(file: &Path) -> &Path {
    let named = file.parent().filter(|f| !f.as_os_str().is_empty());
    named.unwrap_or(Path::new("."))
}

/// The path of a file that a list names; it stays in the folder of the list, links followed.
pub(crate) fn beside(list: &Path, file: &Path) -> Result<PathBuf> {
    let path = list.with_file_name(file);
    let within = |c| matches!(c, Component::Normal(_) | Component::CurDir);
    let named = file.components().all(within);
    // A missing file leads nowhere.
    let real = (path.canonicalize(), folder_of(list).canonicalize());
    let leads = matches!(real, (Ok(real), Ok(folder)) if !real.starts_with(&folder));
    let problem = || format!("it names `{}`, which is outside its folder", file.display());
    (named && !leads)
        .then_some(path)
        .ok_or_else(|| IoError::Unfit(list.into(), problem()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_parents_are_made_and_nothing_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let deep = folder.path().join("a/b/c");
        writable(&deep).unwrap();
        assert_eq!(fs::read_dir(&deep).unwrap().count(), 0);
    }

    #[test]
    fn a_checksum_tells_contents_apart_and_refuses_what_is_long() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        fs::write(&path, b"123456789").unwrap();
        // The check value of CRC-32 (ISO 3309).
        let crc = 0xcbf4_3926;
        assert_eq!(checksum(&path, 9).unwrap(), Checksum { bytes: 9, crc });
        assert!(checksum(&path, 8).is_err() && checksum(folder.path(), 99).is_err());
    }

    #[test]
    fn a_file_in_the_way_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, b"").unwrap();
        let error = writable(file.join("below")).unwrap_err();
        assert!(matches!(error, IoError::CreateFolder(..)));
        assert!(error.to_string().contains("below"));
    }

    #[test]
    fn an_unwritable_folder_is_refused() {
        let folder = Path::new("/proc/self");
        if !folder.exists() {
            println!("skipped: no /proc on this system");
            return;
        }
        let error = writable(folder).unwrap_err();
        assert!(matches!(error, IoError::NotWritable(..)), "{error}");
    }
}
