//! `sph check` of a scene of grains.

use dem_pfv::scene::{Examination, Loaded, examine};
use serde_json::Value as Json;

use crate::number;
use crate::terminal::layout::{columns, remarks};
use crate::terminal::output::CommandOutput;
use crate::terminal::trouble::Trouble;

/// Lists sizes, costs and remarks of a scene, without preparing its grains.
pub fn output(loaded: &Loaded, shown: &str) -> Result<CommandOutput, Trouble> {
    let examined = examine(loaded).map_err(|e| Trouble::in_scene(e, &loaded.source))?;
    Ok(CommandOutput {
        json: serde_json::to_value(&examined).unwrap_or(Json::Null),
        text: text(&examined, shown),
    })
}

fn text(e: &Examination, file: &str) -> String {
    let row = |name: &str, value: String| vec![name.to_string(), value];
    let count = e
        .grains
        .map_or("those of the file".to_string(), |n| number::count(n as f64));
    let bytes: f64 = e.memory.iter().map(|(_, bytes)| bytes).sum();
    let mut size = vec![
        row("grains", format!("{count}, {}", e.start)),
        row("walls", listed(&e.walls)),
        row("surfaces of triangles", listed(&e.surfaces)),
        row(
            "fluid",
            if e.coupled {
                "in the pores of the box"
            } else {
                "none: dry"
            }
            .to_string(),
        ),
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
    for (title, rows) in [
        ("size", size),
        ("derived", derived),
        ("limits of the time step", limits),
        ("estimate", estimate),
    ] {
        if !rows.is_empty() {
            text.push_str(&format!("\n{title}\n{}", columns(2, &rows)));
        }
    }
    if !e.warnings.is_empty() {
        text.push_str(&format!("\nwarnings\n{}", remarks(&e.warnings)));
    }
    text
}

fn listed(names: &[String]) -> String {
    match names.is_empty() {
        true => "none".to_string(),
        false => names.join(", "),
    }
}
