//! The system of a scene, grains alone or in a fluid, the reference of its measurements, and its checkpoint.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use serde::{Deserialize, Serialize};
use sph_run::RunCounters;

use crate::coupled::{CoupledError, CoupledSystem, Terzaghi};
use crate::flow::Conductance;
use crate::grains::{ContactLaw, Control, GrainSystem, Vector};
use crate::scene::{Failure, Piston, Scene};
use crate::triangulation::{Cell, Sphere, Triangulation, Vertex};

/// Share of its radius that a grain may go in a step: a tenth of it is the overlap that a start may have.
const MOTION_SHARE: f64 = 0.1;

/// Grains alone, or in a fluid.
pub enum Model {
    /// Dry.
    Dry(Box<GrainSystem>),
    /// Coupled to the flow in the pores.
    Wet(Box<CoupledSystem>),
}

/// State of a run in a checkpoint.
#[derive(Debug, Deserialize, Serialize)]
pub enum Saved {
    /// Dry.
    Dry(Box<crate::grains::State>),
    /// Coupled.
    Wet(Box<crate::coupled::State>),
}

impl Model {
    /// The grains.
    pub fn grains(&self) -> &GrainSystem {
        match self {
            Self::Dry(system) => system,
            Self::Wet(system) => system.grains(),
        }
    }

    /// The coupled system, if there is a fluid.
    pub fn wet(&self) -> Option<&CoupledSystem> {
        match self {
            Self::Dry(_) => None,
            Self::Wet(system) => Some(system),
        }
    }

    /// Sets the loads of the time that is now: numbers of walls and their pistons.
    pub fn apply<'a>(&mut self, loads: impl Iterator<Item = (usize, &'a Piston)>) {
        for (wall, piston) in loads {
            let grains = match self {
                Self::Dry(system) => system,
                Self::Wet(system) => system.grains_mut(),
            };
            let stress = piston.stress_at(grains.time);
            if let Some(wall) = grains.walls.get_mut(wall)
                && let Control::Piston { mass, .. } = wall.control
            {
                wall.control = Control::Piston { stress, mass };
            }
        }
    }

    /// One step of a share `safety` of the largest stable one, but not beyond `end` (s); returns its length, s, and limiter.
    ///
    /// # Errors
    /// The failure, with the grain, the wall or the cell.
    pub fn advance(&mut self, safety: f64, end: f64) -> Result<(f64, &'static str), Box<Failure>> {
        let made = self.try_advance(safety, end);
        made.map_err(|error| Box::new(self.failure(error)))
    }

    fn try_advance(&mut self, safety: f64, end: f64) -> Result<(f64, &'static str), CoupledError> {
        let left = (end - self.grains().time).max(0.0);
        let (stable, of) = match self {
            Self::Dry(system) => (system.current_limit(), "contacts"),
            Self::Wet(system) => {
                let limit = system.step_limit()?;
                let elastic = limit.elastic < limit.viscous;
                (limit.step, if elastic { "contacts" } else { "drag" })
            }
        };
        let stable = safety * stable;
        let motion = self.grains().motion_limit(MOTION_SHARE);
        let mut step = stable.min(motion);
        if left < step {
            // The last step is shortened, but not to nothing.
            step = left.max(1e-3 * step);
        }
        match self {
            Self::Dry(system) => system.step(step)?,
            Self::Wet(system) => system.step_unchecked(step)?,
        }
        let limiter = if motion < stable { "motion" } else { of };
        Ok((step, limiter))
    }

    fn failure(&self, error: CoupledError) -> Failure {
        let grains = self.grains();
        let grain = error.grain();
        let position = grain.and_then(|k| grains.grains.position.get(k));
        Failure {
            time: grains.time,
            step: grains.steps,
            position: position.map(|x| [x.x, x.y, x.z]),
            grain,
            error,
            named: String::new(),
        }
    }

    /// State to go on bit for bit.
    pub fn save(&self) -> Saved {
        match self {
            Self::Dry(system) => Saved::Dry(Box::new(system.save())),
            Self::Wet(system) => Saved::Wet(Box::new(system.save())),
        }
    }

    /// Goes on from a saved state, with the laws of the scene.
    ///
    /// # Errors
    /// A state whose parts do not fit together.
    pub fn resume(
        saved: Saved,
        laws: Vec<Box<dyn ContactLaw>>,
        throats: Box<dyn Conductance>,
    ) -> Result<Self, CoupledError> {
        Ok(match saved {
            Saved::Dry(state) => Self::Dry(Box::new(GrainSystem::resume(*state, laws)?)),
            Saved::Wet(state) => {
                let system = CoupledSystem::resume(*state, laws, throats)?;
                Self::Wet(Box::new(system))
            }
        })
    }
}

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

/// Progress of a run.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Progress {
    /// Counts of the driver. Their wall-clock time is kept beside the state, which has the same bits in equal runs.
    pub books: RunCounters,
    /// The last step, s.
    pub dt: f64,
    /// Steps by their limits.
    pub limited: BTreeMap<String, u64>,
    /// Wall-clock time of the preparation, s; kept beside the state as well.
    #[serde(skip)]
    pub preparation_seconds: f64,
}

/// The state itself.
#[derive(Debug, Deserialize, Serialize)]
pub struct CheckpointState {
    /// The system.
    pub model: Saved,
    /// Reference values of measurements.
    pub origin: Origin,
    /// Its progress.
    pub progress: Progress,
}
