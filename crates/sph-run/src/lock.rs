//! A run has its folder for itself.

use std::path::Path;

use sph_io::{FolderLock, IoError};

use crate::observer::Watch;

/// Takes the folder of a run until the lock is dropped; reports a folder that was left by a killed run.
///
/// # Errors
/// If another run holds it, or it cannot be made.
pub(crate) fn take(folder: &Path, observer: &mut Watch<'_>) -> Result<FolderLock, IoError> {
    let lock = FolderLock::take(folder)?;
    let out = folder.display();
    if let Some(dead) = lock.taken_over_from() {
        observer.message(&format!(
            "note: {dead} had {out} and is gone without giving it back; it is taken over"
        ));
    }
    if !lock.holds() {
        observer.message(&format!(
            "note: the file system of {out} has no locks; take care that no other run writes there"
        ));
    }
    Ok(lock)
}
