//! Progress of a run on stderr: a bar for a person, lines for a log.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use sph_core::number;
use sph_io::clean;
use sph_run::{Command, Observer, Progress};

use crate::terminal::console;

/// Wall-clock time between two updates of the bar.
const BAR: Duration = Duration::from_millis(100);
const DIVISIONS: u64 = 1000;

pub enum Display {
    Bar(ProgressBar),
    Lines,
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

    pub fn say(&self, text: &str) {
        match self {
            Display::Bar(bar) => bar.println(clean(text)),
            Display::Lines => console::err(text),
            Display::Silent => {}
        }
    }

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

/// Wall-clock time between two lines.
const LINE: Duration = Duration::from_secs(5);
/// Wall-clock time over which rates are averaged, s.
const MEMORY: f64 = 10.0;

/// Watches a run and passes Ctrl-C on.
pub struct Watcher {
    display: Display,
    /// Said once the scene is known to be good.
    start: Option<String>,
    stop: Arc<AtomicBool>,
    /// Noun of the counted things: "particle", "grain".
    noun: &'static str,
    every: Duration,
    told: Instant,
    meter: Option<Meter>,
    last: Option<Progress>,
}

impl Watcher {
    pub fn new(quiet: bool, start: String, noun: &'static str, stop: Arc<AtomicBool>) -> Self {
        let (display, every) = Display::new(quiet, LINE);
        Watcher {
            display,
            start: Some(start),
            stop,
            noun,
            every,
            told: Instant::now(),
            meter: None,
            last: None,
        }
    }

    pub fn finish(&mut self) {
        self.display.finish();
        if let (Display::Lines, Some(last), Some(mut meter)) =
            (&self.display, self.last.take(), self.meter.take())
        {
            meter.update(&last);
            self.print(&last, &meter);
        }
    }

    fn announce(&mut self) {
        if let Some(start) = self.start.take() {
            self.display.say(&start);
        }
    }

    fn print(&self, progress: &Progress, meter: &Meter) {
        let share = progress.time / progress.end;
        self.display.show(share, &line(progress, meter, self.noun));
    }
}

impl Observer for Watcher {
    fn step(&mut self, progress: &Progress) -> Command {
        self.announce();
        if self.meter.is_none() || self.told.elapsed() >= self.every {
            self.told = Instant::now();
            let mut meter = self.meter.take().unwrap_or_else(|| Meter::new(progress));
            meter.update(progress);
            self.print(progress, &meter);
            self.meter = Some(meter);
        }
        self.last = Some(progress.clone());
        match self.stop.load(Ordering::SeqCst) {
            true => Command::Stop,
            false => Command::Continue,
        }
    }

    fn message(&mut self, text: &str) {
        self.announce();
        self.display.say(text);
    }
}

fn line(progress: &Progress, meter: &Meter, noun: &str) -> String {
    let speed = match meter.work_rate {
        Some(rate) => format!("{} {noun}-steps/s", number::rate(rate)),
        None => format!("{} {noun}s", number::count(progress.particles as f64)),
    };
    let left = match meter.time_rate {
        Some(rate) if rate > 0.0 => {
            let seconds = (progress.end - progress.time).max(0.0) / rate;
            format!(", {} left", number::duration(seconds))
        }
        _ => String::new(),
    };
    // The most frequent choice comes first: a narrow terminal cuts the end.
    let [time, end] = [progress.time, progress.end].map(number::plain);
    let (dt, limiter, step) = (progress.dt, &progress.limiter, progress.step);
    format!("t = {time} of {end} s{left}  Δt {dt:.1e} s ({limiter})  {speed}  step {step}")
}

struct Meter {
    at: Instant,
    last: Progress,
    /// Simulated seconds per second.
    time_rate: Option<f64>,
    /// Particle-steps per second.
    work_rate: Option<f64>,
}

impl Meter {
    fn new(progress: &Progress) -> Self {
        Meter {
            at: Instant::now(),
            last: progress.clone(),
            time_rate: None,
            work_rate: None,
        }
    }

    fn update(&mut self, progress: &Progress) {
        let seconds = self.at.elapsed().as_secs_f64();
        if progress.step == self.last.step || seconds <= 0.0 {
            return;
        }
        let weight = 1.0 - (-seconds / MEMORY).exp();
        let blend = |old: Option<f64>, new: f64| Some(old.map_or(new, |o| o + weight * (new - o)));
        let steps = (progress.step - self.last.step) as f64;
        self.time_rate = blend(self.time_rate, (progress.time - self.last.time) / seconds);
        self.work_rate = blend(self.work_rate, steps * progress.particles as f64 / seconds);
        (self.at, self.last) = (Instant::now(), progress.clone());
    }
}
