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
const FLOAT: &str = r#"
title = "A box floats"
dimension = 2
[run]
end = 0.1
checkpoint_every = 0.02
[numerics]
spacing = 0.02
gravity = [0.0, -9.81]
[smoother.brezzi-pitkaranta]
strength = 0.04
[walls.usaw]
vertices = false
[wall.tank]
polyline = [[0, 0.6], [0, 0], [0.8, 0], [0.8, 0.6]]
condition = "free-slip"
[wall.float]
box = [[0.3, 0.2], [0.5, 0.3]]
fluid = "outside"
condition = "free-slip"
[wall.float.mover.rigid-body]
density = 500.0
[phase.water]
density = 1000.0
rheology.newtonian = { viscosity = "1 mPa s" }
[body.water]
phase = "water"
box = [[0, 0], [0.8, 0.26]]
clip = true
pressure = "hydrostatic"
[probe.float]
kind = "wall-motion"
wall = "float"
at = [0.4, 0.25]
[output]
every = 0.1
series_every = 0.002
vtk = false
"#;

/// The states of all bodies at the end of a run, in the order of their names.
fn states<const D: usize>(folder: &Path) -> Vec<RigidState<D>> {
    let numbers = FinalState::read(folder).reals("wall_states");
    let parts = numbers.chunks(RigidState::<D>::NUMBERS);
    let state = |part| RigidState::from_numbers(part).expect("a state");
    parts.map(state).collect()
}
