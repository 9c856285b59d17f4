//! Force of the fluid on the walls.

use sph_core::{StepError, Vect, fields};

use crate::loads::facing::facing_forces;
use crate::walls::slopes::of_particle;
use crate::{Interaction, WallForce, WallPart, World, wall_parts};

/// Forces on the wanted ones of all walls, in the order of their names, at the state of the last sweep; NaN on the others.
///
/// It costs a sweep over the particles that see a wanted wall, nothing for the others.
///
/// The walls' part of an acceleration is the whole less the contribution of the other particles with γ = 1, which is
/// equal and opposite between two particles and leaves no momentum; [`wall_parts`] gives the part of each wall.
/// `facing_forces` are added.
///
/// # Errors
/// If a term misses a column, as everywhere below.
pub fn wall_forces<const D: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    wanted: &[bool],
) -> Result<Vec<WallForce<D>>, StepError> {
    let mut forces = loads(world, terms, wanted)?;
    for (wall, total) in forces.iter_mut().enumerate().filter(|(w, _)| wanted[*w]) {
        let pressure = WallForce::from_sums(pressure_on(world, wall as u32)?);
        (total.pressure_force, total.pressure_moment) = (pressure.force, pressure.moment);
    }
    Ok(forces)
}

/// The same without the integrals of the pressure, which no single rank has on all elements; they are 0 here.
pub fn loads<const D: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    wanted: &[bool],
) -> Result<Vec<WallForce<D>>, StepError> {
    let mut forces = reactions(world, terms, wanted)?;
    let facing = facing_forces(world, wanted)?;
    let both = forces.iter_mut().zip(&facing);
    both.for_each(|(f, more)| f.add(more));
    Ok(forces)
}

/// [`loads`] without `facing_forces`.
pub fn reactions<const D: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    wanted: &[bool],
) -> Result<Vec<WallForce<D>>, StepError> {
    let positions = world.free.get(fields::POSITION)?;
    let walls = &world.walls;
    let sees = |i: usize| {
        let mut elements = walls.contacts.of_particle(i).elements().iter();
        let mut points = world.wall_candidates(i).iter();
        let mut slopes = of_particle(&walls.slopes, i).iter();
        elements.any(|s| wanted[walls.elements.wall[*s as usize] as usize])
            || points.any(|v| wanted[walls.points.wall[*v as usize] as usize])
            || slopes.any(|s| wanted[s.wall as usize])
    };
    let owned = world.owned();
    let sees = |i: usize| owned.has(i) && sees(i);
    let mut parts: Vec<Vec<[f64; 6]>> = vec![Vec::new(); wanted.len()];
    for part in wall_parts(world, terms, sees)? {
        let place = image_beside_wall(world, &positions[part.particle as usize], &part);
        parts[part.wall as usize].push(WallForce::parts(&place, &part.force));
    }
    let all = parts.iter().zip(wanted).map(|(parts, wanted)| {
        if !wanted {
            return Ok(WallForce::repeat(f64::NAN));
        }
        let sums = world.sums_of(parts.len(), &|k| Some(parts[k]))?;
        Ok(WallForce::from_sums(sums))
    });
    all.collect()
}

fn image_beside_wall<const D: usize>(world: &World<D>, x: &Vect<D>, part: &WallPart<D>) -> Vect<D> {
    if !world.domain.periodic.contains(&true) {
        return *x;
    }
    let (i, walls) = (part.particle as usize, &world.walls);
    let elements = walls.contacts.of_particle(i).elements().iter();
    let mut of_elements = elements.filter(|s| walls.elements.wall[**s as usize] == part.wall);
    let of_points = world.wall_candidates(i).iter();
    let mut of_points = of_points.filter(|v| walls.points.wall[**v as usize] == part.wall);
    let (centres, places) = (&walls.elements.centre, &walls.points.position);
    let seen = of_elements.next().map(|s| &centres[*s as usize]);
    let seen = seen.or_else(|| of_points.next().map(|v| &places[*v as usize]));
    let Some(seen) = seen else { return *x };
    let apart = x - seen;
    x + (world.domain.nearest(apart) - apart) + walls.round(part.wall)
}

fn pressure_on<const D: usize>(world: &World<D>, wall: u32) -> Result<[f64; 6], StepError> {
    let elements = &world.walls.elements;
    let owned = world.owned_elements()?;
    let round = world.walls.round(wall);
    let part = |s: usize| {
        let force = elements.normal[s] * (-elements.pressure[s] * elements.measure[s]);
        WallForce::parts(&(elements.centre[s] + round), &force)
    };
    let on = |s: usize| elements.wall[s] == wall && owned.has(s);
    world.sums_of(elements.centre.len(), &|s| on(s).then(|| part(s)))
}
