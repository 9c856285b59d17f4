//! The end of a run of grains in a few lines.

use std::path::Path;

use dem_pfv::scene::{Compared, Summary};

use crate::commands::file_list;
use crate::commands::outcome::{headline, limited_by, row, wall_time};
use crate::number;
use crate::terminal::layout::{columns, remarks};

/// The run, its cost, its quality, and the places of its files.
pub fn text(summary: &Summary, out: &Path) -> String {
    let mut text = headline(summary.status, &summary.scene);
    text.push_str(&columns(2, &cost(summary)));
    if !summary.derived.is_empty() {
        let row = |(name, value): (&String, &f64)| vec![name.clone(), number::plain(*value)];
        let rows: Vec<_> = summary.derived.iter().map(row).collect();
        text.push_str(&format!("measured before the run\n{}", columns(2, &rows)));
    }
    if !summary.errors.is_empty() {
        text.push_str(&format!("errors\n{}", columns(2, &errors(summary))));
    }
    if !summary.warnings.is_empty() {
        text.push_str(&format!("warnings\n{}", remarks(&summary.warnings)));
    }
    text.push_str(&file_list::ending(out));
    text
}

fn cost(s: &Summary) -> Vec<Vec<String>> {
    let cells = s.cells.map_or(String::new(), |cells| {
        format!(", {} pores", number::count(cells as f64))
    });
    let size = format!(
        "{} grains, {:.2} contacts each{cells}",
        number::count(s.grains as f64),
        s.coordination
    );
    let meshes = s.meshes.map_or(String::new(), |n| {
        format!(", {} meshes", number::count(n as f64))
    });
    let steps = format!(
        "{} to t = {} s{meshes}",
        number::count(s.steps as f64),
        number::plain(s.simulated_seconds)
    );
    let time = format!(
        "{}, of these {} for the preparation",
        wall_time(s.wall_seconds, s.threads),
        number::duration(s.preparation_seconds)
    );
    let mut rows = vec![
        row("size", size),
        row("steps", steps),
        row("wall time", time),
        row(
            "speed",
            format!("{} grain-steps/s", number::rate(s.grain_steps_per_second)),
        ),
        row("Δt limited by", limited_by(&s.dt_limiters)),
    ];
    if let Some(porosity) = s.porosity {
        rows.push(row("porosity", format!("{porosity:.4}")));
    }
    if let Some(ratio) = s.unbalanced_force {
        rows.push(row("unbalanced force", number::plain(ratio)));
    }
    rows
}

fn errors(summary: &Summary) -> Vec<Vec<String>> {
    let header = ["name", "error", "norm", "found", "against", "rows"].map(String::from);
    let mut rows = vec![header.to_vec()];
    rows.extend(summary.errors.iter().map(|(name, error)| one(name, error)));
    rows
}

fn one(name: &str, error: &Compared) -> Vec<String> {
    let value = match (error.value, error.norm.as_str()) {
        (None, _) => "none".to_string(),
        (Some(value), "absolute") => number::plain(value),
        (Some(value), _) => number::percent(value),
    };
    vec![
        name.to_string(),
        value,
        error.norm.clone(),
        error.found.map_or("–".to_string(), number::plain),
        error.against.clone(),
        error.samples.to_string(),
    ]
}
