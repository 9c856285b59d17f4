//! What probes and reference solutions are.

use sph_core::{StepError, Vect, contract};
use sph_neighbours::World;

/// A column that a probe adds to the time series.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProbeColumn {
    /// Appended to the probe's name; empty for a probe with one column.
    pub suffix: String,
    /// SI unit.
    pub unit: &'static str,
}

impl ProbeColumn {
    /// The only column of a probe.
    pub fn only(unit: &'static str) -> Vec<ProbeColumn> {
        vec![ProbeColumn::named("", unit)]
    }

    /// One of several columns.
    pub fn named(suffix: &str, unit: &'static str) -> ProbeColumn {
        ProbeColumn {
            suffix: suffix.into(),
            unit,
        }
    }
}

/// Something measured at every row of the time series.
pub trait Probe<const D: usize>: Send {
    /// The columns it adds.
    fn columns(&self) -> Vec<ProbeColumn>;
    /// Learns the scene's phases: their names in the order of their numbers.
    ///
    /// # Errors
    /// If the probe names a phase that is not among them: what is wrong with its key `phase`.
    fn name_phases(&mut self, _names: &[String]) -> Result<(), String> {
        Ok(())
    }
    /// The wall whose force it reads; forces are measured on such walls only.
    fn force_on(&self) -> Option<&str> {
        None
    }
    /// Whether it reads neighbour lists, contacts, or what walls carry besides forces, and not columns alone: where several
    /// ranks run a flow, the first computes these for such probes only.
    fn looks_around(&self) -> bool {
        false
    }
    /// Whether it reads the displacement of the particles, which is kept for such probes only.
    fn needs_displacement(&self) -> bool {
        false
    }
    /// Whether it reads the work of everybody on the particles, which is booked for such probes only.
    fn needs_books(&self) -> bool {
        false
    }
    /// Names of derived fields that are computed for such probes only.
    fn fields(&self) -> Vec<&str> {
        Vec::new()
    }
    /// The columns of its curves, none for a probe without: a table is written with every output of
    /// fields, `curves/NAME_0003.csv`.
    fn curve_columns(&self) -> Vec<ProbeColumn> {
        Vec::new()
    }
    /// The rows of its curves now; NaN where there is nothing to measure.
    ///
    /// # Errors
    /// If a column of the flow is missing.
    fn curves(&self, _world: &World<D>) -> Result<Vec<Vec<f64>>, StepError> {
        Ok(Vec::new())
    }
    /// Which of these columns is drawn, `pictures/NAME_0003.png`, as a map over the first two.
    fn drawn_column(&self) -> Option<usize> {
        None
    }
    /// Takes the flow at a row of the series into what it gathers over time.
    ///
    /// # Errors
    /// If a column of the flow is missing.
    fn gather(&self, _world: &World<D>) -> Result<(), StepError> {
        Ok(())
    }
    /// What it has gathered, bit by bit, for checkpoints; empty if it gathers nothing.
    fn gathered(&self) -> Vec<u64> {
        Vec::new()
    }
    /// Goes on with what a run that is resumed had gathered.
    fn recall(&self, _gathered: &[u64]) {}
    /// The file that its key `file` names, if it compares with one.
    fn file(&self) -> Option<&str> {
        None
    }
    /// Learns the first two columns of that file.
    ///
    /// # Errors
    /// If they are not what the probe compares with: what is wrong with them.
    fn learn(&mut self, _rows: Vec<[f64; 2]>) -> Result<(), String> {
        Ok(())
    }
    /// Their values now; NaN where there is nothing to measure.
    ///
    /// # Errors
    /// If a column of the flow is missing.
    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError>;
}

contract!(
    /// A probe that a scene may name.
    pub ProbeEntry, "probe", "what is measured over time", Probe<D>
);

/// An analytical flow.
pub trait Solution<const D: usize>: Send + Sync {
    /// Velocity, m/s, if the solution has one.
    fn velocity(&self, _position: &Vect<D>, _time: f64) -> Option<Vect<D>> {
        None
    }
    /// Pressure, Pa, if the solution has one.
    fn pressure(&self, _position: &Vect<D>, _time: f64) -> Option<f64> {
        None
    }
    /// d ln(kinetic energy)/dt, 1/s, if it is constant.
    fn energy_rate(&self) -> Option<f64> {
        None
    }
}

contract!(
    /// A solution that a scene may name, as a reference or as an initial state.
    pub SolutionEntry, "solution", "analytical flows: references and initial states", Solution<D>
);
