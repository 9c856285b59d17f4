//! Cost of particles, for a fair division between ranks.

use sph_neighbours::World;

/// Cost of a contact with a wall in terms of that of a candidate. At the start of `dam-break-spheric2` at 2 cm a contact takes
/// 50 ns and a true neighbour 8.2 ns, of which the list of a cluster is taken to have twice as many, as in the plane.
const CONTACT: f64 = 12.0;

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
        candidates as f64 + CONTACT * contacts.of_particle(i).len() as f64
    };
    (0..world.free.len()).map(cost).collect()
}
