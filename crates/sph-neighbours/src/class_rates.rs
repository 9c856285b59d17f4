//! What terms do to all particles, fused ones taken apart, gathered by classes.

use rayon::prelude::*;
use sph_core::{StepError, Vect};

use crate::packed::{Packed, pack};
use crate::{Interaction, Neighbourhood, Part, Rates, Rows, Surroundings, World};

/// What one class of terms does to a particle.
#[derive(Clone, Copy, Debug)]
pub struct ClassRate<const D: usize> {
    /// Acceleration, m/s², without gravity and driving.
    pub acceleration: Vect<D>,
    /// Rate of the density, kg/m³/s.
    pub scalar: f64,
}

/// The sums of `N` classes of terms at the state of the last sweep, one entry per particle; terms of no class are left out.
///
/// Every part of a fused term is one virtual call per particle: for those who account for a step, not for the step.
///
/// # Errors
/// If a term misses a column.
pub fn class_rates<const D: usize, const N: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    class: impl Fn(&str) -> Option<usize>,
) -> Result<Vec<[ClassRate<D>; N]>, StepError> {
    let mut parts: Vec<Part<'_, D>> = Vec::new();
    for term in terms {
        parts.extend(term.parts(world)?);
    }
    let parts: Vec<_> = parts
        .into_iter()
        .filter_map(|(name, term)| Some((class(&name)?, term)))
        .collect();
    let none = ClassRate {
        acceleration: Vect::zeros(),
        scalar: 0.0,
    };
    let surroundings = Surroundings::new(world)?;
    let mut all = vec![[none; N]; surroundings.particles()];
    if parts.is_empty() {
        return Ok(all);
    }
    let mut states = Vec::new();
    pack(world, &mut states, Packed::of(terms.iter().copied()))?;
    let particles = all.par_iter_mut().enumerate().with_min_len(256);
    particles.for_each_init(Rows::default, |rows, (i, sums)| {
        let neighbourhood = Neighbourhood {
            states: &states,
            ..surroundings.of(i, rows)
        };
        for (class, term) in &parts {
            let mut rates = Rates::of(Vect::zeros());
            term.row(&neighbourhood, &mut rates);
            sums[*class].acceleration += rates.acceleration;
            sums[*class].scalar += rates.scalar;
        }
    });
    Ok(all)
}
