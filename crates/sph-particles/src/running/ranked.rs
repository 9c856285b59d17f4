//! A run on several ranks: the first gathers all results, and writes them.

use std::sync::Arc;

use sph_boundary::Wall;
use sph_core::{StepError, System};
use sph_neighbours::decomposition::{PartError, Transport};
use sph_neighbours::{Nearby, WallSet};
use sph_run::{RunOptions, Start};
use sph_scene::Scene;

use crate::failure::error::{Result, RunError};
use crate::results::summary::RankShare;
use crate::running::checkpoint::begin;
use crate::running::counters::Counters;
use crate::running::course::Running;
use crate::running::output::shows_depths;
use crate::setup::{Assembled, Memory, Probes, Share, assembled};

/// The part that a process assembles: on ranks only where particles settle first does each hold the whole for a while.
pub fn share<const D: usize>(
    scene: &Scene,
    options: &RunOptions,
    ranks: Option<&Arc<dyn Transport>>,
) -> Share<D> {
    match (ranks, &options.start) {
        (None, _) => Share::Whole,
        (Some(_), Start::Afresh) if scene.numerics.relax.is_some() => Share::Whole,
        (Some(ranks), Start::Afresh) => Share::Part(ranks.clone()),
        (Some(_), _) => Share::Blank,
    }
}

/// Columns for the whole at the first of several ranks, which has a part: among the walls of this, without lists and contacts,
/// but where neighbours are searched in it.
pub fn columns_of_all<const D: usize>(
    scene: &Scene,
    options: &RunOptions,
    parts: &mut Assembled<D>,
    counters: &Counters,
) -> Result<Assembled<D>> {
    if shows_depths(scene) || looks_around(&parts.probes) {
        let mut all = assembled::<D>(scene, Share::Blank)?;
        begin(scene, options, &mut all.flow, &mut ())?;
        return Ok(all);
    }
    let standing = parts.flow.walls.take().map(|walls| {
        let set = &parts.flow.world.walls;
        let set = WallSet {
            names: set.names.clone(),
            points: set.points.clone(),
            elements: set.elements.clone(),
            scales: set.scales,
            beds: set.beds.clone(),
            ..WallSet::default()
        };
        Box::new((walls, set))
    });
    let mut all = assembled::<D>(scene, Share::Columns(standing))?;
    parts.flow.walls = all.flow.walls.take();
    all.flow.laws = parts.flow.laws.clone();
    all.flow.recount(&counters.left);
    Ok(all)
}

/// True if a probe needs lists and contacts.
pub fn looks_around<const D: usize>(probes: &Probes<D>) -> bool {
    probes.iter().any(|(_, p)| p.needs().around)
}

