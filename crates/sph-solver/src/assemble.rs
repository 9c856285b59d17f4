//! From a scene to a flow that can be evaluated.

use std::sync::{Arc, Mutex};

use sph_boundary::{Condition, Polyline, RigidMotion, WallSetup, WallSpec, thin_plate};
use sph_core::{Access, AnyField, Declares, Role, SceneProblem, Stage, Store, Vect, fields, plan};
use sph_integrators::Integrator;
use sph_kernels::Kernel;
use sph_multiphase::{
    BoundState, ForceLimit, Limiter, PressureStage, Reference, SoundLimit, Viscosity, ViscousLimit,
};
use sph_neighbours::{Domain, WallSet, World, fuse_all};
use sph_probes::{Probe, Solution};
use sph_scene::Scene;

use crate::choices::Choices;
use crate::defaults;
use crate::error::SolverError;
use crate::flow::Flow;
use crate::initial::{InitialState, place};
use crate::stages::{
    Also, InteractionSweep, SharedWall, ViscosityStage, WALL_STATE, WallGeometry, WallState,
};
use crate::summary::PluginInForce;

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
}

/// Builds the plugins, the particles and the plan.
///
/// # Errors
/// Every problem of the scene, with its path; nothing is written.
pub fn assemble<const D: usize>(scene: &Scene) -> Result<Assembled<D>, SolverError> {
    crate::estimate::refuse_the_absurd::<D>(scene)?;
    let mut choices = Choices::<D>::of(scene).map_err(SolverError::Scene)?;
    let laws = bind_laws::<D>(scene, &choices)?;
    let spacing = scene.numerics.spacing;
    let h = scene.numerics.smoothing_ratio * spacing;
    let sampler = choices.kernel.sampler(D, h);
    let skin = scene.numerics.skin.unwrap_or(defaults::SKIN);
    let domain = domain_of::<D>(scene);
    check_periods(&domain, sampler.support_radius() * (1.0 + skin))?;

    let mut warnings = Vec::new();
    let mut wall_set = WallSet::default();
    if let Some(walls) = &mut choices.walls {
        wall_set = build_walls(scene, &mut **walls, &*choices.kernel, &domain, h)?;
        warnings.extend(walls.warnings());
    }
    let placed = place(scene, choices.walls.as_deref()).map_err(SolverError::Scene)?;
    warnings.extend(placed.warnings);
    if let Some(walls) = &choices.walls {
        let ends = walls.check_free_ends(&placed.positions);
        ends.map_err(|e| SolverError::at("wall", e.to_string()))?;
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
    let evolved = choices.formulation.evolved();
    for scalar in &evolved {
        free.add(scalar.value, Role::State);
    }
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
    };

    let kinematic_viscosities = kinematic_viscosities(scene, &choices.rheologies);
    let limiters = limiters_of(&choices, &laws, &kinematic_viscosities);
    let (stages, pruned) = plan_stages(scene, &mut choices, &laws, walls.as_ref(), &world)?;
    let mut flow = Flow {
        world,
        stages,
        pruned,
        limiters,
        walls,
        evolved,
        laws,
        kinematic_viscosities,
        timings: Vec::new(),
    };
    flow.reset_timings();
    allocate(&mut flow);
    check_output_fields(scene, &flow)?;
    start(scene, &choices, &mut flow, &placed.body)?;
    Ok(Assembled {
        flow,
        integrator: choices.integrator,
        probes: choices.probes,
        solutions: choices.solutions,
        plugins: choices.in_force,
        warnings,
    })
}

/// Equations of state with their reference states.
fn bind_laws<const D: usize>(
    scene: &Scene,
    choices: &Choices<D>,
) -> Result<Arc<[Box<dyn BoundState>]>, SolverError> {
    let mut laws = Vec::new();
    for ((name, phase), eos) in scene.phase.iter().zip(&choices.equations_of_state) {
        let scale = phase.velocity_scale.unwrap_or(0.0);
        let default = 10.0 * scale.max((height::<D>(scene) * scene.gravity::<D>().norm()).sqrt());
        let sound_speed = phase.speed_of_sound.unwrap_or(default);
        if sound_speed <= 0.0 {
            return Err(SolverError::at(
                format!("phase.{name}"),
                "without gravity the speed of sound cannot be guessed: give `speed_of_sound`, or \
                 `velocity_scale`, the largest speed you expect",
            ));
        }
        laws.push(eos.bind(Reference {
            density: phase.density,
            sound_speed,
        }));
    }
    Ok(laws.into())
}

