//! Particles that are taken out of a store.

use crate::Removed;
use crate::field::Column;
use crate::store::{Entry, Store};

/// Entries of a column that were taken out, or all behind a place.
fn split<T: Copy>(items: &mut Vec<T>, leaves: &[bool]) -> Vec<T> {
    let both = || items.iter().zip(leaves);
    let out = both().filter(|(_, leaves)| **leaves).map(|(v, _)| *v);
    let out = out.collect();
    let kept = both().filter(|(_, leaves)| !**leaves).map(|(v, _)| *v);
    *items = kept.collect();
    out
}

macro_rules! each {
    ($column:expr, $items:ident => $done:expr) => {
        match $column {
            Column::Scalar($items) => Column::Scalar($done),
            Column::Vector($items) => Column::Vector($done),
            Column::Index($items) => Column::Index($done),
            Column::Tensor($items) => Column::Tensor($done),
            Column::SymmetricTensor($items) => Column::SymmetricTensor($done),
        }
    };
}

impl<const D: usize> Store<D> {
    /// Takes out the particles for which `leaves` is true; the others keep their order.
    ///
    /// Entries beyond the end of `leaves` stay. Derived columns are cut as the others are, and hold
    /// the values of the former neighbours until they are computed anew.
    pub fn take_out(&mut self, leaves: &[bool]) -> Store<D> {
        let mut leaves = leaves.to_vec();
        leaves.resize(self.len, false);
        let count = leaves.iter().filter(|l| **l).count();
        let mut out = Vec::with_capacity(self.entries.len());
        for entry in &mut self.entries {
            let column = each!(&mut entry.column, items => split(items, &leaves));
            out.push(Entry { column, ..*entry });
        }
        self.len -= count;
        Store {
            len: count,
            watch: Default::default(),
            entries: out,
            taken: Vec::new(),
            born: Default::default(),
            spare: Default::default(),
        }
    }

    /// Particles taken out so far, by outlet and phase.
    pub fn removed(&self) -> &[Removed] {
        &self.taken
    }

    /// Sets the counts of removed particles.
    pub fn set_removed(&mut self, taken: Vec<Removed>) {
        self.taken = taken;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Role, fields};

    #[test]
    fn removed_particles_are_complete_and_the_others_keep_their_order() {
        let mut store = Store::<2>::new(5);
        store.add(fields::MASS, Role::State);
        store.add(fields::IDENTITY, Role::State);
        store.add(fields::DENSITY, Role::Derived);
        let numbers = [4, 0, 3, 1, 2];
        *store.get_mut(fields::IDENTITY).unwrap() = numbers.to_vec();
        *store.get_mut(fields::MASS).unwrap() = numbers.map(f64::from).to_vec();
        let out = store.take_out(&[false, true, false, true]);
        assert_eq!((store.len(), out.len()), (3, 2));
        assert_eq!(store.get(fields::IDENTITY).unwrap(), [4, 3, 2]);
        assert_eq!(out.get(fields::MASS).unwrap(), [0.0, 1.0]);
        assert_eq!(store.get(fields::DENSITY).unwrap().len(), 3);
        let numbers = store.get(fields::MASS).unwrap();
        assert_eq!(numbers, [4.0, 3.0, 2.0]);
    }
}
