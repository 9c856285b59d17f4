//! Runs the missing variants of a study, one by one or side by side.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use sph_io::IoError;

use crate::running::repeat;
use crate::{Colour, Options, Record, Status, Study, Variant, Watcher, verdict};

#[derive(Debug)]
pub struct Outcome {
    pub records: Vec<Record>,
    /// True if it was stopped before all variants had run.
    pub stopped: bool,
    /// The error that kept it from going on, a full disk for instance.
    pub error: Option<IoError>,
}

/// Runs every wanted variant that is not settled by a record.
///
/// Results are the same for any number of threads; the times are not.
pub fn execute(study: &Study, options: &Options, watcher: &dyn Watcher) -> Outcome {
    let count = study.variants.len();
    let records: Vec<Mutex<Record>> = (0..count).map(|_| Mutex::default()).collect();
    let next = AtomicUsize::new(0);
    let halt = AtomicBool::new(false);
    let error = Mutex::new(None);
    let (workers, threads) = match study.file.serial {
        true => (1, options.threads()),
        false => (options.threads().clamp(1, count.max(1)), 1),
    };
    let chains = study.chains();
    let go_along = |chain: &[usize]| {
        let mut broken: Option<&Variant> = None;
        for &k in chain {
            let variant = &study.variants[k];
            if let Some(before) = broken {
                let record = skipped(before, variant, options);
                if variant.wanted {
                    watcher.finished(variant, &record);
                }
                *lock(&records[k]) = record;
                continue;
            }
            let stop = || halt.load(Ordering::SeqCst) || watcher.stop();
            let job = repeat::Job {
                study,
                variant,
                options,
                threads,
                watcher,
                stop: &stop,
            };
            let (record, result) = job.run();
            if let Err(told) = result {
                halt.store(true, Ordering::SeqCst);
                lock(&error).get_or_insert(told);
            }
            if breaks(study, variant, &record) {
                broken = Some(variant);
            }
            *lock(&records[k]) = record;
        }
    };
    let work = || {
        while let Some(chain) = chains.get(next.fetch_add(1, Ordering::SeqCst)) {
            go_along(chain);
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..workers {
            scope.spawn(work);
        }
        work();
    });
    let settled = |(v, r): (&Variant, &Record)| {
        let file = &study.file;
        !v.wanted
            || r.status == Status::Skipped
            || r.settles(&v.fingerprint, file.repetitions, file.time_limit)
    };
    let records: Vec<Record> = records.iter().map(|r| lock(r).clone()).collect();
    Outcome {
        stopped: !study.variants.iter().zip(&records).all(settled),
        records,
        error: lock(&error).take(),
    }
}

/// Marks of the variants that have to run, by their records.
pub fn to_run(study: &Study, options: &Options) -> Vec<bool> {
    let file = &study.file;
    let mut open = vec![false; study.variants.len()];
    for chain in study.chains() {
        for k in chain {
            let variant = &study.variants[k];
            let known = options.known(variant).unwrap_or_default();
            let settled = known.settles(&variant.fingerprint, file.repetitions, file.time_limit);
            open[k] = variant.wanted && !settled;
            if settled && breaks(study, variant, &known) {
                break;
            }
        }
    }
    open
}

/// True if nothing behind a variant on its axis is worth running.
fn breaks(study: &Study, variant: &Variant, record: &Record) -> bool {
    let ladder = variant.rung.map(|r| &study.ladders[r.ladder]);
    ladder.is_some_and(|ladder| {
        let found = verdict(record, &ladder.frontier.judge);
        !ladder.to_the_end && found.is_some_and(|v| v.colour == Colour::Red)
    })
}

/// The record of a variant behind one that broke: the earlier one, or that it is skipped.
fn skipped(before: &Variant, variant: &Variant, options: &Options) -> Record {
    let known = options.known(variant);
    let ended = known.filter(|r| !matches!(r.status, Status::Interrupted | Status::Pending));
    ended.unwrap_or_else(|| Record {
        status: Status::Skipped,
        reason: Some(format!("`{}` broke before", before.name)),
        ..Record::default()
    })
}

/// The content of a lock; no holder panics half-way through a change.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
