//! Connection of a rank for the work of its flow, with the copies of each rank.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock, RwLockReadGuard};

use sph_core::{AnyField, Field, Index, StepError, Store, Vect};

use crate::decomposition::{PartError, Transport};

/// The rank that owns a particle.
pub const OWNER: Field<Index> = Field::new("owner", "1", "rank that owns the particle");

/// Slots that are sent to, or received from, a rank.
pub(crate) type Partner = (usize, Vec<u32>);

/// Copies that ranks have of each other's particles.
#[derive(Debug, Default)]
pub(crate) struct Partners {
    /// Own particles that others have as ghosts, by rank.
    pub sends: Vec<Partner>,
    /// Ghosts, by their owner.
    pub receives: Vec<Partner>,
}

/// The connection of a rank with the others between which a flow is divided. All ranks call the same methods in the same
/// order.
#[derive(Debug)]
pub struct Link {
    /// The messages.
    pub transport: Arc<dyn Transport>,
    pub(crate) partners: RwLock<Partners>,
    /// Number of times that a stage goes from particles to their neighbours.
    pub(crate) rings: usize,
    /// True once all ranks have got the failure at hand.
    told: AtomicBool,
    /// True if messages failed where no error could be returned.
    lost: AtomicBool,
    pub(crate) messages: AtomicU64,
    pub(crate) bytes: AtomicU64,
}

impl Link {
    pub(crate) fn new(transport: Arc<dyn Transport>, rings: usize) -> Self {
        Link {
            transport,
            partners: RwLock::default(),
            rings,
            told: AtomicBool::new(false),
            lost: AtomicBool::new(false),
            messages: AtomicU64::new(0),
            bytes: AtomicU64::new(0),
        }
    }

