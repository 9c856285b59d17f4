//! What smoothers and shifting are.

use sph_contribution::{Limiter, Stages};
use sph_core::contract;
use sph_neighbours::Interaction;
use sph_state::Laws;

use crate::Accelerated;

/// A density diffusion that damps the chequerboard mode of pressure.
pub trait Smoother<const D: usize>: Send {
    /// What must be known of all particles before the sweep.
    fn stages(&self, _laws: &Laws) -> Stages<D> {
        Vec::new()
    }
    /// The term; it adds dρ/dt to [`Rates::scalar`](sph_neighbours::Rates). It may read the phase
    /// column where there are several laws.
    fn term(&self, laws: &Laws) -> Box<dyn Interaction<D>>;
    /// Learns that no wall holds the fluid still: all walls of the scene move, or it falls.
    fn carried(&mut self) {}
    /// Which accelerations its term takes the mean of, [`MEAN_ACCELERATION`](sph_core::fields::MEAN_ACCELERATION), if it does.
    fn accelerated(&self) -> Option<Accelerated> {
        None
    }
    /// Whether it evens out pressures, and not densities: there is no bound on it where the pressure is that of the end of the
    /// step.
    fn of_pressures(&self) -> bool {
        false
    }
    /// Up to which step it evens out instead of overshooting.
    fn limiter(&self, _laws: &Laws) -> Option<Box<dyn Limiter<D>>> {
        None
    }
}

contract!(
    /// A smoother that a scene may name.
    pub SmootherEntry, "smoother", "density diffusion against pressure noise", Smoother<D>
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
