//! What stops a run, a check or a server that would go wrong.

use std::net::TcpStream;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sph_tests::{DAM_BREAK, Going, Says, binary_stl, get, near, wait_until, within};

use crate::Field;

/// Grains of 1 kPa sink by mg/k = 5 radii; k = E R at a wall.
#[test]
fn a_grain_that_sinks_into_the_floor_ends_the_run() {
    let field = Field::new();
    let failed = field.run("soft-grain", "").ended(1);
    failed.says("grain 0 | `bottom` | (0.5 | `modulus` | shorter steps | line 2 of");
    let summary = field.summary();
    assert_eq!(summary["status"], "failed");
    // A free fall of 1 cm, then a quarter of the radius at most, and a step of a tenth of it.
    let longest = (2.0_f64 * (0.01 + 0.0125 + 0.005) / 9.81).sqrt();
    assert!(summary["simulated_seconds"].as_f64().expect("s") < longest);
    field.refuses("soft-grain", "", "box.contact | `modulus`");
}

/// A grain let go at a height h sinks by δ, k δ²/2 = m g (h + δ): a quarter of the radius bounds k.
#[test]
fn a_grain_may_sink_by_a_quarter_of_its_radius() {
    let field = Field::new();
    let radius: f64 = 0.05;
    let weight = 2600.0 * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3) * 9.81;
    let sunk = 0.25 * radius;
    let modulus = 2.0 * weight * (0.01 + sunk) / (sunk * sunk * radius);
    for (share, code) in [(1.2, 0), (0.8, 1)] {
        let set = format!(
            "--set run.safety=0.1 --set box.contact.linear-elastic.modulus={}",
            share * modulus
        );
        field.run("soft-grain", &set).ended(code);
    }
}

/// Two grains that meet head-on with 2 v sink by δ = 2 v √(m*/k), m* = m/2 and k = E R.
#[test]
fn grains_that_pass_through_each_other_end_the_run() {
    let field = Field::new();
    field.write("soft-grain.txt", "0.5 0.5 0.051 0.05\n0.5 0.5 0.8 0.05\n");
    let stiff = "--set box.contact.linear-elastic.modulus=1e7";
    let failed = field.run("soft-grain", stiff).ended(1);
    failed.says("overlaps grain 1");
    let stiff = format!("{stiff} --set grains.contact.linear-elastic.modulus=1e7");
    field.ran("soft-grain", &stiff);
}

#[test]
fn two_equal_runs_of_grains_are_the_same() {
    let field = Field::new();
    let stiff = "--set box.contact.linear-elastic.modulus=1e6 --set run.end=0.05";
    for out in ["r", "s"] {
        field.done(&format!("run soft-grain.toml --quiet --out {out} {stiff}"));
    }
    field.done("compare r s");
}

/// ω² = 2 k/m of a pair: Δt = √2 √(m/k), here with k = E R and the shear of half of it below.
#[test]
fn a_check_of_grains_tells_how_many_steps_they_take() {
    let field = Field::new();
    let stiff = "--set grains.contact.linear-elastic.modulus=1e6 --set box.contact.linear-elastic.modulus=1e6";
    let estimate = |more: &str| {
        let check = field
            .check("soft-grain", &format!("{stiff} --json {more}"))
            .ended(0);
        let told = check.json();
        (
            told["estimate"]["steps"].as_f64().expect("steps"),
            told["warnings"].to_string(),
        )
    };
    field.ran("soft-grain", stiff);
    let made = field.summary()["steps"].as_f64().expect("steps");
    let (steps, warnings) = estimate("");
    within(steps / made, 0.5..=1.01, "steps over those made");
    assert_eq!(warnings, "[]");
    // The step is in proportion to the radius.
    field.write("soft-grain.txt", "0.5 0.5 0.06 1e-12\n");
    let (small, warnings) = estimate("");
    near(small / steps, 5e10, 1e-2, "steps of a small grain");
    warnings.says("steps of");
    field.refuses("soft-grain", &format!("{stiff} --set run.end=1e6"), "clock");
}

