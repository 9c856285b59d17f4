//! A scene that is divided between ranks gives the bits of one process.

use sph_tests::{Bench, DAM_BREAK, FinalState, PADDLE, SOIL, bench};

/// A run's last state, after a run with these arguments.
fn ran(bench: &Bench, out: &str, arguments: &str) -> FinalState {
    let run = format!("run scene.toml --quiet --out {out} --threads 1");
    bench.done(&format!("{run} {arguments}"));
    bench.state(out)
}

/// A folder with the results that all ranks agree on, those of one in `r1`.
fn same_on_all_ranks(scene: &str, set: &str) -> Bench {
    let bench = bench!(scene);
    let one = ran(&bench, "r1", set);
    for ranks in [2, 3, 4] {
        let arguments = format!("--ranks {ranks} {set}");
        let state = ran(&bench, &format!("r{ranks}"), &arguments);
        one.assert_same(&state, &format!("1 and {ranks} ranks"));
    }
    bench
}

/// A scene without the tables that compare it, which ask for its files and its end.
fn without_references(scene: &str) -> String {
    let mut kept = true;
    let wanted = |line: &&str| {
        if line.starts_with('[') {
            kept = !line.starts_with("[reference") && !line.starts_with("[[reference");
        }
        kept
    };
    let lines: Vec<&str> = scene.lines().filter(wanted).collect();
    lines.join("\n")
}

/// Schemes that go back within a step have lists that are built anew in the middle of many of them; particles are born at open
/// faces, whatever their rank, and leave through others.
#[test]
fn flows_walls_soils_budgets_and_schemes_give_the_same_bits() {
    let channel = without_references(include_str!("../../../scenes/channel-open-2d.toml"));
    let coarse = "--set run.end=0.2 --set numerics.spacing=0.0625";
    for (scene, set) in [
        (DAM_BREAK, ""),
        (
            DAM_BREAK,
            "--set run.end=0.1 --set probe.energy.kind=energy-budget",
        ),
        (PADDLE, ""),
        (SOIL, "--set run.end=0.06"),
        (&channel, coarse),
    ] {
        same_on_all_ranks(scene, set);
    }
    for integrator in ["leap-frog", "verlet", "predictor-corrector"] {
        let scheme = format!("--set integrator.{integrator}={{}}");
        let set = format!("{scheme} --set numerics.skin=0.02 --set run.end=0.1");
        same_on_all_ranks(DAM_BREAK, &set);
    }
}

/// Water strikes a box: corners of one triangle may have their water on two ranks.
#[test]
fn pressures_on_walls_in_space_give_the_same_bits() {
    let scene = without_references(include_str!("../../../scenes/dam-break-spheric2.toml"));
    let bench = same_on_all_ranks(&scene, "--set numerics.spacing=0.06 --set run.end=0.5");
    assert!(bench.series("r1").last("box.pressure.x").abs() > 0.1);
}

#[test]
fn a_renormalised_surface_gives_the_same_bits() {
    for walls in ["usaw", "symmetric"] {
        let set = format!("--set surface={{renormalised={{}}}} --set walls={{{walls}={{}}}}");
        same_on_all_ranks(DAM_BREAK, &format!("{set} --set damping.acoustic={{}}"));
    }
}

/// Particles are shifted against the mean velocity of all, and a body feels the fluid of all.
#[test]
fn sums_over_all_ranks_do_not_depend_on_their_number() {
    let body = "[wall.float]\nbox = [[0.3, 0.04], [0.4, 0.1]]\nfluid = \"outside\"\n\
                condition = \"free-slip\"\nmover.rigid-body = { density = 500 }\n";
    let flush = DAM_BREAK.replace("vertices = true", "vertices = false");
    let probes = "[probe.float]\nkind = \"wall-force\"\nwall = \"float\"\n\
                  [probe.tank]\nkind = \"wall-force\"\nwall = \"tank\"\n";
    let scene = format!("{flush}\n[shifting.fickian]\n{body}{probes}");
    same_on_all_ranks(&scene, "--set run.end=0.1");
    // Scales of ghosts are those of their owners.
    let scaled = scene.replace("[walls.usaw]\nvertices = false\n", "[walls.symmetric]\n");
    same_on_all_ranks(&scaled, "--set run.end=0.1");
}

/// Who leaves is counted once.
#[test]
fn outlets_give_the_same_bits() {
    let scene = format!("{DAM_BREAK}\n[outlet.end]\nbeyond = 0.3\n");
    let bench = same_on_all_ranks(&scene, "--set run.end=0.3");
    assert!(bench.series("r1").last("outlet.end.water") > 0.0);
}

/// Iterations add up over ranks in an order that follows their number, so that velocities differ by what a solve leaves: a
/// share of 1e-8 of the right-hand side in each step, times the condition of the system, at most 1 + 4 νΔt/δr².
#[test]
fn solves_agree_to_their_tolerance() {
    let scene = format!("{DAM_BREAK}\n[implicit-viscosity.backward-euler]\n");
    let bench = bench!(&scene);
    let (steps, viscosity) = (20.0, 50.0);
    let set = format!(
        "--set phase.water.rheology.newtonian.viscosity={viscosity} --set run.max_steps={steps}"
    );
    let velocities = |ranks: u32| {
        let out = format!("r{ranks}");
        let call = format!("run scene.toml --quiet --out {out} --threads 1 --ranks {ranks} {set}");
        assert_eq!(bench.call(&call).code, Some(1), "it stops before its end");
        bench.state(&out).reals("velocity")
    };
    let one = velocities(1);
    let largest = one.iter().fold(0.0_f64, |m, u| m.max(u.abs()));
    // Δt is at most 0.4 h/c with h = 2 δr and c = 30 m/s.
    let spacing = 0.02;
    let dt = 0.4 * 2.0 * spacing / 30.0;
    let condition = 1.0 + 4.0 * viscosity / 1000.0 * dt / (spacing * spacing);
    let bound = steps * condition * 1e-8;
    for ranks in [2, 4] {
        let both = one.iter().zip(velocities(ranks));
        let apart = both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest;
        let told = format!("{ranks} ranks: {apart:.1e} of the largest, bound {bound:.1e}");
        println!("{told}");
        assert!(apart < bound, "{told}");
    }
}

