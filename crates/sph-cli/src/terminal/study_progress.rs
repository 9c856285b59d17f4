//! Progress of a study: a bar over all variants, or a line for each.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use sph_io::clean;
use sph_run::Progress;
use sph_study::{Cost, Options, Record, Status, Study, Variant, to_run, verdict};

use crate::terminal::console;

use crate::number;

/// Wall-clock time between two updates of the bar.
const BAR: Duration = Duration::from_millis(100);
/// Wall-clock time between two lines within a variant.
const LINE: Duration = Duration::from_secs(30);
/// Divisions of the bar.
const DIVISIONS: u64 = 1000;

enum Display {
    Bar(ProgressBar),
    Lines,
    Silent,
}

/// Watches a study and passes Ctrl-C on.
pub struct Watcher {
    display: Display,
    stop: Arc<AtomicBool>,
    every: Duration,
    /// Of every variant by name: the reported error, or the bounds it is judged by.
    judged: BTreeMap<String, VariantReport>,
    /// Variants that are to be run or have been.
    total: usize,
    repetitions: usize,
    /// By variant: whether there is something to do.
    open: Vec<bool>,
    names: Vec<String>,
    state: Mutex<State>,
}

/// The report of a finished variant.
enum VariantReport {
    Error(String),
    Cost(Cost),
    Bounds(BTreeMap<String, [f64; 2]>),
}

impl VariantReport {
    fn sentence(&self, record: &Record) -> String {
        match self {
            VariantReport::Error(name) => match record.error(name) {
                Some(error) => format!("{name} {}", number::plain(error)),
                None => format!("no {name}"),
            },
            VariantReport::Cost(cost) => {
                let seconds = record.cost(*cost);
                seconds.map_or(String::new(), |s| format!("{} {s:.2e} s", cost.name()))
            }
            VariantReport::Bounds(bounds) => match verdict(record, bounds) {
                Some(found) if found.why.is_empty() => found.colour.name().to_string(),
                Some(found) => format!("{}, {}", found.colour.name(), found.why),
                None => record.status.name().to_string(),
            },
        }
    }
}

fn judged(study: &Study, variant: &Variant) -> (String, VariantReport) {
    let judged = match variant.rung {
        Some(rung) => VariantReport::Bounds(study.ladders[rung.ladder].judge.clone()),
        None => match (study.errors.first(), &study.file.scaling) {
            (None, Some(scaling)) => VariantReport::Cost(scaling.cost),
            (error, _) => VariantReport::Error(error.cloned().unwrap_or_default()),
        },
    };
    (variant.name.clone(), judged)
}

struct State {
    started: Instant,
    told: Instant,
    /// Settled variants.
    settled: usize,
    /// Work of every variant that has to run, by name.
    cost: BTreeMap<String, f64>,
    /// Share of every variant that has begun, by name.
    share: BTreeMap<String, f64>,
    repetition: BTreeMap<String, usize>,
}

impl Watcher {
    /// A watcher that stops the study once the flag is raised.
    pub fn new(quiet: bool, study: &Study, options: &Options, stop: Arc<AtomicBool>) -> Self {
        let (display, every) = match (quiet, console::terminal()) {
            (true, _) => (Display::Silent, LINE),
            (false, true) => (Display::Bar(bar()), BAR),
            (false, false) => (Display::Lines, LINE),
        };
        let file = &study.file;
        let open = to_run(study, options);
        let wanted = study.variants.iter().filter(|v| v.wanted).count();
        let to_run = open.iter().filter(|o| **o).count();
        let settled = wanted - to_run;
        let watcher = Watcher {
            display,
            stop,
            every,
            judged: study.variants.iter().map(|v| judged(study, v)).collect(),
            total: wanted,
            repetitions: file.repetitions,
            open,
            names: study.variants.iter().map(|v| v.name.clone()).collect(),
            state: Mutex::new(State {
                started: Instant::now(),
                told: Instant::now(),
                settled,
                cost: BTreeMap::new(),
                share: BTreeMap::new(),
                repetition: BTreeMap::new(),
            }),
        };
        watcher.say(&format!(
            "{}: {} variants, {} to run, into {}",
            file.title,
            study.variants.len(),
            to_run,
            options.out.display()
        ));
        watcher
    }

