//! What a run measures and what it is compared with.
//!
//! * [`Probe`]: columns of the time series, from the state of the flow ([`Front`],
//!   [`PressureProbe`], [`VelocityProbe`], [`Level`], [`FieldRange`]).
//! * [`Solution`]: analytical flows, as references and as initial states.
//! * [`norm`]: the norms in which errors are reported.

mod contract;
mod couette;
mod energy;
mod front;
mod hydrostatic;
mod interpolate;
mod level;
pub mod norm;
mod point;
mod poiseuille;
mod range;
mod taylor_green;

pub use contract::{Probe, ProbeColumn, ProbeEntry, Solution, SolutionEntry};
pub use couette::Couette;
pub use energy::KineticEnergy;
pub use front::Front;
pub use hydrostatic::Hydrostatic;
pub use interpolate::{Interpolated, interpolate};
pub use level::Level;
pub use point::{PressureProbe, VelocityProbe};
pub use poiseuille::Poiseuille;
pub use range::FieldRange;
pub use taylor_green::TaylorGreen;
