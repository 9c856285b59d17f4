//! Files that a scene may name: those in its folder, and those that the user allows.
//!
//! A scene may be of an unknown author. Files that it names must lie in the folder of the scene file or below, also
//! when `..` and symbolic links are followed. The user who runs it may allow further folders (`--allow-path`),
//! and a path that stands on the command line itself (`--set wall.tank.file=…`) is the user's own.

use std::path::{Component, Path, PathBuf};

use thiserror::Error;

/// The remedy.
const ADVICE: &str =
    "allow its folder with `--allow-path DIR`, or give the path on the command line with `--set`";

/// A file that a scene must not name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PathProblem {
    /// The path is absolute.
    #[error("`{0}` is an absolute path: name files relative to the scene's folder, {advice}", advice = ADVICE)]
    Absolute(String),
    /// The path leaves the folder.
    #[error("`{0}` lies outside the folder of the file that names it: {advice}", advice = ADVICE)]
    Outside(String),
    /// A symbolic link leads out of the folder.
    #[error("`{0}` leads to `{1}`, outside the folder of the file that names it: {advice}", advice = ADVICE)]
    Link(String, String),
    /// There is no path.
    #[error("the name of the file is empty")]
    Empty,
}

/// The path of the file that a file in `folder` calls `named`; it lies in that folder or in one of the `allowed`.
///
/// Nothing is opened, but links are followed.
///
/// # Errors
/// If the path is empty or lies elsewhere.
pub fn within(folder: &Path, named: &str, allowed: &[PathBuf]) -> Result<PathBuf, PathProblem> {
    let path = joined(folder, named)?;
    let real = real(&path);
    let starts = |folder| real.as_ref().is_some_and(|real| real.starts_with(folder));
    let in_folder = |folder: &Path| real_folder(folder).is_some_and(starts);
    if allowed.iter().any(|folder| in_folder(folder)) {
        return Ok(path);
    }
    leaves(named)?;
    // A missing file leads nowhere.
    let leads = real_folder(folder).is_some() && !in_folder(folder);
    match real.filter(|_| leads) {
        Some(real) => Err(PathProblem::Link(named.into(), real.display().to_string())),
        None => Ok(path),
    }
}

/// The path of `named` seen from a folder, wherever it leads.
pub(crate) fn joined(folder: &Path, named: &str) -> Result<PathBuf, PathProblem> {
    match named.trim().is_empty() {
        true => Err(PathProblem::Empty),
        false => Ok(folder.join(named)),
    }
}

/// Refuses a path that is absolute or climbs above where it begins.
fn leaves(named: &str) -> Result<(), PathProblem> {
    let mut level = 0;
    for part in Path::new(named).components() {
        match part {
            Component::Prefix(_) | Component::RootDir => {
                return Err(PathProblem::Absolute(named.to_string()));
            }
            Component::CurDir => {}
            Component::ParentDir => level -= 1,
            Component::Normal(_) => level += 1,
        }
        if level < 0 {
            return Err(PathProblem::Outside(named.to_string()));
        }
    }
    Ok(())
}

/// Target of a path without links; of a missing file, the path that it would have.
fn real(path: &Path) -> Option<PathBuf> {
    let there = path.canonicalize().ok();
    there.or_else(|| Some(real_folder(path.parent()?)?.join(path.file_name()?)))
}

fn real_folder(folder: &Path) -> Option<PathBuf> {
    let unnamed = folder.as_os_str().is_empty();
    let folder = if unnamed { Path::new(".") } else { folder };
    folder.canonicalize().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// home/scenes/x.csv and home/data/y.csv, with a link from the first folder to the second.
    fn home() -> tempfile::TempDir {
        let home = tempfile::tempdir().unwrap();
        for file in ["scenes/sub/x.csv", "scenes/x.csv", "data/y.csv"] {
            let path = home.path().join(file);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, "0,1\n").unwrap();
        }
        home
    }

    #[test]
    fn a_scene_reaches_its_folder_and_no_further() {
        let home = home();
        let folder = home.path().join("scenes");
        let ok = |p: &str| within(&folder, p, &[]);
        for inside in ["x.csv", "sub/x.csv", "./sub/../x.csv", "not-there.csv"] {
            assert_eq!(ok(inside).unwrap(), folder.join(inside));
        }
        let outside = |p: &str| matches!(ok(p), Err(PathProblem::Outside(_)));
        assert!(outside("../data/y.csv") && outside("..") && outside("../scenes/x.csv"));
        assert!(outside("sub/../../data/y.csv") && outside("../../not-there"));
        assert!(matches!(ok("/etc/passwd"), Err(PathProblem::Absolute(_))));
        assert_eq!(ok(" "), Err(PathProblem::Empty));
        // Without a folder of its own a text has that of the process.
        assert!(within(Path::new(""), "data/x.csv", &[]).is_ok());
        assert!(within(Path::new("no/such/folder"), "data/x.csv", &[]).is_ok());
        assert!(within(Path::new(""), "../x.csv", &[]).is_err());
    }

    #[test]
    fn allowed_folders_are_reached_whole_and_alone() {
        let home = home();
        let folder = home.path().join("scenes");
        let allowed = [home.path().join("data")];
        let ok = |p: &str| within(&folder, p, &allowed).is_ok();
        let absolute = |p: &str| home.path().join(p).display().to_string();
        assert!(ok("../data/y.csv") && ok("../data/not-there.csv") && ok("x.csv"));
        assert!(ok(&absolute("data/y.csv")) && !ok(&absolute("other/y.csv")));
        assert!(!ok("../data/../y.csv") && !ok("../database.csv"));
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed() {
        use std::os::unix::fs::symlink;
        let home = home();
        let folder = home.path().join("scenes");
        symlink(home.path().join("data"), folder.join("data")).unwrap();
        symlink("/etc/passwd", folder.join("y.csv")).unwrap();
        symlink("x.csv", folder.join("same.csv")).unwrap();
        let ok = |p: &str| within(&folder, p, &[]);
        assert!(ok("same.csv").is_ok());
        for link in ["data/y.csv", "data/not-there.csv", "y.csv"] {
            let told = ok(link).unwrap_err().to_string();
            assert!(told.contains("leads to"), "{told}");
        }
        assert!(within(&folder, "data/y.csv", &[home.path().join("data")]).is_ok());
        // A scene that is itself reached by a link has the folder that it was called by.
        symlink(&folder, home.path().join("link")).unwrap();
        assert!(within(&home.path().join("link"), "x.csv", &[]).is_ok());
    }
}
