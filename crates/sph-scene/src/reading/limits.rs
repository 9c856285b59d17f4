//! Limits of sizes, checked before memory is used.

use sph_core::{MOST_PROBLEMS, SceneProblem};
use toml::{Table, Value};

/// Most corners of a wall.
pub(crate) const WALL_CORNERS: usize = 1_000_000;
/// Most corners of a polygon that is filled.
pub(crate) const BODY_CORNERS: usize = 10_000;
/// Most lines of a drawing: each two of which are compared.
pub(crate) const LINES: usize = 20_000;
/// Most keys of a table, of any depth, and most fields of an output.
pub(crate) const TABLES: usize = 1_000;
/// Most output times, and most rows of a course.
pub(crate) const TIMES: usize = 1_000_000;

/// Lists and tables that are too long.
pub(crate) fn check(scene: &Table) -> Vec<SceneProblem> {
    let mut found = Vec::new();
    wide(scene, "", &mut found);
    if !found.is_empty() {
        return found;
    }
    for (kind, value) in scene {
        let Value::Table(tables) = value else {
            continue;
        };
        for (name, value) in tables {
            let Value::Table(keys) = value else { continue };
            for (key, value) in keys {
                let most = match (kind.as_str(), key.as_str()) {
                    ("wall", "polyline" | "polygon") => WALL_CORNERS,
                    ("body", "polygon") => BODY_CORNERS,
                    (_, "extrusion") => {
                        extrusion(value, &format!("{kind}.{name}.{key}"), &mut found);
                        continue;
                    }
                    ("wall", "motion") => {
                        motion(value, &format!("{kind}.{name}.{key}"), &mut found);
                        continue;
                    }
                    ("body", "subtract") => TABLES,
                    _ => continue,
                };
                let path = format!("{kind}.{name}.{key}");
                longer(value, most, &path, &mut found);
                let cuts = value.as_array().filter(|_| key == "subtract");
                for (k, cut) in cuts.into_iter().flatten().take(TABLES).enumerate() {
                    if let Some(polygon) = cut.get("polygon") {
                        longer(
                            polygon,
                            BODY_CORNERS,
                            &format!("{path}[{k}].polygon"),
                            &mut found,
                        );
                    }
                    if let Some(drawn) = cut.get("extrusion") {
                        extrusion(drawn, &format!("{path}[{k}].extrusion"), &mut found);
                    }
                }
            }
        }
    }
    if let Some(times) = scene.get("output").and_then(|o| o.get("times")) {
        longer(times, TIMES, "output.times", &mut found);
    }
    for key in ["fields", "picture"] {
        if let Some(fields) = scene.get("output").and_then(|o| o.get(key)) {
            longer(fields, TABLES, &format!("output.{key}"), &mut found);
        }
    }
    found
}

/// Tables of any depth with more keys than any table needs; their contents are skipped.
fn wide(table: &Table, path: &str, found: &mut Vec<SceneProblem>) {
    let n = table.len();
    if n > TABLES {
        let what = match table.values().all(Value::is_table) {
            true => "tables",
            false => "keys",
        };
        return found.push(SceneProblem::new(
            path,
            format!("{n} {what} are more than {TABLES}"),
        ));
    }
    for (key, value) in table {
        if found.len() >= MOST_PROBLEMS {
            return;
        }
        if matches!(value, Value::Table(_) | Value::Array(_)) {
            let path = match path {
                "" => key.clone(),
                _ => format!("{path}.{key}"),
            };
            nested(value, &path, found);
        }
    }
}

fn nested(value: &Value, path: &str, found: &mut Vec<SceneProblem>) {
    match value {
        Value::Table(table) => wide(table, path, found),
        Value::Array(items) => {
            let inner = |v: &&Value| matches!(v, Value::Table(_) | Value::Array(_));
            for (k, item) in items.iter().enumerate().filter(|(_, v)| inner(v)) {
                nested(item, &format!("{path}[{k}]"), found);
            }
        }
        _ => {}
    }
}

fn extrusion(value: &Value, path: &str, found: &mut Vec<SceneProblem>) {
    if let Some(polygon) = value.get("polygon") {
        longer(polygon, BODY_CORNERS, &format!("{path}.polygon"), found);
    }
}

fn motion(value: &Value, path: &str, found: &mut Vec<SceneProblem>) {
    for key in ["translate", "rotate"] {
        let Some(given) = value.get(key) else {
            continue;
        };
        let path = format!("{path}.{key}");
        longer(given, TABLES, &path, found);
        let several = given.as_array().into_iter().flatten();
        for one in several.chain([given]) {
            if let Some(rows) = one.get("table") {
                longer(rows, TIMES, &path, found);
            }
        }
    }
}

fn longer(value: &Value, most: usize, path: &str, found: &mut Vec<SceneProblem>) {
    let count = value.as_array().map_or(0, Vec::len);
    if count > most {
        found.push(SceneProblem::new(
            path,
            format!("{count} entries are more than {most}"),
        ));
    }
}
