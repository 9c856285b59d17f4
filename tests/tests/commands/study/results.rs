//! What a study leaves behind, and what it does not run twice.

use serde_json::Value;
use sph_tests::{Says, exchanged};

use crate::study::{STUDY, bench, files};

#[test]
fn a_study_leaves_a_table_plots_and_a_page_and_runs_nothing_twice() {
    let bench = bench(STUDY);
    let outcome = bench.done("study s.toml --threads 1");
    outcome
        .out
        .says("order of morris | krimi | report.html | velocity-l1");
    let folder = bench.path("results/studies/s");
    assert_eq!(
        files(&folder).join(" "),
        "error-against-refinement.png error-against-refinement.svg error-against-time.png error-against-time.svg \
         report.html study.csv study.json variants"
    );
    let variant = folder.join("variants/morris_spacing-0.05");
    let left = files(&variant).join(" ");
    assert_eq!(left, "record.json series.csv summary.json");

    let told = bench.json("results/studies/s/study.json");
    assert_eq!(told["schema_version"], 1);
    assert!(told["machine"]["cores"].as_u64() > Some(0));
    let told_machine = told["machine"]["cpu"].as_str().expect("a name").to_string();
    let variants = told["variants"].as_array().expect("variants");
    assert_eq!(variants.len(), 6);
    for variant in variants {
        assert_eq!(variant["status"], "done", "{variant:#}");
        assert!(variant["errors"]["velocity-l1"]["value"].as_f64() > Some(0.0));
        assert!(variant["wall_seconds"]["min"].as_f64() > Some(0.0));
        assert!(variant["steps"].as_u64() > Some(3));
        assert!(variant["dt_limiter"].is_string());
    }
    let orders = &told["series"][0]["orders"]["velocity-l1"];
    assert_eq!(orders["between"].as_array().map(Vec::len), Some(2));
    assert!(orders["finest_three"].is_f64());
    assert_eq!(bench.read("results/studies/s/study.csv").lines().count(), 7);
    let page = bench.read("results/studies/s/report.html");
    page.says("<svg | Pareto | Convergence | 0.05 | set.run.end");
    let commit = told["commit"].as_str().unwrap_or("unknown").to_string();
    let told = |key: &str| told[key].as_str().expect("a text").to_string();
    for (name, value) in [
        ("machine", told_machine),
        ("version", format!("sph {}", told("version"))),
        ("commit", commit),
        ("built with", told("built_with")),
    ] {
        let row = format!("<td>{name}</td><td>{value}");
        assert!(page.contains(&row), "no `{row}` on the page");
    }
    for library in ["rustc 1.", "faer 0.", "rayon 1."] {
        told("built_with").says(library);
    }
    page.lacks("src= | href=");

    // The same again runs nothing; a new value on an axis runs what is new.
    let record = |name: &str| bench.read(&format!("results/studies/s/variants/{name}/record.json"));
    let before = record("krimi_spacing-0.04");
    let again = bench.done("study s.toml --threads 1");
    again.says("6 variants, 0 to run");
    bench.write("s.toml", STUDY.replace("0.04]", "0.04, 0.1]"));
    let more = bench.done("study s.toml --threads 1 --only krimi*");
    more.says("8 variants, 1 to run");
    assert!(more.out.contains("pending"), "{}", more.out);
    assert_eq!(record("krimi_spacing-0.04"), before);
    // Another scene is run again.
    let other = bench.done("study s.toml --threads 1 --only krimi* --set run.end=0.01");
    other.says("8 variants, 4 to run");
    assert_ne!(record("krimi_spacing-0.04"), before);
}

#[test]
fn variants_side_by_side_give_the_same_errors() {
    let bench = bench(&exchanged(STUDY, "set.run", "serial = false\nset.run"));
    let errors = |text: &str| -> Vec<f64> {
        let all: Value = serde_json::from_str(text).expect("JSON");
        let all = all["variants"].as_array().expect("variants").clone();
        let value = |v: &Value| v["errors"]["velocity-l1"]["value"].as_f64();
        all.iter().map(|v| value(v).expect("an error")).collect()
    };
    let parallel = errors(&bench.done("study s.toml --json --quiet --threads 3").out);
    bench.write("s.toml", STUDY);
    let serial = errors(
        &bench
            .done("study s.toml --json --quiet --fresh --threads 2")
            .out,
    );
    assert_eq!(parallel, serial);
}

#[test]
fn repetitions_give_the_least_time_and_missing_ones_are_added() {
    let short = STUDY.replace("0.0625, 0.05, 0.04", "0.0625");
    let bench = bench(&short);
    let times = |n: usize| {
        let study = short.replace("set.run", &format!("repetitions = {n}\nset.run"));
        bench.write("s.toml", &study);
        let told = bench.done("study s.toml --quiet --json").json();
        let wall = &told["variants"][0]["wall_seconds"];
        let number = |v: &Value| v.as_f64().expect("seconds");
        let all: Vec<f64> = wall["all"]
            .as_array()
            .expect("a list")
            .iter()
            .map(number)
            .collect();
        assert_eq!(
            number(&wall["min"]),
            all.iter().copied().fold(f64::INFINITY, f64::min)
        );
        all
    };
    let two = times(2);
    let three = times(3);
    assert_eq!((two.len(), three.len()), (2, 3));
    assert_eq!(two, three[..2], "what has run is kept");
}

#[test]
fn two_studies_are_compared() {
    let bench = bench(&STUDY.replace("[0.0625, 0.05, 0.04]", "[0.0625, 0.05]"));
    bench.done("study s.toml --quiet --out a");
    bench.done("study s.toml --quiet --out b --set smoother.brezzi-pitkaranta.strength=0.04");
    let mut other = bench.json("b/study.json");
    other["machine"]["cpu"] = "another".into();
    other["variants"].as_array_mut().expect("variants").pop();
    bench.write("b.json", other.to_string());
    let told = bench.done("study --compare a/study.json b.json").out;
    told.says("morris_spacing-0.05 | → another | × | only in a/study.json");
    let told = bench
        .done("study --json --compare a/study.json b.json")
        .json();
    assert_eq!(told["variants"].as_array().map(Vec::len), Some(3));
    assert_eq!(told["only_in_first"][0], "krimi_spacing-0.05");
    let none = bench.refused("study --compare a/study.json s.toml");
    none.says("`s.toml` is no study.json");
}
