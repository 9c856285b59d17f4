//! What guests are told.

use sph_core::{Access, Stage, StepError};
use sph_decomposition::Parts;
use sph_neighbours::{Half, World};

/// Gives guests what work has found for their owners: what was summed over neighbours.
pub(crate) fn tell_guests<const D: usize>(
    parts: &mut Option<Parts<D>>,
    world: &mut World<D>,
    access: &Access,
) -> Result<(), StepError> {
    let Some(parts) = parts else {
        return Ok(());
    };
    if access.sweep && !access.writes.is_empty() {
        parts.tell(&mut world.free, |f| access.writes.contains(f))?;
    }
    Ok(())
}

/// Runs a stage and gives guests what it has found: where it may run in halves, those who are guests elsewhere come first, and
/// the others while the messages are on their way.
pub(crate) fn run_and_tell<const D: usize>(
    stage: &mut dyn Stage<World<D>>,
    access: &Access,
    parts: &mut Option<Parts<D>>,
    world: &mut World<D>,
) -> Result<(), StepError> {
    let Some(own) = parts.as_ref().filter(|_| stage.halves()) else {
        watched(stage, access, world)?;
        return tell_guests(parts, world, access);
    };
    let sent = own.sent(world.free.len());
    world.lists.half = Some(Half::first(world.lists.nearest(), &sent));
    let done = in_halves(stage, access, own, world);
    world.lists.half = None;
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
            world.lists.half = world.lists.half.take().map(Half::second);
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
