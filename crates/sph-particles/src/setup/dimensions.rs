//! Assembly in the plane and in space, both compiled here: a crate that assembles a scene does not compile the solver again.

use std::any::Any;

use sph_scene::Scene;
use sph_solver::SolverError;

use crate::setup::assemble::{Assembled, assembled};
use crate::setup::share::Share;

/// Builds the plugins, the particles and the plan.
///
/// # Errors
/// Every problem of the scene, with its path; nothing is written.
pub fn assemble<const D: usize>(scene: &Scene) -> Result<Assembled<D>, SolverError> {
    const { assert!(D == 2 || D == 3, "flows have two or three dimensions") };
    let made = match D {
        2 => plane(scene),
        _ => space(scene),
    };
    match made?.downcast() {
        Ok(made) => Ok(*made),
        Err(_) => unreachable!("it was made with {D} dimensions"),
    }
}

fn plane(scene: &Scene) -> Result<Box<dyn Any>, SolverError> {
    Ok(Box::new(assembled::<2>(scene, Share::Whole)?))
}

fn space(scene: &Scene) -> Result<Box<dyn Any>, SolverError> {
    Ok(Box::new(assembled::<3>(scene, Share::Whole)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_core::{Access, Declares, Field, Role, Scalar, Stage, StepError, System, fields};
    use sph_neighbours::World;
    use sph_solver::step::Work;
    use sph_solver::{Flow, Snapshot};

    /// The flow of a scene in the plane: nothing of space is compiled for it.
    fn in_plane(text: &str) -> Flow<2> {
        let loaded = sph_scene::parse(text, "t.toml", &[]).unwrap_or_else(|e| panic!("{e}"));
        let parts = assembled::<2>(&loaded.scene, Share::Whole);
        parts.unwrap_or_else(|e| panic!("{e}")).flow
    }

    const WITH_OUTLETS: &str = "title = \"t\"\ndimension = 2\nrun.end = 1\nnumerics.spacing = 0.1\n\
         phase.a = { density = 1, velocity_scale = 1, rheology.newtonian = { viscosity = 1 } }\n\
         phase.b = { density = 1, velocity_scale = 1, rheology.newtonian = { viscosity = 1 } }\n\
         body.a = { phase = \"a\", box = [[0, 0], [1, 1]] }\n\
         body.b = { phase = \"b\", box = [[0, 1], [1, 2]] }\n\
         outlet.right = { beyond = 2 }\n\
         outlet.below = { box = [[0, -2], [1, -1]] }\n";

    #[test]
    fn a_step_that_fails_brings_back_who_left_by_it() {
        let mut flow = in_plane(WITH_OUTLETS);
        let state = |flow: &Flow<2>| {
            let free = &flow.world.free;
            let identity = free.get(fields::IDENTITY).unwrap().to_vec();
            let mass = free.get(fields::MASS).unwrap().to_vec();
            let phase = free.get(fields::PHASE).unwrap().to_vec();
            let position = free.get(fields::POSITION).unwrap().to_vec();
            (identity, mass, phase, position, free.removed.clone())
        };
        let sent = |flow: &mut Flow<2>, k: usize, to: [f64; 2]| {
            flow.world.free.get_mut(fields::POSITION).unwrap()[k] = to.into();
        };
        // A first step takes one out for good.
        sent(&mut flow, 7, [2.5, 0.0]);
        flow.let_out(0.1).unwrap();
        flow.world.rebuild_lists().unwrap();
        let mut snapshot = Snapshot::default();
        snapshot.take(&flow).unwrap();
        let before = state(&flow);
        sent(&mut flow, 3, [2.5, 0.0]);
        sent(&mut flow, 150, [0.5, -1.5]);
        flow.let_out(0.1).unwrap();
        flow.world.rebuild_lists().unwrap();
        assert_eq!(flow.world.free.len(), before.0.len() - 2);
        let left: Vec<_> = flow.left().filter(|(_, l)| l.particles > 0).collect();
        let sum: u64 = left.iter().map(|(_, l)| l.particles).sum();
        assert_eq!(sum, 3, "{left:?}");
        snapshot.restore(&mut flow).unwrap();
        assert!(state(&flow) == before, "the state before the step is back");
        let (left, one) = (flow.mass_left(), 0.01);
        assert!((left - one).abs() < 1e-12, "{left}");
    }

    const PERIODIC: &str = "title = \"t\"\ndimension = 2\nrun.end = 1\nnumerics.spacing = 0.1\n\
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
        let mut flow = in_plane(PERIODIC);
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
