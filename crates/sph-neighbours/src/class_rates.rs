//! Rates by classes of terms.

use rayon::prelude::*;
use sph_core::{StepError, Vect};

use crate::{Interaction, Rates, Rows, Surroundings, World};

/// Contribution of one class of terms to a particle.
#[derive(Clone, Copy, Debug)]
pub struct ClassRate<const D: usize> {
    /// Acceleration, m/s², without gravity and driving.
    pub acceleration: Vect<D>,
    /// Rate of the density, kg/m³/s.
    pub scalar: f64,
}

/// The sums of `N` classes of terms at the state of the last sweep, one entry per particle; terms of no class are left out.
///
/// Every term goes over the neighbours on its own: for the account of a step, not for the step.
///
/// # Errors
/// If a term misses a column.
pub fn class_rates<const D: usize, const N: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    class: impl Fn(&str) -> Option<usize>,
) -> Result<Vec<[ClassRate<D>; N]>, StepError> {
    let none = ClassRate {
        acceleration: Vect::zeros(),
        scalar: 0.0,
    };
    let surroundings = Surroundings::new(world)?;
    let mut all = vec![[none; N]; surroundings.particles()];
    for interaction in terms {
        let Some(class) = class(&interaction.name()) else {
            continue;
        };
        interaction.with_columns(world, &mut |term| {
            let particles = all.par_iter_mut().enumerate().with_min_len(256);
            particles.for_each_init(Rows::default, |rows, (i, sums)| {
                let mut rates = Rates::from_acceleration(Vect::zeros());
                term.row(&surroundings.neighbourhood(i, rows), &mut rates);
                sums[class].acceleration += rates.acceleration;
                sums[class].scalar += rates.scalar;
            });
            Ok(())
        })?;
    }
    Ok(all)
}
