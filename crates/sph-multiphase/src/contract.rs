//! What formulations, viscous operators and smoothers are.

use sph_core::{Evolved, Stage, StepError, contract};
use sph_neighbours::{Interaction, World};

/// The definition of density and the pressure gradient that belongs to it.
pub trait Formulation<const D: usize>: Send {
    /// Scalars it integrates in time, with their rates.
    fn evolved(&self) -> Vec<Evolved>;
    /// The stage that gives density (and volume) at the present positions.
    fn density_stage(&self) -> Box<dyn Stage<World<D>>>;
    /// The pressure term of the interaction sweep.
    fn pressure_term(&self) -> Box<dyn Interaction<D>>;
    /// Sets the evolved scalars so that the density stage returns the density column as it is.
    ///
    /// Called at the start, and again whenever the sum changes for another reason than motion.
    ///
    /// # Errors
    /// If a column is missing.
    fn rebase(&self, world: &mut World<D>) -> Result<(), StepError>;
}

contract!(
    /// A formulation that a scene may name.
    pub FormulationEntry, "formulation", "density and the pressure gradient that belongs to it", Formulation<D>
);

/// Where a viscous operator finds the viscosity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viscosity {
    /// One number for all particles, Pa s; no column exists.
    Uniform(f64),
    /// The viscosity column.
    PerParticle,
}

/// A second-order operator for the viscous force.
pub trait ViscousOperator<const D: usize>: Send {
    /// The viscous term of the interaction sweep.
    fn term(&self, viscosity: Viscosity) -> Box<dyn Interaction<D>>;
    /// How much stiffer than Morris's operator it is: divides the viscous step limit.
    fn stiffness(&self) -> f64;
}

contract!(
    /// A viscous operator that a scene may name.
    pub ViscousOperatorEntry, "viscous-operator", "the discrete div(η grad u) and its kin", ViscousOperator<D>
);

/// A density diffusion that damps the chequerboard mode of pressure.
pub trait Smoother<const D: usize>: Send {
    /// The term; it adds γ dρ/dt to [`Rates::scalar`](sph_neighbours::Rates).
    fn term(&self) -> Box<dyn Interaction<D>>;
}

contract!(
    /// A smoother that a scene may name.
    pub SmootherEntry, "smoother", "density diffusion against pressure noise", Smoother<D>
);
