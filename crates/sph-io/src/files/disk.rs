//! Folders that can be written to, and files that are either the old one or the new one, never half of each.
//!
//! Content goes to a temporary name in the same folder, which is renamed over the target once complete. If anything
//! fails before (full disk, a value that cannot be written, a panic) the temporary is removed and the target keeps its
//! former content. Only a killed process can leave a temporary behind; [`sweep_temporaries`] removes those.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Component, Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

use flate2::CrcReader;
use serde::{Deserialize, Serialize};
use tempfile::TempPath;

use crate::error::{IoError, Result, is_full};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Durability {
    /// The process may die: the content is with the operating system.
    Process,
    /// The machine may lose power: the content is on the disk (fsync of file and folder).
    Power,
}

/// Makes the temporary names of one process distinct.
static SERIAL: AtomicU64 = AtomicU64::new(0);

/// Writes `target` through `fill`, all or nothing.
pub(crate) fn write_atomic(
    target: impl AsRef<Path>,
    durability: Durability,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<()> {
    let target = target.as_ref();
    let Some(name) = target.file_name() else {
        return Err(IoError::input(target, "the path names no file"));
    };
    let serial = SERIAL.fetch_add(1, Ordering::Relaxed);
    let mut hidden = OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}-{serial}.tmp", process::id()));
    let temporary = target.with_file_name(hidden);
    let replace = || -> io::Result<()> {
        let file = File::create(&temporary)?;
        // Removed when it is dropped, unless it has taken its place.
        let temporary = TempPath::try_from_path(&temporary)?;
        let mut buffer = BufWriter::with_capacity(1 << 18, file);
        fill(&mut buffer)?;
        let file = buffer.into_inner().map_err(|e| e.into_error())?;
        if durability == Durability::Power {
            file.sync_all()?;
        }
        // Without the handle the renaming succeeds on every platform.
        drop(file);
        temporary.persist(target).map_err(|e| e.error)?;
        if durability == Durability::Power {
            // Puts the renamed entry itself on the disk, where folders can be synced.
            let _ = File::open(folder_of(target)).and_then(|folder| folder.sync_all());
        }
        Ok(())
    };
    replace().map_err(|e| IoError::write(target, e))
}

/// Writes `target` with a content, all or nothing.
///
/// # Errors
/// If it cannot be written.
pub fn write_whole(target: impl AsRef<Path>, content: impl AsRef<[u8]>) -> Result<()> {
    write_atomic(target, Durability::Process, |file| {
        file.write_all(content.as_ref())
    })
}

/// Writes `value` to `path` as indented JSON with a final newline.
///
/// JSON has no NaN and no infinity: such numbers become `null`.
pub fn write_json(path: impl AsRef<Path>, value: &(impl Serialize + ?Sized)) -> Result<()> {
    let path = path.as_ref();
    let mut text = serde_json::to_vec_pretty(value).map_err(|e| IoError::Json(path.into(), e))?;
    text.push(b'\n');
    write_whole(path, text)
}

/// Removes temporaries that a killed process left in `folder` and in the folders directly below it; returns how many.
///
/// Call it when a run takes possession of its folder, not while another process writes there.
pub fn sweep_temporaries(folder: impl AsRef<Path>) -> Result<usize> {
    swept(folder.as_ref(), true)
}

/// Removes the temporaries of a folder, and of those in it if they are `below` it; their number.
fn swept(folder: &Path, below: bool) -> Result<usize> {
    let mut removed = 0;
    for entry in fs::read_dir(folder).map_err(|e| IoError::read(folder, e))? {
        let entry = entry.map_err(|e| IoError::read(folder, e))?;
        let Ok(kind) = entry.file_type() else {
            continue;
        };
        if kind.is_dir() && below {
            removed += swept(&entry.path(), false)?;
        } else if kind.is_file() && entry.file_name().to_str().is_some_and(is_temporary) {
            let path = entry.path();
            fs::remove_file(&path).map_err(|e| IoError::write(&path, e))?;
            removed += 1;
        }
    }
    Ok(removed)
}

/// True if `name` has the form `.NAME.PID-SERIAL.tmp`, or `.writable-PID` as earlier versions tried folders with.
fn is_temporary(name: &str) -> bool {
    let digits = |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
    if name.strip_prefix(".writable-").is_some_and(digits) {
        return true;
    }
    let hidden = name.strip_prefix('.');
    let rest = hidden.and_then(|rest| rest.strip_suffix(".tmp"));
    let mark = rest.and_then(|rest| rest.rsplit_once('.')?.1.split_once('-'));
    mark.is_some_and(|(pid, serial)| digits(pid) && digits(serial))
}

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
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
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

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let name = |e: io::Result<fs::DirEntry>| e.unwrap().file_name().into_string();
        entries.map(|e| name(e).unwrap()).collect()
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
        assert!(matches!(error, IoError::DiskFull(..)), "{error}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["a.json"]);
    }

    #[test]
    fn a_target_that_is_a_folder_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("taken");
        fs::create_dir(&path).unwrap();
        let error = write_whole(&path, b"x").unwrap_err();
        assert!(error.to_string().contains("taken"), "{error}");
        assert_eq!(names(folder.path()), ["taken"]);
        assert!(write_whole("..", b"x").is_err());
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

    #[test]
    fn written_values_are_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("summary.json");
        write_json(&path, &serde_json::json!({"steps": 12, "dt": 0.1})).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.ends_with("}\n") && text.contains("  \"steps\": 12"));
        let back: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(back["dt"], 0.1);
    }

    #[test]
    fn values_outside_json_leave_the_file_unchanged() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("summary.json");
        let odd = std::collections::BTreeMap::from([(vec![1], 1)]);
        let error = write_json(&path, &odd).unwrap_err();
        assert!(matches!(error, IoError::Json(..)));
        assert!(!path.exists());
    }

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
