//! `sph run` of a scene of grains.

use std::path::Path;

use dem_scene::{DemError, Loaded, RunOptions, SUMMARY, Start, Status, Step, run};
use serde_json::Value as Json;
use sph_run::{Command, Observer, Progress};

use super::outcome;
use crate::arguments::RunArguments;
use crate::commands::left_behind::{CHECKPOINT, failed_summary, going_on, remedy};
use crate::telling::told::{Ended, Told};
use crate::telling::trouble::Trouble;

/// A watcher of particles that watches grains.
pub(crate) struct Watching<'a>(pub &'a mut (dyn Observer + Send));

impl dem_scene::Observer for Watching<'_> {
    fn step(&mut self, step: &Step) -> bool {
        let progress = Progress {
            time: step.time,
            end: step.end,
            step: step.step,
            dt: step.dt,
            limiter: step.limiter,
            particles: step.grains,
        };
        matches!(self.0.step(&progress), Command::Continue)
    }

    fn message(&mut self, text: &str) {
        self.0.message(text);
    }
}

/// Runs a scene of grains into a folder.
pub fn execute(
    arguments: &RunArguments,
    loaded: &Loaded,
    out: &Path,
    observer: &mut (dyn Observer + Send),
) -> Result<Ended, Trouble> {
    if arguments.from.is_some() {
        return Err(Trouble::usage(
            "--from takes particles of another run; grains go on with --resume, and --changed if the scene has changed",
        ));
    }
    let start = match (arguments.resume, arguments.changed) {
        (true, true) => Start::Changed,
        (true, false) => Start::Resumed,
        _ => Start::Afresh,
    };
    let options = RunOptions {
        out: out.to_path_buf(),
        start,
        threads: arguments.threads.map(usize::from),
    };
    let result = run(loaded, &options, &mut Watching(observer));
    let summary = result.map_err(|error| trouble(error, arguments, loaded, out))?;
    let stopped = summary.status != Status::Done;
    Ok(Ended {
        interrupted: stopped.then_some((summary.simulated_seconds, summary.steps)),
        told: Told {
            json: serde_json::to_value(&summary).unwrap_or(Json::Null),
            text: outcome::text(&summary, out),
        },
    })
}

fn trouble(error: DemError, arguments: &RunArguments, loaded: &Loaded, out: &Path) -> Trouble {
    let failed = matches!(error, DemError::Failed(_));
    let unwritten = match &error {
        DemError::Io(io) => remedy(io),
        _ => None,
    };
    let stands = unwritten.filter(|_| out.join(CHECKPOINT).is_file());
    let advice = stands.map(|why| {
        let again = going_on(arguments, out);
        format!("the last checkpoint stands: {why}, then go on with\n  {again}")
    });
    match Trouble::of_grains(error, &loaded.source) {
        Trouble::Grains { error, .. } => Trouble::Grains {
            error,
            summary: failed
                .then(|| failed_summary(&out.join(SUMMARY)))
                .flatten()
                .map(Box::new),
            advice,
        },
        other => other,
    }
}
