//! Progress of a study: a bar over all variants, or a line for each.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use sph_core::number;
use sph_run::Progress;
use sph_study::{Options, Record, Status, Study, Variant, to_run, verdict};

use crate::terminal::progress::Display;

/// Wall-clock time between two lines within a variant.
const LINE: Duration = Duration::from_secs(30);

/// Watches a study and passes Ctrl-C on.
pub struct Watcher<'s> {
    study: &'s Study,
    display: Display,
    stop: Arc<AtomicBool>,
    every: Duration,
    /// Variants that are to be run or have been.
    total: usize,
    /// By variant: whether there is something to do.
    pub open: Vec<bool>,
    state: Mutex<State>,
}

/// The error of a finished variant that is reported, its cost, or its verdict.
fn sentence(study: &Study, variant: &Variant, record: &Record) -> String {
    if let Some(rung) = variant.rung {
        return match verdict(record, &study.ladders[rung.ladder].frontier.judge) {
            Some(found) if found.why.is_empty() => found.colour.name().to_string(),
            Some(found) => format!("{}, {}", found.colour.name(), found.why),
            None => record.status.name().to_string(),
        };
    }
    let error = study.errors.first();
    if let (None, Some(scaling)) = (error, &study.file.scaling) {
        let (cost, seconds) = (scaling.cost.name(), record.cost(scaling.cost));
        return seconds.map_or(String::new(), |s| format!("{cost} {s:.2e} s"));
    }
    let name = error.map_or("", String::as_str);
    match record.error(name) {
        Some(error) => format!("{name} {}", number::plain(error)),
        None => format!("no {name}"),
    }
}

struct State {
    started: Instant,
    told: Instant,
    settled: usize,
    /// By name.
    variants: BTreeMap<String, VariantProgress>,
}

#[derive(Default)]
struct VariantProgress {
    /// Work of a run, 0 where none is to be done.
    cost: f64,
    /// Share that is done.
    share: f64,
    repetition: usize,
}

impl<'s> Watcher<'s> {
    pub fn new(quiet: bool, study: &'s Study, options: &Options, stop: Arc<AtomicBool>) -> Self {
        let (display, every) = Display::new(quiet, LINE);
        let open = to_run(study, options);
        let total = study.variants.iter().filter(|v| v.wanted).count();
        let to_run = open.iter().filter(|o| **o).count();
        let (title, all) = (&study.file.title, study.variants.len());
        let out = options.out.display();
        let text = format!("{title}: {all} variants, {to_run} to run, into {out}");
        display.say(&text);
        Watcher {
            study,
            display,
            stop,
            every,
            total,
            open,
            state: Mutex::new(State {
                started: Instant::now(),
                told: Instant::now(),
                settled: total - to_run,
                variants: BTreeMap::new(),
            }),
        }
    }

    /// A variant is good and will take about so long.
    pub fn assembled(&self, variant: &Variant, work: f64) {
        let mut state = self.state();
        state.variant(variant).cost = work.max(1e-3);
        if let Display::Bar(bar) = &self.display {
            let text = format!("checked {}", variant.name);
            bar.set_message(sph_io::clean(&text).into_owned());
        }
        state.started = Instant::now();
    }

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
        let own = state.variants.get(variant).map_or(0.0, |own| own.share);
        let (settled, total, own) = (state.settled, self.total, 100.0 * own);
        let text = format!("{settled} of {total}{left}  {variant} {own:.0} %");
        self.display.show(share, &text);
    }
}

impl State {
    fn variant(&mut self, variant: &Variant) -> &mut VariantProgress {
        self.variants.entry(variant.name.clone()).or_default()
    }

    fn done_share(&self) -> f64 {
        let all: f64 = self.variants.values().map(|v| v.cost).sum();
        let done: f64 = self.variants.values().map(|v| v.share * v.cost).sum();
        match all > 0.0 {
            true => (done / all).min(1.0),
            false => 0.0,
        }
    }
}

impl sph_study::Watcher for Watcher<'_> {
    fn started(&self, variant: &Variant, repetition: usize) {
        let mut state = self.state();
        state.variant(variant).repetition = repetition;
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
        let own = state.variant(variant);
        let repetitions = self.study.file.repetitions as f64;
        own.share = (own.repetition as f64 + progress.time / progress.end) / repetitions;
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
        state.variant(variant).share = 1.0;
        let mut all = self.study.variants.iter().zip(&self.open);
        if !all.any(|(own, open)| *open && own.name == variant.name) {
            return;
        }
        if record.status != Status::Interrupted {
            state.settled += 1;
        }
        if record.status == Status::Skipped {
            return;
        }
        let what = match (record.status, &record.reason) {
            (Status::Done, _) => sentence(self.study, variant, record),
            (status, Some(reason)) => format!("{}: {reason}", status.name()),
            (status, None) => status.name().to_string(),
        };
        let time = record.least_seconds();
        let time = time.map_or(String::new(), |s| format!(", {}", number::duration(s)));
        let (settled, total, name) = (state.settled, self.total, &variant.name);
        let text = format!("{settled} of {total}  {name}: {what}{time}");
        self.display.say(&text);
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::SeqCst)
    }
}
