//! Slots of particles by their identities.

/// A map from identities, which are unique for ever and may have gaps, to slots in a store.
#[derive(Clone, Debug)]
pub enum Slots {
    /// By identity; [`u32::MAX`] where no particle has it. Where most identities are in use.
    Dense(Vec<u32>),
    /// Identity and slot, ascending.
    Sparse(Vec<(u32, u32)>),
}

/// Identities per particle above which a table of all of them is not worth its memory.
const SPARSE: usize = 4;

impl Slots {
    /// Of identities in the order of their slots.
    pub fn from_identities(identities: &[u32]) -> Self {
        let most = identities.iter().max().map_or(0, |id| *id as usize + 1);
        let slots = identities.iter().zip(0u32..);
        if most > SPARSE * identities.len() {
            let mut all: Vec<_> = slots.map(|(&id, slot)| (id, slot)).collect();
            all.sort_unstable();
            return Slots::Sparse(all);
        }
        let mut table = vec![u32::MAX; most];
        slots.for_each(|(&id, slot)| table[id as usize] = slot);
        Slots::Dense(table)
    }

    /// The slot of an identity; none if no particle has it.
    pub fn slot(&self, identity: u32) -> Option<u32> {
        match self {
            Slots::Dense(table) => {
                let slot = table.get(identity as usize).copied();
                slot.filter(|slot| *slot != u32::MAX)
            }
            Slots::Sparse(all) => {
                let found = all.binary_search_by_key(&identity, |(id, _)| *id);
                found.ok().map(|k| all[k].1)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_identity_has_its_slot_and_unknown_ones_have_none() {
        for identities in [vec![3, 0, 2], vec![4_000_000_000, 7, 90]] {
            let slots = Slots::from_identities(&identities);
            for (slot, id) in identities.iter().enumerate() {
                assert_eq!(slots.slot(*id), Some(slot as u32), "{slots:?}");
            }
            for id in [1, 5, 91, u32::MAX] {
                assert_eq!(slots.slot(id), None);
            }
        }
        assert!(matches!(
            Slots::from_identities(&[3, 0, 2]),
            Slots::Dense(_)
        ));
        assert!(matches!(
            Slots::from_identities(&[4_000_000_000]),
            Slots::Sparse(_)
        ));
    }
}
