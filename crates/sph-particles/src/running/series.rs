//! Rows of `series.csv`: balances and probes, and their extremes.

use crate::failure::error::Result;
use crate::results::balance::Balance;
use crate::setup::{Assembled, Probes};
use crate::zones::Coupling;

/// Extremes of the rows so far.
#[derive(Clone, Copy, Debug)]
pub struct Extrema {
    /// Least and largest density ratio over all rows.
    pub density_range: [f64; 2],
    /// Highest energy, J, largest speed over the speed of sound, and largest share of the mass beyond [`FAST`], over all
    /// rows.
    pub peaks: [f64; 3],
    /// Largest |energy| over all rows, J.
    pub energy_scale: f64,
    /// Largest Σ m|u| over all rows.
    pub momentum_scale: f64,
}

/// Names and units of all columns, with the labels of exits.
pub fn columns<const D: usize>(left: &[String], probes: &Probes<D>) -> Vec<(String, String)> {
    let mut columns = Vec::new();
    let mut add = |name: String, unit: &str| columns.push((name, unit.to_string()));
    for name in ["time", "dt"] {
        add(name.into(), "s");
    }
    for axis in &["x", "y", "z"][..D] {
        add(format!("momentum.{axis}"), "kg m/s");
    }
    for (name, unit, _) in Balance::<D>::zero().columns() {
        add(name.into(), unit);
    }
    for label in left {
        add(label.clone(), "kg");
        add(format!("{label}.particles"), "1");
    }
    for (name, probe) in probes {
        for column in probe.columns() {
            add(format!("{name}{}", column.suffix), column.unit);
        }
    }
    columns
}

impl Extrema {
    /// Of no row.
    pub const NONE: Extrema = Extrema {
        density_range: [f64::INFINITY, f64::NEG_INFINITY],
        peaks: [f64::NEG_INFINITY, 0.0, 0.0],
        energy_scale: 0.0,
        momentum_scale: 0.0,
    };

    /// Measures a row; forces on walls have been [measured](crate::setup::measure_walls).
    pub fn row<const D: usize>(
        &mut self,
        shown: &Assembled<D>,
        zones: &Coupling<D>,
    ) -> Result<(Vec<f64>, Balance<D>)> {
        let flow = &shown.flow;
        let balance = Balance::from_flow(flow)?;
        let mut row = vec![flow.world.time, flow.world.dt];
        row.extend(balance.momentum.iter());
        row.extend(balance.columns().map(|(.., value)| value));
        for (_, left) in flow.left().take(flow.outlets.labels().len()) {
            row.extend([left.mass, left.particles as f64]);
        }
        for (name, probe) in &shown.probes {
            let (probe, world) = zones.measuring(name).unwrap_or((&**probe, &flow.world));
            probe
                .as_gathers()
                .map_or(Ok(()), |sums| sums.gather(world))?;
            row.extend(probe.measure(world)?);
        }
        let ([least, largest], [low, high]) = (self.density_range, balance.density_range);
        self.density_range = [least.min(low), largest.max(high)];
        let parts = [balance.kinetic, balance.potential, balance.internal];
        let energy = balance.energy().abs();
        let largest = parts.iter().fold(energy, |m, e| m.max(e.abs()));
        let fast = balance.faster[0] / balance.mass.max(f64::MIN_POSITIVE);
        let now = [balance.energy(), balance.mach, fast];
        self.peaks = std::array::from_fn(|k| self.peaks[k].max(now[k]));
        self.energy_scale = self.energy_scale.max(largest);
        self.momentum_scale = self.momentum_scale.max(balance.momentum_scale);
        Ok((row, balance))
    }
}
