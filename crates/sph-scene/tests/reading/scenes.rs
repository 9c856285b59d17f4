//! Good scenes load; bad ones say, under the offending line, what is wrong with it.

use std::path::{Path, PathBuf};

use sph_scene::{Offset, estimate, fill, load, parse};

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests")
        .join(folder);
    let entries = std::fs::read_dir(folder).unwrap();
    let mut all: Vec<_> = entries.map(|e| e.unwrap().path()).collect();
    all.sort();
    all
}

#[test]
fn good_scenes_load_and_fill_as_estimated() {
    for file in files("good") {
        let scene = load(&file, &[]).unwrap_or_else(|e| panic!("{e}")).scene;
        let spacing = scene.numerics.spacing;
        let (filled, estimated) = match scene.dimension {
            2 => {
                let bodies = scene.regions::<2>();
                let periodic = scene.numerics.periodic.bounds();
                let filled = fill(&bodies, spacing, Offset::Half, &periodic);
                let count = filled.iter().map(|f| f.positions.len()).sum::<usize>();
                (count, estimate(&bodies, spacing))
            }
            _ => {
                let bodies = scene.regions::<3>();
                let periodic = scene.numerics.periodic.bounds();
                let filled = fill(&bodies, spacing, Offset::Half, &periodic);
                let count = filled.iter().map(|f| f.positions.len()).sum::<usize>();
                (count, estimate(&bodies, spacing))
            }
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
            let name = format!(
                "{} case {}",
                file.file_name().unwrap().display(),
                number + 1
            );
            let expected = expectations(case);
            total += expected.len();
            let told = match parse(case, "bad.toml", &[]) {
                Ok(_) => Vec::new(),
                Err(refused) => refused.diagnostics,
            };
            for (line, message) in &expected {
                let hit = told
                    .iter()
                    .any(|d| d.line == *line && d.message.contains(message));
                if !hit {
                    wrong.push(format!("{name}: nobody says `{message}` at line {line}"));
                }
            }
            for d in &told {
                let hit = expected
                    .iter()
                    .any(|(l, m)| d.line == *l && d.message.contains(m));
                if !hit {
                    wrong.push(format!("{name}: unexpected {d}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(total >= 90, "{total} expectations");
}
