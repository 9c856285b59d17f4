//! Good scenes load; bad ones say, under the offending line, what is wrong with it.

use std::path::{Path, PathBuf};

use sph_scene::{Diagnostic, Offset, Scene, estimate, fill, load, parse};

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests")
        .join(folder);
    let entries = std::fs::read_dir(folder).unwrap();
    let mut all: Vec<_> = entries.map(|e| e.unwrap().path()).collect();
    all.sort();
    all
}

/// How many particles fill a scene, and how many are estimated.
fn counted<const D: usize>(scene: &Scene) -> (usize, f64) {
    let (bodies, spacing) = (scene.regions::<D>(), scene.numerics.spacing);
    let periodic = scene.numerics.periodic.bounds();
    let filled = fill(&bodies, spacing, Offset::Half, &periodic);
    let count = filled.iter().map(|f| f.positions.len()).sum();
    (count, estimate(&bodies, spacing))
}

#[test]
fn good_scenes_load_and_fill_as_estimated() {
    for file in files("good") {
        let scene = load(&file, &[]).unwrap_or_else(|e| panic!("{e}")).scene;
        let (filled, estimated) = match scene.dimension {
            2 => counted::<2>(&scene),
            _ => counted::<3>(&scene),
        };
        let name = file.display();
        assert!(
            filled > 0 && filled as f64 <= 1.1 * estimated,
            "{name}: {filled} of {estimated}"
        );
    }
}

/// What a bad scene expects: the line that is meant and a part of the message.
fn expectations(case: &str) -> Vec<(usize, String)> {
    let mut meant = 1;
    let mut found = Vec::new();
    for (k, line) in case.lines().enumerate() {
        match line.strip_prefix("#^") {
            Some(message) => found.push((meant, message.trim_start().to_string())),
            None => meant = k + 1,
        }
    }
    found
}

#[test]
fn bad_scenes_are_told_every_mistake_at_its_line() {
    let mut total = 0;
    let mut wrong = Vec::new();
    for file in files("bad") {
        let text = std::fs::read_to_string(&file).unwrap();
        for (number, case) in text.split("+++\n").enumerate() {
            let file = file.file_name().unwrap().display();
            let name = format!("{file} case {}", number + 1);
            let expected = expectations(case);
            total += expected.len();
            let told = match parse(case, "bad.toml", &[]) {
                Ok(_) => Vec::new(),
                Err(refused) => refused.diagnostics,
            };
            let meets = |d: &Diagnostic, (line, message): &(usize, String)| {
                d.line == *line && d.message.contains(message)
            };
            for expected in expected
                .iter()
                .filter(|e| !told.iter().any(|d| meets(d, e)))
            {
                let (line, message) = expected;
                wrong.push(format!("{name}: nobody says `{message}` at line {line}"));
            }
            for d in told
                .iter()
                .filter(|d| !expected.iter().any(|e| meets(d, e)))
            {
                wrong.push(format!("{name}: unexpected {d}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(total >= 90, "{total} expectations");
}
