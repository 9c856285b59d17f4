//! Comparisons of the series with references.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;
use sph_io::{Table, read_table};

use crate::coupled::Terzaghi;
use crate::scene::error::DemError;
use crate::scene::measure;
use crate::scene::origin::Origin;
use crate::scene::read::Loaded;
use crate::scene::scaling;
use crate::scene::tables::{Probe, Reference, Statistic};

/// An error against a reference.
#[derive(Clone, Debug, Serialize)]
pub struct Compared {
    /// The error; none if there was nothing to compare.
    pub value: Option<f64>,
    /// The measure: "rms", "relative".
    pub norm: String,
    /// Name of the reference.
    pub against: String,
    /// Rows compared.
    pub samples: usize,
    /// Value of the run, where it is one number.
    pub found: Option<f64>,
    /// Value of the reference, where it is one number.
    pub wanted: Option<f64>,
}

/// The errors against all references.
///
/// # Errors
/// If the series or a table cannot be read.
pub fn errors(
    loaded: &Loaded,
    origin: &Origin,
    series: &Path,
) -> Result<BTreeMap<String, Compared>, DemError> {
    let mut all = BTreeMap::new();
    if loaded.scene.reference.is_empty() {
        return Ok(all);
    }
    let table = read_table(series)?;
    for (name, reference) in &loaded.scene.reference {
        let compared = one(loaded, origin, &table, name, reference)?;
        all.insert(name.clone(), compared);
    }
    Ok(all)
}

/// Times (s) and values of a probe, without rows in which there was nothing to measure.
fn rows(table: &Table, probe: &str, [from, to]: [f64; 2]) -> Vec<(f64, f64)> {
    let column = |name: &str| table.column(name).unwrap_or(&[]);
    let pairs = column("time").iter().zip(column(probe));
    let pairs = pairs.map(|(t, x)| (*t, *x));
    pairs
        .filter(|(t, x)| x.is_finite() && (from..=to).contains(t))
        .collect()
}

fn window(from: Option<f64>, to: Option<f64>) -> [f64; 2] {
    [
        from.unwrap_or(f64::NEG_INFINITY),
        to.unwrap_or(f64::INFINITY),
    ]
}

const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

fn one(
    loaded: &Loaded,
    origin: &Origin,
    table: &Table,
    name: &str,
    reference: &Reference,
) -> Result<Compared, DemError> {
    match reference {
        Reference::Terzaghi {
            probe,
            shorter_by,
            from,
            to,
        } => Ok(terzaghi(
            loaded,
            origin,
            table,
            probe,
            *shorter_by,
            [*from, *to],
        )),
        Reference::Value {
            probe,
            value,
            of,
            from,
            to,
        } => {
            let rows = rows(table, probe, window(*from, *to));
            let found = statistic(&rows, *of);
            let unit = loaded.scene.probe.get(probe).map_or("", measure::unit);
            let against = format!("{probe} = {value} {unit}");
            Ok(relative(
                found,
                *value,
                against.trim_end().to_string(),
                rows.len(),
            ))
        }
        Reference::Scaling {
            probe,
            file,
            geometry,
            quantity,
        } => {
            let probe = probe.as_str();
            scaled(
                loaded,
                origin,
                table,
                name,
                [probe, file, geometry, quantity],
            )
        }
        Reference::Line {
            along,
            probe,
            from,
            to,
        } => {
            let window = window(*from, *to);
            Ok(line(
                &rows(table, along, window),
                &rows(table, probe, window),
                probe,
            ))
        }
        Reference::Curve {
            probe,
            file,
            column,
        } => curve(loaded, origin, table, name, [probe, file, column]),
    }
}

/// A run-out beside the scaling law of a file.
fn scaled(
    loaded: &Loaded,
    origin: &Origin,
    table: &Table,
    name: &str,
    [probe, file, geometry, quantity]: [&str; 4],
) -> Result<Compared, DemError> {
    let key = format!("reference.{name}.file");
    let path = loaded.source.resolve(&key, file);
    let path = path.map_err(|e| DemError::at(&key, e))?;
    let law = scaling::read(&path, geometry, quantity);
    let law = law.map_err(|why| DemError::at(&key, why))?;
    let length = match loaded.scene.probe.get(probe) {
        Some(Probe::RunOut { length, .. }) => *length,
        _ => f64::NAN,
    };
    let aspect = origin.top / length;
    let wanted = law.at(aspect).unwrap_or(f64::NAN);
    let rows = rows(table, probe, ALL);
    let found = statistic(&rows, Statistic::Last);
    let against = format!("{quantity} = {wanted:.3} at a = {aspect:.3}, {geometry}");
    Ok(relative(found, wanted, against, rows.len().min(1)))
}

/// Fit of a straight line to values of one probe over those of another.
fn line(along: &[(f64, f64)], values: &[(f64, f64)], probe: &str) -> Compared {
    let pairs: Vec<_> = along
        .iter()
        .filter_map(|(t, x)| values.iter().find(|(u, _)| u == t).map(|(_, y)| (*x, *y)))
        .collect();
    Compared {
        value: determination(&pairs).map(|r2| 1.0 - r2),
        norm: "1 − R²".into(),
        against: format!("{probe} in a straight line"),
        samples: pairs.len(),
        found: None,
        wanted: None,
    }
}

