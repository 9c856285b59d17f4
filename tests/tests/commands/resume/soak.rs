//! One scene with gates, two phases and every kind of output, killed at random moments and resumed each time.
//!
//! `cargo test -p sph-tests --test commands resume -- --ignored --nocapture soak` does it for half an hour
//! (`SPH_SOAK_MINUTES`; `SPH_SOAK_SEED` repeats the draws, though not the moments of the machine).

use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant, SystemTime};

use sph_core::SplitMix;
use sph_io::Checkpoint;
use sph_tests::{Bench, Results, SOAK, bench, files_with_extension};

/// What happens when.
struct Draws(SplitMix);

impl Draws {
    /// Less than `n`.
    fn below(&mut self, n: u64) -> u64 {
        self.0.next() % n
    }

    fn part_of(&mut self, whole: Duration) -> Duration {
        whole.mul_f64(self.0.unit())
    }
}

/// How a part of the run is ended.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    /// `SIGKILL` at a random moment.
    Killed,
    /// `SIGKILL` before it has done much: while it assembles, or cuts what it resumes.
    KilledEarly,
    /// `SIGKILL` as soon as a file is under way.
    KilledWriting,
    /// `SIGKILL` as soon as there is another checkpoint.
    KilledAtCheckpoint,
    /// `SIGINT`, on which it stops with a checkpoint.
    Interrupted,
    /// `SIGINT`, and `SIGKILL` while it is about to stop.
    InterruptedAndKilled,
    /// `SIGTERM`, on which it does the same.
    Terminated,
}

impl End {
    fn drawn(draws: &mut Draws) -> Self {
        match draws.below(20) {
            0..6 => End::Killed,
            6..8 => End::KilledEarly,
            8..12 => End::KilledWriting,
            12..14 => End::KilledAtCheckpoint,
            14..16 => End::Interrupted,
            16..18 => End::InterruptedAndKilled,
            _ => End::Terminated,
        }
    }
}

/// A run that is ended again and again.
struct Soak<'a> {
    bench: &'a Bench,
    /// Overrides.
    set: &'static str,
    /// Longest life of a part.
    life: Duration,
    /// Parts after which it is left in peace.
    most: usize,
}

/// What was done to a run.
#[derive(Debug, Default)]
struct Tally {
    kills: usize,
    while_writing: usize,
    interrupts: usize,
    resumes: usize,
    fresh_starts: usize,
    steps: u64,
}

impl Soak<'_> {
    fn run(&self, out: &str, draws: &mut Draws) -> Tally {
        let folder = self.bench.path(out);
        let mut tally = Tally::default();
        let (mut kept, mut parts) = (0, 0);
        loop {
            let resume = match folder.join("checkpoint.sph").exists() {
                true => "--resume",
                false => "",
            };
            match resume {
                "" => tally.fresh_starts += 1,
                _ => tally.resumes += 1,
            }
            let threads = 1 + draws.below(3);
            let words = format!(
                "run scene.toml --quiet --out {out} --threads {threads} {} {resume}",
                self.set
            );
            let mut child = self.bench.command(&words).spawn().expect("a run");
            parts += 1;
            let end = (parts <= self.most).then(|| End::drawn(draws));
            let ended = end.is_some_and(|end| self.ended(&mut child, end, &folder, draws));
            let output = child.wait_with_output().expect("the end of the run");
            let err = String::from_utf8_lossy(&output.stderr);
            if output.status.success() {
                tally.steps = Results::read(&folder).steps();
                return tally;
            }
            let asked = matches!(
                end,
                Some(End::Interrupted | End::InterruptedAndKilled | End::Terminated)
            );
            let expected = ended && (output.status.code().is_none() || asked);
            assert!(expected, "{words}: {}\n{err}", output.status);
            match end {
                Some(End::Interrupted) => tally.interrupts += 1,
                Some(End::KilledWriting) => {
                    tally.kills += 1;
                    tally.while_writing += 1;
                }
                _ => tally.kills += 1,
            }
            let steps = examined(&folder);
            assert!(steps >= kept, "from step {kept} back to {steps}");
            kept = steps;
        }
    }

    /// Ends a part; whether it was still there to be ended.
    fn ended(&self, child: &mut Child, end: End, folder: &Path, draws: &mut Draws) -> bool {
        let life = match end {
            End::KilledEarly => draws.part_of(self.life / 20),
            _ => draws.part_of(self.life),
        };
        if !lives(child, life, || false) {
            return false;
        }
        let checkpoint = folder.join("checkpoint.sph");
        let written = |path: &Path| path.metadata().and_then(|m| m.modified()).ok();
        let before = written(&checkpoint);
        let there = match end {
            End::KilledWriting => lives(child, self.life, || under_way(folder)),
            End::KilledAtCheckpoint => lives(child, self.life, || written(&checkpoint) != before),
            _ => true,
        };
        if !there {
            return false;
        }
        let signal = |name: &str| {
            let pid = child.id().to_string();
            let sent = Command::new("kill").args([name, &pid]).status();
            sent.expect("kill").success()
        };
        match end {
            End::Interrupted => signal("-INT"),
            End::InterruptedAndKilled => {
                signal("-INT");
                let wait = draws.part_of(Duration::from_millis(30));
                // It may be gone by then, with a checkpoint.
                lives(child, wait, || false);
                let _ = child.kill();
                true
            }
            End::Terminated => signal("-TERM"),
            _ => child.kill().is_ok(),
        }
    }
}

