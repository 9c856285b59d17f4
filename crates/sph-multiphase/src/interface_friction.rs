//! Dissipation between phases, and light particles that are scattered in a heavy fluid.

use sph_contribution::{Contribution, Limiter, Offer, Refusal, Setting, bound};
use sph_core::{Access, Field, Scalar, Stage, Vect, fields, plugin, stage};
use sph_neighbours::{
    Around, Elements, Lane, LanePair, Neighbourhood, Pair, PairSum, Particles, Rates, Values,
    WallPoints, World, add_scaled, dot, lattice_sum, minus, pair_sum, pair_term, unlike, walk_into,
};

use crate::{InterfaceEntry, offer_interface};

/// m_a a = h Σ_b 2 m_a m_b/(ρ_a + ρ_b) v_ab (u_ab·r_ab)/r² ∇w_ab over the pairs with at least one particle that
/// is not of the heaviest phase, with v = α χ c̄ (unlike phases only) + β min(h |u_ab·r_ab|/r², c̄) (closing pairs only).
///
/// Symbols: c̄ mean of the reference speeds of sound (m/s); χ the larger [`DISPERSED_FRACTION`] of the two: 1 for a
/// light particle alone among heavy ones, 0 for one at a closed interface, which is left to the viscosities of the
/// phases. A light particle caught in a heavy fluid follows every unevenness of the pressure there, and a soft gas that
/// is squeezed out leaves with up to five times its speed of sound. α takes the motion of light particles towards and
/// away from heavy neighbours back at a rate of 3.5 α χ c̄/h (in 2D, Wendland C2); β stops particles that would run
/// through the light phase faster than sound. Walls stand in for the heaviest phase. Conserves momentum and angular
/// momentum between particles, never adds energy. With χ = 1 everywhere it would be a viscosity of the order of α c̄
/// h/8 times the density of the light phase, which holds the front of a dam break back. In one of air and water (842:1)
/// 2 and 2 keep the air below four times the largest speed of the water (30 spacings to its depth).
///
/// Source: Monaghan 1992, Annu. Rev. Astron. Astrophys. 30, Eq. 4.1–4.2; the choice of pairs, χ, α for
/// separating pairs too, the bound of β's part and the wall part are ours.
///
/// ```toml
/// [interface.artificial-viscosity]
/// strength = 2.0
/// shocks = 2.0
/// ```
#[plugin(InterfaceEntry [2, 3], "artificial-viscosity",
    "dissipation between phases, for light particles in a heavy fluid", source: "Monaghan 1992, Eq. 4.1–4.2",
    cfg(not(test)))]
pub struct InterfaceFriction {
    /// Strength α.
    #[parameter(default: 2.0, unit: "1", min: 0.0, max: 10.0, source: "Monaghan 1992: 0.01 to 1")]
    pub strength: f64,
    /// Strength β.
    #[parameter(default: 2.0, unit: "1", min: 0.0, max: 10.0, source: "Monaghan 1992: 1 to 2")]
    pub shocks: f64,
}

impl<const D: usize> Contribution<D> for InterfaceFriction {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let phases = || setting.laws.iter().map(|law| law.reference());
        let heaviest = phases().map(|r| r.density).fold(0.0, f64::max);
        let behind_wall = |rho: f64| if rho < heaviest { heaviest } else { 0.0 };
        let damping = Damping {
            friction: *self,
            sound: phases().map(|r| r.sound_speed).collect(),
            wall_density: phases().map(|r| behind_wall(r.density)).collect(),
        };
        let light = damping.wall_density.iter();
        let light = light.map(|density| *density > 0.0).collect();
        offer.stage(dispersed_fraction(light));
        let fastest = damping.sound.iter().fold(0.0, |a: f64, c| a.max(*c));
        offer.limiter(damping_limit(*self, fastest));
        offer_interface(Box::new(damping), setting, offer)
    }
}

/// The term of [`InterfaceFriction`] with the speeds of sound of the phases.
struct Damping {
    friction: InterfaceFriction,
    sound: Vec<f64>,
    /// Density that walls have for a phase, kg/m³: that of the heaviest, nothing for that itself.
    wall_density: Vec<f64>,
}

