//! Studies as a person or a script meets them.

use std::path::Path;

use sph_study::{SceneText, Study};
use sph_tests::{Bench, Says, bench};

mod along;
mod failures;
mod grains;
mod orders_in_time;
mod refusals;
mod results;
mod scaling;

/// Vortices in a small box, some ten steps long.
const STUDY: &str = include_str!("vortices.toml");

fn bench(study: &str) -> Bench {
    let bench = bench!();
    bench.write("s.toml", study);
    bench
}

fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let name = |e: std::io::Result<std::fs::DirEntry>| e.expect("an entry").file_name();
    let mut names: Vec<String> = entries
        .map(|e| name(e).into_string().expect("a plain name"))
        .collect();
    names.sort();
    names
}

/// A study is refused with the changes of a file, at the line that each names, and leaves no file.
fn refuses(study: &str, changes: &'static str) {
    bench!().refuses("s.toml", &["study s.toml"], study, changes);
}

#[test]
fn shipped_studies_are_good() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let find = |_: &Path, name: &str| {
        let path = root.join(format!("scenes/{name}.toml"));
        let text = std::fs::read_to_string(&path).map_err(|e| e.to_string())?;
        let (name, file) = (name.to_string(), path.display().to_string());
        Ok(SceneText {
            method: sph_cli::method(&text, &name),
            name,
            text,
            file,
            allowed: Vec::new(),
        })
    };
    for file in files(&root.join("studies")) {
        let path = root.join("studies").join(file);
        let study = Study::read(&path, &find, &[], &[]);
        let study = study.unwrap_or_else(|e| panic!("{path:?}: {e}"));
        // Assembling fine ones would take longer than running coarse ones.
        let coarse = study.variants.iter().map(|v| v.refinement.unwrap_or(1.0));
        let coarsest = coarse.fold(0.0, f64::max);
        for variant in &study.variants {
            // Of an axis the first value stands for the others.
            if variant.rung.is_some_and(|r| r.value > 0) {
                continue;
            }
            if variant.refinement.is_none_or(|h| h == coarsest) {
                let good = study.assemble(variant);
                good.unwrap_or_else(|e| panic!("{path:?}: {}: {e}", variant.name));
            }
        }
    }
}

/// Its data are compiled in, and so are those that it names beside those of its scene.
#[test]
fn a_shipped_study_of_two_models_runs_in_any_folder() {
    let bench = bench!();
    let outcome = bench.done("study dilatancy-judge --only loose-roux* --set run.end=0.02");
    outcome.out.says("loose, roux-radjai");
    let run = "run undrained-shear --set run.end=0.02 --set \
               reference.pull={probe='excess',file='data/grains_undrained_dense.csv',columns=['shear','share']}";
    bench.done(run);
}
