//! `sph view`, asked as a browser asks.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use sph_tests::{Bench, DAM_BREAK};

use crate::hands::with;

/// Ended with the test.
struct Server(Child);

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn get(port: u16, target: &str) -> (String, Vec<u8>) {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).expect("a connection");
    write!(
        stream,
        "GET {target} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n"
    )
    .expect("asked");
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).expect("answered");
    let end = answer
        .windows(4)
        .position(|w| w == b"\r\n\r\n")
        .expect("a head");
    (
        String::from_utf8_lossy(&answer[..end]).into_owned(),
        answer[end + 4..].to_vec(),
    )
}

/// `sph view` on the results in `a`, and its port.
fn served(bench: &Bench) -> (Server, u16) {
    let mut command = bench.command("view a --port 0");
    let mut server = Server(
        command
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program starts"),
    );
    let mut line = String::new();
    let stdout = server.0.stdout.take().expect("a pipe");
    BufReader::new(stdout).read_line(&mut line).expect("a line");
    let port = line
        .split("127.0.0.1:")
        .nth(1)
        .and_then(|r| r.split('/').next());
    let port = port.and_then(|p| p.parse().ok());
    (server, port.unwrap_or_else(|| panic!("{line}")))
}

#[test]
fn a_browser_gets_the_page_the_pictures_and_the_series_of_a_run() {
    let bench = with(DAM_BREAK);
    bench.done(
        "run scene.toml -q --threads 1 --set output.picture=pressure --set run.end=0.06 --out a",
    );
    let (_server, port) = served(&bench);
    let (head, page) = get(port, "/");
    assert!(head.starts_with("HTTP/1.1 200 OK"), "{head}");
    assert!(String::from_utf8_lossy(&page).contains("/state.json"));
    let (_, state) = get(port, "/state.json");
    let state: serde_json::Value = serde_json::from_slice(&state).expect("JSON");
    assert_eq!(state["pictures"]["pressure"][1], "pressure_0001.png");
    assert_eq!(state["summary"]["status"], "done");
    let (head, picture) = get(port, "/files/pictures/pressure_0001.png");
    assert!(head.contains("image/png"), "{head}");
    assert_eq!(
        picture,
        std::fs::read(bench.path("a/pictures/pressure_0001.png")).expect("there")
    );
    let (_, series) = get(port, "/files/series.csv");
    assert!(series.starts_with(b"time[s],"));
    assert!(get(port, "/files/../scene.toml").0.contains("404"));
    assert!(get(port, "/files/checkpoint.sph").0.contains("404"));
    let refused = bench.call(&format!("view a --port {port}"));
    assert_eq!(refused.code, Some(2), "{}", refused.err);
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
    command.args([
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--virtual-time-budget=6000",
        "--dump-dom",
    ]);
    let profile = bench.path("browser");
    command.arg(format!("--user-data-dir={}", profile.display()));
    command.arg(format!("http://127.0.0.1:{port}/"));
    let out = std::fs::File::create(bench.path("page.html")).expect("a file");
    command.stdout(out).stderr(Stdio::null());
    let mut child = Server(command.spawn().expect("the browser starts"));
    let begun = Instant::now();
    while child.0.try_wait().expect("a process").is_none() {
        assert!(begun.elapsed() < Duration::from_secs(120), "it hangs");
        std::thread::sleep(Duration::from_millis(50));
    }
    std::fs::read_to_string(bench.path("page.html")).expect("a page")
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
    let bench = with(&format!("{DAM_BREAK}{RITTER}"));
    let ritter = "time[s],front[m]\n0,0.2\n0.06,0.4377\n";
    std::fs::write(bench.path("ritter.csv"), ritter).expect("a table");
    bench.done(
        "run scene.toml -q --threads 1 --set output.picture=pressure --set run.end=0.06 --out a",
    );
    let (_server, port) = served(&bench);
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
