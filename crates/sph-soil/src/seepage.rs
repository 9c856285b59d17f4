//! Water that moves through the pores of soils.
//!
//! [`DarcyForchheimer`] is a plugin of the kind `seepage`, with the [`PoreResistance`] of grains of a size.

use sph_contribution::{Contribution, contribution_kind};
use sph_core::Work;

mod darcy_forchheimer;
mod exchange;
mod pore_resistance;
mod pore_water;

pub use darcy_forchheimer::DarcyForchheimer;
pub(crate) use exchange::{Exchange, Gains, Phase};
pub use pore_resistance::PoreResistance;

sph_core::fields! {
    /// Flux of the water through the pores, relative to the grains: volume per area and time. 0 outside of soils.
    pub SEEPAGE_VELOCITY: Vector = "seepage_velocity", "m/s",
        "flux of the water through the pores, relative to the grains";
    /// Pressure of the water that seeps, in the pores and beside the soil; 0 elsewhere.
    pub SEEPAGE_PRESSURE: Scalar = "seepage_pressure", "Pa",
        "pressure of the water that seeps through a soil";
}

contribution_kind!(
    /// A law of seepage that a scene may name.
    pub SeepageEntry, "seepage", One, "the flow of water through the pores of a soil",
    .ordered(120).works(Work::Others)
);
