//! A flow is copied before a step, and put back when the step fails.

use sph_core::{FieldError, StepError};

use crate::Flow;
use crate::step::snapshot::Snapshot;

impl<const D: usize> Snapshot<D> {
    /// Copies the state; reuses its buffers.
    pub fn take(&mut self, flow: &Flow<D>) -> Result<(), FieldError> {
        self.save(&flow.world, flow.walls.as_deref(), &flow.loads)
    }

    /// Puts the state back. If the particles were sorted meanwhile, they return to their
    /// order; those that left since come back, those that came in are gone.
    pub fn restore(&self, flow: &mut Flow<D>) -> Result<(), StepError> {
        let walls = (flow.walls.as_deref_mut(), &mut flow.loads);
        self.put_back(&mut flow.world, walls)?;
        // What the evaluation of this state has left is among it.
        flow.restored = true;
        flow.rebuild_lists()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::dimensions::in_plane;
    use crate::step::stages::Work;
    use sph_core::{Access, Declares, Field, Role, Scalar, Stage, StepError, System, fields};
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
        let mut flow = in_plane(SCENE);
        flow.stages.push(Work::Stage(Box::new(Counting)));
        flow.ask_all();
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
