//! Parts of the walls in ∇ ln s at a particle.

use sph_core::Vect;

/// The part of a wall that scales the kernel in ∇ ln s at a particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope<const D: usize> {
    /// The particle.
    pub particle: u32,
    /// The wall.
    pub wall: u32,
    /// ∇ ln s_k, 1/m.
    pub slope: Vect<D>,
}

/// The slopes at a particle, of those of all particles, which come by particle.
pub(crate) fn of_particle<const D: usize>(all: &[Slope<D>], particle: usize) -> &[Slope<D>] {
    let before = |s: &Slope<D>| (s.particle as usize) < particle;
    let from = all.partition_point(before);
    let own = all[from..].iter();
    let own = own.take_while(|s| s.particle as usize == particle);
    &all[from..from + own.count()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_found_by_particle() {
        let slope = |particle, wall| Slope {
            particle,
            wall,
            slope: Vect::<2>::zeros(),
        };
        let slopes = [slope(1, 0), slope(1, 2), slope(4, 1)];
        let walls = |particle| {
            let own = of_particle(&slopes, particle).iter();
            own.map(|s| s.wall).collect()
        };
        let found: Vec<Vec<u32>> = (0..6).map(walls).collect();
        assert_eq!(found, [vec![], vec![0, 2], vec![], vec![], vec![1], vec![]]);
    }
}
