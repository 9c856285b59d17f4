//! A rank's part of a flow: its own particles, and guests, which are copies of others' that are near.
//!
//! Guests take part in every step as if they were the rank's own. Only what is summed over neighbours comes out wrong for them,
//! since some of their neighbours are missing: it is overwritten with what their owner found. All that follows from a
//! particle's own columns is the same on both ranks, to the bit.

use std::sync::Arc;

use sph_core::{AnyField, Field, Index, Role, Store, Vect, fields};
use sph_neighbours::{Extent, World};

use crate::guests::{Around, Needs, positions};
use crate::{Cuts, Divided, PartError, Thread, Transport};

/// The rank that owns a particle.
pub const OWNER: Field<Index> = Field::new("owner", "1", "rank that owns the particle");

/// Rebuilt lists until the parts are looked at again.
const BUILDS_TO_LOOK: u64 = 20;
/// Imbalance from which the space is cut anew: the largest share over the mean, less one.
const UNEVEN: f64 = 0.05;

/// What has been sent so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Messages to neighbours.
    pub messages: u64,
    /// Bytes in them.
    pub bytes: u64,
    /// Particles that went to another rank.
    pub moved: u64,
    /// Times that the space was cut anew.
    pub cuts: u64,
}

/// Slots that are sent to, or received from, a rank.
type Partner = (usize, Vec<u32>);

/// A rank's part of a flow.
#[derive(Debug)]
pub struct Parts<const D: usize> {
    pub(crate) transport: Arc<dyn Transport>,
    cuts: Cuts<D>,
    /// Own particles that others have as guests, by rank.
    sends: Vec<Partner>,
    /// Guests, by their owner.
    receives: Vec<Partner>,
    traffic: Traffic,
    /// Rebuilds since the parts were looked at.
    builds: u64,
    /// How often a stage goes from particles to their neighbours.
    rings: usize,
    /// Whether all ranks know of the failure at hand.
    pub(crate) told: bool,
}

impl<const D: usize> Parts<D> {
    /// Leaves a rank its part of a flow that every rank holds as a whole; `rings` is how often a stage goes from particles to
    /// their neighbours. The lists must have been built; they are built anew for
    /// the same positions.
    ///
    /// # Errors
    /// More ranks than particles; a column that is missing.
    pub fn divide(
        world: &mut World<D>,
        costs: &[f64],
        rings: usize,
        transport: Arc<dyn Transport>,
    ) -> Result<Self, PartError> {
        let (rank, ranks) = (transport.rank() as u32, transport.ranks());
        let reference = world.lists.reference.clone();
        let particles = reference.len();
        if ranks > particles {
            return Err(crate::DecompositionError::TooManyRanks { ranks, particles }.into());
        }
        let cuts = match Thread::team(1).first() {
            Some(alone) => Cuts::of(&reference, costs, ranks, alone)?,
            None => return Err(crate::DecompositionError::NoRanks.into()),
        };
        let owners: Vec<u32> = reference.iter().map(|x| cuts.owner(x)).collect();
        world.free.add(OWNER, Role::State);
        world.free.set_index(OWNER.name, &owners)?;
        world.extent = Some(Extent::of(&reference));
        let around = |r: usize| {
            let own = reference.iter().zip(&owners);
            Around::of(own.filter(|(_, o)| **o as usize == r).map(|(x, _)| x))
        };
        let around: Vec<Around<D>> = (0..ranks).map(around).collect();
        let needs = Needs::of(world, rings);
        let here =
            |k: &usize| owners[*k] == rank || needs.at(&reference[*k], &around[rank as usize]);
        let kept: Vec<u32> = (0..particles).filter(here).map(|k| k as u32).collect();
        let places: Vec<Vect<D>> = kept.iter().map(|k| reference[*k as usize]).collect();
        let own: Vec<bool> = kept.iter().map(|k| owners[*k as usize] == rank).collect();
        let to = |r: &usize| (*r, needs.slots(&places, &around[*r], |k| own[k]));
        let sends = transport.others().iter().map(to).collect();
        drop(needs);
        world.free.keep_slots(&kept);
        let points = world.lists.reference_points().clone();
        world.build_lists_from(places, points, world.lists.time);
        let mut parts = Parts {
            transport,
            cuts,
            sends,
            receives: Vec::new(),
            traffic: Traffic::default(),
            builds: 0,
            rings,
            told: false,
        };
        parts.know_guests(&world.free)?;
        Ok(parts)
    }

