//! From a scene to a flow that can be evaluated.

use std::sync::Arc;

use sph_boundary::Wall;
use sph_contribution::integrators::Integrator;
use sph_contribution::{Part, PluginInForce, Setting, force_limit, motion_limit};
use sph_core::{Inserted, Role, Store, fields};
use sph_multiphase::{Diffused, Formulation};
use sph_neighbours::World;
use sph_probes::{Probe, Solution};
use sph_rheology::Rheology;
use sph_rheology::state::{Laws, Lift, Lifted, Reference};
use sph_scene::Scene;
use sph_solver::setup::{Choices, Planning, StagePlan, shown};
use sph_solver::step::{
    NewParticleDefaults, Outlets, VariableGravity, accounts, term_accelerations,
};
use sph_solver::{Flow, SolverError};

use crate::setup::domain::{height, pressure_at_rest};
use crate::setup::estimate::refuse_the_absurd;
use crate::setup::initial_world::InitialWorld;
use crate::setup::leaks::Leak;
use crate::setup::placement::PlacedParticles;
use crate::setup::probe_setup::{self, check_output_fields};
use crate::setup::relax::Relaxation;
use crate::setup::shapes::Drawn;
use crate::setup::share::Share;
use crate::setup::sound::sound_speeds;
use crate::setup::start::{Start, phases_of_bodies, start};
use crate::setup::{
    field_error, lattices, movers, open_faces, soil_remarks, variable_gravity, wall_speeds,
};

/// Way of the fastest point of a wall within a step, over the spacing: two that meet close half a spacing.
const WAY: f64 = 0.25;

/// A flow with everything a run needs besides.
pub struct Assembled<const D: usize> {
    /// The system.
    pub flow: Flow<D>,
    /// The time stepping scheme.
    pub integrator: Box<dyn Integrator>,
    /// The quantity that the formulation integrates for the density.
    pub diffused: Diffused,
    /// Probes by name.
    pub probes: Vec<(String, Box<dyn Probe<D>>)>,
    /// Solutions by the name of their reference.
    pub solutions: Vec<(String, Box<dyn Solution<D>>)>,
    /// Plugins with their parameters.
    pub plugins: Vec<PluginInForce>,
    /// Remarks for the summary.
    pub warnings: Vec<String>,
    /// Walls behind which fluid can get.
    pub leaks: Vec<Leak<D>>,
    /// The relaxation of the first particles, if there was one.
    pub relaxation: Option<Relaxation>,
    /// Extent of all bodies along gravity, m.
    pub height: f64,
    /// Pressure that all bodies above one another would have below them at rest, Pa.
    pub pressure: f64,
    /// Body that a particle came from, by its number.
    pub body_of: Vec<u32>,
}

