//! Surface tension as a continuous surface stress.

use sph_contribution::{Contribution, Limiter, Offer, Refusal, Setting, bound};
use sph_core::{Access, Stage, Vect, fields, parameters, plugin, stage};
use sph_neighbours::{
    Around, Lane, LanePair, Neighbourhood, Particles, Rates, Values, World, dot, pair_sum,
    pair_term, splat, walk_into,
};

use crate::contact_angle::{ContactAngle, FILM};
use crate::{InterfaceEntry, offer_interface};

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
#[plugin(InterfaceEntry [2, 3], "surface-tension", "surface tension between phases as a surface stress",
    source: "Hu & Adams 2006", cfg(not(test)))]
pub struct SurfaceTension {
    /// Surface tension σ.
    #[parameter(unit: "N/m", min: 0.0, source: "Hu & Adams 2006")]
    pub tension: f64,
    /// The isotropic part of the stress.
    #[parameter(default, source: "Lafaurie et al. 1994; Hu & Adams 2006")]
    pub stress: SurfaceStress,
    /// Angle at which interfaces meet walls; 90° if left out.
    #[parameter(source: "Young 1805")]
    pub contact_angle: Option<ContactAngle>,
}

/// The isotropic part of the surface stress.
#[parameters]
pub enum SurfaceStress {
    /// σ|∇c| I: tension along the interface, nothing across it.
    #[default]
    Full,
    /// σ|∇c| I/d: no trace; the pressure has a dip inside the interface.
    TraceFree,
}

impl<const D: usize> Contribution<D> for SurfaceTension {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer_interface(Box::new(self.clone()), setting, offer)?;
        offer.stage(colour_gradient());
        if let Some(angle) = &self.contact_angle {
            angle.check(setting)?;
            offer.stage(angle.films(setting));
        }
        if self.tension > 0.0 {
            offer.limiter(capillary_limit(self.tension));
        }
        Ok(())
    }
}

sph_core::fields! {
    /// Gradient of the colour of all other phases.
    pub COLOUR_GRADIENT: Vector = "colour_gradient", "1/m", "gradient of the share of all other phases";
}

fn colour_gradient<const D: usize>() -> impl Stage<World<D>> {
    let access = Access::none()
        .both((fields::POSITION, fields::PHASE, fields::VOLUME))
        .writes(COLOUR_GRADIENT);
    stage("colour gradient", access, |world: &mut World<D>| {
        let mut gradients = world.free.take(COLOUR_GRADIENT)?;
        let (phase, volume) = world.free.all((fields::PHASE, fields::VOLUME))?;
        let gradient = |around: &Around<'_, D>| {
            let i = around.rows.particle;
            let mut sum = Vect::<D>::zeros();
            for (j, pair) in around.rows.free.pairs() {
                if phase[j] != phase[i] {
                    sum += pair.separation * (volume[j] * volume[j] * pair.factor);
                }
            }
            sum * (around.rows.inverse_renormalisation / volume[i])
        };
        walk_into(world, Values::Gradient, |_| true, &mut gradients, gradient)?;
        Ok(world.free.put(COLOUR_GRADIENT, gradients)?)
    })
}

/// [`SurfaceTension`] with its columns.
#[pair_term(SurfaceTension, "surface tension")]
pub struct BoundSurfaceTension<'a, const D: usize> {
    #[both(COLOUR_GRADIENT)]
    colour: &'a [Vect<D>],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    /// Empty where the scene has no contact angle.
    #[both(FILM, if self.contact_angle.is_some())]
    film: &'a [Vect<D>],
    #[value(self.tension)]
    tension: f64,
    #[value(match self.stress {
        SurfaceStress::Full => 1.0,
        SurfaceStress::TraceFree => 1.0 / D as f64,
    })]
    isotropic: f64,
}

/// σV² (|∇c| ι I − ∇c∇c/|∇c|).
#[derive(Clone, Copy)]
pub struct Stress<const D: usize, L> {
    isotropic: L,
    /// σV²/|∇c|.
    along: L,
    colour: [L; D],
}

