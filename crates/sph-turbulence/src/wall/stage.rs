//! Friction velocities at particles near walls with a wall function.

use rayon::prelude::*;
use sph_core::{Access, Declares, Stage, StepError, fields};
use sph_neighbours::{WallSet, World};

use super::law::WallLaw;
use super::nearest::nearest;
use crate::columns::{FRICTION_VELOCITY, WALL_UNITS};

/// [`FRICTION_VELOCITY`] u*, [`WALL_UNITS`] z⁺ and [`WALL_FRICTION`](fields::WALL_FRICTION) ρu*²/u_t by the law, from the
/// velocity u_t along the wall, relative to it, at the particle's true distance z.
pub(crate) struct WallShear {
    /// The law.
    pub law: WallLaw,
    /// Names of the walls.
    pub walls: Vec<String>,
    /// ν of every phase, m²/s; none of those that the law is not for.
    pub viscosities: Vec<Option<f64>>,
}

impl WallShear {
    /// Marks of elements whose friction is that of the law.
    fn marks<const D: usize>(&self, walls: &WallSet<D>) -> Vec<bool> {
        let named = |wall: &u32| self.walls.contains(&walls.names[*wall as usize]);
        walls.elements.wall.iter().map(named).collect()
    }
}

impl Declares for WallShear {
    fn name(&self) -> String {
        "wall function".into()
    }
    fn access(&self) -> Access {
        let access = Access::none()
            .here(fields::VELOCITY)
            .here(fields::DENSITY)
            .here(fields::RENORMALISATION)
            .writes(FRICTION_VELOCITY)
            .writes(WALL_UNITS)
            .writes(fields::WALL_FRICTION);
        match self.viscosities.len() {
            1 => access,
            _ => access.here(fields::PHASE),
        }
    }
}

impl<const D: usize> Stage<World<D>> for WallShear {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        if world.walls.elements.wall_function.len() != world.walls.elements.wall.len() {
            world.walls.elements.wall_function = self.marks(&world.walls);
        }
        let mut friction_velocity = world.free.take(FRICTION_VELOCITY)?;
        let mut wall_units = world.free.take(WALL_UNITS)?;
        let mut friction = world.free.take(fields::WALL_FRICTION)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        let density = world.free.get(fields::DENSITY)?;
        let phase = match self.viscosities.len() {
            1 => None,
            _ => Some(world.free.get(fields::PHASE)?),
        };
        let (walls, spacing) = (&world.walls, world.spacing);
        let at = |i: usize| -> Result<[f64; 3], StepError> {
            let none = [0.0, f64::INFINITY, 0.0];
            let nu = self.viscosities[phase.map_or(0, |p| p[i] as usize)];
            let counts = |s: usize| walls.elements.wall_function[s];
            let seen = nearest(walls, i, &velocity[i], spacing, counts);
            let (Some(nu), Some(seen)) = (nu, seen) else {
                return Ok(none);
            };
            let found = self
                .law
                .friction_velocity(seen.speed, seen.distance, nu)
                .map_err(|error| StepError::stage("wall function", error.to_string()))?;
            // At rest the wall is one of the viscous sublayer: τ_w = η u/z.
            let friction = match seen.speed > 0.0 {
                true => density[i] * found * found / seen.speed,
                false => density[i] * nu / seen.distance,
            };
            Ok([found, seen.distance * found / nu, friction])
        };
        let columns = friction_velocity
            .par_iter_mut()
            .zip(&mut wall_units)
            .zip(&mut friction);
        let each = columns.enumerate().with_min_len(512);
        each.try_for_each(|(i, ((u, z), f))| {
            [*u, *z, *f] = at(i)?;
            Ok::<_, StepError>(())
        })?;
        world.free.put(FRICTION_VELOCITY, friction_velocity)?;
        world.free.put(WALL_UNITS, wall_units)?;
        Ok(world.free.put(fields::WALL_FRICTION, friction)?)
    }
}
