//! The commands as functions: they write the files that the commands write, print nothing, and return the printed text.
//!
//! ```no_run
//! use sph_cli::library::{Request, check, open};
//!
//! let scene = open("dam-break-koshizuka", &Request::default()).map_err(|t| t.text(false))?;
//! let told = check(&scene, Some(4)).map_err(|t| t.text(false))?;
//! println!("{}: {} particles", told.text, told.json["particles"]);
//! # Ok::<(), String>(())
//! ```

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use sph_run::Watch;

use crate::arguments::{RunArguments, SceneArguments, StudyArguments};
use crate::commands::{run as runs, study as studies};
use crate::scene_file;

pub use crate::app::command_line;
pub use crate::commands::check::output as check;
pub use crate::commands::compare::output as compare;
pub use crate::commands::explain::output as explain;
pub use crate::commands::study::Studied;
pub use crate::scene_file::{AnyScene, OpenScene};
pub use crate::terminal::output::{CommandOutput, Ended};
pub use crate::terminal::trouble::Trouble;
pub use sph_run::Start;
/// A scene of particles.
pub use sph_scene::Scene as ParticleScene;

/// Companions of a scene.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// Values put on top of the scene: `numerics.spacing=0.01`.
    pub set: Vec<String>,
    /// Folders beside its own in which the scene may name files.
    pub allow_path: Vec<PathBuf>,
}

impl Request {
    fn scene_arguments(&self, scene: &str) -> SceneArguments {
        SceneArguments {
            scene: scene.to_string(),
            set: self.set.clone(),
            allow_path: self.allow_path.clone(),
        }
    }
}

/// Reads a scene, by its path or by the name of a shipped one.
///
/// # Errors
/// Mistakes of the scene with their places, or that there is none.
pub fn open(scene: &str, request: &Request) -> Result<OpenScene, Trouble> {
    scene_file::open(&request.scene_arguments(scene))
}

/// Reads a scene from a text; the files that it names are looked for in the folder of `file`.
///
/// # Errors
/// Mistakes of the scene with their places.
pub fn open_text(text: &str, file: &str, request: &Request) -> Result<OpenScene, Trouble> {
    scene_file::open_text(text, file, &request.scene_arguments(file))
}

/// Runs a scene into a folder; `None` is `results/NAME`. The folder is returned as well. It may start from the folder of
/// another run or from its checkpoint.
///
/// # Errors
/// A folder that cannot be used, a scene that cannot be assembled, a run that failed.
pub fn run(
    opened: &OpenScene,
    request: &Request,
    (out, threads, start): (Option<PathBuf>, Option<u16>, Start),
    observer: &mut Watch<'_>,
) -> Result<(Ended, PathBuf), Trouble> {
    let file = match &opened.scene {
        AnyScene::Particles(loaded) => &loaded.source.file,
        AnyScene::Grains(loaded) => &loaded.source.file,
    };
    let arguments = RunArguments {
        scene: request.scene_arguments(file),
        out,
        threads,
        ranks: None,
        resume: start.goes_on(),
        changed: start == Start::Changed,
        from: match start {
            Start::From(other) => Some(other),
            _ => None,
        },
        json: false,
        quiet: true,
    };
    let folder = runs::folder(&arguments, opened);
    Ok((runs::execute(&arguments, opened, observer)?, folder))
}

/// Runs a study, by its path or by the name of a shipped one, until it is done or the flag is raised. Unless it is
/// `quiet`, it reports its progress on stderr.
///
/// # Errors
/// Mistakes of the study or its scenes with their places, files that cannot be written.
pub fn study(
    study: &str,
    request: &Request,
    options: &StudyOptions,
    stop: Arc<AtomicBool>,
) -> Result<Studied, Trouble> {
    let arguments = StudyArguments {
        study: Some(study.to_string()),
        out: options.out.clone(),
        threads: options.threads,
        only: options.only.clone(),
        set: request.set.clone(),
        allow_path: request.allow_path.clone(),
        fresh: options.fresh,
        compare: Vec::new(),
        json: false,
        quiet: options.quiet,
    };
    studies::conduct(&arguments, stop)
}

/// Options of a study.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct StudyOptions {
    /// Folder of the results; `None` is `results/studies/NAME`.
    pub out: Option<PathBuf>,
    /// Threads; `None` for all cores.
    pub threads: Option<u16>,
    /// Patterns of the names of the variants that are wanted; none for all.
    pub only: Vec<String>,
    /// True if finished variants run again.
    pub fresh: bool,
    /// True if it is silent.
    pub quiet: bool,
}
