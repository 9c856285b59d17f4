//! Probes that are measurements with a name of their own.

use std::sync::OnceLock;

use sph_core::StepError;
use sph_neighbours::World;

use super::level::highest_place;
use super::particles::{AXES, MeasuredParticles};
use super::quantity::{Quantity, Reduce, WeightedValues};
use crate::phases::phase;
use crate::{Curves, Needs, Probe, ProbeColumn, ProbeScene, norm};

/// Bounds on a quantity, the lower and the upper one: a particle on a bound does not count.
pub(crate) type QuantityBounds = (Quantity, [f64; 2]);

/// above < quantity.
pub(crate) fn above(name: &str, above: f64) -> QuantityBounds {
    (Quantity::named(name), [above, f64::INFINITY])
}

/// quantity < below.
pub(crate) fn below(name: &str, below: f64) -> QuantityBounds {
    (Quantity::named(name), [f64::NEG_INFINITY, below])
}

/// A column of a measurement: reduced/`scale` + `spacings` · δr.
pub(crate) struct PlannedColumn {
    pub suffix: String,
    pub of: Quantity,
    pub reduce: Reduce,
    pub scale: f64,
    pub spacings: f64,
    /// The value whose highest place is the column, in place of a reduction.
    pub level: Option<f64>,
    /// The units in the plane and in space, where they are not that of the quantity.
    pub units: Option<[&'static str; 2]>,
}

impl PlannedColumn {
    pub fn new(suffix: &str, name: &str, reduce: impl Into<Reduce>) -> Self {
        let of = Quantity::named(name);
        PlannedColumn {
            suffix: suffix.into(),
            units: of.unit().map(|unit| [unit; 2]),
            of,
            reduce: reduce.into(),
            scale: 1.0,
            spacings: 0.0,
            level: None,
        }
    }

    pub fn and_spacings(mut self, spacings: f64) -> Self {
        self.spacings = spacings;
        self
    }

    /// The highest place at which the mean over a spacing comes up to a value.
    pub fn at_level(self, value: f64) -> Self {
        PlannedColumn {
            level: Some(value),
            ..self.in_units(["m"; 2])
        }
    }

    /// In units of its own, in the plane and in space.
    pub fn in_units(mut self, units: [&'static str; 2]) -> Self {
        self.units = Some(units);
        self
    }

    /// Over a number; without a unit where that is not 1.
    pub fn over(mut self, scale: f64) -> Self {
        if scale != 1.0 {
            self.scale = scale;
            self.units = Some(["1"; 2]);
        }
        self
    }
}

/// A measurement: the particles that count, their weights, and the quantities that are reduced.
#[derive(Default)]
pub struct MeasuringProbe {
    pub(crate) phase: Option<String>,
    pub(crate) number: Option<u32>,
    pub(crate) conditions: Vec<QuantityBounds>,
    pub(crate) weight: Option<Quantity>,
    pub(crate) columns: Vec<PlannedColumn>,
    /// The axis and the width of slices, in spacings, in which the columns are curves.
    pub(crate) slices: Option<(usize, f64)>,
    /// The axis along which the first quantity is fitted by a line.
    pub(crate) fitted: Option<usize>,
    /// The units of the quantities of the columns, known from the first measurement on.
    pub(crate) units: OnceLock<Vec<&'static str>>,
}

/// The numbers of the particles of a phase that fulfil all conditions, and of all particles of the phase.
type CountedNumbers = [Vec<usize>; 2];

/// Values of columns, and their units.
type NumbersWithUnits<U> = (Vec<f64>, Vec<U>);

impl MeasuringProbe {
    /// Columns of all particles of a phase.
    pub(crate) fn of_phase(phase: Option<String>, columns: impl Into<Vec<PlannedColumn>>) -> Self {
        MeasuringProbe {
            phase,
            columns: columns.into(),
            ..MeasuringProbe::default()
        }
    }

    /// The same of the phase with this number; a scene gives it to a probe.
    pub fn with_phase_number(self, number: Option<u32>) -> Self {
        MeasuringProbe { number, ..self }
    }

    /// The columns: one for each reduction.
    ///
    /// # Errors
    /// If the particles lack a quantity.
    pub fn values<const D: usize, P: MeasuredParticles<D>>(
        &self,
        of: &P,
    ) -> Result<Vec<f64>, P::Error> {
        let [counted, of_phase] = self.counted(of)?;
        Ok(self.reduced(of, (&counted, &of_phase))?.0)
    }

    /// The line of least squares through the first quantity over an axis: its slope, the root mean square about it, and
    /// its value where the coordinate is zero.
    ///
    /// # Errors
    /// If the particles lack a quantity.
    pub fn line<const D: usize, P: MeasuredParticles<D>>(
        &self,
        of: &P,
        axis: usize,
    ) -> Result<[f64; 3], P::Error> {
        let [counted, _] = self.counted(of)?;
        let (value, _) = self.columns[0].of.values(of)?;
        let (place, _) = Quantity::named(AXES[axis]).values(of)?;
        let pairs = counted.iter().map(|k| (place(*k), value(*k)));
        let (x, y): (Vec<f64>, Vec<f64>) = pairs.unzip();
        let [slope, rms] = norm::line(&x, &y);
        let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
        Ok([slope, rms, mean(&y) - slope * mean(&x)])
    }

