//! `sph measure`: a field of the frames of a run, over particles that fulfil conditions, reduced to numbers.

use std::path::Path;

use serde_json::json;
use sph_core::{labelled, parse_quantity, suggestion};
use sph_io::curves::{Column, Snapshot};
use sph_io::write_whole;
use sph_probes::{Reduce, Reduction, Weight, WeightedValues};
use sph_run::SUMMARY;

use crate::commands::draw::frames;
use crate::commands::file_list::read_summary;
use crate::terminal::{CommandOutput, Trouble};
use crate::tool_arguments::MeasureArguments;

/// A bound on a quantity, as it was given: the option, the quantity, the value.
type QuantityBound<'a> = (&'static str, &'a str, &'a str);

pub fn command(arguments: &MeasureArguments) -> Result<(), Trouble> {
    let bounds = bounds(arguments)?;
    let phase = arguments.phase.as_deref();
    let phase = phase.map(|name| phase_number(&arguments.results, name));
    let phase = phase.transpose()?;
    let frames = frames(&arguments.results)?;
    let mut unit = String::new();
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for entry in &frames.entries {
        let frame = frames.read(entry)?;
        let column = quantity(&frame, &arguments.field)?;
        let mut row = reduced(&frame, &column, arguments, phase, &bounds)?;
        row.insert(0, entry.time);
        rows.push(row);
        unit = column.unit;
    }
    let names = names(arguments, &unit);
    let mut text = csv(&names, &rows);
    if let Some(file) = &arguments.out {
        write_whole(file, &text)?;
        text = format!("{} frames in {}\n", rows.len(), file.display());
    }
    let json = json!({ "columns": names, "rows": rows });
    CommandOutput { json, text }.print(arguments.json);
    Ok(())
}

fn names(arguments: &MeasureArguments, unit: &str) -> Vec<String> {
    let reductions = arguments.reduce.iter().map(|how| match how {
        Reduction::Share => how.name().to_string(),
        Reduction::Total => format!("{} [{}]", how.name(), arguments.weight.unit()),
        _ => labelled(how.name(), unit),
    });
    let quantiles = arguments.quantile.iter();
    let quantiles = quantiles.map(|share| labelled(&format!("q{share}"), unit));
    let time = std::iter::once("time [s]".to_string());
    time.chain(reductions).chain(quantiles).collect()
}

fn csv(names: &[String], rows: &[Vec<f64>]) -> String {
    let cells = |row: &Vec<f64>| row.iter().map(f64::to_string).collect();
    let lines = std::iter::once(names.to_vec()).chain(rows.iter().map(cells));
    let lines = lines.map(|cells: Vec<String>| cells.join(",") + "\n");
    lines.collect()
}

fn bounds(arguments: &MeasureArguments) -> Result<Vec<QuantityBound<'_>>, Trouble> {
    let above = arguments.above.iter().map(|text| ("above", text));
    let below = arguments.below.iter().map(|text| ("below", text));
    let each = above.chain(below).map(|(option, text)| {
        let found = text.split_once('=').filter(|(of, _)| !of.is_empty());
        let expected = || format!("--{option} {text}: expected FIELD=VALUE, as x=0.2");
        let (of, value) = found.ok_or_else(expected)?;
        Ok((option, of, value))
    });
    each.collect()
}

/// The values of a quantity: a field of the frame, a component of it, or a coordinate.
fn quantity(frame: &Snapshot, name: &str) -> Result<Column, Trouble> {
    let axis = ["x", "y", "z"].iter().position(|axis| *axis == name);
    match axis {
        None => Ok(frame.column(name)?),
        Some(axis) => Ok(Column {
            label: format!("{name} [m]"),
            unit: "m".into(),
            values: frame.points().iter().map(|x| x[axis]).collect(),
        }),
    }
}

fn reduced(
    frame: &Snapshot,
    column: &Column,
    arguments: &MeasureArguments,
    phase: Option<usize>,
    bounds: &[QuantityBound<'_>],
) -> Result<Vec<f64>, Trouble> {
    let all = 0..column.values.len();
    let of_phase: Vec<usize> = match phase {
        None => all.collect(),
        // A scene of one phase has no column of phases.
        Some(number) => match frame.column("phase") {
            Ok(phases) => all.filter(|k| phases.values[*k] == number as f64).collect(),
            Err(_) if number == 0 => all.collect(),
            Err(error) => return Err(error.into()),
        },
    };
    let mut own = of_phase.clone();
    for (option, name, value) in bounds {
        let of = quantity(frame, name)?;
        let value = parse_quantity(value, &of.unit);
        let value = value.map_err(|why| format!("--{option} {name}: {why}"))?;
        own.retain(|k| match *option {
            "above" => of.values[*k] > value,
            _ => of.values[*k] < value,
        });
    }
    let weights = match arguments.weight {
        Weight::One => None,
        weight => Some(quantity(frame, weight.name())?.values),
    };
    let of = |numbers: &[usize]| -> Option<Vec<f64>> {
        let weights = weights.as_ref()?;
        Some(numbers.iter().map(|k| weights[*k]).collect())
    };
    let values: Vec<f64> = own.iter().map(|k| column.values[*k]).collect();
    let own_weights = of(&own);
    let weighed = WeightedValues {
        values: &values,
        weights: own_weights.as_deref(),
        whole: of(&of_phase).map_or(of_phase.len() as f64, |all| all.iter().sum()),
    };
    let reductions = arguments.reduce.iter().map(|how| Reduce::By(*how));
    let quantiles = arguments.quantile.iter();
    let all = reductions.chain(quantiles.map(|share| Reduce::Quantile(*share)));
    Ok(all.map(|how| weighed.reduced(how)).collect())
}

/// The number of a phase: its place among the laws in the summary of the run.
fn phase_number(results: &Path, name: &str) -> Result<usize, Trouble> {
    let missing = || {
        let path = results.join(SUMMARY);
        let path = path.display();
        format!(
            "--phase {name}: the names of the phases are in {path}, which a run writes at its end"
        )
    };
    let summary = read_summary(results).ok_or_else(missing)?;
    let plugins = summary["plugins"].as_array().into_iter().flatten();
    let laws = plugins.filter(|plugin| plugin["kind"] == "rheology");
    let paths = laws.filter_map(|law| law["path"].as_str());
    let phases: Vec<&str> = paths.filter_map(|path| path.split('.').nth(1)).collect();
    let unknown = || {
        let near = suggestion(name, phases.iter().copied());
        format!("--phase: there is no phase called `{name}`{near}")
    };
    let number = phases.iter().position(|phase| *phase == name);
    Ok(number.ok_or_else(unknown)?)
}
