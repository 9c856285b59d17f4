//! What guests are told.

use sph_core::{Access, StepError};
use sph_decomposition::Parts;
use sph_neighbours::World;

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
