//! The text of a study file over a small scene: read, crossed, its first variants assembled.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use sph_study::{SceneText, Study, StudyFile};

const SCENE: &str = include_str!("../../tests/scenes/dam-break.toml");

/// Most variants that are read: each is a scene, and they are all alike.
const MOST: usize = 30;

fuzz_target!(|text: &str| {
    if toml::from_str(text).is_ok_and(|file| variants(&file) > MOST) {
        return;
    }
    let find = |_: &Path, name: &str| match name {
        "none" => Err("there is none".to_string()),
        _ => Ok(SceneText {
            name: "dam-break".to_string(),
            text: SCENE.to_string(),
            file: sph_fuzz::FILE.to_string(),
            allowed: Vec::new(),
            method: &sph_particles::Particles,
        }),
    };
    if let Ok(study) = Study::parse(text, Path::new("fuzzed.toml"), &find, &[], &[]) {
        for variant in study.variants.iter().take(2) {
            if let Ok(scene) = toml::to_string(&variant.subject.resolved()) {
                sph_fuzz::check(&scene, &[]);
            }
        }
    }
});

/// About how many variants a study has.
fn variants(file: &StudyFile) -> usize {
    let count = |values: Option<usize>, entries: Option<usize>| values.or(entries).unwrap_or(1);
    let crossed = file.vary.iter().map(|a| {
        let entries = a.entries.as_ref().map(Vec::len);
        count(a.values.as_ref().map(Vec::len), entries)
    });
    let gone_along = file.axis.iter().map(|a| {
        let entries = a.entries.as_ref().map(Vec::len);
        count(a.values.as_ref().map(Vec::len), entries)
    });
    let along = gone_along.sum::<usize>() * file.combination.len().max(1);
    crossed.fold(along.max(1), usize::saturating_mul)
}
