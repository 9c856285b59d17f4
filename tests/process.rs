//! Calls of the program that go on, and servers.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::{Bench, Outcome};

/// A process that ends with its test.
pub struct Going(Option<Child>);

impl Drop for Going {
    fn drop(&mut self) {
        if let Some(child) = &mut self.0 {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

impl Going {
    /// Starts it.
    #[track_caller]
    pub fn new(command: &mut Command) -> Self {
        Going(Some(command.spawn().expect("the program starts")))
    }

    /// The process.
    pub fn child(&mut self) -> &mut Child {
        self.0.as_mut().expect("it goes on")
    }

    /// Whether it has ended.
    pub fn is_over(&mut self) -> bool {
        self.child().try_wait().expect("a process").is_some()
    }

    /// Kills it, which must not have ended before.
    #[track_caller]
    pub fn kill(&mut self) {
        let child = self.child();
        child.kill().expect("SIGKILL");
        let status = child.wait().expect("its end");
        assert_eq!(status.code(), None, "killed by a signal, not ended");
    }

    /// Sends a signal, such as `-INT`.
    #[track_caller]
    pub fn signal(&mut self, name: &str) {
        let pid = self.child().id().to_string();
        let sent = Command::new("kill").args([name, &pid]).status();
        assert!(sent.expect("kill").success());
    }

    /// Waits for its end.
    pub fn end(mut self) -> Outcome {
        let child = self.0.take().expect("it goes on");
        let output = child.wait_with_output().expect("its end");
        Outcome::new(String::new(), &output)
    }
}

/// Waits until something holds, for at most a minute.
#[track_caller]
pub fn wait_until(what: &str, mut holds: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !holds() {
        assert!(begun.elapsed() < Duration::from_secs(60), "{what}");
        sleep(Duration::from_millis(1));
    }
}

impl Bench {
    /// Starts the program.
    #[track_caller]
    pub fn start(&self, words: &str) -> Going {
        Going::new(&mut self.command(words))
    }

    /// Simulated time that the series of a folder of results has reached; zero before it is there.
    pub fn reached(&self, results: &str) -> f64 {
        let series = std::fs::read_to_string(self.path(results).join("series.csv"));
        let series = series.unwrap_or_default();
        let first = |line: &str| line.split(',').next()?.parse::<f64>().ok();
        series.lines().filter_map(first).fold(0.0, f64::max)
    }

    /// Starts a run, which must get to a checkpoint and past a simulated time in its folder of results.
    #[track_caller]
    pub fn start_until(&self, words: &str, results: &str, time: f64) -> Going {
        let mut run = self.start(words);
        let checkpoint = self.path(results).join("checkpoint.sph");
        wait_until("the run does not get on", || {
            assert!(!run.is_over(), "the run ended before t = {time} s");
            checkpoint.exists() && self.reached(results) >= time
        });
        run
    }

    /// `sph view` on a folder of results, and its port.
    #[track_caller]
    pub fn view(&self, results: &str) -> (Going, u16) {
        let mut server = self.start(&format!("view {results} --port 0"));
        let mut line = String::new();
        let stdout = server.child().stdout.take().expect("a pipe");
        BufReader::new(stdout).read_line(&mut line).expect("a line");
        let port = line.split("127.0.0.1:").nth(1);
        let port = port.and_then(|rest| rest.split('/').next()?.parse().ok());
        (server, port.unwrap_or_else(|| panic!("{line}")))
    }
}

/// The head and the body of what a server answers, within five seconds.
#[track_caller]
pub fn get(port: u16, target: &str) -> (String, Vec<u8>) {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).expect("a connection");
    let limit = Some(Duration::from_secs(5));
    stream.set_read_timeout(limit).expect("a limit");
    let asked = format!("GET {target} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n");
    stream.write_all(asked.as_bytes()).expect("asked");
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).expect("answered");
    let end = answer.windows(4).position(|w| w == b"\r\n\r\n");
    let (head, body) = answer.split_at(end.expect("a head"));
    (
        String::from_utf8_lossy(head).into_owned(),
        body[4..].to_vec(),
    )
}
