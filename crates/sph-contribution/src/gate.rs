//! Sources and sinks of particles, particles that come in, and densities where particles come or go.

use std::sync::Arc;

use rayon::prelude::*;
use sph_core::{Access, FieldError, StepError, Vect, fields};
use sph_neighbours::World;

/// A place where particles leave or come in at the end of a step.
///
/// Departures are counted and taken out, then outlets are emptied, then births come in.
pub trait Gate<const D: usize>: Send {
    /// Name in errors.
    fn name(&self) -> String;
    /// Columns that it reads and writes.
    fn access(&self) -> Access;
    /// Names of the exits by which particles leave.
    fn exits(&self) -> Vec<String> {
        Vec::new()
    }
    /// Particles that leave at the end of a step of `dt` seconds, by their slots, ascending, each with the number of the
    /// [exit](Self::exits).
    ///
    /// # Errors
    /// If a column is missing or a value impossible; the step is then rolled back.
    fn departures(
        &mut self,
        _world: &mut World<D>,
        _dt: f64,
    ) -> Result<Vec<(u32, usize)>, StepError> {
        Ok(Vec::new())
    }
    /// Particles that come in at the end of a step of `dt` seconds.
    ///
    /// # Errors
    /// As [`departures`](Self::departures).
    fn births(&mut self, _world: &mut World<D>, _dt: f64) -> Result<Vec<Newborn<D>>, StepError> {
        Ok(Vec::new())
    }
}

/// A particle that comes into the flow at the end of a step.
///
/// Its density is that of the equation of state's pressure there; the quantity that a formulation integrates follows
/// from it. Densities that are sums get its mass at once: let a particle in with little of it, or where no particle is
/// near.
#[derive(Clone, Debug)]
pub struct Newborn<const D: usize> {
    /// Position, m.
    pub position: Vect<D>,
    /// Velocity, m/s.
    pub velocity: Vect<D>,
    /// Density, kg/m³.
    pub density: f64,
    /// Mass, kg (per metre of depth in two dimensions).
    pub mass: f64,
    /// Number of its phase.
    pub phase: u32,
    /// Its origin, for columns that [begin](crate::Birth) with it.
    pub body: Arc<str>,
    /// Values of columns that contributions bring along, by the names of the columns; the others begin with the values
    /// of the columns.
    pub values: Arc<[(String, f64)]>,
}

/// K_a += s m_a Σ_p w(|r_a − p|) over places p of particles that come (s = −1) or go (s = +1), where densities are sums with a
/// density constant K: no density jumps.
///
/// # Errors
/// If there is no position or mass.
pub fn even_out<const D: usize>(
    world: &mut World<D>,
    places: &[Vect<D>],
    sign: f64,
) -> Result<(), FieldError> {
    let (Some(first), true) = (
        places.first(),
        world.free.has(fields::DENSITY_CONSTANT.name),
    ) else {
        return Ok(());
    };
    let mut constant = world.free.take(fields::DENSITY_CONSTANT)?;
    let free = &world.free;
    let (position, mass) = (free.get(fields::POSITION)?, free.get(fields::MASS)?);
    let radius = world.kernel.support_radius();
    // The box of the places, which most particles are far away from.
    let around = |(low, high): (Vect<D>, Vect<D>), p| (low.inf(p), high.sup(p));
    let (low, high) = places.iter().fold((*first, *first), around);
    let (middle, reach) = ((low + high) * 0.5, (high - low) * 0.5);
    let all = constant.par_iter_mut().zip(position).zip(mass);
    all.with_min_len(1024).for_each(|((constant, x), m)| {
        let apart = world.domain.nearest_image(x - middle).abs() - reach;
        if apart.max() >= radius {
            return;
        }
        for place in places {
            let r2 = world.domain.nearest_image(x - place).norm_squared();
            if r2 < radius * radius {
                *constant += sign * m * world.kernel.at(r2.sqrt()).0;
            }
        }
    });
    world.free.put(fields::DENSITY_CONSTANT, constant)
}
