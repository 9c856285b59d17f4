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
        if let Some(motion) = wall.get_mut("motion") {
            courses(motion, &format!("wall.{name}.motion"), &mut found);
        }
    }
    let Some(numerics) = scene.get_mut("numerics") else {
        return found;
    };
    if let Some(frame) = numerics.get_mut("frame") {
        courses(frame, "numerics.frame", &mut found);
    }
    if let Some(course_of) = numerics.get_mut("gravity_over_time") {
        course(course_of, "m/s²", "numerics.gravity_over_time", &mut found);
    }
    found
}

fn courses(motion: &mut Value, place: &str, found: &mut Vec<SceneProblem>) {
    match motion.get_mut("translate") {
        Some(Value::Array(several)) => {
            let single = several.len() == 1;
            for (k, one) in several.iter_mut().enumerate() {
                let number = match single {
                    true => String::new(),
                    false => format!("[{k}]"),
                };
                course(one, "m", &format!("{place}.translate{number}"), found);
            }
        }
        Some(one) => course(one, "m", &format!("{place}.translate"), found),
        None => {}
    }
    if let Some(rotate) = motion.get_mut("rotate") {
        course(rotate, "rad", &format!("{place}.rotate"), found);
    }
}

fn course(table: &mut Value, unit: &str, place: &str, found: &mut Vec<SceneProblem>) {
    let rows = table.get_mut("table").and_then(Value::as_array_mut);
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