/// Waits for something, at most so long; whether the run is still there.
fn lives(child: &mut Child, most: Duration, until: impl Fn() -> bool) -> bool {
    let start = Instant::now();
    while !until() && start.elapsed() < most {
        if child.try_wait().expect("a child").is_some() {
            return false;
        }
        sleep(Duration::from_micros(200).min(most));
    }
    true
}

/// Files that are being written, in all folders of a run.
fn temporaries(folder: &Path) -> Vec<PathBuf> {
    files_with_extension(folder, "tmp")
}

fn under_way(folder: &Path) -> bool {
    !temporaries(folder).is_empty()
}

/// Fails if anything but a temporary is half written; the step of the checkpoint.
fn examined(folder: &Path) -> u64 {
    for (kind, last) in [
        ("png", &b"IEND\xaeB`\x82"[..]),
        ("vtu", b"</VTKFile>\n"),
        ("pvd", b"</VTKFile>\n"),
        ("json", b"}\n"),
    ] {
        for path in files_with_extension(folder, kind) {
            let bytes = std::fs::read(&path).expect("a file");
            assert!(bytes.ends_with(last), "{} is torn", path.display());
        }
    }
    let checkpoint = folder.join("checkpoint.sph");
    if !checkpoint.exists() {
        return 0;
    }
    let checkpoint = Checkpoint::load(checkpoint).expect("a whole checkpoint");
    let run = &checkpoint.meta["run"];
    let told = run["series_position"].as_u64().expect("a place") as usize;
    let series = std::fs::read(folder.join("series.csv")).expect("a series");
    assert_eq!(series.get(told - 1), Some(&b'\n'), "rows are lost");
    run["steps"].as_u64().expect("a number of steps")
}

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Runs the scene whole, then over and over under kills until that is `enough` of them in this time, and compares.
fn soak(
    set: &'static str,
    life: Duration,
    most: usize,
    enough: impl Fn(&Tally, Duration) -> bool,
) -> Tally {
    let seed = number("SPH_SOAK_SEED").unwrap_or_else(|| {
        let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
        now.map_or(1, |t| t.as_nanos() as u64)
    });
    println!("SPH_SOAK_SEED={seed}");
    let mut draws = Draws(SplitMix(seed));
    let bench = bench!(SOAK);
    bench.done(&format!(
        "run scene.toml --quiet --out whole --threads 2 {set}"
    ));
    let whole = Results::read(&bench.path("whole"));
    println!("uninterrupted: {} steps", whole.steps());
    let soak = Soak {
        bench: &bench,
        set,
        life,
        most,
    };
    let start = Instant::now();
    let mut all = Tally::default();
    for round in 0.. {
        let out = format!("round-{round}");
        let tally = soak.run(&out, &mut draws);
        println!(
            "{out} after {:.0} s: {tally:?}",
            start.elapsed().as_secs_f64()
        );
        let folder = bench.path(&out);
        whole.assert_same(&Results::read(&folder), &format!("seed {seed}, {out}"));
        assert!(!under_way(&folder), "{:?}", temporaries(&folder));
        all.kills += tally.kills;
        all.while_writing += tally.while_writing;
        all.interrupts += tally.interrupts;
        all.resumes += tally.resumes;
        all.fresh_starts += tally.fresh_starts;
        all.steps += tally.steps;
        std::fs::remove_dir_all(folder).expect("a folder less");
        assert!(all.kills.min(all.resumes) * 10 >= round, "{all:?}");
        if enough(&all, start.elapsed()) {
            break;
        }
    }
    println!("in all: {all:?}");
    all
}

#[test]
fn a_run_killed_at_random_moments_loses_no_step() {
    let set = "--set numerics.spacing=0.02 --set run.end=0.3";
    // A fast machine may be through before the fourth kill, and is given another round.
    let enough = |tally: &Tally, _| tally.kills >= 4 && tally.resumes >= 3;
    let tally = soak(set, Duration::from_millis(500), 12, enough);
    assert!(tally.kills >= 4 && tally.resumes >= 3, "{tally:?}");
}

#[test]
#[ignore = "half an hour; SPH_SOAK_MINUTES says how long"]
fn soak_for_half_an_hour() {
    let minutes = number("SPH_SOAK_MINUTES").unwrap_or(30);
    let set = "--set run.end=4 --set run.checkpoint_every=0.05 --set output.every=0.1";
    let at_least = Duration::from_secs(60 * minutes);
    let enough = |_: &Tally, spent| spent >= at_least;
    let tally = soak(set, Duration::from_secs(20), usize::MAX, enough);
    assert!(tally.kills as u64 >= minutes, "{tally:?}");
}
