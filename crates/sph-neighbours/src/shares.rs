//! Shares of the terms in the acceleration of one particle.

use sph_core::{StepError, Vect};

use crate::{ContactRow, Interaction, Neighbourhood, Rates, Rows, Scratch, Surroundings, World};

/// Contribution of one term to a particle.
#[derive(Clone, Debug)]
pub struct TermShare<const D: usize> {
    /// Name of the term.
    pub name: String,
    /// Its rates.
    pub rates: Rates<D>,
    /// The part that walls have in them: the whole less the contribution of the other particles with γ = 1.
    pub of_walls: Rates<D>,
}

/// Contribution of every term to a particle at the state of the last sweep.
///
/// # Errors
/// If a term misses a column.
pub fn shares_at<const D: usize>(
    world: &World<D>,
    terms: &[&dyn Interaction<D>],
    particle: usize,
) -> Result<Vec<TermShare<D>>, StepError> {
    let surroundings = Surroundings::new(world)?;
    let mut rows = Rows::default();
    let whole = surroundings.neighbourhood(particle, &mut rows);
    let none = Scratch::<D>::new();
    let without = whole.scaling.map(|s| s.with_slope(Vect::zeros()));
    let fluid = Neighbourhood {
        wall: none.row(),
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
                of_walls: Rates {
                    acceleration: rates.acceleration - fluid.acceleration,
                    scalar: rates.scalar - fluid.scalar,
                    more: std::array::from_fn(|k| rates.more[k] - fluid.more[k]),
                },
            });
            Ok(())
        })?;
    }
    Ok(shares)
}
