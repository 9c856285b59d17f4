//! What guests are told.

use sph_core::{Access, Stage, StepError};
use sph_decomposition::Parts;
use sph_neighbours::{SweepHalf, World};

/// Runs a stage and gives guests what it has found: where it may run in halves, those who are guests elsewhere come first, and
/// the others while the messages are on their way.
pub(crate) fn run_and_tell<const D: usize>(
    stage: &mut dyn Stage<World<D>>,
    access: &Access,
    parts: Option<&Parts<D>>,
    world: &mut World<D>,
) -> Result<(), StepError> {
    let Some(own) = parts.filter(|_| stage.halves()) else {
        watched(stage, access, world)?;
        return world.refresh(access);
    };
    let sent = own.sent(world.free.len());
    world.lists.sweep_half = Some(SweepHalf::first(world.lists.nearest(), &sent));
    let done = in_halves(stage, access, own, world);
    world.lists.sweep_half = None;
    done
}

fn in_halves<const D: usize>(
    stage: &mut dyn Stage<World<D>>,
    access: &Access,
    parts: &Parts<D>,
    world: &mut World<D>,
) -> Result<(), StepError> {
    watched(stage, access, world)?;
    let mut rest = Ok(());
    let told = parts.tell_during(
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

/// Runs a stage, which is held to what it declares.
fn watched<const D: usize>(
    stage: &mut dyn Stage<World<D>>,
    access: &Access,
    world: &mut World<D>,
) -> Result<(), StepError> {
    world.free.watch([access]);
    let ran = stage.run(world);
    world.free.unwatch(|| stage.name()).and(ran)
}
