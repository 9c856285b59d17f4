//! Where pair terms read the viscosity: one number, or a column with means of pairs.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Access, StepError, fields};
use sph_neighbours::{Lane, World, unlike};

use crate::interface_distance::INTERFACE_DISTANCE;

/// A source of viscosities for a pair term.
pub trait ViscositySource: Copy + Send + Sync + 'static {
    /// The source with its column.
    type Bound<'a>: BoundViscosity + 'a;
    /// Columns read.
    fn access(self) -> Access;
    /// Looks the column up.
    ///
    /// # Errors
    /// If the column is missing.
    fn bind<const D: usize>(self, world: &World<D>) -> Result<Self::Bound<'_>, StepError>;
}

/// Viscosities of particles and pairs.
pub trait BoundViscosity: Copy + Sync {
    /// What is read once per particle.
    type Here: Copy;
    /// The same of several particles.
    type Side<L: Lane>: Copy;
    /// Puts what was read of several particles side by side.
    fn side<L: Lane>(&self, here: &[Self::Here]) -> Self::Side<L>;
    /// η of the particles themselves, Pa s.
    fn owns<L: Lane>(&self, here: &Self::Side<L>) -> L;
    /// Means of the particles and one neighbour, Pa s.
    fn means<L: Lane>(&self, here: &Self::Side<L>, neighbour: usize) -> L;
    /// Reads the particle's own values.
    fn here(&self, particle: usize) -> Self::Here;
    /// η of the particle itself, Pa s.
    fn own(&self, here: &Self::Here) -> f64;
    /// η of a neighbour, Pa s.
    fn at(&self, neighbour: usize) -> f64;
    /// Mean of a pair, Pa s.
    #[inline(always)]
    fn mean(&self, here: &Self::Here, neighbour: usize) -> f64 {
        self.means::<f64>(&self.side(std::slice::from_ref(here)), neighbour)
    }
}

/// The same viscosity everywhere, Pa s.
#[derive(Clone, Copy, Debug)]
pub struct Uniform(pub f64);

impl ViscositySource for Uniform {
    type Bound<'a> = Uniform;
    fn access(self) -> Access {
        Access::none()
    }
    fn bind<const D: usize>(self, _world: &World<D>) -> Result<Uniform, StepError> {
        Ok(self)
    }
}

impl BoundViscosity for Uniform {
    type Here = ();
    type Side<L: Lane> = ();
    #[inline(always)]
    fn side<L: Lane>(&self, _here: &[()]) {}
    #[inline(always)]
    fn owns<L: Lane>(&self, _here: &()) -> L {
        L::splat(self.0)
    }
    #[inline(always)]
    fn means<L: Lane>(&self, _here: &(), _neighbour: usize) -> L {
        L::splat(self.0)
    }
    #[inline(always)]
    fn here(&self, _particle: usize) {}
    #[inline(always)]
    fn own(&self, _here: &()) -> f64 {
        self.0
    }
    #[inline(always)]
    fn at(&self, _neighbour: usize) -> f64 {
        self.0
    }
}

/// Mean viscosity of pairs of one phase.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Within {
    /// 2 η_a η_b/(η_a + η_b): continuous shear stress; scatter of the viscosities lowers it.
    #[default]
    Harmonic,
    /// (η_a + η_b)/2: scatter does not change it; for laws whose stress matters at rest.
    Arithmetic,
}

/// The viscosity column, with means of pairs: harmonic is Ghaïtanellis 2017, Eq. 3.30.
#[derive(Clone, Copy, Debug)]
pub struct PerParticle(pub Within);

/// The viscosity column, found.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a>(&'a [f64], Within);

impl ViscositySource for PerParticle {
    type Bound<'a> = Column<'a>;
    fn access(self) -> Access {
        Access::none().both(fields::VISCOSITY)
    }
    fn bind<const D: usize>(self, world: &World<D>) -> Result<Column<'_>, StepError> {
        Ok(Column(world.free.get(fields::VISCOSITY)?, self.0))
    }
}