    /// Rows of the slices across an axis that are so wide, m: the middle of the slice and the columns of its particles.
    ///
    /// # Errors
    /// If the particles lack a quantity.
    pub fn profile<const D: usize, P: MeasuredParticles<D>>(
        &self,
        of: &P,
        (axis, width): (usize, f64),
    ) -> Result<Vec<Vec<f64>>, P::Error> {
        let [all, of_phase] = self.counted(of)?;
        let positions = of.positions()?;
        let slice = |k: &usize| (positions[*k][axis] / width).floor() as i64;
        let mut slices: std::collections::BTreeMap<i64, Vec<usize>> = Default::default();
        for k in &all {
            slices.entry(slice(k)).or_default().push(*k);
        }
        let rows = slices.iter().map(|(slice, own)| {
            let mut row = vec![(*slice as f64 + 0.5) * width];
            row.extend(self.reduced(of, (own, &of_phase))?.0);
            Ok(row)
        });
        rows.collect()
    }

    fn counted<const D: usize, P: MeasuredParticles<D>>(
        &self,
        of: &P,
    ) -> Result<CountedNumbers, P::Error> {
        let in_phase = of.in_phase(self.phase.as_deref(), self.number)?;
        let of_phase: Vec<usize> = (0..of.count()).filter(|k| in_phase(*k)).collect();
        let mut all = of_phase.clone();
        for (quantity, [above, below]) in &self.conditions {
            let (value, _) = quantity.values(of)?;
            all.retain(|k| value(*k) > *above && value(*k) < *below);
        }
        Ok([all, of_phase])
    }

    /// The columns of the particles that count, of a phase with so much weight, and the units of their quantities.
    fn reduced<const D: usize, P: MeasuredParticles<D>>(
        &self,
        of: &P,
        (counted, of_phase): (&[usize], &[usize]),
    ) -> Result<NumbersWithUnits<P::Unit>, P::Error> {
        let weight = self.weight.as_ref().map(|weight| weight.values(of));
        let weight = weight.transpose()?.map(|(weight, _)| weight);
        let weights = |of: &[usize]| -> Option<Vec<f64>> {
            let weight = weight.as_ref()?;
            Some(of.iter().map(|k| weight(*k)).collect())
        };
        let own = weights(counted);
        let whole = weights(of_phase).map_or(of_phase.len() as f64, |all| all.iter().sum());
        let one = |column: &PlannedColumn| {
            let (value, unit) = column.of.values(of)?;
            let values: Vec<f64> = counted.iter().map(|k| value(*k)).collect();
            if let Some(wanted) = column.level {
                let positions = of.positions()?;
                let weight = |k: usize| own.as_ref().map_or(1.0, |own| own[k]);
                let samples = counted.iter().zip(&values).enumerate();
                let samples = samples.map(|(k, (n, v))| [positions[*n][D - 1], weight(k), *v]);
                let level = highest_place(samples.collect(), of.spacing(), wanted);
                return Ok((level, unit));
            }
            let weighed = WeightedValues {
                values: &values,
                weights: own.as_deref(),
                whole,
            };
            let value = weighed.reduced(column.reduce) / column.scale;
            Ok((value + column.spacings * of.spacing(), unit))
        };
        self.columns.iter().map(one).collect()
    }
}

impl<const D: usize> Probe<D> for MeasuringProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        let known = |k: usize| self.units.get().and_then(|units| units.get(k)).copied();
        let columns = self.columns.iter().enumerate();
        let one = |(k, column): (usize, &PlannedColumn)| {
            let unit = column.units.map(|units| units[D - 2]).or(known(k));
            ProbeColumn::named(&column.suffix, unit.unwrap_or("1"))
        };
        let mut all: Vec<_> = columns.map(one).collect();
        if self.fitted.is_some() {
            all.push(ProbeColumn::named(".slope", "1"));
            all.push(ProbeColumn::named(".rms_about", all[0].unit));
        }
        all
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        self.number = phase::number(self.phase.as_deref(), scene)?;
        Ok(())
    }

    fn needs(&self) -> Needs<'_> {
        let of_conditions = self.conditions.iter().map(|(of, _)| of);
        let all = self.columns.iter().map(|column| &column.of);
        let all = all.chain(of_conditions).chain(&self.weight);
        let fields = all.filter_map(|of| Some(of.column()?.to_string()));
        Needs {
            fields: fields.collect(),
            ..Needs::default()
        }
    }

    fn as_curves(&self) -> Option<&dyn Curves<D>> {
        self.slices.is_some().then_some(self)
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let [all, of_phase] = self.counted(world)?;
        let (mut columns, units) = self.reduced(world, (&all, &of_phase))?;
        self.units.get_or_init(|| units);
        if let Some(axis) = self.fitted {
            columns.extend(&self.line(world, axis)?[..2]);
        }
        Ok(columns)
    }
}

impl<const D: usize> Curves<D> for MeasuringProbe {
    fn curve_columns(&self) -> Vec<ProbeColumn> {
        let Some((axis, _)) = self.slices else {
            return Vec::new();
        };
        let columns = Probe::<D>::columns(self).into_iter();
        let own = columns.take(self.columns.len()).map(|column| ProbeColumn {
            suffix: match column.suffix.trim_start_matches('.') {
                "" => "value".into(),
                name => name.into(),
            },
            ..column
        });
        let axis = ProbeColumn::named(AXES[axis.min(D - 1)], "m");
        std::iter::once(axis).chain(own).collect()
    }

    fn curves(&self, world: &World<D>) -> Result<Vec<Vec<f64>>, StepError> {
        let Some((axis, spacings)) = self.slices else {
            return Ok(Vec::new());
        };
        let rows = self.profile(world, (axis.min(D - 1), spacings * world.spacing))?;
        if !rows.is_empty() && self.units.get().is_none() {
            let (_, units) = self.reduced(world, (&[], &[]))?;
            self.units.get_or_init(|| units);
        }
        Ok(rows)
    }
}
