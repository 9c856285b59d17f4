//! The traits of probes and reference solutions.

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
        ProbeColumn::several(&[("", unit)])
    }

    /// One of several columns.
    pub fn named(suffix: &str, unit: &'static str) -> ProbeColumn {
        let suffix = suffix.into();
        ProbeColumn { suffix, unit }
    }

    /// Several columns, each with its suffix and its unit.
    pub fn several(all: &[(&str, &'static str)]) -> Vec<ProbeColumn> {
        let named = |(suffix, unit): &(&str, &'static str)| ProbeColumn::named(suffix, unit);
        all.iter().map(named).collect()
    }

    /// The components of a rotation: one in the plane, three in space.
    pub fn turns(dimension: usize, unit: &'static str) -> Vec<ProbeColumn> {
        match dimension {
            2 => ProbeColumn::only(unit),
            _ => ProbeColumn::components(dimension, unit),
        }
    }

    /// The components of a vector in so many dimensions.
    pub fn components(dimension: usize, unit: &'static str) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[(".x", unit), (".y", unit), (".z", unit)][..dimension])
    }
}

/// The scene for probes.
#[derive(Clone, Copy, Debug, Default)]
pub struct ProbeScene<'a> {
    /// Names of the phases, in the order of their numbers.
    pub phases: &'a [String],
    /// Kinds of plugins that no crate of this project declares, of which the scene names some.
    pub strangers: &'a [&'static str],
}

/// Quantities that a probe reads and that are computed for such probes only.
#[derive(Clone, Debug, Default)]
pub struct Needs<'a> {
    /// The wall whose force it reads.
    pub force_on: Option<&'a str>,
    /// Neighbour lists, contacts, or columns of walls besides forces, and not columns of particles alone: where a flow
    /// is divided, one process computes these.
    pub around: bool,
    /// The displacement of the particles.
    pub displacement: bool,
    /// The work of all terms on the particles.
    pub books: bool,
    /// Names of derived fields.
    pub fields: Vec<String>,
}

/// Curves of a probe: a table is written with every output of fields, `curves/NAME_0003.csv`.
pub trait Curves<const D: usize> {
    /// The columns of the table.
    fn curve_columns(&self) -> Vec<ProbeColumn>;
    /// The rows now; NaN where there is nothing to measure.
    ///
    /// # Errors
    /// If a column of the flow is missing.
    fn curves(&self, world: &World<D>) -> Result<Vec<Vec<f64>>, StepError>;
    /// Column that is drawn, `pictures/NAME_0003.png`, as a map over the first two.
    fn drawn_column(&self) -> Option<usize> {
        None
    }
}

/// Sums of a probe over the rows of the series.
pub trait Gathers<const D: usize> {
    /// Takes the flow at a row into the sums.
    ///
    /// # Errors
    /// If a column of the flow is missing.
    fn gather(&self, world: &World<D>) -> Result<(), StepError>;
    /// The sums, bit by bit, for checkpoints.
    fn gathered(&self) -> Vec<u64>;
    /// Goes on with the sums of a run that is resumed.
    fn recall(&self, gathered: &[u64]);
}

/// Something measured at every row of the time series.
pub trait Probe<const D: usize>: Send {
    /// The columns it adds.
    fn columns(&self) -> Vec<ProbeColumn>;
    /// Learns the scene.
    ///
    /// # Errors
    /// If the probe names a phase that is not in the scene: the fault of its key `phase`.
    fn prepare(&mut self, _scene: &ProbeScene<'_>) -> Result<(), String> {
        Ok(())
    }
    /// Quantities that are computed for such probes only.
    fn needs(&self) -> Needs<'_> {
        Needs::default()
    }
    /// Its curves, if it has some.
    fn as_curves(&self) -> Option<&dyn Curves<D>> {
        None
    }
    /// Its sums over time, if it has some.
    fn as_gathers(&self) -> Option<&dyn Gathers<D>> {
        None
    }
    /// The file that its key `file` names, if it compares with one.
    fn file(&self) -> Option<&str> {
        None
    }
    /// Learns the first two columns of that file.
    ///
    /// # Errors
    /// If they are not what the probe compares with: what is wrong with them.
    fn load_reference(&mut self, _rows: Vec<[f64; 2]>) -> Result<(), String> {
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
    pub ProbeEntry, "probe", Probe, "a measurement over time", Probe<D>
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
    /// Any other scalar field, in its unit, if the solution has it.
    fn scalar(&self, _field: &str, _position: &Vect<D>, _time: f64) -> Option<f64> {
        None
    }
    /// d ln(kinetic energy)/dt, 1/s, if it is constant.
    fn energy_rate(&self) -> Option<f64> {
        None
    }
}

contract!(
    /// A solution that a scene may name, as a reference or as an initial state.
    pub SolutionEntry, "solution", Solution, "analytical flows: references and initial states", Solution<D>
);
