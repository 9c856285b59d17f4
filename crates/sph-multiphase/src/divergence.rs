//! Discrete divergences of the velocity.

use sph_core::{Field, Scalar, Vect, fields};
use sph_neighbours::{
    Interaction, Lane, LanePair, Neighbourhood, Particles, Rates, WallSet, dot, minus, pair_sum,
    pair_term,
};

/// d_a = 1/γ_a Σ_b θ_b V_b w_ab: how full the support is.
pub const KERNEL_SUM: Field<Scalar> = Field::new("kernel_sum", "1", "Σ θ V w / γ");

/// The weight of a pair in D_a{u} = −1/γ_a [Σ_b θ_b W_ab u_ab·∇w_ab − Σ_s W_as/V_s u_as·∇γ_as].
///
/// With walls that scale the kernel it is D_a{u} = −Σ_b W_ab s_a s_b [u_ab·∇w_ab + w_ab (σ_a + σ_b)], b = a included,
/// σ_a = d ln s_a/dt = u_a·∇ln s_a + ∂ ln s_a/∂t.
pub trait DivergenceWeight: Copy + Send + Sync + 'static {
    /// Name in plans.
    const NAME: &'static str;
    /// True if D is divided by the kernel sum.
    const FILLED: bool = false;
    /// W from the volumes and densities here and there.
    fn weight<L: Lane>(self, volume: L, density: L, there: L, there_density: L) -> L;
    /// W/V_s of a wall element from the volume and density here and its volume.
    #[inline(always)]
    fn at_element(self, volume: f64, density: f64, there: f64) -> f64 {
        self.weight(volume, density, there, density) / there
    }
}

/// W = V_a: belongs to [`HuAdams`](crate::HuAdams), Ghaïtanellis 2017, Eq. 3.26.
#[derive(Clone, Copy, Debug)]
pub struct OwnVolume;

impl DivergenceWeight for OwnVolume {
    const NAME: &'static str = "Hu–Adams divergence";
    #[inline(always)]
    fn weight<L: Lane>(self, volume: L, _: L, _: L, _: L) -> L {
        volume
    }
}

/// W = V_a and W/V_s = 1: −D lnρ_a/Dt of the density sum ρ = (K + mΣθw)/γ with constant K, to rounding. It differs from
/// [`OwnVolume`] where elements of walls have another volume than the particle.
#[derive(Clone, Copy, Debug)]
pub struct SumVolume;

impl DivergenceWeight for SumVolume {
    const NAME: &'static str = "rate of the density sum";
    #[inline(always)]
    fn weight<L: Lane>(self, volume: L, _: L, _: L, _: L) -> L {
        volume
    }
    #[inline(always)]
    fn at_element(self, _: f64, _: f64, _: f64) -> f64 {
        1.0
    }
}

/// W = V_b: belongs to [`ColagrossiLandrini`](crate::ColagrossiLandrini), Ghaïtanellis 2017, Eq. 3.4.
#[derive(Clone, Copy, Debug)]
pub struct NeighbourVolume;

impl DivergenceWeight for NeighbourVolume {
    const NAME: &'static str = "Colagrossi–Landrini divergence";
    #[inline(always)]
    fn weight<L: Lane>(self, _: L, _: L, there: L, _: L) -> L {
        there
    }
}

/// W = V_b, over d_a: belongs to [`Grenier`](crate::Grenier), Ghaïtanellis 2017, Eq. 3.14.
#[derive(Clone, Copy, Debug)]
pub struct FilledVolume;

impl DivergenceWeight for FilledVolume {
    const NAME: &'static str = "Grenier divergence";
    const FILLED: bool = true;
    #[inline(always)]
    fn weight<L: Lane>(self, _: L, _: L, there: L, _: L) -> L {
        there
    }
    #[inline(always)]
    fn at_element(self, _: f64, _: f64, _: f64) -> f64 {
        1.0
    }
}

/// W = (V_a² + V_b²)/V_a · ρ_b/(ρ_a + ρ_b): the adjoint of the gradient of [`Krimi`](crate::Krimi); derived here.
#[derive(Clone, Copy, Debug)]
pub struct DensityWeighted;

