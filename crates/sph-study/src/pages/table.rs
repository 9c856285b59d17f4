//! Results as rows of text, for terminals, pages and spreadsheets.

use std::io::Write;
use std::path::Path;

use sph_core::number;
use sph_io::{Durability, IoError, clean, write_atomic};

use crate::results::Results;
use crate::results::matrix;
use crate::results::variant_result::VariantResult;
use crate::running::cost::Cost;
use crate::running::record::Status;

/// One row per variant, the first one being the heads of the columns.
pub fn rows(results: &Results) -> Vec<Vec<String>> {
    if !results.frontiers.is_empty() {
        return matrix::summary(results);
    }
    let mut heads: Vec<String> = results.axes.clone();
    if heads.is_empty() {
        heads.push("variant".into());
    }
    heads.extend(results.errors.clone());
    let refined = results.refinement.is_some() && !results.errors.is_empty();
    heads.extend(refined.then(|| "order".to_string()));
    let scale = results.scale.as_ref().map(|s| s.cost);
    heads.extend(scale.iter().flat_map(|c| costs_heads(*c)));
    heads.extend(["wall time", "steps", "particles", "limited by", "status"].map(String::from));
    let mut all = vec![heads];
    all.extend(results.variants.iter().map(|v| row(results, v, refined)));
    all
}

fn row(results: &Results, v: &VariantResult, refined: bool) -> Vec<String> {
    let none = || "–".to_string();
    let labels = results.axes.iter().map(|a| v.values.get(a).cloned());
    let mut row: Vec<String> = labels.map(Option::unwrap_or_default).collect();
    if row.is_empty() {
        row.push(v.name.clone());
    }
    let errors = results.errors.iter().map(|name| v.error(name));
    row.extend(errors.map(|e| e.map_or_else(none, number::plain)));
    if refined {
        row.push(v.order.map_or_else(none, |o| format!("{o:.2}")));
    }
    if let Some(scale) = &results.scale {
        row.extend(costs(scale.cost, v).map(|c| c.unwrap_or_else(none)));
    }
    let begun = v.steps > 0;
    row.push(seconds(v).unwrap_or_else(none));
    let count = |n: f64| if begun { number::count(n) } else { none() };
    row.push(count(v.steps as f64));
    row.push(match v.particles {
        0 => none(),
        n => number::count(n as f64),
    });
    let limiter = v.dt_limiter.as_ref();
    row.push(limiter.map_or_else(none, |name| {
        let share = v.dt_limiters.get(name).copied().unwrap_or(0.0);
        format!("{name} {:.0} %", 100.0 * share)
    }));
    row.push(match (v.status, &v.reason) {
        (Status::Failed | Status::OverLimit, Some(reason)) => {
            format!("{}: {reason}", v.status.name())
        }
        (status, _) => status.name().to_string(),
    });
    row
}

/// Heads of the columns of a cost.
fn costs_heads(cost: Cost) -> Vec<String> {
    let heads: &[&str] = match cost {
        Cost::Step => &["time per step"],
        Cost::Solve => &["time per solve", "iterations", "memory"],
    };
    heads.iter().map(|h| h.to_string()).collect()
}

/// Cells of the costs below them.
fn costs(cost: Cost, v: &VariantResult) -> impl Iterator<Item = Option<String>> {
    let milliseconds = |s: f64| format!("{} ms", number::plain((s * 1e6).round() / 1e3));
    let mut cells = vec![v.cost(cost).map(milliseconds)];
    if cost == Cost::Solve {
        let solves = v.solves.as_ref();
        cells.push(solves.map(|s| format!("{:.1}", s.iterations)));
        cells.push(solves.map(|s| format!("{:.1} MB", s.bytes as f64 / 1e6)));
    }
    cells.into_iter()
}

