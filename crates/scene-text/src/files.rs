//! Files of scenes: their texts, and the files that they may name, those in its folder and those that the user allows.
//!
//! A scene may be of an unknown author. Files that it names must lie in the folder of the scene file or below, also
//! when `..` and symbolic links are followed. The user who runs it may allow further folders (`--allow-path`),
//! and a path that stands on the command line itself (`--set wall.tank.file=…`) is the user's own.

use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use toml::{Table, Value};

use crate::diagnostic::line_and_column;

/// The remedy.
const ADVICE: &str =
    "allow its folder with `--allow-path DIR`, or give the path on the command line with `--set`";

/// The path of the file that a file in `folder` calls `named`; it lies in that folder or in one of the `allowed`.
///
/// Nothing is opened, but links are followed.
///
/// # Errors
/// If the path is empty or lies elsewhere.
pub fn within(folder: &Path, named: &str, allowed: &[PathBuf]) -> Result<PathBuf, String> {
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
        Some(real) => Err(format!(
            "`{named}` leads to `{}`, outside the folder of the file that names it: {ADVICE}",
            real.display()
        )),
        None => Ok(path),
    }
}

/// The path of `named` seen from a folder, wherever it leads.
pub(crate) fn joined(folder: &Path, named: &str) -> Result<PathBuf, String> {
    match named.trim().is_empty() {
        true => Err("the name of the file is empty".into()),
        false => Ok(folder.join(named)),
    }
}

/// Refuses a path that is absolute or climbs above where it begins.
fn leaves(named: &str) -> Result<(), String> {
    let mut level = 0;
    for part in Path::new(named).components() {
        match part {
            Component::Prefix(_) | Component::RootDir => {
                let relative = "name files relative to the scene's folder";
                return Err(format!(
                    "`{named}` is an absolute path: {relative}, {ADVICE}"
                ));
            }
            Component::CurDir => {}
            Component::ParentDir => level -= 1,
            Component::Normal(_) => level += 1,
        }
        if level < 0 {
            let outside = "lies outside the folder of the file that names it";
            return Err(format!("`{named}` {outside}: {ADVICE}"));
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

/// Every key `file` with the file that it names, wherever it stands, in the order of the keys.
pub fn named_files(scene: &Table) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for (key, value) in scene {
        collect(value, key, key, &mut found);
    }
    found
}

fn collect(value: &Value, key: &str, path: &str, found: &mut Vec<(String, String)>) {
    match value {
        Value::String(file) if key == "file" => found.push((path.to_string(), file.clone())),
        Value::Table(table) => {
            for (key, value) in table {
                collect(value, key, &format!("{path}.{key}"), found);
            }
        }
        Value::Array(items) => {
            for (k, item) in items.iter().enumerate() {
                collect(item, "", &format!("{path}[{k}]"), found);
            }
        }
        _ => {}
    }
}

/// Longest scene file, bytes.
pub(crate) const FILE_BYTES: usize = 4 << 20;

/// True if a path is that of an open file of this process: `/dev/stdin`, or `<(command)` of a shell. Opening another
/// pipe blocks until a writer opens it.
fn is_given(path: &Path) -> bool {
    let open = ["/dev/stdin", "/dev/fd", "/proc/self/fd"];
    open.iter().any(|p| path.starts_with(p))
}

/// Reads a file of the size that a scene may have.
///
/// # Errors
/// The reason of the system; too long; no text.
pub fn read_text(path: &Path) -> Result<String, String> {
    let known = std::fs::metadata(path).map_err(|e| e.to_string())?;
    if !known.is_file() && !is_given(path) {
        return Err("it is not a file (a pipe of the shell or /dev/stdin is taken as well)".into());
    }
    let file = File::open(path).map_err(|e| e.to_string())?;
    let mut bytes = Vec::new();
    let read = file.take(FILE_BYTES as u64 + 1).read_to_end(&mut bytes);
    read.map_err(|e| e.to_string())?;
    if bytes.len() > FILE_BYTES {
        return Err(format!("it is longer than {} MiB", FILE_BYTES >> 20));
    }
    decoded(bytes).map_err(|(at, line, column)| {
        format!("byte {at}, in line {line}, is not UTF-8 text (column {column})")
    })
}

/// The text of some bytes.
///
/// # Errors
/// The number of the first byte that is not UTF-8, and its line and column.
pub fn decoded(bytes: Vec<u8>) -> Result<String, (usize, usize, usize)> {
    String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&e.as_bytes()[..at]);
        let (line, column) = line_and_column(&before, at);
        (at, line, column)
    })
}

/// The bytes of a plain file that is neither empty nor longer than `most` bytes.
///
/// # Errors
/// The name of the file and its fault.
pub fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    let name = path.display();
    let refused = |e: std::io::Error| format!("cannot read `{name}`: {e}");
    // Asked before it is opened: opening a pipe would wait for its writer.
    let known = std::fs::metadata(path).map_err(refused)?;
    if !known.is_file() {
        return Err(format!("`{name}` is not a file"));
    }
    let length = match known.len() {
        0 => return Err(format!("`{name}` is empty")),
        n if n > most => return Err(format!("`{name}` is longer than {} MiB", most >> 20)),
        n => n,
    };
    let mut bytes = Vec::with_capacity(length as usize);
    let file = File::open(path).map_err(refused)?;
    file.take(most).read_to_end(&mut bytes).map_err(refused)?;
    Ok(bytes)
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
        let told = |p: &str| ok(p).unwrap_err();
        let outside = |p: &str| told(p).contains("lies outside");
        assert!(outside("../data/y.csv") && outside("..") && outside("../scenes/x.csv"));
        assert!(outside("sub/../../data/y.csv") && outside("../../not-there"));
        assert!(told("/etc/passwd").contains("absolute") && told(" ").contains("empty"));
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
            let told = ok(link).unwrap_err();
            assert!(told.contains("leads to"), "{told}");
        }
        assert!(within(&folder, "data/y.csv", &[home.path().join("data")]).is_ok());
        // A scene that is itself reached by a link has the folder that it was called by.
        symlink(&folder, home.path().join("link")).unwrap();
        assert!(within(&home.path().join("link"), "x.csv", &[]).is_ok());
    }

    #[test]
    fn files_are_found_wherever_they_are_named() {
        let scene = "reference.a.file = 'a.csv'\n[wall.w]\nmotion.translate = [{ file = 'b.csv' }]";
        let found = named_files(&toml::from_str(scene).unwrap());
        let found: Vec<_> = found.into_iter().map(|(k, f)| format!("{k}={f}")).collect();
        let moved = "wall.w.motion.translate[0].file=b.csv";
        assert_eq!(found, ["reference.a.file=a.csv", moved]);
    }
}
