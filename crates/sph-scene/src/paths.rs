//! Which files a scene may name.

use std::path::{Component, Path, PathBuf};

use thiserror::Error;

/// A file that a scene must not name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum PathProblem {
    /// The path is absolute.
    #[error(
        "`{0}` is an absolute path; name files relative to the scene, or give the path with --set"
    )]
    Absolute(String),
    /// The path leaves the parent of the scene's folder.
    #[error("`{0}` lies outside the parent of the scene's folder")]
    Outside(String),
    /// There is no path.
    #[error("the name of the file is empty")]
    Empty,
}

/// The path of `named` for a scene in `scene_file`.
pub(crate) fn resolve(
    scene_file: &str,
    named: &str,
    absolute_allowed: bool,
) -> Result<PathBuf, PathProblem> {
    if named.trim().is_empty() {
        return Err(PathProblem::Empty);
    }
    let path = Path::new(named);
    let mut level = 0;
    for part in path.components() {
        match part {
            Component::Prefix(_) | Component::RootDir if absolute_allowed => {
                return Ok(path.to_path_buf());
            }
            Component::Prefix(_) | Component::RootDir => {
                return Err(PathProblem::Absolute(named.to_string()));
            }
            Component::CurDir => {}
            Component::ParentDir => level -= 1,
            Component::Normal(_) => level += 1,
        }
        if level < -1 {
            return Err(PathProblem::Outside(named.to_string()));
        }
    }
    let folder = Path::new(scene_file).parent().unwrap_or(Path::new(""));
    Ok(folder.join(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_reaches_its_folder_and_the_parent_and_no_further() {
        let ok = |p: &str| resolve("scenes/x.toml", p, false).map(|p| p.display().to_string());
        assert_eq!(ok("data/x.csv").unwrap(), "scenes/data/x.csv");
        assert_eq!(ok("../data/x.csv").unwrap(), "scenes/../data/x.csv");
        assert!(matches!(ok("../../x.csv"), Err(PathProblem::Outside(_))));
        assert!(matches!(
            ok("a/../../../x.csv"),
            Err(PathProblem::Outside(_))
        ));
        assert!(matches!(ok("/etc/passwd"), Err(PathProblem::Absolute(_))));
        assert_eq!(ok(" "), Err(PathProblem::Empty));
        assert!(resolve("scenes/x.toml", "/data/x.csv", true).is_ok());
    }
}
