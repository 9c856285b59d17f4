//! Shepard means of the free particles at a point.

use sph_core::{StepError, Vect, fields};
use sph_neighbours::World;

/// Sums at a point.
#[derive(Clone, Copy, Debug)]
pub struct Interpolated<const D: usize> {
    /// Σ V w: 1 deep inside the fluid, 0 where there is none.
    pub filling: f64,
    /// Σ V [p + ρ (g − A)·(x − r)] w / Σ V w, Pa: exact at rest, and in a tank that is accelerated, where the smoother
    /// has the mean accelerations A.
    pub pressure: f64,
    /// Σ V u w / Σ V w, m/s.
    pub velocity: Vect<D>,
}

/// Sums over all free particles within the support of `x`.
///
/// It walks over all particles: probes are few, and no list exists for them.
///
/// # Errors
/// If a column is missing.
pub fn interpolate<const D: usize>(
    world: &World<D>,
    x: &Vect<D>,
) -> Result<Interpolated<D>, StepError> {
    let position = world.free.get(fields::POSITION)?;
    let velocity = world.free.get(fields::VELOCITY)?;
    let pressure = world.free.get(fields::PRESSURE)?;
    let density = world.free.get(fields::DENSITY)?;
    let volume = world.free.get(fields::VOLUME)?;
    let acceleration = world.free.get(fields::MEAN_ACCELERATION).ok();
    let radius = world.kernel.support_radius();
    let mut sum = Interpolated {
        filling: 0.0,
        pressure: 0.0,
        velocity: Vect::zeros(),
    };
    for (j, r) in position.iter().enumerate() {
        let d = world.domain.nearest_image(x - r);
        let r2 = d.norm_squared();
        if r2 < radius * radius {
            let vw = volume[j] * world.kernel.at(r2.sqrt()).0;
            sum.filling += vw;
            let inertia = acceleration.map_or(Vect::zeros(), |a| a[j]);
            sum.pressure += vw * (pressure[j] + density[j] * (world.gravity - inertia).dot(&d));
            sum.velocity += velocity[j] * vw;
        }
    }
    if sum.filling > 0.0 {
        sum.pressure /= sum.filling;
        sum.velocity /= sum.filling;
    }
    Ok(sum)
}
