//! Diffusion that keeps a particle method quiet: of density, and of the particles themselves.
//!
//! * Smoothers damp pressure noise: [`BrezziPitkaranta`], [`DeltaSph`], [`DeltaMultiphase`], [`RhieChow`].
//! * Shifting keeps particles evenly spread: [`Fickian`].

mod balance;
mod brezzi_pitkaranta;
mod contract;
mod delta_multiphase;
mod delta_sph;
mod evenness;
mod fickian;
mod rhie_chow;
mod shift_transport;

pub use balance::{Accelerated, MeanAcceleration, PRESSURE_SLOPE};
pub use brezzi_pitkaranta::{BrezziPitkaranta, PressureDiffusion};
pub use contract::{ShiftingEntry, SmootherEntry, Smoothing};
pub use delta_multiphase::{Balance, DeltaMultiphase};
pub use delta_sph::{DENSITY_GRADIENT, DeltaForm, DeltaSph};
pub use fickian::{Fickian, Transport};
pub use rhie_chow::RhieChow;
pub use shift_transport::{ShiftTransport, ShiftedSum};
