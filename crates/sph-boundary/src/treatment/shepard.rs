//! Means of the fluid's state at the wall.

use sph_core::{StepError, Vect, fields};
use sph_kernels::lanes::{Lane, dot};
use sph_neighbours::{Clusters, HiddenPairs, LanePair, PairSum, Particles, World, shepard};

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
    (targets, accelerations): (&[Vect<D>], &[Vect<D>]),
    list: (&Clusters, &HiddenPairs),
    whole: f64,
    out: &mut Vec<WallMean>,
) -> Result<(), StepError> {
    let mean = Means {
        pressure: world.free.get(fields::PRESSURE)?,
        density: world.free.get(fields::DENSITY)?,
        volume: world.free.get(fields::VOLUME)?,
        felt: EffectiveGravity {
            gravity: world.gravity,
            accelerations,
        },
    };
    shepard(world, targets, list, &mean, out, |_, [w, vw, p]| {
        match vw > 0.0 {
            true => WallMean {
                pressure: p / vw,
                volume: vw / w,
            },
            false => WallMean {
                pressure: 0.0,
                volume: whole,
            },
        }
    })
}

/// g − a_w, m/s².
pub(crate) struct EffectiveGravity<'a, const D: usize> {
    pub gravity: Vect<D>,
    /// Of the targets; empty where no wall ever moves.
    pub accelerations: &'a [Vect<D>],
}

impl<const D: usize> EffectiveGravity<'_, D> {
    #[inline(always)]
    pub fn own<L: Lane>(&self, targets: Particles) -> [L; D] {
        targets.each(|t| {
            let felt = match self.accelerations.get(t) {
                Some(acceleration) => self.gravity - acceleration,
                None => self.gravity,
            };
            felt.into()
        })
    }
}

/// Sums of w, V w and V p w.
struct Means<'a, const D: usize> {
    pressure: &'a [f64],
    density: &'a [f64],
    volume: &'a [f64],
    felt: EffectiveGravity<'a, D>,
}

impl<const D: usize> PairSum<D> for Means<'_, D> {
    const VALUES: bool = true;
    type Own<L: Lane> = [L; D];
    type Sum<L: Lane> = [L; 3];

    #[inline(always)]
    fn own<L: Lane>(&self, targets: Particles) -> [L; D] {
        self.felt.own(targets)
    }

    #[inline(always)]
    fn pair<L: Lane>(&self, felt: &[L; D], j: usize, pair: &LanePair<D, L>, sums: &mut [L; 3]) {
        let vw = L::splat(self.volume[j]) * pair.value;
        let hydrostatic = L::splat(self.density[j]) * dot(felt, &pair.separation);
        sums[0] += pair.value;
        sums[1] += vw;
        sums[2] += vw * (L::splat(self.pressure[j]) + hydrostatic);
    }
}