    /// The ranks' connection.
    pub fn transport(&self) -> &Arc<dyn Transport> {
        &self.transport
    }

    /// Whether this rank writes what all found.
    pub fn is_first(&self) -> bool {
        self.transport.rank() == 0
    }

    /// What has been sent so far.
    pub fn traffic(&self) -> Traffic {
        self.traffic
    }

    /// How the particles are divided.
    pub fn divided(&self, free: &Store<D>) -> Divided {
        let guests: usize = self.receives.iter().map(|(_, slots)| slots.len()).sum();
        Divided {
            own: free.len() - guests,
            guests,
            sent: self.sends.iter().map(|(_, slots)| slots.len()).sum(),
        }
    }

    /// Finds the guests, by their owners; drops partners with whom there is nothing to share.
    fn know_guests(&mut self, free: &Store<D>) -> Result<(), PartError> {
        let owners = free.get(OWNER)?;
        let rank = self.transport.rank();
        let mut receives: Vec<Partner> = (0..self.transport.ranks()).map(|r| (r, vec![])).collect();
        for (slot, owner) in owners.iter().enumerate() {
            if *owner as usize != rank {
                receives[*owner as usize].1.push(slot as u32);
            }
        }
        self.receives = receives;
        self.receives.retain(|(_, slots)| !slots.is_empty());
        self.sends.retain(|(_, slots)| !slots.is_empty());
        Ok(())
    }

    /// Gives guests the values of their owners in the columns that are `wanted`.
    ///
    /// # Errors
    /// Messages that fail.
    pub fn tell(
        &mut self,
        free: &mut Store<D>,
        wanted: impl Fn(&AnyField) -> bool,
    ) -> Result<(), PartError> {
        let message = |(rank, slots): &Partner| {
            let mut message = Vec::new();
            free.pack(&wanted, slots, &mut message);
            (*rank, message)
        };
        let out: Vec<_> = self.sends.iter().map(message).collect();
        self.traffic.messages += out.len() as u64;
        self.traffic.bytes += out.iter().map(|(_, m)| m.len() as u64).sum::<u64>();
        let from: Vec<usize> = self.receives.iter().map(|(rank, _)| *rank).collect();
        let messages = self.transport.swap(out, &from)?;
        for ((_, slots), message) in self.receives.iter().zip(messages) {
            free.unpack(&wanted, slots, &message)?;
        }
        Ok(())
    }

    /// Gives every particle to the rank that owns its place, finds all guests anew, and builds the lists. `cost` is that of every
    /// particle of this rank.
    ///
    /// # Errors
    /// Messages that fail; a column that is missing.
    pub fn rebuild(
        &mut self,
        world: &mut World<D>,
        cost: impl Fn(&World<D>) -> Vec<f64>,
    ) -> Result<(), PartError> {
        self.balance(world, cost)?;
        world.wrap()?;
        let rank = self.transport.rank() as u32;
        let owners = world.free.get(OWNER)?;
        let own: Vec<u32> = (0..owners.len())
            .filter(|k| owners[*k] == rank)
            .map(|k| k as u32)
            .collect();
        world.free.keep_slots(&own);
        self.move_house(world)?;
        let own = world.free.len();
        let around = self.around(world)?;
        let places = positions(world);
        let needs = Needs::of(world, self.rings);
        let to = |r: &usize| (*r, needs.slots(&places, &around[*r], |_| true));
        let sends: Vec<Partner> = self.transport.others().iter().map(to).collect();
        drop(needs);
        self.deliver(world, &sends)?;
        world.extent = Some(self.extent(&places)?);
        let order = world.order()?;
        if let Some(order) = &order {
            world.free.permute_derived(order);
        }
        self.sends = sorted(sends, order.as_deref(), own);
        world.rebuild_lists()?;
        self.know_guests(&world.free)
    }

