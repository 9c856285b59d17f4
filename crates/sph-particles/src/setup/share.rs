//! The share of a flow with which a process begins, and the messages of a scene on several machines.

use std::sync::Arc;

use serde::Serialize;
use sph_boundary::Wall;
use sph_core::{Access, Declares, StepError, System, fields};
use sph_neighbours::WallSet;
use sph_neighbours::decomposition::{Halo, PartError, Transport, bisect};
use sph_scene::Scene;
use sph_solver::step::costs;
use sph_solver::{Flow, SolverError};

use crate::setup::dimensions::assemble;

/// The part of a flow that a process begins with.
pub enum Share<const D: usize> {
    /// All of it.
    Whole,
    /// The part of a rank: lists are built and forces found for this alone.
    Part(Arc<dyn Transport>),
    /// Columns, plugins and walls; places, and no state: for one that comes from elsewhere.
    Blank,
    /// Columns and plugins alone, without a particle, among walls that stand already: for a gathered state.
    Columns(Option<Box<ExistingWalls<D>>>),
}

/// Walls that stand already: the plugin, and the data of pair sums.
pub type ExistingWalls<const D: usize> = (Box<dyn Wall<D>>, WallSet<D>);

/// Refuses scenes that cannot be divided between ranks.
pub fn refuse_the_indivisible<const D: usize>(
    flow: &Flow<D>,
    ranks: usize,
) -> Result<(), SolverError> {
    if let Some(why) = flow.indivisible() {
        return Err(SolverError::at("", why));
    }
    let particles = flow.world.free.len();
    let why = format!("{ranks} ranks for {particles} particles: some would own nothing");
    match ranks > particles {
        true => Err(SolverError::at("", why)),
        false => Ok(()),
    }
}

/// Confirms that all ranks are ready, which all must call.
pub fn all_ready<T, E: From<StepError>>(
    ranks: &dyn Transport,
    ready: Result<T, E>,
) -> Result<T, E> {
    let mut failed = [f64::from(u8::from(ready.is_err()))];
    let told = ranks.largest(&mut failed).map_err(PartError::from);
    let ready = ready?;
    told.map_err(StepError::from)?;
    match failed[0] > 0.0 {
        true => Err(StepError::from(PartError::Elsewhere).into()),
        false => Ok(ready),
    }
}

/// A rank's share.
#[derive(Clone, Debug, Serialize)]
pub struct RankUse {
    /// Particles that it owns.
    pub particles: usize,
    /// Its cost over the mean.
    pub cost: f64,
    /// Particles of others that it needs.
    pub ghosts: usize,
    /// Particles that it sends, each as often as it is sent.
    pub sent: usize,
    /// Ranks that it has ghosts of.
    pub partners: Vec<usize>,
}

/// Columns sent after a stage.
#[derive(Clone, Debug, Serialize)]
pub struct ExchangeUse {
    /// The stage.
    pub stage: String,
    /// Columns.
    pub columns: Vec<String>,
    /// Bytes per ghost.
    pub bytes: usize,
}

/// A decomposition of a scene at its start, and the messages of an evaluation. Solves send besides, in each iteration,
/// a vector.
#[derive(Clone, Debug, Serialize)]
pub struct Ranks {
    /// Each rank.
    pub ranks: Vec<RankUse>,
    /// Largest cost over the mean, less one.
    pub imbalance: f64,
    /// Columns sent after each stage.
    pub exchanges: Vec<ExchangeUse>,
    /// Bytes per ghost in an evaluation.
    pub bytes_per_ghost: usize,
    /// Bytes of a ghost that is new, with all its columns.
    pub bytes_per_newcomer: usize,
}

/// Splits a scene's particles over `ranks` machines.
///
/// # Errors
/// Every problem of the scene; more ranks than particles.
pub fn ranks(scene: &Scene, ranks: usize) -> Result<Ranks, SolverError> {
    match scene.dimension {
        3 => ranks_in(&mut assemble::<3>(scene)?.flow, ranks),
        _ => ranks_in(&mut assemble::<2>(scene)?.flow, ranks),
    }
}

fn ranks_in<const D: usize>(flow: &mut Flow<D>, ranks: usize) -> Result<Ranks, SolverError> {
    flow.evaluate()?;
    let world = &flow.world;
    let places = world.free.get(fields::POSITION)?;
    let costs = costs(world);
    let owners = bisect(places, &costs, ranks).map_err(|e| SolverError::at("", e.to_string()))?;
    let halo = Halo::new(world, &owners, ranks, flow.rings())?;
    let mut cost = vec![0.0; ranks];
    let all = owners.iter().zip(&costs);
    all.for_each(|(owner, c)| cost[*owner as usize] += c);
    let mean = (costs.iter().sum::<f64>() / ranks as f64).max(f64::MIN_POSITIVE);
    let exchanges = sent(flow);
    let largest = cost.iter().copied().fold(0.0, f64::max);
    let one = |rank: usize| RankUse {
        particles: halo.owned(rank),
        cost: cost[rank] / mean,
        ghosts: halo.ghosts(rank),
        sent: halo.sent(rank),
        partners: halo.partners(rank),
    };
    Ok(Ranks {
        ranks: (0..ranks).map(one).collect(),
        imbalance: largest / mean - 1.0,
        bytes_per_ghost: exchanges.iter().map(|e| e.bytes).sum(),
        bytes_per_newcomer: world.free.bytes_per_particle(),
        exchanges,
    })
}

fn sent<const D: usize>(flow: &Flow<D>) -> Vec<ExchangeUse> {
    let free = &flow.world.free;
    let stages = flow
        .stages
        .iter()
        .map(|stage| (stage.name(), stage.access()));
    let sums = stages.filter(|(_, access)| access.sweep);
    let all = sums.map(|(stage, Access { writes, .. })| {
        let columns = writes.iter().filter(|f| free.has(f.name));
        ExchangeUse {
            stage,
            bytes: free.parcel_bytes(|f| writes.contains(f)),
            columns: columns.map(|f| f.name.to_string()).collect(),
        }
    });
    all.filter(|told| told.bytes > 0).collect()
}
