//! The tables that references name: read, and checked against the comparable results.

use std::path::Path;

use sph_io::{IoError, Table, read_columns, read_table};
use sph_scene::{Norm, Reference, Scene};
use sph_solver::SolverError;

/// Longest file of a reference or a probe, bytes.
pub const LONGEST: u64 = 64 << 20;

/// Refuses references whose file cannot be read, before the run starts.
pub fn readable(scene: &Scene) -> Result<(), SolverError> {
    for (name, reference) in &scene.reference {
        if let Some(path) = &reference.path {
            let read = reference_series(reference, path);
            read.map_err(|e| SolverError::at(format!("reference.{name}.file"), e.to_string()))?;
        }
    }
    Ok(())
}

/// Times, values, and the upper limits of a band: finite numbers, in the order of time, scaled as the reference says.
pub fn reference_series(reference: &Reference, path: &Path) -> Result<[Vec<f64>; 3], IoError> {
    sph_io::readable(path, LONGEST)?;
    let band = reference.norm() == Norm::Band;
    let table = match (&reference.lower, &reference.upper) {
        (Some(low), Some(high)) if band => {
            let time = match &reference.columns {
                Some(columns) => columns[0].clone(),
                None => read_table(path)?.columns[0].name.clone(),
            };
            read_columns(path, &[&time, low, high])?
        }
        _ => named_or_all(path, reference.columns.as_deref())?,
    };
    if let Some(problem) = unfit(&table, band) {
        return Err(IoError::Unfit(path.into(), problem));
    }
    let scaled = |k: usize, scale: f64, offset: f64| -> Vec<f64> {
        let column = table.columns.get(k).map_or(&[][..], |c| &c.values);
        column.iter().map(|v| v * scale + offset).collect()
    };
    let times = scaled(0, reference.scale_time, reference.offset_time);
    let value = |k: usize| scaled(k, reference.scale_value, reference.offset_value);
    let high = if band { value(2) } else { Vec::new() };
    Ok([times, value(1), high])
}

/// Errors of a table that cannot be compared with.
fn unfit(table: &Table, band: bool) -> Option<String> {
    let used = if band { 3 } else { 2 };
    let columns = &table.columns[..used.min(table.columns.len())];
    let [times, _, ..] = columns else {
        return Some("it has one column where a time and a value are expected".into());
    };
    if table.rows() == 0 {
        return Some("it has no rows".into());
    }
    for column in columns {
        if let Some(row) = column.values.iter().position(|v| !v.is_finite()) {
            let (name, value) = (&column.name, column.values[row]);
            let row = row + 1;
            return Some(format!(
                "expected finite numbers, found {value} in row {row} of `{name}`"
            ));
        }
    }
    let times = &times.values;
    if let Some(row) = times.windows(2).position(|t| t[1] < t[0]) {
        let [before, after] = [times[row], times[row + 1]];
        let row = row + 2;
        return Some(format!(
            "times must not fall: {after} comes after {before} in row {row}"
        ));
    }
    let still = table.rows() > 1 && times[0] == times[times.len() - 1];
    still.then(|| "all its times are the same".to_string())
}

/// The columns of these names, or all of a table.
pub fn named_or_all(path: &Path, names: Option<&[String]>) -> Result<Table, IoError> {
    match names {
        Some(names) => {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            read_columns(path, &names)
        }
        None => read_table(path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_that_nothing_can_be_compared_with_are_told_from_others() {
        let unfit = |text: &str, band: bool| {
            let table = Table::parse(text, "r.csv").unwrap();
            super::unfit(&table, band).unwrap_or_default()
        };
        for (text, told) in [
            ("t\n0\n1\n", "one column"),
            ("t,u\n", "no rows"),
            ("t,u\n0,1\n1,nan\n", "found NaN in row 2 of `u`"),
            ("t,u\n0,1\ninf,1\n", "found inf in row 2 of `t`"),
            ("t,u\n0,1\n2,1\n1,1\n", "1 comes after 2 in row 3"),
            ("t,u\n1,1\n1,2\n", "the same"),
        ] {
            let found = unfit(text, false);
            assert!(found.contains(told), "{text:?}: {found}");
        }
        assert!(unfit("t,a,b\n0,1,2\n1,1,inf\n", true).contains("`b`"));
        for good in ["t,u,v\n0,1,nan\n1,1,1\n", "t,u\n0,1\n0,2\n1,1\n", "0,1\n"] {
            assert_eq!(unfit(good, false), "");
        }
    }
}
