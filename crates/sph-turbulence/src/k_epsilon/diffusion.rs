//! Diffusion of k and ε.

use sph_contribution::{Limiter, bound};
use sph_core::{Access, Field, Scalar, StepError, fields};
use sph_neighbours::{
    Elements, Lane, LanePair, Neighbourhood, PairTerm, Particles, Rates, World, pair_sum,
};

use crate::columns::{DISSIPATION, DISSIPATION_RATE, TURBULENT_ENERGY, TURBULENT_ENERGY_RATE};

const VALUE: [Field<Scalar>; 2] = [TURBULENT_ENERGY, DISSIPATION];
const RATE: [Field<Scalar>; 2] = [TURBULENT_ENERGY_RATE, DISSIPATION_RATE];

/// dA_a/dt = 1/(γ_a ρ_a) Σ_b V_b (D_a + D_b)(A_a − A_b) F_ab with D = η + η_t/σ, for A = k (N = 1), or k and ε (N = 2) that
/// share all of the pair but D; nothing passes through walls and surfaces, nor into phases without eddies.
///
/// Except for the ε of walls with a wall function, on request: with ε = u_k³/(κz), ν_t = κu_k z and u_k⁴ = C_μk² the
/// wall gives C_μk²/(σ_ε z), which adds 2/γ_a Σ_s C_μk²/(σ_ε z)|∇γ_as| to dε/dt, z being the particle's distance.
///
/// Source: Issa 2004, Eq. 5.61 and 5.65, with the viscosity of the fluid; the flux of ε is that of the
/// logarithmic law, put in as Ferrand et al. 2013 put fluxes through walls. It was not held against another code's.
pub(crate) struct Diffusion<const N: usize> {
    /// σ of each.
    pub sigma: [f64; N],
    /// C_μ of the flux of the last of them through walls with a wall function; none passes if left out.
    pub wall_flux: Option<f64>,
}

pub(crate) struct BoundDiffusion<'a, const D: usize, const N: usize> {
    value: [&'a [f64]; N],
    viscosity: &'a [f64],
    eddies: &'a [f64],
    density: &'a [f64],
    volume: &'a [f64],
    /// 1 − 1/σ: the part that an eddy's viscosity does not move.
    held: [f64; N],
    slot: [usize; N],
    /// 2C_μ/σ of a flux through walls.
    wall_flux: Option<f64>,
    elements: &'a Elements<D>,
    /// Least distance from a wall, m.
    nearest: f64,
}

impl<const D: usize, const N: usize> PairTerm<D> for Diffusion<N> {
    type Bound<'a> = BoundDiffusion<'a, D, N>;
    fn name(&self) -> String {
        let names: Vec<_> = VALUE[..N].iter().map(|field| field.name).collect();
        format!("diffusion of {}", names.join(" and "))
    }
    fn access(&self) -> Access {
        let access = Access::none()
            .both((fields::VISCOSITY, fields::EDDY_VISCOSITY))
            .here(fields::DENSITY)
            .neighbours(fields::VOLUME);
        (0..N).fold(access, |access, n| access.both(VALUE[n]).writes(RATE[n]))
    }
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Self::Bound<'a>, StepError> {
        let (mut value, mut slot) = ([&[][..]; N], [0; N]);
        for n in 0..N {
            (value[n], slot[n]) = (world.free.get(VALUE[n])?, world.slot(RATE[n])?);
        }
        Ok(BoundDiffusion {
            value,
            viscosity: world.free.get(fields::VISCOSITY)?,
            eddies: world.free.get(fields::EDDY_VISCOSITY)?,
            density: world.free.get(fields::DENSITY)?,
            volume: world.free.get(fields::VOLUME)?,
            held: self.sigma.map(|sigma| 1.0 - 1.0 / sigma),
            slot,
            wall_flux: self.wall_flux.map(|c_mu| 2.0 * c_mu / self.sigma[N - 1]),
            elements: &world.walls.elements,
            nearest: 0.5 * world.spacing,
        })
    }
}

#[pair_sum]
impl<const D: usize, const N: usize> BoundDiffusion<'_, D, N> {
    /// η + η_t/σ, where the viscosity is that of fluid and eddies; nothing where a closure does not act: where it does,
    /// there are eddies.
    fn diffusivity(&self, i: usize) -> [f64; N] {
        let (viscosity, eddies) = (self.viscosity[i], self.eddies[i]);
        match eddies > 0.0 {
            true => self.held.map(|held| viscosity - held * eddies),
            false => [0.0; N],
        }
    }

    fn own<L: Lane>(&self, all: Particles) -> [[L; N]; 2] {
        let value = all.each(|i| self.value.map(|value| value[i]));
        [value, all.each(|i| self.diffusivity(i))]
    }
    fn pair<L: Lane>(
        &self,
        [value, diffusivity]: &[[L; N]; 2],
        j: usize,
        pair: &LanePair<D, L>,
        sums: &mut [L; N],
    ) {
        // Nothing passes to or from particles without the closure.
        let there_too = self.diffusivity(j);
        if there_too[0] <= 0.0 {
            return;
        }
        let weight = L::splat(self.volume[j]) * pair.factor;
        let weight = diffusivity[0].where_positive(weight, L::splat(0.0));
        for n in 0..N {
            let both = diffusivity[n] + L::splat(there_too[n]);
            sums[n] += weight * both * (value[n] - L::splat(self.value[n][j]));
        }
    }

    fn finish(&self, mut sum: [f64; N], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let i = at.particle;
        let specific_volume = 1.0 / self.density[i];
        if let Some(flux) = self.wall_flux.filter(|_| self.diffusivity(i)[0] > 0.0) {
            for contact in at.contacts {
                let marked = self.elements.wall_function.get(contact.element as usize);
                if marked == Some(&true) {
                    let passing = flux * self.value[0][i].powi(2);
                    let passing = passing / contact.distance.max(self.nearest);
                    sum[N - 1] += passing * contact.gradient.norm() / specific_volume;
                }
            }
        }
        for (slot, sum) in self.slot.iter().zip(sum) {
            rates.more[*slot] += sum * at.inverse_renormalisation * specific_volume;
        }
    }
}

/// Δt ≤ C ρ h²/(η + η_t): the limit of a positive explicit diffusion.
pub(crate) fn diffusion_limit<const D: usize>(coefficient: f64) -> impl Limiter<D> {
    let formula = format!("turbulence: dt <= {coefficient} h² / (ν + ν_t)");
    bound("turbulence", formula, None, move |world: &World<D>| {
        let viscosity = world.free.get(fields::VISCOSITY)?.iter();
        let (density, eddies) = world.free.all((fields::DENSITY, fields::EDDY_VISCOSITY))?;
        let all = viscosity.zip(density).zip(eddies);
        let acting = all.filter(|(_, eddies)| **eddies > 0.0);
        let largest = (acting.map(|((eta, rho), _)| eta / rho)).fold(0.0, f64::max);
        let h = world.kernel.smoothing_length();
        Ok(coefficient * h * h / largest)
    })
}
