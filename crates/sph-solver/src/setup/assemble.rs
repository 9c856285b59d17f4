//! From a scene to a flow that can be evaluated.

use std::sync::{Arc, Mutex};

use sph_contribution::{Birth, Initial, OwnColumn};
use sph_core::plausible::Quantity;
use sph_core::{AnyField, Evolved, Field, Role, Scalar, SceneProblem, Store, fields};
use sph_integrators::Integrator;
use sph_multiphase::{BoundState, Compressed, Diffused, Reference};
use sph_neighbours::{WallSet, World};
use sph_probes::{Probe, Solution};
use sph_rheology::Rheology;
use sph_scene::Scene;
use sph_stress::ElasticSubSteps;

use crate::defaults;
use crate::failure::error::SolverError;
use crate::results::summary::PluginInForce;
use crate::setup::choices::Choices;
use crate::setup::domain::{check_periods, domain_of, height};
use crate::setup::field_error;
use crate::setup::initial::InitialState;
use crate::setup::lattices;
use crate::setup::layers::Layers;
use crate::setup::limits::{elastic_wave, limiters_of};
use crate::setup::placement::place;
use crate::setup::planning::plan_stages;
use crate::setup::probe_setup;
use crate::setup::relax::{Relaxation, relax};
use crate::setup::shapes::Drawn;
use crate::setup::soil_remarks::Ground;
use crate::setup::sound::sound_speeds;
use crate::setup::wall_speeds;
use crate::setup::walls::{build_walls, wall_problem};
use crate::step::dilatation::Dilatation;
use crate::step::flow::Flow;
use crate::step::implicit::{ImplicitViscosity, Solves};
use crate::step::outlets::Outlets;
use crate::step::seepage;
use crate::step::snapshot::Snapshot;
use crate::step::stages::{SharedWall, WALL_STATE};
use crate::step::sub_steps::SubSteps;

/// A flow with everything a run needs besides.
pub struct Assembled<const D: usize> {
    /// The system.
    pub flow: Flow<D>,
    /// The time stepping scheme.
    pub integrator: Box<dyn Integrator>,
    /// Probes by name.
    pub probes: Vec<(String, Box<dyn Probe<D>>)>,
    /// Solutions by the name of their reference.
    pub solutions: Vec<(String, Box<dyn Solution<D>>)>,
    /// Plugins with their parameters.
    pub plugins: Vec<PluginInForce>,
    /// Remarks for the summary.
    pub warnings: Vec<String>,
    /// What relaxing the first particles did, if it was asked for.
    pub relaxation: Option<Relaxation>,
    /// Extent of all bodies along gravity, m.
    pub height: f64,
    /// Body that a particle came from, by its number.
    pub body_of: Vec<u32>,
}

