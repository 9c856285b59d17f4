//! `sph study`.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use sph_core::{comma_list, suggestion};
use sph_study::{
    Options, Origin, ReadError, Results, SceneText, Status, Study, compare, execute, rows,
};

use crate::arguments::StudyArguments;
use crate::scene_file::{FoundScene, allowed, find, overrides};
use crate::shipped::Content;
use crate::terminal::study_progress::Watcher;
use crate::terminal::{CommandOutput, Ended, Trouble, columns, console, shell};
use crate::{interrupt, shipped};

/// Most series whose orders are printed; the report has all.
const MOST: usize = 12;

pub fn command(arguments: &StudyArguments) -> Result<(), Trouble> {
    if let [first, second] = arguments.compare.as_slice() {
        return compared(arguments, first, second);
    }
    let ended = conduct(arguments, interrupt::flag())?;
    ended.conclude(arguments.json, arguments.quiet)
}

/// Runs a study until it is done or the flag is raised. Unless it is quiet, it reports its progress on stderr.
///
/// # Errors
/// Mistakes of the study or its scenes with their places, files that cannot be written.
pub fn conduct(arguments: &StudyArguments, stop: Arc<AtomicBool>) -> Result<Ended, Trouble> {
    let name = arguments.study.as_deref().unwrap_or_default();
    // The data of compiled-in scenes are needed until the last variant has run.
    let scenes: RefCell<BTreeMap<String, FoundScene>> = RefCell::default();
    let study = read(arguments, name, &scenes)?;
    let out = arguments.out.clone();
    let out = out.unwrap_or_else(|| Path::new("results/studies").join(&study.name));
    let mut options = Options::new(&out, Origin::new(env!("SPH_BUILT_WITH")));
    options.threads = arguments.threads.map(usize::from);
    options.fresh = arguments.fresh;
    let watcher = Watcher::new(arguments.quiet, &study, &options, stop);
    assemble(&study, &watcher)?;
    let _lock = sph_io::FolderLock::take(&out)?;
    sph_io::writable(&out)?;
    sph_io::sweep_temporaries(&out)?;
    let outcome = execute(&study, &options, &watcher);
    watcher.finish();
    let results = Results::new(&study, &outcome.records, options.origin);
    let published = sph_study::publish(&results, &out);
    if let Some(error) = outcome.error {
        console::err(&kept(arguments, name, &outcome.records));
        return Err(error.into());
    }
    published?;
    let records = &outcome.records;
    Ok(Ended {
        told: CommandOutput::new(&results, text(&results, &out)),
        going_on: outcome.stopped.then(|| kept(arguments, name, records)),
    })
}

fn compared(arguments: &StudyArguments, first: &Path, second: &Path) -> Result<(), Trouble> {
    let comparison = compare(&Results::load(first)?, &Results::load(second)?);
    let notes = comparison.notes.iter();
    let mut text: String = notes.map(|note| format!("{note}\n")).collect();
    if !comparison.variants.is_empty() {
        text.push_str(&columns(2, comparison.rows()));
    }
    let sides = [
        (first, &comparison.only_in_first),
        (second, &comparison.only_in_second),
    ];
    for (path, names) in sides.iter().filter(|(_, names)| !names.is_empty()) {
        let names = names.join(", ");
        text.push_str(&format!("only in {}: {names}\n", path.display()));
    }
    if let Some(ratio) = comparison.wall_ratio {
        text.push_str(&format!("wall seconds, geometric mean: ×{ratio:.3}\n"));
    }
    CommandOutput::new(&comparison, text).print(arguments.json);
    Ok(())
}

