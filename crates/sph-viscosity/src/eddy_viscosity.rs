//! What gives the viscosity of eddies that particles do not resolve.

use sph_contribution::{Contribution, Setting};
use sph_core::{Stage, contract};
use sph_neighbours::World;

/// A turbulence model that acts as a viscosity η_t beside that of the laws: τ = 2 (η + η_t) D.
///
/// The stage may read the velocity gradient and the strain rate, whether or not a law needs them, and writes zero where there is
/// no turbulence, as within a soil. An implicit step takes η_t of its beginning.
pub trait EddyViscosity<const D: usize>: Send {
    /// The stage that writes [`EDDY_VISCOSITY`](sph_core::fields::EDDY_VISCOSITY), Pa s.
    fn stage(&self) -> Box<dyn Stage<World<D>>>;
    /// The same stage, where it depends on the scene: on which phases it acts. [`stage`](Self::stage) if left out.
    fn stage_in(&self, _setting: &Setting<'_, D>) -> Box<dyn Stage<World<D>>> {
        self.stage()
    }
    /// What it brings besides: what it refuses, columns, transported scalars, stages, work within a step.
    fn contribution(&self) -> Option<Box<dyn Contribution<D>>> {
        None
    }
}

contract!(
    /// An eddy viscosity that a scene may name. Those of this project are in `sph-turbulence`.
    pub EddyViscosityEntry, "eddy-viscosity", "viscosity of eddies that particles do not resolve", EddyViscosity<D>
);
