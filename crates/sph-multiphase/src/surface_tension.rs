//! Surface tension as a continuous surface stress.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sph_core::{
    Access, Declares, Field, Stage, StepError, StepLimit, Vect, Vector, fields, register,
};
use sph_neighbours::{BoundTerm, Pair, PairTerm, Rates, Term, There, World};

use crate::contact_angle::{ContactAngle, FILM};
use crate::{InterfaceEntry, offer_interface};

use sph_contribution::{Contribution, Limiter, Offer, Refusal, Setting};

use sph_neighbours::{Around, Values, walk_into};

/// m_a a = Σ_b (V_a² Π_a + V_b² Π_b)·∇w_ab with the surface stress
/// Π = σ/|∇c| (|∇c|² ι I − ∇c ∇c) and the gradient of the colour of all other phases,
/// ∇c_a = 1/V_a Σ_{b of other phases} V_b² ∇w_ab.
///
/// Symbols: σ surface tension (N/m); V volume (m^d); ι = 1, or 1/d for the `trace-free` stress of
/// the source, with d the dimension; |∇c| integrates to 1 across an interface. The pressure jumps by σκ. The
/// stress is summed like the pressure gradient: momentum is conserved to rounding, and there is no
/// curvature to compute. Without a trace the pressure has a dip of σ|∇c|(1 − 1/d) inside the
/// interface, which opens gaps there and which smoothers fill: a disc of radius 5 h that lay still
/// for 0.4 s had 1.01 σ/R with the full stress and 0.88 σ/R with the other.
///
/// A background pressure of σ/h holds the interface together, and so does shifting. Smoothers see
/// the jump as noise; a weak one is best.
///
/// Limits: Δt ≤ ¼ √(ρ h³/2πσ) with the least density; a radius below about 3 h is not resolved; the
/// same tension between all phases.
///
/// Interfaces end at walls: nothing there holds them along the wall, so that they stand upright, at 90°. With a
/// `contact_angle` θ the phase that wets a wall has a film on it with the tension −σ|cos θ|, which is what the energies of
/// the wall with both phases leave in Young's law, σ cos θ = σ_wall,other − σ_wall,phase. The film is a surface stress, too,
/// with 2 ∇γ/γ in place of ∇c: |∇γ| integrates to ½ from the wall on, and γ is the share of the partners across a cut.
///
/// Source: Hu & Adams 2006, with the isotropic part of Lafaurie et al. 1994; the limit of Brackbill et al. 1992 with ¼.
///
/// ```toml
/// [interface.surface-tension]
/// tension = 0.072
/// ```
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceTension {
    /// Surface tension σ.
    #[schemars(
        range(min = 0.0),
        extend("unit" = "N/m", "source" = "Hu & Adams 2006")
    )]
    pub tension: f64,
    /// Which isotropic part the stress has.
    #[serde(default)]
    #[schemars(extend("source" = "Lafaurie et al. 1994; Hu & Adams 2006"))]
    pub stress: SurfaceStress,
    /// Angle at which interfaces meet walls; 90° if left out.
    #[schemars(extend("source" = "Young 1805"))]
    pub contact_angle: Option<ContactAngle>,
}

/// The isotropic part of the surface stress.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SurfaceStress {
    /// σ|∇c| I: tension along the interface, nothing across it.
    #[default]
    Full,
    /// σ|∇c| I/d: no trace; the pressure has a dip inside the interface.
    TraceFree,
}

impl<const D: usize> Contribution<D> for SurfaceTension {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer_interface(Box::new(Term(self.clone())), setting, offer)?;
        offer.stage(ColourGradient);
        if let Some(angle) = &self.contact_angle {
            angle.check(setting)?;
            offer.stage(angle.films(setting));
        }
        if self.tension > 0.0 {
            offer.limiter(CapillaryLimit(self.tension));
        }
        Ok(())
    }
}

#[cfg(not(test))]
register!(
    InterfaceEntry [2, 3],
    SurfaceTension,
    "surface-tension",
    "surface tension between phases as a surface stress",
    "Hu & Adams 2006"
);

/// Gradient of the colour of all other phases.
pub const COLOUR_GRADIENT: Field<Vector> = Field::new(
    "colour_gradient",
    "1/m",
    "gradient of the share of all other phases",
);

/// [`COLOUR_GRADIENT`].
struct ColourGradient;

impl Declares for ColourGradient {
    fn name(&self) -> String {
        "colour gradient".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .both(fields::POSITION)
            .both(fields::PHASE)
            .both(fields::VOLUME)
            .writes(COLOUR_GRADIENT)
    }
}

