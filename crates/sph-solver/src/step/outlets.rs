//! Outlets of the flow, and particles that leave it.

use serde::{Deserialize, Serialize};
use sph_core::{Removed, SceneProblem, Store, Vect};
use sph_scene::{Outlet, Scene};

use crate::error::SolverError;

/// The outlets of a scene.
pub struct Outlets {
    pub(crate) all: Vec<Outlet>,
    /// `outlet.NAME.PHASE`, then `open.NAME.PHASE` of open faces, then `domain.PHASE`, in the order of the counts of
    /// removed particles.
    pub(crate) labels: Vec<String>,
    /// Labels that the scene named.
    pub(crate) named: usize,
    /// Number of the exit by which water that went over a free end of a wall leaves the domain, if there may be any.
    pub(crate) border: Option<usize>,
}

/// Mass and particles of a phase that left by an outlet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OutletTotals {
    /// Mass, kg (per metre of depth in 2D).
    pub mass: f64,
    /// Number of particles.
    pub particles: u64,
}

impl Outlets {
    /// The outlets of a scene; `free` counts the particles that leave by them. Particles start at `places`, each in the
    /// body of a number.
    ///
    /// # Errors
    /// If a body stands in one at the start.
    pub fn from_scene<const D: usize>(
        scene: &Scene,
        (places, bodies): (&[Vect<D>], &[u32]),
        free: &mut Store<D>,
    ) -> Result<Self, SolverError> {
        let mut outlets = Outlets {
            all: scene.outlet.values().cloned().collect(),
            labels: Vec::new(),
            named: 0,
            border: None,
        };
        let (mut problems, mut taken) = (Vec::new(), Vec::new());
        for (outlet, (name, place)) in scene.outlet.iter().enumerate() {
            taken.extend(outlets.label(&format!("outlet.{name}"), outlet, scene));
            let mut starts = places.iter().zip(bodies);
            let inside = starts.find(|(x, _)| place.contains(&(**x).into()));
            if let Some((x, body)) = inside {
                let body = scene.body.keys().nth(*body as usize);
                let message = format!(
                    "the body `{}` stands in the outlet at the start, for instance at {:?}",
                    body.map_or("", String::as_str),
                    <[f64; D]>::from(*x)
                );
                problems.push(SceneProblem::new(format!("outlet.{name}"), message));
            }
        }
        free.removed = taken;
        outlets.named = outlets.labels.len();
        SolverError::refuse(problems)?;
        Ok(outlets)
    }

    /// Adds the labels `NAME.PHASE` of an exit, and gives their counts, which begin.
    pub(crate) fn label(&mut self, name: &str, exit: usize, scene: &Scene) -> Vec<Removed> {
        let labels = scene.phase.keys().map(|of| format!("{name}.{of}"));
        self.labels.extend(labels);
        let count = |phase| Removed {
            outlet: exit as u32,
            phase,
            ..Removed::default()
        };
        (0..scene.phase.len() as u32).map(count).collect()
    }

    /// `outlet.NAME.PHASE` and `open.NAME.PHASE` of everything that the scene lets out.
    pub fn labels(&self) -> &[String] {
        &self.labels[..self.named]
    }

    /// True if there is no outlet.
    pub fn is_empty(&self) -> bool {
        self.labels.is_empty()
    }
}
