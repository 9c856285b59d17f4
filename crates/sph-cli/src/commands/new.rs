//! `sph new`.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use sph_scene::{Source, named_files};

use crate::scene_file::method;
use crate::shipped::{self, Content};
use crate::terminal::{Trouble, console};

/// A dam break in a box, every line explained.
const TEMPLATE: &str = include_str!("../../templates/dam-break.toml");

pub fn command(name: &Path, from: Option<&str>) -> Result<(), Trouble> {
    let path = target(name)?;
    let (text, origin) = match from {
        None => (TEMPLATE.to_string(), None),
        Some(from) => origin(from)?,
    };
    write(&path, &text)?;
    console::out(&format!("wrote {}", path.display()));
    let folder = path.parent().unwrap_or(Path::new(""));
    for file in data(&text, origin.as_deref(), folder)? {
        console::out(&format!("wrote {}", file.display()));
    }
    let path = path.display();
    console::out(&format!("next: sph check {path}, then sph run {path}"));
    Ok(())
}

/// NAME.toml, whether the extension was given or not.
fn target(name: &Path) -> Result<PathBuf, Trouble> {
    if name.file_name().is_none() {
        return Err(format!("`{}` is no name for a scene", name.display()).into());
    }
    let mut full = name.as_os_str().to_os_string();
    if name.extension().is_none_or(|e| e != "toml") {
        full.push(".toml");
    }
    Ok(full.into())
}

/// The text to start from, and its folder if it is a file.
fn origin(from: &str) -> Result<(String, Option<PathBuf>), Trouble> {
    let file = match Path::new(from) {
        path if path.is_file() => path.to_path_buf(),
        _ => match shipped::find(from).map(|found| found.content) {
            Some(Content::File(file)) => file,
            Some(Content::CompiledIn(text)) => return Ok((text.to_string(), None)),
            None => {
                let near = shipped::suggestion(from);
                return Err(format!("there is no scene `{from}` to start from{near}").into());
            }
        },
    };
    let text = std::fs::read_to_string(&file);
    let text = text.map_err(|e| format!("cannot read {}: {e}", file.display()))?;
    Ok((text, file.parent().map(Path::to_path_buf)))
}

fn write(path: &Path, text: &str) -> Result<(), Trouble> {
    let created = OpenOptions::new().write(true).create_new(true).open(path);
    let written = created.and_then(|mut file| file.write_all(text.as_bytes()));
    let shown = path.display();
    Ok(written.map_err(|e| match e.kind() {
        ErrorKind::AlreadyExists => format!("{shown} exists already and is left as it is"),
        _ => format!("cannot write {shown}: {e}"),
    })?)
}

/// Brings the files along that the new scene names.
fn data(text: &str, origin: Option<&Path>, folder: &Path) -> Result<Vec<PathBuf>, Trouble> {
    let Some(origin) = origin else {
        let data = shipped::data_of(Some(&[text]));
        return Ok(shipped::unpack(data, folder, |f, data| {
            std::fs::write(f, data)
        })?);
    };
    let name = origin.join("scene.toml").display().to_string();
    let read = method(text, &name).read(Source::new(text, &name, &[]));
    let Ok(subject) = read else {
        return Ok(Vec::new());
    };
    let files = named_files(&subject.resolved());
    let path = |key, file| subject.source().resolve(key, file).ok();
    let placed = files
        .iter()
        .filter_map(|(key, file)| Some((file.as_str(), path(key, file)?)));
    copied(placed, folder)
}

/// Copies files, by the names that the scene has for them, into a folder; returns the new ones.
fn copied<'f>(
    files: impl Iterator<Item = (&'f str, PathBuf)>,
    folder: &Path,
) -> Result<Vec<PathBuf>, Trouble> {
    let files = files.filter(|(_, path)| path.is_file());
    let copy = |target: &Path, path: PathBuf| std::fs::copy(path, target).map(drop);
    Ok(shipped::unpack(files, folder, copy)?)
}
