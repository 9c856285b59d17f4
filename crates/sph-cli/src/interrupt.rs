//! Ctrl-C: once to stop with a checkpoint, twice to stop at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::console;

/// A flag that the first Ctrl-C raises; the second ends the process with code 1.
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
        console::err(&format!(
            "note: Ctrl-C will stop without a checkpoint ({error})"
        ));
    }
    raised
}
