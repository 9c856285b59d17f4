//! From the argument SCENE to a loaded scene.

use std::path::{Path, PathBuf};

use dem_pfv::scene::DiscreteElements;
use sph_io::Scratch;
use sph_particles::Particles;
use sph_run::Method;
use sph_scene::{Override, Source, read_text, within};
use sph_study::{Mistake, SceneText};

use crate::arguments::SceneArguments;
use crate::shipped;
use crate::shipped::{Content, Data};
use crate::terminal::Trouble;

/// A scene of one kind or the other, with its text.
pub enum AnyScene {
    /// Of particles.
    Particles(Box<sph_scene::Loaded>),
    /// Of grains.
    Grains(Box<dem_pfv::scene::Loaded>),
}

/// Reads a scene of either kind: the one place that distinguishes them.
pub fn read(source: Source) -> Result<AnyScene, Trouble> {
    let mistakes = |source: &Source, found: &[sph_scene::Diagnostic]| {
        Trouble::Scene(Mistake::located(source, found))
    };
    // Text that is no TOML is refused by the reader of particles.
    let table = source.table();
    if table.is_ok_and(|table| dem_pfv::scene::is_grain_scene(&table)) {
        let loaded = dem_pfv::scene::read(source);
        let loaded = loaded.map_err(|(source, found)| mistakes(&source, &found))?;
        return Ok(AnyScene::Grains(Box::new(loaded)));
    }
    let loaded = sph_scene::read(source);
    let loaded = loaded.map_err(|refused| mistakes(&refused.source, &refused.diagnostics))?;
    Ok(AnyScene::Particles(Box::new(loaded)))
}

impl AnyScene {
    /// Title, description and dimension.
    pub fn card(&self) -> (&str, Option<&str>, usize) {
        match self {
            AnyScene::Particles(loaded) => {
                let scene = &loaded.scene;
                (&scene.title, scene.description.as_deref(), scene.dimension)
            }
            AnyScene::Grains(loaded) => {
                (&loaded.scene.title, loaded.scene.description.as_deref(), 3)
            }
        }
    }
}

/// A scene ready for its solver, and the folder its data were unpacked to.
pub struct OpenScene {
    /// The scene with its text.
    pub scene: AnyScene,
    /// Name without folder and extension.
    pub stem: String,
    /// Name in messages: its file, or its name if it is compiled in.
    pub shown: String,
    /// Kept until the scene is done with.
    _unpacked: Option<Scratch>,
}

pub fn overrides(set: &[String]) -> Result<Vec<Override>, Trouble> {
    let parse = |text: &String| {
        Override::parse(text).map_err(|p| format!("--set {text}: {}", p.message).into())
    };
    set.iter().map(parse).collect()
}

/// The folders of `--allow-path`, which must be there.
pub fn allowed(folders: &[PathBuf]) -> Result<&[PathBuf], Trouble> {
    match folders.iter().find(|f| !f.is_dir()) {
        Some(gone) => {
            Err(format!("--allow-path {}: there is no such folder", gone.display()).into())
        }
        None => Ok(folders),
    }
}

/// Reads the scene, by its path or by the name of a shipped one.
///
/// # Errors
/// Mistakes of the scene with their places, or that there is none.
pub fn open(arguments: &SceneArguments) -> Result<OpenScene, Trouble> {
    let overrides = overrides(&arguments.set)?;
    let allowed = allowed(&arguments.allow_path)?;
    let set: Vec<&str> = arguments.set.iter().map(String::as_str).collect();
    let found = located(Path::new(&arguments.scene), &arguments.scene, Some(&set))?;
    Ok(OpenScene {
        scene: read(Source::new(&found.text, &found.file, &overrides).allowing(allowed))?,
        stem: found.name,
        shown: found.shown,
        _unpacked: found.unpacked,
    })
}

