//! `sph view`: a page on 127.0.0.1 with the pictures, plots and series of a run, which may be going on.

mod answer;
mod series;

use std::collections::VecDeque;
use std::io::{ErrorKind, Read, Write};
use std::net::{Ipv4Addr, Shutdown, TcpListener, TcpStream};
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::terminal::{Trouble, console};
use answer::{Answer, answer};

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
    console::out(&format!(
        "{shown} at http://127.0.0.1:{port}/ (Ctrl-C ends it)"
    ));
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
