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
/// The line goes through the highest particle of every column of two spacings' width, half a spacing
/// above it; with `of = "failure"` through the highest that has moved by less than `moved` since the
/// start, wherever that is: the limit between the soil that failed and that which did not. Between
/// two particles the line is straight, beyond the last ones level; a column without a particle
/// interrupts it. Points of the reference without a line do not count in the first value:
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
    /// The highest particle of every column, m, and the number of the first column.
    fn tops(&self, world: &World<2>) -> Result<(Vec<Option<[f64; 2]>>, f64), StepError> {
        let counted = Counted::of(world, self.phase.as_deref(), self.number)?;
        let positions = world.free.get(fields::POSITION)?;
        let moved = match self.of {
            LineOf::Surface => None,
            LineOf::Failure => Some(world.free.get(fields::DISPLACEMENT)?),
        };
        let rests = |k: usize| moved.is_none_or(|moved| moved[k].norm() < self.moved);
        // Particles far away from the reference make no columns: these must fit into memory.
        let width = WIDTH * world.spacing;
        let xs = || self.reference.iter().map(|[x, _]| x / width);
        let first = xs().fold(f64::INFINITY, f64::min).floor() - 1.0;
        let count = xs().fold(f64::NEG_INFINITY, f64::max).floor() + 2.0 - first;
        let mut highest = vec![None::<[f64; 2]>; count.clamp(0.0, MOST) as usize];
        for (k, x) in positions.iter().enumerate() {
            let column = (x[0] / width).floor() - first;
            if column < 0.0 || column >= highest.len() as f64 || !counted.has(k) || !rests(k) {
                continue;
            }
            let top = &mut highest[column as usize];
            let here = [x[0], x[1] + 0.5 * world.spacing];
            // Of equals the first in space, whatever the order of the particles.
            if top.is_none_or(|t| (here[1], -here[0]) > (t[1], -t[0])) {
                *top = Some(here);
            }
        }
        Ok((highest, first))
    }
}

/// Width of a column in spacings: particles that have moved apart by more than one leave narrower
/// columns empty down to the rows below.
const WIDTH: f64 = 2.0;

/// Most columns; a reference may have a wrong unit.
const MOST: f64 = 1e6;

/// The height at x; `column` is its own.
fn height(tops: &[Option<[f64; 2]>], column: f64, x: f64) -> Option<f64> {
    let column = column as usize;
    let own = tops.get(column).copied().flatten()?;
    let other = match x < own[0] {
        true => column.checked_sub(1),
        false => Some(column + 1),
    };
    // At the ends, and beside a gap, the line is level.
    let Some(other) = other.and_then(|k| tops.get(k).copied().flatten()) else {
        return Some(own[1]);
    };
    Some(own[1] + (x - own[0]) / (other[0] - own[0]) * (other[1] - own[1]))
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
        let (tops, first) = self.tops(world)?;
        let (mut squares, mut count) = (0.0, 0_usize);
        for [x, y] in &self.reference {
            let column = (x / (WIDTH * world.spacing)).floor() - first;
            if let Some(height) = height(&tops, column, *x) {
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
