//! The state before a step, to fall back on when the step fails.

use sph_boundary::WallStates;
use sph_core::{FieldError, Recall, Slots, StepError, Store, Vect, fields};
use sph_neighbours::WallForce;

use super::Flow;

/// All columns that carry history, in the order the particles had, and the clock.
#[derive(Default)]
pub struct Snapshot<const D: usize> {
    columns: Store<D>,
    time: f64,
    /// The step before, s.
    dt: f64,
    /// Walls with movers, and their loads.
    walls: WallStates,
    loads: Vec<WallForce<D>>,
}

impl<const D: usize> Snapshot<D> {
    /// Copies the state; reuses its buffers.
    pub fn take(&mut self, flow: &Flow<D>) -> Result<(), FieldError> {
        flow.world.free.save_state(&mut self.columns)?;
        self.time = flow.world.time;
        self.dt = flow.world.dt;
        if let Some(walls) = &flow.walls {
            self.walls = walls.states();
            // Lists are built anew where a step is taken back.
            self.walls.listed = None;
            self.loads.clone_from(&flow.loads);
        }
        Ok(())
    }

    /// Takes the columns of the same particles in another order, or of others; the clock and the walls stay.
    pub(crate) fn follow(&mut self, free: &Store<D>) -> Result<(), FieldError> {
        free.save_state(&mut self.columns)
    }

    /// The earlier place of the particle of a number.
    pub fn position_of(&self, number: u32) -> Option<Vect<D>> {
        let identity = self.columns.get(fields::IDENTITY).ok()?;
        let place = identity.iter().position(|i| *i == number)?;
        self.columns.get(fields::POSITION).ok()?.get(place).copied()
    }

    /// The place of every present particle in the copy; `None` if the order is the same.
    pub(crate) fn places(&self, free: &Store<D>) -> Result<Option<Vec<u32>>, FieldError> {
        let now = free.get(fields::IDENTITY)?;
        let then = self.columns.get(fields::IDENTITY)?;
        if now == then {
            return Ok(None);
        }
        let slots = Slots::from_identities(then);
        let gone = FieldError::Missing(fields::IDENTITY.name);
        let places = now.iter().map(|id| slots.slot(*id));
        places.collect::<Option<_>>().ok_or(gone).map(Some)
    }

    /// Puts part of the state back, for any present order of the particles.
    /// Of the columns those that are integrated are meant in any case. State that stages write (a shift, the start of
    /// a solve) is left as the last evaluation made it: only motion is undone.
    pub(crate) fn recall(&self, flow: &mut Flow<D>, what: Recall) -> Result<(), FieldError> {
        let places = self.places(&flow.world.free)?;
        let by_stages = |name: &str| {
            let mut writes = flow.columns.stages.iter().flat_map(|a| &a.writes);
            writes.any(|f| f.name == name)
        };
        let wanted = |name: &str| {
            flow.integrated.iter().any(|f| f.name == name)
                || match what {
                    Recall::Scalars => false,
                    Recall::Motion => name == fields::VELOCITY.name,
                    Recall::State => name != fields::IDENTITY.name && !by_stages(name),
                }
        };
        let free = &mut flow.world.free;
        free.put_state(&self.columns, places.as_deref(), wanted)?;
        if what == Recall::State {
            flow.world.time = self.time;
            self.put_walls_back(flow);
        }
        Ok(())
    }

    /// Puts the state back. If the particles were sorted meanwhile, they return to their
    /// order; those that left since come back, those that came in are gone.
    pub fn restore(&self, flow: &mut Flow<D>) -> Result<(), StepError> {
        flow.world.free.restore_state(&self.columns)?;
        flow.world.time = self.time;
        flow.world.dt = self.dt;
        self.put_walls_back(flow);
        // The results of the evaluation of this state are among it.
        flow.restored = true;
        flow.rebuild_lists()
    }

    fn put_walls_back(&self, flow: &mut Flow<D>) {
        if let Some(walls) = &mut flow.walls {
            // The walls accepted this time before, so they accept it again.
            let _ = walls.put_back(&mut flow.world.walls, &self.walls, self.time);
            flow.loads.clone_from(&self.loads);
        }
    }
}
