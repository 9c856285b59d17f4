//! Whether two binaries compute the same bits: the first steps of every shipped scene, on one and on two threads.
//!
//! ```sh
//! cargo run -p sph-tests --example same_bits -- OLD/sph NEW/sph [--steps 3] [--ranks] [scenes/NAME.toml …]
//! ```
//!
//! With `--ranks` the second binary runs on two and on four ranks, in place of one and two threads.
//!
//! Compares all columns of the checkpoints, in which every column of state is; prints a checksum per scene and the
//! columns that differ, with the largest difference over the largest value, and ends with 1 if any does.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use sph_io::{Checkpoint, ColumnData};

/// Columns by name.
type Columns = BTreeMap<String, ColumnData>;

fn main() -> ExitCode {
    let mut given = std::env::args().skip(1);
    let (Some(old), Some(new)) = (given.next(), given.next()) else {
        eprintln!("two binaries, please: same_bits OLD NEW [--steps N] [SCENE …]");
        return ExitCode::from(2);
    };
    let mut steps = "3".to_string();
    let mut split = ("--threads", [1, 2]);
    let mut scenes = Vec::new();
    while let Some(argument) = given.next() {
        match argument.as_str() {
            "--steps" => steps = given.next().unwrap_or(steps),
            "--ranks" => split = ("--ranks", [2, 4]),
            scene => scenes.push(PathBuf::from(scene)),
        }
    }
    if scenes.is_empty() {
        scenes = shipped();
    }
    let (mut same, mut other) = (0, 0);
    for scene in &scenes {
        let name = scene.file_stem().unwrap_or_default().to_string_lossy();
        let (option, [few, more]) = split;
        let all = [
            (&old, "--threads", 1),
            (&new, option, few),
            (&new, option, more),
        ];
        let all =
            all.map(|(binary, option, n)| columns(binary, scene, [option, &n.to_string()], &steps));
        match all {
            [Ok(before), Ok(one), Ok(two)] => {
                let differ = [differing(&before, &one), differing(&before, &two)];
                if differ.iter().all(Vec::is_empty) {
                    same += 1;
                    println!(
                        "{name}: same, {} columns, {:016x}",
                        before.len(),
                        hash(&before)
                    );
                } else {
                    other += 1;
                    let [one, two] = differ.map(|d| d.join(", "));
                    println!("{name}: DIFFERS with {option} {few}: {one}; {more}: {two}");
                }
            }
            [before, one, two] => {
                other += 1;
                let why = before.err().or(one.err()).or(two.err()).unwrap_or_default();
                println!("{name}: NOT RUN: {why}");
            }
        }
    }
    println!("{same} scenes the same, {other} not");
    ExitCode::from(u8::from(other > 0))
}

/// The scenes of particles of this workspace; those of grains keep another kind of checkpoint.
fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let entries = std::fs::read_dir(folder).expect("the folder of scenes");
    let files = entries.map(|e| e.expect("an entry").path());
    let mut scenes: Vec<_> = files
        .filter(|p| p.extension().is_some_and(|e| e == "toml"))
        .filter(|p| std::fs::read_to_string(p).is_ok_and(|text| !text.contains("[grains]")))
        .collect();
    scenes.sort();
    scenes
}

/// The columns after the first steps, or what the binary said.
fn columns(binary: &str, scene: &Path, split: [&str; 2], steps: &str) -> Result<Columns, String> {
    let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
    let run = Command::new(binary)
        .args(["run", "--quiet"])
        .args(split)
        .args(["--set", &format!("run.max_steps={steps}"), "--out"])
        .arg(folder.path())
        .arg(scene)
        .output();
    let run = run.map_err(|e| format!("{binary}: {e}"))?;
    let said = || String::from_utf8_lossy(&run.stderr).trim().to_string();
    let checkpoint = Checkpoint::load(folder.path().join("checkpoint.sph")).map_err(|_| said())?;
    let columns = checkpoint.columns.into_iter();
    Ok(columns.map(|column| (column.name, column.data)).collect())
}

/// A checksum of all columns.
fn hash(of: &Columns) -> u64 {
    let mut hasher = DefaultHasher::new();
    for (name, column) in of {
        name.hash(&mut hasher);
        bits(column).hash(&mut hasher);
    }
    hasher.finish()
}

fn bits(column: &ColumnData) -> Vec<u64> {
    match column {
        ColumnData::F64(v) => v.iter().map(|x| x.to_bits()).collect(),
        ColumnData::U32(v) => v.iter().map(|x| u64::from(*x)).collect(),
        ColumnData::U64(v) => v.clone(),
    }
}

/// Largest difference of two columns over the largest value, if they have as many reals.
fn apart(one: &ColumnData, two: &ColumnData) -> Option<f64> {
    let (ColumnData::F64(one), ColumnData::F64(two)) = (one, two) else {
        return None;
    };
    let largest = one.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let apart = one.iter().zip(two).map(|(a, b)| (a - b).abs());
    (one.len() == two.len()).then(|| apart.fold(0.0, f64::max) / largest)
}

/// Names of the columns that are not the same or not in both.
fn differing(one: &Columns, two: &Columns) -> Vec<String> {
    let names = one.keys();
    let names = names.chain(two.keys().filter(|k| !one.contains_key(*k)));
    let told = |name: &String| {
        let both = one.get(name).zip(two.get(name));
        if both.is_some_and(|(a, b)| bits(a) == bits(b)) {
            return None;
        }
        let apart = both.and_then(|(a, b)| apart(a, b));
        Some(apart.map_or(name.clone(), |by| format!("{name} by {by:.1e}")))
    };
    names.filter_map(told).collect()
}
