//! Saving and resuming.

use serde::{Deserialize, Serialize};

use crate::coupled::pores::{PRESSED, Places, Pores};
use crate::coupled::system::{Clock, check};
use crate::coupled::{CoupledError, CoupledSystem, FlowSetup};
use crate::flow::Conductance;
use crate::grains::{ContactLaw, GrainSystem};

/// Everything a run needs to go on bit for bit, but for the laws of contacts and throats. For any serde format that
/// keeps every bit of a number.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct State {
    grains: crate::grains::State,
    setup: FlowSetup,
    /// Places at which the mesh was made; it is made again there.
    places: Places,
    clock: Clock,
}

impl CoupledSystem {
    /// State to resume.
    pub fn save(&self) -> State {
        State {
            grains: self.grains.save(),
            setup: self.setup.clone(),
            places: self.pores.places.clone(),
            clock: self.clock.clone(),
        }
    }

    /// Goes on from a saved state with the laws of contacts and conductances that the saved run had.
    ///
    /// # Errors
    /// A state whose parts do not fit together.
    pub fn resume(
        state: State,
        laws: Vec<Box<dyn ContactLaw>>,
        law: Box<dyn Conductance>,
    ) -> Result<Self, CoupledError> {
        let grains = GrainSystem::resume(state.grains, laws)?;
        let setup = state.setup;
        check(&grains, &setup)?;
        let bad = |problem| Err(CoupledError::BadState(problem));
        let (places, clock) = (state.places, state.clock);
        if places.centres.len() != grains.grains.len() || places.walls.len() != grains.walls.len() {
            return bad("the mesh is that of other grains or walls");
        }
        let pores = Pores::new(places, &grains, &setup, &*law, clock.storage_step, PRESSED)?;
        let cells = pores.geometry.volumes.len();
        let columns = [&clock.volumes, &clock.rates, &clock.pressures];
        if columns.iter().any(|c| c.len() != cells) {
            return bad("columns of the pores differ in length from the mesh");
        }
        Ok(Self::from_parts(grains, setup, law, pores, clock))
    }
}
