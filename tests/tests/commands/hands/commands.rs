//! Completions and manual pages.

use sph_tests::{Says, bench};

#[test]
fn every_shell_completes_the_commands() {
    let bench = bench!();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = bench.done(&format!("completions {shell}")).out;
        script.says("explain | compare");
    }
    let bash = bench.done("completions bash").out;
    bench.write("sph.bash", &bash);
    let asked = "source ./sph.bash; COMP_WORDS=(sph ex); COMP_CWORD=1; _sph sph ex sph; echo \"${COMPREPLY[@]}\"";
    // Where there is no bash, the text above is all that can be looked at.
    let told = std::process::Command::new("bash")
        .args(["-c", asked])
        .current_dir(bench.folder())
        .output();
    if let Ok(told) = told {
        assert_eq!(String::from_utf8_lossy(&told.stdout).trim(), "explain");
    }
}

#[test]
fn the_reference_and_the_gallery_are_what_the_program_prints() {
    for (command, file, page) in [
        (
            "plugins --markdown",
            "reference.md",
            include_str!("../../../../docs/reference.md"),
        ),
        (
            "scenes --markdown",
            "gallery.md",
            include_str!("../../../../docs/gallery.md"),
        ),
    ] {
        let printed = bench!().done(command).out;
        assert!(
            printed == page,
            "docs/{file} is another: cargo run -p sph-cli -- {command} > docs/{file}"
        );
    }
}

/// A page that no reader is led to is not in the book.
#[test]
fn every_page_of_docs_is_in_the_table_of_contents_once() {
    let docs = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let summary = std::fs::read_to_string(docs.join("SUMMARY.md")).expect("a table of contents");
    let inner = |folder: &str| std::fs::read_dir(docs.join(folder)).expect("a folder");
    let mut pages = 0;
    for folder in ["", "tutorials/", "rheology/", "validation/"] {
        for entry in inner(folder) {
            let name = entry
                .expect("an entry")
                .file_name()
                .into_string()
                .expect("plain");
            if name.ends_with(".md") && name != "SUMMARY.md" {
                let link = format!("]({folder}{name})");
                assert_eq!(summary.matches(&link).count(), 1, "{link}");
                pages += 1;
            }
        }
    }
    assert_eq!(summary.matches("](").count(), pages, "links");
}

#[test]
fn manual_pages_are_printed_and_written() {
    let bench = bench!();
    let page = bench.done("man run").out;
    page.says(".TH sph-run 1 | checkpoint");
    assert!(bench.done("man").out.contains(".TH sph 1"));
    bench.refused("man rn").says("did you mean `run`?");
    bench.done("man --out pages");
    for name in ["sph.1", "sph-run.1", "sph-compare.1"] {
        bench.read(&format!("pages/{name}")).says(".SH NAME");
    }
}

#[test]
fn the_values_of_every_choice_are_listed() {
    let listed = bench!().done("plugins --json").out;
    let kinds: serde_json::Value = serde_json::from_str(&listed).expect("JSON");
    let plugins = kinds.as_array().into_iter().flatten();
    let plugins = plugins.flat_map(|kind| kind["plugins"].as_array().into_iter().flatten());
    let parameters = plugins.flat_map(|p| p["parameters"].as_array().into_iter().flatten());
    let choices: Vec<_> = parameters.filter(|p| p["type"] == "choice").collect();
    assert!(choices.len() > 30, "{}", choices.len());
    for parameter in choices {
        let values = parameter["choices"].as_array().map_or(0, Vec::len);
        assert!(values > 1, "{parameter}");
    }
    for (plugin, value) in [
        (
            "viscous-operator morris",
            "or \"rows\": Scaled to be exact in the mean",
        ),
        (
            "rheology bingham",
            "one of { papanastasiou = { stress_growth } }: ",
        ),
        ("mover rigid-body", "or \"rz\": About z"),
        ("damping rayleigh", "zones (array; optional)"),
    ] {
        let told = bench!().done(&format!("plugins {plugin}")).out;
        assert!(told.contains(value), "{value}: {told}");
    }
}
