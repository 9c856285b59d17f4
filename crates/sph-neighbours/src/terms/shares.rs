//! Shares of the terms in the acceleration of one particle, and rates of all by classes of terms.

use rayon::prelude::*;
use sph_core::{StepError, Vect};

use crate::{ContactRow, Interaction, Neighbourhood, Rates, Row, Rows, Surroundings, World};

/// Contribution of one term to a particle.
#[derive(Clone, Debug)]
pub struct TermShare<const D: usize> {
    /// Name of the term.
    pub name: String,
    /// Its rates.
    pub rates: Rates<D>,
    /// Acceleration by walls, m/s²: the whole less the contribution of the other particles with γ = 1.
    pub of_walls: Vect<D>,
}

/// Contribution of every term to a particle at the state of the last sweep.
///
/// # Errors
/// If a term misses a column, as everywhere below.
pub fn shares_at<const D: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    particle: usize,
) -> Result<Vec<TermShare<D>>, StepError> {
    let surroundings = Surroundings::new(world)?;
    let mut rows = Rows::default();
    let whole = surroundings.neighbourhood(particle, &mut rows);
    let without = whole.scaling.map(|s| s.with_slope(Vect::zeros()));
    let fluid = Neighbourhood {
        wall: Row::default(),
        contacts: ContactRow::NONE,
        inverse_renormalisation: 1.0,
        scaling: without.as_ref(),
        ..whole
    };
    let mut shares = Vec::new();
    for interaction in terms {
        interaction.with_columns(world, &mut |term| {
            let of = |neighbourhood: &Neighbourhood<'_, D>| {
                let mut rates = Rates::from_acceleration(Vect::zeros());
                term.row(neighbourhood, &mut rates);
                rates
            };
            let (rates, fluid) = (of(&whole), of(&fluid));
            shares.push(TermShare {
                name: interaction.name(),
                rates,
                of_walls: rates.acceleration - fluid.acceleration,
            });
            Ok(())
        })?;
    }
    Ok(shares)
}

/// Contribution of one class of terms to a particle.
#[derive(Clone, Copy, Debug)]
pub struct ClassRate<const D: usize> {
    /// Acceleration, m/s², without gravity and driving.
    pub acceleration: Vect<D>,
    /// Rate of the density, kg/m³/s.
    pub scalar: f64,
}

/// The sums of so many classes of terms, one or more, at the state of the last sweep, those of a particle together;
/// terms of no class are left out.
///
/// Every term goes over the neighbours on its own: for the account of a step, not for the step.
pub fn class_rates<const D: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    classes: usize,
    class: impl Fn(&str) -> Option<usize>,
) -> Result<Vec<ClassRate<D>>, StepError> {
    let none = ClassRate {
        acceleration: Vect::zeros(),
        scalar: 0.0,
    };
    let surroundings = Surroundings::new(world)?;
    let mut all = vec![none; classes * surroundings.particles()];
    for interaction in terms {
        let Some(class) = class(&interaction.name()) else {
            continue;
        };
        interaction.with_columns(world, &mut |term| {
            let particles = all.par_chunks_mut(classes).enumerate().with_min_len(256);
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
