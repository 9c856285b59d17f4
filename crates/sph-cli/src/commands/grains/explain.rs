//! `sph explain` of a scene of grains.

use dem_pfv::scene::{Examination, Loaded, examine};
use serde_json::Value as Json;

use crate::number;
use crate::terminal::layout::{columns, columns_and_below, paragraph, parameters};
use crate::terminal::output::CommandOutput;
use crate::terminal::trouble::Trouble;

/// Shows the parts of a scene.
pub fn output(loaded: &Loaded) -> Result<CommandOutput, Trouble> {
    let examined = examine(loaded).map_err(|e| Trouble::in_scene(e, &loaded.source))?;
    Ok(CommandOutput {
        json: serde_json::to_value(&examined).unwrap_or(Json::Null),
        text: text(&examined),
    })
}

fn text(e: &Examination) -> String {
    let mut text = format!(
        "{}\n\nplugins, with the parameters that the scene gives\n",
        e.scene
    );
    let rows = e.plugins.iter().map(|p| {
        let names = vec![p.kind.clone(), p.of.clone(), p.name.clone()];
        (names, parameters(&p.parameters))
    });
    let rows = rows.collect();
    text.push_str(&columns_and_below(2, &["kind", "of", "name"], rows));
    text.push_str("\nkept per grain; no column of particles is among it\n");
    let rows: Vec<_> = e
        .memory
        .iter()
        .map(|(name, bytes)| vec![name.to_string(), format!("about {}", number::bytes(*bytes))])
        .collect();
    text.push_str(&columns(2, &rows));
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
    let names: Vec<String> = e
        .columns
        .iter()
        .map(|(name, unit)| {
            if unit.is_empty() {
                name.clone()
            } else {
                format!("{name} [{unit}]")
            }
        })
        .collect();
    text.push_str(&paragraph(2, 98, &names.join(", ")));
    text
}
