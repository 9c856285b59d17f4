//! What stops a run, a check or a server that would go wrong.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use sph_tests::DAM_BREAK;

use crate::Field;

/// A process that ends with its test.
struct Ended(Child);

impl Drop for Ended {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Waits until something holds, for at most a minute.
fn wait_until(what: &str, mut holds: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !holds() {
        assert!(begun.elapsed() < Duration::from_secs(60), "{what}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Grains of 1 kPa sink by mg/k = 5 radii; k = E R at a wall.
#[test]
fn a_grain_that_sinks_into_the_floor_ends_the_run() {
    let field = Field::new();
    let outcome = field.run("soft-grain", "");
    assert_eq!(outcome.code, Some(1), "{}", outcome.err);
    for told in [
        "grain 0",
        "`bottom`",
        "(0.5",
        "`modulus`",
        "shorter steps",
        "line 2 of",
    ] {
        assert!(outcome.err.contains(told), "`{told}`: {}", outcome.err);
    }
    let summary = field.summary();
    assert_eq!(summary["status"], "failed");
    // A free fall of 1 cm, then a quarter of the radius at most, and a step of a tenth of it.
    let longest = (2.0_f64 * (0.01 + 0.0125 + 0.005) / 9.81).sqrt();
    assert!(summary["simulated_seconds"].as_f64().expect("s") < longest);
    let check = field.check("soft-grain", "");
    assert_eq!(check.code, Some(2), "{}", check.out);
    assert!(
        check.err.contains("box.contact") && check.err.contains("`modulus`"),
        "{}",
        check.err
    );
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
        let outcome = field.run("soft-grain", &set);
        assert_eq!(outcome.code, Some(code), "{share}: {}", outcome.err);
    }
}

/// Two grains that meet head-on with 2 v sink by δ = 2 v √(m*/k), m* = m/2 and k = E R.
#[test]
fn grains_that_pass_through_each_other_end_the_run() {
    let field = Field::new();
    field
        .0
        .write("soft-grain.txt", "0.5 0.5 0.051 0.05\n0.5 0.5 0.8 0.05\n");
    let stiff = "--set box.contact.linear-elastic.modulus=1e7";
    let outcome = field.run("soft-grain", stiff);
    assert_eq!(outcome.code, Some(1), "{}", outcome.err);
    assert!(outcome.err.contains("overlaps grain 1"), "{}", outcome.err);
    let stiff = format!("{stiff} --set grains.contact.linear-elastic.modulus=1e7");
    let outcome = field.run("soft-grain", &stiff);
    assert_eq!(outcome.code, Some(0), "{}", outcome.err);
}

#[test]
fn two_equal_runs_of_grains_are_the_same() {
    let field = Field::new();
    let stiff = "--set box.contact.linear-elastic.modulus=1e6 --set run.end=0.05";
    for out in ["r", "s"] {
        let outcome = field
            .0
            .call(&format!("run soft-grain.toml --quiet --out {out} {stiff}"));
        assert_eq!(outcome.code, Some(0), "{}", outcome.err);
    }
    let same = field.0.call("compare r s");
    assert_eq!(same.code, Some(0), "{}{}", same.out, same.err);
}

/// ω² = 2 k/m of a pair: Δt = √2 √(m/k), here with k = E R and the shear of half of it below.
#[test]
fn a_check_of_grains_tells_how_many_steps_they_take() {
    let field = Field::new();
    let stiff = "--set grains.contact.linear-elastic.modulus=1e6 --set box.contact.linear-elastic.modulus=1e6";
    let estimate = |more: &str| {
        let check = field.check("soft-grain", &format!("{stiff} --json {more}"));
        assert_eq!(check.code, Some(0), "{}", check.err);
        let told: serde_json::Value = serde_json::from_str(&check.out).expect("JSON");
        (
            told["estimate"]["steps"].as_f64().expect("steps"),
            told["warnings"].to_string(),
        )
    };
    let run = field.run("soft-grain", stiff);
    assert_eq!(run.code, Some(0), "{}", run.err);
    let made = field.summary()["steps"].as_f64().expect("steps");
    let (steps, warnings) = estimate("");
    assert!(
        steps <= 1.01 * made && steps > 0.5 * made,
        "{steps} for {made}"
    );
    assert_eq!(warnings, "[]");
    // The step is in proportion to the radius.
    field.0.write("soft-grain.txt", "0.5 0.5 0.06 1e-12\n");
    let (small, warnings) = estimate("");
    assert!(
        (small / steps / 5e10 - 1.0).abs() < 1e-2,
        "{small} for {steps}"
    );
    assert!(warnings.contains("steps of"), "{warnings}");
    let stands = field.check("soft-grain", &format!("{stiff} --set run.end=1e6"));
    assert_eq!(stands.code, Some(2), "{}", stands.out);
    assert!(stands.err.contains("clock"), "{}", stands.err);
}

#[cfg(target_os = "linux")]
#[test]
fn a_terminal_that_closes_leaves_a_checkpoint_and_nohup_goes_on() {
    let field = Field::new();
    let endless = DAM_BREAK.replace("end = 0.4", "end = 400.0");
    field.0.write("endless.toml", &endless);
    let program = field.0.command("").get_program().to_owned();
    for (ignored, ends) in [("", true), ("trap '' HUP;", false)] {
        let _ = std::fs::remove_dir_all(field.0.path("r"));
        let mut shell = Command::new("sh");
        let run = format!("{ignored} exec \"$0\" run endless.toml --quiet --threads 1 --out r");
        shell.arg("-c").arg(run).arg(&program);
        shell.current_dir(field.0.folder()).stderr(Stdio::null());
        let mut run = Ended(shell.spawn().expect("a run"));
        let series = field.0.path("r/series.csv");
        wait_until("no series", || series.is_file());
        for _ in 0..2 {
            let sent = Command::new("kill")
                .args(["-HUP", &run.0.id().to_string()])
                .status();
            assert!(sent.expect("kill").success());
        }
        if ends {
            assert_eq!(run.0.wait().expect("an end").code(), Some(1));
            assert!(field.0.path("r/checkpoint.sph").is_file());
            assert_eq!(field.summary()["status"], "interrupted");
        } else {
            std::thread::sleep(Duration::from_millis(500));
            assert!(run.0.try_wait().expect("a child").is_none(), "it ended");
        }
    }
}

/// `sph view` on a folder, and its port.
fn view(field: &Field, folder: &str) -> (Ended, u16) {
    let mut command = field.0.command(&format!("view {folder} --port 0"));
    let mut server = Ended(command.stdout(Stdio::piped()).spawn().expect("a server"));
    let mut line = Vec::new();
    let stdout = server.0.stdout.as_mut().expect("a pipe");
    while !line.ends_with(b"/ ") {
        let mut byte = [0];
        stdout.read_exact(&mut byte).expect("a line");
        line.push(byte[0]);
    }
    let line = String::from_utf8(line).expect("text");
    let port = line
        .trim_end_matches("/ ")
        .rsplit(':')
        .next()
        .and_then(|p| p.parse().ok());
    (server, port.expect("a port"))
}

fn get(port: u16, target: &str) -> String {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).expect("a connection");
    stream
        .set_read_timeout(Some(Duration::from_secs(5)))
        .expect("a limit");
    write!(
        stream,
        "GET {target} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n"
    )
    .expect("asked");
    let mut answer = String::new();
    stream.read_to_string(&mut answer).expect("answered");
    answer
}

#[test]
fn connections_that_say_nothing_do_not_keep_others_out() {
    let field = Field::new();
    std::fs::create_dir(field.0.path("r")).expect("a folder");
    let (_server, port) = view(&field, "r");
    let silent = (0..40).map(|_| TcpStream::connect(("127.0.0.1", port)).expect("a connection"));
    let silent: Vec<_> = silent.collect();
    let begun = Instant::now();
    for _ in 0..20 {
        assert!(get(port, "/state.json").starts_with("HTTP/1.1 200"));
    }
    assert!(begun.elapsed() < Duration::from_secs(5));
    drop(silent);
}

#[test]
fn a_series_of_a_million_rows_is_thinned_out_for_the_page() {
    let field = Field::new();
    std::fs::create_dir(field.0.path("r")).expect("a folder");
    let row = |k: usize| format!("{k},{}\n", if k == 123_456 { 7.5 } else { 0.5 });
    let rows: String = (0..1_000_000).map(row).collect();
    field
        .0
        .write("r/series.csv", &format!("time[s],speed[m/s]\n{rows}"));
    let (_server, port) = view(&field, "r");
    let answer = get(port, "/series.csv?column=speed%5Bm/s%5D");
    let rows = answer.lines().count();
    assert!((1000..5000).contains(&rows), "{rows} rows");
    for row in ["0,0.5", "123456,7.5", "999999,0.5"] {
        assert!(answer.lines().any(|line| line == row), "`{row}` is missing");
    }
}

#[test]
fn a_list_of_frames_names_no_files_outside_of_its_folder() {
    let field = Field::new();
    field.0.write("dam.toml", DAM_BREAK);
    for out in ["r", "s"] {
        field.0.done(&format!(
            "run dam.toml --quiet --threads 1 --set run.end=0.01 --out {out}"
        ));
    }
    assert_eq!(field.0.call("compare r s").code, Some(0));
    let list = field.0.read("r/fields.pvd");
    let start = list.find("file=\"").expect("a file") + 6;
    let name = list[start..].split('"').next().expect("a name");
    std::fs::copy(
        field.0.path(&format!("r/{name}")),
        field.0.path("other.vtu"),
    )
    .expect("a copy");
    std::os::unix::fs::symlink(field.0.path("other.vtu"), field.0.path("r/link.vtu"))
        .expect("a link");
    let absolute = field.0.path("other.vtu");
    for other in [
        "../other.vtu",
        &absolute.display().to_string(),
        "fields/../../other.vtu",
        "link.vtu",
    ] {
        field.0.write("r/fields.pvd", &list.replace(name, other));
        let outcome = field.0.call("compare r s");
        assert_eq!(outcome.code, Some(2), "{other}: {}", outcome.out);
        assert!(
            outcome.err.contains("outside its folder"),
            "{}",
            outcome.err
        );
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
    let mut file = vec![0; 80];
    file.extend((facets.len() as u32).to_le_bytes());
    for facet in &facets {
        file.extend([0; 12]);
        file.extend(facet.iter().flatten().flat_map(|x| x.to_le_bytes()));
        file.extend([0; 2]);
    }
    std::fs::write(field.0.path("ball.stl"), file).expect("written");
    let begun = Instant::now();
    let outcome = field.check("ball", "--threads 1");
    let seconds = begun.elapsed().as_secs_f64();
    assert_eq!(outcome.code, Some(0), "{}", outcome.err);
    assert!(seconds < 10.0, "{seconds} s for {} facets", facets.len());
}
