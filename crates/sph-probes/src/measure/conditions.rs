//! Conditions on the particles that count.

use sph_core::StepError;
use sph_neighbours::World;

use super::quantity::Quantity;
use crate::phases::phase::CountedPhase;

/// Bounds on a quantity: a particle on a bound does not count.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct QuantityBounds {
    pub of: Quantity,
    pub above: f64,
    pub below: f64,
}

impl QuantityBounds {
    /// above < quantity.
    pub fn above(of: Quantity, above: f64) -> Self {
        let below = f64::INFINITY;
        QuantityBounds { of, above, below }
    }

    /// quantity < below.
    pub fn below(of: Quantity, below: f64) -> Self {
        let above = f64::NEG_INFINITY;
        QuantityBounds { of, above, below }
    }
}

/// The numbers of the particles of a phase that fulfil all conditions, and the number of particles of the phase.
///
/// # Errors
/// If a quantity is not known, or the phase's number.
pub(crate) fn counted<const D: usize>(
    world: &World<D>,
    (name, number): (Option<&str>, Option<u32>),
    conditions: &[QuantityBounds],
) -> Result<(Vec<usize>, Vec<usize>), StepError> {
    let phase = CountedPhase::in_phase(world, name, number)?;
    let of_phase: Vec<usize> = (0..world.free.len()).filter(|k| phase.has(*k)).collect();
    let mut all = of_phase.clone();
    for condition in conditions {
        let (value, _) = condition.of.values(world)?;
        all.retain(|k| value(*k) > condition.above && value(*k) < condition.below);
    }
    Ok((all, of_phase))
}
