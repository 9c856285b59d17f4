//! Source of the viscosity of pair terms: one number, or a column with means of pairs.

use sph_core::{Access, StepError, fields, parameters};
use sph_neighbours::{Lane, Particles, World, unlike};

use crate::viscosity::interface_distance::INTERFACE_DISTANCE;

/// Mean viscosity of pairs of one phase.
#[parameters]
pub enum Within {
    /// 2 η_a η_b/(η_a + η_b): continuous shear stress; scatter of the viscosities lowers it.
    #[default]
    Harmonic,
    /// (η_a + η_b)/2: scatter does not change it; for laws whose stress matters at rest.
    Arithmetic,
}

/// A source of viscosities for a pair term.
#[derive(Clone, Copy, Debug)]
pub enum ViscositySource {
    /// The same viscosity everywhere, Pa s.
    Uniform(f64),
    /// The viscosity column, with means of pairs: harmonic is Ghaïtanellis 2017, Eq. 3.30.
    PerParticle(Within),
    /// The viscosity column, with means of two layers in series across interfaces:
    /// η̄ = (d_a + d_b)/(d_a/η_a + d_b/η_b) for particles of two phases at d from their interface.
    ///
    /// With it a first difference of a velocity with continuous shear stress is τ r·n/η̄, whatever the
    /// place of the interface between the two; the harmonic mean has it in the middle. Ours.
    /// Pairs of one phase have the mean that is given.
    InSeries(Within),
}

impl ViscositySource {
    /// Columns read.
    pub fn access(self) -> Access {
        match self {
            Self::Uniform(_) => Access::none(),
            Self::PerParticle(_) => Access::none().both(fields::VISCOSITY),
            Self::InSeries(_) => {
                Access::none().both((fields::VISCOSITY, fields::PHASE, INTERFACE_DISTANCE))
            }
        }
    }

    /// Looks the columns up.
    ///
    /// # Errors
    /// If one is missing.
    pub fn bind<const D: usize>(self, world: &World<D>) -> Result<BoundViscosity<'_>, StepError> {
        let column = || world.free.get(fields::VISCOSITY);
        Ok(match self {
            Self::Uniform(eta) => BoundViscosity::Uniform(eta),
            Self::PerParticle(within) => BoundViscosity::Column(column()?, within, None),
            Self::InSeries(within) => {
                let layers = Layers {
                    phase: world.free.get(fields::PHASE)?,
                    distance: world.free.get(INTERFACE_DISTANCE)?,
                };
                BoundViscosity::Column(column()?, within, Some(layers))
            }
        })
    }
}

/// Phases of particles and their distances from the interface, m.
#[derive(Clone, Copy, Debug)]
pub struct Layers<'a> {
    phase: &'a [u32],
    distance: &'a [f64],
}

/// A [`ViscositySource`] with its columns.
#[derive(Clone, Copy, Debug)]
pub enum BoundViscosity<'a> {
    /// The same viscosity everywhere, Pa s.
    Uniform(f64),
    /// The viscosities of the particles, the mean of pairs of one phase, and layers in series where there are some.
    Column(&'a [f64], Within, Option<Layers<'a>>),
}

/// Columns of a mean at the particle itself, or several: phases are small whole numbers, exact as any.
#[derive(Clone, Copy, Debug)]
pub struct OwnViscosity<L> {
    /// η, Pa s.
    pub eta: L,
    phase: L,
    distance: L,
}

impl BoundViscosity<'_> {
    /// Reads the own values.
    #[inline(always)]
    pub fn own<L: Lane>(&self, all: Particles) -> OwnViscosity<L> {
        let zero = L::splat(0.0);
        let (eta, layers) = match self {
            Self::Uniform(eta) => (L::splat(*eta), &None),
            Self::Column(column, _, layers) => (all.numbers(column), layers),
        };
        let (phase, distance) = match layers {
            Some(layers) => (all.phases(Some(layers.phase)), all.numbers(layers.distance)),
            None => (zero, zero),
        };
        OwnViscosity {
            eta,
            phase,
            distance,
        }
    }

    /// η of a neighbour, Pa s.
    #[inline(always)]
    pub fn at(&self, neighbour: usize) -> f64 {
        match self {
            Self::Uniform(eta) => *eta,
            Self::Column(column, ..) => column[neighbour],
        }
    }

    /// Means of the particles and one neighbour, Pa s.
    #[inline(always)]
    pub fn means<L: Lane>(&self, here: &OwnViscosity<L>, j: usize) -> L {
        let Self::Column(column, within, layers) = self else {
            return here.eta;
        };
        let there = L::splat(column[j]);
        let alike = mean(*within, here.eta, there);
        let Some(layers) = layers else {
            return alike;
        };
        let unlike = unlike(here.phase, layers.phase[j]);
        // Most pairs are of one phase.
        if !L::splat(0.0).any_less(unlike) {
            return alike;
        }
        let mixed = in_series(here.distance, here.eta, L::splat(layers.distance[j]), there);
        unlike.where_positive(mixed, alike)
    }
}

#[inline(always)]
fn mean<L: Lane>(within: Within, eta: L, other: L) -> L {
    match within {
        Within::Harmonic => in_series(L::splat(1.0), eta, L::splat(1.0), other),
        Within::Arithmetic => L::splat(0.5) * (eta + other),
    }
}

/// (d_a + d_b)/(d_a/η_a + d_b/η_b); zero viscosity on either side means no friction, not 0/0.
#[inline(always)]
fn in_series<L: Lane>(here: L, eta: L, there: L, other: L) -> L {
    let sum = here * other + there * eta;
    sum.where_positive((here + there) * eta * other / sum, L::splat(0.0))
}