impl<const D: usize> Stage<World<D>> for ColourGradient {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut gradients = world.free.take(COLOUR_GRADIENT)?;
        let phase = world.free.get(fields::PHASE)?;
        let volume = world.free.get(fields::VOLUME)?;
        let gradient = |around: &Around<'_, D>| {
            let (row, i) = (&around.rows.free, around.rows.particle);
            let mut sum = Vect::<D>::zeros();
            for (k, &j) in row.index.iter().enumerate() {
                let j = j as usize;
                if phase[j] != phase[i] {
                    sum += row.separation[k] * (volume[j] * volume[j] * row.factor[k]);
                }
            }
            sum * (around.rows.inverse_renormalisation / volume[i])
        };
        walk_into(world, Values::Gradient, |_| true, &mut gradients, gradient)?;
        Ok(world.free.put(COLOUR_GRADIENT, gradients)?)
    }
}

impl<const D: usize> PairTerm<D> for SurfaceTension {
    type Bound<'a> = Bound<'a, D>;

    fn name(&self) -> String {
        "surface tension".into()
    }

    fn access(&self) -> Access {
        let access = Access::none()
            .both(COLOUR_GRADIENT)
            .both(fields::VOLUME)
            .here(fields::MASS);
        match &self.contact_angle {
            Some(_) => access.both(FILM),
            None => access,
        }
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        Ok(Bound {
            colour: world.free.get(COLOUR_GRADIENT)?,
            volume: world.free.get(fields::VOLUME)?,
            mass: world.free.get(fields::MASS)?,
            film: match &self.contact_angle {
                Some(_) => world.free.get(FILM)?,
                None => &[],
            },
            tension: self.tension,
            isotropic: match self.stress {
                SurfaceStress::Full => 1.0,
                SurfaceStress::TraceFree => 1.0 / D as f64,
            },
        })
    }
}

/// [`SurfaceTension`] with its columns.
pub struct Bound<'a, const D: usize> {
    colour: &'a [Vect<D>],
    volume: &'a [f64],
    mass: &'a [f64],
    /// Empty where the scene has no contact angle.
    film: &'a [Vect<D>],
    tension: f64,
    isotropic: f64,
}

impl<const D: usize> Bound<'_, D> {
    /// Stress of the film at a particle, which is compressed.
    #[inline(always)]
    fn film(&self, i: usize, volume: f64) -> Option<Stress<D>> {
        let film = self.film.get(i)?;
        Some(Stress::of(*film, -self.tension * volume * volume, 1.0))
    }
}

/// σV² (|∇c| ι I − ∇c∇c/|∇c|) of one particle.
#[derive(Clone, Copy)]
pub struct Stress<const D: usize> {
    isotropic: f64,
    /// σV²/|∇c|.
    along: f64,
    colour: Vect<D>,
}

impl<const D: usize> Stress<D> {
    #[inline(always)]
    fn of(colour: Vect<D>, scale: f64, isotropic: f64) -> Self {
        let size = colour.norm();
        Stress {
            isotropic: scale * size * isotropic,
            along: if size > 0.0 { scale / size } else { 0.0 },
            colour,
        }
    }
    #[inline(always)]
    fn dot(&self, r: &Vect<D>) -> Vect<D> {
        r * self.isotropic - self.colour * (self.along * self.colour.dot(r))
    }
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    /// Stress, 1/m and the stress of the film.
    type Here = (Stress<D>, f64, Option<Stress<D>>);
    type Sum = Vect<D>;

    #[inline(always)]
    fn here(&self, i: usize) -> Self::Here {
        let v = self.volume[i];
        let stress = Stress::of(self.colour[i], self.tension * v * v, self.isotropic);
        (stress, 1.0 / self.mass[i], self.film(i, v))
    }

    #[inline(always)]
    fn zero(&self) -> Vect<D> {
        Vect::zeros()
    }

    #[inline(always)]
    fn free(
        &self,
        here: &Self::Here,
        j: usize,
        there: &There<D>,
        pair: &Pair<D>,
        sum: &mut Vect<D>,
    ) {
        let volume = there.volume;
        let scale = self.tension * volume * volume;
        let there = Stress::of(self.colour[j], scale, self.isotropic);
        *sum += (here.0.dot(&pair.separation) + there.dot(&pair.separation)) * pair.factor;
        if let (Some(here), Some(there)) = (&here.2, self.film(j, volume)) {
            *sum += (here.dot(&pair.separation) + there.dot(&pair.separation)) * pair.factor;
        }
    }

    /// Without 1/γ: what one particle gets, another loses.
    #[inline(always)]
    fn finish(&self, here: &Self::Here, sum: &Vect<D>, _inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.acceleration += sum * here.1;
    }
}

/// Δt ≤ ¼ √(ρ h³/2πσ).
struct CapillaryLimit(f64);

impl<const D: usize> Limiter<D> for CapillaryLimit {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let density = world.free.get(fields::DENSITY)?;
        let least = density.iter().copied().fold(f64::INFINITY, f64::min);
        let h = world.kernel.smoothing_length();
        let shortest = least * h.powi(3) / (std::f64::consts::TAU * self.0);
        Ok(StepLimit::new("surface tension", 0.25 * shortest.sqrt()))
    }
    fn formula(&self) -> String {
        "surface tension: dt <= 0.25 sqrt(ρ h³ / 2πσ)".into()
    }
}
