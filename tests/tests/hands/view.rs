//! `sph view`, asked as a browser asks.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Stdio};

use sph_tests::DAM_BREAK;

use crate::with;

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

#[test]
fn a_browser_gets_the_page_the_pictures_and_the_series_of_a_run() {
    let bench = with(DAM_BREAK);
    bench.done(
        "run scene.toml -q --threads 1 --set output.picture=pressure --set run.end=0.06 --out a",
    );
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
    let port: u16 = port
        .and_then(|p| p.parse().ok())
        .unwrap_or_else(|| panic!("{line}"));
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
