//! Bodies that the fluid moves: balance, stability, contact, chains, the same bits, and what is refused.

mod balance;
mod contact;
mod layer;
mod light;
mod moored;
mod refused;
mod rest;
mod resumed;

use std::path::Path;

use sph_boundary::RigidState;
use sph_tests::FinalState;

/// A box that floats in a small tank: 24 rows of 12.
const FLOAT: &str = include_str!("float.toml");

/// The states of all bodies at the end of a run, in the order of their names.
fn states<const D: usize>(folder: &Path) -> Vec<RigidState<D>> {
    let numbers = FinalState::read(folder).reals("wall_states");
    let parts = numbers.chunks(RigidState::<D>::NUMBERS);
    let state = |part| RigidState::from_numbers(part).expect("a state");
    parts.map(state).collect()
}
