//! Dissipation between phases.

use std::sync::Arc;

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Access, StepError, StepLimit, Vect, fields, register};
use sph_neighbours::{
    BoundTerm, Contact, Elements, Lane, LanePair, LanePairTerm, LaneTerm, Lanewise, Pair, Rates,
    There, WallPoints, World, add_scaled, dot, minus, set, splat, unlike, vector,
};

use crate::scattered::{SCATTERED, Scattered};
use crate::{InterfaceEntry, offer_interface};
use sph_contribution::{Contribution, Limiter, Offer, Refusal, Setting};
use sph_neighbours::lattice_sum;
use sph_state::Laws;

/// m_a a = h Σ_b 2 m_a m_b/(ρ_a + ρ_b) v_ab (u_ab·r_ab)/r² ∇w_ab over the pairs with at least one particle that
/// is not of the heaviest phase, with v = α χ c̄ (unlike phases only) + β min(h |u_ab·r_ab|/r², c̄) (closing pairs only).
///
/// Symbols: c̄ mean of the reference speeds of sound (m/s); χ the larger [`SCATTERED`] of the two: 1 for a light
/// particle alone among heavy ones, 0 for one at a closed interface, which is left to the viscosities of the phases.
/// A light particle caught in a heavy fluid follows every unevenness of the pressure there, and a soft gas that is
/// squeezed out leaves with up to five times its speed of sound. α takes the motion of light particles towards and away from heavy
/// neighbours back at a rate of 3.5 α χ c̄/h (in 2D, Wendland C2); β stops what would run through the light
/// phase faster than sound. Walls stand in for the heaviest phase. Conserves momentum and angular momentum between
/// particles, never adds energy. With χ = 1 everywhere it would be a viscosity of the order of α c̄ h/8 times the
/// density of the light phase, which holds the front of a dam break back. In one of air and water (842:1) 2 and 2
/// keep the air below four times the largest speed of the water (30 spacings to its depth).
///
/// Source: Monaghan 1992, Annu. Rev. Astron. Astrophys. 30, Eq. 4.1–4.2; the choice of pairs, χ, α for
/// separating pairs too, the bound of β's part and the wall part are ours.
///
/// ```toml
/// [interface.artificial-viscosity]
/// strength = 2.0
/// shocks = 2.0
/// ```
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct InterfaceFriction {
    /// Strength α.
    #[schemars(
        range(min = 0.0, max = 10.0),
        extend("unit" = "1", "source" = "Monaghan 1992: 0.01 to 1")
    )]
    pub strength: f64,
    /// Strength β.
    #[schemars(
        range(min = 0.0, max = 10.0),
        extend("unit" = "1", "source" = "Monaghan 1992: 1 to 2")
    )]
    pub shocks: f64,
}

impl Default for InterfaceFriction {
    fn default() -> Self {
        InterfaceFriction {
            strength: 2.0,
            shocks: 2.0,
        }
    }
}

impl<const D: usize> Contribution<D> for InterfaceFriction {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let damping = Damping::of(self, setting.laws);
        let light = damping.wall_density.iter();
        offer.stage(Scattered {
            light: light.map(|density| *density > 0.0).collect(),
        });
        offer.limiter(DampingLimit(damping.clone()));
        offer_interface(Box::new(Lanewise(damping)), setting, offer)
    }
}

#[cfg(not(test))]
register!(
    InterfaceEntry [2, 3],
    InterfaceFriction,
    "artificial-viscosity",
    "dissipation between phases, for light particles in a heavy fluid",
    "Monaghan 1992, Eq. 4.1–4.2"
);

/// The term of [`InterfaceFriction`] with the speeds of sound of the phases.
#[derive(Clone, Debug)]
struct Damping {
    strength: f64,
    shocks: f64,
    sound: Arc<[f64]>,
    /// Density that walls have for a phase, kg/m³: that of the heaviest, nothing for that itself.
    wall_density: Arc<[f64]>,
}

impl Damping {
    fn of(friction: &InterfaceFriction, laws: &Laws) -> Self {
        let density = laws.iter().map(|l| l.reference().density);
        let heaviest = density.clone().fold(0.0, f64::max);
        let behind_wall = |rho: f64| if rho < heaviest { heaviest } else { 0.0 };
        Damping {
            strength: friction.strength,
            shocks: friction.shocks,
            sound: laws.iter().map(|l| l.reference().sound_speed).collect(),
            wall_density: density.map(behind_wall).collect(),
        }
    }
}

