//! Readings of a coupled system, and its changes from outside.

use crate::coupled::{CoupledSystem, FlowSetup, Vector};
use crate::flow::PoreGeometry;
use crate::grains::GrainSystem;

impl CoupledSystem {
    /// The grains, their walls and contacts; the fluid's forces are the external ones.
    pub fn grains(&self) -> &GrainSystem {
        &self.grains
    }

    /// The grains, to steer walls, to set gravity or another contact law. Code that moves or scales grains here makes
    /// the mesh anew with [`CoupledSystem::remesh`].
    pub fn grains_mut(&mut self) -> &mut GrainSystem {
        self.evaluated = false;
        &mut self.grains
    }

    /// The grains without the fluid and its forces.
    pub fn into_grains(mut self) -> GrainSystem {
        self.grains.grains.external_force.fill(Vector::zeros());
        for wall in &mut self.grains.walls {
            wall.external_force = Vector::zeros();
        }
        self.grains
    }

    /// The fluid, the conditions and the criterion for meshes.
    pub fn setup(&self) -> &FlowSetup {
        &self.setup
    }

    /// Cells and throats of the mesh; grains have moved a little since it was made.
    pub fn pores(&self) -> &PoreGeometry {
        &self.pores.geometry
    }

    /// Pressures of all cells at the last step, Pa.
    pub fn pressures(&self) -> &[f64] {
        &self.clock.pressures
    }

    /// Volumes of all cells where the grains are now, m³; they add up to the box.
    pub fn volumes(&self) -> &[f64] {
        &self.clock.volumes
    }

    /// Rates at which the volumes changed in the last step, m³/s.
    pub fn volume_rates(&self) -> &[f64] {
        &self.clock.rates
    }

    /// Number of meshes made, the first included.
    pub fn meshes(&self) -> u64 {
        self.clock.meshes
    }
}
