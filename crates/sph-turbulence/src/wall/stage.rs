//! Friction velocities at particles near walls with a wall function.

use rayon::prelude::*;
use sph_core::{Access, Stage, StepError, fields, stage};
use sph_neighbours::World;

use super::law::WallLaw;
use super::nearest;
use crate::closures::Kinematic;
use crate::columns::{FRICTION_VELOCITY, WALL_UNITS};

/// [`FRICTION_VELOCITY`] u*, [`WALL_UNITS`] z⁺ and [`WALL_FRICTION`](fields::WALL_FRICTION) ρu*²/u_t by the law, from the
/// velocity u_t along the wall, relative to it, at the particle's true distance z.
///
/// `named` are the walls, `viscosities` ν of every phase, m²/s; none of those that the law is not for.
pub(crate) fn wall_shear<const D: usize>(
    law: WallLaw,
    named: Vec<String>,
    viscosities: Vec<Option<f64>>,
) -> impl Stage<World<D>> {
    let access = Access::none()
        .here((fields::VELOCITY, fields::DENSITY, fields::RENORMALISATION))
        .writes((FRICTION_VELOCITY, WALL_UNITS, fields::WALL_FRICTION));
    let access = Kinematic::access(&viscosities, access);
    stage("wall function", access, move |world: &mut World<D>| {
        if world.walls.elements.wall_function.len() != world.walls.elements.wall.len() {
            let names = &world.walls.names;
            let is_named = |wall: &u32| named.contains(&names[*wall as usize]);
            let marks = world.walls.elements.wall.iter().map(is_named);
            world.walls.elements.wall_function = marks.collect();
        }
        let mut friction_velocity = world.free.take(FRICTION_VELOCITY)?;
        let mut wall_units = world.free.take(WALL_UNITS)?;
        let mut friction = world.free.take(fields::WALL_FRICTION)?;
        let (velocity, density) = world.free.all((fields::VELOCITY, fields::DENSITY))?;
        let viscosity = Kinematic::from_world(&viscosities, world)?;
        let (walls, spacing) = (&world.walls, world.spacing);
        let at = |i: usize| -> Result<[f64; 3], StepError> {
            let none = [0.0, f64::INFINITY, 0.0];
            let counts = |s: usize| walls.elements.wall_function[s];
            let seen = nearest(walls, i, &velocity[i], spacing, counts);
            let (Some(nu), Some(seen)) = (viscosity.at(i), seen) else {
                return Ok(none);
            };
            let found = law.friction_velocity(seen.speed, seen.distance, nu);
            let found = found.map_err(|error| StepError::stage("wall function", error))?;
            // At rest the wall is one of the viscous sublayer: τ_w = η u/z.
            let friction = match seen.speed > 0.0 {
                true => density[i] * found * found / seen.speed,
                false => density[i] * nu / seen.distance,
            };
            Ok([found, seen.distance * found / nu, friction])
        };
        let columns = friction_velocity.par_iter_mut().zip(&mut wall_units);
        let each = columns.zip(&mut friction).enumerate().with_min_len(512);
        each.try_for_each(|(i, ((u, z), f))| at(i).map(|found| [*u, *z, *f] = found))?;
        world.free.put(FRICTION_VELOCITY, friction_velocity)?;
        world.free.put(WALL_UNITS, wall_units)?;
        Ok(world.free.put(fields::WALL_FRICTION, friction)?)
    })
}
