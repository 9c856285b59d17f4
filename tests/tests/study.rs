//! Studies as a person or a script meets them.

use std::path::Path;

use serde_json::Value;
use sph_study::{SceneText, Study};
use sph_tests::{Bench, Disk, Outcome};

const PROGRAM: &str = env!("CARGO_BIN_EXE_sph-under-test");

/// Vortices in a small box, some ten steps long.
const STUDY: &str = r#"title = "Vortices"
scene = "taylor-green-2d"
error = "velocity-l1"
set.run.end = 0.02

[[vary]]
name = "viscosity"
entries = [
    { name = "morris", set = { viscous-operator.morris = {} } },
    { name = "krimi", set = { viscous-operator.krimi = {} } },
]

[[vary]]
key = "numerics.spacing"
values = [0.0625, 0.05, 0.04]
"#;

fn bench(study: &str) -> Bench {
    let bench = Bench::new(PROGRAM);
    bench.write("s.toml", study);
    bench
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let name = |e: std::io::Result<std::fs::DirEntry>| e.expect("an entry").file_name();
    let mut names: Vec<String> = entries
        .map(|e| name(e).into_string().expect("a plain name"))
        .collect();
    names.sort();
    names
}

/// Replaces a part of the study; the part must be there.
fn with(from: &str, to: &str) -> String {
    assert!(STUDY.contains(from), "the study lost `{from}`");
    STUDY.replacen(from, to, 1)
}

fn says(outcome: &Outcome, words: &[&str]) {
    for word in words {
        assert!(
            outcome.err.contains(word),
            "no `{word}` in\n{}",
            outcome.err
        );
    }
}

/// The study is refused with code 2, at the line that contains `line`, and leaves no file.
fn refused(study: &str, line: &str, words: &[&str]) {
    let bench = bench(study);
    let number = 1 + study
        .lines()
        .position(|l| l.contains(line))
        .expect("the line is there");
    let outcome = bench.call("study s.toml");
    assert_eq!(outcome.code, Some(2), "{}", outcome.err);
    says(&outcome, words);
    says(&outcome, &[&format!("s.toml:{number}:")]);
    assert_eq!(files(bench.folder()), ["s.toml"], "something was written");
}

#[test]
fn a_study_leaves_a_table_plots_and_a_page_and_runs_nothing_twice() {
    let bench = bench(STUDY);
    let outcome = bench.done("study s.toml --threads 1");
    for word in ["order of morris", "krimi", "report.html", "velocity-l1"] {
        assert!(
            outcome.out.contains(word),
            "no `{word}` in\n{}",
            outcome.out
        );
    }
    let folder = bench.path("results/studies/s");
    assert_eq!(
        files(&folder),
        [
            "error-against-refinement.png",
            "error-against-refinement.svg",
            "error-against-time.png",
            "error-against-time.svg",
            "report.html",
            "study.csv",
            "study.json",
            "variants"
        ]
    );
    let variant = folder.join("variants/morris_spacing-0.05");
    assert_eq!(
        files(&variant),
        ["record.json", "series.csv", "summary.json"]
    );

    let told = json(&bench.read("results/studies/s/study.json"));
    assert_eq!(told["schema_version"], 1);
    assert!(told["machine"]["cores"].as_u64() > Some(0));
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
    for word in ["<svg", "Pareto", "Convergence", "0.05", "set.run.end"] {
        assert!(page.contains(word), "no `{word}` on the page");
    }
    assert!(
        !page.contains("src=") && !page.contains("href="),
        "the page needs other files"
    );

    // The same again runs nothing; a new value on an axis runs what is new.
    let record = |name: &str| bench.read(&format!("results/studies/s/variants/{name}/record.json"));
    let before = record("krimi_spacing-0.04");
    let again = bench.done("study s.toml --threads 1");
    says(&again, &["6 variants, 0 to run"]);
    bench.write("s.toml", &STUDY.replace("0.04]", "0.04, 0.1]"));
    let more = bench.done("study s.toml --threads 1 --only krimi*");
    says(&more, &["8 variants, 1 to run"]);
    assert!(more.out.contains("pending"), "{}", more.out);
    assert_eq!(record("krimi_spacing-0.04"), before);
    // Another scene is run again.
    let other = bench.done("study s.toml --threads 1 --only krimi* --set run.end=0.01");
    says(&other, &["8 variants, 4 to run"]);
    assert_ne!(record("krimi_spacing-0.04"), before);
}

