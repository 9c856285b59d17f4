//! Compiles the shipped scenes with their data, and the shipped studies, into the binary.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

fn main() {
    let manifest = std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets the manifest's folder");
    let scenes = Path::new(&manifest).join("../../scenes");
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed={}", scenes.display());
    println!("cargo:rerun-if-changed={}", scenes.join("data").display());
    let studies = Path::new(&manifest).join("../../studies");
    println!("cargo:rerun-if-changed={}", studies.display());
    let mut code = String::new();
    let tables = [
        (
            "SCENES",
            "&str",
            "include_str",
            scenes.clone(),
            &["toml"][..],
            "",
        ),
        ("STUDIES", "&str", "include_str", studies, &["toml"][..], ""),
        (
            "DATA",
            "&[u8]",
            "include_bytes",
            scenes.join("data"),
            &["csv", "stl", "svg"][..],
            "data/",
        ),
    ];
    for (table, kind, include, folder, extensions, prefix) in tables {
        writeln!(code, "const {table}: &[(&str, {kind})] = &[").expect("a string takes all");
        for file in files(&folder, extensions) {
            println!("cargo:rerun-if-changed={}", file.display());
            let name = file.file_name().and_then(|n| n.to_str()).unwrap_or("");
            writeln!(
                code,
                "    ({:?}, {include}!({file:?})),",
                format!("{prefix}{name}")
            )
            .expect("a string takes all");
        }
        code.push_str("];\n");
    }
    let out = std::env::var("OUT_DIR").expect("cargo sets the output folder");
    std::fs::write(Path::new(&out).join("shipped.rs"), code).expect("the output folder is ours");
}

/// Files of a folder with one of these extensions, sorted; none if there is no folder.
fn files(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut all: Vec<PathBuf> = entries
        .map(|e| e.path())
        .filter(|p| {
            p.extension()
                .is_some_and(|e| extensions.iter().any(|x| e == *x))
        })
        .collect();
    all.sort();
    all
}
