//! Files that fail a run: folders that cannot be written, full disks, damaged checkpoints, and whatever else a
//! file may hold that nobody meant.

#[cfg(target_os = "linux")]
mod data_files;
mod forged;
#[cfg(target_os = "linux")]
mod hostile;
#[cfg(target_os = "linux")]
mod large;
mod mutated;
mod plausible;
#[cfg(unix)]
mod reach;
#[cfg(target_os = "linux")]
mod sizes;

use std::process::{Command, Stdio};

use sph_io::{Checkpoint, ColumnData};
use sph_tests::{Bench, DAM_BREAK, Disk, Outcome, bench, files_with_extension};

const PROGRAM: &str = env!("CARGO_BIN_EXE_sph-under-test");

#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let bench = bench!(DAM_BREAK);
    for out in ["scene.toml/results", "/proc/self/results"] {
        let failed = bench.failed(&format!("run scene.toml --out {out}"));
        failed.says(out);
    }
    assert_eq!(bench.read("scene.toml"), DAM_BREAK);
}

/// A call of the program that may have so much address space, KiB.
#[cfg(target_os = "linux")]
fn limited(bench: &Bench, call: &str, memory: u32) -> Outcome {
    let mut shell = Command::new("bash");
    let script = format!("ulimit -v {memory}; exec {PROGRAM} {call}");
    shell.args(["-c", &script]).env("RAYON_NUM_THREADS", "2");
    let shell = shell.current_dir(bench.folder()).stdin(Stdio::null());
    Outcome::new(call.into(), &shell.output().expect("bash"))
}

/// A run of a few steps, to have a checkpoint.
fn short_run(bench: &Bench) {
    bench.done("run scene.toml --quiet --out r --set run.end=0.02");
}

#[test]
fn a_damaged_checkpoint_is_not_resumed() {
    let bench = bench!(DAM_BREAK);
    short_run(&bench);
    let path = bench.path("r/checkpoint.sph");
    let whole = std::fs::read(&path).expect("a checkpoint");
    let series = bench.read("r/series.csv");
    let mut flipped = whole.clone();
    flipped[whole.len() / 2] ^= 1;
    for (bytes, word) in [
        (whole[..whole.len() / 2].to_vec(), "bytes instead of"),
        (Vec::new(), "not a checkpoint"),
        (flipped, "checksum"),
        (vec![b'x'; 4096], "not a checkpoint"),
    ] {
        std::fs::write(&path, &bytes).expect("a damaged checkpoint");
        let failed = bench.failed("run scene.toml --out r --set run.end=0.02 --resume");
        failed.says(&format!("checkpoint.sph | {word} | without --resume"));
        assert_eq!(bench.read("r/series.csv"), series, "the series was touched");
    }
}

/// Whole and of this scene, but with numbers in it that no run writes.
#[test]
fn a_checkpoint_of_nonsense_is_not_resumed() {
    let bench = bench!(DAM_BREAK);
    short_run(&bench);
    let path = bench.path("r/checkpoint.sph");
    let whole = Checkpoint::load(&path).expect("a checkpoint");
    let refused = |forged: &Checkpoint, word: &str| {
        forged.save(&path).expect("saved");
        let failed = bench.failed("run scene.toml --out r --set run.end=0.02 --resume");
        failed.says(&format!("checkpoint.sph | {word}"));
    };
    let change = |name: &str, to: &dyn Fn(&mut ColumnData)| {
        let mut forged = whole.clone();
        let mut columns = forged.columns.iter_mut();
        to(&mut columns.find(|c| c.name == name).expect("the column").data);
        forged
    };
    let real = |x: f64| {
        move |data: &mut ColumnData| match data {
            ColumnData::F64(values) => values[3] = x,
            _ => panic!("no reals"),
        }
    };
    for x in [f64::NAN, f64::INFINITY] {
        refused(&change("position", &real(x)), "nowhere");
        refused(&change("list_reference", &real(x)), "nowhere");
    }
    for number in [0, u32::MAX] {
        let to = |data: &mut ColumnData| match data {
            ColumnData::U32(ids) => ids[1..3].fill(number),
            _ => panic!("no numbers"),
        };
        refused(&change("identity", &to), "particles are not the scene's");
    }
    let mut forged = whole.clone();
    forged.meta["clock"]["time"] = f64::NAN.to_bits().into();
    refused(&forged, "time is not finite");
    forged.meta = serde_json::json!({});
    refused(&forged, "not one of this version");
    let mut forged = whole.clone();
    forged.columns.retain(|c| c.name != "velocity");
    refused(&forged, "lacks the column `velocity`");
    whole.save(&path).expect("saved");
    bench.done("run scene.toml --quiet --out r --set run.end=0.02 --resume");
}

