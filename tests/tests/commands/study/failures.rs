//! What goes wrong in a variant, on the disk or by Ctrl-C costs no finished one.

use serde_json::Value;
use sph_tests::{Disk, Says, wait_until};

use crate::study::{STUDY, bench, files};

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
    let told = bench.json("results/studies/s/study.json");
    let status = |k: usize| {
        (
            &told["variants"][k]["status"],
            &told["variants"][k]["reason"],
        )
    };
    let (failed, reason) = status(0);
    assert_eq!(failed, "failed", "{}", outcome.out);
    let reason = reason.as_str().expect("a reason");
    reason.says("density of particle");
    assert_eq!(status(1).0, "over-limit");
    assert_eq!(status(2).0, "done");
    let page = bench.read("results/studies/s/report.html");
    assert!(page.contains("density of particle") && page.contains("over limit"));
    // Both are settled, until the limit is raised.
    bench.done("study s.toml").says("3 variants, 0 to run");
    bench.write("s.toml", FAILING.replace("0.2 s", "0.3 s"));
    bench.done("study s.toml").says("3 variants, 1 to run");
}

#[test]
fn a_full_disk_costs_the_running_variant_and_no_finished_one() {
    let bench = bench(STUDY);
    let at = bench.path("disk");
    let Some(disk) = Disk::mount(96, &at) else {
        println!("skipped: mounting a small file system is not permitted here");
        return;
    };
    let outcome = bench.failed("study s.toml --out disk/s");
    outcome.says("disk full | of 6 variants are finished and kept");
    let done = |name: &String| {
        let record = format!("disk/s/variants/{name}/record.json");
        bench.path(&record).exists() && bench.json(&record)["status"] == "done"
    };
    let names = files(&bench.path("disk/s/variants"));
    let kept = names.iter().filter(|n| done(n)).count();
    assert!(kept > 0 && kept < 6, "{kept} are kept");

    disk.grow(8192);
    let on = bench.done("study s.toml --out disk/s");
    on.says(&format!("6 variants, {} to run", 6 - kept));
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_what_is_finished_and_the_same_command_goes_on() {
    let short = STUDY.replace("numerics.spacing", "run.end");
    let bench = bench(&short.replace("[0.0625, 0.05, 0.04]", "[0.02, 40.0]"));
    let set = "--set numerics.spacing=0.0625 --only morris*";
    let command = format!("study s.toml --threads 1 {set}");
    let mut study = bench.start(&command);
    let folder = bench.path("results/studies/s/variants");
    let checkpoint = folder.join("morris_end-40/checkpoint.sph");
    wait_until("it does not get on", || {
        assert!(!study.is_over(), "it ended early");
        checkpoint.exists()
    });
    study.signal("-INT");
    let stopped = study.end().ended(1);
    stopped.says("1 of 4 variants are finished and kept | sph study s.toml --threads 1 --only");
    let told = bench.json("results/studies/s/study.json");
    assert_eq!(told["variants"][1]["status"], "interrupted");

    let on = bench.done(&command);
    on.says("4 variants, 1 to run | resuming at t = ");
    let told = bench.json("results/studies/s/study.json");
    assert_eq!(told["variants"][1]["status"], "done");
    // It ends like one that was not interrupted.
    let whole = bench.done(&format!("{command} --out whole --json"));
    let error = |told: &Value| told["variants"][1]["errors"]["velocity-l1"].clone();
    assert_eq!(error(&told), error(&whole.json()));
}
