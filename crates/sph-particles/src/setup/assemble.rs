//! From a scene to a flow that can be evaluated.

use std::sync::Arc;

use sph_boundary::Wall;
use sph_contribution::integrators::Integrator;
use sph_contribution::{ForceLimit, MotionLimit, Part, PluginInForce, Setting};
use sph_core::{Inserted, Role, Store, fields};
use sph_multiphase::{Diffused, Formulation};
use sph_neighbours::World;
use sph_probes::{Probe, Solution};
use sph_rheology::Rheology;
use sph_rheology::state::{Laws, Lift, Lifted, Reference};
use sph_scene::Scene;
use sph_solver::setup::{Choices, FlowInputs, Planning, StagePlan, joined, shown};
use sph_solver::step::{
    NewParticleDefaults, Outlets, VariableGravity, accounts, term_accelerations,
};
use sph_solver::{Flow, SolverError};

use crate::setup::domain::{extent, height, pressure_at_rest};
use crate::setup::estimate::refuse_the_absurd;
use crate::setup::initial_world::InitialWorld;
use crate::setup::leaks::Leak;
use crate::setup::placement::PlacedParticles;
use crate::setup::probe_setup::{self, check_output_fields};
use crate::setup::relax::Relaxation;
use crate::setup::shapes::Drawn;
use crate::setup::share::Share;
use crate::setup::soil_remarks::Ground;
use crate::setup::sound::sound_speeds;
use crate::setup::start::{Start, phases_of_bodies, start};
use crate::setup::wall_speeds::speeds;
use crate::setup::{field_error, lattices, movers, open_faces, variable_gravity};

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
pub(crate) fn assembled<const D: usize>(
    scene: &Scene,
    mut share: Share<D>,
) -> Result<Assembled<D>, SolverError> {
    let mut drawn = Drawn::<D>::from_scene(scene)?;
    refuse_the_absurd(scene, &drawn)?;
    let mut choices = chosen::<D>(scene)?;
    let (laws, swing, lift) = bind_laws::<D>(scene, &drawn, &choices)?;
    movers::prepare(scene, &mut drawn, &mut choices, &laws)?;
    let speeds = wall_speeds(scene, &drawn, &laws)?;
    let opened = open_faces::prepare(scene, &mut drawn, &mut choices, &laws)?;
    let room = InitialWorld::for_share(scene, &drawn, &mut choices, &mut share)?;
    let (walls, placed, mut warnings) = (room.walls, room.placed, room.warnings);
    let (leaks, room) = (room.leaks, room.world);
    let filled = (&room, placed.positions.as_slice(), &laws, &lift);
    let faces = open_faces::check(scene, &opened, walls.as_deref(), filled)?;
    warnings.extend(speeds.into_iter().chain(faces));
    let mut ground = Ground::from_rheologies(&choices.rheologies);
    let (kinematic_viscosities, constant) = kinematic_viscosities(scene, &choices.rheologies);
    let formulation: Arc<dyn Formulation<D>> = choices.formulation.into();
    let shown = shown(scene, &choices.probes);
    let mut parts = choices.parts;
    open_faces::join(scene, opened, &mut parts)?;
    let (free, outlets) = filled_columns(scene, &*formulation, &parts, &placed)?;
    let world = World { free, ..room };
    let planned = PlanInput {
        scene,
        formulation: &*formulation,
        integrator: &*choices.integrator,
        laws: &laws,
        viscosities: &constant,
        soils: &ground.soil,
        walls: walls.as_deref(),
        shown: &shown,
    }
    .plan(&world, &mut parts)?;
    ground.saturated = planned.offer.saturated;
    let diffused = formulation.diffused();
    let given = FlowInputs {
        walls,
        laws,
        kinematic_viscosities,
        swing,
        outlets,
        density: diffused.evolved,
    };
    let mut flow = joined(world, planned, given);
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
    warnings.extend(remarks(scene, &ground, &placed, &mut flow)?);
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
    let mut choices = Choices::<D>::from_scene(scene).map_err(SolverError::Scene)?;
    choices.probes.extend(field_error::probes(scene)?);
    probe_setup::prepare(scene, &mut choices.probes)?;
    Ok(choices)
}

/// Warnings about the places of the particles, which are brought into the box.
fn remarks<const D: usize>(
    scene: &Scene,
    ground: &Ground,
    placed: &PlacedParticles<D>,
    flow: &mut Flow<D>,
) -> Result<Vec<String>, SolverError> {
    flow.know_exits(scene);
    flow.world.wrap()?;
    let mut all = ground.remarks(scene, flow)?;
    all.extend(lattices::remarks(scene, flow, &placed.body)?);
    Ok(all)
}

