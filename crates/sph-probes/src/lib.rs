//! What a run measures and what it is compared with.
//!
//! * [`Probe`]: columns of the time series, from the state of the flow ([`Front`],
//!   [`PressureProbe`], [`VelocityProbe`], [`DisplacementProbe`], [`Level`], [`FieldRange`], [`WallForceProbe`], [`StreamFunction`], [`Profile`]), and of
//!   one phase of it ([`Interface`], [`PhaseVolume`], [`PhaseEnergy`], [`Extent`], [`Yielded`],
//!   [`SurfaceSlope`], [`Line`]), and of a bed under water ([`BedLines`], [`ErodedMass`],
//!   [`PorePressureProbe`]).
//! * [`Solution`]: analytical flows, as references and as initial states.
//! * [`norm`]: the norms in which errors are reported.

mod angular_momentum;
mod bagnold;
mod bed_lines;
mod bifluid_poiseuille;
mod bingham_poiseuille;
mod cantilever;
mod columns;
mod contract;
mod couette;
mod displacement;
mod elastic_shear_wave;
mod energy;
mod eroded_mass;
mod extent;
mod front;
mod hagen_poiseuille;
mod hydrostatic;
mod interface;
mod interpolate;
mod level;
mod line;
mod near;
pub mod norm;
mod phase;
mod phase_energy;
mod phase_volume;
mod point;
mod poiseuille;
mod pore_pressure;
mod profile;
mod range;
mod rigid_rotation;
mod rotating_square;
mod scour_map;
mod slope;
mod stream_function;
mod taylor_green;
mod wall_force;
mod yielded;

pub use angular_momentum::AngularMomentum;
pub use bagnold::Bagnold;
pub use bed_lines::BedLines;
pub use bifluid_poiseuille::BifluidPoiseuille;
pub use bingham_poiseuille::BinghamPoiseuille;
pub use cantilever::Cantilever;
pub use contract::{Probe, ProbeColumn, ProbeEntry, Solution, SolutionEntry};
pub use couette::Couette;
pub use displacement::DisplacementProbe;
pub use elastic_shear_wave::ElasticShearWave;
pub use energy::KineticEnergy;
pub use eroded_mass::ErodedMass;
pub use extent::Extent;
pub use front::Front;
pub use hagen_poiseuille::HagenPoiseuille;
pub use hydrostatic::Hydrostatic;
pub use interface::Interface;
pub use interpolate::{Interpolated, interpolate};
pub use level::Level;
pub use line::{Line, LineOf};
pub use phase_energy::PhaseEnergy;
pub use phase_volume::PhaseVolume;
pub use point::{PressureProbe, VelocityProbe};
pub use poiseuille::Poiseuille;
pub use pore_pressure::PorePressureProbe;
pub use profile::{Component, Profile};
pub use range::FieldRange;
pub use rigid_rotation::RigidRotation;
pub use rotating_square::RotatingSquare;
pub use scour_map::ScourMap;
pub use slope::SurfaceSlope;
pub use stream_function::StreamFunction;
pub use taylor_green::TaylorGreen;
pub use wall_force::WallForceProbe;
pub use yielded::Yielded;
