//! The end of a run in a few lines.

use std::collections::BTreeMap;
use std::path::Path;

use sph_core::unit_suffix;
use sph_particles::Summary;
use sph_run::Status;

use crate::commands::file_list;
use crate::number;
use crate::terminal::layout::{columns, memory, remarks, row, table};

/// The run, its cost, its quality, and the places of its files.
pub fn text(summary: &Summary, out: &Path) -> String {
    let mut text = headline(summary.status, &summary.scene);
    text.push_str(&columns(2, &cost(summary)));
    text.push_str(&errors(summary));
    for (title, list) in [("warnings", &summary.warnings), ("advice", &summary.advice)] {
        if !list.is_empty() {
            text.push_str(&format!("{title}\n{}", remarks(list)));
        }
    }
    text.push_str(&file_list::ending(out));
    text
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
    let limiters: Vec<String> = limiters
        .iter()
        .map(|(name, share)| format!("{name} {}", number::percent(**share)))
        .collect();
    limiters.join(", ")
}

fn cost(s: &Summary) -> Vec<Vec<String>> {
    let particles = format!(
        "{} particles, {} wall points, {:.1} neighbours each",
        number::count(s.particles as f64),
        number::count(s.wall_points as f64),
        s.neighbours
    );
    let back = match s.steps_rolled_back {
        0 => String::new(),
        n => format!(", {n} rolled back"),
    };
    let since = s.started_at.map_or(String::new(), |t| {
        format!("from t = {} s of another run ", number::plain(t))
    });
    let steps = format!(
        "{} {since}to t = {} s{back}",
        number::count(s.steps as f64),
        number::plain(s.simulated_seconds)
    );
    let speed = format!(
        "{} particle-steps/s, {:.1} ns per pair and thread",
        number::rate(s.particle_steps_per_second),
        s.nanoseconds_per_pair
    );
    vec![
        row("size", particles),
        row("steps", steps),
        row("wall time", wall_time(s.wall_seconds, s.threads)),
        row("speed", speed),
        row("memory", memory(&s.memory)),
        row("Δt limited by", limited_by(&s.dt_limiters)),
        // Momentum and energy, which walls and friction take, are in the summary.
        row("mass drift", format!("{:.1e}", s.drift.mass)),
    ]
}

fn errors(summary: &Summary) -> String {
    if summary.errors.is_empty() {
        return String::new();
    }
    let rows = summary.errors.iter().map(|(name, error)| {
        let unit = unit_suffix(&error.unit);
        let value = error.value.map_or("none".to_string(), number::plain);
        vec![
            name.clone(),
            format!("{value}{unit}"),
            error.norm.clone(),
            error.against.clone(),
            error.samples.to_string(),
        ]
    });
    let heads = ["name", "value", "norm", "against", "samples"];
    format!("errors\n{}", table(&heads, rows))
}
