//! The δ-SPH smoother.

use sph_core::{Access, Field, Stage, Vect, Vector, fields, parameters, plugin, stage};
use sph_neighbours::{
    Around, Lane, LanePair, Neighbourhood, Particles, Rates, Values, World, dot, pair_sum,
    pair_term, unlike, walk_into,
};

use sph_contribution::{Contribution, Offer, Refusal, Setting};

use crate::diffusion::balance::linear_exact;
use crate::diffusion::{SmootherEntry, Smoothing};

/// dρ_a/dt += 2 δ h c_a/γ_a Σ_b V_b [ρ_a − ρ_b − ½(∇ρ_a + ∇ρ_b)·r_ab] F_ab over free neighbours
/// of the same phase.
///
/// Symbols: δ number; h smoothing length (m); c speed of sound of the phase at rest (m/s); F = w'/r.
/// In the `renormalised` form ∇ρ is the gradient that is exact for linear densities, so that the
/// hydrostatic one is left alone also where the support is cut; it costs one more walk. The `plain`
/// form has no ∇ρ: at a free surface a hydrostatic density then has a source of about δ ρ₀ g/c.
/// Neighbours of other phases do not count, as in Fourtakas & Rogers (2016), so each phase sees the interface as a free
/// surface; [`DeltaMultiphase`](crate::diffusion::DeltaMultiphase) looks across.
///
/// Source: Molteni & Colagrossi 2009 (plain); Antuono et al. 2010 (renormalised).
///
/// ```toml
/// [smoother.delta-sph]
/// form = "renormalised"
/// strength = 0.1
/// ```
#[plugin(SmootherEntry [2, 3], "delta-sph", "density diffusion within each phase",
    source: "Molteni & Colagrossi 2009; Antuono et al. 2010")]
#[derive(Copy)]
pub struct DeltaSph {
    /// Strength δ.
    #[parameter(default: 0.1, unit: "1", min: 0.0, max: 1.0, source: "Antuono et al. 2010: 0.1")]
    pub strength: f64,
    /// With or without the gradients of the density.
    #[parameter(default: DeltaForm::Renormalised, source: "Molteni & Colagrossi 2009; Antuono et al. 2010")]
    pub form: DeltaForm,
}

/// The forms of [`DeltaSph`].
#[parameters]
pub enum DeltaForm {
    /// Differences of density.
    Plain,
    /// Differences from the linear density.
    #[default]
    Renormalised,
}

impl<const D: usize> Contribution<D> for DeltaSph {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        if self.form == DeltaForm::Renormalised {
            offer.stage(density_gradient());
        }
        let laws = setting.laws.iter();
        let smoothing = Smoothing {
            term: Box::new(DeltaTerm {
                smoother: *self,
                sound_speed: laws.map(|law| law.reference().sound_speed).collect(),
            }),
            strength: self.strength,
            accelerated: None,
            of_pressures: false,
        };
        smoothing.offer(setting, offer);
        Ok(())
    }
}

/// Renormalised gradient of the density within the phase.
pub const DENSITY_GRADIENT: Field<Vector> = Field::new(
    "density_gradient",
    "kg/m⁴",
    "gradient of the density within the phase, exact for linear densities",
);

/// ∇ρ_a = [Σ_b V_b (r_b − r_a) ⊗ ∇w_ab]⁻¹ Σ_b V_b (ρ_b − ρ_a) ∇w_ab; nothing where the neighbours span no volume.
fn density_gradient<const D: usize>() -> impl Stage<World<D>> {
    let access = Access::none()
        .both((fields::POSITION, fields::DENSITY, fields::VOLUME))
        .where_there(fields::PHASE)
        .writes(DENSITY_GRADIENT);
    stage("density gradient", access, |world: &mut World<D>| {
        let mut gradients = world.free.take(DENSITY_GRADIENT)?;
        let (density, volume) = world.free.all((fields::DENSITY, fields::VOLUME))?;
        let phase = world.free.get(fields::PHASE).ok();
        let gradient = |around: &Around<'_, D>| {
            let i = around.rows.particle;
            linear_exact(&around.rows.free, volume, |j| {
                let same = phase.is_none_or(|p| p[i] == p[j]);
                same.then(|| density[j] - density[i])
            })
        };
        walk_into(world, Values::Gradient, |_| true, &mut gradients, gradient)?;
        Ok(world.free.put(DENSITY_GRADIENT, gradients)?)
    })
}

/// The term of [`DeltaSph`].
pub struct DeltaTerm {
    smoother: DeltaSph,
    /// Of every phase, m/s.
    sound_speed: Vec<f64>,
}

/// [`DeltaTerm`] with its columns.
#[pair_term(DeltaTerm, "δ-SPH smoother")]
pub struct BoundDelta<'a, const D: usize> {
    #[both(fields::DENSITY)]
    density: &'a [f64],
    #[neighbours(fields::VOLUME)]
    volume: &'a [f64],
    #[both(fields::PHASE, if self.sound_speed.len() > 1)]
    phase: Option<&'a [u32]>,
    #[both(DENSITY_GRADIENT, if self.smoother.form == DeltaForm::Renormalised)]
    gradient: Option<&'a [Vect<D>]>,
    #[value(&self.sound_speed)]
    sound_speed: &'a [f64],
    #[value(2.0 * self.smoother.strength * world.kernel.smoothing_length())]
    weight: f64,
}

#[pair_sum]
impl<const D: usize> BoundDelta<'_, D> {
    const SCALED: bool = true;

    /// Density, its gradient, phase.
    fn own<L: Lane>(&self, all: Particles) -> (L, [L; D], L) {
        let gradient = match self.gradient {
            Some(gradient) => all.vectors(gradient),
            None => [L::splat(0.0); D],
        };
        (all.numbers(self.density), gradient, all.phases(self.phase))
    }

    fn pair<L: Lane>(&self, own: &Self::Own<L>, j: usize, pair: &LanePair<D, L>, sum: &mut L) {
        let zero = L::splat(0.0);
        let linear = match self.gradient {
            Some(g) => {
                let mut both = own.1;
                for k in 0..D {
                    both[k] = L::splat(0.5) * (both[k] + L::splat(g[j][k]));
                }
                dot(&both, &pair.separation)
            }
            None => zero,
        };
        let rise = own.0 - L::splat(self.density[j]) - linear;
        let mut more = L::splat(self.volume[j]) * rise * pair.factor;
        if let Some(phase) = self.phase {
            more = unlike(own.2, phase[j]).where_positive(zero, more);
        }
        *sum += more;
    }

    fn finish(&self, sum: f64, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let c = self.sound_speed[self.phase.map_or(0, |p| p[at.particle] as usize)];
        rates.scalar += self.weight * c * sum * at.inverse_renormalisation;
    }
}
