//! Saving and resuming.

use serde::{Deserialize, Serialize};

use crate::grains::setup::{Period, positive};
use crate::grains::stability::Limit;
use crate::grains::table::Table;
use crate::grains::{ContactLaw, GrainError, GrainSystem, Grains, Mesh, Vector, Wall};

/// Everything a run needs to go on bit for bit, but for the contact laws: columns of the grains, walls,
/// meshes, and the memory of contacts. For any serde format that keeps every bit of a number.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct State {
    grains: Grains,
    walls: Vec<Wall>,
    meshes: Vec<Mesh>,
    period: Period,
    gravity: Vector,
    damping: f64,
    skin: f64,
    time: f64,
    steps: u64,
    last_step: f64,
    limit: Option<Limit>,
    limit_due: u64,
    contacts: Table,
    renewals: u64,
}

impl GrainSystem {
    /// State to resume.
    pub fn save(&self) -> State {
        State {
            grains: self.grains.clone(),
            walls: self.walls.clone(),
            meshes: self.meshes.clone(),
            period: self.period,
            gravity: self.gravity,
            damping: self.damping,
            skin: self.skin,
            time: self.time,
            steps: self.steps,
            last_step: self.last_step,
            limit: self.limit,
            limit_due: self.limit_due,
            contacts: self.table.touching(),
            renewals: self.renewals,
        }
    }

    /// Goes on from a saved state with the same laws. The lists of neighbours are made anew, which changes no
    /// bit of what follows: contacts are summed in the order of the grains' numbers, whatever else is in the lists.
    ///
    /// # Errors
    /// A state whose parts do not fit together, and laws out of range.
    pub fn resume(state: State, laws: Vec<Box<dyn ContactLaw>>) -> Result<Self, GrainError> {
        let bad = |problem| Err(GrainError::BadState(problem));
        let (table, n) = (&state.contacts, state.grains.len());
        if !state.grains.fits() {
            return bad("columns of the grains differ in length");
        }
        let parts = 1 + state.walls.len() + state.meshes.len();
        let ordered = table.ends.is_sorted() && table.ends.last() == Some(&table.slots.len());
        if table.ends.len() != parts || !ordered {
            return bad("contacts do not fit the walls and meshes");
        }
        for part in 0..parts {
            let most = match part.checked_sub(1 + state.walls.len()) {
                Some(mesh) => state.meshes[mesh].triangles.len(),
                None => n,
            };
            let known = |k: usize| {
                let slot = &table.slots[k];
                (slot.first as usize) < n && (slot.second as usize) < most
            };
            if !table.part(part).all(known) {
                return bad("a contact names a body that is not there");
            }
        }
        for i in 0..n {
            positive(i, "radius", state.grains.radius[i])?;
            positive(i, "mass", state.grains.mass[i])?;
        }
        let mut system = Self {
            grains: state.grains,
            laws,
            walls: state.walls,
            meshes: state.meshes,
            period: state.period,
            gravity: state.gravity,
            damping: state.damping,
            skin: state.skin,
            time: state.time,
            steps: state.steps,
            last_step: state.last_step,
            limit: state.limit,
            limit_due: state.limit_due,
            table: state.contacts,
            renewals: state.renewals,
        };
        system.check()?;
        system.renew();
        Ok(system)
    }
}
