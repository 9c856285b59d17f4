//! Connection of a rank for the work of its flow, with the copies of each rank.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock, RwLockReadGuard};

use sph_core::{AnyField, StepError, Store, Vect};

use crate::decomposition::owner::OWNER;
use crate::decomposition::{PartError, Transport};
use crate::{Communicator, World};

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

/// The connection of a rank with the others.
#[derive(Debug)]
pub(crate) struct Link {
    pub transport: Arc<dyn Transport>,
    pub partners: RwLock<Partners>,
    /// Number of times that a stage goes from particles to their neighbours.
    pub rings: usize,
    /// True once all ranks have got the failure at hand.
    told: AtomicBool,
    /// True if messages failed where no error could be returned.
    lost: AtomicBool,
    pub messages: AtomicU64,
    pub bytes: AtomicU64,
}

impl Link {
    pub fn new(transport: Arc<dyn Transport>, rings: usize) -> Self {
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

    pub fn partners(&self) -> RwLockReadGuard<'_, Partners> {
        self.partners.read().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn count(&self, out: &[(usize, Vec<u8>)]) {
        let bytes = out.iter().map(|(_, m)| m.len() as u64).sum();
        self.messages.fetch_add(out.len() as u64, Ordering::Relaxed);
        self.bytes.fetch_add(bytes, Ordering::Relaxed);
    }

    /// Replaces each value by the largest of all ranks, if none has failed. Every message between ranks is preceded by
    /// this or is this, so that a rank that fails anywhere in a step reaches the others, which wait here.
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
            Some(rank) if rank != self.transport.rank() => StepError::Stage {
                stage: format!("rank {rank}"),
                reason: String::from_utf8_lossy(&all[rank]).into_owned(),
            },
            _ => cause,
        }
    }

    /// Results of `pack` for the particles that others have copies of, by their ranks.
    fn packed(&self, pack: impl Fn(&[u32]) -> Vec<u8>) -> Vec<(usize, Vec<u8>)> {
        let partners = self.partners();
        let sends = partners.sends.iter();
        sends.map(|(rank, slots)| (*rank, pack(slots))).collect()
    }

    /// Sends messages to the ranks with copies, and does some `work` meanwhile; returns the messages for the ghosts,
    /// owner by owner.
    fn swapped(
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

    /// Gives ghosts the values of their owners in the columns that are `wanted`.
    pub fn update_ghosts<const D: usize>(
        &self,
        free: &mut Store<D>,
        wanted: impl Fn(&AnyField) -> bool,
    ) -> Result<(), PartError> {
        self.any(false, false)?;
        let out = self.columns(free, &wanted);
        let messages = self.swapped(out, &mut || ())?;
        self.take_in(free, &wanted, &messages)
    }

    /// The same; does some `work` while the messages are on their way.
    pub fn update_ghosts_during<const D: usize>(
        &self,
        world: &mut World<D>,
        wanted: impl Fn(&AnyField) -> bool,
        mut work: impl FnMut(&mut World<D>),
    ) -> Result<(), PartError> {
        self.any(false, false)?;
        let out = self.columns(&world.free, &wanted);
        let messages = self.swapped(out, &mut || work(world))?;
        self.take_in(&mut world.free, &wanted, &messages)
    }

    fn columns<const D: usize>(
        &self,
        free: &Store<D>,
        wanted: impl Fn(&AnyField) -> bool,
    ) -> Vec<(usize, Vec<u8>)> {
        self.packed(|slots| {
            let mut message = Vec::new();
            free.pack(&wanted, slots, &mut message);
            message
        })
    }

    fn take_in<const D: usize>(
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
}

impl<const D: usize> Communicator<D> for Link {
    fn own(&self, free: &Store<D>) -> Vec<bool> {
        let rank = self.transport.rank() as u32;
        let owners = free.unwatched(OWNER).unwrap_or(&[]);
        owners.iter().map(|o| *o == rank).collect()
    }

    fn idle(&self, free: &Store<D>) -> Option<Vec<bool>> {
        let ghosts = || {
            Communicator::<D>::own(self, free)
                .iter()
                .map(|own| !own)
                .collect()
        };
        (self.rings == 1).then(ghosts)
    }

    fn largest(&self, values: &mut [f64]) -> Result<(), StepError> {
        Ok(self.agree(false, values)?)
    }

    fn total(&self, numbers: &mut [u64]) -> Result<(), StepError> {
        self.any(false, false)?;
        Ok(self.transport.total(numbers).map_err(PartError::from)?)
    }

    fn gather(&self, own: &[u64]) -> Result<Vec<u64>, StepError> {
        self.any(false, false)?;
        let bytes: Vec<u8> = own.iter().flat_map(|x| x.to_le_bytes()).collect();
        let all = self.transport.all(&bytes).map_err(PartError::from)?;
        let words = all.iter().flat_map(|message| message.as_chunks::<8>().0);
        Ok(words.map(|b| u64::from_le_bytes(*b)).collect())
    }

    fn update_ghosts(&self, free: &mut Store<D>, columns: &[AnyField]) -> Result<(), StepError> {
        Ok(Link::update_ghosts(self, free, |f| columns.contains(f))?)
    }

    fn begin_solve(&self) -> Result<(), StepError> {
        self.any(false, false)?;
        Ok(())
    }

    fn mirror(&self, values: &mut [Vect<D>]) {
        if self.mirrored(values).is_err() {
            self.lost.store(true, Ordering::Relaxed);
        }
    }

    fn mirror_scalars(&self, values: &mut [Vect<1>]) {
        if self.mirrored(values).is_err() {
            self.lost.store(true, Ordering::Relaxed);
        }
    }

    fn most(&self, value: f64) -> f64 {
        let mut value = [value];
        if self.transport.largest(&mut value).is_err() {
            self.lost.store(true, Ordering::Relaxed);
        }
        value[0]
    }

    fn add(&self, part: f64) -> f64 {
        match self.transport.all(&part.to_le_bytes()) {
            Ok(all) => {
                let value =
                    |m: &Vec<u8>| m.as_chunks::<8>().0.first().map(|b| f64::from_le_bytes(*b));
                all.iter().filter_map(value).sum()
            }
            Err(_) => {
                self.lost.store(true, Ordering::Relaxed);
                part
            }
        }
    }
}
