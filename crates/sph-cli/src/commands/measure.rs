//! `sph measure`: a field of the frames of a run, over particles that fulfil conditions, reduced to numbers.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;

use serde_json::json;
use sph_core::{Vect, parse_quantity, some_unit, suggestion};
use sph_io::curves::Snapshot;
use sph_io::write_whole;
use sph_probes::{MeasuredParticles, MeasuringProbe, Quantity, Reduction, Statistic, Values};
use sph_run::SUMMARY;

use crate::commands::draw::{frames, quantity, vector};
use crate::commands::file_list::read_summary;
use crate::terminal::{CommandOutput, Trouble};
use crate::tool_arguments::MeasureArguments;

/// A table of numbers.
#[derive(Clone, Debug, Default)]
pub struct MeasuredTable {
    /// Names and units of the columns; pure numbers have an empty unit.
    pub columns: Vec<(String, String)>,
    /// The rows, each with a number for every column.
    pub rows: Vec<Vec<f64>>,
}

pub fn command(arguments: &MeasureArguments) -> Result<(), Trouble> {
    let table = table(arguments)?;
    let named = |(name, unit): &(String, String)| match unit.as_str() {
        "" => name.clone(),
        unit => format!("{name} [{unit}]"),
    };
    let names: Vec<String> = table.columns.iter().map(named).collect();
    let mut text = csv(&names, &table.rows);
    if let Some(file) = &arguments.out {
        write_whole(file, &text)?;
        let many = match arguments.along {
            None => "frames",
            Some(_) => "slices",
        };
        text = format!("{} {many} in {}\n", table.rows.len(), file.display());
    }
    let json = json!({ "columns": names, "rows": table.rows });
    CommandOutput { json, text }.print(arguments.json);
    Ok(())
}

/// The table that `sph measure` prints, for arguments as JSON.
///
/// # Errors
/// Arguments that are none, and a mistake in them.
pub fn table_of_json(arguments: &str) -> Result<MeasuredTable, Trouble> {
    let arguments = serde_json::from_str(arguments);
    table(&arguments.map_err(|e: serde_json::Error| e.to_string())?)
}

fn table(arguments: &MeasureArguments) -> Result<MeasuredTable, Trouble> {
    if arguments.fit.is_some() && arguments.along.is_some() {
        return Err(Trouble::usage("--fit and --along exclude each other"));
    }
    let bounds = bounds(arguments)?;
    let phase = arguments.phase.as_deref();
    let phase = phase.map(|name| phase_number(&arguments.results, name));
    let phase = phase.transpose()?.map(|number| number as u32);
    let gravity = arguments.gravity.as_deref();
    let gravity = gravity.map(|text| vector("gravity", text, "m/s^2"));
    let gravity = gravity.transpose()?.map(Vect::from);
    let frames = frames(&arguments.results)?;
    let width = match &arguments.slice {
        None => 2.0 * frames.spacing,
        Some(text) => quantity("slice", text, "m")?,
    };
    if width <= 0.0 {
        return Err(format!("--slice {width}: expected a width above zero").into());
    }
    let mut measured = None;
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for entry in &frames.entries {
        let frame = frames.read(entry)?;
        let of = FrameParticles { frame, gravity };
        if measured.is_none() {
            let (_, unit) = Quantity::named(&arguments.field).values(&of)?;
            let probe = MeasuringProbe::from(statistic(arguments, &bounds, &of)?);
            measured = Some((unit, probe.with_phase_number(phase)));
        }
        let Some((_, probe)) = &measured else {
            continue;
        };
        let mut found = match arguments.along {
            None => vec![probe.values(&of)?],
            Some(axis) => probe.profile(&of, (axis.number(), width))?,
        };
        if let (Some(axis), Some(row)) = (arguments.fit, found.first_mut()) {
            row.extend(probe.line(&of, axis.number())?);
        }
        let timed = |row: Vec<f64>| [&[entry.time], &row[..]].concat();
        rows.extend(found.into_iter().map(timed));
    }
    let unit = measured.map(|(unit, _)| unit).unwrap_or_default();
    let columns = columns(arguments, &unit);
    Ok(MeasuredTable { columns, rows })
}

