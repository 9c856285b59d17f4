//! The numbers that follow from a scene, without running it.

use std::collections::BTreeMap;

use serde::Serialize;
use sph_core::{AnyField, Declares, Role, StepLimit, System, fields};
use sph_scene::Scene;
use sph_solver::{Flow, PluginInForce, SolverError};

use crate::setup::assemble::Assembled;
use crate::setup::dimensions::assemble;
use crate::setup::domain::box_around;
use crate::setup::estimate::{bytes, short_steps};
use crate::setup::probe_setup::rehearse;
use crate::setup::reference_table::readable;
use crate::setup::{Estimate, Memory, Relaxation};
use crate::zones::ZoneSize;

/// A column with its cost.
#[derive(Clone, Debug, Serialize)]
pub struct FieldUse {
    /// Name.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// True if it carries history.
    pub state: bool,
    /// Bytes per particle.
    pub bytes: usize,
    /// Stages that write it.
    pub written_by: Vec<String>,
    /// Stages that read it.
    pub read_by: Vec<String>,
}

/// A planned stage.
#[derive(Clone, Debug, Serialize)]
pub struct StageUse {
    /// Name.
    pub name: String,
    /// True if it walks over neighbours.
    pub sweep: bool,
    /// Columns read at the particle.
    pub reads_here: Vec<String>,
    /// Columns read at neighbours.
    pub reads_at_neighbours: Vec<String>,
    /// Columns written.
    pub writes: Vec<String>,
}

impl StageUse {
    fn new(stage: &impl Declares) -> Self {
        let access = stage.access();
        let names = |fields: &[AnyField]| fields.iter().map(|f| f.name.to_string()).collect();
        StageUse {
            name: stage.name(),
            sweep: access.sweep,
            reads_here: names(&access.here),
            reads_at_neighbours: names(&access.neighbours),
            writes: names(&access.writes),
        }
    }
}

/// Derived numbers, plan, limits and cost of a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Examination {
    /// Title of the scene.
    pub scene: String,
    /// Space dimensions.
    pub dimension: usize,
    /// Numbers by name with their unit: h, c₀, Reynolds and kin.
    pub derived: Vec<(String, f64, String)>,
    /// Largest stable steps at the start, s.
    pub step_limits: BTreeMap<String, f64>,
    /// Formulas of the limits.
    pub limit_formulas: Vec<String>,
    /// Plugins with their parameters.
    pub plugins: Vec<PluginInForce>,
    /// Columns.
    pub fields: Vec<FieldUse>,
    /// Bytes per particle over all columns.
    pub bytes_per_particle: usize,
    /// Stages in order.
    pub stages: Vec<StageUse>,
    /// Stages that were offered and not needed.
    pub pruned: Vec<String>,
    /// Free particles, those of zones apart.
    pub particles: usize,
    /// Zones of finer particles.
    pub zones: Vec<ZoneSize>,
    /// Wall points.
    pub wall_points: usize,
    /// Wall elements.
    pub wall_elements: usize,
    /// Mean number of true neighbours.
    pub neighbours: f64,
    /// Its expected cost.
    pub estimate: Estimate,
    /// Pairs in the sweeps of all steps: a measure of a run without a machine.
    pub pairs: f64,
    /// Its memory by use.
    pub memory: Memory,
    /// The relaxation of the first particles, if the scene has one.
    pub relaxation: Option<Relaxation>,
    /// Remarks.
    pub warnings: Vec<String>,
}

/// Assembles a scene and lists sizes, costs and remarks.
///
/// # Errors
/// Every problem of the scene, with its path.
pub fn examine(scene: &Scene) -> Result<Examination, SolverError> {
    Ok(match scene.dimension {
        3 => examine_in::<3>(scene)?.0,
        _ => examine_in::<2>(scene)?.0,
    })
}

