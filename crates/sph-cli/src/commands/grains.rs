//! The commands where the scene is one of grains.

use std::path::Path;

use dem_pfv::scene::{Compared, Examination, Loaded, Summary, examine};

use crate::commands::file_list;
use crate::commands::outcome::{headline, limited_by, wall_time};
use crate::number;
use crate::terminal::layout::{
    columns, paragraph, parameters, remarks, row, sections, table, table_and_below,
};
use crate::terminal::output::CommandOutput;
use crate::terminal::trouble::Trouble;

/// Lists sizes, costs and remarks of a scene, without preparing its grains.
pub fn check(loaded: &Loaded, shown: &str) -> Result<CommandOutput, Trouble> {
    examined(loaded, |found| check_text(found, shown))
}

/// Shows the parts of a scene.
pub fn explain(loaded: &Loaded) -> Result<CommandOutput, Trouble> {
    examined(loaded, explain_text)
}

fn examined(
    loaded: &Loaded,
    text: impl Fn(&Examination) -> String,
) -> Result<CommandOutput, Trouble> {
    let found = examine(loaded).map_err(|e| Trouble::in_scene(e, &loaded.source))?;
    Ok(CommandOutput::new(&found, text(&found)))
}

fn check_text(e: &Examination, file: &str) -> String {
    let count = e
        .grains
        .map_or("those of the file".to_string(), |n| number::count(n as f64));
    let bytes: f64 = e.memory.iter().map(|(_, bytes)| bytes).sum();
    let fluid = match e.coupled {
        true => "in the pores of the box",
        false => "none: dry",
    };
    let mut size = vec![
        row("grains", format!("{count}, {}", e.start)),
        row("walls", listed(&e.walls)),
        row("surfaces of triangles", listed(&e.surfaces)),
        row("fluid", fluid),
        row(
            "memory per grain",
            format!("about {}", number::bytes(bytes)),
        ),
    ];
    if let Some(grains) = e.grains {
        size.push(row(
            "memory",
            format!("about {}", number::bytes(bytes * grains as f64)),
        ));
    }
    let derived = e
        .derived
        .iter()
        .map(|(name, value, unit)| row(name, format!("{} {unit}", number::plain(*value))));
    let derived: Vec<_> = derived.collect();
    let limits: Vec<_> = e.limits.iter().map(|l| vec![l.to_string()]).collect();
    let cost = &e.estimate;
    let estimate = vec![
        row("steps", format!("at least {}", number::count(cost.steps))),
        row(
            "wall time",
            format!("at least {} on one core", number::duration(cost.seconds)),
        ),
    ];
    let mut text = format!("{}\n{file} is a good scene of grains\n", e.scene);
    let parts = [
        ("size", size),
        ("derived", derived),
        ("limits of the time step", limits),
        ("estimate", estimate),
    ];
    text.push_str(&sections(parts, &e.warnings));
    text
}

fn listed(names: &[String]) -> String {
    match names.is_empty() {
        true => "none".to_string(),
        false => names.join(", "),
    }
}

fn explain_text(e: &Examination) -> String {
    let mut text = format!(
        "{}\n\nplugins, with the parameters that the scene gives\n",
        e.scene
    );
    let rows = e.plugins.iter().map(|p| {
        let names = vec![p.kind.clone(), p.of.clone(), p.name.clone()];
        (names, parameters(&p.parameters))
    });
    let rows = rows.collect();
    text.push_str(&table_and_below(&["kind", "of", "name"], rows));
    text.push_str("\nkept per grain; no column of particles is among it\n");
    let rows = e.memory.iter();
    let rows = rows.map(|(name, bytes)| row(name, format!("about {}", number::bytes(*bytes))));
    text.push_str(&columns(2, &rows.collect::<Vec<_>>()));
    text.push_str("\nstages of a step, in order\n");
    for (k, stage) in e.stages.iter().enumerate() {
        let item = paragraph(5, 98, stage);
        text.push_str(&format!("  {}. {}", k + 1, item.trim_start()));
    }
    text.push_str("\nlimits of the time step\n");
    for limit in &e.limits {
        text.push_str(&paragraph(2, 98, limit));
    }
    text.push_str("\ncolumns of series.csv\n");
    let name = |(name, unit): &(String, String)| match unit.as_str() {
        "" => name.clone(),
        unit => format!("{name} [{unit}]"),
    };
    let names: Vec<String> = e.columns.iter().map(name).collect();
    text.push_str(&paragraph(2, 98, &names.join(", ")));
    text
}

/// The run, its cost, its quality, and the places of its files.
pub fn outcome(summary: &Summary, out: &Path) -> String {
    let mut text = headline(summary.status, &summary.scene);
    text.push_str(&columns(2, &cost(summary)));
    if !summary.derived.is_empty() {
        let rows = summary.derived.iter();
        let rows: Vec<_> = rows
            .map(|(name, value)| row(name, number::plain(*value)))
            .collect();
        text.push_str(&format!("measured before the run\n{}", columns(2, &rows)));
    }
    if !summary.errors.is_empty() {
        let heads = ["name", "error", "norm", "found", "against", "rows"];
        let rows = summary.errors.iter().map(|(name, error)| one(name, error));
        text.push_str(&format!("errors\n{}", table(&heads, rows)));
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
