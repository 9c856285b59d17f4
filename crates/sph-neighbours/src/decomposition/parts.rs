//! A rank's part of a flow: its own particles, and ghosts, which are copies of others' that are near.
//!
//! Ghosts take part in every step as if they were the rank's own. Only what is summed over neighbours comes out wrong
//! for them, since some of their neighbours are missing: it is overwritten with the result of their owner. All that
//! follows from a particle's own columns is the same on both ranks, to the bit.

use std::sync::atomic::Ordering;
use std::sync::{Arc, PoisonError};

use sph_core::{AnyField, Role, Store, Vect, fields};

use crate::decomposition::bisect::check_ranks;
use crate::decomposition::ghosts::{Needs, RankBox, around, around_own};
use crate::decomposition::link::{Link, OWNER, Partner, Partners};
use crate::decomposition::{Cuts, PartError, Thread, Transport};
use crate::{Extent, World};

/// Rebuilt lists between two checks of the parts.
const BUILDS_TO_LOOK: u64 = 20;
/// Imbalance from which the space is cut anew: the largest share over the mean, less one.
const UNEVEN: f64 = 0.05;

/// Data sent so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Messages to neighbours.
    pub messages: u64,
    /// Bytes in them.
    pub bytes: u64,
    /// Particles that went to another rank.
    pub moved: u64,
}

/// A rank's part of a flow.
#[derive(Debug)]
pub struct Parts<const D: usize> {
    /// Its connection with the others.
    pub link: Arc<Link>,
    cuts: Cuts<D>,
    moved: u64,
    builds: u64,
}

impl<const D: usize> Parts<D> {
    /// Leaves a rank its part of the particles, which every rank holds as a whole; `rings` is how often a stage goes from particles
    /// to their neighbours. The places of the lists must be known; lists are built for the part alone. All particles are taken
    /// to cost the same: the parts are checked when lists are built next.
    ///
    /// # Errors
    /// More ranks than particles; messages that fail, another rank that has failed, a missing column, as everywhere below.
    pub fn divide(
        world: &mut World<D>,
        rings: usize,
        transport: Arc<dyn Transport>,
    ) -> Result<Self, PartError> {
        let (rank, ranks) = (transport.rank() as u32, transport.ranks());
        let reference = world.lists.reference.clone();
        let particles = reference.len();
        check_ranks(ranks, particles)?;
        let alone = &Thread::communicator(1)[0];
        let cuts = Cuts::balanced(&reference, &vec![1.0; particles], ranks, alone)?;
        let owners: Vec<u32> = reference.iter().map(|x| cuts.owner(x)).collect();
        world.free.add(OWNER, Role::State);
        world.free.set_index(OWNER.name, &owners)?;
        world.extent = Some(Extent::around(&reference));
        let around = |rank: usize| around_own(&reference, &owners, rank);
        let around: Vec<RankBox<D>> = (0..ranks).map(around).collect();
        let needs = Needs::new(world, rings);
        let here =
            |k: &usize| owners[*k] == rank || needs.at(&reference[*k], &around[rank as usize]);
        let kept: Vec<u32> = (0..particles).filter(here).map(|k| k as u32).collect();
        let places: Vec<Vect<D>> = kept.iter().map(|k| reference[*k as usize]).collect();
        let own: Vec<bool> = kept.iter().map(|k| owners[*k as usize] == rank).collect();
        let to = |r: &usize| (*r, needs.slots(&places, &around[*r], |k| own[k]));
        let sends = transport.other_ranks().iter().map(to).collect();
        drop(needs);
        world.free.keep_slots(&kept);
        let link = Arc::new(Link::new(transport, rings));
        world.communicator = Some(link.clone());
        let points = world.lists.reference_points.clone();
        world.build_lists_from(places, points, world.lists.time);
        let parts = Parts {
            link,
            cuts,
            moved: 0,
            builds: BUILDS_TO_LOOK - 1,
        };
        parts.know_ghosts(&world.free, sends)?;
        Ok(parts)
    }

    /// Data sent so far.
    pub fn traffic(&self) -> Traffic {
        Traffic {
            messages: self.link.messages.load(Ordering::Relaxed),
            bytes: self.link.bytes.load(Ordering::Relaxed),
            moved: self.moved,
        }
    }