/// Δt ≤ 1/λ for the rate λ at which a light particle among heavy ones is stopped, if it closes with them at the speed of sound.
/// With the present speed in its place the step would be 1.2 times as long, and single particles of air fast enough to fail.
struct DampingLimit(Damping);

impl<const D: usize> Limiter<D> for DampingLimit {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let fastest = self.0.sound.iter().fold(0.0, |a: f64, c| a.max(*c));
        let sum = lattice_sum(world, |pair| {
            -pair.factor * pair.separation[0].powi(2) / pair.distance2
        });
        let cell = world.spacing.powi(D as i32);
        let strength = self.0.strength + self.0.shocks;
        let rate = 2.0 * strength * world.kernel.smoothing_length() * fastest * sum * cell;
        Ok(StepLimit::new("interface friction", 1.0 / rate))
    }
    fn formula(&self) -> String {
        "interface friction: dt <= 1/rate at which a light particle is stopped".into()
    }
}

impl<const D: usize> LanePairTerm<D> for Damping {
    type Bound<'a> = Bound<'a, D>;

    fn name(&self) -> String {
        "artificial viscosity between phases".into()
    }

    fn access(&self) -> Access {
        Access::none()
            .both(fields::VELOCITY)
            .both(fields::MASS)
            .both(fields::DENSITY)
            .both(fields::PHASE)
            .both(SCATTERED)
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        let h = world.kernel.smoothing_length();
        Ok(Bound {
            strength: self.strength,
            shocks: self.shocks,
            length: h,
            sound: &self.sound,
            wall_density: &self.wall_density,
            points: &world.walls.points,
            elements: &world.walls.elements,
            mass: world.free.get(fields::MASS)?,
            phase: world.free.get(fields::PHASE)?,
            density: world.free.get(fields::DENSITY)?,
            scattered: world.free.get(SCATTERED)?,
            velocity: world.free.get(fields::VELOCITY)?,
        })
    }
}

/// [`Damping`] with its columns.
struct Bound<'a, const D: usize> {
    strength: f64,
    shocks: f64,
    length: f64,
    sound: &'a [f64],
    wall_density: &'a [f64],
    points: &'a WallPoints<D>,
    elements: &'a Elements<D>,
    mass: &'a [f64],
    phase: &'a [u32],
    density: &'a [f64],
    scattered: &'a [f64],
    velocity: &'a [Vect<D>],
}

/// What is read once per particle.
#[derive(Clone, Copy)]
struct Own<const D: usize> {
    phase: u32,
    density: f64,
    scattered: f64,
    sound: f64,
    wall_density: f64,
    velocity: Vect<D>,
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    type Here = Own<D>;
    type Sum = Vect<D>;

    #[inline(always)]
    fn here(&self, i: usize) -> Own<D> {
        let phase = self.phase[i];
        Own {
            phase,
            density: self.density[i],
            scattered: self.scattered[i],
            sound: self.sound[phase as usize],
            wall_density: self.wall_density[phase as usize],
            velocity: self.velocity[i],
        }
    }

    #[inline(always)]
    fn zero(&self) -> Vect<D> {
        Vect::zeros()
    }

    #[inline(always)]
    fn free(&self, own: &Own<D>, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut Vect<D>) {
        self.add_one(own, j, there, pair, sum);
    }

    #[inline(always)]
    fn wall(&self, own: &Own<D>, v: usize, pair: &Pair<D>, sum: &mut Vect<D>) {
        let behind = own.wall_density * self.points.share[v] * self.points.volume[v];
        let relative = own.velocity - self.points.velocity[v];
        let mass = behind / (own.density + own.wall_density);
        *sum += self.along(own, &relative, pair) * mass;
    }

    #[inline(always)]
    fn element(&self, own: &Own<D>, contact: &Contact<D>, sum: &mut Vect<D>) {
        let s = contact.element as usize;
        let normal = self.elements.normal[s];
        let leaving = (own.velocity - self.elements.velocity[s]).dot(&normal);
        let density = own.wall_density / (own.density + own.wall_density);
        let distance = contact.distance.max(0.5 * self.length);
        let rate = self.signal(own, leaving) * contact.gradient.norm() / distance;
        *sum -= normal * (density * rate * leaving);
    }

