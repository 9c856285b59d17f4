//! Comparisons of the series with references.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;
use sph_core::bounds;
use sph_io::{Table, read_table};

use crate::coupled::Terzaghi;
use crate::scene::measure::unit;
use crate::scene::{DemError, Loaded, Origin, Probe, Reference, Statistic};

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

impl Compared {
    fn new(error: Option<f64>, norm: &str, against: String, samples: usize) -> Self {
        Self {
            value: error.filter(|e| e.is_finite()),
            norm: norm.into(),
            against,
            samples,
            found: None,
            wanted: None,
        }
    }

    /// Of one number: |x / value − 1|, or |x| where the value is zero.
    fn number(found: Option<f64>, wanted: f64, against: String, samples: usize) -> Self {
        let (norm, error): (_, &dyn Fn(f64) -> f64) = match wanted == 0.0 {
            true => ("absolute", &f64::abs),
            false => ("relative", &|x| (x / wanted - 1.0).abs()),
        };
        Self {
            found,
            wanted: Some(wanted),
            ..Self::new(found.map(error), norm, against, samples)
        }
    }
}

/// The errors against all references.
pub fn errors(
    loaded: &Loaded,
    origin: &Origin,
    series: &Path,
) -> Result<BTreeMap<String, Compared>, DemError> {
    let references = &loaded.scene.reference;
    if references.is_empty() {
        return Ok(BTreeMap::new());
    }
    let run = RunSeries {
        loaded,
        origin,
        table: read_table(series)?,
    };
    let one = |(name, reference): (&String, _)| Ok((name.clone(), run.compared(name, reference)?));
    references.iter().map(one).collect()
}

/// Ends of a window, if it has any.
type Window = [Option<f64>; 2];
const ALL: Window = [None; 2];

/// The rows of a run, and what they are measured from.
struct RunSeries<'a> {
    loaded: &'a Loaded,
    origin: &'a Origin,
    table: Table,
}

impl RunSeries<'_> {
    fn probe(&self, name: &str) -> Option<&Probe> {
        self.loaded.scene.probe.get(name)
    }

    /// Times (s) and values of a probe in a window (s), without rows in which there was nothing to measure.
    fn rows(&self, probe: &str, [from, to]: Window) -> Vec<(f64, f64)> {
        let window = from.unwrap_or(f64::NEG_INFINITY)..=to.unwrap_or(f64::INFINITY);
        let column = |name: &str| self.table.column(name).unwrap_or(&[]);
        let measured = |(t, x): &(f64, f64)| x.is_finite() && window.contains(t);
        let pairs = column("time").iter().zip(column(probe));
        pairs.map(|(t, x)| (*t, *x)).filter(measured).collect()
    }

    fn compared(&self, name: &str, reference: &Reference) -> Result<Compared, DemError> {
        let key = format!("reference.{name}.file");
        let (probe, window) = (reference.probe(), reference.window());
        match reference {
            Reference::Terzaghi { shorter_by, .. } => Ok(self.terzaghi(probe, *shorter_by, window)),
            Reference::Value { value, of, .. } => {
                let rows = self.rows(probe, window);
                let unit = self.probe(probe).map_or("", unit);
                let against = format!("{probe} = {value} {unit}").trim_end().to_string();
                let found = statistic(&rows, *of);
                Ok(Compared::number(found, *value, against, rows.len()))
            }
            Reference::Scaling {
                file,
                geometry,
                quantity,
                ..
            } => {
                let length = match self.probe(probe) {
                    Some(Probe::RunOut { length, .. }) => *length,
                    _ => f64::NAN,
                };
                let (path, aspect) = (self.loaded.resolve(&key, file)?, self.origin.top / length);
                let wanted = scaling(&path, [geometry, quantity], aspect);
                let wanted = wanted.map_err(|why| DemError::at(&key, why))?;
                let rows = self.rows(probe, ALL);
                let found = statistic(&rows, Statistic::Last);
                let against = format!("{quantity} = {wanted:.3} at a = {aspect:.3}, {geometry}");
                Ok(Compared::number(found, wanted, against, rows.len().min(1)))
            }
            Reference::Line { along, .. } => {
                let [along, values] = [along, probe].map(|name| self.rows(name, window));
                let beside = |(t, x): &(f64, f64)| {
                    let (_, y) = values.iter().find(|(u, _)| u == t)?;
                    Some((*x, *y))
                };
                let pairs: Vec<_> = along.iter().filter_map(beside).collect();
                let error = determination(&pairs).map(|r2| 1.0 - r2);
                let against = format!("{probe} in a straight line");
                Ok(Compared::new(error, "1 − R²", against, pairs.len()))
            }
            Reference::Curve { file, column, .. } => {
                let table = read_table(self.loaded.resolve(&key, file)?)?;
                let wanted = table.column(column).ok_or_else(|| {
                    let why = format!("there is no column `{column}`");
                    DemError::at(format!("reference.{name}.column"), why)
                })?;
                let times = self.times(&table).ok_or_else(|| {
                    let why = "needs a column `time[s]`, or `time_factor` with an [oedometer]";
                    DemError::at(key, why)
                })?;
                Ok(self.beside(probe, &times, wanted, format!("`{column}` of {file}")))
            }
        }
    }

    /// A probe beside wanted values at times (s): root mean square over their range.
    fn beside(&self, probe: &str, times: &[f64], wanted: &[f64], against: String) -> Compared {
        let rows = self.rows(probe, ALL);
        let pairs = times.iter().zip(wanted);
        let pairs = pairs.filter_map(|(t, x)| Some((at(&rows, *t)?, *x)));
        let pairs: Vec<_> = pairs.collect();
        let [[low], [high]] = bounds(wanted.iter().map(|x| [*x]));
        let error = mean_square(&pairs).sqrt() / (high - low);
        Compared::new(Some(error), "rms over range", against, pairs.len())
    }

    /// Root mean square of the difference between a probe and Terzaghi, between two time factors.
    fn terzaghi(&self, probe: &str, shorter_by: f64, factors: Window) -> Compared {
        let settles = matches!(self.probe(probe), Some(Probe::Consolidation {}));
        let plain = self.origin.terzaghi();
        let theory = Terzaghi {
            drainage: plain.drainage - shorter_by * self.origin.diameter,
            ..plain
        };
        let wanted = |t: f64| match settles {
            true => theory.consolidation(t),
            false => theory.pressure(theory.drainage, t),
        };
        let rows = self.rows(probe, factors.map(|all| all.map(|t| plain.time(t))));
        let pairs: Vec<_> = rows.iter().map(|(t, x)| (*x, wanted(*t))).collect();
        let what = if settles { "U" } else { "p in the middle" };
        let against = format!(
            "{what}, Terzaghi, C_v = {:.4} m²/s, L less {shorter_by} d₅₀",
            plain.coefficient
        );
        let error = mean_square(&pairs).sqrt();
        Compared::new(Some(error), "rms", against, rows.len())
    }

    /// Times of the rows of a table, s.
    fn times(&self, table: &Table) -> Option<Vec<f64>> {
        if let Some(times) = table.column("time") {
            return Some(times.to_vec());
        }
        self.origin.consolidation()?;
        let theory = self.origin.terzaghi();
        let factors = table.column("time_factor")?.iter();
        Some(factors.map(|t| theory.time(*t)).collect())
    }
}

