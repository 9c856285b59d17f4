//! The imports of a pair term, by `use sph_neighbours::prelude::*;`.
//!
//! * `plugin`, [`TermEntry`]: offers the term to scenes; [`pair_term`]: declares its columns, of `fields` and [`Vect`];
//!   [`pair_sum`]: its formula.
//! * [`Lane`], [`Particles`], [`LanePair`]: numbers, particles and pairs that the formula gets; [`minus`], [`dot`] and
//!   [`add_scaled`]: its vectors.
//! * [`Neighbourhood`], [`Rates`]: the walls around a particle, and the result.
//! * [`PairSum`], [`BoundTerm`]: the traits, for terms without [`pair_sum`].

pub use crate::{
    BoundTerm, Lane, LanePair, Neighbourhood, PairSum, Particles, Rates, TermEntry, add_scaled,
    dot, minus, pair_sum, pair_term,
};
pub use sph_core::{Vect, fields, plugin};
