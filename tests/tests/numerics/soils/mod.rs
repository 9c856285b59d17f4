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
use sph_tests::{Says, shipped};

/// A shipped scene in the plane with some changes, assembled.
fn tried(scene: &str, overrides: &[&str]) -> Result<Assembled<2>, SolverError> {
    assemble::<2>(&shipped(scene, overrides))
}

/// Rows of a file: a shipped scene with its changes, then what it is refused with.
#[test]
fn combinations_that_do_not_fit_are_refused_at_their_key() {
    let rows = include_str!("combinations.refused").lines();
    for row in rows.filter(|row| !row.is_empty() && !row.starts_with('#')) {
        let (changed, words) = row.split_once(" ! ").expect("words");
        let (scene, set) = changed.split_once(' ').expect("changes");
        let refused = tried(scene, &[set]).err().map(|e| e.to_string());
        refused.unwrap_or_else(|| panic!("{row}")).says(words);
    }
}
