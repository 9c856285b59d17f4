//! Errors against the scene's references.

use std::collections::BTreeMap;
use std::path::Path;

use sph_core::fields;
use sph_io::{Table, read_table};
use sph_probes::{Solution, norm};
use sph_scene::{Norm, Reference, Scene};
use sph_solver::Flow;

use crate::failure::error::Result;
use crate::results::summary::ErrorEntry;
use crate::setup::field_error::beside_solution;
use crate::setup::{Assembled, field_error, reference_series};

/// Every reference that can be compared; the others become warnings.
pub fn errors<const D: usize>(
    scene: &Scene,
    shown: &Assembled<D>,
    series: &Path,
    warnings: &mut Vec<String>,
) -> Result<BTreeMap<String, ErrorEntry>> {
    let mut errors = BTreeMap::new();
    let in_series = |r: &Reference| r.probe.is_some() || r.norm() == Norm::L2Mean;
    let series = match scene.reference.values().any(in_series) {
        true => Some(read_table(series)?),
        false => None,
    };
    for (name, reference) in &scene.reference {
        let solution = shown.solutions.iter().find(|(n, _)| n == name);
        let solution = solution.map(|(_, s)| &**s);
        let entry = match (&reference.field, &reference.probe, &series) {
            (Some(_), _, Some(table)) if reference.norm() == Norm::L2Mean => {
                let times = table.column("time").unwrap_or(&[]);
                let column = field_error::column(name);
                let values = table.column(&column).ok_or_else(|| absent(&column));
                values.and_then(|values| averaged(reference, times, values))
            }
            (Some(field), _, _) => against_field(&shown.flow, reference, field, solution),
            (None, Some(probe), Some(table)) => match measured(table, reference, probe) {
                Some((times, values)) => against_series(reference, times, &values, solution),
                None => Err(absent(probe)),
            },
            _ => Err("it names neither a field nor a probe".to_string()),
        };
        match entry {
            Ok(entry) => {
                errors.insert(name.clone(), entry);
            }
            Err(reason) => warnings.push(format!("reference `{name}` was not compared: {reason}")),
        }
    }
    Ok(errors)
}

/// Times and values of a probe in the series, smoothed where its reference is.
pub fn measured<'t>(
    series: &'t Table,
    reference: &Reference,
    probe: &str,
) -> Option<(&'t [f64], Vec<f64>)> {
    let times = series.column("time").unwrap_or(&[]);
    let values = series.column(probe)?;
    let smoothed = reference.average;
    let smoothed = smoothed.map(|width| norm::moving_mean(times, values, width));
    Some((times, smoothed.unwrap_or_else(|| values.to_vec())))
}

fn absent(column: &str) -> String {
    format!("the series has no column `{column}`")
}

fn entry(value: f64, reference: &Reference, samples: usize, window: [f64; 2]) -> ErrorEntry {
    let against = match (&reference.file, &reference.solution) {
        (Some(file), _) => file.clone(),
        (None, Some(solution)) => format!("solution {solution}"),
        (None, None) => match (reference.norm(), reference.value, reference.period) {
            (Norm::Mean, Some(value), _) => format!("value {value}"),
            (Norm::Period, _, Some(period)) => format!("period {period} s"),
            _ => String::new(),
        },
    };
    ErrorEntry {
        value: value.is_finite().then_some(value),
        norm: reference.norm().name(),
        unit: match reference.norm() {
            Norm::Absolute => "".into(),
            _ => "1".into(),
        },
        samples,
        window,
        against,
        means: None,
    }
}

/// A field at the end of the run against a solution.
fn against_field<const D: usize>(
    flow: &Flow<D>,
    reference: &Reference,
    field: &str,
    solution: Option<&dyn Solution<D>>,
) -> Result<ErrorEntry, String> {
    let solution = solution.ok_or("a field is compared with a `solution`")?;
    let time = flow.world.time;
    let volume = flow.world.free.get(fields::VOLUME);
    let volume = volume.map_err(|e| e.to_string())?;
    let (values, exact, components) = beside_solution(&flow.world, field, solution)?;
    let difference: Vec<f64> = values.iter().zip(&exact).map(|(u, e)| u - e).collect();
    let value = match reference.norm() {
        Norm::L2 => norm::l2(&values, &exact, volume, components),
        Norm::L1 => norm::l1(&values, &exact, components),
        Norm::Linf => norm::linf(&values, &exact, components),
        Norm::Amplitude => norm::amplitude(&values, &exact, volume, components),
        Norm::Rms => norm::rms(&difference, volume, components, reference.scale_value),
        Norm::Absolute => largest(&difference),
        other => return Err(format!("the norm `{}` is for probes", other.name())),
    };
    Ok(entry(value, reference, volume.len(), [time, time]))
}

fn largest(differences: &[f64]) -> f64 {
    differences.iter().fold(0.0_f64, |m, d| m.max(d.abs()))
}

/// True if a time counts.
fn counts(reference: &Reference, t: f64) -> bool {
    let inside = reference.window.is_none_or(|[a, b]| t >= a && t <= b);
    inside && reference.exclude.is_none_or(|[a, b]| t < a || t > b)
}

