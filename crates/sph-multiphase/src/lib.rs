//! How pressure, density and viscosity act between particles.
//!
//! * [`EquationOfState`]: pressure from density, on slices ([`Tait`], [`Linear`]), and of grains
//!   from the strain rate as well ([`CompressibleGrains`]).
//! * [`Formulation`]: what density is and which pressure gradient belongs to it ([`HuAdams`]).
//! * [`ViscousOperator`]: the second-order operator of the viscous force ([`Morris`]).
//! * [`Smoother`]: what damps pressure noise ([`BrezziPitkaranta`]).
//! * [`InterfaceModel`]: a force where phases meet ([`SurfaceTension`]).
//! * [`Shifting`]: what keeps particles evenly spread ([`Fickian`]).
//! * [`Limiter`]: the largest stable step of each, with its reason.

mod brezzi_pitkaranta;
mod colagrossi_landrini;
mod compressible_grains;
mod contract;
mod coupling;
mod delta_multiphase;
mod delta_sph;
mod diffusion_limit;
mod divergence;
mod eos;
mod espanol_revenga;
mod evenness;
mod fickian;
mod friction;
mod fusion;
mod gradient;
mod grenier;
mod grenier_interface;
mod hu_adams;
mod hu_adams_viscosity;
mod interface_distance;
mod interface_friction;
mod krimi;
mod krimi_viscosity;
mod lattice;
mod limits;
mod linear;
mod linear_exact;
mod micro_mixing;
mod monaghan_gingold;
mod morris;
mod phases;
mod repulsion;
mod rhie_chow;
mod shift_transport;
mod state;
mod surface_tension;
mod tait;
mod viscosity;
mod volume;

pub use brezzi_pitkaranta::{BrezziPitkaranta, PressureDiffusion};
pub use colagrossi_landrini::ColagrossiLandrini;
pub use compressible_grains::CompressibleGrains;
pub use contract::{
    Compressed, Diffused, Formulation, FormulationEntry, InterfaceEntry, InterfaceModel, Laws,
    ShiftedFlow, Shifting, ShiftingEntry, Smoother, SmootherEntry, Stages, Viscosity,
    ViscousOperator, ViscousOperatorEntry,
};
pub use coupling::{BoundCoupling, Coupling, CouplingRow, Weak};
pub use delta_multiphase::{Balance, DeltaMultiphase};
pub use delta_sph::{DENSITY_GRADIENT, DeltaForm, DeltaSph};
pub use divergence::{DensityWeighted, Divergence, DivergenceWeight, OwnVolume, TheirVolume};
pub use eos::{BoundState, EquationOfState, EquationOfStateEntry, Reference};
pub use espanol_revenga::{EspanolRevenga, WithTransposed};
pub use fickian::{Fickian, Transport};
pub use friction::{Across, Choice, OnLattice, PairFriction, ViscousTerm, WallTerm, Within};
pub use gradient::{
    BetweenParticles, PairPressure, PressureGradient, Side, SquaredVolumes, SumOfPressures,
};
pub use grenier::Grenier;
pub use grenier_interface::GrenierInterface;
pub use hu_adams::{HuAdams, HuAdamsPressure};
pub use hu_adams_viscosity::HuAdamsViscosity;
pub use interface_distance::INTERFACE_DISTANCE;
pub use interface_friction::InterfaceFriction;
pub use krimi::{Continuity, Krimi};
pub use krimi_viscosity::{KrimiViscosity, Strength};
pub use limits::{ForceLimit, InterfaceLimit, Limiter, SoundLimit, ViscousLimit};
pub use linear::Linear;
pub use micro_mixing::MicroMixing;
pub use monaghan_gingold::MonaghanGingold;
pub use morris::{FirstDifferences, Morris, MorrisTerm};
pub use rhie_chow::{PRESSURE_SLOPE, RhieChow};
pub use shift_transport::ShiftTransport;
pub use state::PressureStage;
pub use surface_tension::{COLOUR_GRADIENT, SurfaceStress, SurfaceTension};
pub use tait::Tait;
pub use viscosity::{BoundViscosity, InSeries, PerParticle, Uniform, ViscositySource};
