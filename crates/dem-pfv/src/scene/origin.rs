//! The reference of measurements: the state at the start of the run.

use std::sync::OnceLock;

use serde::{Deserialize, Serialize};

use crate::coupled::Terzaghi;
use crate::grains::{GrainSystem, Vector};
use crate::scene::Scene;
use crate::triangulation::{Cell, Sphere, Triangulation, Vertex};

/// The state at the start of the run, and the measurements before it.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Origin {
    /// Lengths of the box, m, if it is closed.
    pub lengths: Option<[f64; 3]>,
    /// Centres, m.
    pub positions: Vec<Vector>,
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
    /// Tetrahedra of four grains, once asked for.
    #[serde(skip)]
    tetrahedra: OnceLock<Vec<[usize; 4]>>,
}

impl Origin {
    /// Of grains that are ready.
    pub fn new(scene: &Scene, grains: &GrainSystem) -> Self {
        let all = &grains.grains;
        let test = scene.oedometer.as_ref();
        let piston = test.and_then(|t| scene.wall.get(&t.wall)?.piston.as_ref());
        Self {
            lengths: grains.box_lengths(),
            positions: all.position.clone(),
            top: grains.highest(),
            diameter: 2.0 * all.mean_radius(),
            load: piston.map(|p| p.stress - p.prepared.unwrap_or(p.stress)),
            ..Self::default()
        }
    }

    /// Tetrahedra of grains with these radii (m) in their regular triangulation at the start; empty without a triangulation.
    pub fn tetrahedra(&self, radii: &[f64]) -> &[[usize; 4]] {
        self.tetrahedra.get_or_init(|| {
            let spheres = self.positions.iter().zip(radii);
            let spheres: Vec<_> = spheres.map(|(x, r)| Sphere::new((*x).into(), *r)).collect();
            let cells = Triangulation::of_spheres(&spheres).map(|mesh| mesh.cells);
            let corners = |cell: &Cell| {
                let [a, b, c, d] = cell.vertices().map(Vertex::sphere);
                Some([a?, b?, c?, d?])
            };
            let cells = cells.unwrap_or_default();
            cells.iter().filter_map(corners).collect()
        })
    }

    /// C_v = K Δσ / ε, m²/s.
    pub fn consolidation(&self) -> Option<f64> {
        Some(self.mobility? * self.load? / self.dry_strain?)
    }

    /// Consolidation from this state, drained at top and bottom; not a number without an oedometer.
    pub fn terzaghi(&self) -> Terzaghi {
        Terzaghi {
            coefficient: self.consolidation().unwrap_or(f64::NAN),
            drainage: self.lengths.map_or(f64::NAN, |l| 0.5 * l[2]),
        }
    }
}