/// Builds the plugins, the particles and the plan.
///
/// # Errors
/// Every problem of the scene, with its path; nothing is written.
pub fn assemble<const D: usize>(scene: &Scene) -> Result<Assembled<D>, SolverError> {
    let drawn = Drawn::<D>::of(scene)?;
    crate::setup::estimate::refuse_the_absurd(scene, &drawn)?;
    let mut choices = Choices::<D>::of(scene).map_err(SolverError::Scene)?;
    choices.probes.extend(field_error::probes(scene)?);
    probe_setup::prepare(scene, &mut choices.probes)?;
    let laws = bind_laws::<D>(scene, &drawn, &choices)?;
    let sounds = laws.iter().map(|law| law.reference().sound_speed);
    let slowest = sounds.fold(f64::INFINITY, f64::min);
    let too_fast = wall_speeds::too_fast(&drawn.walls, slowest, scene.run.end);
    if !too_fast.is_empty() {
        return Err(SolverError::Scene(too_fast));
    }
    let spacing = scene.numerics.spacing;
    let h = scene.numerics.smoothing_ratio * spacing;
    let sampler = choices.kernel.sampler(D, h);
    let support = sampler.support_radius() / spacing;
    if let Some(why) = Quantity::refused("kernel support over the spacing", support) {
        return Err(SolverError::at("numerics.smoothing_ratio", why));
    }
    let skin = scene.numerics.skin.unwrap_or(defaults::SKIN);
    let domain = domain_of(scene, &drawn);
    check_periods(&domain, sampler.support_radius() * (1.0 + skin))?;

    let mut warnings = scene.remarks.clone();
    let mut wall_set = WallSet::default();
    if let Some(walls) = &mut choices.walls {
        wall_set = build_walls(
            scene,
            &drawn.walls,
            &mut **walls,
            &*choices.kernel,
            &domain,
            h,
        )?;
        warnings.extend(walls.warnings());
    }
    let placed =
        place(scene, &drawn.regions, choices.walls.as_deref()).map_err(SolverError::Scene)?;
    warnings.extend(placed.warnings.iter().cloned());
    if let Some(walls) = &choices.walls {
        let ends = walls.check_free_ends(&placed.positions);
        ends.map_err(|e| wall_problem(scene, &e))?;
    }
    let walls: Option<SharedWall<D>> = choices.walls.take().map(|w| Arc::new(Mutex::new(w)));

    let mut free = Store::new(placed.positions.len());
    free.add(fields::POSITION, Role::State);
    free.add(fields::VELOCITY, Role::State);
    free.add(fields::MASS, Role::State);
    free.add(fields::IDENTITY, Role::State);
    if scene.phase.len() > 1 {
        free.add(fields::PHASE, Role::State);
    }
    let diffused = choices.formulation.diffused();
    let compressed = choices.formulation.compressed();
    free.add(diffused.evolved.value, Role::State);
    if let Some(compressed) = &compressed {
        free.add(compressed.value, Role::State);
    }
    for column in own_columns(&choices) {
        if free.has(column.field.name) {
            let name = column.field.name;
            let why = format!("two plugins of this scene have a column `{name}`");
            return Err(SolverError::at("", why));
        }
        free.add_any(column.field, Role::State);
    }
    let outlets = Outlets::of(scene, &placed, &mut free).map_err(SolverError::Scene)?;
    *free.get_mut(fields::POSITION)? = placed.positions;
    let count = free.len() as u32;
    *free.get_mut(fields::IDENTITY)? = (0..count).collect();
    let world = World {
        free,
        walls: wall_set,
        lists: Default::default(),
        domain,
        kernel: sampler,
        spacing,
        skin,
        gravity: scene.gravity::<D>(),
        driving: scene.driving::<D>(),
        time: 0.0,
        dt: 0.0,
        transported: Vec::new(),
    };

    let ground = Ground::of(&choices);
    let kinematic_viscosities = kinematic_viscosities(scene, &choices.rheologies);
    let phases: Vec<String> = scene.phase.keys().cloned().collect();
    let limiters = limiters_of(&choices, &laws, &kinematic_viscosities, &phases);
    let elastic_wave = elastic_wave(&choices, &laws);
    let planned = plan_stages(scene, &mut choices, &laws, walls.as_ref(), &world)?;
    let scheme = choices.implicit_viscosity.take();
    let implicit = planned.friction.zip(scheme);
    let (implicit, solved) = match implicit {
        None => (None, None),
        Some((friction, (scheme, solver))) => {
            let implicit = ImplicitViscosity {
                coupling: friction.coupling,
                scheme,
                solver,
                lagged: planned.lagged,
                stiffens: planned.ahead,
                solves: Solves::default(),
                former: None,
            };
            (Some(implicit), Some(friction.term))
        }
    };
    let sub_steps = planned.sub_stepped.zip(elastic_wave);
    let sub_steps = sub_steps.map(|((term, felt), wave)| {
        let longest = wave.longest_sub_step(&world);
        SubSteps::new(ElasticSubSteps::new(term, felt, longest))
    });
    let mut flow = Flow {
        world,
        stages: planned.stages,
        pruned: planned.pruned,
        terms: planned.terms,
        kinds: planned.kinds,
        solved,
        implicit,
        limiters,
        walls,
        evolved: evolved(&diffused, &choices),
        integrated: integrated(&diffused, compressed.as_ref(), &choices),
        elastic: planned.elastic,
        sub_steps,
        coulomb: planned.coulomb,
        seepage: planned.seepage,
        moved: true,
        restored: false,
        dilatation: compressed.map(|c| Dilatation::new(c, choices.formulation.divergence())),
        kept: Snapshot::default(),
        kept_rates: Default::default(),
        laws,
        kinematic_viscosities,
        timings: Vec::new(),
        outlets,
        contributions: Vec::new(),
    };
    flow.world.transported = planned.transported;
    flow.reset_timings();
    allocate(&mut flow);
    let asked = scene.output.fields.iter().chain(&scene.output.picture);
    let shown = asked.into_iter().any(|f| f == fields::DISPLACEMENT.name);
    if shown || choices.probes.iter().any(|(_, p)| p.needs_displacement()) {
        flow.world.free.add(fields::DISPLACEMENT, Role::State);
    }
    check_output_fields(scene, &flow)?;
    let relaxation = start(scene, &drawn, &choices, &mut flow, &placed.body)?;
    let contributions = choices.contributions.into_iter();
    flow.contributions = contributions.map(|(_, c)| c).collect();
    warnings.extend(ground.remarks(scene, &flow)?);
    warnings.extend(lattices::remarks(scene, &flow, &placed.body)?);
    Ok(Assembled {
        flow,
        integrator: choices.integrator,
        probes: choices.probes,
        solutions: choices.solutions,
        plugins: choices.in_force,
        warnings,
        relaxation,
        height: height(scene, &drawn.regions),
        body_of: placed.body,
    })
}

/// Equations of state with their reference states.
fn bind_laws<const D: usize>(
    scene: &Scene,
    drawn: &Drawn<D>,
    choices: &Choices<D>,
) -> Result<Arc<[Box<dyn BoundState>]>, SolverError> {
    let fall = (height(scene, &drawn.regions) * scene.gravity::<D>().norm()).sqrt();
    let speeds = sound_speeds(scene, fall)?;
    let phases = scene.phase.values().zip(speeds);
    let reference = phases.map(|(phase, sound_speed)| Reference {
        density: phase.density,
        sound_speed,
    });
    let laws = choices.equations_of_state.iter().zip(reference);
    Ok(laws.map(|(eos, reference)| eos.bind(reference)).collect())
}

