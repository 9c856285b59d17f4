//! Quantities in the columns of tables: `table = [["0 s", "5 cm"], [1.5, "10 deg"]]`.
//!
//! A schema gives a list one unit; here every column has its own, so that this comes first.

use sph_core::{SceneProblem, parse_quantity};
use toml::{Table, Value};

/// Turns strings in the tables of motions and of gravity into SI numbers.
pub(crate) fn convert(scene: &mut Table) -> Vec<SceneProblem> {
    let mut found = Vec::new();
    let walls = scene.get_mut("wall").and_then(Value::as_table_mut);
    for (name, wall) in walls.into_iter().flatten() {
        let place = format!("wall.{name}.motion");
        courses(wall.get_mut("motion"), &place, &mut found);
    }
    if let Some(numerics) = scene.get_mut("numerics") {
        courses(numerics.get_mut("frame"), "numerics.frame", &mut found);
        let gravity = numerics.get_mut("gravity_over_time");
        course(gravity, "m/s²", "numerics.gravity_over_time", &mut found);
    }
    found
}

fn courses(motion: Option<&mut Value>, place: &str, found: &mut Vec<SceneProblem>) {
    let Some(motion) = motion else { return };
    let turning = format!("{place}.rotate");
    course(motion.get_mut("rotate"), "rad", &turning, found);
    let place = format!("{place}.translate");
    match motion.get_mut("translate") {
        Some(Value::Array(all)) if all.len() != 1 => {
            for (k, one) in all.iter_mut().enumerate() {
                course(Some(one), "m", &format!("{place}[{k}]"), found);
            }
        }
        Some(Value::Array(single)) => course(single.first_mut(), "m", &place, found),
        one => course(one, "m", &place, found),
    }
}

fn course(table: Option<&mut Value>, unit: &str, place: &str, found: &mut Vec<SceneProblem>) {
    let rows = table.and_then(|table| table.get_mut("table")?.as_array_mut());
    for (k, row) in rows.into_iter().flatten().enumerate() {
        let units = std::iter::once("s").chain(std::iter::repeat(unit));
        let cells = row.as_array_mut().into_iter().flatten().zip(units);
        for (n, (cell, unit)) in cells.enumerate() {
            let Value::String(text) = &*cell else {
                continue;
            };
            match parse_quantity(text, unit) {
                Ok(x) => *cell = Value::Float(x),
                Err(why) => {
                    let path = format!("{place}.table[{k}][{n}]");
                    found.push(SceneProblem::new(path, why));
                    // The schema would complain once more.
                    *cell = Value::Float(0.0);
                }
            }
        }
    }
}
