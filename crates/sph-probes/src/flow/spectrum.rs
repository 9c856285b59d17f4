//! The energy spectrum of a periodic box.

use std::f64::consts::TAU;

use sph_core::{StepError, Vect, fields, plugin};
use sph_neighbours::World;

use crate::{Probe, ProbeColumn, ProbeEntry};

/// E(k) = ½ Σ |û|²/(2π/L) over the wave vectors whose length, in 2π/L, rounds to n, k = 2πn/L: the curve, up to the wave of two
/// grid points. The columns are ∫ E dk, m²/s², and the wavenumber of the largest E, 1/m.
///
/// Velocities are Shepard means at the points of a grid, which lessen waves of few smoothing lengths; the sums over the grid are
/// discrete Fourier transforms axis by axis. The box is periodic along all axes, with sides of one length.
///
/// Source: Pope 2000, Eq. 6.189; the grid is ours.
///
/// ```toml
/// [probe.spectrum]
/// kind = "energy-spectrum"
/// points = 32
/// ```
#[plugin(ProbeEntry [2, 3], "energy-spectrum", "energy of waves in a periodic box", source: "Pope 2000, Eq. 6.189")]
pub struct EnergySpectrum {
    /// Points of the grid along an axis.
    #[parameter(min: 4, max: 128)]
    pub points: usize,
}

type Complex = [f64; 2];

impl EnergySpectrum {
    fn side<const D: usize>(&self, world: &World<D>) -> Result<f64, StepError> {
        let domain = &world.domain;
        let side = domain.length(0);
        let same = |k: usize| domain.periodic[k] && (domain.length(k) / side - 1.0).abs() < 1e-9;
        let reason = match (0..D).all(same) {
            true if (4..=128).contains(&self.points) => return Ok(side),
            true => "4 to 128 `points` were expected",
            false => {
                "a box that is periodic along all axes, with sides of one length, was expected: `[numerics.periodic]`"
            }
        };
        Err(StepError::stage("probe `energy-spectrum`", reason))
    }

    /// Velocities at the points, the first axis running fastest.
    fn at_points<const D: usize>(
        &self,
        world: &World<D>,
        side: f64,
    ) -> Result<Vec<Vect<D>>, StepError> {
        let n = self.points;
        let step = side / n as f64;
        let positions = world.free.get(fields::POSITION)?;
        let velocities = world.free.get(fields::VELOCITY)?;
        let volumes = world.free.get(fields::VOLUME)?;
        let radius = world.kernel.support_radius();
        let reach = (radius / step).ceil() as i64;
        let width = (2 * reach + 1) as usize;
        let mut sums = vec![(0.0, Vect::<D>::zeros()); n.pow(D as u32)];
        let low = world.domain.lower;
        for (i, x) in positions.iter().enumerate() {
            let nearest: [i64; D] =
                std::array::from_fn(|k| ((x[k] - low[k]) / step).round() as i64);
            for number in 0..width.pow(D as u32) {
                let (mut rest, mut index, mut stride) = (number, 0, 1);
                let mut apart = Vect::<D>::zeros();
                for k in 0..D {
                    let cell = nearest[k] + (rest % width) as i64 - reach;
                    rest /= width;
                    apart[k] = low[k] + cell as f64 * step - x[k];
                    index += stride * cell.rem_euclid(n as i64) as usize;
                    stride *= n;
                }
                let r = apart.norm();
                if r < radius {
                    let weight = volumes[i] * world.kernel.at(r).0;
                    sums[index].0 += weight;
                    sums[index].1 += velocities[i] * weight;
                }
            }
        }
        let mean = |(weight, sum): &(f64, Vect<D>)| match *weight > 0.0 {
            true => sum / *weight,
            false => Vect::zeros(),
        };
        Ok(sums.iter().map(mean).collect())
    }

