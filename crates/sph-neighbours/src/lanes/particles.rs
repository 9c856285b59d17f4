//! Particles in lanes, and their sums.

use nalgebra::SMatrix;
use sph_core::Vect;
use sph_kernels::lanes::{Lane, MOST};

use crate::lists::members::Members;

/// Particles that follow each other, one in each lane; the last one fills the lanes that are left over.
#[derive(Clone, Copy, Debug)]
pub struct Particles {
    from: usize,
    last: usize,
}

impl Particles {
    /// One particle.
    #[inline(always)]
    pub fn one(particle: usize) -> Self {
        Particles {
            from: particle,
            last: particle,
        }
    }

    #[inline(always)]
    pub(crate) fn first(count: usize) -> Self {
        Particles {
            from: 0,
            last: count - 1,
        }
    }

    /// The particle of a lane.
    #[inline(always)]
    pub fn at(self, lane: usize) -> usize {
        (self.from + lane).min(self.last)
    }

    /// Numbers that are computed for each particle, through memory: lanes that are set one by one are taken apart by the
    /// compiler, and each goes its own way.
    #[inline(always)]
    pub fn each<L: Lane, const N: usize>(self, mut of: impl FnMut(usize) -> [f64; N]) -> [L; N] {
        let mut memory = [[0.0; MOST]; N];
        for lane in 0..L::N {
            let values = of(self.at(lane));
            for (memory, value) in memory.iter_mut().zip(values) {
                memory[lane] = value;
            }
        }
        let mut lanes = [L::splat(0.0); N];
        for n in 0..N {
            lanes[n] = L::load(&memory[n]);
        }
        lanes
    }

    /// Their numbers in a column.
    #[inline(always)]
    pub fn numbers<L: Lane>(self, column: &[f64]) -> L {
        match self.last - self.from + 1 >= L::N {
            true => L::load(&column[self.from..]),
            false => self.each(|i| [column[i]])[0],
        }
    }

    /// Their vectors in a column.
    #[inline(always)]
    pub fn vectors<const D: usize, L: Lane>(self, column: &[Vect<D>]) -> [L; D] {
        self.each(|i| column[i].data.0[0])
    }

    /// The rows of their matrices in a column.
    #[inline(always)]
    pub fn matrices<const D: usize, L: Lane>(self, column: &[SMatrix<f64, D, D>]) -> [[L; D]; D] {
        std::array::from_fn(|k| self.each(|i| std::array::from_fn(|l| column[i][(k, l)])))
    }

    /// Their phases, which are small whole numbers, exact as any; 0 without a column.
    #[inline(always)]
    pub fn phases<L: Lane>(self, column: Option<&[u32]>) -> L {
        match column {
            Some(column) => self.each(|i| [f64::from(column[i])])[0],
            None => L::splat(0.0),
        }
    }
}

impl From<Members<'_>> for Particles {
    #[inline(always)]
    fn from(members: Members<'_>) -> Self {
        Particles {
            from: members.from,
            last: members.from + members.count - 1,
        }
    }
}

/// Sums of a few particles, a row for each number.
pub(crate) type Rows = Vec<[f64; MOST]>;
