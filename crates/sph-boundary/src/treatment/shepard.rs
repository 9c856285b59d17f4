//! Means of the fluid's state at the wall.

use std::ops::Range;

use sph_core::{StepError, Vect, fields};
use sph_lanes::{Lane, MOST, dot};
use sph_neighbours::{Blocked, Clusters, InMemory, TargetMean, World, in_memory, loaded, shepard};

/// What the fluid looks like from a place on the wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallMean {
    /// Σ V [p + ρ (g − a_w)·(x − r)] w / Σ V w, Pa; 0 without fluid. Ghaïtanellis 2017, Eq. 2.91,
    /// with the acceleration of the wall (∂p/∂n = ρ (g − a_w)·n).
    pub pressure: f64,
    /// Σ V w / Σ w, m^d; a whole cell without fluid. Ghaïtanellis 2017, Eq. 3.21.
    pub volume: f64,
}

/// Means over the free particles at every target; walls that never move have no accelerations.
pub(crate) fn wall_means<const D: usize>(
    world: &World<D>,
    targets: &[Vect<D>],
    accelerations: &[Vect<D>],
    list: (&Clusters, &Blocked),
    whole: f64,
    out: &mut Vec<WallMean>,
) -> Result<(), StepError> {
    let mean = Means {
        pressure: world.free.get(fields::PRESSURE)?,
        density: world.free.get(fields::DENSITY)?,
        volume: world.free.get(fields::VOLUME)?,
        felt: Felt {
            gravity: world.gravity,
            accelerations,
        },
        whole,
    };
    shepard(world, targets, list, &mean, out)
}

/// g − a_w, m/s².
pub(crate) struct Felt<'a, const D: usize> {
    pub gravity: Vect<D>,
    /// Of the targets; empty where no wall ever moves.
    pub accelerations: &'a [Vect<D>],
}

impl<const D: usize> Felt<'_, D> {
    pub fn of(&self, targets: Range<usize>) -> InMemory<D> {
        let mut felt = [self.gravity; MOST];
        for (felt, t) in felt.iter_mut().zip(targets) {
            if let Some(acceleration) = self.accelerations.get(t) {
                *felt -= acceleration;
            }
        }
        in_memory(&felt)
    }
}

/// Sums of w, V w and V p w.
struct Means<'a, const D: usize> {
    pressure: &'a [f64],
    density: &'a [f64],
    volume: &'a [f64],
    felt: Felt<'a, D>,
    whole: f64,
}

impl<const D: usize> TargetMean<D, 3> for Means<'_, D> {
    type Mean = WallMean;
    type Here = InMemory<D>;
    type Side<L: Lane> = [L; D];

    fn here(&self, targets: Range<usize>) -> InMemory<D> {
        self.felt.of(targets)
    }

    #[inline(always)]
    fn side<L: Lane>(&self, felt: &InMemory<D>) -> [L; D] {
        loaded(felt)
    }

    #[inline(always)]
    fn add<L: Lane>(&self, felt: &[L; D], j: usize, apart: &[L; D], w: L, sums: &mut [L; 3]) {
        let vw = L::splat(self.volume[j]) * w;
        let hydrostatic = L::splat(self.density[j]) * dot(felt, apart);
        sums[0] += w;
        sums[1] += vw;
        sums[2] += vw * (L::splat(self.pressure[j]) + hydrostatic);
    }

    fn mean(&self, _: usize, [w, vw, p]: [f64; 3]) -> WallMean {
        if vw > 0.0 {
            WallMean {
                pressure: p / vw,
                volume: vw / w,
            }
        } else {
            WallMean {
                pressure: 0.0,
                volume: self.whole,
            }
        }
    }
}