/// Δt ≤ 1/λ for the rate λ at which a light particle among heavy ones is stopped, if it closes with them at the speed of sound.
/// With the present speed in its place the step would be 1.2 times as long, and single particles of air fast enough to fail.
fn damping_limit<const D: usize>(friction: InterfaceFriction, fastest: f64) -> impl Limiter<D> {
    let formula = "interface friction: dt <= 1/rate at which a light particle is stopped";
    let dt = move |world: &World<D>| {
        let along = |pair: &Pair<D>| -pair.factor * pair.separation[0].powi(2) / pair.distance2;
        let sum = lattice_sum(world, along);
        let cell = world.spacing.powi(D as i32);
        let strength = friction.strength + friction.shocks;
        Ok(1.0 / (2.0 * strength * world.kernel.smoothing_length() * fastest * sum * cell))
    };
    bound("interface friction", formula, None, dt)
}

#[pair_term(Damping, "artificial viscosity between phases")]
struct BoundInterfaceFriction<'a, const D: usize> {
    #[value(self)]
    term: &'a Damping,
    #[value(world.kernel.smoothing_length())]
    length: f64,
    #[value(&world.walls.points)]
    points: &'a WallPoints<D>,
    #[value(&world.walls.elements)]
    elements: &'a Elements<D>,
    #[both(fields::MASS)]
    mass: &'a [f64],
    #[both(fields::PHASE)]
    phase: &'a [u32],
    #[both(fields::DENSITY)]
    density: &'a [f64],
    #[both(DISPERSED_FRACTION)]
    dispersed_fraction: &'a [f64],
    #[both(fields::VELOCITY)]
    velocity: &'a [Vect<D>],
}

#[derive(Clone, Copy)]
struct Own<const D: usize, L> {
    phase: L,
    density: L,
    dispersed_fraction: L,
    sound: L,
    wall_density: L,
    velocity: [L; D],
}

#[pair_sum]
impl<const D: usize> BoundInterfaceFriction<'_, D> {
    fn own<L: Lane>(&self, all: Particles) -> Own<D, L> {
        let [sound, wall_density] = all.each(|i| {
            let phase = self.phase[i] as usize;
            [self.term.sound[phase], self.term.wall_density[phase]]
        });
        Own {
            phase: all.phases(Some(self.phase)),
            density: all.numbers(self.density),
            dispersed_fraction: all.numbers(self.dispersed_fraction),
            sound,
            wall_density,
            velocity: all.vectors(self.velocity),
        }
    }

    fn pair<L: Lane>(&self, own: &Own<D, L>, j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let zero = L::splat(0.0);
        let phase = self.phase[j];
        let unlike = unlike(own.phase, phase);
        // Positive where a pair counts: unlike phases, and pairs of a light one.
        let counts = unlike + own.wall_density;
        if !zero.any_less(counts) {
            return;
        }
        let sound = L::splat(0.5) * (own.sound + L::splat(self.term.sound[phase as usize]));
        let mass = L::splat(self.mass[j]) / (own.density + L::splat(self.density[j]));
        let relative = dot(&minus(&own.velocity, &self.velocity[j]), &pair.separation);
        let rate = relative / pair.distance2.max(L::splat(f64::MIN_POSITIVE));
        let other = L::splat(self.dispersed_fraction[j]);
        let dispersed_fraction =
            (own.dispersed_fraction - other).where_positive(own.dispersed_fraction, other);
        let steady = L::splat(self.term.friction.strength) * dispersed_fraction * sound;
        let steady = unlike.where_positive(steady, zero);
        let closing = -(rate * L::splat(self.length));
        let closing = closing.where_positive(closing, zero);
        let closing = (closing - sound).where_positive(sound, closing);
        let signal = steady + L::splat(self.term.friction.shocks) * closing;
        let weight = counts.where_positive(signal * rate * pair.factor, zero);
        add_scaled(sum, &pair.separation.map(|r| r * weight), mass);
    }

    /// Without 1/γ: the gain of one particle is the loss of another.
    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let own = self.own::<f64>(Particles::one(at.particle));
        let velocity = self.velocity[at.particle];
        let mut sum = Vect::from(sum);
        for (v, pair) in at.wall.pairs() {
            let behind = own.wall_density * self.points.share[v] * self.points.volume[v];
            let relative = velocity - self.points.velocity[v];
            let mass = behind / (own.density + own.wall_density);
            // Nothing for two in one place.
            let rate = relative.dot(&pair.separation) / pair.distance2.max(f64::MIN_POSITIVE);
            let signal = self.signal(&own, rate * self.length);
            sum += pair.separation * (signal * rate * pair.factor) * mass;
        }
        for contact in at.contacts {
            let normal = self.elements.normal[contact.element as usize];
            let leaving = (velocity - self.elements.velocity_at(&contact)).dot(&normal);
            let density = own.wall_density / (own.density + own.wall_density);
            let distance = contact.distance.max(0.5 * self.length);
            let rate = self.signal(&own, leaving) * contact.gradient.norm() / distance;
            sum -= normal * (density * rate * leaving);
        }
        rates.acceleration += sum * (2.0 * self.length);
    }

    /// v, for a particle and a wall that part at a speed.
    fn signal(&self, own: &Own<D, f64>, parting: f64) -> f64 {
        let InterfaceFriction { strength, shocks } = self.term.friction;
        let steady = strength * own.dispersed_fraction * own.sound;
        steady + shocks * (-parting).clamp(0.0, own.sound)
    }
}