/// Extent of all bodies along gravity, m.
pub(crate) fn height<const D: usize>(scene: &Scene) -> f64 {
    let gravity = scene.gravity::<D>();
    let Some(down) = gravity.try_normalize(0.0) else {
        return 0.0;
    };
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for region in scene.regions::<D>() {
        let (lower, upper) = region.base.bounds();
        for corner in 0..1 << D {
            let along: f64 = (0..D)
                .map(|k| {
                    down[k]
                        * if corner >> k & 1 == 0 {
                            lower[k]
                        } else {
                            upper[k]
                        }
                })
                .sum();
            low = low.min(along);
            high = high.max(along);
        }
    }
    (high - low).max(0.0)
}

/// The scene's domain, or a box round walls and bodies with room to move.
fn domain_of<const D: usize>(scene: &Scene) -> Domain<D> {
    let mut lower = Vect::<D>::repeat(f64::INFINITY);
    let mut upper = Vect::<D>::repeat(f64::NEG_INFINITY);
    let mut include = |x: &[f64]| {
        for k in 0..D.min(x.len()) {
            lower[k] = lower[k].min(x[k]);
            upper[k] = upper[k].max(x[k]);
        }
    };
    for region in scene.regions::<D>() {
        let (low, high) = region.base.bounds();
        include(&low);
        include(&high);
    }
    for wall in scene.wall.values() {
        wall.polyline.iter().for_each(|p| include(p));
    }
    // Splashes rise over an open tank; without walls the flow may go far.
    let room = match scene.wall.is_empty() {
        true => 10.0,
        false => 2.0,
    };
    let margin = Vect::repeat(room * (upper - lower).max());
    let mut domain = Domain::open(lower - margin, upper + margin);
    if let Some([low, high]) = &scene.numerics.domain {
        domain = Domain::open(Vect::from_column_slice(low), Vect::from_column_slice(high));
    }
    for (axis, bounds) in scene.numerics.periodic.bounds::<D>().iter().enumerate() {
        if let Some([low, high]) = bounds {
            domain.lower[axis] = *low;
            domain.upper[axis] = *high;
            domain.periodic[axis] = true;
        }
    }
    domain
}

/// A period must be so long that no particle sees another one twice.
fn check_periods<const D: usize>(domain: &Domain<D>, reach: f64) -> Result<(), SolverError> {
    for axis in (0..D).filter(|&a| domain.periodic[a]) {
        if domain.length(axis) < 2.0 * reach {
            let name = ["x", "y", "z"][axis];
            return Err(SolverError::at(
                format!("numerics.periodic.{name}"),
                format!(
                    "the period of {} m is shorter than two supports with their skin: at least {:.6} m",
                    domain.length(axis),
                    2.0 * reach
                ),
            ));
        }
    }
    Ok(())
}

fn build_walls<const D: usize>(
    scene: &Scene,
    walls: &mut dyn sph_boundary::Wall<D>,
    kernel: &dyn Kernel,
    domain: &Domain<D>,
    h: f64,
) -> Result<WallSet<D>, SolverError> {
    let mut specs = Vec::new();
    for (name, wall) in &scene.wall {
        let points: Vec<[f64; 2]> = wall.polyline.iter().map(|p| [p[0], p[1]]).collect();
        let refused =
            |e: sph_boundary::BoundaryError| SolverError::at(format!("wall.{name}"), e.to_string());
        let polyline = match wall.thickness {
            Some(thickness) => thin_plate(name.clone(), &points, thickness).map_err(refused)?,
            None => Polyline {
                name: name.clone(),
                points,
                closed: wall.closed,
            },
        };
        let pair = |v: &Option<Vec<f64>>| v.as_ref().map_or([0.0; 2], |v| [v[0], v[1]]);
        let motion = wall
            .motion
            .as_ref()
            .map_or(RigidMotion::default(), |m| RigidMotion {
                velocity: pair(&m.velocity),
                angular_velocity: m.angular_velocity,
                centre: pair(&m.centre),
                start: m.start,
                stop: m.stop.unwrap_or(f64::INFINITY),
            });
        let surface = wall.velocity.as_ref();
        specs.push(WallSpec {
            polyline,
            condition: match wall.condition {
                sph_scene::Condition::NoSlip => Condition::NoSlip,
                sph_scene::Condition::FreeSlip => Condition::FreeSlip,
            },
            surface_velocity: surface.map_or_else(Vect::zeros, |v| Vect::from_column_slice(v)),
            motion,
        });
    }
    let setup = WallSetup {
        walls: &specs,
        spacing: scene.numerics.spacing,
        smoothing_length: h,
        kernel,
        domain,
    };
    let built = walls.build(&setup);
    built.map_err(|e| {
        let text = e.to_string();
        // The messages name the wall in backquotes: point at it if it is one of the scene's.
        let named = scene.wall.keys().find(|n| text.contains(&format!("`{n}`")));
        let path = named.map_or("wall".to_string(), |n| format!("wall.{n}"));
        SolverError::at(path, text)
    })
}

