//! Pressure gradients that are sums over pairs with a symmetric weight.

use sph_core::{Field, Scalar, Vect, fields};
use sph_neighbours::{
    Interaction, Lane, LanePair, Neighbourhood, PairSum, Particles, Rates, WallSet, add_scaled,
    pair_sum, pair_term,
};

/// Pressure, volume and density of one side of a pair.
#[derive(Clone, Copy, Debug)]
pub struct PairState<L = f64> {
    /// p, Pa.
    pub pressure: L,
    /// V, m^d.
    pub volume: L,
    /// ρ, kg/m³.
    pub density: L,
}

impl<L> PairState<L> {
    /// Of p, V and ρ.
    #[inline(always)]
    pub fn new(pressure: L, volume: L, density: L) -> Self {
        PairState {
            pressure,
            volume,
            density,
        }
    }
}

/// The weight P_ab of a pair in m_a a = −1/γ_a [Σ_b θ_b P_ab ∇w_ab − Σ_s P_as/V_s ∇γ_as].
///
/// With walls that scale the kernel, w̃_ab = s_a s_b w_ab, it is m_a a = −Σ_b P_ab s_a s_b ∇w_ab − B_a ∇ln s_a,
/// B_a = P_aa s_a² w(0) + Σ_b P_ab w̃_ab: the gradient of the energy of compression if densities sum w̃. Ours.
pub trait PairPressure: Copy + Send + Sync + 'static {
    /// Name in plans.
    const NAME: &'static str;
    /// The column of the pressure.
    const PRESSURE: Field<Scalar> = fields::PRESSURE;
    /// True if P_ab reads the densities.
    const DENSITY: bool = false;
    /// P_ab = P_ba, Pa m^2d.
    fn pair<L: Lane>(self, here: PairState<L>, there: PairState<L>) -> L;
    /// P_as of a wall.
    #[inline(always)]
    fn at_wall(self, here: PairState, there: PairState) -> f64 {
        self.pair(here, there)
    }
}

/// P_ab = p_a V_a² + p_b V_b²: [`HuAdams`](crate::HuAdams), Ghaïtanellis 2017, Eq. 3.25.
#[derive(Clone, Copy, Debug)]
pub struct SquaredVolumes;

impl PairPressure for SquaredVolumes {
    const NAME: &'static str = "Hu–Adams pressure gradient";
    #[inline(always)]
    fn pair<L: Lane>(self, here: PairState<L>, there: PairState<L>) -> L {
        here.pressure * here.volume * here.volume + there.pressure * there.volume * there.volume
    }
}

/// P_ab = V_a V_b (p_a + p_b): [`ColagrossiLandrini`](crate::ColagrossiLandrini).
#[derive(Clone, Copy, Debug)]
pub struct SumOfPressures;

impl PairPressure for SumOfPressures {
    const NAME: &'static str = "Colagrossi–Landrini pressure gradient";
    #[inline(always)]
    fn pair<L: Lane>(self, here: PairState<L>, there: PairState<L>) -> L {
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
    fn pair<L: Lane>(self, here: PairState<L>, there: PairState<L>) -> L {
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

/// [`PressureGradient`] with its columns.
#[pair_term(PressureGradient<P>, P::NAME)]
pub struct BoundPressureGradient<'a, const D: usize, P: PairPressure> {
    #[value(self.0)]
    weight: P,
    #[both(P::PRESSURE)]
    pressure: &'a [f64],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[both(fields::DENSITY, if P::DENSITY)]
    density: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[value(&world.walls)]
    walls: &'a WallSet<D>,
}

#[pair_sum]
impl<const D: usize, P: PairPressure> BoundPressureGradient<'_, D, P> {
    const SCALED: bool = true;

    fn own<L: Lane>(&self, all: Particles) -> PairState<L> {
        let density = match P::DENSITY {
            true => all.numbers(self.density),
            false => L::splat(0.0),
        };
        PairState::new(
            all.numbers(self.pressure),
            all.numbers(self.volume),
            density,
        )
    }

    /// Σ P ∇w over its separation, and B without the particle's own part.
    fn pair<L: Lane>(
        &self,
        own: &PairState<L>,
        j: usize,
        pair: &LanePair<D, L>,
        sum: &mut ([L; D], L),
    ) {
        let weight = self.weight.pair(*own, self.neighbour_state(j)) * pair.factor;
        add_scaled(&mut sum.0, &pair.separation, weight);
    }

    fn pair_at_walls<L: Lane>(
        &self,
        own: &PairState<L>,
        j: usize,
        pair: &LanePair<D, L>,
        sum: &mut Self::Sum<L>,
    ) {
        sum.1 += self.weight.pair(*own, self.neighbour_state(j)) * pair.value;
    }

    fn finish(&self, sum: ([f64; D], f64), at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let own = self.own::<f64>(Particles::one(at.particle));
        let (mut sum, of_values) = (Vect::from(sum.0), sum.1);
        if let Some(scale) = at.scale() {
            sum += scale.slope * (of_values + self.weight.pair(own, own) * scale.own_value);
        }
        // A wall has no density of its own: it is that of the particle.
        let points = &self.walls.points;
        for (v, pair) in at.wall.pairs() {
            let there = PairState::new(points.pressure[v], points.volume[v], own.density);
            let weight = points.share[v] * self.weight.at_wall(own, there);
            sum += pair.separation * (weight * pair.factor);
        }
        for contact in at.contacts {
            let there = PairState::new(contact.pressure, contact.volume, own.density);
            sum -= contact.gradient * (self.weight.at_wall(own, there) / there.volume);
        }
        let inverse_mass = 1.0 / self.mass[at.particle];
        rates.acceleration -= sum * (inverse_mass * at.inverse_renormalisation);
    }

    fn neighbour_state<L: Lane>(&self, j: usize) -> PairState<L> {
        let density = if P::DENSITY { self.density[j] } else { 0.0 };
        let (pressure, volume) = (L::splat(self.pressure[j]), L::splat(self.volume[j]));
        PairState::new(pressure, volume, L::splat(density))
    }
}
