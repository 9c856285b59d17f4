//! The formulation of Grenier et al. (2009).

use rayon::prelude::*;
use sph_core::{Access, Declares, Evolved, Field, Scalar, Stage, StepError, Vect, fields, plugin};
use sph_neighbours::{
    BoundTerm, Elements, Interaction, Lane, LanePair, Neighbourhood, PairSum, PairTerm, Particles,
    Rates, World, add_scaled, dot, minus,
};

use crate::{Compressed, Diffused, Formulation, FormulationEntry};

use sph_contribution::Stages;
use sph_neighbours::{Around, Values, walk_into};

/// d_a = 1/γ_a Σ_b θ_b V_b w_ab: how full the support is.
pub const KERNEL_SUM: Field<Scalar> = Field::new("kernel_sum", "1", "Σ θ V w / γ");

/// d ln V/dt = D{u}, ρ_a = Σ m_b w_ab / Σ V_b w_ab over the particle's own phase, with
/// D_a{u} = −1/(γ_a d_a) [Σ_b θ_b V_b u_ab·∇w_ab − Σ_s u_as·∇γ_as],
/// G_a{p} = 1/γ_a [Σ_b θ_b V_b (p_a/d_a + p_b/d_b) ∇w_ab − Σ_s (p_a + p_s)/d_a ∇γ_as] and
/// d_a = 1/γ_a Σ_b θ_b V_b w_ab.
///
/// Volumes are integrated; densities are means over the phase and jump where it ends. G is the
/// adjoint of D, but D does not follow from the density: energy is conserved only as far as the
/// mean density is the particle's m/V. Walls have the d of the particle in the sum.
///
/// Source: Ghaïtanellis 2017, Eq. 3.14–3.18; Grenier et al. 2009; the wall terms are ours.
#[plugin(FormulationEntry [2, 3], "grenier", "integrated volumes, densities averaged within the phase",
    source: "Ghaïtanellis 2017, Eq. 3.14–3.18; Grenier et al. 2009", cfg(not(test)))]
pub struct Grenier {}

impl<const D: usize> Formulation<D> for Grenier {
    fn diffused(&self) -> Diffused {
        Diffused {
            evolved: Evolved {
                value: fields::VOLUME,
                rate: fields::VOLUME_RATE,
            },
            per_density: |density, volume, _| -volume / density,
        }
    }
    fn compressed(&self) -> Option<Compressed> {
        Some(Compressed {
            value: fields::VOLUME,
            exponent: 1.0,
        })
    }
    fn stages(&self) -> Stages<D> {
        vec![Box::new(PhaseDensity::default())]
    }
    fn pressure_term(&self) -> Box<dyn Interaction<D>> {
        Box::new(FilledPressure)
    }
    fn divergence(&self) -> Box<dyn Interaction<D>> {
        Box::new(FilledDivergence)
    }
    fn is_scaled(&self) -> bool {
        false
    }
    fn rebase(&self, world: &mut World<D>) -> Result<(), StepError> {
        let mut volume = world.free.take(fields::VOLUME)?;
        let mass = world.free.get(fields::MASS)?;
        let density = world.free.get(fields::DENSITY)?;
        let pairs = mass.iter().zip(density);
        volume
            .iter_mut()
            .zip(pairs)
            .for_each(|(v, (m, rho))| *v = m / rho);
        Ok(world.free.put(fields::VOLUME, volume)?)
    }
}

/// Densities by phase, and how full the supports are.
#[derive(Default)]
struct PhaseDensity {
    /// Density and filling of every particle, on the way to their columns.
    sums: Vec<[f64; 2]>,
}

impl Declares for PhaseDensity {
    fn name(&self) -> String {
        "density by phase".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .both(fields::POSITION)
            .both(fields::MASS)
            .both(fields::VOLUME)
            .where_there(fields::PHASE)
            .writes(fields::DENSITY)
            .writes(KERNEL_SUM)
    }
}

impl<const D: usize> Stage<World<D>> for PhaseDensity {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut density = world.free.take(fields::DENSITY)?;
        let mut kernel_sum = world.free.take(KERNEL_SUM)?;
        let free = &world.free;
        let mass = free.get(fields::MASS)?;
        let volume = free.get(fields::VOLUME)?;
        let phase = free.get(fields::PHASE).ok();
        let points = &world.walls.points;
        let own = world.kernel.value_at_zero();
        let sums = |around: &Around<'_, D>| {
            let (rows, i) = (&around.rows, around.rows.particle);
            let mut sums = [mass[i] * own, volume[i] * own, volume[i] * own];
            for (&j, w) in rows.free.index.iter().zip(around.free) {
                let j = j as usize;
                sums[2] += volume[j] * w;
                if phase.is_none_or(|p| p[i] == p[j]) {
                    sums[0] += mass[j] * w;
                    sums[1] += volume[j] * w;
                }
            }
            for (&v, w) in rows.wall.index.iter().zip(around.wall) {
                sums[2] += points.share[v as usize] * points.volume[v as usize] * w;
            }
            [sums[0] / sums[1], sums[2] * rows.inverse_renormalisation]
        };
        self.sums.resize(density.len(), [0.0; 2]);
        walk_into(world, Values::Both, |_| true, &mut self.sums, sums)?;
        let results = density
            .par_iter_mut()
            .zip(kernel_sum.par_iter_mut())
            .zip(&self.sums);
        results
            .with_min_len(1024)
            .for_each(|((rho, d), sums)| [*rho, *d] = *sums);
        world.free.put(KERNEL_SUM, kernel_sum)?;
        Ok(world.free.put(fields::DENSITY, density)?)
    }
}

