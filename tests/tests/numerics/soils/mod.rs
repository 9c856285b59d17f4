//! Soils: elastic forces, pressures between grains, water through pores, odd beds.

mod effective_pressure;
mod elastic_force;
mod elastic_operator;
mod elastic_sub_steps;
mod falling_cliff;
mod gradients;
mod implicit_elasticity;
mod odd_beds;
mod pores;
mod seepage;
mod solids_at_rest;
mod stepping;

use std::path::Path;

use sph_particles::setup::{Assembled, assemble};
use sph_scene::{Override, load};
use sph_solver::SolverError;

/// A shipped scene in the plane with some changes, assembled.
fn tried(scene: &str, overrides: &[&str]) -> Result<Assembled<2>, SolverError> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{scene}.toml"));
    let overrides = overrides.iter().map(|o| Override::parse(o).unwrap());
    let overrides: Vec<_> = overrides.collect();
    let loaded = load(&path, &overrides).unwrap_or_else(|e| panic!("{e}"));
    assemble::<2>(&loaded.scene)
}
