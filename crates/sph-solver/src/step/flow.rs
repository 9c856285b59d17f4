//! A flow in motion: evaluation of all stages, forces, and its report.

mod insertion;
mod kept;
mod snapshot;

pub use insertion::NewParticleDefaults;
pub use snapshot::Snapshot;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde_json::Value as Json;
use sph_boundary::Wall;
use sph_contribution::{
    Forces, Gate, Limiter, OutsideForce, Report, StepHook, StepMoment, StepPhase, StoredEnergy,
};
use sph_core::{
    Access, AnyField, Declares, Evolved, Field, Role, Scalar, StepError, StepLimit, fields,
};
use sph_neighbours::decomposition::Parts;
use sph_neighbours::{Interaction, WallForce, World, wall_forces};
use sph_rheology::state::Laws;

use crate::step::hooks::{Boundary, Columns, Hooked, Hooks, ObservedFlow, Observer};
use crate::step::outlets::Outlets;
use crate::step::stages::{Work, run_and_update_ghosts};
use crate::step::variable_gravity::VariableGravity;
use kept::KeptState;

/// Wall-clock time of one kind of work.
#[derive(Clone, Debug)]
pub struct Timing {
    /// Stage or service.
    pub name: String,
    /// Time spent so far.
    pub spent: Duration,
}

const LISTS: usize = 0;
/// Name of the time spent on neighbour lists.
pub const LISTS_NAME: &str = "neighbour lists";
/// Place of kicks and drifts among the timings; the stages follow, and then the work within a step.
pub(crate) const MOTION: usize = 1;

