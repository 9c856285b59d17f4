//! `sph view`, asked as a browser asks.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sph_tests::{Bench, DAM_BREAK, Going, Says, bench, get};

#[test]
fn a_browser_gets_the_page_the_pictures_and_the_series_of_a_run() {
    let bench = bench!(DAM_BREAK);
    bench.done(
        "run scene.toml -q --threads 1 --set output.picture=pressure --set run.end=0.06 --out a",
    );
    let (_server, port) = bench.view("a");
    let (head, page) = get(port, "/");
    assert!(head.starts_with("HTTP/1.1 200 OK"), "{head}");
    assert!(String::from_utf8_lossy(&page).contains("/state.json"));
    let (_, state) = get(port, "/state.json");
    let state: serde_json::Value = serde_json::from_slice(&state).expect("JSON");
    assert_eq!(state["pictures"]["pressure"][1], "pressure_0001.png");
    assert_eq!(state["summary"]["status"], "done");
    let (head, picture) = get(port, "/files/pictures/pressure_0001.png");
    head.says("image/png");
    let drawn = std::fs::read(bench.path("a/pictures/pressure_0001.png"));
    assert_eq!(picture, drawn.expect("there"));
    let (_, series) = get(port, "/files/series.csv");
    assert!(series.starts_with(b"time[s],"));
    assert!(get(port, "/files/../scene.toml").0.contains("404"));
    assert!(get(port, "/files/checkpoint.sph").0.contains("404"));
    bench.refused(&format!("view a --port {port}"));
}

/// A browser without a window, where one is installed.
fn browser() -> Option<&'static str> {
    ["chromium", "chromium-browser", "google-chrome"]
        .into_iter()
        .find(|name| {
            let asked = Command::new(name).arg("--version").output();
            asked.is_ok_and(|a| a.status.success())
        })
}

/// The page as the browser has it once its script has run.
fn rendered(browser: &str, bench: &Bench, port: u16) -> String {
    let mut command = Command::new(browser);
    let words = "--headless=new --no-sandbox --disable-gpu --no-first-run --disable-background-networking \
                 --disable-component-update --virtual-time-budget=6000 --dump-dom";
    command.args(words.split_whitespace());
    let profile = bench.path("browser");
    command.arg(format!("--user-data-dir={}", profile.display()));
    command.arg(format!("http://127.0.0.1:{port}/"));
    let out = std::fs::File::create(bench.path("page.html")).expect("a file");
    command.stdout(out).stderr(Stdio::null());
    let mut child = Going::new(&mut command);
    let begun = Instant::now();
    while !child.is_over() {
        assert!(begun.elapsed() < Duration::from_secs(120), "it hangs");
        std::thread::sleep(Duration::from_millis(50));
    }
    bench.read("page.html")
}

/// The front of an inviscid dam break without an obstacle, 2√(gH) t beyond the gate (Ritter 1892), beside the probe.
const RITTER: &str = "
[reference.ritter]
probe = \"front\"
file = \"ritter.csv\"
";

#[test]
fn a_real_browser_shows_pictures_curves_plots_errors_and_the_log() {
    let Some(browser) = browser() else {
        println!("no chromium here: nothing was looked at");
        return;
    };
    let bench = bench!(&format!("{DAM_BREAK}{RITTER}"));
    let ritter = "time[s],front[m]\n0,0.2\n0.06,0.4377\n";
    bench.write("ritter.csv", ritter);
    bench.done(
        "run scene.toml -q --threads 1 --set output.picture=pressure --set run.end=0.06 --out a",
    );
    let (_server, port) = bench.view("a");
    let page = rendered(browser, &bench, port);
    for (what, word) in [
        ("status", "done: "),
        ("the field of the slider", "<option value=\"pressure\">"),
        (
            "the last picture",
            "src=\"/files/pictures/pressure_0002.png\"",
        ),
        ("its number", "3 of 3"),
        ("the curve", "<polyline points=\"0.0,"),
        ("the log", "<tr><td>0.06</td>"),
        ("what is compared", "<th>reference</th><th>error</th>"),
        ("the error", "<tr><td>ritter</td><td>0."),
        ("the plot", "<img src=\"/files/plots/ritter.png\""),
    ] {
        assert!(page.contains(word), "{what}, {word}, is not in\n{page}");
    }
}
