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

/// Paragraphs of a file: a shipped scene with its changes, then what it is refused with.
#[test]
fn combinations_that_do_not_fit_are_refused_at_their_key() {
    for case in include_str!("combinations.refused").split("\n\n") {
        let mut lines = case.lines().filter(|line| !line.starts_with('#'));
        let (scene, set) = lines
            .next()
            .and_then(|l| l.split_once(' '))
            .expect("changes");
        let words = lines
            .next()
            .and_then(|l| l.strip_prefix("! "))
            .expect("words");
        let refused = tried(scene, &[set]).err();
        let told = refused
            .unwrap_or_else(|| panic!("{case} is accepted"))
            .to_string();
        told.says(words);
    }
}