/// Reads a scene from a text; the files that it names are looked for in the folder of `file`.
///
/// # Errors
/// Mistakes of the scene with their places.
pub fn open_text(text: &str, file: &str, arguments: &SceneArguments) -> Result<OpenScene, Trouble> {
    let overrides = overrides(&arguments.set)?;
    Ok(OpenScene {
        scene: read(Source::new(text, file, &overrides).allowing(allowed(&arguments.allow_path)?))?,
        stem: stem(Path::new(file)).to_string(),
        shown: file.to_string(),
        _unpacked: None,
    })
}

/// A scene, and the folder that its data were unpacked to.
pub type FoundScene = (SceneText, Option<Scratch>);

/// Finds the scene that a study in a folder names: by its path from there, within that folder or an
/// allowed one, or by the name of a shipped one, beside which all shipped data lie as long as the folder is kept.
pub fn find(folder: &Path, scene: &str, allowed: &[PathBuf]) -> Result<FoundScene, String> {
    let path = within(folder, scene, allowed).map_err(|e| e.to_string())?;
    let found = located(&path, scene, None)?;
    let scene = SceneText {
        method: method(&found.text, &found.shown),
        name: found.name,
        text: found.text,
        file: found.file,
        allowed: allowed.to_vec(),
    };
    Ok((scene, found.unpacked))
}

/// The text of a scene, and the folder that its data were unpacked to.
struct Located {
    name: String,
    /// Name in messages: its file, or its name if it is compiled in.
    shown: String,
    /// The file by which it names its data.
    file: String,
    text: String,
    unpacked: Option<Scratch>,
}

/// The scene at a path, else the shipped one of a name, with the data that it or the texts `beside` it mention, or with
/// all.
fn located(path: &Path, scene: &str, beside: Option<&[&str]>) -> Result<Located, String> {
    // A pipe is as good as a file.
    let (name, content) = match path.exists() && !path.is_dir() {
        true => (stem(path).to_string(), Content::File(path.to_path_buf())),
        false => {
            let found = shipped::find(scene).ok_or_else(|| not_found(scene))?;
            (found.name, found.content)
        }
    };
    let (shown, file, text, unpacked) = match content {
        Content::File(file) => {
            let shown = file.display().to_string();
            let text = read_text(&file).map_err(|why| format!("cannot read `{shown}`: {why}"))?;
            (shown.clone(), shown, text, None)
        }
        Content::CompiledIn(text) => {
            let texts = beside.map(|beside| [&[text], beside].concat());
            let (file, unpacked) = unpacked(&name, &shipped::data_of(texts.as_deref()))?;
            (name.clone(), file, text.to_string(), unpacked)
        }
    };
    Ok(Located {
        name,
        shown,
        file,
        text,
        unpacked,
    })
}

/// Method that computes the scene of a text in a study; the name is for messages.
#[must_use]
pub fn method(text: &str, name: &str) -> &'static dyn Method {
    let table = Source::new(text, name, &[]).table();
    match table.is_ok_and(|table| dem_pfv::scene::is_grain_scene(&table)) {
        true => &DiscreteElements,
        false => &Particles,
    }
}

fn stem(path: &Path) -> &str {
    path.file_stem().and_then(|s| s.to_str()).unwrap_or("scene")
}

/// The file name by which a compiled-in scene names its data, put into a folder if it has any.
fn unpacked(name: &str, data: &[Data]) -> Result<(String, Option<Scratch>), String> {
    if data.is_empty() {
        return Ok((format!("{name}.toml"), None));
    }
    // A name that cannot be guessed, created here, for this user alone.
    let folder = Scratch::new(".sph-data-");
    let folder = folder.map_err(|e| format!("cannot put the data of `{name}` anywhere: {e}"))?;
    let file = folder.path().join(format!("{name}.toml"));
    shipped::unpack(data.iter().copied(), folder.path(), |f, data| {
        std::fs::write(f, data)
    })?;
    Ok((file.display().to_string(), Some(folder)))
}

fn not_found(scene: &str) -> String {
    let path = Path::new(scene);
    if path.is_dir() {
        return format!("`{scene}` is a folder, not a scene file");
    }
    let near = shipped::suggestion(scene.trim_end_matches(".toml"));
    format!(
        "there is no scene file `{scene}` and no shipped scene of that name{near} (`sph scenes` lists them)"
    )
}
