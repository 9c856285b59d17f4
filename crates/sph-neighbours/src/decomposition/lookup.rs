//! Particles of an earlier moment, which have gone to other ranks since.

use sph_core::{AnyField, Slots, Store, fields};

use crate::decomposition::{
    link::{OWNER, Partner},
    {PartError, Parts},
};

impl<const D: usize> Parts<D> {
    /// Brings an earlier copy of this rank's particles into the present order: particles that have come since are asked
    /// of their earlier ranks, particles that have gone are left out. Every rank must call it.
    ///
    /// # Errors
    /// Another rank that has failed; messages that fail; a particle that no rank had.
    pub fn follow(&self, earlier: &mut Store<D>, now: &Store<D>) -> Result<(), PartError> {
        self.link.any(false, false)?;
        let transport = &self.link.transport;
        let rank = transport.rank();
        let owners = now.get(OWNER)?;
        let now = now.get(fields::IDENTITY)?;
        let then = Slots::from_identities(earlier.get(fields::IDENTITY)?);
        let wanted = now.iter().filter(|id| then.slot(**id).is_none());
        let wanted: Vec<u8> = wanted.flat_map(|id| id.to_le_bytes()).collect();
        let all = transport.all(&wanted)?;
        let owner = earlier.get(OWNER)?;
        let had = |bytes: &[u8; 4]| {
            let slot = then.slot(u32::from_le_bytes(*bytes));
            slot.filter(|slot| owner[*slot as usize] as usize == rank)
        };
        let to = |(rank, wanted): (usize, &Vec<u8>)| -> Partner {
            let slots = wanted.as_chunks::<4>().0.iter().filter_map(had);
            (rank, slots.collect())
        };
        let sends: Vec<Partner> = all.iter().enumerate().map(to).collect();
        let some = |(to, slots): &Partner| *to != rank && !slots.is_empty();
        let sends = sends.into_iter().filter(some);
        let message = |(to, slots): Partner| (to, earlier.pack(|_: &AnyField| true, &slots));
        let messages = sends.map(message).collect();
        self.receive(earlier, messages)?;
        let then = Slots::from_identities(earlier.get(fields::IDENTITY)?);
        let missing = sph_core::FieldError::Missing(fields::IDENTITY.name);
        let order = now.iter().map(|id| then.slot(*id));
        let order: Option<Vec<u32>> = order.collect();
        earlier.keep_slots(&order.ok_or(missing)?);
        Ok(earlier.set_index(OWNER.name, owners)?)
    }
}
