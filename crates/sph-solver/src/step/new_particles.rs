//! Initial values of particles that come into the flow.

use std::sync::Arc;

use sph_contribution::OwnColumn;
use sph_multiphase::Formulation;
use sph_scene::Scene;

/// Initial values of newborn particles.
pub struct NewParticleDefaults<const D: usize> {
    pub(crate) formulation: Arc<dyn Formulation<D>>,
    /// Columns that contributions bring along.
    pub(crate) columns: Vec<OwnColumn<D>>,
    pub(crate) phases: Vec<String>,
}

impl<const D: usize> NewParticleDefaults<D> {
    /// That of a scene.
    pub fn new(
        scene: &Scene,
        formulation: Arc<dyn Formulation<D>>,
        columns: Vec<OwnColumn<D>>,
    ) -> Self {
        NewParticleDefaults {
            formulation,
            columns,
            phases: scene.phase.keys().cloned().collect(),
        }
    }
}