/// Builds the plugins, the particles and the plan of the start of a process. Where this is a part of the flow, all
/// ranks assemble together.
///
/// # Errors
/// Every problem of the scene, with its path, and nothing is written; a flow that cannot be divided; another rank that failed.
pub fn assembled<const D: usize>(
    scene: &Scene,
    mut share: Share<D>,
) -> Result<Assembled<D>, SolverError> {
    let mut drawn = Drawn::<D>::from_scene(scene)?;
    refuse_the_absurd(scene, &drawn)?;
    let mut choices = chosen::<D>(scene)?;
    let (laws, swing, lift) = bind_laws::<D>(scene, &drawn, &choices)?;
    movers::prepare(scene, &mut drawn, &mut choices, &laws)?;
    let speeds = wall_speeds::remarks(scene, &drawn, &laws)?;
    let opened = open_faces::prepare(scene, &mut drawn, &mut choices, &laws)?;
    let room = InitialWorld::for_share(scene, &drawn, &mut choices, &mut share)?;
    let faces = open_faces::check(scene, &opened, &room, (&laws, &lift))?;
    let (walls, placed, mut warnings) = (room.walls, room.placed, room.warnings);
    let (leaks, room) = (room.leaks, room.world);
    warnings.extend(speeds.into_iter().chain(faces));
    let (kinematic_viscosities, constant) = viscosities(scene, &choices.rheologies);
    let formulation: Arc<dyn Formulation<D>> = choices.formulation.into();
    let shown = shown(scene, &choices.probes);
    let mut parts = choices.parts;
    open_faces::join(scene, opened, &mut parts)?;
    let (free, outlets) = filled_columns(scene, &*formulation, &parts, &placed)?;
    let world = World { free, ..room };
    let soils = soil_remarks::soils(&choices.rheologies);
    let planned = plan(
        scene,
        (&*formulation, &*choices.integrator),
        (&laws, &constant, &soils),
        (&world, walls.as_deref()),
        &shown,
        &mut parts,
    )?;
    let saturated = planned.offer.saturated;
    let diffused = formulation.diffused();
    let mut flow = Flow::new(world, planned, diffused.evolved, laws, outlets);
    flow.walls = walls;
    flow.kinematic_viscosities = kinematic_viscosities;
    flow.swing = swing;
    show(scene, &shown, &choices.probes, &mut flow)?;
    let columns = || parts.iter().flat_map(|(_, p)| p.columns());
    let beginning = Start {
        scene,
        drawn: &drawn,
        body_of: &placed.body,
        initial: &choices.initial,
        formulation: &*formulation,
        columns: &columns().collect::<Vec<_>>(),
    };
    flow.know_exits(scene);
    flow.world.wrap()?;
    let soils = soil_remarks::remarks(scene, &flow, &choices.rheologies, saturated)?;
    warnings.extend(soils);
    warnings.extend(lattices::remarks(scene, &flow, &placed.body)?);
    let relaxation = start(&beginning, &share, &mut flow)?;
    let (probes, integrator) = (&choices.probes, &*choices.integrator);
    accounts::open(scene, probes, integrator, &*formulation, &mut flow)?;
    let comes_in = !flow.gates.is_empty() || scene.window.is_some();
    let columns = columns().collect();
    flow.nursery = comes_in.then(|| NewParticleDefaults::new(scene, formulation, columns));
    Ok(Assembled {
        flow,
        integrator: choices.integrator,
        diffused,
        probes: choices.probes,
        solutions: choices.solutions,
        plugins: choices.in_force,
        warnings,
        leaks,
        relaxation,
        height: height(scene, &drawn.regions),
        pressure: pressure_at_rest(scene, &drawn.regions),
        body_of: placed.body,
    })
}

/// The plugins of a scene, with all probes ready.
fn chosen<const D: usize>(scene: &Scene) -> Result<Choices<D>, SolverError> {
    let mut choices = Choices::<D>::from_scene(scene)?;
    let errors = field_error::probes(scene, &mut choices.solutions);
    choices.probes.extend(errors);
    probe_setup::prepare(scene, &mut choices.probes)?;
    Ok(choices)
}

/// True if a wall moves or slides.
pub fn moves(wall: &sph_scene::Wall) -> bool {
    wall.motion.is_some() || wall.velocity.is_some() || !wall.mover.is_empty()
}

/// Stages and limits of a flow, by its formulation and integrator, the laws of its phases with their constant
/// viscosities and the marks of soils, and its walls.
fn plan<const D: usize>(
    scene: &Scene,
    (formulation, integrator): (&dyn Formulation<D>, &dyn Integrator),
    (laws, viscosities, soils): (&Laws, &[Option<f64>], &[bool]),
    (world, walls): (&World<D>, Option<&dyn Wall<D>>),
    shown: &[String],
    parts: &mut [Part<D>],
) -> Result<StagePlan<D>, SolverError> {
    let phases: Vec<String> = scene.phase.keys().cloned().collect();
    let bodies: Vec<String> = scene.body.keys().cloned().collect();
    let diffused = formulation.diffused();
    let coefficients = integrator.coefficients();
    let moving = scene.wall.iter().find(|(_, wall)| moves(wall));
    let setting = Setting {
        laws,
        phases: &phases,
        bodies: &bodies,
        viscosities,
        soils,
        density: diffused.evolved,
        summed: formulation.compressed().is_none(),
        pressure_ahead: scene.choice("pressure").is_some(),
        courant: coefficients.courant,
        viscous: coefficients.viscous,
        kicks_once: integrator.kicks_once(),
        delayed_yield: scene.numerics.delayed_yield,
        carried: movers::carried(scene),
        moving_wall: moving.map(|(name, _)| name.as_str()),
        world,
    };
    let planning = Planning {
        scene,
        setting: &setting,
        walls,
        diffused,
        shown,
    };
    let mut planned = planning.plan(parts)?;
    planned.offer.limiter(force_limit(coefficients.force));
    let mut walls = scene.wall.values();
    if walls.any(|w| w.motion.is_some() || !w.mover.is_empty()) {
        planned.offer.limiter(motion_limit(WAY));
    }
    Ok(planned)
}

