//! A run has its folder for itself.

use std::process::Command;

use sph_tests::{Bench, DAM_BREAK, Results};

use crate::resume::{PROGRAM, uninterrupted, wait_for};

/// A scene that runs until it is stopped.
fn endless() -> String {
    DAM_BREAK.replace("end = 0.4", "end = 400.0")
}

#[test]
fn a_second_run_is_refused_while_the_first_goes_on_and_not_after() {
    let bench = Bench::with(PROGRAM, &endless());
    let run = "run scene.toml --quiet --out r";
    let mut first = bench.command(run).spawn().expect("a run");
    wait_for(&mut first, &bench, "r", 0.05);
    for more in ["", " --resume", " --resume --changed --set run.safety=0.5"] {
        let second = bench.call(&format!("{run}{more}"));
        assert_eq!(second.code, Some(1), "{}", second.err);
        let holder = format!("r is in use by process {} on ", first.id());
        for told in [holder.as_str(), " since 20", "another folder"] {
            assert!(second.err.contains(told), "no `{told}` in {}", second.err);
        }
        assert!(!second.err.contains("overwritten"), "{}", second.err);
    }
    assert!(
        first.try_wait().expect("a child").is_none(),
        "the first died"
    );
    // Another folder is free.
    bench.done("run scene.toml --quiet --out other --set run.end=0.02");
    let pid = first.id().to_string();
    let sent = Command::new("kill").args(["-INT", &pid]).status();
    assert!(sent.expect("kill").success());
    assert_eq!(first.wait().expect("an end").code(), Some(1));
    assert!(
        !bench.path("r/.lock").exists(),
        "the lock was not given back"
    );
}

#[test]
fn the_lock_of_a_killed_run_is_taken_over_with_a_word() {
    let bench = Bench::with(PROGRAM, DAM_BREAK);
    let whole = uninterrupted(&bench);
    let mut child = bench
        .command("run scene.toml --quiet --out r")
        .spawn()
        .expect("a run");
    wait_for(&mut child, &bench, "r", 0.1);
    child.kill().expect("SIGKILL");
    child.wait().expect("the end of the run");
    assert!(bench.path("r/.lock").exists(), "nothing to take over");
    let again = bench.done("run scene.toml --out r --resume");
    let told = format!("process {} on ", child.id());
    assert!(again.err.contains(&told), "{}", again.err);
    assert!(again.err.contains("taken over"), "{}", again.err);
    whole.assert_same(&Results::read(&bench.path("r")), "taken over");
    assert!(!bench.path("r/.lock").exists());
}

#[test]
fn a_run_that_fails_gives_its_folder_back() {
    let bench = Bench::with(PROGRAM, DAM_BREAK);
    let bounds = "--set numerics.density_bounds=[0.9999,1.0001] --set run.retries=0";
    let failed = bench.call(&format!("run scene.toml --out r {bounds}"));
    assert_eq!(failed.code, Some(1), "{}", failed.err);
    assert!(!bench.path("r/.lock").exists());
    bench.done("run scene.toml --quiet --out r --set run.end=0.02");
}

#[test]
fn variants_side_by_side_have_their_folders_and_a_second_study_is_refused() {
    let reference = "[reference.front]\nprobe = \"front\"\nfile = \"front.csv\"\n";
    let bench = Bench::with(PROGRAM, &(endless() + reference));
    bench.write("front.csv", "time,front\n0,0.2\n400,0.6\n");
    let study = |end: &str| {
        format!(
            "title = \"t\"\nscene = \"scene.toml\"\nerror = \"front\"\nserial = false\n[set]\nrun.end = {end}\n\
             [[vary]]\nkey = \"run.safety\"\nvalues = [0.5, 0.6, 0.7, 0.8]\n"
        )
    };
    bench.write("s.toml", &study("0.02"));
    bench.done("study s.toml --quiet --threads 4 --out done");
    assert!(!bench.path("done/.lock").exists());
    bench.write("s.toml", &study("400.0"));
    let mut first = bench
        .command("study s.toml --quiet --threads 2 --out busy")
        .spawn()
        .expect("a study");
    // Both variants of the first two threads have their folders before anything is asked.
    let held = || {
        let folders = std::fs::read_dir(bench.path("busy/variants"));
        let folders = folders.into_iter().flatten().flatten();
        folders.filter(|f| f.path().join(".lock").exists()).count()
    };
    let start = std::time::Instant::now();
    while held() < 2 && start.elapsed().as_secs() < 60 {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let both = held();
    let second = bench.call("study s.toml --quiet --threads 2 --out busy");
    let told = format!("busy is in use by process {}", first.id());
    // Ended before anything is asserted, so that it does not outlive a failure.
    first.kill().expect("SIGKILL");
    first.wait().expect("an end");
    assert_eq!(both, 2, "variants side by side at once");
    assert_eq!(second.code, Some(1), "{}", second.err);
    assert!(second.err.contains(&told), "{}", second.err);
}
