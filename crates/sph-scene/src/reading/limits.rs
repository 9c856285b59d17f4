//! Limits of sizes, checked before memory is used.

use sph_core::{MOST_PROBLEMS, SceneProblem};
use toml::{Table, Value};

pub(crate) const WALL_CORNERS: usize = 1_000_000;
/// Most corners of a polygon that is filled.
pub(crate) const BODY_CORNERS: usize = 10_000;
/// Most lines of a drawing: each two of which are compared.
pub(crate) const LINES: usize = 20_000;
/// Most keys of a table, of any depth, and most fields of an output.
pub(crate) const TABLES: usize = 1_000;
/// Most output times, and most rows of a course.
pub(crate) const TIMES: usize = 1_000_000;

/// Most entries of lists, by the keys that lead to them; `*` stands for any key.
const LISTS: [(&[&str], usize); 14] = [
    (&["wall", "*", "polyline"], WALL_CORNERS),
    (&["wall", "*", "polygon"], WALL_CORNERS),
    (&["body", "*", "polygon"], BODY_CORNERS),
    (&["*", "*", "extrusion", "polygon"], BODY_CORNERS),
    (&["body", "*", "subtract"], TABLES),
    (&["body", "*", "subtract", "polygon"], BODY_CORNERS),
    (
        &["body", "*", "subtract", "extrusion", "polygon"],
        BODY_CORNERS,
    ),
    (&["wall", "*", "motion", "translate"], TABLES),
    (&["wall", "*", "motion", "translate", "table"], TIMES),
    (&["wall", "*", "motion", "rotate"], TABLES),
    (&["wall", "*", "motion", "rotate", "table"], TIMES),
    (&["output", "times"], TIMES),
    (&["output", "fields"], TABLES),
    (&["output", "picture"], TABLES),
];

pub(crate) fn check(scene: &Table) -> Vec<SceneProblem> {
    let mut found = Vec::new();
    table(scene, "", &[], &mut found);
    found
}

/// Tables of any depth with more keys than any table needs; their contents are skipped.
fn table(all: &Table, path: &str, keys: &[&str], found: &mut Vec<SceneProblem>) {
    let n = all.len();
    if n > TABLES {
        let tables = all.values().all(Value::is_table);
        let what = if tables { "tables" } else { "keys" };
        let message = format!("{n} {what} are more than {TABLES}");
        return found.push(SceneProblem::new(path, message));
    }
    for (key, value) in all {
        if found.len() >= MOST_PROBLEMS {
            return;
        }
        let dot = if path.is_empty() { "" } else { "." };
        let path = format!("{path}{dot}{key}");
        let keys = [keys, &[key]].concat();
        if let Some(items) = value.as_array()
            && let Some((_, most)) = LISTS.iter().find(|(wanted, _)| fits(wanted, &keys))
            && items.len() > *most
        {
            let message = format!("{} entries are more than {most}", items.len());
            found.push(SceneProblem::new(path, message));
            continue;
        }
        nested(value, &path, &keys, found);
    }
}

fn fits(wanted: &[&str], keys: &[&str]) -> bool {
    let mut pairs = wanted.iter().zip(keys);
    wanted.len() == keys.len() && pairs.all(|(wanted, key)| *wanted == "*" || wanted == key)
}

fn nested(value: &Value, path: &str, keys: &[&str], found: &mut Vec<SceneProblem>) {
    match value {
        Value::Table(inner) => table(inner, path, keys, found),
        Value::Array(items) => {
            let inner = |v: &&Value| matches!(v, Value::Table(_) | Value::Array(_));
            for (k, item) in items.iter().enumerate().filter(|(_, v)| inner(v)) {
                nested(item, &format!("{path}[{k}]"), keys, found);
            }
        }
        _ => {}
    }
}
