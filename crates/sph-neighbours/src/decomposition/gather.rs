//! The whole flow at one rank, for files and measurements.

use sph_core::{AnyField, Vect};

use crate::World;
use crate::decomposition::link::OWNER;
use crate::decomposition::{PartError, Parts};

impl<const D: usize> Parts<D> {
    /// Gathers the particles of all ranks into a world with the same columns, but for the owner, at rank 0, which has the `whole`: in
    /// the order and with the lists that one process would have.
    ///
    /// # Errors
    /// Messages that fail; a column that is missing.
    pub fn gather(
        &mut self,
        world: &World<D>,
        whole: Option<&mut World<D>>,
    ) -> Result<(), PartError> {
        let rank = self.link.transport.rank() as u32;
        let owners = world.free.get(OWNER)?;
        let own = |k: &usize| owners[*k] == rank;
        let slots: Vec<u32> = (0..owners.len()).filter(own).map(|k| k as u32).collect();
        let mut message = world.free.pack(|f: &AnyField| f.name != OWNER.name, &slots);
        let reference = &world.lists.reference;
        let numbers = slots.iter().flat_map(|s| reference[*s as usize].iter());
        numbers.for_each(|x| message.extend_from_slice(&x.to_le_bytes()));
        let messages = self.link.transport.gather(message)?;
        match whole {
            Some(whole) => join(world, whole, &messages),
            None => Ok(()),
        }
    }
}

fn join<const D: usize>(
    part: &World<D>,
    whole: &mut World<D>,
    messages: &[Vec<u8>],
) -> Result<(), PartError> {
    let wanted = |f: &AnyField| f.name != OWNER.name;
    // Columns that came into being on the way.
    let roles = part.free.columns().map(|(_, _, role, ..)| role);
    for (field, role) in part.free.fields().zip(roles) {
        if wanted(&field) {
            whole.free.add_any(field, role);
        }
    }
    let each = part.free.parcel_bytes(wanted);
    let with = each + 8 * D;
    let total: usize = messages.iter().map(|m| m.len() / with).sum();
    whole.free.set_len(total);
    let mut reference = Vec::with_capacity(total);
    let mut first = 0_u32;
    for message in messages {
        let count = message.len() / with;
        let (columns, places) = message.split_at(count * each);
        let slots: Vec<u32> = (first..first + count as u32).collect();
        whole.free.unpack(wanted, &slots, columns)?;
        for place in places.as_chunks::<8>().0.chunks_exact(D) {
            reference.push(Vect::from_fn(|k, _| f64::from_le_bytes(place[k])));
        }
        first += count as u32;
    }
    let order = whole.order_at(&reference);
    if let Some(order) = order {
        reference = order.iter().map(|k| reference[*k as usize]).collect();
        whole.free.keep_slots(&order);
    }
    whole.time = part.time;
    whole.dt = part.dt;
    let points = part.lists.reference_points.clone();
    whole.lists_would_be_of(reference, points, part.lists.time);
    Ok(())
}