    /// Number of ghosts that this rank has.
    pub fn ghosts(&self) -> usize {
        let partners = self.link.partners();
        partners.receives.iter().map(|(_, slots)| slots.len()).sum()
    }

    /// Finds the ghosts, by their owners; drops partners with nothing to share.
    fn know_ghosts(&self, free: &Store<D>, mut sends: Vec<Partner>) -> Result<(), PartError> {
        let owners = free.get(OWNER)?;
        let (rank, ranks) = (self.link.transport.rank(), self.link.transport.ranks());
        let mut receives = by_owner(owners, ranks);
        receives[rank].1.clear();
        receives.retain(|(_, slots)| !slots.is_empty());
        sends.retain(|(_, slots)| !slots.is_empty());
        let partners = self.link.partners.write();
        *partners.unwrap_or_else(PoisonError::into_inner) = Partners { sends, receives };
        Ok(())
    }

    /// As [`Link::update_ghosts`]; does some `work` while the messages are on their way.
    pub fn update_ghosts_during(
        &self,
        world: &mut World<D>,
        wanted: impl Fn(&AnyField) -> bool,
        mut work: impl FnMut(&mut World<D>),
    ) -> Result<(), PartError> {
        self.link.any(false, false)?;
        let out = self.link.columns(&world.free, &wanted);
        let messages = self.link.swapped(out, &mut || work(world))?;
        self.link.take_in(&mut world.free, &wanted, &messages)
    }

    /// Marks of particles that are sent to another rank, out of so many.
    pub fn sent(&self, particles: usize) -> Vec<bool> {
        let mut sent = vec![false; particles];
        for (_, slots) in &self.link.partners().sends {
            slots.iter().for_each(|slot| sent[*slot as usize] = true);
        }
        sent
    }

    /// Gives newborn particles to the ranks that own their places.
    pub fn house(
        &self,
        free: &mut Store<D>,
        newborn: std::ops::Range<usize>,
        places: &[Vect<D>],
    ) -> Result<(), PartError> {
        let owners = free.get_mut(OWNER)?;
        for (slot, place) in newborn.zip(places) {
            owners[slot] = self.cuts.owner(place);
        }
        Ok(())
    }

    /// Gives every particle to the rank that owns its place, finds all ghosts anew, and builds the lists. `cost` is that of every
    /// particle of this rank.
    pub fn rebuild(
        &mut self,
        world: &mut World<D>,
        cost: impl Fn(&World<D>) -> Vec<f64>,
    ) -> Result<(), PartError> {
        self.balance(world, cost)?;
        world.wrap()?;
        let (rank, ranks) = (self.link.transport.rank(), self.link.transport.ranks());
        let (_, own) = &by_owner(world.free.get(OWNER)?, ranks)[rank];
        world.free.keep_slots(own);
        self.move_house(world)?;
        let own = world.free.len();
        let around = self.rank_boxes(world)?;
        let places = world.free.get(fields::POSITION)?.to_vec();
        let needs = Needs::new(world, self.link.rings);
        let to = |r: &usize| (*r, needs.slots(&places, &around[*r], |_| true));
        let sends: Vec<Partner> = self.link.transport.other_ranks().iter().map(to).collect();
        drop(needs);
        // Ghosts come in behind the rank's own.
        let copies = self.pack(world, &sends);
        self.receive(&mut world.free, copies)?;
        world.extent = Some(self.extent(&places)?);
        let order = world.order()?;
        if let Some(order) = &order {
            world.free.permute(Role::Derived, order);
        }
        let sends = sorted(sends, order.as_deref(), own);
        world.rebuild_lists_in(order.as_deref())?;
        self.know_ghosts(&world.free, sends)
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
        let rank = self.link.transport.rank() as u32;
        let owners = world.free.get(OWNER)?;
        let position = world.free.get(fields::POSITION)?;
        let costs = cost(world);
        let own = || owners.iter().enumerate().filter(|(_, o)| **o == rank);
        let costs: Vec<f64> = own().map(|(k, _)| costs[k]).collect();
        let sum: f64 = costs.iter().sum();
        let mut most = [sum];
        self.link.transport.largest(&mut most)?;
        // Sums in whole numbers do not depend on their order.
        let mut total = [(sum / most[0].max(f64::MIN_POSITIVE) * 1e6) as u64];
        self.link.transport.total(&mut total)?;
        let ranks = self.link.transport.ranks();
        if 1e6 * ranks as f64 <= (1.0 + UNEVEN) * total[0] as f64 {
            return Ok(());
        }
        let places = own().map(|(k, _)| world.domain.wrapped(position[k]));
        let places: Vec<Vect<D>> = places.collect();
        self.cuts = Cuts::balanced(&places, &costs, ranks, &*self.link.transport)?;
        Ok(())
    }

