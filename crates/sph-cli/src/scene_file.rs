//! From the argument SCENE to a loaded scene.

use std::path::{Path, PathBuf};

use sph_core::suggestion;
use sph_scene::{Loaded, Override, load, parse, read_text};
use sph_study::SceneText;

use crate::arguments::SceneArguments;
use crate::diagnostics;
use crate::shipped::{self, Shipped};
use crate::trouble::Trouble;

/// A scene ready for the solver, and the folder its data were unpacked to.
pub struct Opened {
    /// The scene with its text.
    pub loaded: Loaded,
    /// Name without folder and extension.
    pub stem: String,
    /// Kept until the scene is done with.
    _unpacked: Option<Unpacked>,
}

/// A folder that disappears with its owner.
struct Unpacked(PathBuf);

impl Drop for Unpacked {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

impl Opened {
    /// What a checkpoint of this scene belongs to: the text and what was put on top, not the
    /// folder or the threads.
    pub fn identity(&self) -> String {
        let source = &self.loaded.source;
        let set = source
            .overrides()
            .iter()
            .map(|o| format!("\n--set {}", o.text()));
        std::iter::once(source.text().to_string())
            .chain(set)
            .collect()
    }
}

/// The values of `--set`.
pub fn overrides(set: &[String]) -> Result<Vec<Override>, Trouble> {
    let parse = |text: &String| {
        let parsed = Override::parse(text);
        parsed.map_err(|p| Trouble::usage(format!("--set {text}: {}", p.message)))
    };
    set.iter().map(parse).collect()
}

/// Reads the scene, by its path or by the name of a shipped one.
pub fn open(arguments: &SceneArguments) -> Result<Opened, Trouble> {
    let overrides = overrides(&arguments.set)?;
    let path = Path::new(&arguments.scene);
    // A pipe is as good as a file.
    if path.exists() && !path.is_dir() {
        return from_file(path, &overrides);
    }
    match shipped::find(&arguments.scene) {
        Some(Shipped {
            file: Some(file), ..
        }) => from_file(&file, &overrides),
        Some(Shipped {
            name,
            text: Some(text),
            ..
        }) => compiled_in(&name, text, &overrides),
        _ => Err(Trouble::Usage(not_found(&arguments.scene))),
    }
}

/// A scene's text, found but not yet read as one; its data disappear with it.
pub struct Found {
    /// Name, text and file.
    pub scene: SceneText,
    _unpacked: Option<Unpacked>,
}

/// Finds a scene by its path from a folder, or by the name of a shipped one.
pub fn find(folder: &Path, scene: &str) -> Result<Found, String> {
    let path = folder.join(scene);
    let file = match path.exists() && !path.is_dir() {
        true => Some(path),
        false => None,
    };
    let shipped = || shipped::find(scene).ok_or_else(|| not_found(scene));
    let (name, file, text) = match file {
        Some(file) => (stem(&file).to_string(), Some(file), None),
        None => shipped().map(|s| (s.name, s.file, s.text))?,
    };
    match (file, text) {
        (Some(file), _) => {
            let shown = file.display().to_string();
            let text = read_text(&file).map_err(|why| format!("cannot read `{shown}`: {why}"))?;
            let file = shown;
            Ok(Found {
                scene: SceneText { name, text, file },
                _unpacked: None,
            })
        }
        (None, text) => {
            let text = text.unwrap_or_default().to_string();
            let (file, unpacked) = unpacked(&name, &text)?;
            Ok(Found {
                scene: SceneText { name, text, file },
                _unpacked: unpacked,
            })
        }
    }
}

fn stem(path: &Path) -> &str {
    path.file_stem().and_then(|s| s.to_str()).unwrap_or("scene")
}

fn from_file(path: &Path, overrides: &[Override]) -> Result<Opened, Trouble> {
    Ok(Opened {
        loaded: load(path, overrides)?,
        stem: stem(path).to_string(),
        _unpacked: None,
    })
}

/// A scene in the program; the data it is compared with are put where it can read them.
fn compiled_in(name: &str, text: &str, overrides: &[Override]) -> Result<Opened, Trouble> {
    let (file, unpacked) = unpacked(name, text).map_err(Trouble::Usage)?;
    let loaded = parse(text, &file, overrides).map_err(|refused| {
        Trouble::Scene(diagnostics::located(&refused.source, &refused.diagnostics))
    })?;
    Ok(Opened {
        loaded,
        stem: name.to_string(),
        _unpacked: unpacked,
    })
}

/// The file name by which a compiled-in scene names its data, put into a folder if it has any.
fn unpacked(name: &str, text: &str) -> Result<(String, Option<Unpacked>), String> {
    if shipped::data_of(text).next().is_none() {
        return Ok((format!("{name}.toml"), None));
    }
    let folder = std::env::temp_dir().join(format!("sph-{name}-{}", std::process::id()));
    let file = folder.join(format!("{name}.toml")).display().to_string();
    shipped::unpack_data(text, &folder)?;
    Ok((file, Some(Unpacked(folder))))
}

fn not_found(scene: &str) -> String {
    let path = Path::new(scene);
    if path.is_dir() {
        return format!("`{scene}` is a folder, not a scene file");
    }
    let shipped = shipped::all();
    let stem = scene.trim_end_matches(".toml");
    let near = suggestion(stem, shipped.iter().map(|s| s.name.as_str()));
    format!(
        "there is no scene file `{scene}` and no shipped scene of that name{near} (`sph scenes` \
         lists them)"
    )
}