    /// Cuts the space anew where the parts have become uneven.
    fn balance(
        &mut self,
        world: &World<D>,
        cost: impl Fn(&World<D>) -> Vec<f64>,
    ) -> Result<(), PartError> {
        self.builds += 1;
        if self.builds < BUILDS_TO_LOOK {
            return Ok(());
        }
        self.builds = 0;
        let rank = self.transport.rank() as u32;
        let owners = world.free.get(OWNER)?;
        let position = world.free.get(fields::POSITION)?;
        let costs = cost(world);
        let own = || owners.iter().enumerate().filter(|(_, o)| **o == rank);
        let costs: Vec<f64> = own().map(|(k, _)| costs[k]).collect();
        let sum: f64 = costs.iter().sum();
        let mut most = [sum];
        self.transport.largest(&mut most)?;
        // Sums in whole numbers do not depend on their order.
        let mut total = [(sum / most[0].max(f64::MIN_POSITIVE) * 1e6) as u64];
        self.transport.total(&mut total)?;
        let ranks = self.transport.ranks();
        if 1e6 * ranks as f64 <= (1.0 + UNEVEN) * total[0] as f64 {
            return Ok(());
        }
        let places: Vec<Vect<D>> = own()
            .map(|(k, _)| world.domain.wrapped(position[k]))
            .collect();
        self.cuts = Cuts::of(&places, &costs, ranks, &*self.transport)?;
        self.traffic.cuts += 1;
        Ok(())
    }

    /// Particles go to the rank that owns their place; guests must have been dropped.
    fn move_house(&mut self, world: &mut World<D>) -> Result<(), PartError> {
        let (rank, ranks) = (self.transport.rank(), self.transport.ranks());
        let owners: Vec<u32> = positions(world)
            .iter()
            .map(|x| self.cuts.owner(x))
            .collect();
        world.free.set_index(OWNER.name, &owners)?;
        let mut leaving: Vec<Partner> = (0..ranks).map(|r| (r, vec![])).collect();
        for (slot, owner) in owners.iter().enumerate() {
            leaving[*owner as usize].1.push(slot as u32);
        }
        let stay = std::mem::take(&mut leaving[rank].1);
        leaving.retain(|(_, slots)| !slots.is_empty());
        let moved: usize = leaving.iter().map(|(_, slots)| slots.len()).sum();
        self.traffic.moved += moved as u64;
        let leavers = self.pack(world, &leaving);
        world.free.keep_slots(&stay);
        self.receive(world, leavers)
    }

    /// Guests come in behind the rank's own.
    fn deliver(&mut self, world: &mut World<D>, sends: &[Partner]) -> Result<(), PartError> {
        let messages = self.pack(world, sends);
        self.receive(world, messages)
    }

    fn pack(&self, world: &World<D>, to: &[Partner]) -> Vec<(usize, Vec<u8>)> {
        let some = to.iter().filter(|(_, slots)| !slots.is_empty());
        let message = |(rank, slots): &Partner| {
            let mut message = Vec::new();
            world.free.pack(|_| true, slots, &mut message);
            (*rank, message)
        };
        some.map(message).collect()
    }

    /// Sends whole particles, and adds those that come at the end.
    fn receive(
        &mut self,
        world: &mut World<D>,
        out: Vec<(usize, Vec<u8>)>,
    ) -> Result<(), PartError> {
        let each = world.free.bytes_per_particle();
        let mut numbers = vec![0; self.transport.ranks()];
        for (rank, message) in &out {
            numbers[*rank] = (message.len() / each) as u64;
        }
        self.traffic.messages += out.len() as u64;
        self.traffic.bytes += out.iter().map(|(_, m)| m.len() as u64).sum::<u64>();
        let mut come = self.transport.trade(&numbers)?;
        come[self.transport.rank()] = 0;
        let from: Vec<usize> = (0..come.len()).filter(|r| come[*r] > 0).collect();
        let messages = self.transport.swap(out, &from)?;
        for (rank, message) in from.into_iter().zip(messages) {
            let first = world.free.len();
            let slots: Vec<u32> = (first..first + come[rank] as usize)
                .map(|k| k as u32)
                .collect();
            world.free.set_len(first + slots.len());
            world.free.unpack(|_| true, &slots, &message)?;
        }
        Ok(())
    }

