//! Flows on grids: the stream function over a box, and the energy spectrum of a periodic one.

use std::f64::consts::TAU;

use serde::{Deserialize, Deserializer};
use sph_core::{StepError, Vect, fields, plugin};
use sph_neighbours::World;

use crate::sampling::NearbyParticles;
use crate::{Curves, Probe, ProbeColumn, ProbeEntry};

/// The largest |ψ| with ψ(x, y) = ∫ u_x dy′ from the bottom y₀ of a box, and its place: the
/// strength and the centre of a vortex.
///
/// The velocity at the points of a grid is a Shepard mean of the particles, zero on the bottom, which is a wall, and
/// where there is no fluid. A mean is not a value: it smooths with an error of h² u″. `corrections` adds the means of
/// what the particles differ by from their own mean, which leaves h⁴ for the first time. The integral is that of
/// trapezia, and the extreme the top of parabolas through the largest value on the grid and its neighbours: both are
/// second order in the spacing of the grid. Without particles the values are NaN.
///
/// The box must hold the vortex, and the flow must be that of an incompressible fluid, in 2D.
///
/// Source: ours; corrections as in Stolz & Adams 1999, Eq. 5.
///
/// ```toml
/// [probe.vortex]
/// kind = "stream-function"
/// box = [[0.0, 0.0], [1.0, 1.0]]
/// ```
#[plugin(ProbeEntry [2], "stream-function", "largest stream function in a box and its place: strength of a vortex",
    source: "integral of Shepard means; Stolz & Adams 1999, Eq. 5")]
pub struct StreamFunction {
    /// Two opposite corners of the box, the lower left one first.
    #[serde(rename = "box", deserialize_with = "ordered")]
    #[parameter(unit: "m")]
    pub corners: [[f64; 2]; 2],
    /// Spacing of the grid; half of that of the particles if left out.
    #[parameter(unit: "m", above: 0.0)]
    pub grid: Option<f64>,
    /// Number of corrections of the mean.
    #[parameter(default, max: 4)]
    pub corrections: u32,
}

/// Most points of the grid along a side: a scene may be wrong, and a grid must fit into memory.
const MOST: f64 = 4096.0;

/// Corners of which the first is below and left of the second.
fn ordered<'de, D: Deserializer<'de>>(from: D) -> Result<[[f64; 2]; 2], D::Error> {
    let corners = <[[f64; 2]; 2]>::deserialize(from)?;
    let [low, high] = corners;
    match low[0] < high[0] && low[1] < high[1] {
        true => Ok(corners),
        false => Err(serde::de::Error::custom(format!(
            "`box` must have its lower left corner first, found {low:?} and {high:?}"
        ))),
    }
}

/// ψ on a grid, columns of constant x one after another.
struct Grid {
    values: Vec<f64>,
    /// Points along each side.
    points: [usize; 2],
    /// Spacing along each side, m.
    step: [f64; 2],
}

impl StreamFunction {
    fn grid(&self, world: &World<2>, near: &NearbyParticles, velocity: &[f64]) -> Grid {
        let [low, high] = self.corners;
        let wanted = self.grid.unwrap_or(0.5 * world.spacing);
        let cells = [0, 1].map(|k| ((high[k] - low[k]) / wanted).round().clamp(2.0, MOST));
        let step = [0, 1].map(|k| (high[k] - low[k]) / cells[k]);
        let points = cells.map(|n| n as usize + 1);
        let mut values = Vec::with_capacity(points[0] * points[1]);
        for i in 0..points[0] {
            let (mut psi, mut before) = (0.0, 0.0);
            values.push(psi);
            for j in 1..points[1] {
                let x = low[0] + i as f64 * step[0];
                let at = Vect::from([x, low[1] + j as f64 * step[1]]);
                let u = near.mean(&*world.kernel, &at, velocity).unwrap_or(0.0);
                psi += 0.5 * step[1] * (before + u);
                before = u;
                values.push(psi);
            }
        }
        Grid {
            values,
            points,
            step,
        }
    }
}

impl Grid {
    /// |ψ| at the top of the parabolas through the largest value, and its place from the corner.
    fn extreme(&self) -> [f64; 3] {
        let [nx, ny] = self.points;
        let mut most = 0;
        for (k, psi) in self.values.iter().enumerate() {
            if psi.abs() > self.values[most].abs() {
                most = k;
            }
        }
        let (i, j) = (most / ny, most % ny);
        let middle = self.values[most].abs();
        let sign = self.values[most].signum();
        // Shift in steps and rise of the parabola through three values of which the middle is largest.
        let top = |inside: bool, below: usize, above: usize| {
            if !inside {
                return [0.0, 0.0];
            }
            let [a, b] = [below, above].map(|k| sign * self.values[k]);
            let curvature = a - 2.0 * middle + b;
            match curvature < 0.0 {
                true => {
                    let shift = 0.5 * (a - b) / curvature;
                    [shift, 0.25 * (b - a) * shift]
                }
                false => [0.0, 0.0],
            }
        };
        let along_x = top(i > 0 && i + 1 < nx, most.saturating_sub(ny), most + ny);
        let along_y = top(j > 0 && j + 1 < ny, most.saturating_sub(1), most + 1);
        [
            middle + along_x[1] + along_y[1],
            (i as f64 + along_x[0]) * self.step[0],
            (j as f64 + along_y[0]) * self.step[1],
        ]
    }
}

impl Probe<2> for StreamFunction {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[(".max", "m²/s"), (".x", "m"), (".y", "m")])
    }

    fn measure(&self, world: &World<2>) -> Result<Vec<f64>, StepError> {
        let velocity = world.free.get(fields::VELOCITY)?;
        let [low, high] = self.corners.map(Vect::from);
        // A correction reads the neighbours of neighbours.
        let near = NearbyParticles::new(world, low, high, 1 + self.corrections as usize)?;
        let along: Vec<f64> = near.numbers().map(|k| velocity[k][0]).collect();
        if along.is_empty() {
            return Ok(vec![f64::NAN; 3]);
        }
        // q is the averaged quantity: u, and then u with what its mean lacks.
        let mut q = along.clone();
        for _ in 0..self.corrections {
            let mean = near.means(&*world.kernel, &q);
            for ((q, u), mean) in q.iter_mut().zip(&along).zip(mean) {
                *q += u - mean;
            }
        }
        let [psi, x, y] = self.grid(world, &near, &q).extreme();
        Ok(vec![psi, low[0] + x, low[1] + y])
    }
}

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
        let (positions, velocities) = world.free.all((fields::POSITION, fields::VELOCITY))?;
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

    fn as_curves(&self) -> Option<&dyn Curves<D>> {
        Some(self)
    }
}

impl<const D: usize> Curves<D> for EnergySpectrum {
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
