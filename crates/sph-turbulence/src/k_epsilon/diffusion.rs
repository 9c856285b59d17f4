//! Diffusion of k and ε.

use sph_contribution::Limiter;
use sph_core::reexport::inventory;
use sph_core::{Access, Field, Scalar, StepError, StepLimit, fields};
use sph_neighbours::{
    BoundTerm, FusionEntry, Lane, LanePair, LanePairTerm, LaneTerm, Pair, Rates, There, World,
    fuse_two_lanes,
};

use crate::columns::{DISSIPATION, DISSIPATION_RATE, TURBULENT_ENERGY, TURBULENT_ENERGY_RATE};

const VALUE: [Field<Scalar>; 2] = [TURBULENT_ENERGY, DISSIPATION];
const RATE: [Field<Scalar>; 2] = [TURBULENT_ENERGY_RATE, DISSIPATION_RATE];

/// dA_a/dt = 1/(γ_a ρ_a) Σ_b V_b (D_a + D_b)(A_a − A_b) F_ab with D = η + η_t/σ, for A = k (K = 0) and A = ε (K = 1); nothing
/// passes through walls and surfaces, nor into phases without eddies.
///
/// Source: Issa 2004, Eq. 5.61 and 5.65, with the viscosity of the fluid.
pub(crate) struct Diffusion<const K: usize>(
    /// σ.
    pub f64,
);

/// [`Diffusion`] with its columns.
pub(crate) struct BoundDiffusion<'a> {
    value: &'a [f64],
    viscosity: &'a [f64],
    eddies: &'a [f64],
    density: &'a [f64],
    /// 1 − 1/σ: what an eddy's viscosity does not move.
    held: f64,
    slot: usize,
}

impl BoundDiffusion<'_> {
    /// η + η_t/σ, where the viscosity is that of fluid and eddies; nothing where a closure does not act: where it does,
    /// there are eddies.
    #[inline(always)]
    fn diffusivity(&self, i: usize) -> f64 {
        match self.eddies[i] > 0.0 {
            true => self.viscosity[i] - self.held * self.eddies[i],
            false => 0.0,
        }
    }
}

/// A particle's own values.
#[derive(Clone, Copy)]
pub(crate) struct Here {
    value: f64,
    diffusivity: f64,
    specific_volume: f64,
}

impl<const D: usize, const K: usize> LanePairTerm<D> for Diffusion<K> {
    type Bound<'a> = BoundDiffusion<'a>;
    fn name(&self) -> String {
        format!("diffusion of {}", VALUE[K].name)
    }
    fn access(&self) -> Access {
        Access::none()
            .both(VALUE[K])
            .both(fields::VISCOSITY)
            .both(fields::EDDY_VISCOSITY)
            .here(fields::DENSITY)
            .neighbours(fields::VOLUME)
            .writes(RATE[K])
    }
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Self::Bound<'a>, StepError> {
        Ok(BoundDiffusion {
            value: world.free.get(VALUE[K])?,
            viscosity: world.free.get(fields::VISCOSITY)?,
            eddies: world.free.get(fields::EDDY_VISCOSITY)?,
            density: world.free.get(fields::DENSITY)?,
            held: 1.0 - 1.0 / self.0,
            slot: world.slot(RATE[K])?,
        })
    }
}

impl<const D: usize> BoundTerm<D> for BoundDiffusion<'_> {
    type Here = Here;
    type Sum = f64;
    #[inline(always)]
    fn here(&self, i: usize) -> Here {
        Here {
            value: self.value[i],
            diffusivity: self.diffusivity(i),
            specific_volume: 1.0 / self.density[i],
        }
    }
    #[inline(always)]
    fn zero(&self) -> f64 {
        0.0
    }
    #[inline(always)]
    fn free(&self, here: &Here, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut f64) {
        self.add_one(here, j, there, pair, sum);
    }
    #[inline(always)]
    fn finish(&self, here: &Here, sum: &f64, inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.more[self.slot] += sum * inverse_gamma * here.specific_volume;
    }
}

impl<const D: usize> LaneTerm<D> for BoundDiffusion<'_> {
    /// Value and diffusivity.
    type Side<L: Lane> = [L; 2];
    type Sums<L: Lane> = L;

    #[inline(always)]
    fn side<L: Lane>(&self, here: &[Here]) -> [L; 2] {
        let mut side = [L::splat(0.0); 2];
        for (lane, own) in here.iter().enumerate() {
            side[0].set(lane, own.value);
            side[1].set(lane, own.diffusivity);
        }
        side
    }
    #[inline(always)]
    fn sums<L: Lane>(&self, sum: &f64) -> L {
        L::splat(*sum)
    }
    #[inline(always)]
    fn lane<L: Lane>(&self, sums: &L, lane: usize) -> f64 {
        sums.at(lane)
    }
    #[inline(always)]
    fn add<L: Lane>(
        &self,
        [value, diffusivity]: &[L; 2],
        j: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        sums: &mut L,
    ) {
        // Nothing passes to or from those on whom the closure does not act.
        let (zero, there_too) = (L::splat(0.0), L::splat(self.diffusivity(j)));
        let both = there_too.where_positive(*diffusivity + there_too, zero);
        let both = diffusivity.where_positive(both, zero);
        let apart = *value - L::splat(self.value[j]);
        *sums += L::splat(there.volume) * both * apart * pair.factor;
    }
}

inventory::submit! {
    FusionEntry {
        terms: 2,
        fuse_2d: fuse_two_lanes::<2, Diffusion<0>, Diffusion<1>>,
        fuse_3d: fuse_two_lanes::<3, Diffusion<0>, Diffusion<1>>,
    }
}

/// Δt ≤ C ρ h²/(η + η_t): what keeps an explicit diffusion positive.
pub(crate) struct DiffusionLimit(
    /// C.
    pub f64,
);

impl<const D: usize> Limiter<D> for DiffusionLimit {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let viscosity = world.free.get(fields::VISCOSITY)?.iter();
        let density = world.free.get(fields::DENSITY)?;
        let eddies = world.free.get(fields::EDDY_VISCOSITY)?;
        let all = viscosity.zip(density).zip(eddies);
        let acting = all.filter(|(_, eddies)| **eddies > 0.0);
        let both = acting.map(|((eta, rho), _)| eta / rho);
        let largest = both.fold(0.0, f64::max);
        let h = world.kernel.smoothing_length();
        Ok(StepLimit::new("turbulence", self.0 * h * h / largest))
    }
    fn formula(&self) -> String {
        format!("turbulence: dt <= {} h² / (ν + ν_t)", self.0)
    }
}