/// The measurement that the probe `statistic` of a scene would be, with bounds in the units of a frame.
fn statistic(
    arguments: &MeasureArguments,
    bounds: &[QuantityBound<'_>],
    of: &FrameParticles,
) -> Result<Statistic, Trouble> {
    let (mut above, mut below) = (BTreeMap::new(), BTreeMap::new());
    for (option, name, value) in bounds {
        let (_, unit) = Quantity::named(name).values(of)?;
        let value = parse_quantity(value, &unit);
        let value = value.map_err(|why| format!("--{option} {name}: {why}"))?;
        // Of several bounds the narrowest counts.
        let (all, narrower): (_, fn(f64, f64) -> f64) = match *option {
            "above" => (&mut above, f64::max),
            _ => (&mut below, f64::min),
        };
        let bound = all.entry(name.to_string()).or_insert(value);
        *bound = narrower(*bound, value);
    }
    Ok(Statistic {
        field: arguments.field.clone(),
        reduce: arguments.reduce.clone(),
        quantiles: arguments.quantile.clone(),
        levels: Vec::new(),
        weight: arguments.weight,
        phase: arguments.phase.clone(),
        above,
        below,
        fit: None,
        along: None,
        slice: 1.0,
        scale: 1.0,
    })
}

fn columns(arguments: &MeasureArguments, unit: &str) -> Vec<(String, String)> {
    let unit = some_unit(unit).unwrap_or_default();
    let named = |name: String| (name, unit.to_string());
    let reductions = arguments.reduce.iter().map(|how| match how {
        Reduction::Share => (how.name().into(), String::new()),
        Reduction::Total => (how.name().into(), arguments.weight.unit().into()),
        _ => named(how.name().into()),
    });
    let quantiles = arguments.quantile.iter();
    let quantiles = quantiles.map(|share| named(format!("q{share}")));
    let mut all = vec![("time".to_string(), "s".to_string())];
    all.extend(
        arguments
            .along
            .map(|axis| (["x", "y", "z"][axis.number()].into(), "m".into())),
    );
    all.extend(reductions.chain(quantiles));
    if arguments.fit.is_some() {
        let slope = if unit.is_empty() { "1" } else { unit };
        all.push(("slope".into(), format!("{slope} per m")));
        all.extend(["rms_about", "at_zero"].map(|name| named(name.into())));
    }
    all
}

fn csv(names: &[String], rows: &[Vec<f64>]) -> String {
    let cells = |row: &Vec<f64>| row.iter().map(f64::to_string).collect();
    let lines = std::iter::once(names.to_vec()).chain(rows.iter().map(cells));
    let lines = lines.map(|cells: Vec<String>| cells.join(",") + "\n");
    lines.collect()
}

/// A bound on a quantity, as it was given: the option, the quantity, the value.
type QuantityBound<'a> = (&'static str, &'a str, &'a str);

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

/// The particles of a frame, as a probe measures those of a flow. Vectors have three components in the plane, too.
struct FrameParticles {
    frame: Snapshot,
    gravity: Option<Vect<3>>,
}

impl MeasuredParticles<3> for FrameParticles {
    type Error = Trouble;
    type Unit = String;

    fn count(&self) -> usize {
        self.frame.points().len()
    }

    fn positions(&self) -> Result<Cow<'_, [Vect<3>]>, Trouble> {
        let points = self.frame.points().iter();
        Ok(points.map(|x| Vect::from(*x)).collect())
    }

    fn velocities(&self) -> Result<Cow<'_, [Vect<3>]>, Trouble> {
        let all = self.frame.velocity()?;
        let vectors = all.chunks_exact(3);
        Ok(vectors.map(Vect::from_column_slice).collect())
    }

    /// A frame may have this alone.
    fn speeds(&self) -> Result<Values<'_, String>, Trouble> {
        self.column("speed")
    }

    fn gravity(&self) -> Result<Vect<3>, Trouble> {
        let none = "frames hold no gravity: give --gravity X,Y[,Z]";
        self.gravity.ok_or_else(|| Trouble::usage(none))
    }

    fn column(&self, name: &str) -> Result<Values<'_, String>, Trouble> {
        let column = self.frame.column(name)?;
        let values = column.values;
        Ok((Box::new(move |k| values[k]), column.unit))
    }

    fn in_phase(
        &self,
        name: Option<&str>,
        number: Option<u32>,
    ) -> Result<Box<dyn Fn(usize) -> bool + '_>, Trouble> {
        let Some(number) = name.and(number) else {
            return Ok(Box::new(|_| true));
        };
        match self.column("phase") {
            Ok((phases, _)) => Ok(Box::new(move |k| phases(k) == f64::from(number))),
            // A scene of one phase has no column of phases.
            Err(_) if number == 0 => Ok(Box::new(|_| true)),
            Err(error) => Err(error),
        }
    }

    fn spacing(&self) -> f64 {
        self.frame.spacing
    }
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