impl<const D: usize> Stress<D, f64> {
    #[inline(always)]
    fn new(colour: Vect<D>, scale: f64, isotropic: f64) -> Self {
        let size = colour.norm();
        Stress {
            isotropic: scale * size * isotropic,
            along: if size > 0.0 { scale / size } else { 0.0 },
            colour: colour.into(),
        }
    }

    /// Of several particles.
    #[inline(always)]
    fn each<L: Lane>(all: Particles, of: impl Fn(usize) -> Self) -> Stress<D, L> {
        let [isotropic, along] = all.each(|i| {
            let stress = of(i);
            [stress.isotropic, stress.along]
        });
        Stress {
            isotropic,
            along,
            colour: all.each(|i| of(i).colour),
        }
    }

    #[inline(always)]
    fn splat<L: Lane>(self) -> Stress<D, L> {
        Stress {
            isotropic: L::splat(self.isotropic),
            along: L::splat(self.along),
            colour: splat(&Vect::from(self.colour)),
        }
    }
}

impl<const D: usize, L: Lane> Stress<D, L> {
    #[inline(always)]
    fn dot(&self, r: &[L; D]) -> [L; D] {
        let along = self.along * dot(&self.colour, r);
        let mut force = *r;
        for (force, colour) in force.iter_mut().zip(self.colour) {
            *force = *force * self.isotropic - colour * along;
        }
        force
    }

    /// (own + other)·r F.
    #[inline(always)]
    fn add_to(&self, sum: &mut [L; D], other: &Self, pair: &LanePair<D, L>) {
        let (own, other) = (self.dot(&pair.separation), other.dot(&pair.separation));
        for (sum, (own, other)) in sum.iter_mut().zip(own.into_iter().zip(other)) {
            *sum += (own + other) * pair.factor;
        }
    }
}

#[pair_sum]
impl<const D: usize> BoundSurfaceTension<'_, D> {
    /// Stresses of the interface and of the film.
    fn own<L: Lane>(&self, all: Particles) -> [Stress<D, L>; 2] {
        let stress = Stress::each(all, |i| self.stress(i));
        [stress, Stress::each(all, |i| self.film(i))]
    }

    fn pair<L: Lane>(&self, own: &Self::Own<L>, j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        own[0].add_to(sum, &self.stress(j).splat(), pair);
        if !self.film.is_empty() {
            own[1].add_to(sum, &self.film(j).splat(), pair);
        }
    }

    /// Without 1/γ: the gain of one particle is the loss of another.
    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        rates.acceleration += Vect::from(sum) * (1.0 / self.mass[at.particle]);
    }

    /// That of the interface at a particle.
    fn stress(&self, i: usize) -> Stress<D, f64> {
        let scale = self.tension * self.volume[i] * self.volume[i];
        Stress::new(self.colour[i], scale, self.isotropic)
    }

    /// That of the film at a particle, which is compressed; nothing where the scene has no contact angle.
    fn film(&self, i: usize) -> Stress<D, f64> {
        let volume = self.volume[i];
        let film = self.film.get(i).copied().unwrap_or_else(Vect::zeros);
        Stress::new(film, -self.tension * volume * volume, 1.0)
    }
}

/// Δt ≤ ¼ √(ρ h³/2πσ).
fn capillary_limit<const D: usize>(tension: f64) -> impl Limiter<D> {
    let formula = "surface tension: dt <= 0.25 sqrt(ρ h³ / 2πσ)";
    bound("surface tension", formula, None, move |world: &World<D>| {
        let density = world.free.get(fields::DENSITY)?;
        let least = density.iter().copied().fold(f64::INFINITY, f64::min);
        let h = world.kernel.smoothing_length();
        let shortest = least * h.powi(3) / (std::f64::consts::TAU * tension);
        Ok(0.25 * shortest.sqrt())
    })
}
