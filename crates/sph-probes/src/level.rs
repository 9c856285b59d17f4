//! The height of the free surface over a point.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{StepError, Vect, fields, register};
use sph_neighbours::World;

use crate::point::{carried, point};
use crate::{Probe, ProbeColumn, ProbeEntry};

/// The highest place over a point where Σ V w falls to one half, V being at most a cell δr^d.
///
/// ```toml
/// [gauge.H1]
/// kind = "level"
/// at = [0.3]
/// ```
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Level {
    /// Horizontal coordinates: one in 2D, two in 3D.
    #[schemars(extend("unit" = "m"))]
    pub at: Vec<f64>,
    /// Name of the moving wall that carries the gauge; it stands still if left out.
    pub follows: Option<String>,
}

impl<const D: usize> Probe<D> for Level {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only("m")
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let positions = world.free.get(fields::POSITION)?;
        let volume = world.free.get(fields::VOLUME)?;
        let radius = world.kernel.support_radius();
        // A drop alone has a small density and a volume of several cells: it is no surface.
        let cell = world.spacing.powi(D as i32);
        let drawn = point::<D>(&self.at[..self.at.len().min(D - 1)]);
        let mut foot = carried(world, drawn, self.follows.as_deref())?;
        foot[D - 1] = 0.0;
        // Only the particles whose support meets the vertical line matter.
        let near: Vec<(Vect<D>, f64)> = positions
            .iter()
            .zip(volume)
            .map(|(x, v)| (world.domain.nearest_image(x - foot), v.min(cell)))
            .filter(|(d, _)| (0..D - 1).map(|k| d[k] * d[k]).sum::<f64>() < radius * radius)
            .collect();
        let filling = |z: f64| -> f64 {
            let w = |(d, v): &(Vect<D>, f64)| {
                let mut d = *d;
                d[D - 1] -= z;
                let r = d.norm();
                if r < radius {
                    v * world.kernel.at(r).0
                } else {
                    0.0
                }
            };
            near.iter().map(w).sum()
        };
        let heights = || near.iter().map(|(d, _)| d[D - 1]);
        let top = heights().fold(f64::NEG_INFINITY, f64::max);
        let bottom = heights().fold(f64::INFINITY, f64::min);
        if near.is_empty() {
            return Ok(vec![f64::NAN]);
        }
        // Down from above until half full, then bisect.
        let step = 0.25 * world.spacing;
        let mut z = top + radius;
        while z > bottom && filling(z) < 0.5 {
            z -= step;
        }
        if filling(z) < 0.5 {
            return Ok(vec![f64::NAN]);
        }
        let (mut full, mut empty) = (z, z + step);
        for _ in 0..30 {
            let middle = 0.5 * (full + empty);
            if filling(middle) < 0.5 {
                empty = middle
            } else {
                full = middle
            }
        }
        Ok(vec![0.5 * (full + empty)])
    }
}

register!(
    ProbeEntry [2, 3],
    Level,
    "level",
    "height of the free surface over a point",
    "half-filling of the Shepard sum"
);
