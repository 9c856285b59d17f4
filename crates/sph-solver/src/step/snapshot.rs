//! The state before a step, to fall back on when the step fails.

use sph_boundary::{Wall, WallStates};
use sph_core::{Field, FieldError, Recall, Scalar, Slots, Store, Vect, fields};
use sph_neighbours::{WallForce, World};

pub(crate) type MovedWalls<'a, const D: usize> = (
    Option<&'a mut (dyn Wall<D> + 'static)>,
    &'a mut Vec<WallForce<D>>,
);

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
    pub(crate) fn save(
        &mut self,
        world: &World<D>,
        walls: Option<&dyn Wall<D>>,
        loads: &[WallForce<D>],
    ) -> Result<(), FieldError> {
        world.free.save_state(&mut self.columns)?;
        self.time = world.time;
        self.dt = world.dt;
        if let Some(walls) = walls {
            self.walls = walls.states();
            // Lists are built anew where a step is taken back.
            self.walls.listed = None;
            self.loads.clear();
            self.loads.extend_from_slice(loads);
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
    /// Of the columns those that are `integrated` are meant in any case. State that stages write (a shift, the start of
    /// a solve) is left as the last evaluation made it: only motion is undone.
    pub(crate) fn recall(
        &self,
        world: &mut World<D>,
        walls: MovedWalls<'_, D>,
        what: Recall,
        (integrated, by_stages): (&[Field<Scalar>], &[&str]),
    ) -> Result<(), FieldError> {
        let places = self.places(&world.free)?;
        let wanted = |name: &str| {
            integrated.iter().any(|f| f.name == name)
                || match what {
                    Recall::Scalars => false,
                    Recall::Motion => name == fields::VELOCITY.name,
                    Recall::State => name != fields::IDENTITY.name && !by_stages.contains(&name),
                }
        };
        let free = &mut world.free;
        free.put_state(&self.columns, places.as_deref(), wanted)?;
        if what == Recall::State {
            world.time = self.time;
            self.walls_back(world, walls);
        }
        Ok(())
    }

    fn walls_back(&self, world: &mut World<D>, (walls, loads): MovedWalls<'_, D>) {
        if let Some(walls) = walls {
            // The walls accepted this time before, so they accept it again.
            let _ = walls.put_back(&mut world.walls, &self.walls, self.time);
            loads.clone_from(&self.loads);
        }
    }

    /// Puts all of the state and the clock back, but builds no lists.
    pub(crate) fn put_back(
        &self,
        world: &mut World<D>,
        walls: MovedWalls<'_, D>,
    ) -> Result<(), FieldError> {
        world.free.restore_state(&self.columns)?;
        world.time = self.time;
        world.dt = self.dt;
        self.walls_back(world, walls);
        Ok(())
    }
}
