//! From the drawn walls to those of the wall plugin.

use sph_boundary::{BoundaryError, Wall, WallSetup, WallSpec};
use sph_kernels::Kernel;
use sph_neighbours::{Domain, WallSet};
use sph_scene::Scene;

use crate::failure::error::SolverError;

/// Hands every drawn wall to the plugin; refusals point at the wall.
pub fn build_walls<const D: usize>(
    scene: &Scene,
    drawn: &[WallSpec<D>],
    walls: &mut dyn Wall<D>,
    kernel: &dyn Kernel,
    domain: &Domain<D>,
    h: f64,
) -> Result<WallSet<D>, SolverError> {
    let setup = WallSetup {
        walls: drawn,
        spacing: scene.numerics.spacing,
        smoothing_length: h,
        kernel,
        domain,
    };
    let built = walls.build(&setup);
    built.map_err(|e| wall_problem(scene, &e))
}

/// A refused wall, pointed at if its message names one of the scene's in backquotes.
pub fn wall_problem(scene: &Scene, error: &BoundaryError) -> SolverError {
    let text = error.to_string();
    let named = scene.wall.keys().find(|n| text.contains(&format!("`{n}`")));
    let path = named.map_or("wall".to_string(), |n| format!("wall.{n}"));
    SolverError::at(path, text)
}
