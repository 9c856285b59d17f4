//! The free surface, the failure line or the limit of motion of a phase against a drawn line.

use sph_core::{StepError, fields, parameters, plugin};
use sph_neighbours::World;

use crate::beds::columns::{Columns, End};
use crate::phases::phase::{self, CountedPhase};
use crate::{Needs, Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// Line of a body of soil.
#[parameters]
#[serde(rename_all = "lowercase")]
pub enum LineOf {
    /// Over all particles.
    #[default]
    Surface,
    /// Over those that have hardly moved since the start.
    Failure,
    /// Under those that move now.
    Limit,
}

/// Root mean square of the height of a line over a reference's, at the reference's points, the share of these points
/// where there is a line, and the root mean square of their distances from it, in any direction.
///
/// The line goes through the highest particle of every column of two spacings' width, half a spacing
/// above it; with `of = "failure"` through the highest that has moved by less than `moved` since the
/// start, wherever that is: the limit between the soil that failed and that which did not. With
/// `of = "limit"` it goes half a spacing under the lowest particle of a column that is faster than
/// `threshold` now, and along the surface where none is: the limit of a moving bed
/// (`bed-lines`). Between
/// two particles the line is straight, beyond the last ones level; a column without a particle
/// interrupts it. Points of the reference without a line do not count in the first and the last value:
/// read the share, too. Without any they are NaN. A steep line is nearer than it is high.
///
/// Displacements are kept for such probes only.
///
/// Source: ours; the thresholds as in Ghaïtanellis 2017, §5.3.2 and Eq. 5.21.
///
/// ```toml
/// [probe.failure]
/// kind = "line"
/// of = "failure"
/// moved = "1.5 mm"
/// file = "data/bui2008_final_failure.csv"
/// ```
#[plugin(ProbeEntry [2], "line", "free surface, failure line or limit of motion of a phase against a drawn line",
    source: "highest particles; Ghaïtanellis 2017, §5.3.2, Eq. 5.21")]
pub struct Line {
    /// The line: `surface`, `failure` or `limit`.
    #[parameter(default)]
    pub of: LineOf,
    /// CSV file of the reference, relative to the scene's folder: x and y in m.
    pub file: String,
    /// Displacement from which on a particle has failed.
    #[parameter(default: 1.5e-3, unit: "m", above: 0.0, source: "Ghaïtanellis 2017, §5.3.2")]
    pub moved: f64,
    /// Speed above which a particle moves, for `of = "limit"`.
    #[parameter(default: 0.2, unit: "m/s", above: 0.0, source: "Ghaïtanellis 2017, Eq. 5.21")]
    pub threshold: f64,
    /// Name of the phase; all particles if left out.
    pub phase: Option<String>,
    #[serde(skip)]
    number: Option<u32>,
    #[serde(skip)]
    reference: Vec<[f64; 2]>,
}

impl Line {
    /// The line over the reference.
    fn drawn(&self, world: &World<2>) -> Result<Columns, StepError> {
        let counted = CountedPhase::in_phase(world, self.phase.as_deref(), self.number)?;
        let positions = world.free.get(fields::POSITION)?;
        // Particles far away from the reference make no columns: these must fit into memory.
        let xs = self.reference.iter().map(|[x, _]| *x);
        let through = |end, has: &dyn Fn(usize) -> bool| {
            let mut columns = Columns::over(xs.clone(), world.spacing, end);
            let all = positions.iter().enumerate();
            all.filter(|(k, _)| counted.has(*k) && has(*k))
                .for_each(|(_, x)| columns.put(x));
            columns
        };
        Ok(match self.of {
            LineOf::Surface => through(End::Highest, &|_| true),
            LineOf::Failure => {
                let moved = world.free.get(fields::DISPLACEMENT)?;
                through(End::Highest, &|k| moved[k].norm() < self.moved)
            }
            LineOf::Limit => {
                let velocity = world.free.get(fields::VELOCITY)?;
                let moves = |k: usize| velocity[k].norm() > self.threshold;
                through(End::Lowest, &moves).or(&through(End::Highest, &|_| true))
            }
        })
    }
}

impl Probe<2> for Line {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[(".rms", "m"), (".share", "1"), (".distance", "m")])
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        self.number = phase::number(self.phase.as_deref(), scene)?;
        Ok(())
    }

    fn file(&self) -> Option<&str> {
        Some(&self.file)
    }

    fn load_reference(&mut self, rows: Vec<[f64; 2]>) -> Result<(), String> {
        if rows.is_empty() || rows.iter().flatten().any(|v| !v.is_finite()) {
            return Err("is no line: expected rows of x and y".into());
        }
        self.reference = rows;
        Ok(())
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            displacement: self.of == LineOf::Failure,
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<2>) -> Result<Vec<f64>, StepError> {
        let line = self.drawn(world)?;
        let (mut heights, mut distances, mut count) = (0.0, 0.0, 0_usize);
        for [x, y] in &self.reference {
            if let (Some(height), Some(distance)) = (line.height(*x), line.distance([*x, *y])) {
                heights += (height - y).powi(2);
                distances += distance.powi(2);
                count += 1;
            }
        }
        let rms = |squares: f64| match count {
            0 => f64::NAN,
            count => (squares / count as f64).sqrt(),
        };
        let share = count as f64 / self.reference.len().max(1) as f64;
        Ok(vec![rms(heights), share, rms(distances)])
    }
}
