//! Cost of particles, for a fair division between ranks.

use sph_neighbours::World;

/// Cost of a contact with a wall in terms of that of a candidate, in the plane and in space. A candidate takes 4 ns. In the
/// plane a contact takes 50 ns; in space it is a whole face and takes 300 ns (`dam-break-spheric2` at 4 cm).
const CONTACT: [f64; 2] = [12.0, 80.0];

/// Candidates of each particle, and its contacts with walls.
pub fn costs<const D: usize>(world: &World<D>) -> Vec<f64> {
    let contacts = &world.walls.contacts;
    let particles = world.free.len();
    if world.lists.reference.len() != particles {
        // No lists of these particles yet.
        return vec![1.0; particles];
    }
    let cost = |i: usize| {
        let candidates = world.lists.free.candidates(i).len();
        candidates as f64 + CONTACT[D - 2] * contacts.of_particle(i).len() as f64
    };
    (0..world.free.len()).map(cost).collect()
}
