//! The end of a run, or its failure, in a few lines.

use std::collections::BTreeMap;
use std::path::Path;

use sph_core::{comma_list, number, unit_suffix};
use sph_particles::{ErrorEntry, Failure, Findings, ParticleRecord, Share, Summary, Suspect};
use sph_run::Status;

use crate::commands::file_list;
use crate::terminal::{Rows, columns, headed, memory, remarks, row, table};

pub fn text(summary: &Summary, out: &Path) -> String {
    let heads = "name, value, norm, against, samples";
    headline(summary.status, &summary.scene)
        + &columns(2, cost(summary))
        + &errors(heads, &summary.errors, error)
        + &headed("warnings", remarks(&summary.warnings))
        + &headed("advice", remarks(&summary.advice))
        + &file_list::ending(out)
}

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

fn cost(s: &Summary) -> Rows {
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

const TERMS: usize = 6;

pub fn failure(failure: &Failure) -> String {
    let found = &failure.findings;
    let mut text = found.particle.as_ref().map_or(String::new(), suspect);
    text.push_str(&terms(found));
    let tried = match found.retries {
        0 => "not tried again".to_string(),
        1 => "after a roll-back".to_string(),
        n => format!("after {n} roll-backs"),
    };
    let (dt, limiter) = (found.dt, &found.limiter);
    text += &format!("the step\n  Δt = {dt:.3e} s, bound `{limiter}`, {tried}\n");
    text.push_str(&headed("what may help", remarks(&found.advice)));
    let titles = [
        "a picture of the bad state",
        "and of what is around the particle",
    ];
    let pictures = titles.into_iter().zip(&failure.pictures);
    let bad_state = failure.bad_state.iter();
    let bad_state = bad_state.map(|path| ("all of it, for ParaView", path));
    let saved = failure.checkpoint.iter();
    let saved = saved.map(|path| ("the last good state, for --resume", path));
    let files = pictures.chain(bad_state).chain(saved);
    let rows = files.map(|(what, path)| row(what, path.display().to_string()));
    text + &headed("written", columns(2, rows))
}

fn suspect(suspect: &Suspect) -> String {
    let named = match suspect.named {
        true => "the particle",
        false => "the particle with the largest acceleration",
    };
    let (number, body, phase) = (suspect.number, &suspect.body, &suspect.phase);
    let mut text = format!("{named}\n  number {number} of body `{body}`, phase `{phase}`\n");
    for (when, seen) in [("before", &suspect.before), ("failed", &suspect.after)] {
        text.extend(seen.iter().map(|seen| sighting(when, seen)));
    }
    text
}

fn sighting(when: &str, seen: &ParticleRecord) -> String {
    let number = |x: &Option<f64>| x.map_or("not finite".into(), |x| format!("{x:.4e}"));
    let list = |v: &[Option<f64>]| comma_list(v.iter().map(number));
    let mut text = format!(
        "  {when}  t = {:.6} s, at ({}) m, u = ({}) m/s\n          ρ = {} kg/m³, p = {} Pa",
        seen.time,
        list(&seen.position),
        list(&seen.velocity),
        number(&seen.density),
        number(&seen.pressure)
    );
    if let Some(nearest) = seen.nearest {
        text.push_str(&format!("; nearest neighbour {nearest:.2} spacings"));
    }
    if let Some((wall, distance)) = &seen.wall {
        text.push_str(&format!("; wall `{wall}` {distance:.2} spacings"));
    }
    text.push('\n');
    text
}

/// The largest terms before and after, m/s².
fn terms(found: &Findings) -> String {
    let all = [
        ("at the last good state", &found.before),
        ("at the bad state", &found.after),
    ];
    let blocks = all.map(|(when, shares)| {
        let rows = shares.iter().take(TERMS).map(share);
        headed(&format!("what acted on it {when}, m/s²"), columns(2, rows))
    });
    blocks.concat()
}

fn share(share: &Share) -> Vec<String> {
    let number = |x: Option<f64>| x.map_or("not finite".into(), |x| format!("{x:.3e}"));
    let mut more = match share.of_walls {
        Some(0.0) => String::new(),
        of_walls => format!("of walls {}", number(of_walls)),
    };
    if let Some(rate) = share.density_rate {
        let comma = if more.is_empty() { "" } else { ", " };
        more.push_str(&format!("{comma}density at {rate:.3e} kg/m³/s"));
    }
    vec![share.term.clone(), number(share.acceleration), more]
}