/// Refuses walls that are faster than sound in the slowest phase.
fn wall_speeds<const D: usize>(
    scene: &Scene,
    drawn: &Drawn<D>,
    laws: &Laws,
) -> Result<Vec<String>, SolverError> {
    let sounds = laws.iter().map(|law| law.reference().sound_speed);
    let slowest = sounds.fold(f64::INFINITY, f64::min);
    let found = speeds(scene, &drawn.walls, slowest, extent(&drawn.regions));
    SolverError::refuse(found.refused).map(|()| found.remarks)
}

/// Input of a plan, before there is one.
struct PlanInput<'a, const D: usize> {
    scene: &'a Scene,
    formulation: &'a dyn Formulation<D>,
    integrator: &'a dyn Integrator,
    laws: &'a Laws,
    viscosities: &'a [Option<f64>],
    soils: &'a [bool],
    walls: Option<&'a dyn Wall<D>>,
    shown: &'a [String],
}

/// True if a wall moves or slides.
pub fn moves(wall: &sph_scene::Wall) -> bool {
    wall.motion.is_some() || wall.velocity.is_some() || !wall.mover.is_empty()
}

impl<const D: usize> PlanInput<'_, D> {
    fn plan(&self, world: &World<D>, parts: &mut [Part<D>]) -> Result<StagePlan<D>, SolverError> {
        let phases: Vec<String> = self.scene.phase.keys().cloned().collect();
        let bodies: Vec<String> = self.scene.body.keys().cloned().collect();
        let diffused = self.formulation.diffused();
        let coefficients = self.integrator.coefficients();
        let moving = self.scene.wall.iter().find(|(_, wall)| moves(wall));
        let setting = Setting {
            laws: self.laws,
            phases: &phases,
            bodies: &bodies,
            viscosities: self.viscosities,
            soils: self.soils,
            density: diffused.evolved,
            summed: self.formulation.compressed().is_none(),
            pressure_ahead: self.scene.choice("pressure").is_some(),
            courant: coefficients.courant,
            viscous: coefficients.viscous,
            kicks_once: self.integrator.kicks_once(),
            delayed_yield: self.scene.numerics.delayed_yield,
            carried: movers::carried(self.scene),
            moving_wall: moving.map(|(name, _)| name.as_str()),
            world,
        };
        let planning = Planning {
            scene: self.scene,
            setting: &setting,
            walls: self.walls,
            diffused,
            shown: self.shown,
        };
        let mut planned = planning.plan(parts)?;
        planned.offer.limiter(ForceLimit {
            coefficient: coefficients.force,
        });
        let mut walls = self.scene.wall.values();
        if walls.any(|w| w.motion.is_some() || !w.mover.is_empty()) {
            planned.offer.limiter(MotionLimit { share: WAY });
        }
        Ok(planned)
    }
}

/// The columns that carry history.
fn state<const D: usize>(
    scene: &Scene,
    formulation: &dyn Formulation<D>,
    parts: &[Part<D>],
    particles: usize,
) -> Result<Store<D>, SolverError> {
    let mut free = Store::new(particles);
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
        free.add_any(column.field, Role::State);
    }
    Ok(free)
}

/// The columns that carry history, with places, identities and phases in them, and where particles leave.
fn filled_columns<const D: usize>(
    scene: &Scene,
    formulation: &dyn Formulation<D>,
    parts: &[Part<D>],
    placed: &PlacedParticles<D>,
) -> Result<(Store<D>, Outlets), SolverError> {
    let mut free = state(scene, formulation, parts, placed.positions.len())?;
    let outlets = Outlets::from_scene(scene, (&placed.positions, &placed.body), &mut free)
        .map_err(SolverError::Scene)?;
    give_places(scene, &mut free, placed)?;
    Ok((free, outlets))
}

/// Gives particles their places, identities and phases.
fn give_places<const D: usize>(
    scene: &Scene,
    free: &mut Store<D>,
    placed: &PlacedParticles<D>,
) -> Result<(), SolverError> {
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
    Ok(())
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
    let head_of = |swing| variable_gravity::head(swing, scene, &drawn.regions);
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
fn kinematic_viscosities(
    scene: &Scene,
    laws: &[Box<dyn Rheology>],
) -> (Vec<f64>, Vec<Option<f64>>) {
    let laws = scene.phase.values().map(|p| p.density).zip(laws);
    let over = laws.map(|(density, law)| {
        let uniform = law.uniform_viscosity().map(|eta| eta / density);
        (law.largest_viscosity() / density, uniform)
    });
    over.unzip()
}