impl<const D: usize> Running<'_, D> {
    /// The particles that are shown and measured: the whole flow, where this process has it.
    pub fn shown(&self) -> &Assembled<D> {
        self.whole.as_ref().unwrap_or(&self.parts)
    }

    /// The walls of outputs: its own, or those of this process's part.
    pub fn walls(&self) -> Option<&dyn Wall<D>> {
        let own = self.shown().flow.walls.as_deref();
        own.or(self.parts.flow.walls.as_deref())
    }

    /// Brings the whole flow to the state of all ranks; with all that is derived from it, if it is to be `evaluated`. Every rank
    /// must call it. Nothing where one process runs all.
    pub fn gather(&mut self, evaluated: bool) -> Result<()> {
        if self.known.gathered.is_some_and(|done| done || !evaluated) {
            return Ok(());
        }
        self.known.gathered = Some(evaluated);
        let flow = &mut self.parts.flow;
        let Some(parts) = &mut flow.parts else {
            return Ok(());
        };
        parts.link.any(false, false).map_err(StepError::from)?;
        let whole = self.whole.as_mut().map(|w| &mut w.flow);
        let Some(whole) = whole else {
            return Ok(parts.gather(&flow.world, None).map_err(StepError::from)?);
        };
        // Only an evaluated state has neighbours.
        whole.world.forget_lists();
        let gathered = parts.gather(&flow.world, Some(&mut whole.world));
        gathered.map_err(StepError::from)?;
        if let (Some(own), Some(all)) = (&flow.walls, &mut whole.walls) {
            let states = own.states();
            let (set, time) = (&mut whole.world.walls, flow.world.time);
            let moved = all.put_back(set, &states, time);
            moved.map_err(|e| RunError::at("wall", e.to_string()))?;
        }
        whole.world.walls.follow(&flow.world.walls);
        whole.loads.clone_from(&flow.loads);
        let (own, all) = (&flow.world.free, &mut whole.world.free);
        all.removed.clone_from(&own.removed);
        all.inserted = own.inserted;
        whole.world.lists.builds = flow.world.lists.builds;
        whole.restored = true;
        if evaluated {
            let world = &mut whole.world;
            let reference = world.lists.reference.clone();
            let points = world.lists.reference_points.clone();
            let (time, builds) = (world.lists.time, world.lists.builds);
            world.forget_pruned();
            world.build_lists_from(reference, points, time);
            whole.evaluate()?;
            whole.world.lists.builds = builds;
        }
        Ok(())
    }

    /// Counts the neighbours of the particles of this process.
    pub fn look_around(&mut self) -> Result<()> {
        let flow = &self.parts.flow;
        let free = &flow.world.free;
        if flow.world.lists.free.len() != free.len() {
            return Ok(());
        }
        let owned = flow.world.owned();
        self.around = flow.world.nearby(|k| owned.has(k))?;
        Ok(())
    }

    /// Gives the walls of the whole flow the pressures that the ranks found; every rank must call it.
    pub fn gather_walls(&mut self) -> Result<()> {
        let flow = &self.parts.flow;
        let Some(parts) = &flow.parts else {
            return Ok(());
        };
        let whole = self.whole.as_mut().map(|w| &mut w.flow.world);
        let gathered = parts.gather_walls(&flow.world, whole);
        Ok(gathered.map_err(StepError::from)?)
    }

    /// Gives the first rank the results of each; every rank must call it.
    pub fn share(&mut self) -> Result<()> {
        let steps = self.counters.steps.max(1) as f64;
        let flow = &self.parts.flow;
        let Some(parts) = &flow.parts else {
            return Ok(());
        };
        let near = self.around;
        let solved: usize = self.counters.stage_bytes.iter().sum();
        let (ghosts, traffic) = (parts.ghosts(), parts.traffic());
        let own = [
            (flow.world.free.len() - ghosts) as f64,
            ghosts as f64,
            traffic.messages as f64 / steps,
            traffic.bytes as f64 / steps,
            traffic.moved as f64,
            Memory::estimate(self.scene, flow, solved as f64)?.total(),
            near.particles as f64,
            near.neighbours as f64,
            near.accompanied as f64,
            near.least,
            near.distances,
        ];
        let own = own.map(f64::to_le_bytes).concat();
        let all = parts.link.transport.gather(own);
        let all = all.map_err(|e| StepError::from(PartError::from(e)))?;
        let read = |message: &Vec<u8>| {
            let numbers = message.as_chunks::<8>().0.iter();
            let mut numbers = numbers.map(|bytes| f64::from_le_bytes(*bytes));
            let mut next = || numbers.next().unwrap_or(0.0);
            let share = RankShare {
                particles: next() as u64,
                ghosts: next() as u64,
                messages_per_step: next(),
                bytes_per_step: next(),
                moved: next() as u64,
                memory_bytes: next(),
            };
            let near = Nearby {
                particles: next() as u64,
                neighbours: next() as u64,
                accompanied: next() as u64,
                least: next(),
                distances: next(),
            };
            (share, near)
        };
        let (shares, near): (Vec<_>, Vec<_>) = all.iter().map(read).unzip();
        self.shares = shares;
        self.around = near.into_iter().fold(Nearby::NONE, Nearby::joined);
        Ok(())
    }

    /// A cause to end the run that any rank has, which all must call.
    pub fn agreed(&mut self, own: Option<StepError>) -> Option<StepError> {
        let Some(parts) = &mut self.parts.flow.parts else {
            return own;
        };
        match parts.link.confirm(own.is_some()) {
            Ok(()) => None,
            Err(elsewhere) => Some(own.unwrap_or_else(|| elsewhere.into())),
        }
    }

    /// Informs the other ranks of a failure; returns the cause of the first rank that has one.
    pub fn known_to_all(&mut self, cause: StepError) -> StepError {
        match &mut self.parts.flow.parts {
            None => cause,
            Some(parts) => parts.link.share_failure(cause),
        }
    }
}
