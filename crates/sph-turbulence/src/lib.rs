//! Turbulence: viscosities of eddies that particles do not resolve, and the shear of walls whose boundary layer they do
//! not resolve either.
//!
//! * Closures are plugins of the kind `eddy-viscosity`: [`MixingLength`], [`Smagorinsky`], [`Wale`],
//!   [`KLength`], [`KEpsilon`].
//! * [`LogLaw`] gives walls the shear of [`WallLaw`], [`FrictionVelocityProbe`] measures it, [`LogLawFlow`] is the velocity
//!   over a flat bed.
//! * [`TurbulentEnergyProbe`] measures k.
//! * [`BulkVelocity`] holds the flow rate of a periodic channel.
// Unit tests name no plugin. Without registration they compile what they call, not all loops of the crate again.
#![cfg_attr(
    test,
    allow(unused_imports, reason = "plugins are not registered in unit tests")
)]
#![doc = include_str!("../README.md")]

mod bed;
mod bulk_velocity;
mod closures;
mod columns;
mod distance;
mod energy_probe;
mod k_epsilon;
mod wall;

pub use bed::RoughBed;
pub use bulk_velocity::{BulkVelocity, FlowControlEntry};
pub use closures::{Damping, FilterLength, MixingLength, Smagorinsky, StrainOf, Wale};
pub use columns::{
    BED_DISTANCE, BED_FRICTION_VELOCITY, DISSIPATION, DISSIPATION_RATE, EDDY_STRESS,
    FRICTION_VELOCITY, LAST_STRAIN, SURFACE_SHARE, TURBULENT_ENERGY, TURBULENT_ENERGY_RATE,
    WALL_DISTANCE, WALL_UNITS,
};
pub use energy_probe::TurbulentEnergyProbe;
pub use k_epsilon::{
    AlgebraicStress, Anisotropy, AtWall, ChannelStart, KEpsilon, KEpsilonModel, KLength,
    RealisableModel, Variant,
};
pub use wall::{FrictionVelocityProbe, LogLaw, LogLawFlow, WallFunctionEntry, WallLaw};