/// η/ρ₀ of every phase, m²/s.
fn kinematic_viscosities(scene: &Scene, laws: &[Box<dyn Rheology>]) -> Vec<f64> {
    let phases = scene.phase.values().zip(laws);
    phases
        .map(|(phase, law)| law.largest_viscosity() / phase.density)
        .collect()
}

/// Columns of contributions.
fn own_columns<const D: usize>(choices: &Choices<D>) -> Vec<OwnColumn<D>> {
    let all = choices.contributions.iter();
    all.flat_map(|(_, c)| c.columns()).collect()
}

/// Scalars with rates: the formulation's, then those of contributions.
fn evolved<const D: usize>(diffused: &Diffused, choices: &Choices<D>) -> Vec<Evolved> {
    let others = choices.contributions.iter();
    let others = others.flat_map(|(_, c)| c.transported());
    std::iter::once(diffused.evolved).chain(others).collect()
}

/// What the integrator changes besides positions and velocities.
fn integrated<const D: usize>(
    diffused: &Diffused,
    compressed: Option<&Compressed>,
    choices: &Choices<D>,
) -> Vec<Field<Scalar>> {
    let evolved = evolved(diffused, choices);
    let mut all: Vec<Field<Scalar>> = evolved.iter().map(|e| e.value).collect();
    if let Some(c) = compressed.filter(|c| c.value != diffused.evolved.value) {
        all.push(c.value);
    }
    all
}

/// Allocates every column that a planned stage touches.
fn allocate<const D: usize>(flow: &mut Flow<D>) {
    let touched: Vec<AnyField> = flow
        .stages
        .iter()
        .flat_map(|s| {
            let access = s.access();
            let reads = access.reads();
            access.writes.into_iter().chain(reads)
        })
        .filter(|f| f.name != WALL_STATE.name && f.name != fields::PHASE.name)
        .collect();
    for field in touched {
        // Drifts may sort particles between their halves: the shift must be sorted, too.
        // Solves for the effective pressure start from the last one.
        let kept = [fields::SHIFT_VELOCITY.name, fields::EFFECTIVE_PRESSURE.name];
        let role = match kept.contains(&field.name) {
            true => Role::State,
            false => Role::Derived,
        };
        flow.world.free.add_any(field, role);
    }
    // Drifts leave the gradient for the next evaluation.
    for field in flow.elastic.iter().flat_map(|e| e.remembered()) {
        flow.world.free.add_any(field, Role::State);
    }
    for field in flow.seepage.iter().flat_map(|_| seepage::remembered()) {
        flow.world.free.add_any(field, Role::State);
    }
    flow.world.free.add(fields::ACCELERATION, Role::Derived);
    // An evolved scalar that nothing changes is a constant: it needs no rate and no kick.
    let free = &flow.world.free;
    flow.evolved.retain(|e| free.has(e.rate.name));
}

fn check_output_fields<const D: usize>(scene: &Scene, flow: &Flow<D>) -> Result<(), SolverError> {
    let names: Vec<&str> = flow.world.free.columns().map(|c| c.0).collect();
    let lists = [
        ("output.fields", &scene.output.fields),
        ("output.picture", &scene.output.picture),
    ];
    let mut problems = Vec::new();
    for (path, wanted) in lists {
        for name in wanted.iter().filter(|n| !names.contains(&n.as_str())) {
            let near = sph_core::suggestion(name, names.iter().copied());
            let known = names.join(", ");
            problems.push(SceneProblem::new(
                path,
                format!("no plugin of this scene has a field `{name}`{near} (there are: {known})"),
            ));
        }
    }
    match problems.is_empty() {
        true => Ok(()),
        false => Err(SolverError::Scene(problems)),
    }
}

/// Sorts the particles and gives them their initial state.
fn start<const D: usize>(
    scene: &Scene,
    drawn: &Drawn<D>,
    choices: &Choices<D>,
    flow: &mut Flow<D>,
    body_of: &[u32],
) -> Result<Option<Relaxation>, SolverError> {
    let world = &mut flow.world;
    world.rebuild_lists()?;
    let relaxation = relax(scene, drawn, world, flow.walls.as_ref())?;
    let phases: Vec<&String> = scene.phase.keys().collect();
    let layers = Layers::of(scene, &drawn.regions);
    let mut states = Vec::new();
    let mut phase_of = Vec::new();
    for ((name, body), region) in scene.body.iter().zip(&drawn.regions) {
        let phase = phases.iter().position(|p| **p == body.phase).unwrap_or(0);
        let field = choices.initial.iter().find(|(n, _)| n == name);
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
    let body = |k: usize| body_of[identity[k] as usize] as usize;
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
    for column in own_columns(choices) {
        let name = |k: usize| {
            let body = body(k);
            (phases[phase_of[body] as usize].as_str(), bodies[body])
        };
        fill(world, &column, name)?;
    }
    if let Some(walls) = &flow.walls {
        crate::step::stages::lock(walls).geometry(world)?;
    }
    choices.formulation.rebase(world)?;
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