/// Isolation of a light particle from its phase: 1 alone, 0 where its phase has half of the support or more.
///
/// χ_a = max(0, 1 − 2φ_a), φ_a = Σ_{b ≠ a, of the phase of a} V_b w_ab / (1 − V_a w(0)). Walls are none of its
/// phase. A flat interface half a spacing away leaves φ = 0.64 in two dimensions with h = 2 δr, and χ = 0.
pub const DISPERSED_FRACTION: Field<Scalar> = Field::new(
    "dispersed_fraction",
    "1",
    "1 for a light particle alone in another phase, 0 where its own has half of the support",
);

/// [`DISPERSED_FRACTION`] of all phases but the heaviest, which has 0; 0 as well where there is nothing to rub on.
/// `light` marks phases that are lighter than another.
pub(crate) fn dispersed_fraction<const D: usize>(light: Vec<bool>) -> impl Stage<World<D>> {
    let access = Access::none()
        .both((fields::POSITION, fields::PHASE, fields::VOLUME))
        .writes(DISPERSED_FRACTION);
    let name = "scattered light particles";
    stage(name, access, move |world: &mut World<D>| {
        let mut dispersed_fraction = world.free.take(DISPERSED_FRACTION)?;
        dispersed_fraction.fill(0.0);
        let (phase, volume) = world.free.all((fields::PHASE, fields::VOLUME))?;
        let own = world.kernel.value_at_zero();
        let share = |around: &Around<'_, D>| {
            let i = around.rows.particle;
            let all = std::iter::zip(around.rows.free.index, around.free);
            let like = all.filter(|(j, _)| **j as usize != i && phase[**j as usize] == phase[i]);
            let like: f64 = like.map(|(j, w)| volume[*j as usize] * w).sum();
            let others = (1.0 - volume[i] * own).max(f64::MIN_POSITIVE);
            (1.0 - 2.0 * like / others).max(0.0)
        };
        // Inside a light phase it is not read: friction is with another phase or with a wall.
        let (lists, walls) = (world.lists.nearest(), &world.walls);
        let beside = |i: usize| {
            let mut near = lists.candidates(i).iter();
            near.any(|j| phase[*j as usize] != phase[i])
                || !walls.contacts.of_particle(i).is_empty()
                || walls.points.in_sums() && !world.lists.wall.candidates(i).is_empty()
        };
        let wanted = |i: usize| light[phase[i] as usize] && beside(i);
        walk_into(world, Values::Both, wanted, &mut dispersed_fraction, share)?;
        Ok(world.free.put(DISPERSED_FRACTION, dispersed_fraction)?)
    })
}
