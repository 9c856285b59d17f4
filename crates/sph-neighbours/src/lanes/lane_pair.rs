//! One neighbour of a particle, and of several.

use sph_core::Vect;

/// One pair of a particle.
#[derive(Clone, Copy, Debug)]
pub struct Pair<const D: usize> {
    /// r_i − r_j, m.
    pub separation: Vect<D>,
    /// |r_i − r_j|², m².
    pub distance2: f64,
    /// F = w'(r)/r ≤ 0: ∇w = F · separation.
    pub factor: f64,
}

/// One neighbour as the particles of a cluster see it, a particle in each lane.
#[derive(Clone, Copy, Debug)]
pub struct LanePair<const D: usize, L> {
    /// r_i − r_j, m.
    pub separation: [L; D],
    /// |r_i − r_j|², m²; infinite for a particle and itself.
    pub distance2: L,
    /// F = w'(r)/r ≤ 0, 1/m^(d+2); 0 where the neighbour is beyond the support, and for itself.
    pub factor: L,
    /// w, 1/m^d, where a sum asks for it ([`PairSum::VALUES`](crate::PairSum::VALUES)), else 0; 0 beyond the support.
    pub value: L,
}

impl<const D: usize> From<&Pair<D>> for LanePair<D, f64> {
    #[inline(always)]
    fn from(pair: &Pair<D>) -> Self {
        LanePair {
            separation: pair.separation.data.0[0],
            distance2: pair.distance2,
            factor: pair.factor,
            value: 0.0,
        }
    }
}
