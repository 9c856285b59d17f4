//! Parts of the walls in ∇ ln s at a particle.

use sph_core::Vect;

/// ∇ ln s_k of every wall k that scales the kernel at a particle.
#[derive(Clone, Debug, Default)]
pub struct Slopes<const D: usize> {
    all: Vec<Slope<D>>,
}

/// That of one wall at one particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope<const D: usize> {
    /// The particle.
    pub particle: u32,
    /// The wall.
    pub wall: u32,
    /// ∇ ln s_k, 1/m.
    pub slope: Vect<D>,
}

impl<const D: usize> Slopes<D> {
    /// Those of all particles, by particle.
    pub fn all(&self) -> &[Slope<D>] {
        &self.all
    }

    /// Those of a particle.
    pub fn of_particle(&self, particle: usize) -> &[Slope<D>] {
        let before = |s: &Slope<D>| (s.particle as usize) < particle;
        let from = self.all.partition_point(before);
        let own = self.all[from..].iter();
        let own = own.take_while(|s| s.particle as usize == particle);
        &self.all[from..from + own.count()]
    }

    /// Replaces all; they come by particle.
    pub fn renew(&mut self, all: impl Iterator<Item = Slope<D>>) {
        self.all.clear();
        self.all.extend(all);
    }
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
        let mut slopes = Slopes::default();
        slopes.renew([slope(1, 0), slope(1, 2), slope(4, 1)].into_iter());
        let walls = |particle| {
            let own = slopes.of_particle(particle).iter();
            own.map(|s| s.wall).collect()
        };
        let found: Vec<Vec<u32>> = (0..6).map(walls).collect();
        assert_eq!(found, [vec![], vec![0, 2], vec![], vec![], vec![1], vec![]]);
    }
}
