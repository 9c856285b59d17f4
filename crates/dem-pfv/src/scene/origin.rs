//! The reference of measurements: the state at the start of the run.

use serde::{Deserialize, Serialize};

use crate::grains::GrainSystem;
use crate::scene::highest_point::highest;
use crate::scene::tables::Scene;

/// The state at the start of the run, and the measurements before it.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Origin {
    /// Lengths of the box, m, if it is closed.
    pub lengths: Option<[f64; 3]>,
    /// Centres, m.
    pub positions: Vec<[f64; 3]>,
    /// Highest point of a grain, m.
    pub top: f64,
    /// Mean diameter d₅₀, m.
    pub diameter: f64,
    /// Load of the oedometer, Pa.
    pub load: Option<f64>,
    /// Strain under that load, dry and slow.
    pub dry_strain: Option<f64>,
    /// Mobility K = κ/µ along z, m²/(Pa s).
    pub mobility: Option<f64>,
}

impl Origin {
    /// Of grains that are ready.
    pub fn new(scene: &Scene, grains: &GrainSystem) -> Self {
        let all = &grains.grains;
        let test = scene.oedometer.as_ref();
        let piston = test.and_then(|t| scene.wall.get(&t.wall)?.piston.as_ref());
        Self {
            lengths: grains.box_lengths(),
            positions: all.position.iter().map(|x| [x.x, x.y, x.z]).collect(),
            top: highest(grains),
            diameter: 2.0 * all.radius.iter().sum::<f64>() / all.len() as f64,
            load: piston.map(|p| p.stress - p.prepared.unwrap_or(p.stress)),
            dry_strain: None,
            mobility: None,
        }
    }

    /// C_v = K Δσ / ε, m²/s.
    pub fn consolidation(&self) -> Option<f64> {
        Some(self.mobility? * self.load? / self.dry_strain?)
    }
}
