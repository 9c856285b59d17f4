//! The commands where the scene is one of grains.

use std::path::Path;

use dem_pfv::scene::{Compared, Examination, Loaded, Summary, examine};
use sph_core::{comma_list, labelled, number};

use crate::commands::file_list;
use crate::commands::outcome::{errors, headline, limited_by, wall_time};
use crate::terminal::{
    CommandOutput, Rows, Trouble, WIDTH, columns, headed, listed, paragraph, paragraphs,
    parameters, quantities, remarks, row, sections, table_and_below,
};

pub fn check(loaded: &Loaded, shown: &str) -> Result<CommandOutput, Trouble> {
    let found = examine(loaded).map_err(|e| Trouble::in_scene(e, &loaded.source))?;
    Ok(CommandOutput::new(&found, check_text(&found, shown)))
}

pub fn explain(loaded: &Loaded) -> Result<CommandOutput, Trouble> {
    let found = examine(loaded).map_err(|e| Trouble::in_scene(e, &loaded.source))?;
    Ok(CommandOutput::new(&found, explain_text(&found)))
}

fn rough_size(bytes: f64) -> String {
    format!("about {}", number::bytes(bytes))
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
        row("walls", listed(&e.walls, "none")),
        row("surfaces of triangles", listed(&e.surfaces, "none")),
        row("fluid", fluid),
        row("memory per grain", rough_size(bytes)),
    ];
    let memory = e.grains.map(|grains| rough_size(bytes * grains as f64));
    size.extend(memory.map(|memory| row("memory", memory)));
    let limits = e.limits.iter().map(|l| vec![l.to_string()]);
    let steps = number::count(e.estimate.steps);
    let time = number::duration(e.estimate.seconds);
    let estimate = vec![
        row("steps", format!("at least {steps}")),
        row("wall time", format!("at least {time} on one core")),
    ];
    let parts = [
        ("size", size),
        ("derived", quantities(&e.derived)),
        ("limits of the time step", limits.collect()),
        ("estimate", estimate),
    ];
    let scene = &e.scene;
    format!("{scene}\n{file} is a good scene of grains\n") + &sections(parts, &e.warnings)
}

fn explain_text(e: &Examination) -> String {
    let scene = &e.scene;
    let mut text = format!("{scene}\n\nplugins, with the parameters that the scene gives\n");
    let rows = e.plugins.iter().map(|p| {
        let names = [&p.kind, &p.of, &p.name].map(String::clone);
        (names.to_vec(), parameters(&p.parameters))
    });
    text.push_str(&table_and_below("kind, of, name", rows));
    text.push_str("\nkept per grain; no column of particles is among it\n");
    let rows = e.memory.iter();
    let rows = rows.map(|(name, bytes)| row(name, rough_size(*bytes)));
    text.push_str(&columns(2, rows));
    text.push_str("\nstages of a step, in order\n");
    for (k, stage) in e.stages.iter().enumerate() {
        let item = paragraph(5, WIDTH, stage);
        text.push_str(&format!("  {}. {}", k + 1, item.trim_start()));
    }
    text.push_str("\nlimits of the time step\n");
    text.push_str(&paragraphs(2, &e.limits));
    text.push_str("\ncolumns of series.csv\n");
    let name = |(name, unit): &(String, String)| labelled(name, unit);
    text + &paragraph(2, WIDTH, &comma_list(e.columns.iter().map(name)))
}

pub fn outcome(summary: &Summary, out: &Path) -> String {
    let derived = summary.derived.iter();
    let derived = derived.map(|(name, value)| row(name, number::plain(*value)));
    let heads = "name, error, norm, found, against, rows";
    headline(summary.status, &summary.scene)
        + &columns(2, cost(summary))
        + &headed("measured before the run", columns(2, derived))
        + &errors(heads, &summary.errors, error)
        + &headed("warnings", remarks(&summary.warnings))
        + &file_list::ending(out)
}

fn cost(s: &Summary) -> Rows {
    let counted = |n: Option<f64>, noun: &str| {
        n.map_or(String::new(), |n| format!(", {} {noun}", number::count(n)))
    };
    let cells = counted(s.cells.map(|n| n as f64), "pores");
    let meshes = counted(s.meshes.map(|n| n as f64), "meshes");
    let (grains, coordination) = (number::count(s.grains as f64), s.coordination);
    let size = format!("{grains} grains, {coordination:.2} contacts each{cells}");
    let steps = number::count(s.steps as f64);
    let end = number::plain(s.simulated_seconds);
    let steps = format!("{steps} to t = {end} s{meshes}");
    let preparation = number::duration(s.preparation_seconds);
    let time = wall_time(s.wall_seconds, s.threads);
    let time = format!("{time}, of these {preparation} for the preparation");
    let speed = format!("{} grain-steps/s", number::rate(s.grain_steps_per_second));
    let mut rows = vec![
        row("size", size),
        row("steps", steps),
        row("wall time", time),
        row("speed", speed),
        row("Δt limited by", limited_by(&s.dt_limiters)),
    ];
    let porosity = s.porosity.map(|porosity| format!("{porosity:.4}"));
    rows.extend(porosity.map(|porosity| row("porosity", porosity)));
    let force = s.unbalanced_force.map(number::plain);
    rows.extend(force.map(|force| row("unbalanced force", force)));
    rows
}

fn error(error: &Compared) -> Vec<String> {
    let value = match (error.value, error.norm.as_str()) {
        (None, _) => "none".to_string(),
        (Some(value), "absolute") => number::plain(value),
        (Some(value), _) => number::percent(value),
    };
    let found = error.found.map_or("–".to_string(), number::plain);
    let (norm, against) = (error.norm.clone(), error.against.clone());
    vec![value, norm, found, against, error.samples.to_string()]
}
