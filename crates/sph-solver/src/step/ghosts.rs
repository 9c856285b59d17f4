//! Updates of ghosts.

use sph_boundary::Wall;
use sph_core::{Access, Declares, Stage, StepError};
use sph_neighbours::decomposition::Parts;
use sph_neighbours::{SweepHalf, World};

use crate::step::stages::Work;

/// Runs a piece of work and gives ghosts its results: where it may run in halves, those that are ghosts elsewhere come
/// first, and the others while the messages are on their way.
pub(crate) fn run_and_update_ghosts<const D: usize>(
    work: &mut Work<D>,
    access: &Access,
    parts: Option<&Parts<D>>,
    world: &mut World<D>,
    walls: Option<&mut dyn Wall<D>>,
) -> Result<(), StepError> {
    if let (Work::Stage(stage), Some(parts)) = (&mut *work, parts)
        && stage.halves()
    {
        let sent = parts.sent(world.free.len());
        world.lists.sweep_half = Some(SweepHalf::first(world.lists.nearest(), &sent));
        let done = in_halves(&mut **stage, access, parts, world);
        world.lists.sweep_half = None;
        return done;
    }
    world.free.watch([access]);
    let ran = work.run(world, walls);
    world.free.unwatch(|| work.name()).and(ran)?;
    world.refresh(access)
}

fn in_halves<const D: usize>(
    stage: &mut dyn Stage<World<D>>,
    access: &Access,
    parts: &Parts<D>,
    world: &mut World<D>,
) -> Result<(), StepError> {
    watched(stage, access, world)?;
    let mut rest = Ok(());
    let told = parts.update_ghosts_during(
        world,
        |f| access.writes.contains(f),
        |world| {
            world.lists.sweep_half = world.lists.sweep_half.take().map(SweepHalf::second);
            rest = watched(stage, access, world);
        },
    );
    rest?;
    Ok(told?)
}

/// Runs half of a stage, which is held to its declaration.
fn watched<const D: usize>(
    stage: &mut dyn Stage<World<D>>,
    access: &Access,
    world: &mut World<D>,
) -> Result<(), StepError> {
    world.free.watch([access]);
    let ran = stage.run(world);
    world.free.unwatch(|| stage.name()).and(ran)
}
