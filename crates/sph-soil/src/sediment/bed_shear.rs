//! The shear of the flow on a bed.

use sph_core::bed::{Bed, horizontal};
use sph_core::{StepError, fields};
use sph_neighbours::{Contact, World};

/// Below this share of a full row of particles over a place, its shear fades.
pub(super) const WET: f64 = 0.25;

/// The particles of this process that touch a bed, with their contacts.
pub(super) fn contacts<'a, const D: usize>(
    world: &'a World<D>,
    bed: &Bed,
) -> impl Iterator<Item = (usize, Contact<D>)> + use<'a, D> {
    let (walls, owned, wall) = (&world.walls, world.owned(), bed.walls[0]);
    let particles = walls.contacts.particles.iter().map(|i| *i as usize);
    let own = particles.filter(move |i| owned.has(*i));
    let all = own.flat_map(|i| (walls.contacts.of_particle(i).iter()).map(move |c| (i, c)));
    all.filter(move |(_, c)| walls.elements.wall[c.element as usize] == wall)
}

/// Shear stress at the places of a bed, over the density of the water, m²/s²: the mean of u* u*_i, weighted with V |∇γ| and
/// with the bilinear weights of the places around.
///
/// Σ V |∇γ| of a full row is half of the area: where there is less than an eighth, the bed falls dry and the shear with it.
pub(super) fn shear<const D: usize>(
    world: &World<D>,
    bed: &Bed,
) -> Result<Vec<[f64; 2]>, StepError> {
    let (friction, velocity) = world.free.all((fields::WALL_FRICTION, fields::VELOCITY))?;
    let (density, volume) = world.free.all((fields::DENSITY, fields::VOLUME))?;
    let elements = &world.walls.elements;
    let count = bed.grid.len();
    let mut parts: Vec<(usize, f64)> = Vec::new();
    for (i, contact) in contacts(world, bed).filter(|(i, _)| friction[*i] != 0.0) {
        let s = contact.element as usize;
        let slip = velocity[i] - elements.velocity_at(&contact);
        let normal = &elements.normal[s];
        let along = slip - normal * slip.dot(normal);
        let weight = volume[i] * contact.gradient.norm();
        let stress = friction[i] / density[i];
        for (place, share) in bed.grid.around(horizontal(&elements.centre[s].into())) {
            let part = weight * share;
            parts.push((place, part));
            parts.push((count + place, part * stress * along[0]));
            if D == 3 {
                parts.push((2 * count + place, part * stress * along[1]));
            }
        }
    }
    let sums = world.sums_by_place(&parts, D * count)?;
    let mean = |place: usize| {
        let full = 0.5 * bed.grid.area(place);
        let weight = sums[place].max(WET * full);
        let along = |k: usize| sums.get(k * count + place).map_or(0.0, |sum| sum / weight);
        [along(1), along(2)]
    };
    Ok((0..count).map(mean).collect())
}