/// The assembled system of one scene.
pub struct Flow<const D: usize> {
    /// Columns, walls, lists, kernel, clock.
    pub world: World<D>,
    /// Stages in the order of the plan, those of the walls among them.
    pub stages: Vec<Work<D>>,
    /// Names of the stages that were pruned.
    pub pruned: Vec<String>,
    /// Bounds on the step.
    pub limiters: Vec<Box<dyn Limiter<D>>>,
    /// The walls; none without any, and where a flow is shown among those of its part.
    pub walls: Option<Box<dyn Wall<D>>>,
    /// Loads of movers, in the order of the walls' names, from the last kick; empty if none needs them.
    pub loads: Vec<WallForce<D>>,
    /// Forces on some walls, by their numbers, as a flow of finer particles has them in the present state.
    pub finer_loads: Vec<(usize, WallForce<D>)>,
    pub(crate) evolved: Vec<Evolved>,
    /// All scalars that are advanced in time.
    pub(crate) integrated: Vec<Field<Scalar>>,
    /// Bounds on steps within a step, for listings.
    pub inner_bounds: Vec<String>,
    /// Work within a step.
    pub hooks: Hooks<D>,
    /// True if hooks before a drift read density, volume, pressure and γ of the present positions.
    pub(crate) fresh_state: bool,
    /// Forces on walls by hooks in the last kick, in the order of the walls; empty if there are none.
    pub(crate) on_walls: Vec<WallForce<D>>,
    /// Sources and sinks of particles.
    pub gates: Vec<Box<dyn Gate<D>>>,
    /// Energy that particles store.
    pub stored: Vec<Box<dyn StoredEnergy<D>>>,
    pub(crate) outside: Vec<OutsideForce<D>>,
    pub(crate) columns: Columns,
    /// True if particles moved since the last evaluation.
    pub moved: bool,
    /// True if the columns of state are those that the last evaluation before a checkpoint or a snapshot left.
    pub restored: bool,
    pub(crate) kept: KeptState<D>,
    /// Equations of state, in the order of the phase numbers.
    pub laws: Laws,
    /// η/ρ₀ of every phase, m²/s.
    pub kinematic_viscosities: Vec<f64>,
    pub(crate) terms: Arc<[Box<dyn Interaction<D>>]>,
    /// The plugin of every term, by the term's name.
    pub kinds: Vec<(String, &'static str)>,
    /// Remedies where a term of a kind has thrown a particle about, by the kind, or a stage failed, by its name.
    pub remedies: Vec<(&'static str, String)>,
    /// Names of stages and hooks that are cheaper with a looser tolerance of their solver.
    pub solves: Vec<String>,
    /// Time spent per stage and service since the assembly.
    pub timings: Vec<Timing>,
    /// The change of gravity, if there is one.
    pub swing: Option<VariableGravity<D>>,
    /// The outlets.
    pub outlets: Outlets,
    /// Initial values of newborn particles, where some may come in.
    pub nursery: Option<NewParticleDefaults<D>>,
    /// Observers of the boundaries within a step, where a probe needs one.
    pub(crate) observers: Vec<Box<dyn Observer<D>>>,
    /// The part of this process of a flow that is divided between several.
    pub parts: Option<Parts<D>>,
}

impl<const D: usize> Flow<D> {
    /// Smallest step limit with its name; the smallest of all plugins.
    ///
    /// # Errors
    /// If a column is missing, as everywhere below.
    pub fn step_limits(&self) -> Result<Vec<StepLimit>, StepError> {
        let mut limits = Vec::new();
        self.step_limits_into(&mut limits)?;
        Ok(limits)
    }

    /// The same into a buffer.
    pub fn step_limits_into(&self, limits: &mut Vec<StepLimit>) -> Result<(), StepError> {
        limits.clear();
        for limiter in &self.limiters {
            limits.push(limiter.limit(&self.world)?);
        }
        Ok(())
    }

    /// Collects the declared columns; after a change of the parts.
    pub fn ask_all(&mut self) {
        let sweep = self.terms.iter().map(|term| term.access());
        let outside = self.outside.iter().map(|force| force.access());
        self.columns = Columns {
            stages: self.stages.iter().map(|stage| stage.access()).collect(),
            gates: self.gates.iter().map(|gate| gate.access()).collect(),
            forces: sweep.chain(outside).collect(),
        };
    }

    /// True if nothing has been looked for near particles yet.
    pub fn is_blank(&self) -> bool {
        self.world.lists.reference.is_empty() && self.world.lists.builds == 0
    }

    /// Remedy of each bound, by its name, where its plugin has one.
    pub fn remedies_of_bounds(&self) -> Result<BTreeMap<String, String>, StepError> {
        let mut all = BTreeMap::new();
        for limiter in &self.limiters {
            if let Some(remedy) = limiter.remedy() {
                all.insert(limiter.limit(&self.world)?.name.to_string(), remedy);
            }
        }
        Ok(all)
    }

    pub(crate) fn run_hooks(&mut self, phase: StepPhase, dt: f64) -> Result<(), StepError> {
        for n in 0..self.hooks.during(phase).len() {
            let k = self.hooks.during(phase)[n];
            // Before a kick a hook may bind all forces.
            let binds = phase == StepPhase::BeforeKick;
            self.run_hook(k, binds, dt, |hook, moment| hook.run(phase, moment))?;
            self.observe(Boundary::Hooked(phase, k), dt)?;
        }
        Ok(())
    }

    /// Lets the hooks that kick advance the velocities.
    pub(crate) fn run_kicks(&mut self, dt: f64) -> Result<(), StepError> {
        for n in 0..self.hooks.kicking.len() {
            let k = self.hooks.kicking[n];
            self.run_hook(k, false, dt, |hook, moment| match hook.as_kick() {
                Some(kick) => kick.kick(moment.world, dt),
                None => Ok(()),
            })?;
        }
        Ok(())
    }

    /// Lets a hook work, and holds it to the columns that it declared, and to those of all forces where it `binds` them.
    fn run_hook(
        &mut self,
        number: usize,
        binds: bool,
        dt: f64,
        work: impl FnOnce(&mut dyn StepHook<D>, &mut StepMoment<'_, D>) -> Result<(), StepError>,
    ) -> Result<(), StepError> {
        let start = Instant::now();
        let Hooked { hook, access, .. } = &mut self.hooks.all[number];
        let more = if binds { &self.columns.forces[..] } else { &[] };
        self.world.free.watch(more.iter().chain([&*access]));
        let mut moment = StepMoment {
            world: &mut self.world,
            dt,
            forces: Forces {
                sweep: &self.terms,
                outside: &self.outside,
            },
            on_walls: &mut self.on_walls,
        };
        let done = work(&mut **hook, &mut moment);
        self.world.free.unwatch(|| hook.name()).and(done)?;
        self.world.refresh(access)?;
        self.timings[MOTION + 1 + self.stages.len() + number].spent += start.elapsed();
        Ok(())
    }

    pub(crate) fn observe(&mut self, at: Boundary, dt: f64) -> Result<(), StepError> {
        let mut seen = ObservedFlow {
            world: &mut self.world,
            terms: &self.terms,
            dt,
        };
        let mut observers = self.observers.iter_mut();
        observers.try_for_each(|observer| observer.observe(at, &mut seen))
    }

    pub(crate) fn run_stages(&mut self, wanted: impl Fn(&Access) -> bool) -> Result<(), StepError> {
        let restored = self.begin_evaluation()?;
        self.run_wanted(restored, wanted)
    }

    /// Lists and gravity of the present state; true if the columns of state are those that an evaluation left.
    pub(crate) fn begin_evaluation(&mut self) -> Result<bool, StepError> {
        if let Some(swing) = &self.swing {
            let world = &mut self.world;
            world.gravity = world.steady_gravity + swing.at(world.time);
        }
        let start = Instant::now();
        self.refresh_lists()?;
        self.timings[LISTS].spent += start.elapsed();
        self.moved = false;
        Ok(std::mem::take(&mut self.restored))
    }

    /// Runs the stages that are `wanted`; of a state that was `restored` all but those that write state alone.
    pub(crate) fn run_wanted(
        &mut self,
        restored: bool,
        wanted: impl Fn(&Access) -> bool,
    ) -> Result<(), StepError> {
        let state = match restored {
            true => self.state_columns(),
            false => Vec::new(),
        };
        // Stages that only write state have run: a solve would start from its own result.
        let done = |writes: &[AnyField]| {
            let known = |f: &AnyField| state.contains(&f.name);
            restored && !writes.is_empty() && writes.iter().all(known)
        };
        for (k, stage) in self.stages.iter_mut().enumerate() {
            let access = &self.columns.stages[k];
            if !wanted(access) || done(&access.writes) {
                continue;
            }
            let start = Instant::now();
            let walls = self.walls.as_deref_mut().map(|walls| walls as _);
            run_and_update_ghosts(stage, access, self.parts.as_ref(), &mut self.world, walls)?;
            self.timings[MOTION + 1 + k].spent += start.elapsed();
        }
        Ok(())
    }

    /// The terms that push particles, those outside of the sweep included.
    pub fn forces(&self) -> Vec<&dyn Interaction<D>> {
        let terms = self.terms.iter().map(|t| &**t);
        terms.chain(self.outside.iter().map(|f| &**f)).collect()
    }

    /// Measures the forces on the wanted walls at the state of the last evaluation; those on others are NaN.
    pub fn measure_wall_forces(&mut self, wanted: impl Fn(&str) -> bool) -> Result<(), StepError> {
        if !self.world.free.has(fields::ACCELERATION.name) || self.world.lists.builds == 0 {
            return Ok(());
        }
        let wanted: Vec<bool> = self.world.walls.names.iter().map(|n| wanted(n)).collect();
        let mut forces = wall_forces(&self.world, &self.forces(), &wanted)?;
        let walls = forces.iter_mut().zip(&self.on_walls);
        walls.for_each(|(whole, own)| whole.add(own));
        self.world.walls.forces = forces;
        Ok(())
    }

    /// The reports of all hooks, in their order.
    pub fn reports(&self) -> impl Iterator<Item = Report> {
        self.hooks.all.iter().map(|h| h.hook.report(&self.world))
    }

    /// Counts of hooks, by their names.
    pub fn counts(&self) -> BTreeMap<String, Json> {
        let all = self.hooks.all.iter().zip(self.reports());
        all.filter_map(|(h, report)| Some((h.hook.name(), report.counts?)))
            .collect()
    }

    /// Counts of hooks, by the keys of the summary.
    pub fn counts_of_summary(&self) -> BTreeMap<String, Json> {
        let keyed = |report: Report| Some((report.summary?.into(), report.counts?));
        self.reports().filter_map(keyed).collect()
    }

    /// Particles behind one of these walls.
    pub fn escaped_from(&self, walls: Option<&dyn Wall<D>>) -> Result<usize, StepError> {
        let Some(walls) = walls else {
            return Ok(0);
        };
        let position = self.world.free.get(fields::POSITION)?;
        Ok(position.iter().filter(|x| !walls.contains(x)).count())
    }

    /// Least and largest K/ρ₀, if the formulation has a density constant.
    pub fn density_constant_range(&self) -> Option<[f64; 2]> {
        let constant = self.world.free.get(fields::DENSITY_CONSTANT).ok()?;
        let phase = self.world.free.get(fields::PHASE).ok();
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for (i, k) in constant.iter().enumerate() {
            let law = &self.laws[phase.map_or(0, |p| p[i] as usize)];
            let ratio = k / law.reference().density;
            range = [range[0].min(ratio), range[1].max(ratio)];
        }
        (!constant.is_empty()).then_some(range)
    }

    /// Names of the columns that carry history, in order of allocation.
    pub fn state_columns(&self) -> Vec<&'static str> {
        let columns = self.world.free.columns();
        let state = columns.filter(|(_, _, role, ..)| *role == Role::State);
        state.map(|(name, ..)| name).collect()
    }

    /// Starts all timings anew; after a change of the works.
    pub fn reset_timings(&mut self) {
        let services = [LISTS_NAME, "kick and drift"].map(String::from);
        let stages = self.stages.iter().map(|s| s.name());
        let hooks = self.hooks.all.iter().map(|h| h.hook.name());
        let names = services.into_iter().chain(stages).chain(hooks);
        let spent = Duration::ZERO;
        self.timings = names.map(|name| Timing { name, spent }).collect();
    }
}
