//! Outlets of the flow.

use serde::{Deserialize, Serialize};
use sph_core::{Removed, SceneProblem, Store, Vect};
use sph_scene::{Outlet, Scene};

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
    ) -> Result<Self, Vec<SceneProblem>> {
        let mut problems = Vec::new();
        let (mut labels, mut taken) = (Vec::new(), Vec::new());
        for (outlet, (name, place)) in scene.outlet.iter().enumerate() {
            for (phase, of) in scene.phase.keys().enumerate() {
                labels.push(format!("outlet.{name}.{of}"));
                taken.push(Removed {
                    outlet: outlet as u32,
                    phase: phase as u32,
                    ..Removed::default()
                });
            }
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
        free.set_removed(taken);
        match problems.is_empty() {
            true => Ok(Outlets {
                all: scene.outlet.values().cloned().collect(),
                named: labels.len(),
                labels,
                border: None,
            }),
            false => Err(problems),
        }
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
