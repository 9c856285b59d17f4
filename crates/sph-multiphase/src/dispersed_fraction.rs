//! Light particles that are scattered in a heavy fluid.

use sph_core::{Access, Field, Scalar, Stage, fields, stage};
use sph_neighbours::{Around, Values, World, walk_into};

/// Isolation of a light particle from its phase: 1 alone, 0 where its phase has half of the support or more.
///
/// χ_a = max(0, 1 − 2φ_a), φ_a = Σ_{b ≠ a, of the phase of a} V_b w_ab / (1 − V_a w(0)). Walls are none of its
/// phase. A flat interface half a spacing away leaves φ = 0.64 in two dimensions with h = 2 δr, and χ = 0.
pub const DISPERSED_FRACTION: Field<Scalar> = Field::new(
    "dispersed_fraction",
    "1",
    "1 for a light particle alone in another phase, 0 where its own has half of the support",
);

/// [`DISPERSED_FRACTION`] of all phases but the heaviest, which has 0; 0 as well where there is nothing to rub on.
/// `light` marks phases that are lighter than another.
pub(crate) fn dispersed_fraction<const D: usize>(light: Vec<bool>) -> impl Stage<World<D>> {
    let access = Access::none()
        .both((fields::POSITION, fields::PHASE, fields::VOLUME))
        .writes(DISPERSED_FRACTION);
    stage(
        "scattered light particles",
        access,
        move |world: &mut World<D>| {
            let mut dispersed_fraction = world.free.take(DISPERSED_FRACTION)?;
            dispersed_fraction.fill(0.0);
            let (phase, volume) = world.free.all((fields::PHASE, fields::VOLUME))?;
            let mut at_zero = [0.0];
            world.kernel.value(&[0.0], &mut at_zero);
            let share = |around: &Around<'_, D>| {
                let i = around.rows.particle;
                let like: f64 = std::iter::zip(around.rows.free.index, around.free)
                    .filter(|(j, _)| **j as usize != i && phase[**j as usize] == phase[i])
                    .map(|(j, w)| volume[*j as usize] * w)
                    .sum();
                let others = (1.0 - volume[i] * at_zero[0]).max(f64::MIN_POSITIVE);
                (1.0 - 2.0 * like / others).max(0.0)
            };
            // Inside a light phase it is not read: friction is with another phase or with a wall.
            let (lists, walls) = (world.lists.nearest(), &world.walls);
            let beside = |i: usize| {
                let mut near = lists.candidates(i).iter();
                near.any(|j| phase[*j as usize] != phase[i])
                    || !walls.contacts.of_particle(i).is_empty()
                    || walls.points.in_sums() && !world.lists.wall.candidates(i).is_empty()
            };
            let wanted = |i: usize| light[phase[i] as usize] && beside(i);
            walk_into(world, Values::Both, wanted, &mut dispersed_fraction, share)?;
            Ok(world.free.put(DISPERSED_FRACTION, dispersed_fraction)?)
        },
    )
}
