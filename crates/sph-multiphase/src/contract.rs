//! What formulations, viscous operators, smoothers, interface models and shifting are.

use std::sync::Arc;

use sph_core::{Evolved, Field, Scalar, Stage, StepError, contract};
use sph_neighbours::{Interaction, World};

use crate::{BoundState, Coupling, Limiter};

/// The equations of state with their reference states, in the order of the phase numbers.
pub type Laws = Arc<[Box<dyn BoundState>]>;

/// Stages of an evaluation.
pub type Stages<const D: usize> = Vec<Box<dyn Stage<World<D>>>>;

/// How density diffusion reaches what a formulation integrates.
#[derive(Clone, Copy)]
pub struct Diffused {
    /// The integrated scalar and its rate.
    pub evolved: Evolved,
    /// d(value)/dρ from density, volume and γ.
    pub per_density: fn(density: f64, volume: f64, gamma: f64) -> f64,
}

/// A scalar that motion compresses: d ln(value)/dt = exponent · D{u}.
#[derive(Clone, Copy)]
pub struct Compressed {
    /// The integrated scalar.
    pub value: Field<Scalar>,
    /// −1 for a density, 1 for a volume.
    pub exponent: f64,
}

/// The definition of density and the pressure gradient that belongs to it.
pub trait Formulation<const D: usize>: Send {
    /// The scalar it integrates in time, which density diffusion changes.
    fn diffused(&self) -> Diffused;
    /// The scalar that drifts with the divergence, for formulations that integrate continuity.
    fn compressed(&self) -> Option<Compressed> {
        None
    }
    /// The stages that give density and volume at the present state.
    fn stages(&self) -> Stages<D>;
    /// The pressure term of the interaction sweep.
    fn pressure_term(&self) -> Box<dyn Interaction<D>>;
    /// D{u}, the divergence that belongs to the pressure gradient, as the scalar of
    /// [`Rates`](sph_neighbours::Rates), 1/s. With Σ over particles and without walls,
    /// Σ V p D{u} = −Σ V u·G{p}.
    fn divergence(&self) -> Box<dyn Interaction<D>>;
    /// Sets the evolved scalars so that the stages return the density column as it is.
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
    /// The viscosity column; one phase.
    PerParticle,
    /// The viscosity column; several phases.
    PerPhase,
}

/// A second-order operator for the viscous force.
pub trait ViscousOperator<const D: usize>: Send {
    /// The viscous term of the interaction sweep.
    fn term(&self, viscosity: Viscosity) -> Box<dyn Interaction<D>>;
    /// What the term needs to know of all particles before the sweep.
    fn stages(&self, _viscosity: Viscosity) -> Stages<D> {
        Vec::new()
    }
    /// The same friction as rows of a matrix, for implicit schemes.
    fn coupling(&self, viscosity: Viscosity) -> Box<dyn Coupling<D>>;
    /// How much stiffer than Morris's operator it is: divides the viscous step limit.
    fn stiffness(&self) -> f64;
    /// Whether a rigid rotation feels nothing of it, at free surfaces too.
    fn leaves_rotations(&self) -> bool {
        false
    }
}

contract!(
    /// A viscous operator that a scene may name.
    pub ViscousOperatorEntry, "viscous-operator", "the discrete div(η grad u) and its kin", ViscousOperator<D>
);

/// A density diffusion that damps the chequerboard mode of pressure.
pub trait Smoother<const D: usize>: Send {
    /// What must be known of all particles before the sweep.
    fn stages(&self, _laws: &Laws) -> Stages<D> {
        Vec::new()
    }
    /// The term; it adds dρ/dt to [`Rates::scalar`](sph_neighbours::Rates). It may read the phase
    /// column where there are several laws.
    fn term(&self, laws: &Laws) -> Box<dyn Interaction<D>>;
    /// Up to which step it evens out instead of overshooting.
    fn limiter(&self, _laws: &Laws) -> Option<Box<dyn Limiter<D>>> {
        None
    }
}

contract!(
    /// A smoother that a scene may name.
    pub SmootherEntry, "smoother", "density diffusion against pressure noise", Smoother<D>
);

/// A force where phases meet.
pub trait InterfaceModel<const D: usize>: Send {
    /// What must be known of all particles before the sweep.
    fn stages(&self) -> Stages<D> {
        Vec::new()
    }
    /// The term of the interaction sweep; it may read the phase column.
    fn term(&self, laws: &Laws) -> Box<dyn Interaction<D>>;
    /// Its bound on the step, if it has one.
    fn limiter(&self, _laws: &Laws) -> Option<Box<dyn Limiter<D>>> {
        None
    }
}

contract!(
    /// An interface model that a scene may name.
    pub InterfaceEntry, "interface", "a force where phases meet", InterfaceModel<D>
);

/// What keeps particles evenly spread.
pub trait Shifting<const D: usize>: Send {
    /// The stages; the last one writes [`SHIFT_VELOCITY`](sph_core::fields::SHIFT_VELOCITY).
    fn stages(&self, laws: &Laws) -> Stages<D>;
    /// What particles take up where they are shifted to, as rates of velocity and density.
    fn term(&self, _flow: ShiftedFlow) -> Option<Box<dyn Interaction<D>>> {
        None
    }
}

/// What shifting may ask of a scene.
#[derive(Clone, Copy, Debug)]
pub struct ShiftedFlow {
    /// Whether the density is a sum over positions, which the shifting changes.
    pub summed: bool,
}

contract!(
    /// A shifting scheme that a scene may name.
    pub ShiftingEntry, "shifting", "what keeps particles evenly spread", Shifting<D>
);
