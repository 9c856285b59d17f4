//! Distances from walls in wall units, as far as damping reaches.

use rayon::prelude::*;
use sph_core::{Access, Declares, Stage, StepError, Vect, fields};
use sph_neighbours::World;

use super::phases::Kinematic;
use crate::columns::DAMPING_UNITS;
use crate::distance::ElementTree;
use crate::wall::{WallLaw, nearest};

/// z⁺ = z u*/ν with the true distance z from the nearest element and its u*, the mean by the law of the smooth wall for
/// the particles that touch it, weighted with their shares |∇γ_as|. It is infinite where no particle does.
pub(crate) struct WallUnits<const D: usize> {
    /// ν of every phase, m²/s; none of those whose eddies are not damped.
    pub viscosities: Vec<Option<f64>>,
    /// The elements, and the places of the wall points for which they were sorted.
    pub tree: Option<(ElementTree<D>, Vec<Vect<D>>)>,
}

/// The distance that is looked for, over the smoothing length: it is short of nothing but the farthest tail of the damping.
const REACH: f64 = 32.0;

impl<const D: usize> Declares for WallUnits<D> {
    fn name(&self) -> String {
        "damping units".into()
    }
    fn access(&self) -> Access {
        let access = Access::none()
            .here(fields::POSITION)
            .here(fields::VELOCITY)
            .here(fields::RENORMALISATION)
            .writes(DAMPING_UNITS);
        match self.viscosities.len() {
            1 => access,
            _ => access.here(fields::PHASE),
        }
    }
}

impl<const D: usize> WallUnits<D> {
    /// u* of every element that rubs, m/s; none where no particle is near.
    fn friction_velocities(&self, world: &World<D>) -> Result<Vec<Option<f64>>, StepError> {
        let (walls, law) = (&world.walls, WallLaw::default());
        let viscosity = Kinematic::from_world(&self.viscosities, world)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        let mut sums = vec![[0.0; 2]; walls.elements.centre.len()];
        let rubs = |s: usize| walls.elements.friction_factor[s] > 0.0;
        for &particle in &walls.contacts.particles {
            let i = particle as usize;
            let seen = nearest(walls, i, &velocity[i], world.spacing, rubs);
            let (Some(seen), Some(nu)) = (seen, viscosity.at(i)) else {
                continue;
            };
            let found = law
                .friction_velocity(seen.speed, seen.distance, nu)
                .map_err(|error| StepError::stage("damping units", error.to_string()))?;
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
}

impl<const D: usize> Stage<World<D>> for WallUnits<D> {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut units = world.free.take(DAMPING_UNITS)?;
        let friction = self.friction_velocities(world)?;
        let walls = &world.walls;
        let places = &walls.points.position;
        if self.tree.as_ref().is_none_or(|(_, of)| of != places) {
            let rubs = |s: usize| walls.elements.friction_factor[s] > 0.0;
            let tree = ElementTree::new(walls, &world.domain, rubs);
            self.tree = Some((tree, places.clone()));
        }
        if let Some((tree, _)) = &self.tree {
            let within = REACH * world.kernel.smoothing_length();
            let positions = world.free.get(fields::POSITION)?;
            let viscosity = Kinematic::from_world(&self.viscosities, world)?;
            let all = units.par_iter_mut().zip(positions).enumerate();
            all.with_min_len(256).for_each(|(i, (z, x))| {
                let nu = viscosity.at(i);
                let found = tree.nearest(x, within).filter(|_| nu.is_some());
                let friction = |(d, s): (f64, u32)| Some(d * friction[s as usize]?);
                let found = found.and_then(friction);
                let plus = found.zip(nu).map(|(d, nu)| d / nu);
                *z = plus.unwrap_or(f64::INFINITY);
            });
        }
        Ok(world.free.put(DAMPING_UNITS, units)?)
    }
}