type Stages<const D: usize> = Vec<Box<dyn Stage<World<D>>>>;

/// Offers all stages and keeps, in order, those that the goals need.
fn plan_stages<const D: usize>(
    scene: &Scene,
    choices: &mut Choices<D>,
    laws: &Arc<[Box<dyn BoundState>]>,
    walls: Option<&SharedWall<D>>,
    world: &World<D>,
) -> Result<(Stages<D>, Vec<String>), SolverError> {
    let renormalises = walls.is_some_and(|w| crate::stages::lock(w).renormalises());
    let gamma = || match renormalises {
        true => Access::none().here(fields::RENORMALISATION),
        false => Access::none(),
    };
    let mut terms = vec![choices.formulation.pressure_term()];
    let rheologies: Arc<[_]> = std::mem::take(&mut choices.rheologies).into();
    let viscosity = viscosity_of(scene, &rheologies)?;
    if viscosity != Viscosity::Uniform(0.0) {
        terms.push(choices.viscous_operator.term(viscosity));
    }
    if let Some(smoother) = &choices.smoother {
        terms.push(smoother.term());
    }
    terms.append(&mut choices.terms);
    let scalar = choices.formulation.evolved().first().map(|e| e.rate);
    let changes_scalar = choices.smoother.is_some();
    let sweep = InteractionSweep {
        terms: fuse_all(terms),
        scalar: scalar.filter(|_| changes_scalar),
        walls: walls.is_some(),
        states: Vec::new(),
    };

    let mut offered: Stages<D> = Vec::new();
    if let Some(walls) = walls {
        offered.push(Box::new(WallGeometry(walls.clone())));
    }
    offered.push(Box::new(Also {
        stage: choices.formulation.density_stage(),
        access: gamma(),
    }));
    offered.push(Box::new(PressureStage { laws: laws.clone() }));
    if let Some(walls) = walls {
        offered.push(Box::new(WallState(walls.clone())));
    }
    offered.push(Box::new(ViscosityStage { laws: rheologies }));
    offered.push(Box::new(Also {
        stage: Box::new(sweep),
        access: gamma(),
    }));

    let mut goals: Vec<AnyField> = vec![fields::ACCELERATION.any()];
    for stage in &offered {
        let wanted = scene.output.fields.iter().chain(&scene.output.picture);
        for name in wanted {
            goals.extend(stage.access().writes.iter().filter(|f| f.name == name));
        }
    }
    let sources: Vec<AnyField> = [
        fields::POSITION.any(),
        fields::VELOCITY.any(),
        fields::MASS.any(),
        fields::IDENTITY.any(),
        fields::PHASE.any(),
    ]
    .into_iter()
    .chain(choices.formulation.evolved().iter().map(|e| e.value.any()))
    .filter(|f| world.free.has(f.name))
    .collect();
    let declared: Vec<&dyn Declares> = offered
        .iter()
        .map(|s| s.as_ref() as &dyn Declares)
        .collect();
    let mut planned = plan(&declared, &goals, &sources)?;
    // Walls without γ still need their geometry checked, although nobody reads a field of it.
    if walls.is_some() && !planned.order.contains(&0) {
        planned.order.insert(0, 0);
        planned.pruned.retain(|k| *k != 0);
    }
    let pruned = planned.pruned.iter().map(|&k| offered[k].name()).collect();
    let mut slots: Vec<_> = offered.into_iter().map(Some).collect();
    let stages = planned
        .order
        .iter()
        .filter_map(|&k| slots[k].take())
        .collect();
    Ok((stages, pruned))
}

