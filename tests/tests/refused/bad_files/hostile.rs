//! Texts that want more memory, time or obedience than they are due.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sph_tests::{Bench, DAM_BREAK, Outcome, bench};

use crate::bad_files::PROGRAM;

/// Memory of a process that reads a scene of next to nothing, bytes, with room for another allocator.
const BASE: u64 = 64 << 20;
/// Bytes of memory per byte of a text: a key of TOML of few letters takes some hundred bytes in each of three trees.
const PER_BYTE: u64 = 250;

/// Runs `sph check scene.toml`, which must refuse; the largest memory that was seen (VmHWM), bytes, and what it said.
fn refused(bench: &Bench) -> (u64, String) {
    let mut child = bench.command("check scene.toml").spawn().expect("a check");
    let status = format!("/proc/{}/status", child.id());
    let mut most = 0;
    while child.try_wait().expect("a child").is_none() {
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|l| l.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|l| l.split_whitespace().next()?.parse::<u64>().ok());
        most = most.max(kilobytes.unwrap_or(0) << 10);
        std::thread::sleep(Duration::from_micros(300));
    }
    let output = child.wait_with_output().expect("an end");
    let err = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{err}");
    (most, err)
}

#[test]
fn a_scene_of_many_wrong_keys_takes_memory_as_its_length() {
    let bench = bench!();
    let many = |n: usize, one: &dyn Fn(usize) -> String| (0..n).map(one).collect::<String>();
    let cases = [
        (
            "keys of a body",
            format!(
                "{DAM_BREAK}[body.z]\n{}",
                many(45_000, &|k| format!("key{k} = {k}\n"))
            ),
        ),
        (
            "keys of a sub-table",
            format!(
                "{DAM_BREAK}[body.z.initial.q]\n{}",
                many(45_000, &|k| format!("k{k} = 1\n"))
            ),
        ),
        (
            "top-level tables",
            DAM_BREAK.to_string() + &many(45_000, &|k| format!("[t{k}]\n")),
        ),
        // No table is too wide here: a thousand tables of nine hundred unknown keys each.
        (
            "unknown keys in many tables",
            DAM_BREAK.to_string()
                + &many(400, &|t| {
                    format!("[body.z{t}]\n{}", many(900, &|k| format!("u{k}=1\n")))
                }),
        ),
        ("lines that are no TOML", many(100_000, &|_| "= x\n".into())),
    ];
    for (what, text) in cases {
        bench.write("scene.toml", &text);
        let (most, told) = refused(&bench);
        let bound = BASE + PER_BYTE * text.len() as u64;
        println!(
            "{what}: {} kB of text, {} MB of memory",
            text.len() / 1000,
            most / 1_000_000
        );
        assert!(most < bound, "{what}: {most} bytes\n{}", &told[..200]);
        assert!(told.len() < 100_000, "{what}: {} bytes", told.len());
    }
}

