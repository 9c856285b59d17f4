//! How pressure, density and viscosity act between particles.
//!
//! * [`EquationOfState`]: pressure from density, on slices ([`Tait`], [`Linear`]).
//! * [`Formulation`]: what density is and which pressure gradient belongs to it ([`HuAdams`]).
//! * [`ViscousOperator`]: the second-order operator of the viscous force ([`Morris`]).
//! * [`Smoother`]: what damps pressure noise ([`BrezziPitkaranta`]).
//! * [`Limiter`]: the largest stable step of each, with its reason.

mod brezzi_pitkaranta;
mod contract;
mod eos;
mod fusion;
mod hu_adams;
mod limits;
mod linear;
mod morris;
mod state;
mod tait;
mod viscosity;

pub use brezzi_pitkaranta::BrezziPitkaranta;
pub use contract::{
    Formulation, FormulationEntry, Smoother, SmootherEntry, Viscosity, ViscousOperator,
    ViscousOperatorEntry,
};
pub use eos::{BoundState, EquationOfState, EquationOfStateEntry, Reference};
pub use hu_adams::{HuAdams, HuAdamsPressure};
pub use limits::{ForceLimit, Limiter, SoundLimit, ViscousLimit};
pub use linear::Linear;
pub use morris::{Morris, MorrisTerm, WallTerm};
pub use state::PressureStage;
pub use tait::Tait;
pub use viscosity::{PerParticle, Uniform, ViscositySource};
