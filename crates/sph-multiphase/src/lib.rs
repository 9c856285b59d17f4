//! Density between particles of several phases, and the action of its pressure.
//!
//! * [`Formulation`] is a kind of plugin, the definition of the density, and its pressure gradient: [`HuAdams`],
//!   [`ColagrossiLandrini`], [`Grenier`], [`Krimi`].
//! * [`InterfaceEntry`] is a kind of plugin, a force where phases meet: [`SurfaceTension`], [`GrenierInterface`],
//!   [`MicroMixing`], [`InterfaceFriction`].
//! * [`PressureScheme`] is a kind of plugin, which pressure acts in a step; [`pressure`] has that of its end.
//! * [`equations_of_state`] is the stage that applies them.
//! * [`SurfaceEntry`] is a kind of plugin, the definition of free surfaces: [`ConeTest`], [`Renormalised`].
//! * [`AcousticDamper`] takes sound away, [`dissipation`] noise between particles that approach each other.
//! * [`damping`]: decay of velocities, everywhere or in sponges.
//! * [`diffusion`] of density against noise, and of particles against gaps.
//! * [`linear`]: sparse systems on the neighbour graph and their solvers.
//! * [`viscosity`]: viscous operators, solved for or not, and viscosities of eddies.
#![doc = include_str!("../README.md")]
// Unit tests name no plugin. Without registration they compile what they call, not all loops of the crate again.
#![cfg_attr(
    test,
    allow(unused_imports, reason = "plugins are not registered in unit tests")
)]

mod acoustic_damper;
mod colagrossi_landrini;
mod contact_angle;
mod contract;
mod contribution;
pub mod damping;
pub mod diffusion;
pub mod dissipation;
mod divergence;
mod gradient;
mod grenier;
mod hu_adams;
mod interface_friction;
mod interface_limit;
pub mod linear;
pub mod pressure;
mod repulsion;
mod surface;
mod surface_tension;
pub mod viscosity;

pub use acoustic_damper::AcousticDamper;
pub use colagrossi_landrini::{ColagrossiLandrini, Continuity, Krimi};
pub use contact_angle::{ContactAngle, FILM};
pub use contract::{
    Acting, Compressed, Diffused, Formulation, FormulationEntry, InterfaceEntry, PressureEntry,
    PressureScheme, equations_of_state, offer_interface,
};
pub use divergence::{DensityWeighted, Divergence, DivergenceWeight, NeighbourVolume, OwnVolume};
pub use gradient::{
    BetweenParticles, PairPressure, PairState, PressureGradient, SquaredVolumes, SumOfPressures,
};
pub use grenier::Grenier;
pub use hu_adams::HuAdams;
pub use interface_friction::{DISPERSED_FRACTION, InterfaceFriction};
pub use interface_limit::interface_limit;
pub use repulsion::{GrenierInterface, MicroMixing};
pub use surface::{ConeTest, FREE_SURFACE, MOMENT_EXCESS, Place, Renormalised, SurfaceEntry};
pub use surface_tension::{COLOUR_GRADIENT, SurfaceStress, SurfaceTension};
