//! Probes that are measurements with a name of their own.

use std::sync::OnceLock;

use sph_core::{StepError, fields};
use sph_neighbours::World;

use super::quantity::{AXES, Quantity, Reduce, WeightedValues};
use crate::phases::phase::{self, CountedPhase};
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
        }
    }

    pub fn and_spacings(mut self, spacings: f64) -> Self {
        self.spacings = spacings;
        self
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
pub(crate) struct MeasuringProbe {
    pub phase: Option<String>,
    pub number: Option<u32>,
    pub conditions: Vec<QuantityBounds>,
    pub weight: Option<Quantity>,
    pub columns: Vec<PlannedColumn>,
    /// The axis and the width of slices, in spacings, in which the columns are curves.
    pub slices: Option<(usize, f64)>,
    /// The axis along which the first quantity is fitted by a line.
    pub fitted: Option<usize>,
    /// The units of the quantities of the columns, known from the first measurement on.
    pub units: OnceLock<Vec<&'static str>>,
}

impl MeasuringProbe {
    /// Columns of all particles of a phase.
    pub fn of_phase(phase: Option<String>, columns: impl Into<Vec<PlannedColumn>>) -> Self {
        MeasuringProbe {
            phase,
            columns: columns.into(),
            ..MeasuringProbe::default()
        }
    }

    /// The numbers of the particles of the phase that fulfil all conditions, and of all particles of the phase.
    fn counted<const D: usize>(&self, world: &World<D>) -> Result<[Vec<usize>; 2], StepError> {
        let phase = CountedPhase::in_phase(world, self.phase.as_deref(), self.number)?;
        let of_phase: Vec<usize> = (0..world.free.len()).filter(|k| phase.has(*k)).collect();
        let mut all = of_phase.clone();
        for (of, [above, below]) in &self.conditions {
            let (value, _) = of.values(world)?;
            all.retain(|k| value(*k) > *above && value(*k) < *below);
        }
        Ok([all, of_phase])
    }

    /// The columns of the particles that count, of a phase with so much weight.
    fn reduced<const D: usize>(
        &self,
        world: &World<D>,
        (counted, of_phase): (&[usize], &[usize]),
    ) -> Result<Vec<f64>, StepError> {
        let weight = self.weight.as_ref().map(|weight| weight.values(world));
        let weight = weight.transpose()?.map(|(weight, _)| weight);
        let weights = |of: &[usize]| -> Option<Vec<f64>> {
            let weight = weight.as_ref()?;
            Some(of.iter().map(|k| weight(*k)).collect())
        };
        let own = weights(counted);
        let whole = weights(of_phase).map_or(of_phase.len() as f64, |all| all.iter().sum());
        let mut units = Vec::new();
        let one = |column: &PlannedColumn| {
            let (value, unit) = column.of.values(world)?;
            units.push(unit);
            let values: Vec<f64> = counted.iter().map(|k| value(*k)).collect();
            let weighed = WeightedValues {
                values: &values,
                weights: own.as_deref(),
                whole,
            };
            Ok(weighed.reduced(column.reduce) / column.scale + column.spacings * world.spacing)
        };
        let all: Result<Vec<f64>, StepError> = self.columns.iter().map(one).collect();
        self.units.get_or_init(|| units);
        all
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
        let mut columns = self.reduced(world, (&all, &of_phase))?;
        if let Some(axis) = self.fitted {
            let (value, _) = self.columns[0].of.values(world)?;
            let (place, _) = Quantity::named(AXES[axis]).values(world)?;
            let (x, y): (Vec<f64>, Vec<f64>) = all.iter().map(|k| (place(*k), value(*k))).unzip();
            columns.extend(norm::line(&x, &y));
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
        let (axis, width) = (axis.min(D - 1), spacings * world.spacing);
        let [all, of_phase] = self.counted(world)?;
        let positions = world.free.get(fields::POSITION)?;
        let slice = |k: &usize| (positions[*k][axis] / width).floor() as i64;
        let mut slices: std::collections::BTreeMap<i64, Vec<usize>> = Default::default();
        for k in &all {
            slices.entry(slice(k)).or_default().push(*k);
        }
        let rows = slices.iter().map(|(slice, own)| {
            let mut row = vec![(*slice as f64 + 0.5) * width];
            row.extend(self.reduced(world, (own, &of_phase))?);
            Ok(row)
        });
        rows.collect()
    }
}