/// One viscosity for all, or a column.
fn viscosity_of(
    scene: &Scene,
    laws: &[Box<dyn sph_rheology::Rheology>],
) -> Result<Viscosity, SolverError> {
    for (law, phase) in laws.iter().zip(scene.phase.keys()) {
        if law.needs().strain_rate {
            return Err(SolverError::at(
                format!("phase.{phase}.rheology"),
                "the law needs the strain rate, which no stage of this version provides",
            ));
        }
    }
    let uniform: Vec<_> = laws.iter().map(|l| l.uniform_viscosity()).collect();
    match uniform.first() {
        Some(Some(first)) if uniform.iter().all(|v| v == &Some(*first)) => {
            Ok(Viscosity::Uniform(*first))
        }
        _ => Ok(Viscosity::PerParticle),
    }
}

/// η/ρ₀ of every phase, m²/s.
fn kinematic_viscosities(scene: &Scene, laws: &[Box<dyn sph_rheology::Rheology>]) -> Vec<f64> {
    let phases = scene.phase.values().zip(laws);
    phases
        .map(|(phase, law)| law.largest_viscosity() / phase.density)
        .collect()
}

fn limiters_of<const D: usize>(
    choices: &Choices<D>,
    laws: &Arc<[Box<dyn BoundState>]>,
    kinematic_viscosities: &[f64],
) -> Vec<Box<dyn Limiter<D>>> {
    let c = choices.integrator.coefficients();
    let mut limiters: Vec<Box<dyn Limiter<D>>> = vec![
        Box::new(SoundLimit {
            courant: c.courant,
            laws: laws.clone(),
        }),
        Box::new(ForceLimit {
            coefficient: c.force,
        }),
    ];
    let kinematic = kinematic_viscosities.iter().copied().fold(0.0, f64::max);
    if kinematic > 0.0 {
        limiters.push(Box::new(ViscousLimit {
            coefficient: c.viscous / choices.viscous_operator.stiffness(),
            kinematic_viscosity: kinematic,
        }));
    }
    limiters
}

/// Allocates every column that a planned stage touches.
fn allocate<const D: usize>(flow: &mut Flow<D>) {
    use fields::*;
    let scalars = [
        DENSITY,
        VOLUME,
        PRESSURE,
        VISCOSITY,
        RENORMALISATION,
        DENSITY_CONSTANT_RATE,
    ];
    let touched: Vec<AnyField> = flow
        .stages
        .iter()
        .flat_map(|s| {
            let access = s.access();
            let reads = access.reads();
            access.writes.into_iter().chain(reads)
        })
        .filter(|f| f.name != WALL_STATE.name)
        .collect();
    for field in scalars {
        if touched.contains(&field.any()) {
            flow.world.free.add(field, Role::Derived);
        }
    }
    flow.world.free.add(ACCELERATION, Role::Derived);
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
    choices: &Choices<D>,
    flow: &mut Flow<D>,
    body_of: &[u32],
) -> Result<(), SolverError> {
    let world = &mut flow.world;
    world.rebuild_lists()?;
    let phases: Vec<&String> = scene.phase.keys().collect();
    let mut states = Vec::new();
    let mut phase_of = Vec::new();
    for (name, body) in &scene.body {
        let phase = phases.iter().position(|p| **p == body.phase).unwrap_or(0);
        let field = choices.initial.iter().find(|(n, _)| n == name);
        let field = field.map(|(_, f)| &**f);
        states.push(InitialState::new(scene, body, &*flow.laws[phase], field));
        phase_of.push(phase as u32);
    }
    let identity = world.free.get(fields::IDENTITY)?.to_vec();
    let position = world.free.get(fields::POSITION)?.to_vec();
    let body = |k: usize| body_of[identity[k] as usize] as usize;
    let whole = world.spacing.powi(D as i32);
    for k in 0..identity.len() {
        let state = &states[body(k)];
        let density = state.density(&position[k]);
        world.free.get_mut(fields::DENSITY)?[k] = density;
        world.free.get_mut(fields::MASS)?[k] = density * whole;
        world.free.get_mut(fields::VELOCITY)?[k] = state.velocity(&position[k]);
        if world.free.has(fields::PHASE.name) {
            world.free.get_mut(fields::PHASE)?[k] = phase_of[body(k)];
        }
    }
    if let Some(walls) = &flow.walls {
        crate::stages::lock(walls).geometry(world)?;
    }
    choices.formulation.rebase(world)?;
    let limits = flow.step_limits()?;
    let least = sph_core::StepLimit::least(&limits).map_or(0.0, |l| l.dt);
    flow.world.dt = scene.run.safety * least;
    Ok(())
}