#[test]
fn variants_side_by_side_give_the_same_errors() {
    let bench = bench(&with("set.run.end", "serial = false\nset.run.end"));
    let errors = |text: &str| -> Vec<f64> {
        let all = json(text);
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
        let told = json(&bench.done("study s.toml --quiet --json").out);
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
fn a_misspelt_key_of_the_study_is_refused() {
    let words = ["did you mean `values`", "nothing was written"];
    refused(&with("values", "valeus"), "valeus", &words);
    refused(&with("error", "eror"), "eror", &["did you mean `error`"]);
    let time = with("[[vary]]\nname", "[[vary]]\ntime_limit = 1\nname");
    refused(&time, "time_limit", &["vary[0].time_limit"]);
}

#[test]
fn a_misspelt_scene_key_is_shown_in_the_study() {
    refused(
        &with("numerics.spacing", "numerics.spcing"),
        "[0.0625",
        &["numerics.spcing", "did you mean `spacing`"],
    );
    refused(
        &with("krimi = {}", "krimmi = {}"),
        "krimmi",
        &[
            "no viscous-operator called `krimmi`",
            "did you mean `krimi`",
        ],
    );
    refused(
        &with("0.05, ", "-0.05, "),
        "-0.05",
        &["numerics.spacing", "more than 0"],
    );
    refused(
        &with("run.end", "run.edn"),
        "run.edn",
        &["did you mean `end`"],
    );
}

#[test]
fn an_error_or_scene_that_is_not_there_is_refused() {
    refused(
        &with("velocity-l1", "velocity-l2"),
        "velocity-l2",
        &[
            "no reference called `velocity-l2`",
            "did you mean `velocity-l1`",
        ],
    );
    refused(
        &with("taylor-green-2d", "tailor-green-2d"),
        "tailor",
        &["did you mean `taylor-green-2d`"],
    );
    refused(
        &with("[[vary]]", "[[skip]]\nviscosity = \"moris\"\n[[vary]]"),
        "moris",
        &["did you mean `morris`"],
    );
    let bench = bench(STUDY);
    for words in [
        "study nosuch",
        "study",
        "study s.toml --only x*",
        "study s.toml --set a",
    ] {
        assert_eq!(bench.call(words).code, Some(2), "sph {words}");
    }
    assert_eq!(files(bench.folder()), ["s.toml"]);
}

/// One variant whose density leaves its bounds, one that takes too long, one that is good.
const FAILING: &str = r#"title = "One of three cannot work, one is too slow"
scene = "taylor-green-2d"
error = "velocity-l1"
set.numerics.spacing = 0.05
time_limit = "0.2 s"

[[vary]]
name = "case"
entries = [
    { name = "lost", set = { numerics.density_bounds = [0.9999, 1.0001], run.retries = 0 } },
    { name = "long", set = { run.end = 1e6, output.every = 1e5 } },
    { name = "good", set = { run.end = 0.02 } },
]
"#;

#[test]
fn a_variant_that_fails_is_recorded_and_the_study_goes_on() {
    let bench = bench(FAILING);
    let outcome = bench.done("study s.toml");
    let told = json(&bench.read("results/studies/s/study.json"));
    let status = |k: usize| {
        (
            &told["variants"][k]["status"],
            &told["variants"][k]["reason"],
        )
    };
    let (failed, reason) = status(0);
    assert_eq!(failed, "failed", "{}", outcome.out);
    let reason = reason.as_str().expect("a reason");
    assert!(reason.contains("density of particle"), "{reason}");
    assert_eq!(status(1).0, "over-limit");
    assert_eq!(status(2).0, "done");
    let page = bench.read("results/studies/s/report.html");
    assert!(page.contains("density of particle") && page.contains("over limit"));
    // Both are settled, until the limit is raised.
    says(&bench.done("study s.toml"), &["3 variants, 0 to run"]);
    bench.write("s.toml", &FAILING.replace("0.2 s", "0.3 s"));
    says(&bench.done("study s.toml"), &["3 variants, 1 to run"]);
}

#[test]
fn a_full_disk_costs_the_running_variant_and_no_finished_one() {
    let bench = bench(STUDY);
    let at = bench.path("disk");
    let Some(disk) = Disk::of(96, &at) else {
        println!("skipped: mounting a small file system is not permitted here");
        return;
    };
    let outcome = bench.call("study s.toml --out disk/s");
    assert_eq!(outcome.code, Some(1), "{}", outcome.err);
    says(
        &outcome,
        &["disk full", "of 6 variants are finished and kept"],
    );
    let done = |name: &String| {
        let record = format!("disk/s/variants/{name}/record.json");
        bench.path(&record).exists() && json(&bench.read(&record))["status"] == "done"
    };
    let names = files(&bench.path("disk/s/variants"));
    let kept = names.iter().filter(|n| done(n)).count();
    assert!(kept > 0 && kept < 6, "{kept} are kept");

    disk.grow(8192);
    let on = bench.done("study s.toml --out disk/s");
    says(&on, &[&format!("6 variants, {} to run", 6 - kept)]);
}

#[test]
fn two_studies_are_compared() {
    let bench = bench(&STUDY.replace("[0.0625, 0.05, 0.04]", "[0.0625, 0.05]"));
    bench.done("study s.toml --quiet --out a");
    bench.done("study s.toml --quiet --out b --set smoother.brezzi-pitkaranta.strength=0.1");
    let mut other = json(&bench.read("b/study.json"));
    other["machine"]["cpu"] = "another".into();
    other["variants"].as_array_mut().expect("variants").pop();
    bench.write("b.json", &other.to_string());
    let told = bench.done("study --compare a/study.json b.json").out;
    for word in [
        "morris_spacing-0.05",
        "→ another",
        "×",
        "only in a/study.json",
    ] {
        assert!(told.contains(word), "no `{word}` in\n{told}");
    }
    let told = json(&bench.done("study --json --compare a/study.json b.json").out);
    assert_eq!(told["variants"].as_array().map(Vec::len), Some(3));
    assert_eq!(told["only_in_first"][0], "krimi_spacing-0.05");
    let none = bench.call("study --compare a/study.json s.toml");
    assert_eq!(none.code, Some(2));
    says(&none, &["`s.toml` is no study.json"]);
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_what_is_finished_and_the_same_command_goes_on() {
    let study = STUDY.replace("numerics.spacing", "run.end");
    let bench = bench(&study.replace("[0.0625, 0.05, 0.04]", "[0.02, 40.0]"));
    let set = "--set numerics.spacing=0.0625 --only morris*";
    let command = format!("study s.toml --threads 1 {set}");
    let mut child = bench.command(&command).spawn().expect("a study");
    let folder = bench.path("results/studies/s/variants");
    let checkpoint = folder.join("morris_end-40/checkpoint.sph");
    let start = std::time::Instant::now();
    while !checkpoint.exists() {
        assert!(
            child.try_wait().expect("a child").is_none(),
            "it ended early"
        );
        assert!(start.elapsed().as_secs() < 60, "it does not get on");
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    let pid = child.id().to_string();
    let signal = std::process::Command::new("kill")
        .args(["-INT", &pid])
        .status();
    assert!(signal.expect("kill").success());
    let output = child.wait_with_output().expect("the end of the study");
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(
        err.contains("1 of 4 variants are finished and kept"),
        "{err}"
    );
    assert!(err.contains("sph study s.toml --threads 1 --only"), "{err}");
    let told = json(&bench.read("results/studies/s/study.json"));
    assert_eq!(told["variants"][1]["status"], "interrupted");

    let on = bench.done(&command);
    says(&on, &["4 variants, 1 to run", "resuming at t = "]);
    let told = json(&bench.read("results/studies/s/study.json"));
    assert_eq!(told["variants"][1]["status"], "done");
    // It ends like one that was not interrupted.
    let whole = bench.done(&format!("{command} --out whole --json"));
    let error = |told: &Value| told["variants"][1]["errors"]["velocity-l1"].clone();
    assert_eq!(error(&told), error(&json(&whole.out)));
}

#[test]
fn shipped_studies_are_good() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let find = |_: &Path, name: &str| {
        let path = root.join(format!("scenes/{name}.toml"));
        let text = std::fs::read_to_string(&path).map_err(|e| e.to_string())?;
        let (name, file) = (name.to_string(), path.display().to_string());
        Ok(SceneText { name, text, file })
    };
    for file in files(&root.join("studies")) {
        let path = root.join("studies").join(file);
        let study = Study::read(&path, &find, &[], &[]);
        let study = study.unwrap_or_else(|e| panic!("{path:?}: {e}"));
        // Assembling fine ones would take longer than running coarse ones.
        let coarse = study.variants.iter().map(|v| v.refinement.unwrap_or(1.0));
        let coarsest = coarse.fold(0.0, f64::max);
        for variant in &study.variants {
            if variant.refinement.is_none_or(|h| h == coarsest) {
                let good = study.assemble(variant, 1);
                good.unwrap_or_else(|e| panic!("{path:?}: {}: {e}", variant.name));
            }
        }
    }
}
