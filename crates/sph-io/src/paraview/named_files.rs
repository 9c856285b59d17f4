//! Files that a file of results names.

use std::path::{Component, Path, PathBuf};

use crate::error::{IoError, Result};

/// The path of a file that a list names; it stays in the folder of the list, links followed.
pub(crate) fn beside(list: &Path, file: &str) -> Result<PathBuf> {
    let path = list.with_file_name(file);
    let folder = list.parent().filter(|f| !f.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let within = |c| matches!(c, Component::Normal(_) | Component::CurDir);
    let named = Path::new(file).components().all(within);
    // A missing file leads nowhere.
    let real = (path.canonicalize(), folder.canonicalize());
    let leads = matches!(real, (Ok(real), Ok(folder)) if !real.starts_with(&folder));
    match named && !leads {
        true => Ok(path),
        false => Err(IoError::Unfit {
            path: list.to_path_buf(),
            problem: format!("it names `{file}`, which is outside its folder"),
        }),
    }
}
