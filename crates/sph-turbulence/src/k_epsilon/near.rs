//! Walls and beds of transported scalars, and refusals.

use sph_core::{StepError, fields};
use sph_neighbours::World;

use crate::closures::Kinematic;

/// u*, m/s, and the distance, m, of a particle next to a bed that is a rough wall, from the columns of such a bed.
pub(crate) fn beside_bed(columns: Option<(&[f64], &[f64])>, i: usize) -> Option<[f64; 2]> {
    let (friction, distance) = columns?;
    (friction[i] > 0.0).then(|| [friction[i], distance[i]])
}

/// Nothing is cut off: a step whose diffusion takes more than there is fails, and is taken again in shorter ones.
pub(crate) fn refuse_negative<const D: usize>(
    world: &World<D>,
    quantity: &'static str,
    values: &[f64],
    acts: impl Fn(usize) -> bool,
) -> Result<(), StepError> {
    let bad = |i: usize, v: f64| acts(i) && !(v > 0.0 && v.is_finite());
    let found = values.iter().enumerate().position(|(i, v)| bad(i, *v));
    let Some(i) = found else {
        return Ok(());
    };
    let position = world.free.get(fields::POSITION)?[i];
    Err(StepError::Bad {
        quantity,
        particle: world.free.get(fields::IDENTITY)?[i],
        position: position.iter().copied().collect(),
        value: values[i],
        reason: "where a positive number was expected: the step is too long for its diffusion"
            .into(),
    })
}

/// A word about walls that rub a turbulent fluid without a wall function, as they may where a soil needs them to.
pub(crate) fn rubbed<const D: usize>(
    world: &World<D>,
    viscosities: &[Option<f64>],
) -> Option<String> {
    let viscosity = Kinematic::from_world(viscosities, world).ok()?;
    let walls = &world.walls;
    let elements = &walls.elements;
    let rubs = |s: usize| {
        elements.friction_factor[s] > 0.0 && elements.wall_function.get(s) != Some(&true)
    };
    let particles = walls.contacts.particles.iter().map(|p| *p as usize);
    let mut turbulent = particles.filter(|i| viscosity.at(*i).is_some());
    let met = turbulent.find_map(|i| {
        let mut contacts = walls.contacts.of_particle(i).iter();
        contacts.find(|c| rubs(c.element as usize))
    })?;
    let name = &walls.names[elements.wall[met.element as usize] as usize];
    Some(format!(
        "k has no value at the wall `{name}`, which rubs the turbulent fluid without a wall function: its shear is that of \
         the eddies of the first row; name it in `[wall-function.log-law]`"
    ))
}
