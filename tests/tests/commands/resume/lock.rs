//! A run has its folder for itself.

use sph_tests::{DAM_BREAK, Results, bench, wait_until};

use crate::resume::uninterrupted;

/// A scene that runs until it is stopped.
fn endless() -> String {
    DAM_BREAK.replace("end = 0.4", "end = 400.0")
}

#[test]
fn a_second_run_is_refused_while_the_first_goes_on_and_not_after() {
    let bench = bench!(&endless());
    let run = "run scene.toml --quiet --out r";
    let mut first = bench.start_until(run, "r", 0.05);
    for more in ["", " --resume", " --resume --changed --set run.safety=0.5"] {
        let second = bench.failed(&format!("{run}{more}"));
        let holder = format!("r is in use by process {} on ", first.child().id());
        second.says(&format!("{holder} |  since 20 | another folder"));
        assert!(!second.err.contains("overwritten"), "{}", second.err);
    }
    assert!(!first.is_over(), "the first died");
    // Another folder is free.
    bench.done("run scene.toml --quiet --out other --set run.end=0.02");
    first.signal("-INT");
    first.end().ended(1);
    let locked = bench.path("r/.lock").exists();
    assert!(!locked, "the lock was not given back");
}

#[test]
fn the_lock_of_a_killed_run_is_taken_over_with_a_word() {
    let bench = bench!(DAM_BREAK);
    let whole = uninterrupted(&bench);
    let mut run = bench.start_until("run scene.toml --quiet --out r", "r", 0.1);
    run.kill();
    assert!(bench.path("r/.lock").exists(), "nothing to take over");
    let again = bench.done("run scene.toml --out r --resume");
    let told = format!("process {} on ", run.child().id());
    again.says(&format!("{told} | taken over"));
    whole.assert_same(&Results::read(&bench.path("r")), "taken over");
    assert!(!bench.path("r/.lock").exists());
}

#[test]
fn a_run_that_fails_gives_its_folder_back() {
    let bench = bench!(DAM_BREAK);
    let bounds = "--set numerics.density_bounds=[0.9999,1.0001] --set run.retries=0";
    bench.failed(&format!("run scene.toml --out r {bounds}"));
    assert!(!bench.path("r/.lock").exists());
    bench.done("run scene.toml --quiet --out r --set run.end=0.02");
}

#[test]
fn variants_side_by_side_have_their_folders_and_a_second_study_is_refused() {
    let reference = "[reference.front]\nprobe = \"front\"\nfile = \"front.csv\"\n";
    let bench = bench!(&(endless() + reference));
    bench.write("front.csv", "time,front\n0,0.2\n400,0.6\n");
    let study = |end: &str| {
        format!(
            "title = \"t\"\nscene = \"scene.toml\"\nerror = \"front\"\nserial = false\n[set]\nrun.end = {end}\n\
             [[vary]]\nkey = \"run.safety\"\nvalues = [0.5, 0.6, 0.7, 0.8]\n"
        )
    };
    bench.write("s.toml", study("0.02"));
    bench.done("study s.toml --quiet --threads 4 --out done");
    assert!(!bench.path("done/.lock").exists());
    bench.write("s.toml", study("400.0"));
    let mut first = bench.start("study s.toml --quiet --threads 2 --out busy");
    // Both variants of the first two threads have their folders before anything is asked.
    wait_until("variants side by side at once", || {
        let folders = std::fs::read_dir(bench.path("busy/variants"));
        let folders = folders.into_iter().flatten().flatten();
        folders.filter(|f| f.path().join(".lock").exists()).count() >= 2
    });
    let second = bench.failed("study s.toml --quiet --threads 2 --out busy");
    let holder = first.child().id();
    second.says(&format!("busy is in use by process {holder}"));
}
