//! The Rhie–Chow smoother.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Access, Declares, Field, Stage, StepError, Vect, Vector, fields, register};
use sph_neighbours::{BoundTerm, Interaction, Pair, PairTerm, Rates, Term, There, World};

use crate::diffusion_limit::{DiffusionLimit, fastest};
use crate::{Laws, Limiter, Smoother, SmootherEntry, Stages};
use sph_neighbours::{Around, Values, walk};

/// dρ_a/dt += δ (h/c) ρ_a [L_a{1/ρ, p} − D⁺_a{G⁻{1/ρ, p}}], over free neighbours, with
/// L_a = 2/γ_a Σ_b V_b 2/(ρ_a + ρ_b) (p_a − p_b) F_ab,
/// G⁻_a{1/ρ, p} = −V_a/γ_a Σ_b 2/(ρ_a + ρ_b) (p_a − p_b) ∇w_ab and
/// D⁺_a{A} = 1/(γ_a V_a) Σ_b (A_a V_a² + A_b V_b²)·∇w_ab.
///
/// Symbols: δ strength; c speed of sound of the fastest phase (m/s), with which δ h/c stands for the source's ΛΔt; p pressure (Pa); V volume (m^d); F = w'/r. The difference of a narrow and a
/// wide Laplacian: it sees noise and not what the wide one resolves, so it needs no gravity part.
/// One more walk over the neighbours.
///
/// Limits: next to walls and surfaces the two parts differ for a linear pressure. In a tank at rest
/// it is worse than [`BrezziPitkaranta`](crate::BrezziPitkaranta): 7.6 % instead of 0.9 % of the
/// bottom pressure after 4 s.
///
/// Source: Ghaïtanellis 2017, Eq. 2.96–2.98, corrected: Δt D{G{p}/ρ} is subtracted; volume form of
/// Ghaïtanellis et al. 2018, Eq. 24–26. With the mean density of a pair in G⁻ as in L, ours: printed is G⁻{p}/ρ_a, which next to a
/// phase ρ_b/ρ_a times heavier is as many times too steep, and fills or empties the light phase there.
///
/// ```toml
/// [smoother.rhie-chow]
/// strength = 0.4
/// ```
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RhieChow {
    /// Strength δ: the diffusivity of the density over h c.
    #[schemars(
        range(min = 0.0, max = 4.0),
        extend("unit" = "1", "source" = "Antuono et al. 2010; Ghaïtanellis 2017, Eq. 2.101: 0.4 Λ")
    )]
    pub strength: f64,
}

impl Default for RhieChow {
    fn default() -> Self {
        RhieChow { strength: 0.4 }
    }
}

impl<const D: usize> Smoother<D> for RhieChow {
    fn stages(&self, _laws: &Laws) -> Stages<D> {
        vec![Box::new(PressureSlope)]
    }
    fn term(&self, laws: &Laws) -> Box<dyn Interaction<D>> {
        Box::new(Term(NarrowLessWide {
            slowness: self.strength / fastest(laws),
        }))
    }
    fn limiter(&self, laws: &Laws) -> Option<Box<dyn Limiter<D>>> {
        DiffusionLimit::of(self.strength, laws)
    }
}

register!(
    SmootherEntry [2, 3],
    RhieChow,
    "rhie-chow",
    "pressure diffusion less what the wide stencil resolves",
    "Ghaïtanellis 2017, Eq. 2.96–2.98"
);

/// G⁻{p}/ρ.
pub const PRESSURE_SLOPE: Field<Vector> = Field::new(
    "pressure_slope",
    "m/s²",
    "gradient of the pressure over the density, from differences between free neighbours",
);

/// [`PRESSURE_SLOPE`].
struct PressureSlope;

impl Declares for PressureSlope {
    fn name(&self) -> String {
        "pressure slope".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .both(fields::POSITION)
            .both(fields::PRESSURE)
            .both(fields::DENSITY)
            .here(fields::VOLUME)
            .writes(PRESSURE_SLOPE)
    }
}

impl<const D: usize> Stage<World<D>> for PressureSlope {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let pressure = world.free.get(fields::PRESSURE)?;
        let volume = world.free.get(fields::VOLUME)?;
        let density = world.free.get(fields::DENSITY)?;
        let slopes = walk(world, Values::Gradient, |around: &Around<'_, D>| {
            let (row, i) = (&around.rows.free, around.rows.particle);
            let mut sum = Vect::<D>::zeros();
            for (k, &j) in row.index.iter().enumerate() {
                let j = j as usize;
                let rise = (pressure[j] - pressure[i]) / (density[i] + density[j]);
                sum += row.separation[k] * (rise * row.factor[k]);
            }
            sum * (2.0 * volume[i] * around.rows.inverse_renormalisation)
        })?;
        Ok(world.free.put(PRESSURE_SLOPE, slopes)?)
    }
}

/// The term of [`RhieChow`].
#[derive(Clone, Copy, Debug)]
struct NarrowLessWide {
    /// δ/c, s/m.
    slowness: f64,
}

impl<const D: usize> PairTerm<D> for NarrowLessWide {
    type Bound<'a> = Bound<'a, D>;

    fn name(&self) -> String {
        "Rhie–Chow smoother".into()
    }

    fn access(&self) -> Access {
        Access::none()
            .both(fields::PRESSURE)
            .both(fields::DENSITY)
            .both(fields::VOLUME)
            .both(PRESSURE_SLOPE)
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        Ok(Bound {
            pressure: world.free.get(fields::PRESSURE)?,
            density: world.free.get(fields::DENSITY)?,
            volume: world.free.get(fields::VOLUME)?,
            slope: world.free.get(PRESSURE_SLOPE)?,
            weight: self.slowness * world.kernel.smoothing_length(),
        })
    }
}

/// [`NarrowLessWide`] with its columns.
pub struct Bound<'a, const D: usize> {
    pressure: &'a [f64],
    density: &'a [f64],
    volume: &'a [f64],
    slope: &'a [Vect<D>],
    weight: f64,
}

/// What is read once per particle.
#[derive(Clone, Copy)]
pub struct Own<const D: usize> {
    pressure: f64,
    density: f64,
    inverse_volume: f64,
    /// A_a V_a².
    weighted: Vect<D>,
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    type Here = Own<D>;
    type Sum = f64;

    #[inline(always)]
    fn here(&self, i: usize) -> Own<D> {
        let volume = self.volume[i];
        Own {
            pressure: self.pressure[i],
            density: self.density[i],
            inverse_volume: 1.0 / volume,
            weighted: self.slope[i] * (volume * volume),
        }
    }

    #[inline(always)]
    fn zero(&self) -> f64 {
        0.0
    }

    #[inline(always)]
    fn free(&self, own: &Own<D>, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut f64) {
        let narrow =
            4.0 * there.volume * (own.pressure - there.pressure) / (own.density + there.density);
        let both = own.weighted + self.slope[j] * (there.volume * there.volume);
        let wide = both.dot(&pair.separation) * own.inverse_volume;
        *sum += (narrow - wide) * pair.factor;
    }

    #[inline(always)]
    fn finish(&self, own: &Own<D>, sum: &f64, inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.scalar += self.weight * own.density * sum * inverse_gamma;
    }
}
