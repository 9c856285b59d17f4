//! From the argument SCENE to a loaded scene.

use std::path::{Path, PathBuf};

use sph_core::suggestion;
use sph_scene::{Loaded, Override, load, parse};

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

/// Reads the scene, by its path or by the name of a shipped one.
pub fn open(arguments: &SceneArguments) -> Result<Opened, Trouble> {
    let mut overrides = Vec::new();
    for text in &arguments.set {
        let parsed = Override::parse(text);
        overrides.push(parsed.map_err(|p| Trouble::usage(format!("--set {text}: {}", p.message)))?);
    }
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
        _ => Err(not_found(&arguments.scene)),
    }
}

fn from_file(path: &Path, overrides: &[Override]) -> Result<Opened, Trouble> {
    let stem = path.file_stem().and_then(|s| s.to_str()).unwrap_or("scene");
    Ok(Opened {
        loaded: load(path, overrides)?,
        stem: stem.to_string(),
        _unpacked: None,
    })
}

/// A scene in the program; the data it is compared with are put where it can read them.
fn compiled_in(name: &str, text: &str, overrides: &[Override]) -> Result<Opened, Trouble> {
    let mut unpacked = None;
    let mut file = format!("{name}.toml");
    if shipped::data_of(text).next().is_some() {
        let folder = std::env::temp_dir().join(format!("sph-{name}-{}", std::process::id()));
        file = folder.join(file).display().to_string();
        shipped::unpack_data(text, &folder).map_err(Trouble::Usage)?;
        unpacked = Some(Unpacked(folder));
    }
    let loaded = parse(text, &file, overrides).map_err(|refused| {
        Trouble::Scene(diagnostics::located(&refused.source, &refused.diagnostics))
    })?;
    Ok(Opened {
        loaded,
        stem: name.to_string(),
        _unpacked: unpacked,
    })
}

fn not_found(scene: &str) -> Trouble {
    let path = Path::new(scene);
    if path.is_dir() {
        return Trouble::usage(format!("`{scene}` is a folder, not a scene file"));
    }
    let shipped = shipped::all();
    let stem = scene.trim_end_matches(".toml");
    let near = suggestion(stem, shipped.iter().map(|s| s.name.as_str()));
    Trouble::usage(format!(
        "there is no scene file `{scene}` and no shipped scene of that name{near} (`sph scenes` \
         lists them)"
    ))
}
