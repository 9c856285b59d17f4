//! The state before a step, to fall back on when the step fails.

use sph_core::{FieldError, Vect, fields};

use crate::Flow;

/// The columns that a step changes, in the order the particles had.
#[derive(Default)]
pub struct Snapshot<const D: usize> {
    identity: Vec<u32>,
    position: Vec<Vect<D>>,
    velocity: Vec<Vect<D>>,
    evolved: Vec<Vec<f64>>,
    time: f64,
}

impl<const D: usize> Snapshot<D> {
    /// Copies the state; reuses its buffers.
    pub fn take(&mut self, flow: &Flow<D>) -> Result<(), FieldError> {
        fn copy<T: Copy>(to: &mut Vec<T>, from: &[T]) {
            to.clear();
            to.extend_from_slice(from);
        }
        let free = &flow.world.free;
        copy(&mut self.identity, free.get(fields::IDENTITY)?);
        copy(&mut self.position, free.get(fields::POSITION)?);
        copy(&mut self.velocity, free.get(fields::VELOCITY)?);
        self.evolved.resize(flow.evolved.len(), Vec::new());
        for (copied, evolved) in self.evolved.iter_mut().zip(&flow.evolved) {
            copy(copied, free.get(evolved.value)?);
        }
        self.time = flow.world.time;
        Ok(())
    }

    /// Puts the state back. If the particles were sorted meanwhile, they return to their order.
    pub fn restore(&self, flow: &mut Flow<D>) -> Result<(), FieldError> {
        let free = &mut flow.world.free;
        let now = free.get(fields::IDENTITY)?;
        if now != self.identity {
            let mut place = vec![0u32; now.len()];
            for (k, &id) in now.iter().enumerate() {
                place[id as usize] = k as u32;
            }
            let order: Vec<u32> = self.identity.iter().map(|&id| place[id as usize]).collect();
            free.permute(&order);
        }
        free.get_mut(fields::POSITION)?
            .copy_from_slice(&self.position);
        free.get_mut(fields::VELOCITY)?
            .copy_from_slice(&self.velocity);
        for (copied, evolved) in self.evolved.iter().zip(&flow.evolved) {
            free.get_mut(evolved.value)?.copy_from_slice(copied);
        }
        flow.world.time = self.time;
        if let Some(walls) = &flow.walls {
            // The walls accepted this time before, so they accept it again.
            let _ = crate::stages::lock(walls).move_to(&mut flow.world.walls, self.time);
        }
        flow.world.rebuild_lists()
    }
}
