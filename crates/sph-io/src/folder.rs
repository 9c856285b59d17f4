//! Is there a place to write to, before hours are spent computing?

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;
use std::process;

use crate::error::{IoError, Result, is_full};

/// Size of the test file in bytes: one block, so that a full disk shows.
const BLOCK: usize = 4096;

/// Refuses what is no plain file, or has more than `most` bytes, before it is opened.
///
/// # Errors
/// What it is instead: a folder, a pipe, a file that is too long or not there.
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

/// Creates `folder` with its parents if need be and proves by a test file,
/// removed again, that it can be written.
pub fn writable(folder: impl AsRef<Path>) -> Result<()> {
    let folder = folder.as_ref();
    fs::create_dir_all(folder).map_err(|source| IoError::CreateFolder {
        path: folder.to_path_buf(),
        source,
    })?;
    let trial = folder.join(format!(".writable-{}", process::id()));
    let written = write_block(&trial);
    let removed = match fs::remove_file(&trial) {
        Err(e) if e.kind() == io::ErrorKind::NotFound && written.is_err() => Ok(()),
        other => other,
    };
    written.and(removed).map_err(|source| {
        let path = folder.to_path_buf();
        if is_full(&source) {
            IoError::DiskFull { path, source }
        } else {
            IoError::NotWritable { path, source }
        }
    })
}

fn write_block(path: &Path) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(&[0; BLOCK])?;
    // Some file systems report a full disk only when the data go out.
    file.sync_data()
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
    fn a_file_in_the_way_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, b"").unwrap();
        let error = writable(file.join("below")).unwrap_err();
        assert!(matches!(error, IoError::CreateFolder { .. }));
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
        assert!(matches!(error, IoError::NotWritable { .. }), "{error}");
    }
}
