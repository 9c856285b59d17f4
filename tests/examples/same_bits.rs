//! Whether two binaries compute the same bits: the first steps of every shipped scene, on one, two and four threads.
//!
//! ```sh
//! cargo run -p sph-tests --example same_bits -- OLD/sph NEW/sph [--steps 3] [--ranks] [scenes/NAME.toml …]
//! ```
//!
//! With `--ranks` the second binary runs on two and on four ranks, in place of threads; scenes of grains, which have no
//! ranks, are then left out.
//!
//! Compares all columns of the checkpoints, in which every column of state is, of grains the whole state as one column;
//! prints a checksum per scene and the columns that differ, with the largest difference over the largest value where
//! they hold reals, and ends with 1 if any does.

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
    let mut split: (&str, &[usize]) = ("--threads", &[1, 2, 4]);
    let mut scenes = Vec::new();
    while let Some(argument) = given.next() {
        match argument.as_str() {
            "--steps" => steps = given.next().unwrap_or(steps),
            "--ranks" => split = ("--ranks", &[2, 4]),
            scene => scenes.push(PathBuf::from(scene)),
        }
    }
    if scenes.is_empty() {
        scenes = shipped(split.0 != "--ranks");
    }
    let (mut same, mut other) = (0, 0);
    for scene in &scenes {
        let name = scene.file_stem().unwrap_or_default().to_string_lossy();
        match compared([&old, &new], scene, split, &steps) {
            Ok((before, differ)) if differ.is_empty() => {
                same += 1;
                let (count, sum) = (before.len(), hash(&before));
                println!("{name}: same, {count} columns, {sum:016x}");
            }
            Ok((_, differ)) => {
                other += 1;
                println!("{name}: DIFFERS with {}: {}", split.0, differ.join("; "));
            }
            Err(why) => {
                other += 1;
                println!("{name}: NOT RUN: {why}");
            }
        }
    }
    println!("{same} scenes the same, {other} not");
    ExitCode::from(u8::from(other > 0))
}

/// The columns of the old binary, and those of the new one that differ, by its number of threads or ranks.
fn compared(
    [old, new]: [&str; 2],
    scene: &Path,
    (option, counts): (&str, &[usize]),
    steps: &str,
) -> Result<(Columns, Vec<String>), String> {
    let before = columns(old, scene, ["--threads", "1"], steps)?;
    let mut differ = Vec::new();
    for count in counts.iter().map(usize::to_string) {
        let found = differing(&before, &columns(new, scene, [option, &count], steps)?);
        if !found.is_empty() {
            differ.push(format!("{count}: {}", found.join(", ")));
        }
    }
    Ok((before, differ))
}

/// The scenes of this workspace.
fn shipped(with_grains: bool) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let entries = std::fs::read_dir(folder).expect("the folder of scenes");
    let files = entries.map(|e| e.expect("an entry").path());
    let mut scenes: Vec<_> = files
        .filter(|p| p.extension().is_some_and(|e| e == "toml"))
        .filter(|p| {
            let text = std::fs::read_to_string(p);
            text.is_ok_and(|text| with_grains || !text.contains("[grains]"))
        })
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
