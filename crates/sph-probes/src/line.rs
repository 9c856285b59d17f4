//! The free surface or the failure line of a phase against a drawn line.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sph_core::{StepError, fields, register};
use sph_neighbours::World;

use crate::phase::{self, Counted};
use crate::{Probe, ProbeColumn, ProbeEntry};

/// Which line of a body of soil.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, JsonSchema, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum LineOf {
    /// Over all particles.
    #[default]
    Surface,
    /// Over those that have hardly moved since the start.
    Failure,
}

/// Root mean square of the height of a line over a reference's, at the reference's points, and the
/// share of these points where there is a line.
///
/// The line is the highest particle of every column of a spacing's width, and half a spacing; with
/// `of = "failure"` the highest that has moved by less than `moved` since the start, wherever that
/// is: the limit between the soil that failed and that which did not. Between the middles of two
/// columns the line is straight, and it ends half a spacing beyond the last ones; a column without a
/// particle interrupts it. Points of the reference without a line do not count in the first value:
/// look at both. Without any the first is NaN.
///
/// Displacements are kept for such probes only.
///
/// Source: ours; the threshold as in Ghaïtanellis 2017, §5.3.2.
///
/// ```toml
/// [probe.failure]
/// kind = "line"
/// of = "failure"
/// moved = "1.5 mm"
/// file = "data/bui2008_final_failure.csv"
/// ```
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Which line: `surface` or `failure`.
    #[serde(default)]
    pub of: LineOf,
    /// CSV file of the reference, relative to the scene's folder: x and y in m.
    pub file: String,
    /// Displacement from which on a particle has failed.
    #[serde(default = "threshold")]
    #[schemars(extend(
        "unit" = "m",
        "exclusiveMinimum" = 0.0,
        "source" = "Ghaïtanellis 2017, §5.3.2"
    ))]
    pub moved: f64,
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    #[serde(skip)]
    number: Option<u32>,
    #[serde(skip)]
    reference: Vec<[f64; 2]>,
}

fn threshold() -> f64 {
    1.5e-3
}

impl Line {
    /// Height of the line in columns of a spacing's width, and the number of the first column.
    fn columns(&self, world: &World<2>) -> Result<(Vec<Option<f64>>, f64), StepError> {
        let counted = Counted::of(world, self.phase.as_deref(), self.number)?;
        let positions = world.free.get(fields::POSITION)?;
        let moved = match self.of {
            LineOf::Surface => None,
            LineOf::Failure => Some(world.free.get(fields::DISPLACEMENT)?),
        };
        let rests = |k: usize| moved.is_none_or(|moved| moved[k].norm() < self.moved);
        // Particles far away from the reference make no columns: these must fit into memory.
        let xs = || self.reference.iter().map(|[x, _]| x / world.spacing);
        let first = xs().fold(f64::INFINITY, f64::min).floor() - 1.0;
        let count = xs().fold(f64::NEG_INFINITY, f64::max).floor() + 2.0 - first;
        let mut highest = vec![None::<f64>; count.clamp(0.0, MOST) as usize];
        for (k, x) in positions.iter().enumerate() {
            let column = (x[0] / world.spacing).floor() - first;
            if column < 0.0 || column >= highest.len() as f64 || !counted.has(k) || !rests(k) {
                continue;
            }
            let top = &mut highest[column as usize];
            let y = x[1] + 0.5 * world.spacing;
            *top = Some(top.map_or(y, |top| top.max(y)));
        }
        Ok((highest, first))
    }
}

/// Most columns; a reference may have a wrong unit.
const MOST: f64 = 1e6;

/// The height at a place counted in columns from the first.
fn height(columns: &[Option<f64>], along: f64) -> Option<f64> {
    let own = columns.get(along as usize).copied().flatten()?;
    let off = along - along.floor() - 0.5;
    let other = match off < 0.0 {
        true => (along as usize).checked_sub(1),
        false => Some(along as usize + 1),
    };
    let other = other.and_then(|k| columns.get(k).copied().flatten());
    // At the ends, and beside a gap, the line is level.
    Some(own + off.abs() * (other.unwrap_or(own) - own))
}

impl Probe<2> for Line {
    fn columns(&self) -> Vec<ProbeColumn> {
        let column = |suffix: &str, unit| ProbeColumn {
            suffix: suffix.into(),
            unit,
        };
        vec![column(".rms", "m"), column(".share", "1")]
    }

    fn name_phases(&mut self, names: &[String]) -> Result<(), String> {
        if let Some(name) = &self.phase {
            self.number = Some(phase::number(name, names)?);
        }
        Ok(())
    }

    fn needs_displacement(&self) -> bool {
        self.of == LineOf::Failure
    }

    fn file(&self) -> Option<&str> {
        Some(&self.file)
    }

    fn learn(&mut self, rows: Vec<[f64; 2]>) -> Result<(), String> {
        if rows.is_empty() || rows.iter().flatten().any(|v| !v.is_finite()) {
            return Err("is no line: expected rows of x and y".into());
        }
        self.reference = rows;
        Ok(())
    }

    fn measure(&self, world: &World<2>) -> Result<Vec<f64>, StepError> {
        let (columns, first) = Line::columns(self, world)?;
        let (mut squares, mut count) = (0.0, 0_usize);
        for [x, y] in &self.reference {
            if let Some(height) = height(&columns, x / world.spacing - first) {
                squares += (height - y).powi(2);
                count += 1;
            }
        }
        let rms = match count {
            0 => f64::NAN,
            count => (squares / count as f64).sqrt(),
        };
        Ok(vec![rms, count as f64 / self.reference.len().max(1) as f64])
    }
}

register!(
    ProbeEntry[2],
    Line,
    "line",
    "free surface or failure line of a phase against a drawn line",
    "highest particles; Ghaïtanellis 2017, §5.3.2"
);