impl DivergenceWeight for DensityWeighted {
    const NAME: &'static str = "Krimi divergence";
    #[inline(always)]
    fn weight<L: Lane>(self, volume: L, density: L, there: L, there_density: L) -> L {
        (volume * volume + there * there) / volume * there_density / (density + there_density)
    }
}

/// The term of D{u} with a weight.
#[derive(Clone, Copy, Debug)]
pub struct Divergence<W>(pub W);

impl<W: DivergenceWeight> Divergence<W> {
    /// As a term of a sweep.
    pub fn boxed<const D: usize>(weight: W) -> Box<dyn Interaction<D>> {
        Box::new(Divergence(weight))
    }
}

/// [`Divergence`] with its columns.
#[pair_term(Divergence<W>, W::NAME)]
pub struct BoundVelocityDivergence<'a, const D: usize, W: DivergenceWeight> {
    #[value(self.0)]
    weight: W,
    #[both(fields::VELOCITY)]
    velocity: &'a [Vect<D>],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[both(fields::DENSITY)]
    density: &'a [f64],
    #[both(KERNEL_SUM, if W::FILLED)]
    kernel_sum: &'a [f64],
    #[where_there(fields::SCALE_SLOPE)]
    slope: Option<&'a [Vect<D>]>,
    #[where_there(fields::SCALE_RATE)]
    rate: Option<&'a [f64]>,
    #[value(&world.walls)]
    walls: &'a WallSet<D>,
}

#[pair_sum]
impl<const D: usize, W: DivergenceWeight> BoundVelocityDivergence<'_, D, W> {
    const SCALED: bool = true;

    /// Velocity, volume, density, d ln s/dt.
    fn own<L: Lane>(&self, all: Particles) -> ([L; D], L, L, L) {
        let (volume, density) = (all.numbers(self.volume), all.numbers(self.density));
        let scale = match self.slope {
            Some(_) => all.each(|i| [self.scale_rate(i)])[0],
            None => L::splat(0.0),
        };
        (all.vectors(self.velocity), volume, density, scale)
    }

    fn pair<L: Lane>(&self, own: &Self::Own<L>, j: usize, pair: &LanePair<D, L>, sum: &mut L) {
        let (volume, density) = (L::splat(self.volume[j]), L::splat(self.density[j]));
        let weight = self.weight.weight(own.1, own.2, volume, density);
        let apart = dot(&minus(&own.0, &self.velocity[j]), &pair.separation);
        *sum -= weight * apart * pair.factor;
    }

    fn pair_at_walls<L: Lane>(
        &self,
        own: &Self::Own<L>,
        j: usize,
        pair: &LanePair<D, L>,
        sum: &mut L,
    ) {
        let (volume, density) = (L::splat(self.volume[j]), L::splat(self.density[j]));
        let weight = self.weight.weight(own.1, own.2, volume, density);
        *sum -= weight * pair.value * (own.3 + L::splat(self.scale_rate(j)));
    }

    fn finish(&self, mut sum: f64, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let i = at.particle;
        let (velocity, volume, density) = (self.velocity[i], self.volume[i], self.density[i]);
        if let Some(scale) = at.scale() {
            let weight = self.weight.weight(volume, density, volume, density);
            sum -= weight * 2.0 * scale.own_value * self.scale_rate(i);
        }
        for (v, pair) in at.wall.pairs() {
            let there = self.walls.points.volume[v];
            let weight = self.weight.weight(volume, density, there, density);
            let apart = (velocity - self.walls.points.velocity[v]).dot(&pair.separation);
            sum -= self.walls.points.share[v] * weight * apart * pair.factor;
        }
        for contact in at.contacts {
            let weight = self.weight.at_element(volume, density, contact.volume);
            let wall = self.walls.elements.velocity_at(&contact);
            sum += weight * (velocity - wall).dot(&contact.gradient);
        }
        if W::FILLED {
            sum *= 1.0 / self.kernel_sum[i];
        }
        rates.scalar += sum * at.inverse_renormalisation;
    }

    /// σ = d ln s/dt of a particle, 1/s.
    fn scale_rate(&self, i: usize) -> f64 {
        let along = self.slope.map_or(0.0, |g| g[i].dot(&self.velocity[i]));
        along + self.rate.map_or(0.0, |rate| rate[i])
    }
}