fn read(
    arguments: &StudyArguments,
    name: &str,
    scenes: &RefCell<BTreeMap<String, FoundScene>>,
) -> Result<Study, Trouble> {
    let set = overrides(&arguments.set)?;
    let allowed = allowed(&arguments.allow_path)?;
    let look = |folder: &Path, name: &str| -> Result<SceneText, String> {
        let known = scenes.borrow().get(name).map(|(scene, _)| scene.clone());
        if let Some(scene) = known {
            return Ok(scene);
        }
        let found = find(folder, name, allowed)?;
        let scene = found.0.clone();
        scenes.borrow_mut().insert(name.to_string(), found);
        Ok(scene)
    };
    let path = Path::new(name);
    if path.exists() && !path.is_dir() {
        return Ok(Study::read(path, &look, &set, &arguments.only)?);
    }
    let study = shipped::find_study(name).ok_or_else(|| {
        let near = suggestion(name.trim_end_matches(".toml"), shipped::studies());
        let known = comma_list(shipped::studies());
        format!("there is no study file `{name}` and no shipped study of that name{near} (there are: {known})")
    })?;
    Ok(match study.content {
        Content::File(path) => Study::read(&path, &look, &set, &arguments.only)?,
        Content::CompiledIn(text) => {
            let path = PathBuf::from(format!("{}.toml", study.name));
            Study::parse(text, &path, &look, &set, &arguments.only)?
        }
    })
}

/// Collects the variants to run, so that every mistake is known before the first run.
fn assemble(study: &Study, watcher: &Watcher) -> Result<(), Trouble> {
    let all = study.variants.iter().zip(&watcher.open);
    for (variant, _) in all.filter(|(_, open)| **open) {
        let work = study.assemble(variant).map_err(ReadError::from)?;
        watcher.assembled(variant, work);
    }
    Ok(())
}

fn text(results: &Results, out: &Path) -> String {
    let is_pending = |v: &sph_study::VariantResult| v.status == Status::Pending;
    let pending = |k: usize| results.variants.get(k).is_some_and(is_pending);
    let all = rows(results).into_iter().enumerate();
    let along = !results.frontiers.is_empty();
    let shown = all.filter(|(k, _)| *k == 0 || along || !pending(k - 1));
    let shown = columns(2, shown.map(|(_, row)| row));
    let left = results.variants.iter().filter(|v| is_pending(v)).count();
    let mut text = format!("{}\n{shown}", results.title);
    if left > 0 {
        text.push_str(&format!("{left} variants are pending\n"));
    }
    let few = if results.series.len() > MOST { 0 } else { MOST };
    for series in results.series.iter().take(few) {
        let orders = series.orders.get(results.judged());
        if let Some(order) = orders.and_then(sph_study::Orders::main) {
            let of = match series.name.as_str() {
                "" => String::new(),
                name => format!(" of {name}"),
            };
            text.push_str(&format!("order{of}: {order:.2}\n"));
        }
    }
    let lines = results.scale.iter().flat_map(sph_study::Scale::lines);
    text.extend(lines.map(|line| line + "\n"));
    let (machine, out) = (&results.origin.machine, out.display());
    text + &format!("on {machine}\nwritten to {out}: report.html shows all of it\n")
}

fn kept(arguments: &StudyArguments, name: &str, records: &[sph_study::Record]) -> String {
    let over = |r: &&sph_study::Record| !matches!(r.status, Status::Pending | Status::Interrupted);
    let (finished, all) = (records.iter().filter(over).count(), records.len());
    let again = going_on(arguments, name);
    format!("{finished} of {all} variants are finished and kept; go on with\n  {again}")
}

fn going_on(arguments: &StudyArguments, name: &str) -> String {
    let out = arguments.out.iter();
    let out = out.map(|out| ("--out", out.display().to_string()));
    let threads = arguments.threads.iter();
    let threads = threads.map(|threads| ("--threads", threads.to_string()));
    let only = arguments.only.iter().map(|only| ("--only", only.clone()));
    let overrides = shell::overrides(&arguments.set, &arguments.allow_path);
    let options = out.chain(threads).chain(only).chain(overrides);
    shell::command(&["sph", "study", name], options)
}
