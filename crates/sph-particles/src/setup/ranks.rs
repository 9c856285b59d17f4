//! Messages of a scene on several machines.

use serde::Serialize;
use sph_core::{Access, Declares, System, fields};
use sph_neighbours::decomposition::{bisect, ghosts_by_owner};
use sph_scene::Scene;
use sph_solver::step::costs;
use sph_solver::{Flow, SolverError};

use crate::setup::dimensions::assemble;

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
    let ghosts = ghosts_by_owner(world, &owners, ranks, flow.rings())?;
    let (mut particles, mut cost) = (vec![0; ranks], vec![0.0; ranks]);
    for (owner, c) in owners.iter().zip(&costs) {
        particles[*owner as usize] += 1;
        cost[*owner as usize] += c;
    }
    let mean = (costs.iter().sum::<f64>() / ranks as f64).max(f64::MIN_POSITIVE);
    // Ghosts get the columns that a stage has summed over neighbours; they compute all others themselves.
    let mut exchanges = Vec::new();
    for stage in &flow.stages {
        let Access { sweep, writes, .. } = stage.access();
        let bytes = world.free.parcel_bytes(|f| writes.contains(f));
        if sweep && bytes > 0 {
            let columns = writes.iter().filter(|f| world.free.has(f.name));
            exchanges.push(ExchangeUse {
                stage: stage.name(),
                columns: columns.map(|f| f.name.to_string()).collect(),
                bytes,
            });
        }
    }
    let largest = cost.iter().copied().fold(0.0, f64::max);
    let one = |rank: usize| RankUse {
        particles: particles[rank],
        cost: cost[rank] / mean,
        ghosts: ghosts[rank].values().sum(),
        sent: ghosts.iter().filter_map(|of| of.get(&(rank as u32))).sum(),
        partners: ghosts[rank].keys().map(|from| *from as usize).collect(),
    };
    Ok(Ranks {
        ranks: (0..ranks).map(one).collect(),
        imbalance: largest / mean - 1.0,
        bytes_per_ghost: exchanges.iter().map(|e| e.bytes).sum(),
        bytes_per_newcomer: world.free.bytes_per_particle(),
        exchanges,
    })
}
