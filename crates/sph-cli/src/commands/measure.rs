//! `sph measure`: a field of the frames of a run, over particles that fulfil conditions, reduced to numbers.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::{Value as Json, json};
use sph_core::parse_quantity;
use sph_io::curves::{Column, Snapshot};
use sph_io::write_whole;
use sph_probes::{Reduce, Reduction, Weight, WeightedValues};

use crate::commands::draw::{frames, trouble};
use crate::terminal::output::CommandOutput;
use crate::terminal::trouble::Trouble;
use crate::tool_arguments::MeasureArguments;

/// A bound on a quantity, as it was given: the quantity, the value, whether it is a lower one.
struct QuantityBound<'a> {
    of: &'a str,
    value: &'a str,
    least: bool,
}

/// The particles of a frame that count, with their weights.
struct CountedParticles {
    values: Vec<f64>,
    weights: Option<Vec<f64>>,
    /// The weight of all particles of the phase.
    whole: f64,
}

/// Prints a table of all frames, or writes it to a file.
pub fn command(arguments: &MeasureArguments) -> Result<(), Trouble> {
    let bounds = bounds(arguments)?;
    let phase = arguments.phase.as_deref();
    let phase = phase
        .map(|name| phase_number(&arguments.results, name))
        .transpose()?;
    let frames = frames(&arguments.results)?;
    let mut unit = String::new();
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for entry in &frames.entries {
        let frame = frames.read(entry).map_err(trouble)?;
        let column = quantity(&frame, &arguments.field)?;
        let counted = counted(&frame, &column, arguments.weight, phase, &bounds)?;
        rows.push(row(entry.time, &counted, arguments));
        unit = column.unit;
    }
    let names = names(arguments, &unit);
    let told = CommandOutput {
        text: csv(&names, &rows),
        json: json!({ "columns": names, "rows": rows }),
    };
    match &arguments.out {
        None => told.print(arguments.json),
        Some(file) => {
            write_whole(file, &told.text)?;
            let count = rows.len();
            let file = file.display();
            CommandOutput {
                text: format!("{count} frames in {file}\n"),
                json: told.json,
            }
            .print(arguments.json);
        }
    }
    Ok(())
}

/// A row of the table: the time and all reductions.
fn row(time: f64, counted: &CountedParticles, arguments: &MeasureArguments) -> Vec<f64> {
    let weighed = WeightedValues {
        values: &counted.values,
        weights: counted.weights.as_deref(),
        whole: counted.whole,
    };
    let reductions = arguments.reduce.iter().map(|how| Reduce::By(*how));
    let quantiles = arguments.quantile.iter();
    let all = reductions.chain(quantiles.map(|share| Reduce::Quantile(*share)));
    let numbers = all.map(|how| weighed.reduced(how));
    std::iter::once(time).chain(numbers).collect()
}

/// The names of the columns, with their units.
fn names(arguments: &MeasureArguments, unit: &str) -> Vec<String> {
    let named = |how: String| match unit {
        "" | "1" => how,
        unit => format!("{how} [{unit}]"),
    };
    let reductions = arguments.reduce.iter().map(|how| match how {
        Reduction::Share => how.name().to_string(),
        Reduction::Total => format!("{} [{}]", how.name(), arguments.weight.unit()),
        _ => named(how.name().into()),
    });
    let quantiles = arguments
        .quantile
        .iter()
        .map(|share| named(format!("q{share}")));
    std::iter::once("time [s]".to_string())
        .chain(reductions)
        .chain(quantiles)
        .collect()
}

fn csv(names: &[String], rows: &[Vec<f64>]) -> String {
    let mut text = names.join(",");
    text.push('\n');
    for row in rows {
        let row: Vec<String> = row.iter().map(|value| value.to_string()).collect();
        // A text takes everything.
        let _ = writeln!(text, "{}", row.join(","));
    }
    text
}