    /// Wavenumbers and E, 1/m and m³/s².
    fn shells<const D: usize>(&self, world: &World<D>) -> Result<Vec<[f64; 2]>, StepError> {
        let side = self.side(world)?;
        let n = self.points;
        let velocities = self.at_points(world, side)?;
        let mut energy = vec![0.0; n / 2 + 1];
        for component in 0..D {
            let values = velocities.iter().map(|u| [u[component], 0.0]);
            let transformed = transformed::<D>(values.collect(), n);
            for (index, value) in transformed.iter().enumerate() {
                let (mut rest, mut squared) = (index, 0);
                for _ in 0..D {
                    let wave = (rest % n) as i64;
                    rest /= n;
                    let wave = if wave > n as i64 / 2 {
                        wave - n as i64
                    } else {
                        wave
                    };
                    squared += wave * wave;
                }
                let shell = (squared as f64).sqrt().round() as usize;
                if let Some(sum) = energy.get_mut(shell) {
                    *sum += 0.5 * (value[0] * value[0] + value[1] * value[1]);
                }
            }
        }
        let first = TAU / side;
        let shells = energy.iter().enumerate().skip(1);
        Ok(shells.map(|(s, e)| [first * s as f64, e / first]).collect())
    }
}

/// Discrete Fourier transform over all axes, over the number of points.
fn transformed<const D: usize>(mut values: Vec<Complex>, n: usize) -> Vec<Complex> {
    let turn = |k: usize| {
        let angle = -TAU * k as f64 / n as f64;
        [angle.cos(), angle.sin()]
    };
    let turns: Vec<Complex> = (0..n).map(turn).collect();
    for axis in 0..D {
        let stride = n.pow(axis as u32);
        let before = values.clone();
        for (index, value) in values.iter_mut().enumerate() {
            let wave = index / stride % n;
            let start = index - wave * stride;
            let mut sum = [0.0; 2];
            for k in 0..n {
                let [re, im] = before[start + k * stride];
                let [cos, sin] = turns[wave * k % n];
                sum[0] += re * cos - im * sin;
                sum[1] += re * sin + im * cos;
            }
            *value = sum.map(|part| part / n as f64);
        }
    }
    values
}

impl<const D: usize> Probe<D> for EnergySpectrum {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[(".energy", "m²/s²"), (".peak", "1/m")])
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let shells = self.shells(world)?;
        let total: f64 = shells.iter().map(|[_, e]| e * shells[0][0]).sum();
        let peak = shells.iter().max_by(|a, b| a[1].total_cmp(&b[1]));
        Ok(vec![total, peak.map_or(f64::NAN, |p| p[0])])
    }

    fn curve_columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[("wavenumber", "1/m"), ("energy", "m³/s²")])
    }

    fn curves(&self, world: &World<D>) -> Result<Vec<Vec<f64>>, StepError> {
        let rows = self.shells(world)?;
        Ok(rows.into_iter().map(|row| row.to_vec()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// cos(2π·3x) sin(2π·4y): four waves of 5, each of a quarter; Parseval: ½ ⟨u²⟩ = 1/8.
    #[test]
    fn waves_stand_in_their_shell() {
        let n = 16;
        let wave = |index: usize| {
            let [x, y] = [index % n, index / n].map(|k| TAU * k as f64 / n as f64);
            [(3.0 * x).cos() * (4.0 * y).sin(), 0.0]
        };
        let found = transformed::<2>((0..n * n).map(wave).collect(), n);
        let size = |v: &Complex| v[0] * v[0] + v[1] * v[1];
        for (index, value) in found.iter().enumerate() {
            let own = [3, n - 3].contains(&(index % n)) && [4, n - 4].contains(&(index / n));
            let expected = if own { 1.0 / 16.0 } else { 0.0 };
            assert!((size(value) - expected).abs() < 1e-14, "{index}");
        }
        let total: f64 = found.iter().map(size).sum();
        assert!((0.5 * total - 0.125).abs() < 1e-14);
    }
}
