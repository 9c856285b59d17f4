//! `sph view`: a page on 127.0.0.1 with the pictures, plots and series of a run, which may be going on.

mod answer;
mod state;

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::Path;
use std::time::Duration;

use crate::telling::console;
use crate::telling::trouble::Trouble;
use crate::tool_arguments::ViewArguments;
use answer::{Answer, answer};

/// Longest head of a request, bytes.
const LONGEST: u64 = 8192;
/// Time that a browser has to say what it wants, and to take it.
const PATIENCE: Duration = Duration::from_secs(10);
/// Browsers that are served at once.
const MOST: usize = 16;

/// Serves a folder until the process is ended.
pub fn command(arguments: &ViewArguments) -> Result<(), Trouble> {
    let folder = &arguments.results;
    let real = folder.canonicalize().ok().filter(|f| f.is_dir());
    let real = real.ok_or_else(|| {
        Trouble::usage(format!(
            "there is no folder of results {}",
            folder.display()
        ))
    })?;
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, arguments.port)).map_err(|e| {
        let port = arguments.port;
        Trouble::usage(format!(
            "cannot listen on 127.0.0.1:{port} ({e}); --port 0 takes one that is free"
        ))
    })?;
    let port = listener.local_addr().map_or(arguments.port, |a| a.port());
    console::out(&format!(
        "{} at http://127.0.0.1:{port}/ (Ctrl-C ends it)",
        folder.display()
    ));
    serve(&listener, &real, port);
    Ok(())
}

fn serve(listener: &TcpListener, folder: &Path, port: u16) {
    let busy = std::sync::atomic::AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for stream in listener.incoming().flatten() {
            use std::sync::atomic::Ordering::SeqCst;
            if busy.load(SeqCst) >= MOST {
                continue;
            }
            busy.fetch_add(1, SeqCst);
            let busy = &busy;
            scope.spawn(move || {
                // A browser that has gone needs no answer.
                let _ = one(stream, folder, port);
                busy.fetch_sub(1, SeqCst);
            });
        }
    });
}

/// Reads a request and answers it; the connection ends with it.
fn one(mut stream: TcpStream, folder: &Path, port: u16) -> std::io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let mut head = Vec::new();
    let mut reader = BufReader::new(stream.try_clone()?).take(LONGEST);
    while !head.ends_with(b"\r\n\r\n") && !head.ends_with(b"\n\n") {
        if reader.read_until(b'\n', &mut head)? == 0 {
            break;
        }
    }
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
