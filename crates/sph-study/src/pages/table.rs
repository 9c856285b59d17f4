//! Results as rows of text, for terminals, pages and spreadsheets.

use std::path::Path;

use sph_core::number;
use sph_io::{IoError, clean, write_whole};

use crate::pages::matrix;
use crate::{Cost, Results, Status, VariantResult};

/// One row per variant, the first one being the heads of the columns.
pub fn rows(results: &Results) -> Vec<Vec<String>> {
    if !results.frontiers.is_empty() {
        return matrix::summary(results);
    }
    with_heads(results.variants.iter().map(|v| row(results, v)))
}

/// Rows below the names of their cells, which are those of the first.
fn with_heads(rows: impl Iterator<Item = Vec<(String, String)>>) -> Vec<Vec<String>> {
    let mut all = Vec::new();
    for row in rows {
        let (heads, cells) = row.into_iter().unzip();
        if all.is_empty() {
            all.push(heads);
        }
        all.push(cells);
    }
    all
}

fn row(results: &Results, v: &VariantResult) -> Vec<(String, String)> {
    let none = || "–".to_string();
    let number = |x: Option<f64>| x.map_or_else(none, number::plain);
    let value = |axis: &String| v.values.get(axis).cloned().unwrap_or_default();
    let axes = results.axes.iter();
    let mut row: Vec<(String, String)> = axes.map(|a| (a.clone(), value(a))).collect();
    if row.is_empty() {
        row.push(("variant".into(), v.name.clone()));
    }
    let errors = results.errors.iter();
    row.extend(errors.map(|name| (name.clone(), number(v.error(name)))));
    let mut add = |head: &str, cell: Option<String>| {
        row.push((head.to_string(), cell.unwrap_or_else(none)));
    };
    if results.refinement.is_some() && !results.errors.is_empty() {
        add("order", v.order.map(|o| format!("{o:.2}")));
    }
    if let Some(scale) = &results.scale {
        let milliseconds = |s: f64| format!("{} ms", number::plain((s * 1e6).round() / 1e3));
        add(scale.cost.name(), v.cost(scale.cost).map(milliseconds));
        if scale.cost == Cost::Solve {
            let solves = v.solves.as_ref();
            add("iterations", solves.map(|s| format!("{:.1}", s.iterations)));
            let megabytes = |bytes: usize| format!("{:.1} MB", bytes as f64 / 1e6);
            add("memory", solves.map(|s| megabytes(s.bytes)));
        }
    }
    add("wall time", seconds(v));
    let count = |n: f64| (n > 0.0).then(|| number::count(n));
    add("steps", count(v.size.steps as f64));
    add("particles", count(v.size.particles as f64));
    let limiter = v.dt_limiter.as_ref().map(|name| {
        let share = v.dt_limiters.get(name).copied().unwrap_or(0.0);
        format!("{name} {:.0} %", 100.0 * share)
    });
    add("limited by", limiter);
    let name = v.status.name();
    let status = match (v.status, &v.reason) {
        (Status::Failed | Status::OverLimit, Some(reason)) => format!("{name}: {reason}"),
        _ => name.to_string(),
    };
    add("status", Some(status));
    row
}

/// The least time, with the spread where there are several.
fn seconds(v: &VariantResult) -> Option<String> {
    let text = match v.wall_seconds.min? {
        s if s < 100.0 => format!("{} s", number::plain((s * 1e3).round() / 1e3)),
        s => number::duration(s),
    };
    Some(match v.wall_seconds.spread {
        Some(spread) => format!("{text} +{:.0} %", 100.0 * spread),
        None => text,
    })
}

/// Writes one row of plain numbers per variant.
pub fn write_csv(results: &Results, path: &Path) -> Result<(), IoError> {
    let errors = errors(results);
    let rows = with_heads(results.variants.iter().map(|v| plain(results, &errors, v)));
    let cells = |row: &Vec<String>| row.iter().map(|c| quoted(c)).collect::<Vec<_>>();
    let lines = rows.iter().map(|row| cells(row).join(",") + "\n");
    write_whole(path, lines.collect::<String>())
}

fn plain(results: &Results, errors: &[String], v: &VariantResult) -> Vec<(String, String)> {
    let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x}"));
    let value = |axis: &String| clean(&v.values[axis]).into_owned();
    let refinement = results.refinement.clone();
    let refinement = refinement.unwrap_or("refinement".into());
    let mut row = vec![("variant".to_string(), clean(&v.name).into_owned())];
    row.extend(results.axes.iter().map(|a| (a.clone(), value(a))));
    row.push((refinement, number(v.refinement)));
    row.push(("status".into(), v.status.name().into()));
    row.extend((errors.iter()).map(|e| (format!("error.{e}"), number(v.error(e)))));
    let (health, verdict, solves) = (&v.health, v.verdict.as_ref(), v.solves.as_ref());
    let trouble = health.first_trouble.as_ref();
    let trouble = trouble.map_or(String::new(), matrix::trouble);
    let density = |k: usize| number(health.density_range.map(|range| range[k]));
    let rest = [
        ("order", number(v.order)),
        ("wall_seconds", number(v.wall_seconds.min)),
        ("wall_spread", number(v.wall_seconds.spread)),
        ("solves", number(solves.map(|s| s.count as f64))),
        ("solve_seconds", number(solves.map(|s| s.seconds))),
        ("solve_iterations", number(solves.map(|s| s.iterations))),
        ("solve_bytes", number(solves.map(|s| s.bytes as f64))),
        ("threads", v.size.threads.to_string()),
        ("steps", v.size.steps.to_string()),
        ("particles", v.size.particles.to_string()),
        ("dt_limiter", v.dt_limiter.clone().unwrap_or_default()),
        ("colour", verdict.map_or("", |v| v.colour.name()).into()),
        ("why", verdict.map_or(String::new(), |v| v.why.clone())),
        ("first_trouble", trouble),
        ("energy_drift", number(health.energy_drift)),
        ("energy_rise", number(health.energy_rise)),
        ("momentum_drift", number(health.momentum_drift)),
        ("least_density", density(0)),
        ("largest_density", density(1)),
        ("mach", number(health.mach)),
        ("escaped", health.escaped.to_string()),
        ("reason", v.reason.clone().unwrap_or_default()),
    ];
    row.extend(rest.map(|(head, cell)| (head.to_string(), cell)));
    row
}

fn errors(results: &Results) -> Vec<String> {
    let mut all = results.errors.clone();
    for name in results.frontiers.iter().flat_map(|f| &f.errors) {
        if !all.contains(name) {
            all.push(name.clone());
        }
    }
    all
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