    /// Boxes around what each rank owns.
    fn around(&self, world: &World<D>) -> Result<Vec<Around<D>>, PartError> {
        let own = Around::of(world.free.get(fields::POSITION)?.iter());
        let numbers = own.lower.iter().chain(own.upper.iter());
        let bytes: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
        let read = |message: Vec<u8>| {
            let numbers = message.as_chunks::<8>().0;
            let at = |k: usize| numbers.get(k).map_or(f64::NAN, |b| f64::from_le_bytes(*b));
            Around {
                lower: Vect::from_fn(|k, _| at(k)),
                upper: Vect::from_fn(|k, _| at(D + k)),
            }
        };
        Ok(self.transport.all(&bytes)?.into_iter().map(read).collect())
    }

    /// The extent of the particles of all ranks; `own` are those of this one.
    fn extent(&self, own: &[Vect<D>]) -> Result<Extent<D>, PartError> {
        let around = Around::of(own.iter());
        let numbers = around
            .lower
            .iter()
            .map(|x| -x)
            .chain(around.upper.iter().copied());
        let mut corners: Vec<f64> = numbers.collect();
        self.transport.largest(&mut corners)?;
        let mut points = [own.len() as u64];
        self.transport.total(&mut points)?;
        Ok(Extent {
            lower: Vect::from_fn(|k, _| -corners[k]),
            upper: Vect::from_fn(|k, _| corners[D + k]),
            points: points[0] as usize,
        })
    }

    /// Gathers the particles of all ranks into a store with the same columns, but for the owner, sorted as one process would have
    /// them, at rank 0; `along` are columns of one's own that come with them.
    ///
    /// # Errors
    /// Messages that fail; a column that is missing.
    pub fn gather(
        &mut self,
        world: &World<D>,
        whole: Option<&mut World<D>>,
    ) -> Result<(), PartError> {
        let rank = self.transport.rank() as u32;
        let owners = world.free.get(OWNER)?;
        let own = |k: &usize| owners[*k] == rank;
        let slots: Vec<u32> = (0..owners.len()).filter(own).map(|k| k as u32).collect();
        let mut message = Vec::new();
        let wanted = |f: &AnyField| f.name != OWNER.name;
        world.free.pack(wanted, &slots, &mut message);
        let reference = &world.lists.reference;
        let numbers = slots.iter().flat_map(|s| reference[*s as usize].iter());
        numbers.for_each(|x| message.extend_from_slice(&x.to_le_bytes()));
        let messages = self.transport.gather(message)?;
        match whole {
            Some(whole) => join(world, whole, &messages),
            None => Ok(()),
        }
    }
}

/// Fills the whole with what all ranks have sent.
fn join<const D: usize>(
    part: &World<D>,
    whole: &mut World<D>,
    messages: &[Vec<u8>],
) -> Result<(), PartError> {
    let wanted = |f: &AnyField| f.name != OWNER.name;
    // Columns that came into being on the way.
    let missing: Vec<_> = part
        .free
        .columns()
        .map(|(name, _, role, ..)| (name, role))
        .collect();
    for (field, (_, role)) in part.free.fields().zip(missing) {
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
    let order = whole.order_at(&reference)?;
    if let Some(order) = order {
        reference = order.iter().map(|k| reference[*k as usize]).collect();
        whole.free.keep_slots(&order);
    }
    whole.time = part.time;
    whole.dt = part.dt;
    let points = part.lists.reference_points().clone();
    whole.build_lists_from(reference, points, part.lists.time);
    Ok(())
}

/// The slots that are sent, after the particles have been sorted, ascending: then the guests of a rank are in the same order as
/// the particles that their owner sends.
fn sorted(sends: Vec<Partner>, order: Option<&[u32]>, own: usize) -> Vec<Partner> {
    let Some(order) = order else {
        return sends;
    };
    let mut places = vec![u32::MAX; own];
    for (place, slot) in order.iter().enumerate() {
        if let Some(entry) = places.get_mut(*slot as usize) {
            *entry = place as u32;
        }
    }
    let one = |(rank, slots): Partner| {
        let mut slots: Vec<u32> = slots.iter().map(|s| places[*s as usize]).collect();
        slots.sort_unstable();
        (rank, slots)
    };
    sends.into_iter().map(one).collect()
}
