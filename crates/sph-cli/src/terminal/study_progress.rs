//! Progress of a study: a bar over all variants, or a line for each.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use sph_run::Progress;
use sph_study::{Cost, Options, Record, Status, Study, Variant, to_run, verdict};

use crate::number;
use crate::terminal::display::Display;

/// Wall-clock time between two lines within a variant.
const LINE: Duration = Duration::from_secs(30);

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
    /// By variant: its name, and whether there is something to do.
    open: Vec<(String, bool)>,
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
        let (display, every) = Display::new(quiet, LINE);
        let file = &study.file;
        let open = to_run(study, options);
        let wanted = study.variants.iter().filter(|v| v.wanted).count();
        let to_run = open.iter().filter(|o| **o).count();
        let settled = wanted - to_run;
        let names = study.variants.iter().map(|v| v.name.clone());
        let watcher = Watcher {
            display,
            stop,
            every,
            judged: study.variants.iter().map(|v| judged(study, v)).collect(),
            total: wanted,
            repetitions: file.repetitions,
            open: names.zip(open).collect(),
            state: Mutex::new(State {
                started: Instant::now(),
                told: Instant::now(),
                settled,
                cost: BTreeMap::new(),
                share: BTreeMap::new(),
                repetition: BTreeMap::new(),
            }),
        };
        watcher.display.say(&format!(
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
        self.open.get(k).is_some_and(|(_, open)| *open)
    }

    /// A variant is good and will take about so long.
    pub fn assembled(&self, k: usize, work: f64) {
        let mut state = self.state();
        if let Some((name, _)) = self.open.get(k) {
            state.cost.insert(name.clone(), work.max(1e-3));
            if let Display::Bar(bar) = &self.display {
                bar.set_message(sph_io::clean(&format!("checked {name}")).into_owned());
            }
        }
        state.started = Instant::now();
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.display.finish();
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
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
        self.display.show(share, &text);
    }
}

impl State {
    /// Share of the estimated work that is done.
    fn done_share(&self) -> f64 {
        let all: f64 = self.cost.values().sum();
        let done = self.share.iter();
        let done = done.map(|(name, share)| share * self.cost.get(name).unwrap_or(&0.0));
        let done: f64 = done.sum();
        match all > 0.0 {
            true => (done / all).min(1.0),
            false => 0.0,
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
            self.display.say(&format!("{}: {text}", variant.name));
        }
    }

    fn finished(&self, variant: &Variant, record: &Record) {
        let mut state = self.state();
        state.share.insert(variant.name.clone(), 1.0);
        let mut open = self.open.iter().filter(|(_, open)| *open);
        if !open.any(|(name, _)| *name == variant.name) {
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
        self.display.say(&text);
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::SeqCst)
    }
}
