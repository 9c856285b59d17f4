//! Reading the pressures that another computation has left on a wall.

use scene_text::{Source, suggestion, unit_factor};
use sph_io::{Table, read_table};

use crate::coupled::Recorded;
use crate::scene::error::DemError;
use crate::scene::tables::RecordedLoad;

/// The load of a wall, from its file.
///
/// # Errors
/// A file that is not there, holds no such columns, or does not reach as far as the run starts.
pub fn read(source: &Source, wall: &str, load: &RecordedLoad) -> Result<Recorded, DemError> {
    let key = |name: &str| format!("wall.{wall}.recorded.{name}");
    if load.columns.len() != load.places.len() {
        let counts = [load.columns.len(), load.places.len()];
        let message = format!("{} columns for {} places", counts[0], counts[1]);
        return Err(DemError::at(key("columns"), message));
    }
    let path = source.resolve(&key("file"), &load.file);
    let path = path.map_err(|e| DemError::at(key("file"), e))?;
    let table = read_table(&path).map_err(|e| DemError::at(key("file"), e))?;
    let times = column(&table, "time", "s").map_err(|e| DemError::at(key("file"), e))?;
    let columns = load.columns.iter().map(|name| column(&table, name, "Pa"));
    let columns: Result<Vec<_>, _> = columns.collect();
    let columns = columns.map_err(|e| DemError::at(key("columns"), e))?;
    let rows = 0..times.len();
    let pressures = rows.flat_map(|row| columns.iter().map(move |c| c[row] - load.less));
    let recorded = Recorded {
        axis: load.axis,
        places: load.places.clone(),
        times: times.iter().map(|t| t - load.start).collect(),
        pressures: pressures.collect(),
    };
    if let Some(problem) = recorded.problem() {
        return Err(DemError::at(format!("wall.{wall}.recorded"), problem));
    }
    match recorded.times.last() {
        Some(last) if *last > 0.0 => Ok(recorded),
        _ => {
            let message = format!("the table has no row after {} s", load.start);
            Err(DemError::at(key("start"), message))
        }
    }
}

/// A column in SI; its head may have a unit.
fn column(table: &Table, name: &str, alike: &str) -> Result<Vec<f64>, String> {
    let names = table.columns.iter().map(|c| c.name.as_str());
    let near = || suggestion(name, names);
    let values = table
        .column(name)
        .ok_or_else(|| format!("the table has no column `{name}`{}", near()))?;
    let head = table.columns.iter().find(|c| c.name == name);
    let unit = head.map_or("", |c| c.unit.as_str());
    let factor = match unit {
        "" => 1.0,
        unit => unit_factor(unit, alike)?,
    };
    Ok(values.iter().map(|x| factor * x).collect())
}
