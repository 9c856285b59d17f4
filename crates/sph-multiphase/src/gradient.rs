//! Pressure gradients that are sums over pairs with a symmetric weight.

use sph_core::{Access, StepError, Vect, fields};
use sph_neighbours::{
    BoundTerm, Elements, Interaction, Lane, LanePair, Neighbourhood, PairSum, PairTerm, Particles,
    Rates, World, add_scaled,
};

/// Pressure, volume and density of one side of a pair.
#[derive(Clone, Copy, Debug)]
pub struct Side<L = f64> {
    /// p, Pa.
    pub pressure: L,
    /// V, m^d.
    pub volume: L,
    /// ρ, kg/m³.
    pub density: L,
}

/// The weight P_ab of a pair in m_a a = −1/γ_a [Σ_b θ_b P_ab ∇w_ab − Σ_s P_as/V_s ∇γ_as].
pub trait PairPressure: Copy + Send + Sync + 'static {
    /// Name in plans.
    const NAME: &'static str;
    /// Whether P_ab looks at the densities.
    const DENSITY: bool;
    /// P_ab = P_ba, Pa m^2d.
    fn pair<L: Lane>(self, here: Side<L>, there: Side<L>) -> L;
}

/// P_ab = p_a V_a² + p_b V_b²: [`HuAdams`](crate::HuAdams), Ghaïtanellis 2017, Eq. 3.25.
#[derive(Clone, Copy, Debug)]
pub struct SquaredVolumes;

impl PairPressure for SquaredVolumes {
    const NAME: &'static str = "Hu–Adams pressure gradient";
    const DENSITY: bool = false;
    #[inline(always)]
    fn pair<L: Lane>(self, here: Side<L>, there: Side<L>) -> L {
        here.pressure * here.volume * here.volume + there.pressure * there.volume * there.volume
    }
}

/// P_ab = V_a V_b (p_a + p_b): [`ColagrossiLandrini`](crate::ColagrossiLandrini).
#[derive(Clone, Copy, Debug)]
pub struct SumOfPressures;

impl PairPressure for SumOfPressures {
    const NAME: &'static str = "Colagrossi–Landrini pressure gradient";
    const DENSITY: bool = false;
    #[inline(always)]
    fn pair<L: Lane>(self, here: Side<L>, there: Side<L>) -> L {
        here.volume * there.volume * (here.pressure + there.pressure)
    }
}

/// P_ab = (V_a² + V_b²)(ρ_b p_a + ρ_a p_b)/(ρ_a + ρ_b): [`Krimi`](crate::Krimi).
#[derive(Clone, Copy, Debug)]
pub struct BetweenParticles;

impl PairPressure for BetweenParticles {
    const NAME: &'static str = "Krimi pressure gradient";
    const DENSITY: bool = true;
    #[inline(always)]
    fn pair<L: Lane>(self, here: Side<L>, there: Side<L>) -> L {
        let between = there.density * here.pressure + here.density * there.pressure;
        let volumes = here.volume * here.volume + there.volume * there.volume;
        volumes * between / (here.density + there.density)
    }
}

/// The pressure term with a weight.
#[derive(Clone, Copy, Debug)]
pub struct PressureGradient<P>(pub P);

impl<P: PairPressure> PressureGradient<P> {
    /// As a term of a sweep.
    pub fn boxed<const D: usize>(weight: P) -> Box<dyn Interaction<D>> {
        Box::new(PressureGradient(weight))
    }
}

impl<const D: usize, P: PairPressure> PairTerm<D> for PressureGradient<P> {
    type Bound<'a> = Bound<'a, D, P>;

    fn name(&self) -> String {
        P::NAME.into()
    }

    fn access(&self) -> Access {
        let access = Access::none()
            .both(fields::PRESSURE)
            .both(fields::VOLUME)
            .here(fields::MASS);
        match P::DENSITY {
            true => access.both(fields::DENSITY),
            false => access,
        }
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D, P>, StepError> {
        let points = &world.walls.points;
        Ok(Bound {
            weight: self.0,
            pressure: world.free.get(fields::PRESSURE)?,
            volume: world.free.get(fields::VOLUME)?,
            density: match P::DENSITY {
                true => world.free.get(fields::DENSITY)?,
                false => &[],
            },
            mass: world.free.get(fields::MASS)?,
            wall_pressure: &points.pressure,
            wall_volume: &points.volume,
            wall_share: &points.share,
            elements: &world.walls.elements,
        })
    }
}

/// [`PressureGradient`] with its columns.
pub struct Bound<'a, const D: usize, P> {
    weight: P,
    pressure: &'a [f64],
    volume: &'a [f64],
    density: &'a [f64],
    mass: &'a [f64],
    wall_pressure: &'a [f64],
    wall_volume: &'a [f64],
    wall_share: &'a [f64],
    elements: &'a Elements<D>,
}

impl<const D: usize, P: PairPressure> PairSum<D> for Bound<'_, D, P> {
    type Own<L: Lane> = Side<L>;
    type Sum<L: Lane> = [L; D];

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> Side<L> {
        Side {
            pressure: all.numbers(self.pressure),
            volume: all.numbers(self.volume),
            density: match P::DENSITY {
                true => all.numbers(self.density),
                false => L::splat(0.0),
            },
        }
    }

    #[inline(always)]
    fn pair<L: Lane>(&self, own: &Side<L>, j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let density = if P::DENSITY { self.density[j] } else { 0.0 };
        let there = Side {
            pressure: L::splat(self.pressure[j]),
            volume: L::splat(self.volume[j]),
            density: L::splat(density),
        };
        let weight = self.weight.pair(*own, there) * pair.factor;
        add_scaled(sum, &pair.separation, weight);
    }
}

impl<const D: usize, P: PairPressure> BoundTerm<D> for Bound<'_, D, P> {
    #[inline(always)]
    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let own = self.own::<f64>(Particles::one(at.particle));
        let mut sum = Vect::from(sum);
        // A wall has no density of its own: it is that of the particle.
        for (v, pair) in at.wall.pairs() {
            let there = Side {
                pressure: self.wall_pressure[v],
                volume: self.wall_volume[v],
                density: own.density,
            };
            let weight = self.wall_share[v] * self.weight.pair(own, there);
            sum += pair.separation * (weight * pair.factor);
        }
        for contact in at.contacts {
            let s = contact.element as usize;
            let there = Side {
                pressure: self.elements.pressure[s],
                volume: self.elements.volume[s],
                density: own.density,
            };
            sum -= contact.gradient * (self.weight.pair(own, there) / there.volume);
        }
        let inverse_mass = 1.0 / self.mass[at.particle];
        rates.acceleration -= sum * (inverse_mass * at.inverse_renormalisation);
    }
}
