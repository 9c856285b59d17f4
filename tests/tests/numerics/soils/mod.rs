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

use sph_particles::setup::{Assembled, assemble};
use sph_solver::SolverError;
use sph_tests::shipped;

/// A shipped scene in the plane with some changes, assembled.
fn tried(scene: &str, overrides: &[&str]) -> Result<Assembled<2>, SolverError> {
    assemble::<2>(&shipped(scene, overrides))
}
