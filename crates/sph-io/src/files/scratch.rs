//! Folders for temporary files of a process.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::error::{IoError, Result};
use crate::files::lock::{FolderLock, left};

/// A folder in the system's temporary place, of a name that cannot be guessed, for this user alone; it goes with
/// its owner. The folder of a killed process is removed by the next one that makes such a folder.
#[derive(Debug)]
pub struct Scratch {
    // Given back before the folder goes.
    _lock: FolderLock,
    folder: TempDir,
}

impl Scratch {
    /// Makes a folder whose name begins with `prefix`, after those of dead processes have been removed.
    ///
    /// # Errors
    /// If it cannot be made.
    pub fn new(prefix: &str) -> Result<Self> {
        Self::create_in(&std::env::temp_dir(), prefix)
    }

    fn create_in(place: &Path, prefix: &str) -> Result<Self> {
        let failed = |source| IoError::CreateFolder(place.into(), source);
        // Never one that exists: the library tries other names then.
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        let builder = {
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(fs::Permissions::from_mode(0o700))
        };
        let mut tries = 0;
        let (lock, folder) = loop {
            let folder = builder.prefix(prefix).tempdir_in(place).map_err(failed)?;
            match FolderLock::take_existing(folder.path()) {
                Ok(lock) => break (lock, folder),
                // Another process swept it before it was held, or holds it to sweep it.
                Err(IoError::InUse(..)) if tries < TRIES => tries += 1,
                Err(_) if tries < TRIES && !folder.path().exists() => tries += 1,
                Err(e) => return Err(e),
            }
        };
        sweep(place, prefix, folder.path());
        let _lock = lock;
        Ok(Scratch { _lock, folder })
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}

/// Folders that are made anew when others sweep them away before they are held.
const TRIES: usize = 100;

/// Removes folders of the prefix whose process is dead; folders that cannot be removed stay.
///
/// A process may die between the making of its folder and that of the lock in it: an empty folder goes too. Its
/// owner may live and be about to hold it; then it makes another.
fn sweep(place: &Path, prefix: &str, own: &Path) {
    let entries = fs::read_dir(place).into_iter().flatten().flatten();
    let named = entries.filter(|e| e.file_name().to_string_lossy().starts_with(prefix));
    // No links: they may lead to files of other users.
    let folders = named.filter(|e| e.file_type().is_ok_and(|t| t.is_dir()));
    let others = folders.map(|e| e.path()).filter(|path| path != own);
    let dead: Vec<PathBuf> = others.filter(|path| is_ours(path, own)).collect();
    for path in dead {
        // It is held while it goes, so that no two remove it, and under another name, so that no process that is about
        // to hold it puts a new lock into it.
        if let Some(_lock) = left(&path) {
            let dead = path.with_extension("dead");
            if fs::rename(&path, &dead).is_ok() {
                let _ = fs::remove_dir_all(&dead);
            }
        } else {
            // Nothing happens unless it is empty.
            let _ = fs::remove_dir(&path);
        }
    }
}

/// True if a folder has the same owner as our own.
#[cfg(unix)]
fn is_ours(path: &Path, own: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let owner = |p: &Path| fs::symlink_metadata(p).map(|m| m.uid()).ok();
    owner(path).is_some_and(|uid| Some(uid) == owner(own))
}

#[cfg(not(unix))]
fn is_ours(_: &Path, _: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_of_dead_processes_go_and_those_of_running_ones_stay() {
        let place = tempfile::tempdir().unwrap();
        let at = |name: &str| place.path().join(name);
        let dead = at(".sph-data-dead");
        fs::create_dir_all(dead.join("below")).unwrap();
        fs::write(dead.join(".lock"), "{}").unwrap();
        let died_at_once = at(".sph-data-empty");
        fs::create_dir(&died_at_once).unwrap();
        // A folder with files and no lock belongs to another program; so does one of another name.
        for other in [".sph-data-other", "results"] {
            fs::create_dir(at(other)).unwrap();
        }
        fs::write(at(".sph-data-other").join("mine"), "kept").unwrap();
        fs::write(at("results").join(".lock"), "{}").unwrap();
        let held = Scratch::create_in(place.path(), ".sph-data-").unwrap();
        assert!(!dead.exists() && !died_at_once.exists());
        let second = Scratch::create_in(place.path(), ".sph-data-").unwrap();
        assert!(held.path() != second.path() && held.path().exists());
        assert!(at(".sph-data-other/mine").exists() && at("results/.lock").exists());
        let paths = [&held, &second].map(|scratch| scratch.path().to_path_buf());
        drop((second, held));
        assert!(paths.iter().all(|path| !path.exists()));
    }

    #[test]
    fn many_at_once_sweep_and_each_has_its_own() {
        let place = tempfile::tempdir().unwrap();
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    for _ in 0..200 {
                        let made = Scratch::create_in(place.path(), ".sph-data-").unwrap();
                        fs::write(made.path().join("data"), "kept").unwrap();
                        std::thread::yield_now();
                        assert!(made.path().join("data").exists());
                    }
                });
            }
        });
        assert_eq!(fs::read_dir(place.path()).unwrap().count(), 0);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_not_followed_and_nobody_else_may_look_in() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let (place, victim) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        fs::write(victim.path().join(".lock"), "{}").unwrap();
        symlink(victim.path(), place.path().join(".sph-data-link")).unwrap();
        let made = Scratch::create_in(place.path(), ".sph-data-").unwrap();
        assert!(victim.path().join(".lock").exists());
        let mode = fs::metadata(made.path()).unwrap().permissions().mode();
        assert_eq!(mode & 0o077, 0, "{mode:o}");
    }
}
