//! Particles that a probe counts: those of one phase, or all.

use sph_core::{StepError, fields, suggestion};
use sph_neighbours::World;

use crate::ProbeScene;

/// Number of the phase that a probe names, in the scene's order of names; none if it names none.
///
/// # Errors
/// If no phase is called so.
pub(crate) fn number(name: Option<&str>, scene: &ProbeScene<'_>) -> Result<Option<u32>, String> {
    let Some(name) = name else { return Ok(None) };
    let found = scene.phases.iter().position(|n| n == name);
    found.map(|k| Some(k as u32)).ok_or_else(|| {
        let near = suggestion(name, scene.phases.iter().map(String::as_str));
        format!("there is no phase called `{name}`{near}")
    })
}

/// The particles of one phase, or all of them.
pub(crate) enum CountedPhase<'a> {
    All,
    /// Those whose phase has this number.
    Of(&'a [u32], u32),
}

impl<'a> CountedPhase<'a> {
    /// Those of the phase `name` with its `number` as [`Probe::prepare`](crate::Probe) found it.
    ///
    /// # Errors
    /// If the phase is named and its number was not set.
    pub fn in_phase<const D: usize>(
        world: &'a World<D>,
        name: Option<&str>,
        number: Option<u32>,
    ) -> Result<Self, StepError> {
        match (name, number) {
            (None, _) => Ok(CountedPhase::All),
            // A scene of one phase has no column of phases.
            (_, Some(0)) if !world.free.has(fields::PHASE.name) => Ok(CountedPhase::All),
            (_, Some(k)) if !world.free.has(fields::PHASE.name) => Ok(CountedPhase::Of(&[], k)),
            (_, Some(k)) => Ok(CountedPhase::Of(world.free.get(fields::PHASE)?, k)),
            (Some(name), None) => {
                let reason = format!("the number of the phase `{name}` is not known yet");
                Err(StepError::stage("probes", reason))
            }
        }
    }

    pub fn has(&self, k: usize) -> bool {
        match self {
            CountedPhase::All => true,
            CountedPhase::Of(phases, number) => phases.get(k) == Some(number),
        }
    }
}