/// Means over the rows that count: the error itself, the value, the period.
fn averaged(reference: &Reference, times: &[f64], values: &[f64]) -> Result<ErrorEntry, String> {
    let rows = times.iter().zip(values);
    let rows = rows.filter(|(t, v)| counts(reference, **t) && v.is_finite());
    let (times, values): (Vec<f64>, Vec<f64>) = rows.unzip();
    let (Some(first), Some(last)) = (times.first(), times.last()) else {
        return Err("no row of the series counts".into());
    };
    let mean = || norm::mean(&times, &values).unwrap_or(f64::NAN);
    let value = match (reference.norm(), reference.value, reference.period) {
        (Norm::Mean, Some(exact), _) => ((mean() - exact) / exact).abs(),
        (Norm::Period, _, Some(exact)) => {
            let found = norm::period(&times, &values);
            let found = found.ok_or("the series crosses its mean too seldom for a period")?;
            (found / exact - 1.0).abs()
        }
        _ => mean(),
    };
    let exact = reference.value.filter(|_| reference.norm() == Norm::Mean);
    Ok(ErrorEntry {
        means: exact
            .map(|exact| [mean(), exact])
            .filter(|all| all[0].is_finite()),
        ..entry(value, reference, times.len(), [*first, *last])
    })
}

/// A probe's series against a file or a solution's rate of decay.
fn against_series<const D: usize>(
    reference: &Reference,
    times: &[f64],
    values: &[f64],
    solution: Option<&dyn Solution<D>>,
) -> Result<ErrorEntry, String> {
    if reference.norm() == Norm::DecayRate {
        let exact = solution.and_then(|s| s.energy_rate());
        let exact = exact.ok_or("the norm `decay-rate` needs a solution with a constant rate")?;
        let pairs = times.iter().zip(values);
        let pairs = pairs.filter(|(t, v)| counts(reference, **t) && **v > 0.0);
        let (t, ln): (Vec<f64>, Vec<f64>) = pairs.map(|(t, v)| (*t, v.ln())).unzip();
        if t.len() < 2 {
            return Err("fewer than two rows of the series count".into());
        }
        let window = [t[0], t[t.len() - 1]];
        let value = (norm::slope(&t, &ln) / exact - 1.0).abs();
        return Ok(entry(value, reference, t.len(), window));
    }
    if reference.stands_alone() {
        return averaged(reference, times, values);
    }
    let path = reference.path.as_ref();
    let path = path.ok_or("a probe is compared with a `file`, or by the norm `decay-rate`")?;
    // It was good when the run began; results computed since are not lost with it.
    let table = reference_series(reference, path).map_err(|gone| gone.to_string())?;
    against_table(reference, &table, [times, values])
}

/// A series where a table has values that count, and both there.
fn against_table(
    reference: &Reference,
    [at, low, high]: &[Vec<f64>; 3],
    series: [&[f64]; 2],
) -> Result<ErrorEntry, String> {
    let weights = norm::time_weights(at);
    let (mut instants, mut compared, mut differences) = (Vec::new(), Vec::new(), Vec::new());
    let (mut outside, mut whole) = (0.0, 0.0);
    let mut window = [f64::INFINITY, f64::NEG_INFINITY];
    let mut last = None;
    let counted = at.iter().enumerate();
    for (k, &t) in counted.filter(|(_, t)| counts(reference, **t)) {
        let Some(u) = norm::at(series[0], series[1], t).filter(|u| u.is_finite()) else {
            continue;
        };
        window = [window[0].min(t), window[1].max(t)];
        differences.push(u - low[k]);
        compared.push(low[k]);
        instants.push(t);
        if let Some(high) = high.get(k) {
            let out = u < low[k] || u > *high;
            outside += if out { weights[k] } else { 0.0 };
            whole += weights[k];
        }
        if last.is_none_or(|(before, _)| t >= before) {
            last = Some((t, ((u - low[k]) / low[k]).abs()));
        }
    }
    let (_, last) = last.ok_or("no time of the reference lies within the run")?;
    let n = differences.len();
    let both = compared.iter().zip(&differences);
    let exact_plus: Vec<f64> = both.map(|(e, d)| e + d).collect();
    let value = match reference.norm() {
        Norm::RmsOverRange => norm::rms_over_range(&differences, &compared),
        Norm::Band => outside / whole,
        Norm::Final => last,
        Norm::Absolute => largest(&differences),
        Norm::L2 => norm::l2(&exact_plus, &compared, &vec![1.0; n], 1),
        Norm::L1 => norm::l1(&exact_plus, &compared, 1),
        Norm::Linf => norm::linf(&exact_plus, &compared, 1),
        Norm::Range => norm::range_error(&exact_plus, &compared),
        Norm::PeakTime => {
            let peak = |values: &[f64]| norm::peak_time(&instants, values).unwrap_or(f64::NAN);
            (peak(&exact_plus) / peak(&compared) - 1.0).abs()
        }
        Norm::Lag => {
            let period = reference.period;
            let period = period.ok_or("the norm `lag` needs the `period`")?;
            // The whole series: it is looked at between instants.
            let found = norm::lag(series, [&instants, &compared], 0.5 * period);
            found.map_or(f64::NAN, |lag| lag.abs() / period)
        }
        _ => return Err("this norm is for fields".into()),
    };
    Ok(entry(value, reference, n, window))
}
