//! `sph run`.

use std::path::{Path, PathBuf};

use serde::Serialize;
use sph_particles::{RunError, identity, run, run_on_threads, run_part};
use sph_run::{CHECKPOINT, Identity, RunOptions, Start, Status, Watch};
use sph_scene::{Loaded, Source};

use crate::arguments::RunArguments;
use crate::commands::file_list::read_summary;
use crate::commands::{grains, outcome};
use crate::scene_file::{AnyScene, OpenScene, open};
use crate::terminal::progress::Watcher;
use crate::terminal::{CommandOutput, Ended, ModelError, Trouble, shell};
use crate::{interrupt, ranks};

pub fn command(arguments: &RunArguments) -> Result<(), Trouble> {
    let opened = open(&arguments.scene)?;
    let out = folder(arguments, &opened);
    let start = format!("{}: running into {}", opened.scene.card().0, out.display());
    let noun = match opened.scene {
        AnyScene::Particles(_) => "particle",
        AnyScene::Grains(_) => "grain",
    };
    let quiet = arguments.quiet || !ranks::is_first();
    let mut watcher = Watcher::new(quiet, start, noun, interrupt::flag());
    let ended = execute(arguments, &opened, &mut watcher);
    watcher.finish();
    let ended = ended?;
    match ranks::is_first() {
        true => ended.conclude(arguments.json, arguments.quiet),
        false => Ok(()),
    }
}

/// The folder of the results: `results/NAME` if none is given.
pub fn folder(arguments: &RunArguments, opened: &OpenScene) -> PathBuf {
    let out = arguments.out.clone();
    out.unwrap_or_else(|| Path::new("results").join(&opened.stem))
}

/// Runs an opened scene, of particles or of grains, without output of its own.
///
/// # Errors
/// A folder that cannot be used, a scene that cannot be assembled, a run that failed.
pub fn execute(
    arguments: &RunArguments,
    opened: &OpenScene,
    observer: &mut Watch<'_>,
) -> Result<Ended, Trouble> {
    let out = folder(arguments, opened);
    // Before the folder is touched.
    if arguments.resume && !out.join(CHECKPOINT).is_file() {
        let why = "to resume from: start without --resume";
        return Err(format!("there is no checkpoint in {} {why}", out.display()).into());
    }
    match &opened.scene {
        AnyScene::Particles(loaded) => particles(arguments, loaded, &out, observer),
        AnyScene::Grains(loaded) => grains(arguments, loaded, &out, observer),
    }
}

fn particles(
    arguments: &RunArguments,
    loaded: &Loaded,
    out: &Path,
    observer: &mut Watch<'_>,
) -> Result<Ended, Trouble> {
    let mut options = options(arguments, out)?;
    let own = identity(loaded);
    options.identity = own.map_err(|e| Trouble::in_scene(RunError::from(e), &loaded.source))?;
    let result = match (ranks::communicator(), arguments.ranks.map(usize::from)) {
        (Some(_), Some(2..)) => {
            let why = "--ranks divides this process, and mpirun has started several";
            return Err(format!("{why}: leave out --ranks").into());
        }
        (Some(communicator), _) => run_part(&loaded.scene, &options, communicator, observer),
        (None, Some(ranks @ 2..)) => {
            run_on_threads(&loaded.scene, &options, ranks, observer).map(Some)
        }
        (None, _) => run(&loaded.scene, &options, observer).map(Some),
    };
    let summary = result.map_err(|error| trouble(error, arguments, &loaded.source, out))?;
    let Some(s) = summary else {
        // Another rank has it.
        return Ok(Ended::default());
    };
    let text = outcome::text(&s, out);
    let reached = (s.status, s.simulated_seconds, s.steps);
    Ok(ended(&s, text, reached, &going_on(arguments, out)))
}

fn grains(
    arguments: &RunArguments,
    loaded: &dem_pfv::scene::Loaded,
    out: &Path,
    observer: &mut Watch<'_>,
) -> Result<Ended, Trouble> {
    if arguments.ranks.is_some_and(|n| n > 1) || ranks::communicator().is_some() {
        return Err(Trouble::usage("a scene of grains runs on one rank"));
    }
    if arguments.from.is_some() {
        let why = "--from takes particles of another run; grains go on with --resume, and --changed if the scene \
                   has changed";
        return Err(Trouble::usage(why));
    }
    let mut options = options(arguments, out)?;
    options.identity = dem_pfv::scene::identity(loaded);
    let result = dem_pfv::scene::run(loaded, &options, observer);
    let s = result.map_err(|error| trouble(error, arguments, &loaded.source, out))?;
    let text = grains::outcome(&s, out);
    let reached = (s.status, s.simulated_seconds, s.steps);
    Ok(ended(&s, text, reached, &going_on(arguments, out)))
}

fn options(arguments: &RunArguments, out: &Path) -> Result<RunOptions, Trouble> {
    let options = RunOptions::new(out, Identity::default()).start(start(arguments, out)?);
    Ok(options.threads(arguments.threads.map(usize::from)))
}

/// The end of a run whose summary is a text, with the time (s) and the step that it reached, and the command to go on.
fn ended(
    found: &impl Serialize,
    text: String,
    (status, time, step): (Status, f64, u64),
    again: &str,
) -> Ended {
    let kept = format!("interrupted at t = {time:.6} s, step {step}; go on with\n  {again}");
    Ended {
        told: CommandOutput::new(found, text),
        going_on: (status != Status::Done).then_some(kept),
    }
}

fn start(arguments: &RunArguments, out: &Path) -> Result<Start, Trouble> {
    let Some(other) = &arguments.from else {
        return Ok(match (arguments.resume, arguments.changed) {
            (true, true) => Start::Changed,
            (true, false) => Start::Resumed,
            _ => Start::Afresh,
        });
    };
    let file = match other.is_dir() {
        true => other.join(CHECKPOINT),
        false => other.clone(),
    };
    let shown = other.display();
    let missing = |_| format!("there is no checkpoint in {shown} to start from");
    let real = file.canonicalize().map_err(missing)?;
    let own = out.join(CHECKPOINT).canonicalize();
    if own.is_ok_and(|own| own == real) {
        let why =
            "would be overwritten, and the run starts from it: name another folder with --out";
        return Err(format!("{} {why}", out.display()).into());
    }
    Ok(Start::From(file))
}

fn trouble(
    error: impl Into<ModelError>,
    arguments: &RunArguments,
    source: &Source,
    out: &Path,
) -> Trouble {
    let told: ModelError = error.into();
    // Not one of an earlier run.
    let left = read_summary(out).filter(|summary| told.ran && summary["status"] == "failed");
    let stands = told.remedy.filter(|_| out.join(CHECKPOINT).is_file());
    let again = stands.map(|why| {
        let again = going_on(arguments, out);
        format!("the last checkpoint stands: {why}, then go on with\n  {again}")
    });
    let mut trouble = Trouble::in_scene(told, source);
    if let Trouble::Failed {
        summary, advice, ..
    } = &mut trouble
    {
        *summary = left.map(Box::new);
        *advice = again;
    }
    trouble
}

fn going_on(arguments: &RunArguments, out: &Path) -> String {
    let scene = &arguments.scene;
    let out = [("--out", out.display().to_string())].into_iter();
    let options = out.chain(shell::overrides(&scene.set, &scene.allow_path));
    shell::command(&["sph", "run", &scene.scene], options) + " --resume"
}
