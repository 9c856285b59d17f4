//! The text of a study file over a small scene: read, crossed, its first variants assembled.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use sph_study::{SceneText, Study};

const SCENE: &str = include_str!("../../tests/scenes/dam-break.toml");

fuzz_target!(|text: &str| {
    let find = |_: &Path, name: &str| match name {
        "none" => Err("there is none".to_string()),
        _ => Ok(SceneText {
            name: "dam-break".to_string(),
            text: SCENE.to_string(),
            file: sph_fuzz::FILE.to_string(),
        }),
    };
    if let Ok(study) = Study::parse(text, Path::new("fuzzed.toml"), &find, &[], &[]) {
        for variant in study.variants.iter().take(2) {
            sph_fuzz::assemble(&variant.loaded);
        }
    }
});
