//! The state before a step, to fall back on when the step fails.

use sph_boundary::WallStates;
use sph_core::{FieldError, Recall, Saved, Slots, Vect, fields};

use crate::Flow;
use crate::step::stages::lock;

/// All columns that carry history, whoever declared them, in the order the particles had, and the clock.
#[derive(Default)]
pub struct Snapshot<const D: usize> {
    columns: Saved<D>,
    time: f64,
    /// The step before, s.
    dt: f64,
    /// Walls that movers move.
    walls: WallStates,
}

impl<const D: usize> Snapshot<D> {
    /// Copies the state; reuses its buffers.
    pub fn take(&mut self, flow: &Flow<D>) -> Result<(), FieldError> {
        let free = &flow.world.free;
        free.save_state(&mut self.columns)?;
        self.time = flow.world.time;
        self.dt = flow.world.dt;
        if let Some(walls) = &flow.walls {
            // Lists are built anew where a step is taken back.
            let listed = None;
            self.walls = WallStates {
                listed,
                ..lock(walls).states()
            };
        }
        Ok(())
    }

    /// Where the particle of a number was.
    pub fn position_of(&self, number: u32) -> Option<Vect<D>> {
        let identity = self.columns.get(fields::IDENTITY);
        let place = identity.iter().position(|i| *i == number)?;
        self.columns.get(fields::POSITION).get(place).copied()
    }

    /// Where every particle of now is in the copy; `None` if the order is the same.
    pub fn places(&self, flow: &Flow<D>) -> Result<Option<Vec<u32>>, FieldError> {
        let now = flow.world.free.get(fields::IDENTITY)?;
        let then = self.columns.get(fields::IDENTITY);
        if now == then {
            return Ok(None);
        }
        let slots = Slots::of(then);
        let place = |id: &u32| {
            slots
                .slot(*id)
                .ok_or(FieldError::Missing(fields::IDENTITY.name))
        };
        now.iter().map(place).collect::<Result<_, _>>().map(Some)
    }

    /// Puts part of the state back, whatever order the particles are in now.
    ///
    /// State that stages write (a shift, from what a solve starts) is left as the last evaluation made it: only motion is undone.
    pub fn recall(&self, flow: &mut Flow<D>, what: Recall) -> Result<(), FieldError> {
        let places = self.places(flow)?;
        let integrated: Vec<&str> = flow.integrated.iter().map(|f| f.name).collect();
        let by_stages: Vec<&str> = match what {
            Recall::State => flow.written_by_stages(),
            Recall::Motion | Recall::Scalars => Vec::new(),
        };
        let wanted = |name: &str| {
            integrated.contains(&name)
                || match what {
                    Recall::Scalars => false,
                    Recall::Motion => name == fields::VELOCITY.name,
                    Recall::State => name != fields::IDENTITY.name && !by_stages.contains(&name),
                }
        };
        let free = &mut flow.world.free;
        free.put_state(&self.columns, places.as_deref(), wanted)?;
        if what == Recall::State {
            flow.world.time = self.time;
            self.walls_back(flow);
        }
        Ok(())
    }

    fn walls_back(&self, flow: &mut Flow<D>) {
        if let Some(walls) = &flow.walls {
            // The walls accepted this time before, so they accept it again.
            let _ = lock(walls).put_back(&mut flow.world.walls, &self.walls, self.time);
        }
    }

    /// Puts the state back. If the particles were sorted meanwhile, they return to their
    /// order; those that left since come back, those that came in are gone.
    pub fn restore(&self, flow: &mut Flow<D>) -> Result<(), FieldError> {
        flow.world.free.restore_state(&self.columns)?;
        // What the evaluation of this state has left is among it.
        flow.restored = true;
        flow.world.time = self.time;
        flow.world.dt = self.dt;
        self.walls_back(flow);
        flow.world.rebuild_lists()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_core::{Access, Declares, Field, Role, Scalar, Stage, StepError, System};
    use sph_neighbours::World;

    const SCENE: &str = "title = \"t\"\ndimension = 2\nrun.end = 1\nnumerics.spacing = 0.1\n\
         numerics.periodic = { x = [0, 1], y = [0, 1] }\n\
         phase.a = { density = 1, velocity_scale = 1, rheology.newtonian = { viscosity = 1 } }\n\
         body.a = { phase = \"a\", box = [[0, 0], [1, 1]], velocity = [1, 0] }\n";

    const SEEN: Field<Scalar> = Field::new("seen", "1", "evaluations seen");

    /// Counts evaluations in a column of its own, as a plugin from outside may.
    struct Counting;

    impl Declares for Counting {
        fn name(&self) -> String {
            "counting".into()
        }
        fn access(&self) -> Access {
            Access::none().writes(SEEN)
        }
    }

    impl<const D: usize> Stage<World<D>> for Counting {
        fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
            world.free.add(SEEN, Role::State);
            world.free.get_mut(SEEN)?.iter_mut().for_each(|n| *n += 1.0);
            Ok(())
        }
    }

    /// Two evaluations, the second of which is rolled back and done again: one and one are two, and never three.
    #[test]
    fn a_state_column_that_the_solver_does_not_know_is_rolled_back_and_not_advanced_twice() {
        let scene = sph_scene::parse(SCENE, "t.toml", &[]).unwrap_or_else(|e| panic!("{e}"));
        let parts = crate::assemble::<2>(&scene.scene).unwrap_or_else(|e| panic!("{e}"));
        let mut flow = parts.flow;
        flow.stages.push(Box::new(Counting));
        flow.reset_timings();
        flow.evaluate().unwrap();
        let seen = |flow: &Flow<2>| flow.world.free.get(SEEN).unwrap().to_vec();
        let first = |flow: &Flow<2>| flow.world.free.get(fields::POSITION).unwrap()[0];
        let mut snapshot = Snapshot::default();
        snapshot.take(&flow).unwrap();
        let before = first(&flow);
        flow.drift(0.3).unwrap();
        flow.evaluate().unwrap();
        assert!(seen(&flow).iter().all(|n| *n == 2.0) && flow.world.time == 0.3);
        snapshot.restore(&mut flow).unwrap();
        assert_eq!((first(&flow), flow.world.time), (before, 0.0));
        assert!(seen(&flow).iter().all(|n| *n == 1.0), "{:?}", seen(&flow));
        flow.evaluate().unwrap();
        assert!(seen(&flow).iter().all(|n| *n == 1.0), "{:?}", seen(&flow));
        flow.drift(0.1).unwrap();
        flow.evaluate().unwrap();
        assert!(seen(&flow).iter().all(|n| *n == 2.0), "{:?}", seen(&flow));
    }
}