    /// Particles go to the rank that owns their place; ghosts must have been dropped.
    fn move_house(&mut self, world: &mut World<D>) -> Result<(), PartError> {
        let (rank, ranks) = (self.link.transport.rank(), self.link.transport.ranks());
        let places = world.free.get(fields::POSITION)?.iter();
        let owners: Vec<u32> = places.map(|x| self.cuts.owner(x)).collect();
        world.free.set_index(OWNER.name, &owners)?;
        let mut leaving = by_owner(&owners, ranks);
        let stay = std::mem::take(&mut leaving[rank].1);
        leaving.retain(|(_, slots)| !slots.is_empty());
        let moved: usize = leaving.iter().map(|(_, slots)| slots.len()).sum();
        self.moved += moved as u64;
        let leavers = self.pack(world, &leaving);
        world.free.keep_slots(&stay);
        self.receive(&mut world.free, leavers)
    }

    fn pack(&self, world: &World<D>, to: &[Partner]) -> Vec<(usize, Vec<u8>)> {
        let some = to.iter().filter(|(_, slots)| !slots.is_empty());
        let message = |(rank, slots): &Partner| (*rank, world.free.pack(|_| true, slots));
        some.map(message).collect()
    }

    /// Sends whole particles, and adds those that come at the end.
    pub(crate) fn receive(
        &self,
        free: &mut Store<D>,
        out: Vec<(usize, Vec<u8>)>,
    ) -> Result<(), PartError> {
        let each = free.bytes_per_particle();
        let mut numbers = vec![0; self.link.transport.ranks()];
        for (rank, message) in &out {
            numbers[*rank] = (message.len() / each) as u64;
        }
        self.link.count(&out);
        let mut come = self.link.transport.all_to_all(&numbers)?;
        come[self.link.transport.rank()] = 0;
        let from: Vec<usize> = (0..come.len()).filter(|r| come[*r] > 0).collect();
        let messages = self.link.transport.swap(out, &from)?;
        for (rank, message) in from.into_iter().zip(messages) {
            let first = free.len();
            let slots: Vec<u32> = (first as u32..first as u32 + come[rank] as u32).collect();
            free.set_len(first + slots.len());
            free.unpack(|_| true, &slots, &message)?;
        }
        Ok(())
    }

    fn rank_boxes(&self, world: &World<D>) -> Result<Vec<RankBox<D>>, PartError> {
        let own = around(world.free.get(fields::POSITION)?.iter());
        let numbers = own.iter().flat_map(|corner| corner.iter());
        let bytes: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
        let read = |message: Vec<u8>| {
            let numbers = message.as_chunks::<8>().0;
            let at = |k: usize| numbers.get(k).map_or(f64::NAN, |b| f64::from_le_bytes(*b));
            [0, D].map(|from| Vect::from_fn(|k, _| at(from + k)))
        };
        let all = self.link.transport.all(&bytes)?;
        Ok(all.into_iter().map(read).collect())
    }

    /// The extent of the particles of all ranks; `own` are those of this one.
    fn extent(&self, own: &[Vect<D>]) -> Result<Extent<D>, PartError> {
        let [lower, upper] = around(own.iter());
        let mut corners: Vec<f64> = (-lower).iter().chain(&upper).copied().collect();
        self.link.transport.largest(&mut corners)?;
        let mut points = [own.len() as u64];
        self.link.transport.total(&mut points)?;
        Ok(Extent {
            corners: [
                Vect::from_fn(|k, _| -corners[k]),
                Vect::from_fn(|k, _| corners[D + k]),
            ],
            points: points[0] as usize,
        })
    }
}

fn by_owner(owners: &[u32], ranks: usize) -> Vec<Partner> {
    let mut all: Vec<Partner> = (0..ranks).map(|r| (r, vec![])).collect();
    for (slot, owner) in owners.iter().enumerate() {
        all[*owner as usize].1.push(slot as u32);
    }
    all
}

/// The slots that are sent, after the particles have been sorted, ascending: then the ghosts of a rank are in the same order as
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
