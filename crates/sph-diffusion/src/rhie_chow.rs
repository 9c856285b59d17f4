//! The Rhie–Chow smoother.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Access, Declares, Field, Stage, StepError, Vect, Vector, fields, register};
use sph_neighbours::{
    BoundTerm, Interaction, Lane, LanePair, LanePairTerm, LaneTerm, Lanewise, Pair, Rates, There,
    World, dot, set,
};

use crate::diffusion_limit::{DiffusionLimit, fastest};
use crate::linear_exact::linear_exact;
use crate::{Smoother, SmootherEntry};
use sph_contribution::{Limiter, Stages};
use sph_neighbours::{Around, Values, walk_into};
use sph_state::Laws;

/// dρ_a/dt += δ (h/c) 2ρ_a/γ_a Σ_b V_b [2/(ρ_a + ρ_b) (p_a − p_b) − ½(s_a + s_b)·r_ab] F_ab over free neighbours of all
/// phases, with the slope s_a = [Σ_b V_b (r_b − r_a) ⊗ ∇w_ab]⁻¹ Σ_b V_b 2/(ρ_a + ρ_b) (p_b − p_a) ∇w_ab.
///
/// Symbols: δ strength; c speed of sound of the fastest phase (m/s), with which δ h/c stands for the source's ΛΔt; p pressure
/// (Pa); V volume (m^d); F = w'/r. The narrow Laplacian of the pressure less what its wide gradient resolves: it sees noise,
/// and needs no gravity part. A linear pressure is left alone wherever it is, beside walls and at surfaces too.
/// One more walk over the neighbours.
///
/// Limits: long waves of sound pass undamped, so that a tank rings until viscosity has stilled it unless it starts settled
/// (`numerics.relax`). Between phases of different density a pressure at rest has a kink, and something of the order of δ g/c
/// is left, 1/s.
///
/// Source: Ghaïtanellis 2017, Eq. 2.96–2.98, corrected: Δt D{G{p}/ρ} is subtracted. Ours: the slope is renormalised and
/// the divergence has the weights of the narrow part. As printed, G⁻{p} = ΣV(p_b − p_a)∇w and D⁺ differ from the narrow part
/// beside walls and surfaces for a linear pressure, and a tank at rest is 6.5 % off. Also ours: the mean density of a pair in
/// s as in the narrow part; printed is G⁻{p}/ρ_a, which next to a phase ρ_b/ρ_a times heavier is as many times too steep.
///
/// ```toml
/// [smoother.rhie-chow]
/// strength = 0.1
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
        RhieChow { strength: 0.1 }
    }
}

impl<const D: usize> Smoother<D> for RhieChow {
    fn stages(&self, _laws: &Laws) -> Stages<D> {
        vec![Box::new(PressureSlope)]
    }
    fn term(&self, laws: &Laws) -> Box<dyn Interaction<D>> {
        Box::new(Lanewise(NarrowLessWide {
            slowness: self.strength / fastest(laws),
        }))
    }
    fn of_pressures(&self) -> bool {
        true
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

/// s, ∇p/ρ.
pub const PRESSURE_SLOPE: Field<Vector> = Field::new(
    "pressure_slope",
    "m/s²",
    "gradient of the pressure over the density of pairs, exact for linear pressures",
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
            .both(fields::VOLUME)
            .writes(PRESSURE_SLOPE)
    }
}

impl<const D: usize> Stage<World<D>> for PressureSlope {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut slopes = world.free.take(PRESSURE_SLOPE)?;
        let pressure = world.free.get(fields::PRESSURE)?;
        let volume = world.free.get(fields::VOLUME)?;
        let density = world.free.get(fields::DENSITY)?;
        let slope = |around: &Around<'_, D>| {
            let i = around.rows.particle;
            linear_exact(&around.rows.free, volume, |j| {
                Some(2.0 * (pressure[j] - pressure[i]) / (density[i] + density[j]))
            })
        };
        walk_into(world, Values::Gradient, |_| true, &mut slopes, slope)?;
        Ok(world.free.put(PRESSURE_SLOPE, slopes)?)
    }
}

/// The term of [`RhieChow`].
#[derive(Clone, Copy, Debug)]
struct NarrowLessWide {
    /// δ/c, s/m.
    slowness: f64,
}

impl<const D: usize> LanePairTerm<D> for NarrowLessWide {
    type Bound<'a> = Bound<'a, D>;

    fn name(&self) -> String {
        "Rhie–Chow smoother".into()
    }

    fn access(&self) -> Access {
        Access::none()
            .both(fields::PRESSURE)
            .both(fields::DENSITY)
            .neighbours(fields::VOLUME)
            .both(PRESSURE_SLOPE)
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        Ok(Bound {
            pressure: world.free.get(fields::PRESSURE)?,
            density: world.free.get(fields::DENSITY)?,
            slope: world.free.get(PRESSURE_SLOPE)?,
            weight: 2.0 * self.slowness * world.kernel.smoothing_length(),
        })
    }
}

/// [`NarrowLessWide`] with its columns.
pub struct Bound<'a, const D: usize> {
    pressure: &'a [f64],
    density: &'a [f64],
    slope: &'a [Vect<D>],
    weight: f64,
}

/// What is read once per particle.
#[derive(Clone, Copy)]
pub struct Own<const D: usize> {
    pressure: f64,
    density: f64,
    slope: Vect<D>,
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    type Here = Own<D>;
    type Sum = f64;

    #[inline(always)]
    fn here(&self, i: usize) -> Own<D> {
        Own {
            pressure: self.pressure[i],
            density: self.density[i],
            slope: self.slope[i],
        }
    }

    #[inline(always)]
    fn zero(&self) -> f64 {
        0.0
    }

    #[inline(always)]
    fn free(&self, own: &Own<D>, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut f64) {
        self.add_one(own, j, there, pair, sum);
    }

    #[inline(always)]
    fn finish(&self, own: &Own<D>, sum: &f64, inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.scalar += self.weight * own.density * sum * inverse_gamma;
    }
}

impl<const D: usize> LaneTerm<D> for Bound<'_, D> {
    /// Pressure, density, slope.
    type Side<L: Lane> = (L, L, [L; D]);
    type Sums<L: Lane> = L;

    #[inline(always)]
    fn side<L: Lane>(&self, here: &[Own<D>]) -> Self::Side<L> {
        let zero = L::splat(0.0);
        let mut side = (zero, zero, [zero; D]);
        for (lane, own) in here.iter().enumerate() {
            side.0.set(lane, own.pressure);
            side.1.set(lane, own.density);
            set(&mut side.2, lane, &own.slope);
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
        own: &Self::Side<L>,
        j: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        sum: &mut L,
    ) {
        let (pressure, density) = (L::splat(there.pressure), L::splat(there.density));
        let volume = L::splat(there.volume);
        let narrow = L::splat(2.0) * (own.0 - pressure) / (own.1 + density);
        let mut slopes = own.2;
        for (slope, other) in slopes.iter_mut().zip(self.slope[j].iter()) {
            *slope = L::splat(0.5) * (*slope + L::splat(*other));
        }
        let wide = dot(&slopes, &pair.separation);
        *sum += volume * (narrow - wide) * pair.factor;
    }
}
