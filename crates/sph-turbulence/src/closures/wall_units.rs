//! Distances from walls in wall units, as far as damping reaches.

use rayon::prelude::*;
use sph_core::{Access, Stage, StepError, fields};
use sph_neighbours::{World, column_stage};

use super::phases::Kinematic;
use crate::columns::DAMPING_UNITS;
use crate::distance::KeptTree;
use crate::wall::{WallLaw, nearest};

/// The distance that is looked for, over the smoothing length: it is short of nothing but the farthest tail of the damping.
const REACH: f64 = 32.0;

/// z⁺ = z u*/ν with the true distance z from the nearest element and its u*, the mean by the law of the smooth wall for
/// the particles that touch it, weighted with their shares |∇γ_as|. It is infinite where no particle does.
///
/// `viscosities` are ν of every phase, m²/s; none of those whose eddies are not damped.
pub(crate) fn wall_units<const D: usize>(viscosities: Vec<Option<f64>>) -> impl Stage<World<D>> {
    let access = Access::none()
        .here((fields::POSITION, fields::VELOCITY, fields::RENORMALISATION))
        .here(Kinematic::column(&viscosities));
    let mut tree = KeptTree::default();
    let name = "damping units";
    column_stage::<D, _>(name, access, DAMPING_UNITS, move |world, units| {
        let friction = friction_velocities(&viscosities, world)?;
        let factors = &world.walls.elements.friction_factor;
        let tree = tree.updated(world, |s| factors[s] > 0.0);
        let within = REACH * world.kernel.smoothing_length();
        let positions = world.free.get(fields::POSITION)?;
        let viscosity = Kinematic::from_world(&viscosities, world)?;
        let all = units.par_iter_mut().zip(positions).enumerate();
        all.with_min_len(256).for_each(|(i, (z, x))| {
            let nu = viscosity.at(i);
            let found = tree.nearest(x, within).filter(|_| nu.is_some());
            let friction = |(d, s): (f64, u32)| Some(d * friction[s as usize]?);
            let plus = found.and_then(friction).zip(nu).map(|(d, nu)| d / nu);
            *z = plus.unwrap_or(f64::INFINITY);
        });
        Ok(())
    })
}

/// u* of every element that rubs, m/s; none where no particle is near.
fn friction_velocities<const D: usize>(
    viscosities: &[Option<f64>],
    world: &World<D>,
) -> Result<Vec<Option<f64>>, StepError> {
    let (walls, law) = (&world.walls, WallLaw::default());
    let viscosity = Kinematic::from_world(viscosities, world)?;
    let velocity = world.free.get(fields::VELOCITY)?;
    let mut sums = vec![[0.0; 2]; walls.elements.centre.len()];
    let rubs = |s: usize| walls.elements.friction_factor[s] > 0.0;
    for &particle in &walls.contacts.particles {
        let i = particle as usize;
        let seen = nearest(walls, i, &velocity[i], world.spacing, rubs);
        let (Some(seen), Some(nu)) = (seen, viscosity.at(i)) else {
            continue;
        };
        let found = law.friction_velocity(seen.speed, seen.distance, nu);
        let found = found.map_err(|error| StepError::stage("damping units", error))?;
        for contact in walls.contacts.of_particle(i) {
            let weight = contact.gradient.norm();
            let sum = &mut sums[contact.element as usize];
            sum[0] += weight * found;
            sum[1] += weight;
        }
    }
    let mean = |s: &[f64; 2]| (s[1] > 0.0).then(|| s[0] / s[1]);
    Ok(sums.iter().map(mean).collect())
}
