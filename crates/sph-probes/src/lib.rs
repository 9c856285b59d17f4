//! What a run measures and what it is compared with.
//!
//! * [`Probe`]: columns of the time series, from the state of the flow ([`Front`],
//!   [`PressureProbe`], [`VelocityProbe`], [`Level`], [`FieldRange`], [`WallForceProbe`]).
//! * [`Solution`]: analytical flows, as references and as initial states.
//! * [`norm`]: the norms in which errors are reported.

mod angular_momentum;
mod contract;
mod couette;
mod energy;
mod front;
mod hagen_poiseuille;
mod hydrostatic;
mod interpolate;
mod level;
pub mod norm;
mod point;
mod poiseuille;
mod range;
mod rigid_rotation;
mod taylor_green;
mod wall_force;

pub use angular_momentum::AngularMomentum;
pub use contract::{Probe, ProbeColumn, ProbeEntry, Solution, SolutionEntry};
pub use couette::Couette;
pub use energy::KineticEnergy;
pub use front::Front;
pub use hagen_poiseuille::HagenPoiseuille;
pub use hydrostatic::Hydrostatic;
pub use interpolate::{Interpolated, interpolate};
pub use level::Level;
pub use point::{PressureProbe, VelocityProbe};
pub use poiseuille::Poiseuille;
pub use range::FieldRange;
pub use rigid_rotation::RigidRotation;
pub use taylor_green::TaylorGreen;
pub use wall_force::WallForceProbe;
