//! `sph new`.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use sph_scene::Source;

use crate::arguments::NewArguments;
use crate::scene_file::{self, AnyScene};
use crate::shipped::{self, Content};
use crate::terminal::console;
use crate::terminal::trouble::Trouble;

/// A dam break in a box, every line explained.
const TEMPLATE: &str = include_str!("../../templates/dam-break.toml");

/// Writes a scene to start from.
pub fn command(arguments: &NewArguments) -> Result<(), Trouble> {
    let path = target(&arguments.name)?;
    let (text, origin) = match &arguments.from {
        None => (TEMPLATE.to_string(), None),
        Some(from) => origin(from)?,
    };
    write(&path, &text)?;
    console::out(&format!("wrote {}", path.display()));
    let folder = path.parent().unwrap_or(Path::new(""));
    for file in data(&text, origin.as_deref(), folder)? {
        console::out(&format!("wrote {}", file.display()));
    }
    console::out(&format!(
        "next: sph check {0}, then sph run {0}",
        path.display()
    ));
    Ok(())
}

/// NAME.toml, whether the extension was given or not.
fn target(name: &Path) -> Result<PathBuf, Trouble> {
    if name.file_name().is_none() {
        return Err(Trouble::usage(format!(
            "`{}` is no name for a scene",
            name.display()
        )));
    }
    match name.extension().is_some_and(|e| e == "toml") {
        true => Ok(name.to_path_buf()),
        false => {
            let mut full = name.as_os_str().to_os_string();
            full.push(".toml");
            Ok(full.into())
        }
    }
}

/// The text to start from, and its folder if it is a file.
fn origin(from: &str) -> Result<(String, Option<PathBuf>), Trouble> {
    let file = match Path::new(from) {
        path if path.is_file() => path.to_path_buf(),
        _ => match shipped::find(from).map(|found| found.content) {
            Some(Content::File(file)) => file,
            Some(Content::CompiledIn(text)) => return Ok((text.to_string(), None)),
            None => {
                let all = shipped::all();
                let near = sph_core::suggestion(from, all.iter().map(|s| s.name.as_str()));
                let message = format!("there is no scene `{from}` to start from{near}");
                return Err(Trouble::usage(message));
            }
        },
    };
    let text = std::fs::read_to_string(&file);
    let text = text.map_err(|e| Trouble::usage(format!("cannot read {}: {e}", file.display())))?;
    Ok((text, file.parent().map(Path::to_path_buf)))
}

fn write(path: &Path, text: &str) -> Result<(), Trouble> {
    let created = OpenOptions::new().write(true).create_new(true).open(path);
    let written = created.and_then(|mut file| file.write_all(text.as_bytes()));
    written.map_err(|e| {
        Trouble::usage(match e.kind() {
            ErrorKind::AlreadyExists => {
                format!("{} exists already and is left as it is", path.display())
            }
            _ => format!("cannot write {}: {e}", path.display()),
        })
    })
}

/// Brings the data files along that the new scene is compared with.
fn data(text: &str, origin: Option<&Path>, folder: &Path) -> Result<Vec<PathBuf>, Trouble> {
    let Some(origin) = origin else {
        return shipped::unpack(shipped::data_of(&[text]), folder).map_err(Trouble::Usage);
    };
    let name = origin.join("scene.toml").display().to_string();
    let loaded = match scene_file::read(Source::new(text, &name, &[])) {
        Ok(AnyScene::Particles(loaded)) => loaded,
        Ok(AnyScene::Grains(loaded)) => {
            let files = loaded.files();
            let placed = files.iter().filter_map(|(key, file)| {
                let path = loaded.source.resolve(key, file).ok()?;
                Some((file.clone(), path))
            });
            return copied(placed.collect(), folder);
        }
        Err(_) => return Ok(Vec::new()),
    };
    let scene = &loaded.scene;
    let references = scene.reference.values();
    let references = references.filter_map(|r| Some((r.file.as_deref()?, r.path.as_ref()?)));
    let probes = scene.probe_files.iter().filter_map(|(name, path)| {
        let table = scene.probe.get(name).or_else(|| scene.gauge.get(name))?;
        Some((table.get("file")?.as_str()?, path))
    });
    let all = references.chain(probes);
    let all = all.map(|(file, path)| (file.to_string(), path.clone()));
    copied(all.collect(), folder)
}

/// Copies files, by the names that the scene has for them, into a folder; returns the new ones.
fn copied(files: Vec<(String, PathBuf)>, folder: &Path) -> Result<Vec<PathBuf>, Trouble> {
    let mut copied = Vec::new();
    for (file, path) in files {
        let target = folder.join(file);
        if target.exists() || !path.is_file() {
            continue;
        }
        let told = |e| Trouble::usage(format!("cannot write {}: {e}", target.display()));
        if let Some(parent) = target.parent() {
            std::fs::create_dir_all(parent).map_err(told)?;
        }
        std::fs::copy(&path, &target).map_err(told)?;
        copied.push(target);
    }
    Ok(copied)
}