    /// True if a variant has to run.
    pub fn has_to_run(&self, k: usize) -> bool {
        self.open.get(k).copied().unwrap_or(false)
    }

    /// A variant is good and will take about so long.
    pub fn assembled(&self, k: usize, work: f64) {
        let mut state = self.state();
        if let Some(name) = self.names.get(k) {
            state.cost.insert(name.clone(), work.max(1e-3));
            if let Display::Bar(bar) = &self.display {
                bar.set_message(clean(&format!("checked {name}")).into_owned());
            }
        }
        state.started = Instant::now();
    }

    /// Removes the bar.
    pub fn finish(&self) {
        if let Display::Bar(bar) = &self.display {
            bar.finish_and_clear();
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn say(&self, text: &str) {
        match &self.display {
            Display::Bar(bar) => bar.println(clean(text)),
            Display::Lines => console::err(text),
            Display::Silent => {}
        }
    }

    fn print(&self, state: &State, variant: &str) {
        let share = state.done_share();
        let left = match share {
            share if share > 0.0 => {
                let seconds = state.started.elapsed().as_secs_f64() * (1.0 - share) / share;
                format!(", {} left", number::duration(seconds))
            }
            _ => String::new(),
        };
        let own = state.share.get(variant).copied().unwrap_or(0.0);
        let text = format!(
            "{} of {}{left}  {variant} {:.0} %",
            state.settled,
            self.total,
            100.0 * own
        );
        match &self.display {
            Display::Bar(bar) => {
                bar.set_position((share * DIVISIONS as f64) as u64);
                bar.set_message(clean(&text).into_owned());
            }
            Display::Lines => console::err(&format!("{:5.1} %  {text}", 100.0 * share)),
            Display::Silent => {}
        }
    }
}

impl State {
    /// Share of the estimated work that is done.
    fn done_share(&self) -> f64 {
        let all: f64 = self.cost.values().sum();
        let done = self.share.iter();
        let done = done.map(|(name, share)| share * self.cost.get(name).unwrap_or(&0.0));
        let done: f64 = done.sum();
        if all > 0.0 {
            (done / all).min(1.0)
        } else {
            0.0
        }
    }
}

impl sph_study::Watcher for Watcher {
    fn started(&self, variant: &Variant, repetition: usize) {
        let mut state = self.state();
        state.repetition.insert(variant.name.clone(), repetition);
        if matches!(self.display, Display::Bar(_)) {
            self.print(&state, &variant.name);
        }
    }

    fn step(&self, variant: &Variant, progress: &Progress) {
        let mut state = self.state();
        if state.told.elapsed() < self.every {
            return;
        }
        state.told = Instant::now();
        let before = state.repetition.get(&variant.name).copied().unwrap_or(0) as f64;
        let share = (before + progress.time / progress.end) / self.repetitions as f64;
        state.share.insert(variant.name.clone(), share);
        self.print(&state, &variant.name);
    }

    fn message(&self, variant: &Variant, text: &str) {
        // Notes of every variant, and tries of those that are meant to break, would bury the study; a
        // summary keeps them.
        if !text.starts_with("note: ") && variant.rung.is_none() {
            self.say(&format!("{}: {text}", variant.name));
        }
    }

    fn finished(&self, variant: &Variant, record: &Record) {
        let mut state = self.state();
        state.share.insert(variant.name.clone(), 1.0);
        let open = self.names.iter().position(|n| *n == variant.name);
        if !open.is_some_and(|k| self.has_to_run(k)) {
            return;
        }
        if record.status != Status::Interrupted {
            state.settled += 1;
        }
        if record.status == Status::Skipped {
            return;
        }
        let what = match (self.judged.get(&variant.name), &record.reason) {
            (Some(judged), _) if record.status == Status::Done => judged.sentence(record),
            (_, Some(reason)) => format!("{}: {reason}", record.status.name()),
            _ => record.status.name().to_string(),
        };
        let time = record.least_seconds();
        let time = time.map_or(String::new(), |s| format!(", {}", number::duration(s)));
        let text = format!(
            "{} of {}  {}: {what}{time}",
            state.settled, self.total, variant.name
        );
        self.say(&text);
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::SeqCst)
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(DIVISIONS), ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template("{bar:12} {percent:>3} %  {wide_msg}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}
