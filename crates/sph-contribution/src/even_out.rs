//! Densities of the remaining particles when others come or go.

use rayon::prelude::*;
use sph_core::{FieldError, Vect, fields};
use sph_neighbours::World;

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