    pub(crate) fn partners(&self) -> RwLockReadGuard<'_, Partners> {
        self.partners.read().unwrap_or_else(PoisonError::into_inner)
    }

    pub(crate) fn count(&self, out: &[(usize, Vec<u8>)]) {
        let bytes = out.iter().map(|(_, m)| m.len() as u64).sum();
        self.messages.fetch_add(out.len() as u64, Ordering::Relaxed);
        self.bytes.fetch_add(bytes, Ordering::Relaxed);
    }

    /// Replaces each value by the largest of all ranks, if none has failed. Every message between ranks is preceded by
    /// this or is this, so that a rank that fails anywhere in a step reaches the others, which wait here.
    ///
    /// # Errors
    /// If a rank has failed, on all ranks alike, or messages fail; as everywhere below.
    pub fn agree(&self, failed: bool, values: &mut [f64]) -> Result<(), PartError> {
        let failed = failed || self.lost.load(Ordering::Relaxed);
        let mut all = values.to_vec();
        all.push(f64::from(u8::from(failed)));
        let sent = self.transport.largest(&mut all);
        let failed = all.pop().is_some_and(|failed| failed > 0.0);
        // A rank without a connection has no rank to inform.
        let told = failed || sent.is_err();
        self.told.store(told, Ordering::Relaxed);
        sent?;
        values.copy_from_slice(&all);
        match told {
            true => Err(PartError::Elsewhere),
            false => Ok(()),
        }
    }

    /// True if a rank answers yes; an error if one has failed.
    pub fn any(&self, failed: bool, yes: bool) -> Result<bool, PartError> {
        let mut said = [f64::from(u8::from(yes))];
        self.agree(failed, &mut said)?;
        Ok(said[0] > 0.0)
    }

    /// The least of every value over all ranks.
    pub fn least(&self, values: &mut [f64]) -> Result<(), PartError> {
        values.iter_mut().for_each(|v| *v = -*v);
        self.agree(false, values)?;
        values.iter_mut().for_each(|v| *v = -*v);
        Ok(())
    }

    /// Confirms the success of all ranks at the end of a work in which some may have failed, with or without a message.
    pub fn confirm(&self, failed: bool) -> Result<(), PartError> {
        if failed && self.told.swap(false, Ordering::Relaxed) {
            return Err(PartError::Elsewhere);
        }
        let settled = self.any(failed, false);
        self.told.store(false, Ordering::Relaxed);
        settled.map(|_| ())
    }

    /// After a failure on any rank, on all ranks: informs the others, and gives the cause that the first rank
    /// has that has one.
    pub fn share_failure(&self, cause: StepError) -> StepError {
        if !self.told.swap(false, Ordering::Relaxed) {
            // They answer with the failure itself.
            let _ = self.any(true, false);
            self.told.store(false, Ordering::Relaxed);
        }
        let own = match StepError::from(PartError::Elsewhere) == cause {
            true => String::new(),
            false => cause.to_string(),
        };
        let Ok(all) = self.transport.all(own.as_bytes()) else {
            return cause;
        };
        match all.iter().position(|text| !text.is_empty()) {
            Some(rank) if rank != self.transport.rank() => StepError::stage(
                format!("rank {rank}"),
                String::from_utf8_lossy(&all[rank]).into_owned(),
            ),
            _ => cause,
        }
    }

    /// Marks of own particles; the others are copies.
    pub(crate) fn own<const D: usize>(&self, free: &Store<D>) -> Vec<bool> {
        let rank = self.transport.rank() as u32;
        let owners = free.unwatched(OWNER).unwrap_or(&[]);
        owners.iter().map(|o| *o == rank).collect()
    }

    /// Replaces each number by its sum over all ranks, which wraps around.
    pub(crate) fn total(&self, numbers: &mut [u64]) -> Result<(), PartError> {
        self.any(false, false)?;
        Ok(self.transport.total(numbers)?)
    }

    /// The numbers of all ranks, one rank's behind the other's.
    pub(crate) fn gather(&self, own: &[u64]) -> Result<Vec<u64>, PartError> {
        self.any(false, false)?;
        let bytes: Vec<u8> = own.iter().flat_map(|x| x.to_le_bytes()).collect();
        let all = self.transport.all(&bytes)?;
        let words = all.iter().flat_map(|message| message.as_chunks::<8>().0);
        Ok(words.map(|b| u64::from_le_bytes(*b)).collect())
    }

    fn packed(&self, pack: impl Fn(&[u32]) -> Vec<u8>) -> Vec<(usize, Vec<u8>)> {
        let partners = self.partners();
        let sends = partners.sends.iter();
        sends.map(|(rank, slots)| (*rank, pack(slots))).collect()
    }

    /// Sends messages to the ranks with copies, and does some `work` meanwhile; returns the messages for the ghosts,
    /// owner by owner.
    pub(crate) fn swapped(
        &self,
        out: Vec<(usize, Vec<u8>)>,
        work: &mut dyn FnMut(),
    ) -> Result<Vec<Vec<u8>>, PartError> {
        self.count(&out);
        let partners = self.partners();
        let from: Vec<usize> = partners.receives.iter().map(|(rank, _)| *rank).collect();
        drop(partners);
        Ok(self.transport.swap_during(out, &from, work)?)
    }

    pub(crate) fn columns<const D: usize>(
        &self,
        free: &Store<D>,
        wanted: impl Fn(&AnyField) -> bool,
    ) -> Vec<(usize, Vec<u8>)> {
        self.packed(|slots| free.pack(&wanted, slots))
    }

    pub(crate) fn take_in<const D: usize>(
        &self,
        free: &mut Store<D>,
        wanted: impl Fn(&AnyField) -> bool,
        messages: &[Vec<u8>],
    ) -> Result<(), PartError> {
        for ((_, slots), message) in self.partners().receives.iter().zip(messages) {
            free.unpack(&wanted, slots, message)?;
        }
        Ok(())
    }

    /// Gives ghosts the values of their owners in the columns that are `wanted`.
    pub fn update_ghosts<const D: usize>(
        &self,
        free: &mut Store<D>,
        wanted: impl Fn(&AnyField) -> bool,
    ) -> Result<(), PartError> {
        self.any(false, false)?;
        let messages = self.swapped(self.columns(free, &wanted), &mut || ())?;
        self.take_in(free, &wanted, &messages)
    }

    /// Of vectors of D components: places, or single numbers.
    fn mirrored<const D: usize>(&self, values: &mut [Vect<D>]) -> Result<(), PartError> {
        let out = self.packed(|slots| {
            let all = slots.iter().flat_map(|s| values[*s as usize].iter());
            all.flat_map(|x| x.to_le_bytes()).collect()
        });
        let messages = self.swapped(out, &mut || ())?;
        for ((_, slots), message) in self.partners().receives.iter().zip(messages) {
            let numbers = message.as_chunks::<8>().0.chunks_exact(D);
            for (slot, numbers) in slots.iter().zip(numbers) {
                values[*slot as usize] = Vect::from_fn(|k, _| f64::from_le_bytes(numbers[k]));
            }
        }
        Ok(())
    }

    // Methods of a solve, in which no rank may fail: after `any` has found that none has, they return no error.

    /// The result of messages in a solve; none if they fail, of which the next check between ranks knows.
    fn held<T, E>(&self, sent: Result<T, E>) -> Option<T> {
        if sent.is_err() {
            self.lost.store(true, Ordering::Relaxed);
        }
        sent.ok()
    }

    /// Gives copies the values of their owners in a vector of a solve.
    pub(crate) fn mirror<const D: usize>(&self, values: &mut [Vect<D>]) {
        self.held(self.mirrored(values));
    }

    pub(crate) fn most(&self, value: f64) -> f64 {
        let mut value = [value];
        self.held(self.transport.largest(&mut value));
        value[0]
    }

    /// The sum of all ranks' parts, in the order of the ranks.
    pub(crate) fn add(&self, part: f64) -> f64 {
        let all = self.held(self.transport.all(&part.to_le_bytes()));
        all.map_or(part, |all| {
            let value = |m: &Vec<u8>| m.as_chunks::<8>().0.first().map(|b| f64::from_le_bytes(*b));
            all.iter().filter_map(value).sum()
        })
    }
}
