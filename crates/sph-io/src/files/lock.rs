//! One writer per folder.
//!
//! The lock is one of the operating system on the file `.lock`: it ends with the process that holds it, however that
//! ends, so that a stale one locks no folder. The content of the file names its holder.

use std::fmt::{self, Write as _};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde::{Deserialize, Serialize};

use crate::error::{IoError, Result};

const LOCK: &str = ".lock";
/// Longest content that is read of it, bytes.
const LONGEST: u64 = 4096;

/// The process that holds a folder.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Holder {
    /// Number of the process.
    pub pid: u32,
    /// Name of the computer.
    pub host: String,
    /// When it took the folder: date and time, UTC.
    pub since: String,
}

impl Holder {
    fn this_process() -> Self {
        let mut since = String::new();
        // A clock that is beyond the years of the format leaves it empty.
        let now = humantime::format_rfc3339_seconds(SystemTime::now());
        let _ = write!(since, "{now}");
        Holder {
            pid: std::process::id(),
            host: host(),
            since: since.replace('T', " ").replace('Z', " UTC"),
        }
    }
}

impl fmt::Display for Holder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Holder { pid, host, since } = self;
        write!(f, "process {pid} on {host} since {since}")
    }
}

/// A folder that no other holder of such a lock may write to, until this is dropped.
#[derive(Debug)]
pub struct FolderLock {
    path: PathBuf,
    /// `None` where the file system has no locks.
    file: Option<File>,
    before: Option<Holder>,
}

impl FolderLock {
    /// Takes a folder, which is created with its parents if need be.
    ///
    /// # Errors
    /// [`IoError::InUse`] if another run holds it; if the folder or the file in it cannot be made.
    pub fn take(folder: impl AsRef<Path>) -> Result<Self> {
        let folder = folder.as_ref();
        fs::create_dir_all(folder).map_err(|e| IoError::CreateFolder(folder.into(), e))?;
        Self::take_existing(folder)
    }

    /// As [`take`](Self::take), of a folder that another process may remove: it is not made again.
    pub(crate) fn take_existing(folder: &Path) -> Result<Self> {
        let path = folder.join(LOCK);
        let failed = |source| IoError::NotWritable(folder.into(), source);
        loop {
            let mut file = opened(&path).map_err(failed)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    let by = holder(&mut file).map_or("another process".into(), |h| h.to_string());
                    return Err(IoError::InUse(folder.into(), by));
                }
                Err(TryLockError::Error(e)) if e.kind() == io::ErrorKind::Unsupported => {
                    let (file, before) = (None, None);
                    return Ok(FolderLock { path, file, before });
                }
                Err(TryLockError::Error(e)) => return Err(failed(e)),
            }
            // The last holder may have removed the file between the opening and the lock.
            if !is_at(&file, &path) {
                continue;
            }
            let before = holder(&mut file);
            // A full disk is reported by the next write, with a better message.
            let _ = sign(&mut file);
            let file = Some(file);
            return Ok(FolderLock { path, file, before });
        }
    }

    /// The process that held it before and ended without giving it back.
    pub fn taken_over_from(&self) -> Option<&Holder> {
        self.before.as_ref()
    }

    /// True if others are locked out: some file systems have no locks.
    pub fn holds(&self) -> bool {
        self.file.is_some()
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        if let Some(file) = self.file.take() {
            // First the name, then the lock, so that no new file is removed.
            if is_at(&file, &self.path) {
                let _ = fs::remove_file(&self.path);
            }
        }
    }
}

/// The lock of a folder that a dead process left behind, taken; none if a living one holds it, or if there is none.
pub(crate) fn left(folder: &Path) -> Option<File> {
    let path = folder.join(LOCK);
    let known = fs::symlink_metadata(&path).ok()?;
    let file = known.is_file().then(|| File::open(&path).ok())??;
    file.try_lock().ok()?;
    is_at(&file, &path).then_some(file)
}

/// The file, made if it is not there; only a plain file is opened, no link and no pipe.
fn opened(path: &Path) -> io::Result<File> {
    if fs::symlink_metadata(path).is_ok_and(|known| !known.is_file()) {
        return Err(io::Error::other(format!("`{LOCK}` in it is not a file")));
    }
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(true).truncate(false);
    options.open(path)
}

