//! Particles that come into a store while a flow runs.

use std::ops::Range;

use crate::{FieldError, Inserted, Store, fields};

impl<const D: usize> Store<D> {
    /// Particles born so far.
    pub fn inserted(&self) -> Inserted {
        self.born
    }

    /// Sets the counts of inserted particles.
    pub fn set_inserted(&mut self, born: Inserted) {
        self.born = born;
    }

    /// Adds particles behind the others, with new identities, and zeros in all other columns. Gives their slots.
    ///
    /// # Errors
    /// If there is no column of identities, or they are used up.
    pub fn give_birth(&mut self, count: usize) -> Result<Range<usize>, FieldError> {
        let first = self.born.identities;
        let exhausted = FieldError::Length(fields::IDENTITY.name, count, u32::MAX as usize);
        let next = u32::try_from(count).ok().and_then(|n| first.checked_add(n));
        let next = next.ok_or(exhausted)?;
        let slots = self.len..self.len + count;
        self.set_len(slots.end);
        let identity = self.get_mut(fields::IDENTITY)?;
        for (slot, id) in slots.clone().zip(first..next) {
            identity[slot] = id;
        }
        self.born.identities = next;
        self.born.particles += count as u64;
        Ok(slots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Role, Saved};

    #[test]
    fn births_and_deaths_of_one_step_are_taken_back_and_identities_are_never_given_twice() {
        let mut store = Store::<2>::new(3);
        store.add(fields::IDENTITY, Role::State);
        store.add(fields::MASS, Role::State);
        store.add(fields::DENSITY, Role::Derived);
        *store.get_mut(fields::IDENTITY).unwrap() = vec![0, 1, 2];
        *store.get_mut(fields::MASS).unwrap() = vec![1.0, 2.0, 3.0];
        store.set_inserted(Inserted {
            identities: 3,
            ..Inserted::default()
        });
        let mut saved = Saved::default();
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
        assert_eq!(store.inserted().identities, 3, "the step is done again");
        store.set_inserted(Inserted {
            identities: u32::MAX - 1,
            ..Inserted::default()
        });
        assert!(store.give_birth(2).is_err(), "identities are used up");
    }
}