#[test]
fn a_pipe_that_nobody_writes_is_refused_and_one_of_the_shell_is_read() {
    let bench = bench!(DAM_BREAK);
    let made = Command::new("mkfifo").arg(bench.path("pipe")).status();
    assert!(made.expect("mkfifo").success());
    for call in [
        "check pipe",
        "run pipe",
        "study pipe",
        "explain pipe",
        "run scene.toml --from pipe",
        "study --compare pipe pipe",
    ] {
        let mut child = bench.command(call).spawn().expect("a call");
        let start = Instant::now();
        while child.try_wait().expect("a child").is_none() {
            if start.elapsed() > Duration::from_secs(30) {
                child.kill().expect("SIGKILL");
                panic!("`sph {call}` waits");
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        let output = child.wait_with_output().expect("an end");
        let err = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success(), "{call}: {err}");
        assert!(err.contains("not a file"), "{call}: {err}");
    }
    let script = format!("exec {PROGRAM} check <(cat scene.toml)");
    let mut shell = Command::new("bash");
    let shell = shell.args(["-c", &script]).current_dir(bench.folder());
    let output = shell.stdin(Stdio::null()).output().expect("bash");
    Outcome::new(script, &output).ended(0);
}

#[test]
fn nothing_from_a_file_is_obeyed_by_a_terminal() {
    let escape = "\u{1b}]0;owned\u{7}\u{1b}[2J";
    let marks = "\u{202e}\u{2066}\u{9b}1m";
    let bench = bench!(DAM_BREAK);
    let toml = |text: &str| {
        text.chars()
            .map(|c| format!("\\u{:04x}", c as u32))
            .collect::<String>()
    };
    let hostile = toml(&format!("{escape}{marks}"));
    let titled = DAM_BREAK.replace("Dam break of the tests", &format!("x{hostile}y"));
    let obeyed = |c: char| {
        (c.is_control() && !"\n\t".contains(c))
            || ('\u{202a}'..='\u{202e}').contains(&c)
            || ('\u{2066}'..='\u{2069}').contains(&c)
    };
    let quiet = |call: &str, code: i32| {
        let outcome = bench.call(call).ended(code);
        for text in [&outcome.out, &outcome.err] {
            let at = text.find(obeyed);
            assert!(
                at.is_none(),
                "{call}: {:?}",
                at.map(|k| &text[k.saturating_sub(20)..k + 1])
            );
        }
        assert!(!(outcome.out + &outcome.err).is_empty(), "{call}");
    };
    bench.write("scene.toml", &titled);
    quiet("check scene.toml", 0);
    quiet("explain scene.toml", 0);
    quiet("run scene.toml --out r --set run.end=0.01", 0);
    quiet("run scene.toml --out r --json --set run.end=0.01", 0);
    // In a key, in a value that is quoted, in the name of a phase, raw in a comment that is shown.
    for (from, to) in [
        (
            "condition = \"free-slip\"",
            format!("condition = \"free{hostile}\""),
        ),
        ("phase = \"water\"", format!("phase = \"wa{hostile}\"")),
        ("spacing = 0.02", format!("\"spa{hostile}\" = 0.02")),
        ("spacing = 0.02", format!("spacing = \"{marks}\" # {marks}")),
    ] {
        assert!(DAM_BREAK.contains(from));
        bench.write("scene.toml", DAM_BREAK.replace(from, &to));
        quiet("check scene.toml", 2);
        quiet("check scene.toml --json", 2);
    }
}

#[test]
fn places_are_told_of_deep_nesting_and_of_bytes_that_are_no_text() {
    let bench = bench!();
    let deep = format!(
        "title = \"t\"\nx = {}{}\n",
        "[".repeat(200),
        "]".repeat(200)
    );
    bench.write("scene.toml", &deep);
    bench.call("check scene.toml").says("scene.toml:2:");
    let dotted = format!("title = \"t\"\n\n{} = 1\n", vec!["a"; 2000].join("."));
    bench.write("scene.toml", &dotted);
    bench.call("check scene.toml").says("scene.toml:3:");
    let mut bytes = b"title = \"t\"\n# \xc3\xa4\xc3\xb6".to_vec();
    bytes.extend([0xff, 0xfe]);
    bench.write("scene.toml", bytes);
    bench.call("check scene.toml").says("line 2 | (column 5)");
}

#[test]
fn trials_and_unpacked_data_leave_nothing_behind() {
    let bench = bench!(DAM_BREAK);
    std::fs::create_dir_all(bench.path("r")).expect("a folder");
    bench.write("r/.writable-4711", "left by an earlier version");
    std::fs::create_dir_all(bench.path("tmp")).expect("a folder");
    bench.done("run scene.toml --quiet --out r --set run.end=0.01");
    let hidden: Vec<_> = std::fs::read_dir(bench.path("r"))
        .expect("a folder")
        .filter_map(|e| e.ok()?.file_name().into_string().ok())
        .filter(|n| n.starts_with('.'))
        .collect();
    assert!(hidden.is_empty(), "{hidden:?}");
    let mut check = bench.command("check dam-break-koshizuka");
    check.env("TMPDIR", bench.path("tmp"));
    assert!(check.output().expect("a check").status.success());
    let left = std::fs::read_dir(bench.path("tmp")).expect("a folder");
    assert_eq!(left.count(), 0);
}

#[test]
fn temporary_files_of_a_kill_go_with_the_next_check() {
    let bench = bench!();
    std::fs::create_dir_all(bench.path("tmp")).expect("a folder");
    // Whatever its name, this one has something in it and no lock: it is nobody's litter.
    std::fs::create_dir_all(bench.path("tmp/.sph-data-mine/mine")).expect("a folder");
    let names = || -> Vec<String> {
        let entries = std::fs::read_dir(bench.path("tmp")).expect("a folder");
        let all = entries.filter_map(|e| e.ok()?.file_name().into_string().ok());
        all.filter(|n| n != ".sph-data-mine").collect()
    };
    let check = || {
        let mut check = bench.command("check dam-break-koshizuka");
        check.env("TMPDIR", bench.path("tmp"));
        check
    };
    let killed_in_time = (0..100).any(|_| {
        let mut child = check().spawn().expect("a check");
        while names().is_empty() && child.try_wait().expect("a child").is_none() {
            std::thread::sleep(Duration::from_micros(200));
        }
        let _ = child.kill();
        child.wait().expect("an end");
        !names().is_empty()
    });
    assert!(killed_in_time, "no kill came while the data were there");
    // Not a name that a number of a process tells.
    let name = names().remove(0);
    let random = name.strip_prefix(".sph-data-").expect("the prefix");
    assert!(random.len() >= 6 && random.parse::<u64>().is_err());
    assert!(check().output().expect("a check").status.success());
    assert!(names().is_empty(), "{:?}", names());
    assert!(bench.path("tmp/.sph-data-mine/mine").exists());
}

#[test]
fn the_place_of_bytes_that_are_no_text_is_told_of_data_files_too() {
    let bench = bench!();
    let drawn = DAM_BREAK.replace(
        "polyline = [[0.0, 0.0], [0.6, 0.0], [0.6, 0.6], [0.0, 0.6]]\nclosed = true\n",
        "file = \"w.csv\"\n",
    );
    assert!(drawn != DAM_BREAK);
    let compared = format!("{DAM_BREAK}[reference.r]\nprobe = \"front\"\nfile = \"w.csv\"\n");
    bench.write("w.csv", b"0,0\n0,\xc3\xa4\xff\n");
    for scene in [drawn, compared] {
        bench.write("scene.toml", &scene);
        let told = bench.call("check scene.toml");
        told.says("w.csv | line 2 | column 4");
    }
}

#[test]
fn a_line_of_millions_of_letters_is_not_shown() {
    let bench = bench!();
    let long = "k".repeat(3_000_000);
    for text in [
        format!("{DAM_BREAK}\n{long} = 1\n"),
        DAM_BREAK.replace("1000.0", &format!("\"1 {long}\"")),
        format!("{DAM_BREAK}\nx = {}\n", "9".repeat(3_000_000)),
    ] {
        bench.write("scene.toml", &text);
        let outcome = bench.refused("check scene.toml");
        outcome.says("scene.toml:");
        // A few messages of two thousand letters at most, with their paths.
        assert!(outcome.err.len() < 20_000, "{} bytes", outcome.err.len());
    }
}