#[test]
fn a_checkpoint_of_another_scene_is_not_resumed() {
    let bench = bench!(DAM_BREAK);
    short_run(&bench);
    let series = bench.read("r/series.csv");
    for set in ["", "--set run.end=0.02 --set phase.water.density=999"] {
        let failed = bench.failed(&format!("run scene.toml --out r --resume {set}"));
        failed.says("different scene");
        assert_eq!(bench.read("r/series.csv"), series, "the series was touched");
    }
    // Another number of threads is the same scene.
    bench.done("run scene.toml --quiet --out r --set run.end=0.02 --resume --threads 1");
}

#[test]
fn a_full_disk_costs_the_last_output_and_no_other() {
    let bench = bench!(DAM_BREAK);
    let at = bench.path("disk");
    let Some(_disk) = Disk::mount(160, &at) else {
        println!("skipped: mounting a small file system is not permitted here");
        return;
    };
    let set = "--set output.every=0.002 --set output.picture=pressure";
    let outcome = bench.failed(&format!("run scene.toml --out disk/r {set}"));
    outcome.says("disk full");
    assert!(!outcome.err.contains("without --resume"), "{}", outcome.err);

    let folder = bench.path("disk/r");
    let ends = |extension: &str, end: &[u8]| {
        for path in files_with_extension(&folder, extension) {
            let bytes = std::fs::read(&path).expect("a file of the run");
            assert!(bytes.ends_with(end), "{} is cut", path.display());
        }
    };
    ends("vtu", b"</VTKFile>\n");
    ends("pvd", b"</VTKFile>\n");
    ends("png", b"IEND\xaeB`\x82");
    ends("csv", b"\n");
    ends("json", b"}\n");
    let count = |extension| files_with_extension(&folder, extension).len();
    assert!(count("vtu") > 0 && count("tmp") == 0, "nothing or a half");
    let lines = bench.read("disk/r/series.csv");
    let widths = lines
        .lines()
        .filter(|l| !l.starts_with('#'))
        .map(|l| l.split(',').count());
    let widths: Vec<usize> = widths.collect();
    assert!(widths.iter().all(|w| *w == widths[0]), "a cut row");
}

/// The advice is what one does, and it works.
#[test]
fn a_disk_that_is_full_at_a_checkpoint_is_resumed_once_there_is_room() {
    let bench = bench!(DAM_BREAK);
    let at = bench.path("disk");
    // Room for a checkpoint (a third of it), not for its successor beside it and the series.
    let quiet =
        "--set output.vtk=false --set output.series_every=0.4 --set run.checkpoint_every=0.05";
    bench.done(&format!(
        "run scene.toml --quiet --out size {quiet} --set run.end=0.05"
    ));
    let one = std::fs::metadata(bench.path("size/checkpoint.sph"))
        .expect("a checkpoint")
        .len();
    let Some(disk) = Disk::mount((one * 3 / 2 / 1024) as u32 + 8, &at) else {
        println!("skipped: mounting a small file system is not permitted here");
        return;
    };
    let outcome = bench.failed(&format!("run scene.toml --out disk/r {quiet}"));
    outcome.says("disk full | checkpoint.sph | make room | --out disk/r | --resume");
    assert!(!outcome.err.contains("start again"), "{}", outcome.err);
    disk.grow(4096);
    bench.done(&format!(
        "run scene.toml --quiet --out disk/r {quiet} --resume"
    ));
}
