//! The formulation of Grenier et al. (2009).

use rayon::prelude::*;
use sph_contribution::Stages;
use sph_core::{Access, Evolved, Stage, StepError, Vect, fields, plugin, stage};
use sph_neighbours::{
    Around, Interaction, Lane, LanePair, Neighbourhood, Particles, Rates, Values, WallPoints,
    World, add_scaled, pair_sum, pair_term, walk_into,
};

use crate::contract::volumes;
use crate::divergence::{Divergence, FilledVolume, KERNEL_SUM};
use crate::{Compressed, Diffused, Formulation, FormulationEntry};

/// d ln V/dt = D{u}, ρ_a = Σ m_b w_ab / Σ V_b w_ab over the particle's own phase, with
/// D_a{u} = −1/(γ_a d_a) [Σ_b θ_b V_b u_ab·∇w_ab − Σ_s u_as·∇γ_as],
/// G_a{p} = 1/γ_a [Σ_b θ_b V_b (p_a/d_a + p_b/d_b) ∇w_ab − Σ_s (p_a + p_s)/d_a ∇γ_as] and
/// d_a = 1/γ_a Σ_b θ_b V_b w_ab.
///
/// Volumes are integrated; densities are means over the phase and jump where it ends. G is the
/// adjoint of D, but D does not follow from the density: energy is conserved only as far as the
/// mean density is the particle's m/V. Walls have the d of the particle in the sum.
///
/// Source: Ghaïtanellis 2017, Eq. 3.14–3.18; Grenier et al. 2009; the wall terms are ours.
#[plugin(FormulationEntry [2, 3], "grenier", "integrated volumes, densities averaged within the phase",
    source: "Ghaïtanellis 2017, Eq. 3.14–3.18; Grenier et al. 2009", cfg(not(test)))]
pub struct Grenier {}

impl<const D: usize> Formulation<D> for Grenier {
    fn diffused(&self) -> Diffused {
        Diffused {
            evolved: Evolved {
                value: fields::VOLUME,
                rate: fields::VOLUME_RATE,
            },
            per_density: |density, volume, _| -volume / density,
        }
    }
    fn compressed(&self) -> Option<Compressed> {
        Some(Compressed {
            value: fields::VOLUME,
            exponent: 1.0,
        })
    }
    fn stages(&self) -> Stages<D> {
        vec![Box::new(phase_densities())]
    }
    fn pressure_term(&self) -> Box<dyn Interaction<D>> {
        Box::new(FilledPressure)
    }
    fn divergence(&self) -> Box<dyn Interaction<D>> {
        Divergence::boxed(FilledVolume)
    }
    fn is_scaled(&self) -> bool {
        false
    }
    fn rebase(&self, world: &mut World<D>) -> Result<(), StepError> {
        volumes().run(world)
    }
}

/// Densities by phase, and how full the supports are.
fn phase_densities<const D: usize>() -> impl Stage<World<D>> {
    let access = Access::none()
        .both((fields::POSITION, fields::MASS, fields::VOLUME))
        .where_there(fields::PHASE)
        .writes((fields::DENSITY, KERNEL_SUM));
    // Density and filling of every particle, on the way to their columns.
    let mut all = Vec::new();
    stage("density by phase", access, move |world: &mut World<D>| {
        let mut density = world.free.take(fields::DENSITY)?;
        let mut kernel_sum = world.free.take(KERNEL_SUM)?;
        let free = &world.free;
        let (mass, volume) = free.all((fields::MASS, fields::VOLUME))?;
        let phase = free.get(fields::PHASE).ok();
        let points = &world.walls.points;
        let own = world.kernel.value_at_zero();
        let sums_of = |around: &Around<'_, D>| {
            let (rows, i) = (&around.rows, around.rows.particle);
            let mut sums = [mass[i] * own, volume[i] * own, volume[i] * own];
            for (&j, w) in rows.free.index.iter().zip(around.free) {
                let j = j as usize;
                sums[2] += volume[j] * w;
                if phase.is_none_or(|p| p[i] == p[j]) {
                    sums[0] += mass[j] * w;
                    sums[1] += volume[j] * w;
                }
            }
            for (&v, w) in rows.wall.index.iter().zip(around.wall) {
                sums[2] += points.share[v as usize] * points.volume[v as usize] * w;
            }
            [sums[0] / sums[1], sums[2] * rows.inverse_renormalisation]
        };
        all.resize(density.len(), [0.0; 2]);
        walk_into(world, Values::Both, |_| true, &mut all, sums_of)?;
        let results = density.par_iter_mut().zip(&mut kernel_sum).zip(&all);
        let results = results.with_min_len(1024);
        results.for_each(|((rho, d), sums)| [*rho, *d] = *sums);
        world.free.put(KERNEL_SUM, kernel_sum)?;
        Ok(world.free.put(fields::DENSITY, density)?)
    })
}

struct FilledPressure;

#[pair_term(FilledPressure, "Grenier pressure gradient")]
struct BoundPressure<'a, const D: usize> {
    #[both(fields::PRESSURE)]
    pressure: &'a [f64],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[both(KERNEL_SUM)]
    kernel_sum: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[value(&world.walls.points)]
    points: &'a WallPoints<D>,
}

#[pair_sum]
impl<const D: usize> BoundPressure<'_, D> {
    /// p/d.
    fn own<L: Lane>(&self, all: Particles) -> L {
        all.numbers::<L>(self.pressure) / all.numbers(self.kernel_sum)
    }
    fn pair<L: Lane>(&self, own: &L, j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let both = *own + L::splat(self.pressure[j] / self.kernel_sum[j]);
        let weight = L::splat(self.volume[j]) * both * pair.factor;
        add_scaled(sum, &pair.separation, weight);
    }

    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let i = at.particle;
        let (own, inverse) = (self.pressure[i], 1.0 / self.kernel_sum[i]);
        let mut sum = Vect::from(sum);
        for (v, pair) in at.wall.pairs() {
            let pressure = (own + self.points.pressure[v]) * inverse;
            let weight = self.points.share[v] * self.points.volume[v] * pressure;
            sum += pair.separation * (weight * pair.factor);
        }
        for contact in at.contacts {
            sum -= contact.gradient * ((own + contact.pressure) * inverse);
        }
        rates.acceleration -= sum * (self.volume[i] / self.mass[i] * at.inverse_renormalisation);
    }
}
