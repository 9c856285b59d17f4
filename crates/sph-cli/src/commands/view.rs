//! `sph view`: a page on 127.0.0.1 with the pictures, plots and series of a run, which may be going on.

mod series;

use std::collections::{BTreeMap, VecDeque};
use std::io::{ErrorKind, Read, Write};
use std::net::{Ipv4Addr, Shutdown, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use serde_json::{Value as Json, json};

use crate::commands::file_list::{names, read_summary};
use crate::terminal::{Trouble, console};

/// Longest head of a request, bytes.
const LONGEST: usize = 8192;
/// Time of a browser for its request, and for the answer.
const PATIENCE: Duration = Duration::from_secs(10);
/// Browsers that are served at once.
const MOST: usize = 16;

pub fn command(folder: &Path, port: u16) -> Result<(), Trouble> {
    let real = folder.canonicalize().ok().filter(|f| f.is_dir());
    let shown = folder.display();
    let real = real.ok_or_else(|| format!("there is no folder of results {shown}"))?;
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(|e| {
        format!("cannot listen on 127.0.0.1:{port} ({e}); --port 0 takes one that is free")
    })?;
    let port = listener.local_addr().map_or(port, |a| a.port());
    let text = format!("{shown} at http://127.0.0.1:{port}/ (Ctrl-C ends it)");
    console::out(&text);
    serve(&listener, &real, port);
    Ok(())
}

/// Serves as many browsers at once as there is room for: one more takes the place of the one that was there first.
fn serve(listener: &TcpListener, folder: &Path, port: u16) {
    let open: Mutex<VecDeque<(u64, TcpStream)>> = Mutex::default();
    let held = || open.lock().unwrap_or_else(PoisonError::into_inner);
    std::thread::scope(|scope| {
        for (number, stream) in (0..).zip(listener.incoming().flatten()) {
            let Ok(handle) = stream.try_clone() else {
                continue;
            };
            let mut all = held();
            if all.len() >= MOST
                && let Some((_, first)) = all.pop_front()
            {
                let _ = first.shutdown(Shutdown::Both);
            }
            all.push_back((number, handle));
            drop(all);
            scope.spawn(move || {
                // A browser that has gone needs no answer.
                let _ = one(stream, folder, port);
                held().retain(|(other, _)| *other != number);
            });
        }
    });
}

/// The head of a request, which has to be there in time as a whole.
fn head(stream: &mut TcpStream) -> std::io::Result<Vec<u8>> {
    let end = Instant::now() + PATIENCE;
    let (mut head, mut part) = (Vec::new(), [0; 1024]);
    while !head.ends_with(b"\r\n\r\n") && !head.ends_with(b"\n\n") && head.len() < LONGEST {
        let left = end.saturating_duration_since(Instant::now());
        stream.set_read_timeout(Some(left.max(Duration::from_millis(1))))?;
        match stream.read(&mut part)? {
            0 => break,
            n => head.extend_from_slice(&part[..n]),
        }
        if left.is_zero() {
            return Err(ErrorKind::TimedOut.into());
        }
    }
    Ok(head)
}

/// Reads a request and answers it; the connection ends with it.
fn one(mut stream: TcpStream, folder: &Path, port: u16) -> std::io::Result<()> {
    stream.set_write_timeout(Some(PATIENCE))?;
    let head = head(&mut stream)?;
    let head = String::from_utf8_lossy(&head);
    let Answer { status, kind, body } = answer(&head, folder, port);
    write!(
        stream,
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n\
         X-Content-Type-Options: nosniff\r\nContent-Security-Policy: default-src 'self' 'unsafe-inline'\r\n\
         Connection: close\r\n\r\n",
        body.len()
    )?;
    if !head.starts_with("HEAD ") {
        stream.write_all(&body)?;
    }
    stream.flush()
}

const PAGE: &str = include_str!("../../templates/view.html");

struct Answer {
    /// Number and word.
    status: &'static str,
    /// MIME type.
    kind: &'static str,
    body: Vec<u8>,
}

const KINDS: [(&str, &str); 6] = [
    ("png", "image/png"),
    ("gif", "image/gif"),
    ("svg", "image/svg+xml"),
    ("csv", "text/csv; charset=utf-8"),
    ("json", "application/json"),
    ("html", "text/html; charset=utf-8"),
];

impl Answer {
    fn found(kind: &'static str, body: impl Into<Vec<u8>>) -> Self {
        let (status, body) = ("200 OK", body.into());
        Answer { status, kind, body }
    }

    fn refused(status: &'static str) -> Self {
        let (kind, body) = ("text/plain; charset=utf-8", format!("{status}\n").into());
        Answer { status, kind, body }
    }

    /// The content of a file, if there is one.
    fn of_file(kind: &'static str, content: Option<impl Into<Vec<u8>>>) -> Self {
        let gone = || Answer::refused("404 Not Found");
        content.map_or_else(gone, |body| Answer::found(kind, body))
    }
}

/// The answer to a request with this head.
///
/// Only names of this machine are answered: a page from elsewhere whose name leads here gets no data.
fn answer(head: &str, folder: &Path, port: u16) -> Answer {
    let mut lines = head.lines();
    let mut words = lines.next().unwrap_or_default().split(' ');
    let [method, target] = [(); 2].map(|()| words.next().unwrap_or_default());
    if !["GET", "HEAD"].contains(&method) {
        return Answer::refused("405 Method Not Allowed");
    }
    let host = lines.find_map(|line| {
        let (name, value) = line.split_once(':')?;
        name.eq_ignore_ascii_case("host").then_some(value.trim())
    });
    let own = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
    if !host.is_some_and(|host| own.iter().any(|own| own == host)) {
        return Answer::refused("403 Forbidden");
    }
    let mut parts = target.split(['?', '#']);
    let path = parts.next().unwrap_or_default();
    match path {
        "/series.csv" => {
            let asked = parts.next().and_then(|query| query.strip_prefix("column="));
            let column = asked.and_then(decoded).unwrap_or_default();
            let file = inside(folder, "series.csv");
            let text = file.and_then(|file| series::thinned(&file, &column).ok());
            Answer::of_file("text/csv; charset=utf-8", text)
        }
        "/" => Answer::found("text/html; charset=utf-8", PAGE),
        "/state.json" => Answer::found("application/json", folder_state(folder).to_string()),
        path => file(path, folder),
    }
}

/// The path of something in the folder, links followed and still within it.
fn inside(folder: &Path, name: &str) -> Option<PathBuf> {
    let real = folder.join(name).canonicalize().ok();
    real.filter(|real| real.starts_with(folder))
}

fn file(path: &str, folder: &Path) -> Answer {
    let name = path.strip_prefix("/files/").and_then(decoded);
    let name = name.unwrap_or_default();
    let is_of = |extension: &str| name.ends_with(&format!(".{extension}"));
    let Some((_, kind)) = KINDS.iter().find(|(extension, _)| is_of(extension)) else {
        return Answer::refused("404 Not Found");
    };
    let real = inside(folder, &name);
    Answer::of_file(kind, real.and_then(|real| std::fs::read(real).ok()))
}

/// Pictures by field, plots, whether there is a series and its first shown column, the summary if there is one.
fn folder_state(folder: &Path) -> Json {
    let name = folder.file_name().map(|n| n.to_string_lossy().into_owned());
    json!({
        "name": name,
        "pictures": numbered(&folder.join("pictures")),
        "plots": names(&folder.join("plots"), "png"),
        "animations": names(&folder.join("animations"), "gif"),
        "bad": names(folder, "png"),
        "series": folder.join("series.csv").is_file(),
        "column": series::first_shown(&folder.join("series.csv")),
        "running": folder.join(".lock").exists(),
        "summary": read_summary(folder),
    })
}

/// `pressure_0003.png` as the numbers of `pressure`.
fn numbered(folder: &Path) -> BTreeMap<String, Vec<String>> {
    let mut all: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for name in names(folder, "png") {
        if let Some((field, _)) = name.rsplit_once('_') {
            all.entry(field.to_string()).or_default().push(name);
        }
    }
    all
}

/// A path with `%20` and the like as characters.
fn decoded(path: &str) -> Option<String> {
    let mut bytes = Vec::new();
    let mut rest = path.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(match byte {
            b'%' => {
                let digits = [rest.next()?, rest.next()?];
                u8::from_str_radix(std::str::from_utf8(&digits).ok()?, 16).ok()?
            }
            byte => byte,
        });
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_browser_gets_files_of_the_folder_and_no_others() {
        let outer = sph_io::Scratch::new(".sph-view-").expect("a folder");
        let folder = outer.path().join("results");
        std::fs::create_dir_all(folder.join("pictures")).expect("a folder");
        std::fs::write(folder.join("pictures/a b_0000.png"), b"png").expect("a file");
        std::fs::write(folder.join("checkpoint.sph"), b"state").expect("a file");
        std::fs::write(outer.path().join("secret.json"), b"{}").expect("a file");
        let folder = folder.canonicalize().expect("there");
        let get = |target: &str, host: &str| {
            let head = format!("GET {target} HTTP/1.1\r\nHost: {host}\r\n\r\n");
            let Answer { status, body, .. } = answer(&head, &folder, 8377);
            (status.split(' ').next().unwrap_or_default(), body)
        };
        let own = "127.0.0.1:8377";
        assert_eq!(get("/", own).0, "200");
        let picture = get("/files/pictures/a%20b_0000.png?t=1", own);
        assert_eq!(picture, ("200", b"png".to_vec()));
        let state = String::from_utf8(get("/state.json", own).1).expect("text");
        assert!(state.contains("a b"), "{state}");
        for target in [
            "/files/../secret.json",
            "/files/%2e%2e/secret.json",
            "/files//etc/hostname.json",
            "/files/checkpoint.sph",
            "/files/%zz.png",
            "/files/gone.png",
            "/secret.json",
            "",
        ] {
            assert_eq!(get(target, own).0, "404", "{target}");
        }
        assert_eq!(get("/", "evil.example:8377").0, "403");
        assert_eq!(get("/", "localhost:8377").0, "200");
        let status = |head: &str| answer(head, &folder, 8377).status;
        assert_eq!(status("GET / HTTP/1.1\r\n\r\n"), "403 Forbidden");
        assert_eq!(status("POST / HTTP/1.1\r\n"), "405 Method Not Allowed");
    }
}
