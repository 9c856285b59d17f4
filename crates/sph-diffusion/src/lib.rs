//! Diffusion that keeps a particle method quiet: of density, and of the particles themselves.
//!
//! * [`Smoother`] is a kind of plugin, what damps pressure noise: [`BrezziPitkaranta`], [`DeltaSph`],
//!   [`DeltaMultiphase`], [`RhieChow`].
//! * [`Shifting`] is a kind of plugin, what keeps particles evenly spread: [`Fickian`].
#![doc = include_str!("../README.md")]

mod balance;
mod brezzi_pitkaranta;
mod contract;
mod contribution;
mod delta_multiphase;
mod delta_sph;
mod diffusion_limit;
mod evenness;
mod fickian;
mod linear_exact;
mod per_phase;
mod rhie_chow;
mod shift_transport;

pub use balance::{Accelerated, MeanAcceleration, PRESSURE_SLOPE};
pub use brezzi_pitkaranta::{BrezziPitkaranta, PressureDiffusion};
pub use contract::{ShiftedFlow, Shifting, ShiftingEntry, Smoother, SmootherEntry};
pub use contribution::{Shifted, Smoothed};
pub use delta_multiphase::{Balance, DeltaMultiphase};
pub use delta_sph::{DENSITY_GRADIENT, DeltaForm, DeltaSph};
pub use fickian::{Fickian, Transport};
pub use rhie_chow::RhieChow;
pub use shift_transport::ShiftTransport;
