//! Ctrl-C, SIGTERM as from a batch system, SIGHUP as from a terminal that closes: once to stop with a checkpoint,
//! twice to stop at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::terminal::console;

/// A flag that the first Ctrl-C (or SIGTERM, or SIGHUP) raises; the second ends the process with code 1.
pub fn flag() -> Arc<AtomicBool> {
    let raised = Arc::new(AtomicBool::new(false));
    let seen = raised.clone();
    let handled = ctrlc::set_handler(move || {
        if seen.swap(true, Ordering::SeqCst) {
            console::err("stopped at once; the last checkpoint stands");
            std::process::exit(1);
        }
        // Away from the line of the bar.
        let line = if console::terminal() { "\n" } else { "" };
        console::err(&format!(
            "{line}stopping after this step with a checkpoint; Ctrl-C again stops at once"
        ));
    });
    if let Err(error) = handled {
        report_unhandled("Ctrl-C", error);
    }
    if let Err(error) = other_signals(&raised) {
        report_unhandled("SIGTERM and SIGHUP", error);
    }
    raised
}

fn report_unhandled(signals: &str, error: impl std::fmt::Display) {
    console::err(&format!(
        "note: {signals} will stop without a checkpoint ({error})"
    ));
}

/// SIGTERM raises the flag too; where it is up, the process ends. So does SIGHUP, of which a terminal that closes may
/// send several: none of them ends the process.
#[cfg(unix)]
fn other_signals(raised: &Arc<AtomicBool>) -> std::io::Result<()> {
    use signal_hook::{
        consts::{SIGHUP, SIGTERM, SIGXFSZ},
        flag,
    };
    // A file longer than `ulimit -f` allows is reported as a full disk; by default the process ends without a message.
    let _ = flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    flag::register_conditional_shutdown(SIGTERM, 1, raised.clone())?;
    flag::register(SIGTERM, raised.clone())?;
    if told_of_hang_up() {
        flag::register(SIGHUP, raised.clone())?;
    }
    Ok(())
}

/// True if SIGHUP is known to have an effect: `nohup` ignores it.
#[cfg(unix)]
fn told_of_hang_up() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|l| l.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    ignored.is_some_and(|mask| mask & 1 == 0)
}

#[cfg(not(unix))]
fn other_signals(_: &Arc<AtomicBool>) -> std::io::Result<()> {
    Ok(())
}