    /// Without 1/γ: what one particle gets, another loses.
    #[inline(always)]
    fn finish(&self, _own: &Own<D>, sum: &Vect<D>, _inverse_gamma: f64, rates: &mut Rates<D>) {
        rates.acceleration += sum * (2.0 * self.length);
    }
}

impl<const D: usize> Bound<'_, D> {
    /// v, for a particle and a wall that part at a speed.
    #[inline(always)]
    fn signal(&self, own: &Own<D>, parting: f64) -> f64 {
        let steady = self.strength * own.scattered * own.sound;
        steady + self.shocks * (-parting).clamp(0.0, own.sound)
    }

    /// v (u·r)/r² ∇w of a wall point; nothing for two in one place.
    #[inline(always)]
    fn along(&self, own: &Own<D>, relative: &Vect<D>, pair: &Pair<D>) -> Vect<D> {
        let rate = relative.dot(&pair.separation) / pair.distance2.max(f64::MIN_POSITIVE);
        let signal = self.signal(own, rate * self.length);
        pair.separation * (signal * rate * pair.factor)
    }
}

/// [`Own`] of several particles; phases are small whole numbers, exact as any.
#[derive(Clone, Copy)]
struct Side<const D: usize, L> {
    phase: L,
    density: L,
    scattered: L,
    sound: L,
    wall_density: L,
    velocity: [L; D],
}

impl<const D: usize> LaneTerm<D> for Bound<'_, D> {
    type Side<L: Lane> = Side<D, L>;
    type Sums<L: Lane> = [L; D];

    #[inline(always)]
    fn side<L: Lane>(&self, here: &[Own<D>]) -> Side<D, L> {
        let zero = L::splat(0.0);
        let mut side = Side {
            phase: zero,
            density: zero,
            scattered: zero,
            sound: zero,
            wall_density: zero,
            velocity: [zero; D],
        };
        for (lane, own) in here.iter().enumerate() {
            side.phase.set(lane, f64::from(own.phase));
            side.density.set(lane, own.density);
            side.scattered.set(lane, own.scattered);
            side.sound.set(lane, own.sound);
            side.wall_density.set(lane, own.wall_density);
            set(&mut side.velocity, lane, &own.velocity);
        }
        side
    }

    #[inline(always)]
    fn sums<L: Lane>(&self, sum: &Vect<D>) -> [L; D] {
        splat(sum)
    }

    #[inline(always)]
    fn lane<L: Lane>(&self, sums: &[L; D], lane: usize) -> Vect<D> {
        vector(sums, lane)
    }

    #[inline(always)]
    fn add<L: Lane>(
        &self,
        own: &Side<D, L>,
        j: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        sums: &mut [L; D],
    ) {
        let zero = L::splat(0.0);
        let phase = self.phase[j];
        let unlike = unlike(own.phase, phase);
        // Positive where a pair counts: unlike phases, and pairs of a light one.
        let counts = unlike + own.wall_density;
        if !zero.any_less(counts) {
            return;
        }
        let sound = L::splat(0.5) * (own.sound + L::splat(self.sound[phase as usize]));
        let mass = L::splat(self.mass[j]) / (own.density + L::splat(there.density));
        let relative = dot(&minus(&own.velocity, &there.velocity), &pair.separation);
        let rate = relative / pair.distance2.max(L::splat(f64::MIN_POSITIVE));
        let other = L::splat(self.scattered[j]);
        let scattered = (own.scattered - other).where_positive(own.scattered, other);
        let steady = L::splat(self.strength) * scattered * sound;
        let steady = unlike.where_positive(steady, zero);
        let closing = -(rate * L::splat(self.length));
        let closing = closing.where_positive(closing, zero);
        let closing = (closing - sound).where_positive(sound, closing);
        let signal = steady + L::splat(self.shocks) * closing;
        let weight = counts.where_positive(signal * rate * pair.factor, zero);
        add_scaled(sums, &pair.separation.map(|r| r * weight), mass);
    }
}