/// As [`examine`] of a scene in `D` dimensions, with its assembly.
pub fn examine_in<const D: usize>(
    scene: &Scene,
) -> Result<(Examination, Assembled<D>), SolverError> {
    let mut assembled = assemble::<D>(scene)?;
    rehearse(scene, &mut assembled.flow, &assembled.probes)?;
    readable(scene)?;
    let limits = assembled.flow.step_limits()?;
    let remedies = assembled.flow.remedies_of_bounds()?;
    let short = short_steps(scene, &limits, &remedies)?;
    assembled.warnings.extend(short);
    let dt = StepLimit::least(&limits).map_or(scene.run.end, |l| l.dt) * scene.run.safety;
    let memory = memory(scene, &mut assembled.flow, dt)?;
    let flow = &assembled.flow;
    let world = &flow.world;
    let stages: Vec<StageUse> = flow.stages.iter().map(StageUse::new).collect();
    let users = |uses: &dyn Fn(&StageUse) -> bool| -> Vec<String> {
        let using = stages.iter().filter(|stage| uses(stage));
        using.map(|s| s.name.clone()).collect()
    };
    let columns = world.free.columns();
    let fields = columns.map(|(name, unit, role, components, values)| {
        let among = |columns: &[String]| columns.iter().any(|column| column == name);
        FieldUse {
            name: name.into(),
            unit: unit.into(),
            state: role == Role::State,
            bytes: bytes(components, &values),
            written_by: users(&|s| among(&s.writes)),
            read_by: users(&|s| among(&s.reads_here) || among(&s.reads_at_neighbours)),
        }
    });
    let particles = world.free.len();
    let neighbours = world.mean_neighbours()?;
    let estimate = Estimate::new(scene, particles as f64, dt, memory.total());
    let sweeps = stages.iter().filter(|s| s.sweep).count() as f64;
    let examined = Examination {
        scene: scene.title.clone(),
        dimension: D,
        derived: derived::<D>(scene, flow, assembled.height),
        step_limits: limits.iter().map(|l| (l.name.to_string(), l.dt)).collect(),
        limit_formulas: (flow.limiters.iter().map(|l| l.formula()))
            .chain(flow.inner_bounds.iter().cloned())
            .collect(),
        plugins: std::mem::take(&mut assembled.plugins),
        fields: fields.collect(),
        bytes_per_particle: world.free.bytes_per_particle(),
        pruned: flow.pruned.clone(),
        particles,
        zones: Vec::new(),
        wall_points: world.walls.points.position.len(),
        wall_elements: world.walls.elements.centre.len(),
        pairs: estimate.steps * sweeps * particles as f64 * neighbours,
        neighbours,
        estimate,
        memory,
        relaxation: assembled.relaxation.take(),
        warnings: std::mem::take(&mut assembled.warnings),
        stages,
    };
    Ok((examined, assembled))
}

/// Memory of a run: the forces are evaluated once, and the first matrix is put together.
fn memory<const D: usize>(
    scene: &Scene,
    flow: &mut Flow<D>,
    dt: f64,
) -> Result<Memory, SolverError> {
    // Where the state is one that the run will refuse, the parts that need no state count.
    let evaluated = flow.evaluate().is_ok();
    let mut system = 0;
    for hooked in flow.hooks.all.iter().filter(|_| evaluated) {
        system += hooked.hook.bytes(&mut flow.world, dt)?;
    }
    system += flow.stages.iter().map(|stage| stage.bytes()).sum::<usize>();
    Ok(Memory::estimate(scene, flow, system as f64)?)
}

/// Smoothing length, speeds and dimensionless numbers.
fn derived<const D: usize>(
    scene: &Scene,
    flow: &Flow<D>,
    length: f64,
) -> Vec<(String, f64, String)> {
    let world = &flow.world;
    let mut all = Vec::new();
    let mut say = |name: String, value: f64, unit: &str| {
        if value.is_finite() {
            all.push((name, value, unit.to_string()));
        }
    };
    let kernel = &world.kernel;
    say("smoothing length h".into(), kernel.smoothing_length(), "m");
    say("kernel support".into(), kernel.support_radius(), "m");
    let g = world.gravity.norm();
    let fall = (g * length).sqrt();
    if g > 0.0 {
        say("depth H".into(), length, "m");
        say("gravity wave speed √(gH)".into(), fall, "m/s");
    }
    let numbers = world.free.get(fields::PHASE).ok();
    let fastest = |k: usize| {
        let velocity = world.free.get(fields::VELOCITY).into_iter().flatten();
        let is_own = |i: usize| numbers.is_none_or(|n| n[i] as usize == k);
        let own = velocity.enumerate().filter(|(i, _)| is_own(*i));
        own.map(|(_, u)| u.norm()).fold(0.0, f64::max)
    };
    let extent = || {
        let [low, high] = box_around(world.free.get(fields::POSITION).into_iter().flatten());
        (high - low).max().max(0.0)
    };
    let viscosities = flow.kinematic_viscosities.iter();
    let phases = scene.phase.iter().zip(flow.laws.iter().zip(viscosities));
    for (k, ((name, phase), (law, nu))) in phases.enumerate() {
        let c0 = law.reference().sound_speed;
        say(format!("{name}: speed of sound c₀"), c0, "m/s");
        say(format!("{name}: kinematic viscosity ν"), *nu, "m²/s");
        let speed = phase.velocity_scale.unwrap_or(fall).max(fastest(k));
        if speed > 0.0 {
            say(format!("{name}: expected speed U"), speed, "m/s");
            say(format!("{name}: Mach number U/c₀"), speed / c0, "1");
            let scale = if length > 0.0 { length } else { extent() };
            let reynolds = speed * scale / nu;
            say(format!("{name}: Reynolds number UL/ν"), reynolds, "1");
            if fall > 0.0 {
                say(format!("{name}: Froude number U/√(gH)"), speed / fall, "1");
            }
        }
    }
    all
}