macro_rules! columns {
    ($term:ident, $bound:ident, $name:literal) => {
        impl<const D: usize> PairTerm<D> for $term {
            type Bound<'a> = $bound<'a, D>;
            fn name(&self) -> String {
                $name.into()
            }
            fn access(&self) -> Access {
                Access::none()
                    .both(fields::PRESSURE)
                    .both(fields::VOLUME)
                    .both(KERNEL_SUM)
                    .both(fields::VELOCITY)
                    .here(fields::MASS)
            }
            fn bind<'a>(&'a self, world: &'a World<D>) -> Result<$bound<'a, D>, StepError> {
                Ok($bound(Columns {
                    pressure: world.free.get(fields::PRESSURE)?,
                    volume: world.free.get(fields::VOLUME)?,
                    kernel_sum: world.free.get(KERNEL_SUM)?,
                    velocity: world.free.get(fields::VELOCITY)?,
                    mass: world.free.get(fields::MASS)?,
                    wall_pressure: &world.walls.points.pressure,
                    wall_volume: &world.walls.points.volume,
                    wall_velocity: &world.walls.points.velocity,
                    wall_share: &world.walls.points.share,
                    elements: &world.walls.elements,
                }))
            }
        }
    };
}

/// Columns of both terms.
struct Columns<'a, const D: usize> {
    pressure: &'a [f64],
    volume: &'a [f64],
    kernel_sum: &'a [f64],
    velocity: &'a [Vect<D>],
    mass: &'a [f64],
    wall_pressure: &'a [f64],
    wall_volume: &'a [f64],
    wall_velocity: &'a [Vect<D>],
    wall_share: &'a [f64],
    elements: &'a Elements<D>,
}

/// The pressure term of [`Grenier`].
pub struct FilledPressure;
/// [`FilledPressure`] with its columns.
pub struct BoundPressure<'a, const D: usize>(Columns<'a, D>);
columns!(FilledPressure, BoundPressure, "Grenier pressure gradient");

/// The divergence of [`Grenier`].
pub struct FilledDivergence;
/// [`FilledDivergence`] with its columns.
pub struct BoundDivergence<'a, const D: usize>(Columns<'a, D>);
columns!(FilledDivergence, BoundDivergence, "Grenier divergence");

impl<const D: usize> PairSum<D> for BoundPressure<'_, D> {
    /// p/d.
    type Own<L: Lane> = L;
    type Sum<L: Lane> = [L; D];

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> L {
        all.numbers::<L>(self.0.pressure) / all.numbers(self.0.kernel_sum)
    }
    #[inline(always)]
    fn pair<L: Lane>(&self, own: &L, j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let c = &self.0;
        let both = *own + L::splat(c.pressure[j] / c.kernel_sum[j]);
        let weight = L::splat(c.volume[j]) * both * pair.factor;
        add_scaled(sum, &pair.separation, weight);
    }
}

impl<const D: usize> BoundTerm<D> for BoundPressure<'_, D> {
    #[inline(always)]
    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let (c, i) = (&self.0, at.particle);
        let (own, inverse) = (c.pressure[i], 1.0 / c.kernel_sum[i]);
        let mut sum = Vect::from(sum);
        for (v, pair) in at.wall.pairs() {
            let pressure = (own + c.wall_pressure[v]) * inverse;
            sum += pair.separation * (c.wall_share[v] * c.wall_volume[v] * pressure * pair.factor);
        }
        for contact in at.contacts {
            sum -= contact.gradient * ((own + contact.pressure) * inverse);
        }
        rates.acceleration -= sum * (c.volume[i] / c.mass[i] * at.inverse_renormalisation);
    }
}

impl<const D: usize> PairSum<D> for BoundDivergence<'_, D> {
    type Own<L: Lane> = [L; D];
    type Sum<L: Lane> = L;

    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> [L; D] {
        all.vectors(self.0.velocity)
    }
    #[inline(always)]
    fn pair<L: Lane>(&self, own: &[L; D], j: usize, pair: &LanePair<D, L>, sum: &mut L) {
        let apart = dot(&minus(own, &self.0.velocity[j]), &pair.separation);
        *sum -= L::splat(self.0.volume[j]) * apart * pair.factor;
    }
}

impl<const D: usize> BoundTerm<D> for BoundDivergence<'_, D> {
    #[inline(always)]
    fn finish(&self, mut sum: f64, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let (c, i) = (&self.0, at.particle);
        let velocity = c.velocity[i];
        for (v, pair) in at.wall.pairs() {
            let apart = (velocity - c.wall_velocity[v]).dot(&pair.separation);
            sum -= c.wall_share[v] * c.wall_volume[v] * apart * pair.factor;
        }
        for contact in at.contacts {
            let wall = c.elements.velocity_at(&contact);
            sum += (velocity - wall).dot(&contact.gradient);
        }
        rates.scalar += sum * (1.0 / c.kernel_sum[i]) * at.inverse_renormalisation;
    }
}
