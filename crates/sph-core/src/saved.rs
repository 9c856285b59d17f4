//! Copies of the memory of a store, to go back to.

use crate::store::Entry;
use crate::{FieldError, Role, Store};

impl<const D: usize> Store<D> {
    /// Copies every state column into a store of its own, which keeps its buffers.
    ///
    /// # Errors
    /// If a column has changed its type since it was copied last, as everywhere below.
    pub fn save_state(&self, saved: &mut Store<D>) -> Result<(), FieldError> {
        let state = || self.entries.iter().filter(|e| e.role == Role::State);
        if !state().map(|e| e.field).eq(saved.fields()) {
            saved.entries = state().cloned().collect();
        }
        for (entry, to) in state().zip(&mut saved.entries) {
            to.copy(entry, None)?;
        }
        saved.len = self.len;
        saved.removed.clone_from(&self.removed);
        saved.inserted = self.inserted;
        Ok(())
    }

    /// Puts everything back as it was saved: particles that left come back, particles born since are gone. State
    /// columns that have come since become zero; derived ones have to be computed anew.
    pub fn restore_state(&mut self, saved: &Store<D>) -> Result<(), FieldError> {
        self.set_len(saved.len);
        self.removed.clone_from(&saved.removed);
        self.inserted = saved.inserted;
        self.put_state(saved, None, |_| true)
    }

    /// Puts the copies of the state columns back whose names are `wanted`; `places` has the place of every present
    /// particle in the copies, and is `None` if the order is the same. Wanted state columns that have come since the
    /// copies were made become zero.
    ///
    /// # Errors
    /// If, besides, another number of particles was copied.
    pub fn put_state(
        &mut self,
        saved: &Store<D>,
        places: Option<&[u32]>,
        wanted: impl Fn(&str) -> bool,
    ) -> Result<(), FieldError> {
        let len = self.len;
        let state = |e: &&mut Entry<D>| e.role == Role::State && wanted(e.field.name);
        for entry in self.entries.iter_mut().filter(state) {
            let name = entry.field.name;
            let Ok(from) = saved.entry(name) else {
                entry.column = entry.field.shape.column(len);
                continue;
            };
            let [copied, _] = from.column.size();
            if places.map_or(copied, <[u32]>::len) != len {
                return Err(FieldError::Length(name, copied, len));
            }
            entry.copy(from, places)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields;

    /// Every column that was declared as state comes back, in another order too; derived ones do not.
    #[test]
    fn saved_particles_come_back_in_any_order() {
        let mut store = Store::<2>::new(3);
        store.add(fields::MASS, Role::State);
        store.add(fields::IDENTITY, Role::State);
        store.add(fields::DENSITY, Role::Derived);
        *store.get_mut(fields::MASS).unwrap() = vec![1.0, 2.0, 3.0];
        *store.get_mut(fields::IDENTITY).unwrap() = vec![0, 1, 2];
        let mut saved = Store::default();
        store.save_state(&mut saved).unwrap();
        store.permute(Role::State, &[2, 0, 1]);
        store.get_mut(fields::MASS).unwrap().fill(9.0);
        store.get_mut(fields::DENSITY).unwrap().fill(9.0);
        store.add(fields::PRESSURE, Role::State);
        store.get_mut(fields::PRESSURE).unwrap().fill(9.0);
        let only = |name: &str| name == "mass" || name == "pressure";
        store.put_state(&saved, Some(&[2, 0, 1]), only).unwrap();
        assert_eq!(store.get(fields::MASS).unwrap(), [3.0, 1.0, 2.0]);
        assert_eq!(store.get(fields::IDENTITY).unwrap(), [2, 0, 1]);
        assert_eq!(store.get(fields::DENSITY).unwrap(), [9.0; 3]);
        assert_eq!(store.get(fields::PRESSURE).unwrap(), [0.0; 3], "new since");
        store.put_state(&saved, None, |_| true).unwrap();
        assert_eq!(store.get(fields::IDENTITY).unwrap(), [0, 1, 2]);
        let fewer = store.take_out(&[true]);
        assert!(store.put_state(&saved, None, |_| true).is_err());
        assert_eq!(fewer.len(), 1);
    }
}