fn bounds(arguments: &MeasureArguments) -> Result<Vec<QuantityBound<'_>>, Trouble> {
    let of = |text: &'_ String, least| -> Result<(usize, bool), Trouble> {
        let found = text.find('=').filter(|at| *at > 0);
        let option = if least { "above" } else { "below" };
        let expected =
            || Trouble::usage(format!("--{option} {text}: expected FIELD=VALUE, as x=0.2"));
        Ok((found.ok_or_else(expected)?, least))
    };
    let above = arguments.above.iter().map(|text| (text, true));
    let below = arguments.below.iter().map(|text| (text, false));
    let each = above.chain(below).map(|(text, least)| {
        let (at, least) = of(text, least)?;
        Ok(QuantityBound {
            of: &text[..at],
            value: &text[at + 1..],
            least,
        })
    });
    each.collect()
}

/// The values of a quantity: a field of the frame, a component of it, or a coordinate.
fn quantity(frame: &Snapshot, name: &str) -> Result<Column, Trouble> {
    let axis = ["x", "y", "z"].iter().position(|axis| *axis == name);
    match axis {
        None => frame.column(name).map_err(trouble),
        Some(axis) => Ok(Column {
            label: format!("{name} [m]"),
            unit: "m".into(),
            values: frame.points().iter().map(|x| x[axis]).collect(),
        }),
    }
}

fn counted(
    frame: &Snapshot,
    column: &Column,
    weight: Weight,
    phase: Option<usize>,
    bounds: &[QuantityBound<'_>],
) -> Result<CountedParticles, Trouble> {
    let all = 0..column.values.len();
    let of_phase: Vec<usize> = match phase {
        None => all.collect(),
        // A scene of one phase has no column of phases.
        Some(number) => match frame.column("phase") {
            Ok(phases) => all.filter(|k| phases.values[*k] == number as f64).collect(),
            Err(_) if number == 0 => all.collect(),
            Err(error) => return Err(trouble(error)),
        },
    };
    let mut own = of_phase.clone();
    for bound in bounds {
        let of = quantity(frame, bound.of)?;
        let option = if bound.least { "above" } else { "below" };
        let value = parse_quantity(bound.value, &of.unit);
        let value =
            value.map_err(|why| Trouble::usage(format!("--{option} {}: {why}", bound.of)))?;
        own.retain(|k| match bound.least {
            true => of.values[*k] > value,
            false => of.values[*k] < value,
        });
    }
    let weights = match weight {
        Weight::One => None,
        Weight::Mass => Some(quantity(frame, "mass")?.values),
        Weight::Volume => Some(quantity(frame, "volume")?.values),
    };
    let of = |numbers: &[usize]| -> Option<Vec<f64>> {
        let weights = weights.as_ref()?;
        Some(numbers.iter().map(|k| weights[*k]).collect())
    };
    let whole = of(&of_phase).map_or(of_phase.len() as f64, |all| all.iter().sum());
    Ok(CountedParticles {
        values: own.iter().map(|k| column.values[*k]).collect(),
        weights: of(&own),
        whole,
    })
}

/// The number of a phase: its place among the laws in the summary of the run.
fn phase_number(results: &Path, name: &str) -> Result<usize, Trouble> {
    let path = results.join("summary.json");
    let read = std::fs::read_to_string(&path).ok();
    let summary: Option<Json> = read.and_then(|text| serde_json::from_str(&text).ok());
    let Some(summary) = summary else {
        let path = path.display();
        return Err(Trouble::usage(format!(
            "--phase {name}: the names of the phases are in {path}, which a run writes at its end"
        )));
    };
    let plugins = summary["plugins"].as_array().into_iter().flatten();
    let laws = plugins.filter(|plugin| plugin["kind"] == "rheology");
    let paths = laws.filter_map(|law| law["path"].as_str());
    let phases: Vec<&str> = paths.filter_map(|path| path.split('.').nth(1)).collect();
    phases
        .iter()
        .position(|phase| *phase == name)
        .ok_or_else(|| {
            let near = sph_core::suggestion(name, phases.iter().copied());
            Trouble::usage(format!("--phase: there is no phase called `{name}`{near}"))
        })
}
