//! Friction of fluids: viscous operators, solved for or not, and viscosities of eddies.
//!
//! * [`ViscousOperator`] is a kind of plugin: [`Morris`], [`MonaghanGingold`], [`EspanolRevenga`], [`HuAdamsViscosity`],
//!   [`KrimiViscosity`]. [`PairFriction`] is what most of them are made of, [`Coupling`] the same as rows of a matrix.
//! * [`ImplicitViscosity`] takes friction from the end of the step, [`viscous_limit`] bounds the step where it does not.
//! * Eddy viscosities ([`EddyViscosityEntry`]) are added to the viscosity of the laws; none is in this crate.

mod body_response;
mod contract;
mod friction;
mod friction_operator;
mod friction_system;
mod implicit;
mod interface_distance;
mod operators;
mod solves;
mod viscosity_source;

pub use contract::{
    BoundCoupling, Coupling, CouplingRow, EddyViscosityEntry, Viscosity, ViscousOperator,
    ViscousOperatorEntry, WithCoupling, viscous_limit,
};
pub use friction::{Across, Choice, OnLattice, PairFriction, ViscousTerm, WallTerm};
pub use friction_operator::FrictionOperator;
pub use friction_system::FrictionSystem;
pub use implicit::{ImplicitViscosity, PicardUpdates};
pub use interface_distance::INTERFACE_DISTANCE;
pub use operators::{
    EspanolRevenga, HuAdamsViscosity, KrimiViscosity, MonaghanGingold, Morris, Strength,
};
pub use solves::{OuterSolves, SolveArrest, Solves};
pub use viscosity_source::{BoundViscosity, Layers, OwnViscosity, ViscositySource, Within};