/// True if the open file is still the one of that name.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |m: fs::Metadata| (m.dev(), m.ino());
    match (file.metadata(), fs::symlink_metadata(path)) {
        (Ok(open), Ok(named)) => id(open) == id(named),
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

fn holder(file: &mut File) -> Option<Holder> {
    let mut text = String::new();
    file.rewind().ok()?;
    file.take(LONGEST).read_to_string(&mut text).ok()?;
    serde_json::from_str(&text).ok()
}

fn sign(file: &mut File) -> io::Result<()> {
    file.set_len(0)?;
    file.rewind()?;
    serde_json::to_writer(&mut *file, &Holder::this_process())?;
    file.flush()
}

/// Name of this computer, as far as it is known without asking the network.
fn host() -> String {
    let files = ["/proc/sys/kernel/hostname", "/etc/hostname"];
    let told = files.iter().find_map(|f| fs::read_to_string(f).ok());
    let variables = ["COMPUTERNAME", "HOSTNAME"].into_iter();
    let told = told.or_else(|| variables.filter_map(|v| std::env::var(v).ok()).next());
    let name = told.as_deref().map_or("", str::trim);
    if name.is_empty() { "this host" } else { name }.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_is_refused_and_told_who_holds_it() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("a/b");
        let first = FolderLock::take(&out).unwrap();
        assert!(first.holds() && first.taken_over_from().is_none());
        let told = FolderLock::take(&out).unwrap_err();
        assert!(matches!(told, IoError::InUse(..)), "{told}");
        let told = told.to_string();
        let me = format!("process {} on {} since 20", std::process::id(), host());
        assert!(told.contains(&me) && told.contains("a/b"), "{told}");
        drop(first);
        let left = fs::read_dir(&out).unwrap().count();
        assert_eq!(left, 0, "and nothing is left");
        FolderLock::take(&out).unwrap();
    }

    #[test]
    fn files_of_a_dead_process_are_taken_over() {
        let folder = tempfile::tempdir().unwrap();
        let dead = Holder {
            pid: 1,
            host: "elsewhere".into(),
            since: "1970-01-01 00:00:00 UTC".into(),
        };
        let left = serde_json::to_string(&dead).unwrap();
        fs::write(folder.path().join(LOCK), left).unwrap();
        let lock = FolderLock::take(folder.path()).unwrap();
        assert_eq!(lock.taken_over_from(), Some(&dead));
        drop(lock);
        fs::write(folder.path().join(LOCK), "{\"pid\": \"half of it").unwrap();
        assert_eq!(FolderLock::take(folder.path()).unwrap().before, None);
    }

    #[test]
    fn one_of_many_who_come_at_once_has_it() {
        let folder = tempfile::tempdir().unwrap();
        let inside = std::sync::atomic::AtomicI32::new(0);
        let got = std::sync::atomic::AtomicI32::new(0);
        let come = || {
            use std::sync::atomic::Ordering::SeqCst;
            for _ in 0..200 {
                let Ok(lock) = FolderLock::take(folder.path()) else {
                    continue;
                };
                got.fetch_add(1, SeqCst);
                assert_eq!(inside.fetch_add(1, SeqCst), 0, "two have it");
                std::thread::yield_now();
                inside.fetch_sub(1, SeqCst);
                drop(lock);
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(come);
            }
        });
        assert!(got.into_inner() >= 4, "no thread had it");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_in_its_place_is_not_followed() {
        let folder = tempfile::tempdir().unwrap();
        let precious = folder.path().join("precious");
        fs::write(&precious, "kept").unwrap();
        let out = folder.path().join("out");
        fs::create_dir(&out).unwrap();
        std::os::unix::fs::symlink(&precious, out.join(LOCK)).unwrap();
        let told = FolderLock::take(&out).unwrap_err().to_string();
        assert!(told.contains("not a file"), "{told}");
        assert_eq!(fs::read_to_string(&precious).unwrap(), "kept");
    }
}
