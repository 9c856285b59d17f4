//! Quantities that no unit of a schema converts: those in the columns of tables, `table = [["0 s", "5 cm"], [1.5, "10 deg"]]`,
//! of which every column has its own, and viscosities that are given as kinematic ones, η = ρν with the density of the
//! phase.

use sph_core::{SceneProblem, kind_of, parameters, parse_quantity};
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

const DYNAMIC: &str = "Pa s";
const KINEMATIC: &str = "m²/s";

/// Turns every text of a law that is in m²/s, where its parameter is in Pa s, into pascal seconds.
///
/// A number without a unit is left in Pa s, as all other texts are left to the constructor of the law.
pub(crate) fn to_dynamic(scene: &mut Table) {
    let laws = kind_of("rheology");
    let laws = laws.map_or(Vec::new(), |kind| (kind.plugins)());
    let phases = scene.get_mut("phase").and_then(Value::as_table_mut);
    for (_, phase) in phases.into_iter().flatten() {
        let density = phase.get("density").and_then(density);
        let chosen = phase.get_mut("rheology").and_then(Value::as_table_mut);
        for (name, keys) in chosen.into_iter().flatten() {
            let Some(law) = laws.iter().find(|law| law.name == name) else {
                continue;
            };
            let dynamic = parameters(&(law.schema)()).into_iter();
            for parameter in dynamic.filter(|p| p.unit == DYNAMIC) {
                if let Some(value) = keys.get_mut(&parameter.name)
                    && let Some(kinematic) = kinematic(value)
                {
                    // Without a density the scene is refused for that.
                    *value = Value::Float(density.unwrap_or(1.0) * kinematic);
                }
            }
        }
    }
}

/// A density as it stands in a scene, kg/m³.
fn density(value: &Value) -> Option<f64> {
    match value {
        Value::Float(density) => Some(*density),
        Value::Integer(density) => Some(*density as f64),
        text => parse_quantity(text.as_str()?, "kg/m³").ok(),
    }
}

/// The value of a text in m²/s.
fn kinematic(value: &Value) -> Option<f64> {
    let text = value.as_str()?;
    match parse_quantity(text, DYNAMIC) {
        Ok(_) => None,
        Err(_) => parse_quantity(text, KINEMATIC).ok(),
    }
}
