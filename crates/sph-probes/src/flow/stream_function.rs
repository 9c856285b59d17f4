//! The extreme of the stream function over a box.

use serde::{Deserialize, Deserializer};
use sph_core::{StepError, Vect, fields, plugin};
use sph_neighbours::World;

use crate::sampling::NearbyParticles;
use crate::{Probe, ProbeColumn, ProbeEntry};

/// The largest |ψ| with ψ(x, y) = ∫ u_x dy′ from the bottom y₀ of a box, and its place: the
/// strength and the centre of a vortex.
///
/// The velocity at the points of a grid is a Shepard mean of the particles, zero on the bottom,
/// which is a wall, and where there is no fluid. A mean is not a value: it smooths with an error of
/// h² u″. `corrections` adds the means of what the particles differ by from their own mean, which
/// leaves h⁴ for the first time. The integral is that of trapezia, and the extreme the top of
/// parabolas through the largest value on the grid and its neighbours: both are second order in the
/// spacing of the grid. Without particles the values are NaN.
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
