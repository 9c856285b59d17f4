//! The state of all particles before the first step.

use sph_contribution::OwnColumn;
use sph_core::{StepError, StepLimit, Vect, fields};
use sph_multiphase::Formulation;
use sph_probes::Solution;
use sph_rheology::state::BoundState;
use sph_scene::{Body, Pressure, Region, Scene};
use sph_solver::{Flow, SolverError};

use crate::setup::layers::Layers;
use crate::setup::relax::{Relaxation, relax};
use crate::setup::shapes::Drawn;
use crate::setup::share::{Share, all_ready, refuse_the_indivisible};

/// Input of the first state of all particles.
pub(crate) struct Start<'a, const D: usize> {
    pub scene: &'a Scene,
    pub drawn: &'a Drawn<D>,
    /// Body that a particle comes from, by its number.
    pub body_of: &'a [u32],
    /// Initial fields, by the body's name.
    pub initial: &'a [(String, Box<dyn Solution<D>>)],
    pub formulation: &'a dyn Formulation<D>,
    /// Columns that contributions bring along.
    pub columns: &'a [OwnColumn<D>],
}

/// Number of the phase of every body, in the scene's order of names.
pub fn phases_of_bodies(scene: &Scene) -> Vec<u32> {
    let of = |body: &sph_scene::Body| scene.phase.keys().position(|p| *p == body.phase);
    let all = scene.body.values();
    all.map(|body| of(body).unwrap_or(0) as u32).collect()
}

/// Sorts the particles and gives them their initial state; those of a rank's part if this is its `share`.
pub fn start<const D: usize>(
    given: &Start<'_, D>,
    share: &Share<D>,
    flow: &mut Flow<D>,
) -> Result<Option<Relaxation>, SolverError> {
    let relaxation = match share {
        Share::Blank | Share::Columns(_) => return Ok(None),
        Share::Whole => {
            flow.world.rebuild_lists()?;
            relax(given.scene, given.drawn, flow)?
        }
        Share::Part(ranks) => {
            refuse_the_indivisible(flow, ranks.ranks())?;
            flow.world.sort()?;
            let divided = flow.divide(ranks.clone());
            divided.map_err(StepError::from)?;
            None
        }
    };
    let begun = give_state(given, relaxation, flow);
    if let Share::Part(ranks) = share {
        all_ready(&**ranks, begun)?;
        flow.tell_all()?;
    } else {
        begun?;
    }
    let mut limits = flow.step_limits()?;
    flow.least_limits(&mut limits)?;
    let least = StepLimit::least(&limits).map_or(0.0, |l| l.dt);
    flow.world.dt = given.scene.run.safety * least;
    Ok(relaxation)
}

/// Gives the particles of a process their initial state.
fn give_state<const D: usize>(
    given: &Start<'_, D>,
    relaxation: Option<Relaxation>,
    flow: &mut Flow<D>,
) -> Result<(), SolverError> {
    let Start { scene, drawn, .. } = given;
    let world = &mut flow.world;
    let layers = Layers::from_scene(scene, &drawn.regions);
    let gravity = scene.gravity::<D>();
    let bodies = scene.body.iter().zip(&drawn.regions);
    let states = bodies.zip(phases_of_bodies(scene));
    let states = states.map(|(((name, body), region), phase)| {
        let field = given.initial.iter().find(|(n, _)| n == name);
        InitialState {
            body,
            law: &*flow.laws[phase as usize],
            field: field.map(|(_, f)| &**f),
            layers: layers.as_ref().filter(|_| body.surface.is_none()),
            gravity,
            surface: body.surface.unwrap_or_else(|| top(region, &gravity)),
        }
    });
    let states: Vec<InitialState<'_, D>> = states.collect();
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
    }
    let names = scene.body.iter();
    let names: Vec<(&str, &str)> = names.map(|(name, body)| (&*body.phase, &**name)).collect();
    for column in given.columns {
        column.begin(&mut world.free, 0..identity.len(), |k| names[body(k)])?;
    }
    if let Some(walls) = &mut flow.walls {
        walls.geometry(world)?;
    }
    Ok(given.formulation.rebase(world)?)
}

/// Height of the free surface of a region along −gravity, m.
fn top<const D: usize>(region: &Region<D>, gravity: &Vect<D>) -> f64 {
    let (lower, upper) = region.base.bounds();
    let highest = (0..D).map(|k| match gravity[k] > 0.0 {
        true => -gravity[k] * lower[k],
        false => -gravity[k] * upper[k],
    });
    highest.sum::<f64>() / gravity.norm().max(f64::MIN_POSITIVE)
}

/// Density and velocity of a body's particles at the start.
struct InitialState<'a, const D: usize> {
    body: &'a Body,
    law: &'a dyn BoundState,
    field: Option<&'a dyn Solution<D>>,
    /// The bodies whose weight is over it, if the scene gives no surface.
    layers: Option<&'a Layers<'a, D>>,
    gravity: Vect<D>,
    /// Height of the free surface along −gravity, m.
    surface: f64,
}

impl<const D: usize> InitialState<'_, D> {
    /// Density, kg/m³, at a position.
    fn density(&self, x: &Vect<D>) -> f64 {
        let given = self.field.and_then(|f| f.pressure(x, 0.0));
        let pressure = given.unwrap_or_else(|| match self.body.pressure {
            Pressure::Zero => 0.0,
            Pressure::Hydrostatic => match self.layers {
                Some(layers) => layers.weight(x),
                None => {
                    let g = self.gravity.norm();
                    let height = -self.gravity.dot(x) / g.max(f64::MIN_POSITIVE);
                    self.law.reference().density * g * (self.surface - height).max(0.0)
                }
            },
        });
        match (given, self.body.pressure) {
            (None, Pressure::Zero) => self.law.reference().density,
            // Given pressures count from that of the reference density.
            _ => self.law.density(pressure + self.law.background()),
        }
    }

    /// Velocity, m/s, at a position.
    fn velocity(&self, x: &Vect<D>) -> Vect<D> {
        let plain = self.body.velocity.as_deref();
        let plain = plain.map_or_else(Vect::zeros, Vect::from_column_slice);
        let wave = self.body.wave.as_ref();
        let wave = wave.map(|w| Vect::from(w.velocity(&(*x).into(), self.gravity.norm())));
        let field = self.field.and_then(|f| f.velocity(x, 0.0));
        field.or(wave).unwrap_or(plain)
    }
}
