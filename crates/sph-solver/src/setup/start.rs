//! The state of all particles before the first step.

use sph_contribution::{Birth, Initial, OwnColumn};
use sph_core::fields;
use sph_multiphase::Formulation;
use sph_neighbours::World;
use sph_probes::Solution;
use sph_scene::Scene;

use crate::failure::error::SolverError;
use crate::setup::initial::InitialState;
use crate::setup::layers::Layers;
use crate::setup::relax::relax;
use crate::setup::relaxation::Relaxation;
use crate::setup::shapes::Drawn;
use crate::step::flow::Flow;

/// What the first state of all particles is made from.
pub(crate) struct Start<'a, const D: usize> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its bodies as shapes.
    pub drawn: &'a Drawn<D>,
    /// Body that a particle comes from, by its number.
    pub body_of: &'a [u32],
    /// Initial fields, by the body's name.
    pub initial: &'a [(String, Box<dyn Solution<D>>)],
    /// What density is.
    pub formulation: &'a dyn Formulation<D>,
    /// Columns that contributions bring along.
    pub columns: &'a [OwnColumn<D>],
}

/// Sorts the particles and gives them their initial state.
pub(crate) fn start<const D: usize>(
    given: &Start<'_, D>,
    flow: &mut Flow<D>,
) -> Result<Option<Relaxation>, SolverError> {
    let Start { scene, drawn, .. } = given;
    let world = &mut flow.world;
    world.rebuild_lists()?;
    let relaxation = relax(scene, drawn, world, flow.walls.as_ref())?;
    let phases: Vec<&String> = scene.phase.keys().collect();
    let layers = Layers::of(scene, &drawn.regions);
    let mut states = Vec::new();
    let mut phase_of = Vec::new();
    for ((name, body), region) in scene.body.iter().zip(&drawn.regions) {
        let phase = phases.iter().position(|p| **p == body.phase).unwrap_or(0);
        let field = given.initial.iter().find(|(n, _)| n == name);
        let field = field.map(|(_, f)| &**f);
        states.push(InitialState::new(
            scene,
            body,
            region,
            &*flow.laws[phase],
            field,
            layers.as_ref(),
        ));
        phase_of.push(phase as u32);
    }
    let identity = world.free.get(fields::IDENTITY)?.to_vec();
    let position = world.free.get(fields::POSITION)?.to_vec();
    let body = |k: usize| given.body_of[identity[k] as usize] as usize;
    let volume = relaxation.map_or(1.0, |r| r.volume);
    let (noise, seed) = (scene.numerics.velocity_noise, scene.numerics.seed);
    let whole = volume * world.spacing.powi(D as i32);
    for k in 0..identity.len() {
        let state = &states[body(k)];
        let density = state.density(&position[k]);
        world.free.get_mut(fields::DENSITY)?[k] = density;
        world.free.get_mut(fields::MASS)?[k] = density * whole;
        let mut velocity = state.velocity(&position[k]);
        if noise > 0.0 {
            velocity += sph_core::Vect::<D>::from(sph_scene::noise(identity[k], noise, seed));
        }
        world.free.get_mut(fields::VELOCITY)?[k] = velocity;
        if world.free.has(fields::PHASE.name) {
            world.free.get_mut(fields::PHASE)?[k] = phase_of[body(k)];
        }
    }
    let bodies: Vec<&str> = scene.body.keys().map(String::as_str).collect();
    for column in given.columns {
        let name = |k: usize| {
            let body = body(k);
            (phases[phase_of[body] as usize].as_str(), bodies[body])
        };
        fill(world, column, name)?;
    }
    if let Some(walls) = &flow.walls {
        crate::step::stages::lock(walls).geometry(world)?;
    }
    given.formulation.rebase(world)?;
    let limits = flow.step_limits()?;
    let least = sph_core::StepLimit::least(&limits).map_or(0.0, |l| l.dt);
    flow.world.dt = scene.run.safety * least;
    Ok(relaxation)
}

/// Gives a column of a contribution its values at the start; `names` has the phase and the body of a particle.
fn fill<'n, const D: usize>(
    world: &mut World<D>,
    column: &OwnColumn<D>,
    names: impl Fn(usize) -> (&'n str, &'n str),
) -> Result<(), SolverError> {
    let free = &world.free;
    let (position, velocity) = (free.get(fields::POSITION)?, free.get(fields::VELOCITY)?);
    let (density, mass) = (free.get(fields::DENSITY)?, free.get(fields::MASS)?);
    let birth = |k: usize| {
        let (phase, body) = names(k);
        Birth {
            position: position[k],
            velocity: velocity[k],
            density: density[k],
            mass: mass[k],
            phase,
            body,
        }
    };
    let all = 0..position.len();
    match &column.initial {
        Initial::Zero => {}
        Initial::Scalar(formula) => {
            let values = all.map(|k| formula(&birth(k))).collect();
            world.free.put(column.field.scalar(), values)?;
        }
        Initial::Vector(formula) => {
            let values = all.map(|k| formula(&birth(k))).collect();
            world.free.put(column.field.vector(), values)?;
        }
    }
    Ok(())
}
