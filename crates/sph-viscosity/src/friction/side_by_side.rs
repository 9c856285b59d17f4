//! The friction of several particles with one neighbour.

use sph_neighbours::{
    Lane, LanePair, LaneTerm, MOST, There, add_scaled, minus, set, splat, vector,
};

use super::{Bound, PairFriction, Sum};
use crate::OwnViscosity;

/// Own values of several particles.
#[derive(Clone, Copy)]
pub struct Side<const D: usize, L> {
    velocity: [L; D],
    viscosity: OwnViscosity<L>,
    volume: L,
    density: L,
    along: [L; D],
    /// Whether any has an element at which the wall term is to be corrected.
    near: bool,
}

/// Sums of several particles over their free neighbours, and what they started from.
#[derive(Clone, Copy)]
pub struct Sums<const D: usize, L> {
    force: [L; D],
    discrete: [L; D],
    start: Sum<D>,
}

impl<const D: usize, F: PairFriction<D>> LaneTerm<D> for Bound<'_, D, F> {
    type Side<L: Lane> = Side<D, L>;
    type Sums<L: Lane> = Sums<D, L>;

    #[inline(always)]
    fn side<L: Lane>(&self, here: &[Self::Here]) -> Self::Side<L> {
        let zero = L::splat(0.0);
        let mut viscosity = [here[0].viscosity; MOST];
        let mut side = Side {
            velocity: [zero; D],
            viscosity: self.viscosity.side::<L>(&viscosity[..1]),
            volume: zero,
            density: zero,
            along: [zero; D],
            near: false,
        };
        for (lane, own) in here.iter().enumerate() {
            set(&mut side.velocity, lane, &own.velocity);
            set(&mut side.along, lane, &own.along);
            side.volume.set(lane, own.volume);
            side.density.set(lane, own.density);
            side.near |= own.nearest.is_some();
            viscosity[lane] = own.viscosity;
        }
        side.viscosity = self.viscosity.side::<L>(&viscosity[..L::N]);
        side
    }

    #[inline(always)]
    fn sums<L: Lane>(&self, sum: &Sum<D>) -> Sums<D, L> {
        Sums {
            force: splat(&sum.force),
            discrete: splat(&sum.discrete),
            start: *sum,
        }
    }

    #[inline(always)]
    fn lane<L: Lane>(&self, sums: &Sums<D, L>, lane: usize) -> Sum<D> {
        Sum {
            force: vector(&sums.force, lane),
            discrete: vector(&sums.discrete, lane),
            ..sums.start
        }
    }

    #[inline(always)]
    fn add<L: Lane>(
        &self,
        here: &Self::Side<L>,
        j: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        sums: &mut Sums<D, L>,
    ) {
        let (volume, density) = (L::splat(there.volume), L::splat(there.density));
        let densities = [here.density, density];
        let mean = self
            .friction
            .means(&self.viscosity, &here.viscosity, j, densities);
        let relative = minus(&here.velocity, &there.velocity);
        let force = self.friction.forces(here.volume, volume, &relative, pair);
        add_scaled(&mut sums.force, &force, mean);
        if here.near {
            let shear = self.friction.shears(here.volume, volume, &here.along, pair);
            add_scaled(&mut sums.discrete, &pair.separation, shear);
        }
    }
}