/// Root mean square of the difference between a probe and Terzaghi, between two time factors.
fn terzaghi(
    loaded: &Loaded,
    origin: &Origin,
    table: &Table,
    probe: &str,
    shorter_by: f64,
    factors: [f64; 2],
) -> Compared {
    let settles = matches!(loaded.scene.probe.get(probe), Some(Probe::Consolidation {}));
    let half = origin.lengths.map_or(f64::NAN, |l| 0.5 * l[2]);
    let coefficient = origin.consolidation().unwrap_or(f64::NAN);
    let plain = Terzaghi {
        coefficient,
        drainage: half,
    };
    let theory = Terzaghi {
        drainage: half - shorter_by * origin.diameter,
        ..plain
    };
    let times = factors.map(|t| plain.time(t));
    let rows = rows(table, probe, times);
    let squares = rows.iter().map(|(t, x)| {
        let wanted = match settles {
            true => theory.consolidation(*t),
            false => theory.pressure(theory.drainage, *t),
        };
        (x - wanted).powi(2)
    });
    let mean = squares.sum::<f64>() / rows.len() as f64;
    let what = if settles { "U" } else { "p in the middle" };
    Compared {
        value: mean.is_finite().then(|| mean.sqrt()),
        norm: "rms".into(),
        against: format!("{what}, Terzaghi, C_v = {coefficient:.4} m²/s, L less {shorter_by} d₅₀"),
        samples: rows.len(),
        found: None,
        wanted: None,
    }
}

fn relative(found: Option<f64>, wanted: f64, against: String, samples: usize) -> Compared {
    let error = |x: f64| match wanted == 0.0 {
        true => x.abs(),
        false => (x / wanted - 1.0).abs(),
    };
    Compared {
        value: found.map(error).filter(|e| e.is_finite()),
        norm: if wanted == 0.0 {
            "absolute"
        } else {
            "relative"
        }
        .into(),
        against,
        samples,
        found,
        wanted: Some(wanted),
    }
}

fn statistic(rows: &[(f64, f64)], of: Statistic) -> Option<f64> {
    let mut values = rows.iter().map(|(_, x)| *x);
    match of {
        Statistic::Last => values.next_back(),
        Statistic::Largest => values.reduce(f64::max),
        Statistic::Smallest => values.reduce(f64::min),
        // By the trapezoidal rule, since rows are not even in time.
        Statistic::Mean => match rows {
            [] => None,
            [(_, only)] => Some(*only),
            [first, .., last] => {
                let areas = rows
                    .windows(2)
                    .map(|w| 0.5 * (w[0].1 + w[1].1) * (w[1].0 - w[0].0));
                Some(areas.sum::<f64>() / (last.0 - first.0))
            }
        },
    }
}

/// Coefficient of determination R² of a straight line through pairs.
fn determination(pairs: &[(f64, f64)]) -> Option<f64> {
    let n = pairs.len() as f64;
    let mean = |f: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let moment =
        |f: &dyn Fn(f64, f64) -> f64| -> f64 { pairs.iter().map(|p| f(p.0 - x, p.1 - y)).sum() };
    let (xx, yy, xy) = (
        moment(&|a, _| a * a),
        moment(&|_, b| b * b),
        moment(&|a, b| a * b),
    );
    (pairs.len() > 2 && xx > 0.0 && yy > 0.0).then(|| xy * xy / (xx * yy))
}

fn curve(
    loaded: &Loaded,
    origin: &Origin,
    table: &Table,
    name: &str,
    [probe, file, column]: [&String; 3],
) -> Result<Compared, DemError> {
    let key = format!("reference.{name}.file");
    let path = loaded.source.resolve(&key, file);
    let path = path.map_err(|e| DemError::at(&key, e))?;
    let given = read_table(&path)?;
    let wanted = given.column(column);
    let wanted = wanted.ok_or_else(|| {
        DemError::at(
            format!("reference.{name}.column"),
            format!("there is no column `{column}`"),
        )
    })?;
    let times: Vec<f64> = match (
        given.column("time"),
        given.column("time_factor"),
        origin.consolidation(),
    ) {
        (Some(times), ..) => times.to_vec(),
        (_, Some(factors), Some(coefficient)) => {
            let drainage = origin.lengths.map_or(f64::NAN, |l| 0.5 * l[2]);
            let theory = Terzaghi {
                coefficient,
                drainage,
            };
            factors.iter().map(|t| theory.time(*t)).collect()
        }
        _ => {
            return Err(DemError::at(
                key,
                "needs a column `time[s]`, or `time_factor` with an [oedometer]",
            ));
        }
    };
    let rows = rows(table, probe, ALL);
    let pairs = times
        .iter()
        .zip(wanted)
        .filter_map(|(t, x)| Some((at(&rows, *t)?, *x)));
    let pairs: Vec<(f64, f64)> = pairs.collect();
    let (low, high) = wanted
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
            (l.min(*x), h.max(*x))
        });
    let mean = pairs.iter().map(|(a, b)| (a - b).powi(2)).sum::<f64>() / pairs.len() as f64;
    let value = mean.sqrt() / (high - low);
    Ok(Compared {
        value: value.is_finite().then_some(value),
        norm: "rms over range".into(),
        against: format!("`{column}` of {file}"),
        samples: pairs.len(),
        found: None,
        wanted: None,
    })
}

/// A probe at a time (s), linear between rows.
fn at(rows: &[(f64, f64)], time: f64) -> Option<f64> {
    let after = rows.iter().position(|(t, _)| *t >= time)?;
    let (t1, x1) = rows[after];
    if t1 == time {
        return Some(x1);
    }
    let (t0, x0) = rows[after.checked_sub(1)?];
    Some(x0 + (x1 - x0) * (time - t0) / (t1 - t0))
}