/// A rank that fails takes the others back with it; in the end all give up, and the first tells why.
#[test]
fn ranks_fail_together() {
    let bench = bench!(DAM_BREAK);
    let set = "--set numerics.density_bounds=[0.99,1.005] --set run.retries=2";
    let told = |ranks: u32| {
        let failed = bench.failed(&format!(
            "run scene.toml --quiet --out f{ranks} --threads 1 --ranks {ranks} {set}"
        ));
        let checkpoint = bench.path(&format!("f{ranks}/checkpoint.sph"));
        assert!(checkpoint.is_file(), "{}", failed.err);
        let line = failed.err.lines().find(|l| l.contains("the run failed at"));
        line.unwrap_or_else(|| panic!("{}", failed.err)).to_string()
    };
    let one = told(1);
    for ranks in [2, 4] {
        let several = told(ranks);
        let quantity = one.split(": ").nth(2).expect("a cause");
        assert!(several.contains(quantity), "{several} for {one}");
    }
}

#[test]
fn a_run_goes_on_with_another_number_of_ranks() {
    let bench = bench!(DAM_BREAK);
    let whole = ran(&bench, "whole", "");
    let out = "run scene.toml --quiet --out parts --threads 1";
    bench.failed(&format!("{out} --ranks 4 --set run.max_steps=40"));
    bench.done(&format!("{out} --ranks 2 --resume --changed"));
    whole.assert_same(&bench.state("parts"), "4 ranks, then 2");
}

#[test]
fn indivisible_flows_are_refused_before_any_output() {
    let bed = without_references(include_str!("../../../scenes/saturated-bed-at-rest.toml"));
    let laplace = "[effective-pressure.laplace]";
    let sweeps = bed.replace(laplace, &format!("{laplace}\nsolver = \"jacobi\""));
    let whole = "`effective pressure` cannot run on several ranks";
    let coarse = "256 --set numerics.spacing=0.1";
    for (scene, ranks, why) in [
        (sweeps.as_str(), "2", whole),
        (DAM_BREAK, coarse, "some would own nothing"),
    ] {
        let bench = bench!(scene);
        let refused = bench.refused(&format!("run scene.toml --out r --ranks {ranks}"));
        refused.says(why);
        assert!(!bench.path("r").exists(), "{why}");
    }
}

#[cfg(not(feature = "mpi"))]
#[test]
fn mpirun_is_left_out() {
    println!("skipped: built without the feature `mpi` (crates/sph-cli/README.md)");
}

/// Ranks that are processes; ends with the bits of one process.
#[cfg(feature = "mpi")]
#[test]
fn mpirun_gives_the_same_bits() {
    let bench = bench!(DAM_BREAK);
    let one = ran(&bench, "r1", "");
    for ranks in [1, 2, 4] {
        let out = format!("m{ranks}");
        let done = mpirun(&bench, ranks, &out).output().expect("mpirun");
        assert!(done.status.success(), "{done:?}");
        one.assert_same(&bench.state(&out), &format!("{ranks} processes"));
    }
}

/// One of four ranks is killed in mid-run: the job ends, the last checkpoint is whole, and two ranks go on to the same bits.
#[cfg(feature = "mpi")]
#[test]
fn a_killed_rank_ends_the_job_and_others_go_on_from_the_checkpoint() {
    use std::time::{Duration, Instant};
    let bench = bench!(DAM_BREAK);
    let whole = ran(&bench, "whole", "");
    let mut job = mpirun(&bench, 4, "killed").spawn().expect("mpirun");
    let checkpoint = bench.path("killed").join("checkpoint.sph");
    let start = Instant::now();
    while !checkpoint.exists() && start.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(5));
    }
    kill_a_child(job.id());
    let killed = Instant::now();
    let ended = job.wait().expect("an end");
    assert!(
        killed.elapsed() < Duration::from_secs(60),
        "{:?}",
        killed.elapsed()
    );
    assert!(!ended.success(), "the run was over before it was killed");
    bench.done("run scene.toml --quiet --out killed --threads 1 --ranks 2 --resume");
    whole.assert_same(&bench.state("killed"), "killed and resumed");
}

/// Kills the youngest process that mpirun has started.
#[cfg(feature = "mpi")]
fn kill_a_child(parent: u32) {
    let children = std::process::Command::new("pgrep")
        .args(["-P", &parent.to_string()])
        .output()
        .expect("pgrep");
    let children = String::from_utf8_lossy(&children.stdout);
    if let Some(child) = children.lines().last() {
        let _ = std::process::Command::new("kill")
            .args(["-9", child])
            .status();
    }
}

#[cfg(feature = "mpi")]
fn mpirun(bench: &Bench, ranks: usize, out: &str) -> std::process::Command {
    let mut job = std::process::Command::new("mpirun");
    let program = env!("CARGO_BIN_EXE_sph-under-test");
    // More ranks than cores, and in containers everybody is root.
    let call = format!(
        "--oversubscribe --allow-run-as-root -n {ranks} {program} run scene.toml --quiet --threads 1 --out {out}"
    );
    job.args(call.split_whitespace());
    job.current_dir(bench.folder());
    job
}
