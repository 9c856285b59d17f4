//! The end of a run in a few lines.

use std::collections::BTreeMap;
use std::path::Path;

use sph_core::{comma_list, number, unit_suffix};
use sph_particles::{ErrorEntry, Summary};
use sph_run::Status;

use crate::commands::file_list;
use crate::terminal::{columns, headed, memory, remarks, row, table};

/// The run, its cost, its quality, and the places of its files.
pub fn text(summary: &Summary, out: &Path) -> String {
    let heads = "name, value, norm, against, samples";
    headline(summary.status, &summary.scene)
        + &columns(2, cost(summary))
        + &errors(heads, &summary.errors, error)
        + &headed("warnings", remarks(&summary.warnings))
        + &headed("advice", remarks(&summary.advice))
        + &file_list::ending(out)
}

/// End of a run, and its scene.
pub fn headline(status: Status, scene: &str) -> String {
    let status = match status {
        Status::Done => "done",
        Status::Failed => "failed",
        Status::Interrupted => "interrupted",
    };
    format!("{status}: {scene}\n")
}

/// Wall-clock time (s) and threads.
pub fn wall_time(seconds: f64, threads: usize) -> String {
    let threads = match threads {
        1 => "1 thread".to_string(),
        n => format!("{n} threads"),
    };
    format!("{} on {threads}", number::duration(seconds))
}

/// Bounds that limited the steps, the most frequent first.
pub fn limited_by(shares: &BTreeMap<String, f64>) -> String {
    let mut limiters: Vec<(&String, &f64)> = shares.iter().collect();
    limiters.sort_by(|a, b| b.1.total_cmp(a.1));
    let limiters = limiters.into_iter();
    comma_list(limiters.map(|(name, share)| format!("{name} {}", number::percent(*share))))
}

fn cost(s: &Summary) -> Vec<Vec<String>> {
    let [particles, points] = [s.particles, s.wall_points].map(|n| number::count(n as f64));
    let steps = number::count(s.steps as f64);
    let end = number::plain(s.simulated_seconds);
    let rate = number::rate(s.particle_steps_per_second);
    let (each, pair) = (s.neighbours, s.nanoseconds_per_pair);
    let size = format!("{particles} particles, {points} wall points, {each:.1} neighbours each");
    let back = match s.steps_rolled_back {
        0 => String::new(),
        n => format!(", {n} rolled back"),
    };
    let since = s.started_at.map_or(String::new(), |t| {
        format!("from t = {} s of another run ", number::plain(t))
    });
    let steps = format!("{steps} {since}to t = {end} s{back}");
    let speed = format!("{rate} particle-steps/s, {pair:.1} ns per pair and thread");
    vec![
        row("size", size),
        row("steps", steps),
        row("wall time", wall_time(s.wall_seconds, s.threads)),
        row("speed", speed),
        row("memory", memory(&s.memory)),
        row("Δt limited by", limited_by(&s.dt_limiters)),
        // Momentum and energy, which walls and friction take, are in the summary.
        row("mass drift", format!("{:.1e}", s.drift.mass)),
    ]
}

/// Errors below their heads, the first of which is that of their names; nothing if there are none.
pub fn errors<E>(
    heads: &str,
    errors: &BTreeMap<String, E>,
    cells: impl Fn(&E) -> Vec<String>,
) -> String {
    let row = |(name, error)| [vec![String::clone(name)], cells(error)].concat();
    match errors.is_empty() {
        true => String::new(),
        false => headed("errors", table(heads, errors.iter().map(row))),
    }
}

fn error(error: &ErrorEntry) -> Vec<String> {
    let value = error.value.map_or("none".to_string(), number::plain) + &unit_suffix(&error.unit);
    let (norm, against) = (error.norm.clone(), error.against.clone());
    vec![value, norm, against, error.samples.to_string()]
}