impl BoundViscosity for Column<'_> {
    type Here = f64;
    type Side<L: Lane> = L;
    #[inline(always)]
    fn side<L: Lane>(&self, here: &[f64]) -> L {
        side(here, |eta| *eta)
    }
    #[inline(always)]
    fn owns<L: Lane>(&self, here: &L) -> L {
        *here
    }
    #[inline(always)]
    fn means<L: Lane>(&self, here: &L, neighbour: usize) -> L {
        within(self.1, *here, L::splat(self.0[neighbour]))
    }
    #[inline(always)]
    fn here(&self, particle: usize) -> f64 {
        self.0[particle]
    }
    #[inline(always)]
    fn own(&self, here: &f64) -> f64 {
        *here
    }
    #[inline(always)]
    fn at(&self, neighbour: usize) -> f64 {
        self.0[neighbour]
    }
}

/// The viscosity column, with means of two layers in series across interfaces:
/// η̄ = (d_a + d_b)/(d_a/η_a + d_b/η_b) for particles of two phases at d from their interface.
///
/// With it a first difference of a velocity with continuous shear stress is τ r·n/η̄, whatever the
/// place of the interface between the two; the harmonic mean has it in the middle. Ours.
/// Pairs of one phase have the mean that is given.
#[derive(Clone, Copy, Debug)]
pub struct InSeries(pub Within);

/// The columns of [`InSeries`].
#[derive(Clone, Copy, Debug)]
pub struct SeriesColumns<'a> {
    viscosity: &'a [f64],
    phase: &'a [u32],
    distance: &'a [f64],
    within: Within,
}

impl ViscositySource for InSeries {
    type Bound<'a> = SeriesColumns<'a>;
    fn access(self) -> Access {
        Access::none()
            .both(fields::VISCOSITY)
            .both(fields::PHASE)
            .both(INTERFACE_DISTANCE)
    }
    fn bind<const D: usize>(self, world: &World<D>) -> Result<SeriesColumns<'_>, StepError> {
        Ok(SeriesColumns {
            viscosity: world.free.get(fields::VISCOSITY)?,
            phase: world.free.get(fields::PHASE)?,
            distance: world.free.get(INTERFACE_DISTANCE)?,
            within: self.0,
        })
    }
}

impl BoundViscosity for SeriesColumns<'_> {
    /// Viscosity, phase, distance.
    type Here = (f64, u32, f64);
    /// The same; phases are small whole numbers, exact as any.
    type Side<L: Lane> = (L, L, L);
    #[inline(always)]
    fn side<L: Lane>(&self, here: &[Self::Here]) -> (L, L, L) {
        let phase = side(here, |own| f64::from(own.1));
        (side(here, |own| own.0), phase, side(here, |own| own.2))
    }
    #[inline(always)]
    fn owns<L: Lane>(&self, here: &(L, L, L)) -> L {
        here.0
    }
    #[inline(always)]
    fn means<L: Lane>(&self, here: &(L, L, L), j: usize) -> L {
        let there = L::splat(self.viscosity[j]);
        let unlike = unlike(here.1, self.phase[j]);
        let alike = within(self.within, here.0, there);
        // Most pairs are of one phase.
        if !L::splat(0.0).any_less(unlike) {
            return alike;
        }
        let mixed = in_series(here.2, here.0, L::splat(self.distance[j]), there);
        unlike.where_positive(mixed, alike)
    }
    #[inline(always)]
    fn here(&self, i: usize) -> Self::Here {
        (self.viscosity[i], self.phase[i], self.distance[i])
    }
    #[inline(always)]
    fn own(&self, here: &Self::Here) -> f64 {
        here.0
    }
    #[inline(always)]
    fn at(&self, neighbour: usize) -> f64 {
        self.viscosity[neighbour]
    }
}

/// One number of several particles.
#[inline(always)]
fn side<H, L: Lane>(here: &[H], of: impl Fn(&H) -> f64) -> L {
    let mut side = L::splat(0.0);
    for (lane, own) in here.iter().enumerate() {
        side.set(lane, of(own));
    }
    side
}

/// Mean of a pair of one phase.
#[inline(always)]
fn within<L: Lane>(mean: Within, eta: L, other: L) -> L {
    match mean {
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
