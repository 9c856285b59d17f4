//! Particles as bytes: how they go from one process to another.

use crate::field::{AnyField, Item, each_type};
use crate::{FieldError, Store};

impl<const D: usize> Store<D> {
    /// Bytes of one particle over the columns that are `wanted`.
    pub fn parcel_bytes(&self, wanted: impl Fn(&AnyField) -> bool) -> usize {
        let all = self.entries.iter().filter(|e| wanted(&e.field));
        all.map(|e| e.column.size()[1]).sum()
    }

    /// A message with the entries of these slots, column by column, of the columns that are `wanted`.
    pub fn pack(&self, wanted: impl Fn(&AnyField) -> bool, slots: &[u32]) -> Vec<u8> {
        let mut to = Vec::with_capacity(slots.len() * self.parcel_bytes(&wanted));
        let at = || slots.iter().map(|s| *s as usize);
        for entry in self.entries.iter().filter(|e| wanted(&e.field)) {
            each_type!(&entry.column, items => at().for_each(|s| items[s].pack(&mut to)));
        }
        to
    }

    /// Overwrites the entries of these slots with the result of [`pack`](Self::pack) of a store with the same columns.
    ///
    /// # Errors
    /// If the message has another length.
    pub fn unpack(
        &mut self,
        wanted: impl Fn(&AnyField) -> bool,
        slots: &[u32],
        mut from: &[u8],
    ) -> Result<(), FieldError> {
        let expected = slots.len() * self.parcel_bytes(&wanted);
        if from.len() != expected {
            return Err(FieldError::Length("message", from.len(), expected));
        }
        let at = || slots.iter().map(|s| *s as usize);
        for entry in self.entries.iter_mut().filter(|e| wanted(&e.field)) {
            each_type!(&mut entry.column, items => {
                at().for_each(|s| items[s] = Item::unpack(&mut from));
            });
        }
        Ok(())
    }

    /// A copy of all particles with all their columns, of which none has left or come in.
    pub fn copied(&self) -> Store<D> {
        Store {
            entries: self.entries.clone(),
            ..Store::new(self.len)
        }
    }

    /// Keeps the particles of these slots, in this order, with all their columns.
    pub fn keep_slots(&mut self, slots: &[u32]) {
        for entry in &mut self.entries {
            entry.column = entry.picked(slots);
        }
        self.len = slots.len();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{Index, Scalar, SymmetricTensor, Tensor, Vector};
    use crate::{Field, Role, Vect};

    const S: Field<Scalar> = Field::new("s", "1", "a scalar");
    const V: Field<Vector> = Field::new("v", "1", "a vector");
    const I: Field<Index> = Field::new("i", "1", "an index");
    const T: Field<Tensor> = Field::new("t", "1", "a tensor");
    const Y: Field<SymmetricTensor> = Field::new("y", "1", "a symmetric tensor");

    fn store(len: usize) -> Store<2> {
        let mut store = Store::new(len);
        store.add(S, Role::State);
        store.add(V, Role::Derived);
        store.add(I, Role::State);
        store.add(T, Role::State);
        store.add(Y, Role::Derived);
        store
    }

    #[test]
    fn packed_values_arrive_in_the_named_slots() {
        let mut from = store(3);
        *from.get_mut(S).unwrap() = vec![1.0, -0.0, f64::NAN];
        *from.get_mut(V).unwrap() = (0..3).map(|k| Vect::<2>::new(f64::from(k), 0.5)).collect();
        *from.get_mut(I).unwrap() = vec![7, 8, u32::MAX];
        from.get_mut(T).unwrap()[2][(0, 1)] = 3.0;
        from.get_mut(Y).unwrap()[2].0[5] = 4.0;
        let message = from.pack(|_| true, &[2, 0]);
        assert_eq!(message.len(), 2 * from.bytes_per_particle());
        let mut to = store(4);
        to.unpack(|_| true, &[1, 3], &message).unwrap();
        assert!(to.get(S).unwrap()[1].is_nan() && to.get(S).unwrap()[3] == 1.0);
        assert_eq!(to.get(V).unwrap()[1], Vect::<2>::new(2.0, 0.5));
        assert_eq!(to.get(I).unwrap(), [0, u32::MAX, 0, 7]);
        assert_eq!(to.get(T).unwrap()[1][(0, 1)], 3.0);
        assert_eq!(to.get(Y).unwrap()[1].0[5], 4.0);
        assert!(to.unpack(|_| true, &[1], &message).is_err(), "too long");
        to.keep_slots(&[3, 1]);
        assert_eq!((to.len(), to.get(I).unwrap()), (2, &[7, u32::MAX][..]));
        let only = |f: &AnyField| f.name == I.name;
        to.unpack(only, &[0], &from.pack(only, &[1])).unwrap();
        assert_eq!(to.get(I).unwrap(), [8, u32::MAX]);
    }
}
