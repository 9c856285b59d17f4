//! One neighbour of several particles.

/// One neighbour as the particles of a cluster see it, a particle in each lane.
#[derive(Clone, Copy, Debug)]
pub struct LanePair<const D: usize, L> {
    /// r_i − r_j, m.
    pub separation: [L; D],
    /// |r_i − r_j|², m²; infinite for a particle and itself.
    pub distance2: L,
    /// F = w'(r)/r ≤ 0, 1/m^(d+2); 0 for whom the neighbour is beyond the support, and for itself.
    pub factor: L,
}
