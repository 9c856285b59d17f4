//! What a rheology is.

use sph_core::contract;

/// The inputs a law reads; only those are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Magnitude of the strain rate γ̇ = √(2 γ̇:γ̇), 1/s.
    pub strain_rate: bool,
    /// Pressure, Pa.
    pub pressure: bool,
}

/// The inputs of a batch; slices that the law did not ask for are empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct Inputs<'a> {
    /// Magnitude of the strain rate, 1/s.
    pub strain_rate: &'a [f64],
    /// Pressure, Pa.
    pub pressure: &'a [f64],
}

/// A generalised Newtonian law τ = 2 η γ̇ with an effective viscosity η.
pub trait Rheology: Send + Sync + std::fmt::Debug {
    /// What the law reads.
    fn needs(&self) -> Needs;
    /// The viscosity if it is one number for all times and places, Pa s. Then no viscosity
    /// column is allocated.
    fn uniform_viscosity(&self) -> Option<f64>;
    /// Effective viscosity of a batch, Pa s.
    fn viscosity(&self, inputs: &Inputs<'_>, viscosity: &mut [f64]);
    /// A bound of the viscosity for the time step, Pa s.
    fn largest_viscosity(&self) -> f64;
}

contract!(
    /// A rheology that a scene may name.
    pub RheologyEntry, "rheology", "the constitutive law of a phase", Rheology
);
