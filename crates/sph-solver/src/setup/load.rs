//! What one step of a flow has to do, before anybody knows how long it takes.

use serde::Serialize;
use sph_core::StepError;

use crate::Flow;
use crate::step::clocks::{LISTS_NAME, MOTION_NAME, REST_NAME};

/// How much of a piece of work there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Per {
    /// Particles.
    Particle,
    /// Particles times true neighbours.
    Pair,
    /// Particles and wall elements in reach of each other.
    Contact,
}

/// Part of a step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Piece {
    /// Name of the stage, the work or the service.
    pub name: String,
    /// What is counted.
    pub per: Per,
    /// How many.
    pub amount: f64,
}

/// The work of one step.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Load {
    /// Space dimensions.
    pub dimension: usize,
    /// Its parts.
    pub pieces: Vec<Piece>,
}

/// What the wall plugin does, by the names of its stages.
const WALLS: [&str; 2] = ["wall geometry", "wall state"];
/// How the name of the sweep over all terms begins.
pub(crate) const SWEEP: &str = "interactions";

impl Load {
    /// Of a flow as it stands; lists are built anew after `life` steps.
    ///
    /// # Errors
    /// If there is no position column.
    pub(crate) fn of<const D: usize>(flow: &Flow<D>, life: f64) -> Result<Self, StepError> {
        let world = &flow.world;
        let particles = world.free.len() as f64;
        let pairs = particles * world.mean_neighbours()?;
        let contacts = world.walls.contacts.all().count() as f64;
        let mut all = Load {
            dimension: D,
            pieces: Vec::new(),
        };
        all.add(LISTS_NAME, Per::Pair, pairs / life.max(1.0));
        all.add(MOTION_NAME, Per::Particle, particles);
        all.add(REST_NAME, Per::Particle, particles);
        for stage in &flow.stages {
            let name = stage.name();
            if name.starts_with(SWEEP) {
                all.add(&name, Per::Pair, pairs);
                all.add(SWEEP, Per::Contact, contacts);
            } else if contacts > 0.0 && WALLS.contains(&name.as_str()) {
                all.add(&name, Per::Contact, contacts);
            } else {
                all.add_by(&name, stage.access().sweep, [particles, pairs]);
            }
        }
        for work in &flow.works {
            all.add_by(&work.name(), work.access().sweep, [particles, pairs]);
        }
        Ok(all)
    }

    fn add(&mut self, name: &str, per: Per, amount: f64) {
        let name = name.to_string();
        self.pieces.push(Piece { name, per, amount });
    }

    fn add_by(&mut self, name: &str, sweep: bool, [particles, pairs]: [f64; 2]) {
        match sweep {
            true => self.add(name, Per::Pair, pairs),
            false => self.add(name, Per::Particle, particles),
        }
    }

    /// Particles times neighbours of all sweeps: a measure of a step that knows no machine.
    pub fn pairs(&self) -> f64 {
        let pairs = self.pieces.iter().filter(|p| p.per == Per::Pair);
        pairs.map(|p| p.amount).sum()
    }
}
