//! Progress on stderr: a bar for a person, lines for a log.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use sph_io::clean;

use crate::terminal::console;

/// Wall-clock time between two updates of the bar.
const BAR: Duration = Duration::from_millis(100);
/// Divisions of the bar.
const DIVISIONS: u64 = 1000;

/// The form of progress.
pub enum Display {
    /// A bar, in a terminal.
    Bar(ProgressBar),
    /// A line now and then.
    Lines,
    /// None.
    Silent,
}

impl Display {
    /// The form for stderr, and the wall-clock time between two updates; `line` is that between two lines.
    pub fn new(quiet: bool, line: Duration) -> (Self, Duration) {
        match (quiet, console::terminal()) {
            (true, _) => (Display::Silent, line),
            (false, true) => (Display::Bar(bar()), BAR),
            (false, false) => (Display::Lines, line),
        }
    }

    /// Prints a line of its own.
    pub fn say(&self, text: &str) {
        match self {
            Display::Bar(bar) => bar.println(clean(text)),
            Display::Lines => console::err(text),
            Display::Silent => {}
        }
    }

    /// Shows the share that is done.
    pub fn show(&self, share: f64, text: &str) {
        match self {
            Display::Bar(bar) => {
                bar.set_position((share * DIVISIONS as f64) as u64);
                bar.set_message(clean(text).into_owned());
            }
            Display::Lines => console::err(&format!("{:5.1} %  {text}", 100.0 * share)),
            Display::Silent => {}
        }
    }

    /// Removes the bar.
    pub fn finish(&self) {
        if let Display::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(DIVISIONS), ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template("{bar:12} {percent:>3} %  {wide_msg}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}