/// The columns that carry history, with places, identities and phases in them, and where particles leave.
fn filled_columns<const D: usize>(
    scene: &Scene,
    formulation: &dyn Formulation<D>,
    parts: &[Part<D>],
    placed: &PlacedParticles<D>,
) -> Result<(Store<D>, Outlets), SolverError> {
    let mut free = Store::new(placed.positions.len());
    free.add(fields::POSITION, Role::State);
    free.add(fields::VELOCITY, Role::State);
    free.add(fields::MASS, Role::State);
    free.add(fields::IDENTITY, Role::State);
    if scene.phase.len() > 1 {
        free.add(fields::PHASE, Role::State);
    }
    free.add(formulation.diffused().evolved.value, Role::State);
    if let Some(compressed) = formulation.compressed() {
        free.add(compressed.value, Role::State);
    }
    for column in parts.iter().flat_map(|(_, p)| p.columns()) {
        if free.has(column.field.name) {
            let name = column.field.name;
            let why = format!("two plugins of this scene have a column `{name}`");
            return Err(SolverError::at("", why));
        }
        free.add(column.field, Role::State);
    }
    let outlets = Outlets::from_scene(scene, (&placed.positions, &placed.body), &mut free)?;
    let count = free.len() as u32;
    free.get_mut(fields::POSITION)?
        .copy_from_slice(&placed.positions);
    *free.get_mut(fields::IDENTITY)? = (0..count).collect();
    if free.has(fields::PHASE.name) {
        let phases: Vec<u32> = phases_of_bodies(scene);
        let of = placed.body.iter().map(|body| phases[*body as usize]);
        *free.get_mut(fields::PHASE)? = of.collect();
    }
    free.inserted = Inserted {
        identities: count,
        ..Inserted::default()
    };
    Ok((free, outlets))
}

/// Keeps displacements where an output or a probe needs them; refuses outputs of fields that there are none of.
fn show<const D: usize>(
    scene: &Scene,
    shown: &[String],
    probes: &[(String, Box<dyn Probe<D>>)],
    flow: &mut Flow<D>,
) -> Result<(), SolverError> {
    let moved = shown.iter().any(|f| f == fields::DISPLACEMENT.name);
    if moved || probes.iter().any(|(_, p)| p.needs().displacement) {
        flow.world.free.add(fields::DISPLACEMENT, Role::State);
    }
    term_accelerations::open(shown, flow);
    check_output_fields(scene, flow)
}

/// Equations of state with their reference states, and the change of gravity; the lift where faces are open.
fn bind_laws<const D: usize>(
    scene: &Scene,
    drawn: &Drawn<D>,
    choices: &Choices<D>,
) -> Result<(Laws, Option<VariableGravity<D>>, Lift), SolverError> {
    let swing = variable_gravity::from_scene::<D>(scene)?;
    let head_of = |swing| variable_gravity::head(swing, scene.run.end, &drawn.regions);
    let more = swing.as_ref().map_or(0.0, head_of);
    let head = height(scene, &drawn.regions) * scene.gravity::<D>().norm();
    let speeds = sound_speeds(scene, (head + more).sqrt())?;
    let phases = scene.phase.values().zip(speeds);
    let reference = phases.map(|(phase, sound_speed)| Reference {
        density: phase.density,
        sound_speed,
    });
    let laws = choices.equations_of_state.iter().zip(reference);
    let lift = Lift::default();
    let laws = laws.map(|(eos, reference)| match choices.open.is_empty() {
        true => eos.bind(reference),
        false => Box::new(Lifted::new(eos.bind(reference), &lift)),
    });
    Ok((laws.collect(), swing, lift))
}

/// η/ρ₀ of every phase, m²/s: the largest, and that of laws with one viscosity.
fn viscosities(scene: &Scene, laws: &[Box<dyn Rheology>]) -> (Vec<f64>, Vec<Option<f64>>) {
    let laws = scene.phase.values().map(|p| p.density).zip(laws);
    let over = laws.map(|(density, law)| {
        let uniform = law.uniform_viscosity().map(|eta| eta / density);
        (law.largest_viscosity() / density, uniform)
    });
    over.unzip()
}
