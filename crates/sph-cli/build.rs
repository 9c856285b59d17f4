//! Compiles the shipped scenes with their data, and the shipped studies, into the binary; says what it is built with.

use std::path::{Path, PathBuf};

fn main() {
    let scenes = place("scenes", "scenes");
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed={}", scenes.display());
    let data = scenes.join("data");
    println!("cargo:rerun-if-changed={}", data.display());
    let studies = place("studies", "studies");
    println!("cargo:rerun-if-changed={}", studies.display());
    let mut code = String::new();
    let tables = [
        ("SCENES", "&str", "include_str", "", &scenes, "toml"),
        ("STUDIES", "&str", "include_str", "", &studies, "toml"),
        (
            "DATA",
            "&[u8]",
            "include_bytes",
            "data/",
            &data,
            "csv stl svg",
        ),
    ];
    for (table, kind, include, prefix, folder, extensions) in tables {
        code += &format!("const {table}: &[(&str, {kind})] = &[\n");
        for file in files(folder, extensions) {
            println!("cargo:rerun-if-changed={}", file.display());
            let name = file.file_name().and_then(|n| n.to_str()).unwrap_or("");
            let name = name.trim_end_matches(".toml");
            let name = format!("{prefix}{name}");
            code += &format!("    ({name:?}, {include}!({file:?})),\n");
        }
        code.push_str("];\n");
    }
    let gallery = place("docs/gallery.toml", "gallery.toml");
    println!("cargo:rerun-if-changed={}", gallery.display());
    code += &format!("pub(crate) const GALLERY: &str = include_str!({gallery:?});\n");
    let out = std::env::var("OUT_DIR").expect("cargo sets the output folder");
    std::fs::write(Path::new(&out).join("shipped.rs"), code).expect("the output folder is ours");
    let lock = place("Cargo.lock", "Cargo.lock");
    println!("cargo:rerun-if-changed={}", lock.display());
    println!("cargo:rustc-env=SPH_BUILT_WITH={}", built_with(&lock));
}

/// A file or folder of the repository; in a published package, which has no repository around it, the package's own copy.
/// The links that put the copies there are files of text where a system has no links: hence the order.
fn place(in_repository: &str, in_package: &str) -> PathBuf {
    let manifest = std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets the manifest's folder");
    let manifest = Path::new(&manifest);
    let repository = manifest.join("../..");
    match repository.join("crates/sph-cli/build.rs").exists() {
        true => repository.join(in_repository),
        false => manifest.join(in_package),
    }
}

/// Compiler, optimisation, and the libraries that most of the time is spent in.
fn built_with(lock: &Path) -> String {
    let rustc = std::env::var_os("RUSTC").expect("cargo sets the compiler");
    let said = std::process::Command::new(rustc).arg("--version").output();
    let said = said.map(|o| String::from_utf8_lossy(&o.stdout).into_owned());
    let level = std::env::var("OPT_LEVEL").expect("cargo sets the level");
    let mut parts = vec![
        said.unwrap_or_default().trim().to_string(),
        format!("opt-level {level}"),
    ];
    let lock = std::fs::read_to_string(lock).unwrap_or_default();
    for library in ["faer", "nalgebra", "rayon"] {
        let name = format!("name = \"{library}\"\nversion = \"");
        let version = lock.split_once(&name).and_then(|(_, t)| t.split_once('"'));
        parts.extend(version.map(|(version, _)| format!("{library} {version}")));
    }
    parts.join(", ")
}

/// Files of a folder with one of these extensions, sorted; none if there is no folder.
fn files(folder: &Path, extensions: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let one_of = |e: &std::ffi::OsStr| extensions.split(' ').any(|x| e == x);
    let files = entries.map(|e| e.path());
    let mut all: Vec<_> = files
        .filter(|p| p.extension().is_some_and(one_of))
        .collect();
    all.sort();
    all
}