/// The least time, with the spread where there are several.
fn seconds(v: &VariantResult) -> Option<String> {
    let least = v.wall_seconds.min?;
    let text = match least {
        s if s < 100.0 => format!("{} s", number::plain((s * 1e3).round() / 1e3)),
        s => number::duration(s),
    };
    Some(match v.wall_seconds.spread {
        Some(spread) => format!("{text} +{:.0} %", 100.0 * spread),
        None => text,
    })
}

/// Writes one row of plain numbers per variant.
///
/// # Errors
/// If the file cannot be written.
pub fn write_csv(results: &Results, path: &Path) -> Result<(), IoError> {
    write_atomic(path, Durability::Process, |file| csv(results, file))
}

fn csv(results: &Results, file: &mut dyn Write) -> std::io::Result<()> {
    let mut heads = vec!["variant".to_string()];
    heads.extend(results.axes.iter().cloned());
    heads.push(results.refinement.clone().unwrap_or("refinement".into()));
    heads.push("status".into());
    let errors = errors(results);
    heads.extend(errors.iter().map(|e| format!("error.{e}")));
    let rest = [
        "order",
        "wall_seconds",
        "wall_spread",
        "solves",
        "solve_seconds",
        "solve_iterations",
        "solve_bytes",
        "threads",
        "steps",
        "particles",
        "dt_limiter",
        "colour",
        "why",
        "first_trouble",
        "energy_drift",
        "energy_rise",
        "momentum_drift",
        "least_density",
        "largest_density",
        "mach",
        "escaped",
        "reason",
    ];
    heads.extend(rest.map(String::from));
    line(file, &heads)?;
    for v in &results.variants {
        let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x}"));
        let mut row = vec![clean(&v.name).into_owned()];
        row.extend(
            results
                .axes
                .iter()
                .map(|a| clean(&v.values[a]).into_owned()),
        );
        row.push(number(v.refinement));
        row.push(v.status.name().into());
        row.extend(errors.iter().map(|e| number(v.error(e))));
        let health = &v.health;
        let verdict = v.verdict.as_ref();
        row.extend([
            number(v.order),
            number(v.wall_seconds.min),
            number(v.wall_seconds.spread),
            number(v.solves.as_ref().map(|s| s.count as f64)),
            number(v.solves.as_ref().map(|s| s.seconds)),
            number(v.solves.as_ref().map(|s| s.iterations)),
            number(v.solves.as_ref().map(|s| s.bytes as f64)),
            v.threads.to_string(),
            v.steps.to_string(),
            v.particles.to_string(),
            v.dt_limiter.clone().unwrap_or_default(),
            verdict.map_or("", |v| v.colour.name()).to_string(),
            verdict.map_or(String::new(), |v| v.why.clone()),
            health
                .first_trouble
                .as_ref()
                .map_or(String::new(), matrix::trouble),
            number(health.energy_drift),
            number(health.energy_rise),
            number(health.momentum_drift),
            number(health.density_range.map(|r| r[0])),
            number(health.density_range.map(|r| r[1])),
            number(health.mach),
            health.escaped.to_string(),
            v.reason.clone().unwrap_or_default(),
        ]);
        line(file, &row)?;
    }
    Ok(())
}

/// Names of all errors in the report.
fn errors(results: &Results) -> Vec<String> {
    let mut all = results.errors.clone();
    for name in results.frontiers.iter().flat_map(|f| &f.errors) {
        if !all.contains(name) {
            all.push(name.clone());
        }
    }
    all
}

fn line(file: &mut dyn Write, cells: &[String]) -> std::io::Result<()> {
    let cells: Vec<String> = cells.iter().map(|c| quoted(c)).collect();
    writeln!(file, "{}", cells.join(","))
}

/// A cell as RFC 4180 has it.
fn quoted(cell: &str) -> String {
    match cell.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn cells_with_separators_are_quoted() {
        assert_eq!(quoted("a b"), "a b");
        assert_eq!(quoted("a, \"b\""), "\"a, \"\"b\"\"\"");
    }
}