/// Mean of (a − b)².
fn mean_square(pairs: &[(f64, f64)]) -> f64 {
    pairs.iter().map(|(a, b)| (a - b).powi(2)).sum::<f64>() / pairs.len() as f64
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
                let area = |w: &[(f64, f64)]| 0.5 * (w[0].1 + w[1].1) * (w[1].0 - w[0].0);
                let sum: f64 = rows.windows(2).map(area).sum();
                Some(sum / (last.0 - first.0))
            }
        },
    }
}

/// Coefficient of determination R² of a straight line through pairs.
fn determination(pairs: &[(f64, f64)]) -> Option<f64> {
    let n = pairs.len() as f64;
    let mean = |f: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let moment = |f: fn(f64, f64) -> f64| pairs.iter().map(|p| f(p.0 - x, p.1 - y)).sum::<f64>();
    let [xx, yy] = [moment(|a, _| a * a), moment(|_, b| b * b)];
    let xy = moment(|a, b| a * b);
    (pairs.len() > 2 && xx > 0.0 && yy > 0.0).then(|| xy * xy / (xx * yy))
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

/// C aⁿ at an aspect ratio a by the rows of a geometry and a quantity in a table with the columns geometry, quantity,
/// range (`a<2.3`), C, n (`2/3`); not a number beyond all ranges.
fn scaling(path: &Path, [geometry, quantity]: [&str; 2], aspect: f64) -> Result<f64, String> {
    let text = scene_text::read_text(path)?;
    let rows = text.lines().filter(|l| !l.starts_with('#')).skip(1);
    let mut found = Vec::new();
    for line in rows {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if let [g, q, range, factor, exponent, ..] = cells.as_slice()
            && [*g, *q] == [geometry, quantity]
        {
            let value = value(range, factor, exponent, aspect);
            found.push(value.ok_or_else(|| format!("cannot read the row `{line}`"))?);
        }
    }
    match found.is_empty() {
        true => Err(format!("there is no row of `{quantity}` for `{geometry}`")),
        false => Ok(found.into_iter().flatten().next().unwrap_or(f64::NAN)),
    }
}

/// The law of a row at an aspect ratio, if it is in the range; none of a row that cannot be read.
fn value(range: &str, factor: &str, exponent: &str, aspect: f64) -> Option<Option<f64>> {
    let below = range.strip_prefix("a<");
    let bound: f64 = below.or_else(|| range.strip_prefix("a>"))?.parse().ok()?;
    let (factor, exponent): (f64, f64) = (factor.parse().ok()?, fraction(exponent)?);
    let fits = (aspect < bound) == below.is_some();
    Some(fits.then(|| factor * aspect.powf(exponent)))
}

/// `0.65` or `2/3`.
fn fraction(text: &str) -> Option<f64> {
    match text.split_once('/') {
        Some((over, under)) => Some(over.parse::<f64>().ok()? / under.parse::<f64>().ok()?),
        None => text.parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_hold_in_their_ranges() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("laws.csv");
        let text = "# a table\ngeometry,quantity,range,C,n,note\nchannel,run-out,a<2.3,1.2,1,x\nchannel,run-out,a>2.3,1.9,2/3,y\n";
        std::fs::write(&path, text).unwrap();
        let at = |aspect| scaling(&path, ["channel", "run-out"], aspect).unwrap();
        assert!((at(1.0) - 1.2).abs() < 1e-12);
        assert!((at(8.0) - 7.6).abs() < 1e-12);
        let none = scaling(&path, ["round", "run-out"], 1.0).unwrap_err();
        assert!(none.contains("no row"));
    }
}
