//! Former names of keys and columns, which scenes may still give.

use sph_core::SceneProblem;
use toml::{Table, Value};

/// Table, former key, key.
const KEYS: [[&str; 3]; 1] = [["numerics", "disorder", "jitter"]];

/// Former name of a column, name.
const COLUMNS: [[&str; 2]; 6] = [
    ["elastic_turn", "stress_rotation"],
    ["emptiness", "void_fraction"],
    ["filling", "kernel_sum"],
    ["held_share", "yield_factor"],
    ["scattered", "dispersed_fraction"],
    ["solid_share", "solid_fraction"],
];

/// Replaces former names of keys, and of columns in outputs and probes; a remark for each, at its place, or the key that
/// is given by both names.
pub(crate) fn replace(scene: &mut Table) -> Result<Vec<SceneProblem>, SceneProblem> {
    let mut remarks = Vec::new();
    for [table, former, key] in KEYS {
        let keys = scene.get_mut(table).and_then(Value::as_table_mut);
        let Some((keys, value)) = keys.and_then(|keys| keys.remove(former).map(|v| (keys, v)))
        else {
            continue;
        };
        let place = format!("{table}.{former}");
        if keys.contains_key(key) {
            let why = format!(
                "is the former name of `{key}`, which is given as well: take one of them out"
            );
            return Err(SceneProblem::new(place, why));
        }
        keys.insert(key.into(), value);
        let why = format!("is called `{key}`: rename the key");
        remarks.push(SceneProblem::new(place, why));
    }
    if let Some(output) = scene.get_mut("output").and_then(Value::as_table_mut) {
        let keys = ["fields", "picture", "picture_range"];
        columns(output, keys, "output", &mut remarks);
    }
    let probes = scene.get_mut("probe").and_then(Value::as_table_mut);
    for (name, probe) in probes.into_iter().flatten() {
        if let Some(probe) = probe.as_table_mut() {
            let (keys, place) = (["field", "above", "below"], format!("probe.{name}"));
            columns(probe, keys, &place, &mut remarks);
        }
    }
    Ok(remarks)
}

/// Replaces the columns that some keys of a table name: in a text, in a list of texts, or as keys of a table.
fn columns(table: &mut Table, keys: [&str; 3], place: &str, remarks: &mut Vec<SceneProblem>) {
    for key in keys {
        let place = format!("{place}.{key}");
        let mut name = |text: &mut String, place: &str| {
            let (column, component) = text.split_at(text.find('.').unwrap_or(text.len()));
            if let Some([former, name]) = COLUMNS.iter().find(|[former, _]| *former == column) {
                let remark = format!("the column `{former}` is called `{name}`: rename it");
                remarks.push(SceneProblem::new(place, remark));
                *text = format!("{name}{component}");
            }
        };
        match table.get_mut(key) {
            Some(Value::String(text)) => name(text, &place),
            Some(Value::Array(items)) => {
                for (k, item) in items.iter_mut().enumerate() {
                    if let Value::String(text) = item {
                        name(text, &format!("{place}[{k}]"));
                    }
                }
            }
            Some(Value::Table(bounds)) => {
                let given = std::mem::take(bounds).into_iter();
                let renamed = given.map(|(mut column, bound)| {
                    let place = format!("{place}.{column}");
                    name(&mut column, &place);
                    (column, bound)
                });
                *bounds = renamed.collect();
            }
            _ => {}
        }
    }
}
