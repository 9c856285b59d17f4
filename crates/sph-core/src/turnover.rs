//! Particles that are taken out of a store, or come into it, while a flow runs.

use std::ops::Range;

use crate::store::{Entry, Store};
use crate::{FieldError, fields};

impl<const D: usize> Store<D> {
    /// Takes out the particles for which `leaves` is true; the others keep their order.
    ///
    /// Entries beyond the end of `leaves` stay. Derived columns are cut as the others are, and hold
    /// the values of the former neighbours until they are computed anew.
    pub fn take_out(&mut self, leaves: &[bool]) -> Store<D> {
        let leaves = |slot: &u32| leaves.get(*slot as usize) == Some(&true);
        let (out, stay): (Vec<u32>, Vec<u32>) = (0..self.len as u32).partition(leaves);
        let entries = self.entries.iter().map(|entry| Entry {
            column: entry.picked(&out),
            ..*entry
        });
        let taken = Store {
            entries: entries.collect(),
            ..Store::new(out.len())
        };
        self.keep_slots(&stay);
        taken
    }

    /// Adds particles behind the others, with new identities, and zeros in all other columns. Gives their slots.
    ///
    /// # Errors
    /// If there is no column of identities, or they are used up.
    pub fn give_birth(&mut self, count: usize) -> Result<Range<usize>, FieldError> {
        let first = self.inserted.identities;
        let exhausted = FieldError::Length(fields::IDENTITY.name, count, u32::MAX as usize);
        let next = u32::try_from(count).ok().and_then(|n| first.checked_add(n));
        let next = next.ok_or(exhausted)?;
        let slots = self.len..self.len + count;
        self.set_len(slots.end);
        let identity = self.get_mut(fields::IDENTITY)?;
        for (slot, id) in slots.clone().zip(first..next) {
            identity[slot] = id;
        }
        self.inserted.identities = next;
        self.inserted.particles += count as u64;
        Ok(slots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Inserted, Role};

    /// Particles of these identities, each with a mass of one more.
    fn store(identities: &[u32]) -> Store<2> {
        let mut store = Store::new(identities.len());
        store.add(fields::IDENTITY, Role::State);
        store.add(fields::MASS, Role::State);
        store.add(fields::DENSITY, Role::Derived);
        *store.get_mut(fields::IDENTITY).unwrap() = identities.to_vec();
        let masses = identities.iter().map(|id| f64::from(id + 1)).collect();
        *store.get_mut(fields::MASS).unwrap() = masses;
        store
    }

    #[test]
    fn removed_particles_are_complete_and_the_others_keep_their_order() {
        let mut store = store(&[4, 0, 3, 1, 2]);
        let out = store.take_out(&[false, true, false, true]);
        assert_eq!((store.len(), out.len()), (3, 2));
        assert_eq!(store.get(fields::IDENTITY).unwrap(), [4, 3, 2]);
        assert_eq!(out.get(fields::MASS).unwrap(), [1.0, 2.0]);
        assert_eq!(store.get(fields::DENSITY).unwrap().len(), 3);
        assert_eq!(store.get(fields::MASS).unwrap(), [5.0, 4.0, 3.0]);
    }

    #[test]
    fn births_and_deaths_of_one_step_are_taken_back_and_identities_are_never_given_twice() {
        let mut store = store(&[0, 1, 2]);
        let given = |identities| Inserted {
            identities,
            ..Inserted::default()
        };
        store.inserted = given(3);
        let mut saved = Store::default();
        store.save_state(&mut saved).unwrap();
        store.take_out(&[true, false, true]);
        let slots = store.give_birth(2).unwrap();
        assert_eq!((slots, store.len()), (1..3, 3));
        assert_eq!(store.get(fields::IDENTITY).unwrap(), [1, 3, 4]);
        assert_eq!(store.get(fields::MASS).unwrap(), [2.0, 0.0, 0.0]);
        store.give_birth(1).unwrap();
        store.restore_state(&saved).unwrap();
        assert_eq!(store.get(fields::IDENTITY).unwrap(), [0, 1, 2]);
        assert_eq!(store.get(fields::MASS).unwrap(), [1.0, 2.0, 3.0]);
        assert_eq!(store.get(fields::DENSITY).unwrap().len(), 3);
        assert_eq!(store.inserted.identities, 3, "the step is done again");
        store.inserted = given(u32::MAX - 1);
        assert!(store.give_birth(2).is_err(), "identities are used up");
    }
}
