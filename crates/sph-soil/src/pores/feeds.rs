//! Walls that feed the pores of a soil.

use sph_core::{StepError, fields};
use sph_neighbours::World;

/// Particles before a wall with the flux per pressure and mobility from the wall to them, m^(d−2): 2 V |∇γ_as|/d_as.
pub(crate) fn feeds<const D: usize>(
    world: &World<D>,
    wall: u32,
) -> Result<Vec<(usize, f64)>, StepError> {
    let (elements, contacts) = (&world.walls.elements, &world.walls.contacts);
    let positions = world.free.get(fields::POSITION)?;
    let volume = world.free.get(fields::VOLUME)?;
    let least = LEAST_DISTANCE * world.spacing;
    let feed = |i: usize| {
        let own = contacts.of_particle(i).iter();
        let own = own.filter(|c| elements.wall[c.element as usize] == wall);
        let each = own.map(|contact| {
            let s = contact.element as usize;
            let apart = world
                .domain
                .nearest_image(positions[i] - elements.centre[s]);
            contact.gradient.norm() / apart.dot(&elements.normal[s]).abs().max(least)
        });
        (i, 2.0 * volume[i] * each.sum::<f64>())
    };
    let all = contacts.particles.iter().map(|i| feed(*i as usize));
    Ok(all.filter(|(_, conductance)| *conductance > 0.0).collect())
}

/// Spacings to a wall below which none counts.
const LEAST_DISTANCE: f64 = 0.1;