#[cfg(target_os = "linux")]
#[test]
fn a_terminal_that_closes_leaves_a_checkpoint_and_nohup_goes_on() {
    let field = Field::new();
    let endless = DAM_BREAK.replace("end = 0.4", "end = 400.0");
    field.write("endless.toml", &endless);
    let program = field.command("").get_program().to_owned();
    for (ignored, ends) in [("", true), ("trap '' HUP;", false)] {
        let _ = std::fs::remove_dir_all(field.path("r"));
        let mut shell = Command::new("sh");
        let run = format!("{ignored} exec \"$0\" run endless.toml --quiet --threads 1 --out r");
        shell.arg("-c").arg(run).arg(&program);
        shell.current_dir(field.folder()).stderr(Stdio::null());
        let mut run = Going::new(&mut shell);
        let series = field.path("r/series.csv");
        wait_until("no series", || series.is_file());
        for _ in 0..2 {
            run.signal("-HUP");
        }
        if ends {
            run.end().ended(1);
            assert!(field.path("r/checkpoint.sph").is_file());
            assert_eq!(field.summary()["status"], "interrupted");
        } else {
            std::thread::sleep(Duration::from_millis(500));
            assert!(!run.is_over(), "it ended");
        }
    }
}

#[test]
fn connections_that_say_nothing_do_not_keep_others_out() {
    let field = Field::new();
    std::fs::create_dir(field.path("r")).expect("a folder");
    let (_server, port) = field.view("r");
    let silent = (0..40).map(|_| TcpStream::connect(("127.0.0.1", port)).expect("a connection"));
    let silent: Vec<_> = silent.collect();
    let begun = Instant::now();
    for _ in 0..20 {
        assert!(get(port, "/state.json").0.starts_with("HTTP/1.1 200"));
    }
    assert!(begun.elapsed() < Duration::from_secs(5));
    drop(silent);
}

#[test]
fn a_series_of_a_million_rows_is_thinned_out_for_the_page() {
    let field = Field::new();
    std::fs::create_dir(field.path("r")).expect("a folder");
    let row = |k: usize| format!("{k},{}\n", if k == 123_456 { 7.5 } else { 0.5 });
    let rows: String = (0..1_000_000).map(row).collect();
    field.write("r/series.csv", format!("time[s],speed[m/s]\n{rows}"));
    let (_server, port) = field.view("r");
    let (_, answer) = get(port, "/series.csv?column=speed%5Bm/s%5D");
    let answer = String::from_utf8_lossy(&answer);
    let rows = answer.lines().count();
    assert!((1000..5000).contains(&rows), "{rows} rows");
    for row in ["0,0.5", "123456,7.5", "999999,0.5"] {
        assert!(answer.lines().any(|line| line == row), "`{row}` is missing");
    }
}

#[test]
fn a_list_of_frames_names_no_files_outside_of_its_folder() {
    let field = Field::new();
    field.write("dam.toml", DAM_BREAK);
    for out in ["r", "s"] {
        field.done(&format!(
            "run dam.toml --quiet --threads 1 --set run.end=0.01 --out {out}"
        ));
    }
    assert_eq!(field.call("compare r s").code, Some(0));
    let list = field.read("r/fields.pvd");
    let start = list.find("file=\"").expect("a file") + 6;
    let name = list[start..].split('"').next().expect("a name");
    std::fs::copy(field.path(&format!("r/{name}")), field.path("other.vtu")).expect("a copy");
    std::os::unix::fs::symlink(field.path("other.vtu"), field.path("r/link.vtu")).expect("a link");
    let absolute = field.path("other.vtu");
    for other in [
        "../other.vtu",
        &absolute.display().to_string(),
        "fields/../../other.vtu",
        "link.vtu",
    ] {
        field.write("r/fields.pvd", list.replace(name, other));
        field.refused("compare r s").says("outside its folder");
    }
}

/// Facets far smaller than the spacing: as many times the work as there are times the facets, and no more.
#[test]
fn a_check_of_many_small_facets_takes_seconds() {
    let field = Field::new();
    let rings = 60;
    let point = |i: usize, j: usize| {
        let [t, p] =
            [i as f32 / 2.0, (j % rings) as f32].map(|k| std::f32::consts::TAU * k / rings as f32);
        [t.sin() * p.cos(), t.sin() * p.sin(), t.cos()]
    };
    let mut facets = Vec::new();
    for i in 0..rings {
        for j in 0..rings {
            let [a, b, c, d] =
                [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| point(i, j));
            if i + 1 < rings {
                facets.push([a, c, b]);
            }
            if i > 0 {
                facets.push([a, d, c]);
            }
        }
    }
    field.write("ball.stl", binary_stl(&facets));
    let begun = Instant::now();
    field.check("ball", "--threads 1").ended(0);
    let seconds = begun.elapsed().as_secs_f64();
    assert!(seconds < 10.0, "{seconds} s for {} facets", facets.len());
}
