//! Assembly in the plane and in space, both compiled here: a crate that assembles a scene does not compile the solver again.

use std::any::Any;

use sph_scene::Scene;
use sph_solver::SolverError;

use crate::assemble::{Assembled, assemble_share};
use crate::share::Share;

/// Builds the plugins, the particles and the plan.
///
/// # Errors
/// Every problem of the scene, with its path; nothing is written.
pub fn assemble<const D: usize>(scene: &Scene) -> Result<Assembled<D>, SolverError> {
    const { assert!(D == 2 || D == 3, "flows have two or three dimensions") };
    let made = if D == 2 { plane(scene) } else { space(scene) };
    match made?.downcast() {
        Ok(made) => Ok(*made),
        Err(_) => unreachable!("it was made with {D} dimensions"),
    }
}

fn plane(scene: &Scene) -> Result<Box<dyn Any>, SolverError> {
    Ok(Box::new(assemble_share::<2>(scene, Share::Whole)?))
}

fn space(scene: &Scene) -> Result<Box<dyn Any>, SolverError> {
    Ok(Box::new(assemble_share::<3>(scene, Share::Whole)?))
}

/// The flow of a scene in the plane, for unit tests: nothing of space is compiled for them.
#[cfg(test)]
pub(crate) fn in_plane(text: &str) -> sph_solver::Flow<2> {
    let loaded = sph_scene::parse(text, "t.toml", &[]).unwrap_or_else(|e| panic!("{e}"));
    let parts = assemble_share::<2>(&loaded.scene, Share::Whole);
    parts.unwrap_or_else(|e| panic!("{e}")).flow
}
