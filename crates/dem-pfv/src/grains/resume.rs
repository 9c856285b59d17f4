//! Saving and resuming.

use crate::grains::setup::positive;
use crate::grains::{ContactLaw, GrainError, GrainSystem, State};

impl GrainSystem {
    /// State to resume.
    pub fn save(&self) -> State {
        self.state.clone()
    }

    /// Goes on from a saved state with the same laws. The lists of neighbours are made anew, which changes no
    /// bit of what follows: contacts are summed in the order of the grains' numbers, whatever else is in the lists.
    ///
    /// # Errors
    /// A state whose parts do not fit together, and laws out of range.
    pub fn resume(state: State, laws: Vec<Box<dyn ContactLaw>>) -> Result<Self, GrainError> {
        let bad = |problem| Err(GrainError::BadState(problem));
        let (table, n) = (&state.table, state.grains.len());
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
        let mut system = Self { state, laws };
        system.check()?;
        system.renew();
        Ok(system)
    }
}
